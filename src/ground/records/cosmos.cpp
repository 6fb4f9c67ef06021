// COSMOS V1 and V2.
#include "ground/records/checks.hpp"
#include "ground/records/formats.hpp"
#include "ground/records/reader.hpp"

#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "stickslip/ground/orientation.hpp"

namespace stickslip::records {
namespace {

constexpr double unknown = -999;

/// Number of columns in `Format=(8F10.5)`, or 0.
std::size_t stated_width(std::string_view line) { return fortran_width(after(after(line, "Format="), "(")); }

/// The number at the start of a line such as `100 Real-header values follow on 20 lines`.
std::size_t leading_count(const Reader& reader, std::string_view line, const std::string& what) {
  std::string_view rest = trim(line);
  const std::optional<double> count = take_number(rest);
  if (!count || !has(rest, what)) refuse_line(reader.last(), "expected a number of " + what + ", got " + quote(line));
  return as_count(*count, reader.last(), what);
}

}  // namespace

bool is_cosmos(const Lines& lines) { return has(lines[0], "(Format v"); }

std::vector<Channel> read_cosmos(const Lines& lines) {
  std::vector<Channel> components;
  Reader reader(lines);
  while (!reader.done()) {
    const std::string_view first = reader.line("header");
    if (has(first, "spectr"))
      refuse_line(
          reader.last(),
          "a COSMOS V3 file holds spectra, not an acceleration history; read the V1 or V2 file, got " + quote(first));
    if (!is_cosmos({first})) refuse_line(reader.last(), "expected the header of another channel, got " + quote(first));

    Channel channel;
    std::string event, station;
    std::string_view largest;  // what follows "Max =" in the text
    std::size_t largest_line = 0;
    std::string_view line = reader.line("integer header");
    for (; !has(line, "Integer-header"); line = reader.line("integer header")) {
      if (has(line, "Record of ")) event = squeeze(after(line, "Record of "));
      if (has(line, "Rcrd start time:")) channel.start = squeeze(before(after(line, "Rcrd start time:"), "("));
      if (has(line, "Code:")) station = squeeze(after(line, "Code:"));
      if (has(line, "Processed:") && has(line, " Max =")) {
        largest = trim(after(line, " Max ="));
        largest_line = reader.last();
      }
      if (has(line, "Sta Chan")) channel.name = squeeze(before(after(line, ":"), "("));
    }
    const std::size_t stage_line = reader.last() + 1;
    const std::vector<double> integer =
        reader.numbers(leading_count(reader, line, "Integer-header"), "integers", stated_width(line));
    const double stage = integer.empty() ? unknown : integer[0];
    if (stage == 0)
      refuse_line(stage_line,
                  "a COSMOS V0 file (integer 1 is 0) holds raw counts, not acceleration; read the V1 or V2 file");
    if (stage == 3)
      refuse_line(
          stage_line,
          "a COSMOS V3 file (integer 1 is 3) holds spectra, not an acceleration history; read the V1 or V2 file");

    line = reader.line("real header");
    const std::size_t header_line = reader.last();
    const std::vector<double> real =
        reader.numbers(leading_count(reader, line, "Real-header"), "reals", stated_width(line));
    if (real.size() < 62) refuse_line(header_line, "the time step is real 62, got " + std::to_string(real.size()));
    channel.dt = real[61] / 1000;

    line = reader.line("comments");
    for (std::string_view comment : reader.block(leading_count(reader, line, "Comment"), "comments"))
      if (has(comment, "SCNL")) {  // station, channel, network, location
        const std::string_view code = after(comment, ".");
        channel.name = squeeze(code.substr(0, code.find('.')));
        channel.orientation = orientation_in(channel.name);
      }
    // Integer 54: an azimuth from 1, or a code for vertical components. Some files hold 0 where it is unknown. It is more
    // precise than the letter of a channel's code; a direction in the text comes first.
    const std::string by_text = channel.orientation.empty() ? orientation_in(channel.name) : std::string();
    if (by_text.empty() && integer.size() > 53) {
      const double sensor = integer[53];
      const bool points_up = upward(channel.orientation) != 0;
      if (sensor >= 1 && sensor <= 360 && !points_up) channel.orientation = orientation_at(sensor);
      if (sensor == 400 || sensor == 401) channel.orientation = sensor == 400 ? "up" : "down";
      if (sensor == 402) channel.orientation = "vertical";
    }
    channel.title = joined({event, station, channel.name});

    // Velocity and displacement may follow, with or without their own header.
    while (has(reader.peek(), " pts")) {
      line = reader.line("samples");
      const std::size_t samples = leading_count(reader, line, "pts");
      const std::vector<double> values = reader.numbers(samples, "samples", stated_width(line));
      if (const std::string_view end = trim(reader.peek()); same(end.substr(0, 3), "End") || end.starts_with("/&"))
        reader.line("end");
      else if (!is_cosmos({reader.peek()}))
        reader.require_end(samples);
      if (!has(line, "accel")) continue;
      channel.units = stated_units(line);
      channel.acceleration = values;
      const std::size_t size_line = reader.last();
      std::string_view duration = trim(after(line, "approx"));
      if (const std::optional<double> seconds = take_number(duration)) check_duration(channel, *seconds, size_line);
      std::string_view peak = largest;
      if (take_number(peak)) check_peak(channel, largest, first_word(peak), largest_line);
      components.push_back(channel);
    }
  }
  if (components.empty()) throw std::invalid_argument("no channel of this COSMOS file holds acceleration");
  return components;
}

}  // namespace stickslip::records
