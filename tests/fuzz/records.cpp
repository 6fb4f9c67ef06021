// Record files: whatever the bytes, the reader returns a valid ground motion or an error that says why not.
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "fuzz.hpp"
#include "ground/agency_files.hpp"
#include "ground/record_files.hpp"
#include "stickslip/ground/records.hpp"
#include "stickslip/ground/station.hpp"

using namespace record_files;
using stickslip::GroundMotion;
using stickslip::RecordOptions;
namespace fs = std::filesystem;

namespace {

std::size_t allocated = 0;  // bytes allocated in total

/// The file that every case is written to.
class Scratch {
 public:
  Scratch() : path_(fs::temp_directory_path() / ("stickslip_fuzz_" + std::to_string(::getpid()))) {}
  ~Scratch() { fs::remove(path_, ignored_); }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;

  const fs::path& write(std::string_view bytes) const {
    std::ofstream stream(path_, std::ios::binary);
    stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    if (!stream.flush()) throw std::runtime_error("cannot write " + path_.string());
    return path_;
  }

 private:
  fs::path path_;
  std::error_code ignored_{};
};

/// The result of reading some bytes.
struct Result {
  std::optional<GroundMotion> motion{};
  std::string error{};
};

Result read(const fs::path& file, std::size_t size, const RecordOptions& options) {
  Result result;
  const std::size_t before = allocated;
  try {
    result.motion = stickslip::read_record(file, options);
  } catch (const std::invalid_argument& error) {
    result.error = error.what();
  }
  if (const std::size_t bytes = allocated - before; bytes > (std::size_t{1} << 17) + 512 * size)
    finding("reading " + std::to_string(size) + " bytes allocates " + std::to_string(bytes));
  return result;
}

/// Whether a text is UTF-8 without control characters: decodes each character and encodes it again.
bool is_clean(std::string_view text) {
  while (!text.empty()) {
    const auto byte = [text](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u; };
    const std::size_t length = byte(0) < 0x80 ? 1 : byte(0) < 0xE0 ? 2 : byte(0) < 0xF0 ? 3 : 4;
    unsigned code = length == 1 ? byte(0) : byte(0) & (0x7Fu >> length);
    for (std::size_t i = 1; i < length; ++i) code = code << 6 | (byte(i) & 0x3F);
    if (code < 0x20 || (code >= 0x7F && code < 0xA0) || (code >= 0xD800 && code < 0xE000) || code > 0x10FFFF)
      return false;

    std::string encoded;
    if (code < 0x80) {
      encoded += static_cast<char>(code);
    } else {
      const std::size_t shortest = code < 0x800 ? 2 : code < 0x10000 ? 3 : 4;
      encoded += static_cast<char>((0xF00u >> shortest & 0xFF) | code >> 6 * (shortest - 1));
      for (std::size_t i = shortest - 1; i > 0; --i) encoded += static_cast<char>(0x80 | (code >> 6 * (i - 1) & 0x3F));
    }
    if (!text.starts_with(encoded)) return false;
    text.remove_prefix(encoded.size());
  }
  return true;
}

void check(const Result& result) {
  if (!result.motion) {
    if (result.error.size() > 700) finding("a message of " + std::to_string(result.error.size()) + " bytes");
    if (!is_clean(result.error)) finding("a message that is not clean UTF-8: " + result.error);
    return;
  }
  const GroundMotion& motion = *result.motion;
  if (!is_clean(motion.name())) finding("a name that is not clean UTF-8: " + motion.name());
  if (motion.name().size() > 1200) finding("a name of " + std::to_string(motion.name().size()) + " bytes");
  if (motion.samples() < 2) finding("fewer than two samples");
  if (!std::ranges::all_of(motion.acceleration(), [](double n) { return std::abs(n) <= 1e100; }))
    finding("an acceleration that is not finite");
  const bool even = !std::isnan(motion.dt());
  if (even ? !(motion.dt() > 0 && std::isfinite(motion.dt()) && motion.time(0) == 0) : motion.samples() == 2)
    finding("a time step of " + std::to_string(motion.dt()));
  for (std::size_t i = 1; i < motion.samples(); ++i)
    if (!(motion.time(i) > motion.time(i - 1) && std::isfinite(motion.time(i)))) finding("times that do not increase");
}

/// All components are read as one by one, and together they make a station or an error.
void check_station(const std::string& bytes, RecordOptions options) {
  options.component.clear();
  std::vector<stickslip::RecordComponent> components;
  try {
    components = stickslip::parse_components(bytes, "fuzz", options);
  } catch (const std::invalid_argument& error) {
    if (!is_clean(error.what())) finding("a message that is not clean UTF-8: " + std::string(error.what()));
    return;
  }
  if (components.empty()) finding("no components and no error");
  for (std::size_t i = 0; i < components.size() && i < 4; ++i) {
    if (!is_clean(components[i].name + components[i].start + components[i].motion.orientation()))
      finding("a name, start or orientation that is not clean UTF-8");
    const std::string number = std::to_string(i + 1);
    const auto named = [&](const stickslip::RecordComponent& one) { return one.name == number; };
    options.component = number;
    if (std::ranges::none_of(components, named) &&
        !(stickslip::parse_record(bytes, "fuzz", options) == components[i].motion))
      finding("component " + number + " alone is another");
  }
  try {
    const GroundMotion station = stickslip::station_motion(components, "30", true);
    if (station.samples() < 2) finding("a station of fewer than two samples");
  } catch (const std::invalid_argument& error) {
    if (!is_clean(error.what())) finding("a message that is not clean UTF-8: " + std::string(error.what()));
  }
}

bool same(const Result& a, const Result& b) {
  if (!a.motion || !b.motion) return !a.motion && !b.motion;
  if (!std::ranges::equal(a.motion->acceleration(), b.motion->acceleration()) || a.motion->name() != b.motion->name())
    return false;
  for (std::size_t i = 0; i < a.motion->samples(); ++i)
    if (a.motion->time(i) != b.motion->time(i)) return false;
  return true;
}

}  // namespace

