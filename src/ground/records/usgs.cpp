// Processed records of the U.S. Geological Survey of the 1980s: for each of acceleration, velocity and displacement seven
// lines of text, then numbers, ten a line.
//
// Used: the station, event and component, the sampling rate, the data type, the number of points and the first unit. The
// filter and the date are not used.
// Layout: the files of the Whittier Narrows earthquake of 1987 (Brady and others, USGS Open-File Report 89-12).
#include "ground/records/checks.hpp"
#include "ground/records/formats.hpp"
#include "ground/records/reader.hpp"

#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace stickslip::records {
namespace {

constexpr std::size_t text_lines = 7;

double number_after(const Lines& text, std::size_t heading, std::size_t line, std::string_view label) {
  std::string_view rest = trim(after(text[line], label));
  const std::optional<double> value = take_number(rest);
  if (!value || !(*value > 0))
    refuse_line(heading + line, "expected a number after " + quote(label) + ", got " + quote(text[line]));
  return *value;
}

}  // namespace

bool is_usgs(const Lines& lines) {
  return lines.size() > text_lines && has(lines[5], "SAMPLES/SEC=") && has(lines[5], "DATA TYPE=") &&
         has(lines[6], "NO OF POINTS=");
}

std::vector<Channel> read_usgs(const Lines& lines) {
  std::vector<Channel> channels;
  Reader reader(lines);
  while (!reader.done()) {
    const Lines text = reader.block(text_lines, "heading of 7 lines");
    const std::size_t heading = reader.last() + 1 - text_lines;
    if (!has(text[5], "DATA TYPE="))
      refuse_line(heading + 5, "expected the heading of another series, got " + quote(text[5]));
    const std::size_t samples = as_count(number_after(text, heading, 6, "NO OF POINTS="), heading + 6, "points");
    Channel channel{.name = squeeze(before(text[1], "DEGREES")),
                    .units = stated_units(text[6]),
                    .dt = 1 / number_after(text, heading, 5, "SAMPLES/SEC=")};
    channel.title = joined({squeeze(text[2]), squeeze(text[0]), channel.name});
    channel.acceleration = reader.numbers(samples, "samples", 8);
    if (!channels.empty()) check_step(channels[0], *channel.dt, heading + 5);
    if (same(trim(after(text[5], "DATA TYPE=")), "AC")) channels.push_back(std::move(channel));
  }
  if (channels.empty()) throw std::invalid_argument("no series of this file holds acceleration (DATA TYPE=AC)");
  return channels;
}

}  // namespace stickslip::records
