// CSMIP V1 (also RAW) and V2, the format of the California Strong Motion Instrumentation Program (CDMG, CGS), in which
// RENADIC (Chile) writes, too; and volumes I and II of Caltech and the University of Southern California, from which it
// descends: lines of text, then integers in columns of five characters and reals in columns of ten. V3 holds spectra.
//
// Used: the type, event, station, channel or component, and what is stated with the data: count, spacing, unit, columns;
// for pairs of time and acceleration integer 28 (their number) and the unit in the text. Checked against them: the number
// of points, the spacing and the peak in the text. The other lines, integers and reals are not used.
#include "ground/records/checks.hpp"
#include "ground/records/formats.hpp"
#include "ground/records/reader.hpp"
#include "ground/records/times.hpp"

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

bool is_spectra(std::string_view line) { return has(line, "response") && has(line, "spectra"); }
bool is_uncorrected(std::string_view line) { return has(line, "uncorrected accelerogram data"); }
bool is_corrected(std::string_view line) { return has(line, "corrected accelerogram") && !is_uncorrected(line); }
bool is_end(std::string_view line) { return trim(line).starts_with("/&") || has(line, "end of data"); }

/// The line above the samples: `3251 POINTS OF ACCEL DATA EQUALLY SPACED AT .020 SEC. (UNITS: CM/SEC/SEC)`,
/// `13200 Accelerogram points at 200 pts/sec in units of g .  Format: (8f9.6)`.
bool is_size(std::string_view line) {
  std::string_view rest = trim(line);
  return take_number(rest) && has(rest, "points") && (has(rest, "spaced at") || has(rest, "points at"));
}

/// Number of columns in the last brackets of a line, as in `(8f10.6)`, or 0.
std::size_t stated_width(std::string_view line) {
  const std::size_t open = line.rfind('(');
  return open == std::string_view::npos ? 0 : fortran_width(line.substr(open + 1));
}

/// The unit in `... in cm/sec2. (8f10.6)`, `IN UNITS CM/SEC/SEC`, `(UNITS: CM/SEC/SEC)`, `UNITS ARE SEC AND G/10`,
/// `UNITS OF UNCOR ACCEL ARE SEC-G/10.`, `Units of uncor data are sec and g .`; or nothing.
std::string unit_of(std::string_view line) {
  if (const std::string_view are = after(line, " ARE SEC"); !are.empty()) {
    std::string_view unit = same(are.substr(0, 4), "onds") ? are.substr(4) : are;
    unit = unit.substr(std::min(unit.find_first_not_of(" -,"), unit.size()));
    return first_word(same(unit.substr(0, 4), "and ") ? unit.substr(4) : unit);
  }
  if (has(line, "unit")) return first_word(stated_units(line));
  return first_word(after(line, " in "));
}

/// Sets the unit; tenths of g become g.
void set_unit(Channel& channel, const std::string& unit) {
  const bool tenths = same(unit, "g/10");
  channel.units = tenths ? unit.substr(0, 1) : unit;
  if (tenths)
    for (double& n : channel.acceleration) n /= 10;
}

/// The description in the line of a channel: `Chan  1:  90 Deg   Location: ...`, `COMP N08W`.
std::string orientation_of(const Lines& text) {
  for (std::string_view line : text) {
    line = trim(line);
    // Numbers at the end of a card are its length.
    if (same(line.substr(0, 5), "comp "))
      return is_blank(line[std::min<std::size_t>(6, line.size() - 1)]) ? "" : first_word(line.substr(5));
    if (same(line.substr(0, 4), "chan")) {
      std::string_view rest = trim(after(line, ":"));
      if (has(rest, "deg")) {  // 90 Deg, N 45 DEG E
        const std::string side = first_word(trim(after(rest, "deg")));
        const bool quadrant = same(side, "e") || same(side, "w");
        return squeeze(std::string(before(rest, "deg")) + (quadrant ? side : std::string()));
      }
      return squeeze(before(rest.substr(0, rest.find("  ")), "("));
    }
  }
  return {};
}

