// CWB (now CWA), Taiwan, free format: comments `#Key: value`, rows of time and components in columns.
//
// Source: files of the Taiwan Strong Motion Instrumentation Program; gmprocess, cwb. A component is marked with the
// sign of its direction: (+) is read, (-) is refused, because no description says whether it turns the samples or the
// direction. Positive is up, north and east. Not used: coordinates, depth, magnitude, kind of instrument.
#include "ground/records/checks.hpp"
#include "ground/records/formats.hpp"
#include "ground/records/keys.hpp"
#include "ground/records/reader.hpp"
#include "ground/records/rows.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace stickslip::records {
namespace {

constexpr const char *rate_key = "SampleRate(Hz)", *length_key = "RecordLength(sec)", *order_key = "DataSequence";

/// The components of `Time U(+); N(+); E(+)`.
std::vector<std::string> components(const Keys& header) {
  const auto refuse = [&](std::string_view text) {
    refuse_line(header.line(order_key), "expected a sequence such as 'Time U(+); N(+); E(+)', got " + quote(text));
  };
  std::vector<std::string> names;
  std::string_view rest = header.value(order_key);
  if (!same(rest.substr(0, 4), "time")) refuse(rest);
  for (rest = after_separator(rest.substr(4)); !rest.empty(); rest = after_separator(rest)) {
    std::string_view one = rest.substr(0, rest.find_first_of(" \t,;"));
    rest.remove_prefix(one.size());
    if (!one.ends_with("(+)") || one.size() == 3) refuse(one);
    names.push_back(squeeze(one.substr(0, one.size() - 3)));
  }
  if (names.empty()) refuse(header.value(order_key));
  return names;
}

/// Compares the largest and the smallest sample with `0.658~ -0.837`.
void check_range(const Keys& header, const Channel& channel) {
  const std::string key = "AmplitudeMAX. " + channel.name;
  if (!header.has(key)) return;
  const std::string_view most = trim(before(header.value(key), "~")), least = trim(after(header.value(key), "~"));
  std::string_view up = most, down = least;
  const double above = std::abs(take_number(up).value_or(0)), below = std::abs(take_number(down).value_or(0));
  check_peak(channel, above > below ? most : least, header.line(key));
}

/// Rejects times that are half a step or more away from those of the sampling rate.
void check_times(const Keys& header, const Rows& rows, double dt, const Lines& lines) {
  const std::vector<double>& times = rows.columns[0];
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (!(std::abs(times[i] - times[0] - static_cast<double>(i) * dt) < dt / 2))
      refuse_line(rows.lines[i], "the times disagree with the sampling rate, " + quote(header.value(rate_key)) +
                                     " Hz, got " + quote(lines[rows.lines[i]]));
}

}  // namespace

bool is_cwb(const Lines& lines) {
  const Keys header(lines, comment_lines(lines));
  return header.has("StationCode") && header.has(order_key);
}

std::vector<Channel> read_cwb(const Lines& lines) {
  const std::size_t first = comment_lines(lines);
  const Keys header(lines, first);
  const std::vector<std::string> names = components(header);
  Reader reader(lines);
  reader.block(first, "header");
  Rows rows = read_rows(reader, names.size() + 1, fortran_width(header.value("Data")));

  double dt = 0;
  if (header.has(rate_key)) {
    dt = checked_step(1 / header.number(rate_key), header.line(rate_key));
    check_times(header, rows, dt, lines);
  } else {
    dt = printed_step(rows, lines);
  }
  if (header.has(length_key)) {  // it counts the samples, or the steps between them
    const std::size_t steps = as_count(std::round(header.number(length_key) / dt), header.line(length_key), "samples");
    if (rows.size() != steps + 1) rows.require_size(steps);
  }

  std::string_view unit = header.value("AmplitudeUnit");  // gal. DCoffset(corr)
  unit = unit.substr(0, unit.find_first_of(" \t."));
  const std::string event = header.text("Origin Time"), start = header.text("StartTime"),
                    station = squeeze(header.text("StationCode") + " " + header.text("StationName"));
  std::vector<Channel> channels;
  for (std::size_t k = 0; k < names.size(); ++k) {
    Channel channel{.name = names[k], .title = joined({event, station, names[k]}), .start = start};
    channel.units = squeeze(unit);
    channel.dt = dt;
    channel.acceleration = std::move(rows.columns[k + 1]);
    channels.push_back(std::move(channel));
  }
  if (has(header.value("AmplitudeUnit"), "(corr)"))  // with their offset the samples have other extremes
    for (const Channel& channel : channels) check_range(header, channel);
  return channels;
}

}  // namespace stickslip::records
