#include "ground/records/formats.hpp"

#include <algorithm>
#include <iterator>
#include <stdexcept>

namespace stickslip::records {
namespace {

constexpr Format formats[] = {
    {"COSMOS V1 and V2", is_cosmos, read_cosmos},
    {"GeoNet V1A and V2A", is_geonet, read_geonet},
    {"USGS SMC", is_smc, read_smc},
    {"PEER AT2", is_peer, read_peer},
    {"two columns of seconds and acceleration", is_table, read_table},  // last: it takes whatever has a number
};

}  // namespace

std::string known_formats() {
  std::string known;
  for (const Format& format : formats) known.append(known.empty() ? "" : "; ").append(format.name);
  return known;
}

const Format& recognize(const Lines& lines) {
  const auto* const format = std::ranges::find_if(formats, [&](const Format& f) { return f.recognizes(lines); });
  if (format == std::end(formats))
    throw std::invalid_argument("no known format of records; known are: " + known_formats());
  return *format;
}

}  // namespace stickslip::records