/// A number in the text and what follows it: `PEAK ACCELERATION = -242.39 CMS/SEC/SEC AT 4.580 SEC.`
struct Statement {
  double value = 0;
  std::string_view number{};  // as printed, and what follows
  std::string unit{};         // the word after it
  std::size_t line = 0;
};

std::optional<Statement> stated(const Lines& text, std::string_view label) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (!has(text[i], label)) continue;
    std::string_view rest = trim(after(text[i], label));
    if (rest.starts_with('=')) rest = trim(rest.substr(1));
    const std::string_view number = rest;
    if (const std::optional<double> value = take_number(rest)) return Statement{*value, number, first_word(rest), i};
  }
  return std::nullopt;
}

/// Checks what the text of a channel states of its samples.
void check(const Channel& channel, const Lines& text, std::size_t heading, bool corrected) {
  if (const auto every = stated(text, "INTERVALS OF")) check_step(channel, every->value, heading + every->line);
  if (const auto length = stated(text, "RECORD LENGTH")) check_duration(channel, length->value, heading + length->line);
  if (const auto peak = stated(text, corrected ? "PEAK ACCELERATION" : " MAX "))
    check_peak(channel, peak->number, peak->unit, heading + peak->line);
}

}  // namespace

bool is_csmip(const Lines& lines) {
  if (lines.size() < 2) return false;
  return is_uncorrected(lines[0]) || (is_corrected(lines[0]) && is_uncorrected(lines[1])) ||
         (is_spectra(lines[0]) && has(lines[1], "corrected accelerogram"));
}

std::vector<Channel> read_csmip(const Lines& lines) {
  std::vector<Channel> channels;
  Reader reader(lines);
  while (!reader.done()) {
    if (is_spectra(reader.peek()))
      throw std::invalid_argument(
          "a CSMIP V3 file holds response and Fourier spectra, not an acceleration history; read the V1 or V2 file");
    const bool corrected = is_corrected(reader.peek());
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
    while (is_size(reader.peek())) {
      const std::string_view line = reader.line("samples");
      std::string_view rest = trim(line);
      const std::size_t samples = as_count(take_number(rest).value_or(-1), reader.last(), "samples");
      const bool rated = !has(line, "spaced at");  // points per second
      std::string_view step = trim(after(line, rated ? "points at" : "spaced at"));
      const std::optional<double> number = take_number(step);
      if (!number || !(*number > 0) || (rated && !same(trim(step).substr(0, 7), "pts/sec")))
        refuse_line(reader.last(), "expected points of data equally spaced in seconds, got " + quote(line));
      const double dt = rated ? 1 / *number : *number;
      const std::vector<double> values = reader.numbers(samples, "samples", stated_width(line));
      if (!has(rest, "acc")) continue;
      channel.dt = dt;
      channel.acceleration = values;
      set_unit(channel, unit_of(line));
      if (const auto peak = stated(text, "PEAK ACCELERATION"); peak && channel.units.empty())
        channel.units = peak->unit;
      check(channel, text, heading, corrected);
      found = true;
    }
    if (!found && !corrected) {  // pairs of time and acceleration
      const std::size_t samples = as_count(integer[27], heading + 13, "samples");
      if (const std::optional<Statement> points = stated(text, "NO. OF POINTS"); points && points->value != integer[27])
        refuse_line(heading + points->line, "states " + detail::shortest(points->value) +
                                                " points, but integer 28 is " + detail::shortest(integer[27]));
      const std::vector<double> values = reader.numbers(2 * samples, "times and samples", 7);
      std::vector<double> times;
      for (std::size_t i = 0; i < values.size(); i += 2) {
        times.push_back(values[i]);
        channel.acceleration.push_back(values[i + 1]);
      }
      for (const std::string_view line : text)
        if (channel.units.empty() && has(line, "units") && has(line, " are sec")) set_unit(channel, unit_of(line));
      if (samples > 1) set_times(channel, times, std::vector<double>(times.size(), 0.001));
      check(channel, text, heading, corrected);
      found = true;
    }
    if (!found) throw std::invalid_argument("a channel of this file holds no acceleration");
    if (is_end(reader.peek())) reader.line("end of data");
    channels.push_back(std::move(channel));
  }
  return channels;
}

}  // namespace stickslip::records
