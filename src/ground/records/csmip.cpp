// CSMIP V1 and V2, the format of the California Strong Motion Instrumentation Program. V3 holds spectra.
#include "ground/records/formats.hpp"
#include "ground/records/reader.hpp"

#include <charconv>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace stickslip::records {
namespace {

bool is_spectra(std::string_view line) { return has(line, "response") && has(line, "spectra"); }
bool is_uncorrected(std::string_view line) { return has(line, "uncorrected accelerogram data"); }
bool is_end(std::string_view line) { return trim(line).starts_with("/&") || has(line, "end of data"); }

/// Number of columns in a Fortran format such as `(8f10.6)`, or 0.
std::size_t stated_width(std::string_view line) {
  const std::size_t open = line.rfind('(');
  std::string_view rest = open == std::string_view::npos ? std::string_view() : line.substr(open + 1);
  while (!rest.empty() && is_digit(rest[0])) rest.remove_prefix(1);
  if (rest.empty() || lower(rest[0]) != 'f') return 0;
  std::size_t width = 0;
  std::from_chars(rest.data() + 1, rest.data() + rest.size(), width);
  return width;
}

/// The unit in `... in cm/sec2. (8f10.6)`, `(UNITS: CM/SEC/SEC)`, `UNITS OF UNCOR ACCEL ARE SEC-G/10.`
std::string unit_of(std::string_view line) {
  if (const std::string_view are = after(line, " ARE SEC"); !are.empty()) {
    std::string_view unit = are.substr(std::min(are.find_first_not_of(" -,"), are.size()));
    if (same(unit.substr(0, 4), "and ")) unit = trim(unit.substr(4));
    unit = unit.substr(0, unit.find_first_of(" ,;("));
    while (unit.ends_with('.')) unit.remove_suffix(1);
    return std::string(unit);
  }
  if (has(line, "units")) return stated_units(before(line, ")"));
  std::string_view unit = trim(after(line, " in "));
  unit = unit.substr(0, unit.find_first_of(" \t,;("));
  while (unit.ends_with('.')) unit.remove_suffix(1);
  return std::string(unit);
}

/// Sets the unit; tenths of g become g.
void set_unit(Channel& channel, const std::string& unit) {
  const bool tenths = same(unit, "g/10");
  channel.units = tenths ? unit.substr(0, 1) : unit;
  if (tenths)
    for (double& n : channel.acceleration) n /= 10;
}

/// The description in the line of a channel: `Chan  1:  90 Deg   Location: ...`.
std::string orientation_of(const Lines& text) {
  for (std::string_view line : text)
    if (same(trim(line).substr(0, 4), "chan")) {
      std::string_view rest = trim(after(line, ":"));
      if (has(rest, "deg")) return squeeze(before(rest, "deg"));
      return squeeze(rest.substr(0, rest.find("  ")));
    }
  return {};
}

}  // namespace

bool is_csmip(const Lines& lines) {
  if (lines.size() < 2) return false;
  return is_uncorrected(lines[0]) || (has(lines[0], "corrected accelerogram") && is_uncorrected(lines[1])) ||
         (is_spectra(lines[0]) && has(lines[1], "corrected accelerogram"));
}

std::vector<Channel> read_csmip(const Lines& lines) {
  std::vector<Channel> channels;
  Reader reader(lines);
  while (!reader.done()) {
    if (is_spectra(reader.peek()))
      throw std::invalid_argument(
          "a CSMIP V3 file holds response and Fourier spectra, not an acceleration history; read the V1 or V2 file");
    const bool corrected = !is_uncorrected(reader.peek());
    reader.done();  // skips blank lines
    const Lines text = reader.block(corrected ? 25 : 13, corrected ? "heading of 25 lines" : "heading of 13 lines");
    const std::size_t heading = reader.last() + 1 - text.size();
    if (!has(text[0], "corrected accelerogram"))
      refuse_line(heading, "expected the heading of another channel, got " + quote(text[0]));
    const std::vector<double> integer = reader.numbers(100, "integers", 5);
    reader.numbers(corrected ? 100 : 50, "reals", 10);

    Channel channel{.name = orientation_of(text)};
    channel.title = joined(
        {squeeze(before(text[corrected ? 4 : 3], "  ")), squeeze(before(text[corrected ? 6 : 5], "  ")), channel.name});
    bool found = false;
    while (has(reader.peek(), "points of")) {
      const std::string_view line = reader.line("samples");
      std::string_view rest = trim(line);
      const std::optional<double> count = take_number(rest);
      const std::size_t samples = as_count(count.value_or(-1), reader.last(), "samples");
      std::string_view step = trim(after(line, "spaced at"));
      const std::optional<double> dt = take_number(step);
      if (!dt) refuse_line(reader.last(), "expected points of data equally spaced in seconds, got " + quote(line));
      const std::vector<double> values = reader.numbers(samples, "samples", stated_width(line));
      if (!has(line, "accel")) continue;
      channel.dt = *dt;
      channel.acceleration = values;
      set_unit(channel, unit_of(line));
      found = true;
    }
    if (!found && !corrected) {  // pairs of time and acceleration
      const std::size_t samples = as_count(integer[27], heading + 13, "samples");
      const std::vector<double> values = reader.numbers(2 * samples, "times and samples", 7);
      for (std::size_t i = 0; i < values.size(); i += 2) {
        channel.times.push_back(values[i]);
        channel.acceleration.push_back(values[i + 1]);
      }
      for (const std::string_view line : text)
        if (channel.units.empty() && has(line, "units of")) set_unit(channel, unit_of(line));
      found = true;
    }
    if (!found) throw std::invalid_argument("a channel of this CSMIP file holds no acceleration");
    if (is_end(reader.peek())) reader.line("end of data");
    channels.push_back(std::move(channel));
  }
  return channels;
}

}  // namespace stickslip::records