// Called by the address sanitizer; without it nothing is counted.
extern "C" void __sanitizer_malloc_hook(const volatile void* memory, std::size_t size);
extern "C" void __sanitizer_malloc_hook(const volatile void*, std::size_t size) { allocated += size; }

std::vector<std::string> fuzz_seeds() {
  std::vector<std::string> seeds = {
      peer("NPTS=   5, DT=   .0100 SEC"),
      peer("5 .01 NPTS, DT", "1.234-100 1.5D-03-0.5+1.E+00 2\n"),
      smc(),
      geonet(),
      cosmos_channel("HNE", cosmos_data + cosmos_velocity()) + cosmos_channel("", cosmos_data),
      knet(),
      dyna(),
      afad(),
      cwb(),
      asa(),
      csmnc_corrected(),
      sigma(),
      bbp(),
      csmip_channel() + csmip_channel("Up"),
      csmip_uncorrected(true) + csmip_uncorrected(false),
      csmip_since_1990("Up", 40),
      usc_volume_1(),
      usc_volume_2(),
      bhrc() + bhrc("V2"),
      usgs(),
      "Time (s);NS (g);UD (gal)\n0,00;0,1;1\n0,01;-2,5;2\n0,02;3;1e-3\n",
      "# one column\n# units: g\n0.1\n-0.25\n1.5E-4\n0.5\n",
      table(even_times(9, 0.1), "%.1f"),
      table(even_times(150, 0.02), "%.3e"),
      table(even_times(150, 0.0123), "%.3f"),
      "# A title: D\xC3\xBCzce\n# units: g\n0 1\n1 2\n1.5 3\n",
  };
  if (const char* folder = std::getenv("STICKSLIP_RECORDS"))
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder))
      if (entry.is_regular_file()) {
        std::ifstream stream(entry.path(), std::ios::binary);
        seeds.emplace_back(std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>());
      }
  return seeds;
}

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const Scratch scratch;
  const std::string bytes(data, data + size);
  const fs::path& file = scratch.write(bytes);
  // Data missing from a file are supplied, as the error message suggests.
  RecordOptions options{.component = "1"};
  Result first = read(file, size, options);
  if (first.error.ends_with("pass units, such as \"g\" or \"m/s^2\"")) {
    options.units.push_back('g');  // an assignment of "g" makes GCC 12 warn of memory that overlaps
    first = read(file, size, options);
  }
  if (first.error.ends_with("pass dt, the seconds between samples")) {
    options.dt = 0.01;
    first = read(file, size, options);
  }
  if (first.error.ends_with("pass gaps to keep it as a straight line")) {
    options.gaps = true;
    first = read(file, size, options);
  }
  check(first);
  if (!same(read(file, size, options), first)) finding("two answers to the same bytes");
  std::string dos;
  for (const char byte : bytes) dos.append(byte == '\n' ? "\r" : "").push_back(byte);
  if (!same(read(scratch.write(dos), dos.size(), options), first)) finding("another answer with CRLF line ends");
  check_station(bytes, options);
  return 0;
}
