// Record files: whatever their bytes, a record comes out whole or the error says why not.
#include <unistd.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

#include "fuzz.hpp"
#include "record_files.hpp"
#include "stickslip/records.hpp"

using namespace record_files;
namespace fs = std::filesystem;

std::vector<std::string> fuzz_seeds() {
  std::vector<std::string> seeds = {
      peer("NPTS=   5, DT=   .0100 SEC"),
      peer("5 .01 NPTS, DT"),
      smc(),
      geonet(),
      cosmos_channel("HNE", cosmos_data + cosmos_velocity()),
      cosmos_channel("", cosmos_data),
      table(even_times(9, 0.1), "%.1f"),
      "# A title\n# units: g\n0 1\n1 2\n",
  };
  if (const char* folder = std::getenv("STICKSLIP_RECORDS"))
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder))
      if (entry.is_regular_file() && entry.path().string().find("usgs_pairs") == std::string::npos) {
        std::ifstream stream(entry.path(), std::ios::binary);
        seeds.emplace_back(std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>());
      }
  return seeds;
}

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fs::path file = fs::temp_directory_path() / ("stickslip_fuzz_" + std::to_string(::getpid()));
  std::ofstream(file, std::ios::binary).write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  try {
    const stickslip::GroundMotion motion = stickslip::read_record(file, {.units = "", .component = "1"});
    if (!std::isfinite(motion.peak_acceleration())) finding("an acceleration is not finite");
  } catch (const std::invalid_argument&) {
  }
  return 0;
}
