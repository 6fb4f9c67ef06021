// Volume 1 of the Building and Housing Research Center, Iran (BHRC, ISMN): twelve lines of text, 100 integers, 50 reals,
// and samples at even steps, in tenths of g. Lines of integers and reals are cut at 70 characters.
//
// Used: the component, its azimuth, the station, the number of points, the unit, and real 9, the sampling rate. Checked:
// integer 28, the number of points, and the duration. The other lines, integers and reals are not used.
// Layout: the files of the center, and the reader of gmprocess (USGS) for their components.
#include "ground/records/formats.hpp"
#include "ground/records/reader.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "stickslip/base/error.hpp"

namespace stickslip::records {
namespace {

constexpr std::size_t text_lines = 12;

/// Index of the line with a label, or the number of lines.
std::size_t line_with(const Lines& lines, std::string_view label) {
  for (std::size_t i = 0; i < std::min(lines.size(), text_lines); ++i)
    if (has(lines[i], label)) return i;
  return lines.size();
}

double number_after(const Lines& text, std::size_t heading, std::string_view label) {
  const std::size_t line = line_with(text, label);
  if (line == text.size()) refuse_line(heading, "the heading has no " + quote(label));
  std::string_view rest = trim(after(text[line], label));
  if (rest.starts_with('=')) rest = trim(rest.substr(1));
  const std::optional<double> value = take_number(rest);
  if (!value) refuse_line(heading + line, "expected a number after " + quote(label) + ", got " + quote(text[line]));
  return *value;
}

/// The azimuth of a component L or T: `Azimuth L 50    T 140`; V is up.
std::string orientation_of(const Lines& text, const std::string& component) {
  const std::size_t line = line_with(text, "Azimuth");
  const std::string unknown = "unknown";
  if (component.empty()) return unknown;
  if (component[0] == 'V') return "V";
  if (line == text.size() || (component[0] != 'L' && component[0] != 'T')) return unknown;
  std::string_view rest = trim(after(text[line], "Azimuth"));
  for (std::size_t i = 0; i + 1 < rest.size(); ++i) {
    if (rest[i] != component[0] || !is_blank(rest[i + 1]) || (i > 0 && !is_blank(rest[i - 1]))) continue;
    std::string_view azimuth = trim(rest.substr(i + 1));
    const std::string_view whole = azimuth;
    if (take_number(azimuth)) return std::string(whole.substr(0, whole.size() - azimuth.size()));
  }
  return unknown;
}

/// The component whose heading was read.
Channel component_of(const Lines& text, std::size_t heading, Reader& reader) {
  const std::size_t units = line_with(text, "UNITS ARE"), size = heading + line_with(text, "NO. OF POINTS");
  if (units == text.size() || !has(text[units], "G/10"))
    refuse_line(heading, "expected 'UNITS ARE SECONDS AND G/10' in the heading that begins here");
  const std::size_t samples = as_count(number_after(text, heading, "NO. OF POINTS"), size, "points");
  const double duration = number_after(text, heading, "DURATION");

  const auto said = [&](std::string_view label) {
    const std::size_t line = line_with(text, label);
    return line == text.size() ? std::string_view() : text[line];
  };
  Channel channel{.name = squeeze(after(said("COMP "), "COMP ")), .units = "g"};
  channel.orientation = orientation_of(text, channel.name);
  channel.title =
      joined({squeeze(after(said("Origin Time"), ":")), squeeze(before(said("Station"), "Station")), channel.name});

  reader.done();  // skips blank lines
  const Lines integers = reader.block(7, "integers");
  const auto number = [&](std::string_view line, std::size_t column, std::size_t width, const std::string& what) {
    std::string_view field = trim(line.substr(std::min(column, line.size()), width));
    const std::optional<double> value = take_number(field);
    if (!value || !field.empty()) refuse_line(size, "the heading states no " + what + ", got " + quote(line));
    return *value;
  };
  if (const double points = number(integers[1], 55, 5, "integer 28"); points != static_cast<double>(samples))
    refuse_line(size, "states " + std::to_string(samples) + " points, but integer 28 is " + detail::shortest(points));
  const double rate = number(reader.block(7, "reals")[1], 0, 13, "real 9, the sampling rate");
  if (!(rate > 0) || std::abs(rate * duration / static_cast<double>(samples) - 1) > 0.01)
    refuse_line(size, "states " + std::to_string(samples) + " points in " + detail::shortest(duration) +
                          " s, but real 9 is a sampling rate of " + detail::shortest(rate) + " 1/s");
  channel.dt = 1 / rate;
  channel.acceleration = reader.numbers(samples, "samples", 13);
  for (double& n : channel.acceleration) n /= 10;
  if (trim(reader.peek()).starts_with("/&"))
    reader.line("end");
  else if (!has(reader.peek(), "VOL1DS FILE"))
    reader.require_end(samples);
  return channel;
}

}  // namespace

bool is_bhrc(const Lines& lines) {
  return has(lines[0], "VOL1DS FILE") && line_with(lines, "NO. OF POINTS") < lines.size();
}

std::vector<Channel> read_bhrc(const Lines& lines) {
  std::vector<Channel> channels;
  Reader reader(lines);
  while (!reader.done()) {
    const Lines text = reader.block(text_lines, "heading of 12 lines");
    const std::size_t heading = reader.last() + 1 - text_lines;
    if (!is_bhrc(text)) refuse_line(heading, "expected the heading of another component, got " + quote(text[0]));
    channels.push_back(component_of(text, heading, reader));
  }
  return channels;
}

}  // namespace stickslip::records
