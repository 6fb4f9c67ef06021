// SIGMA, `.cor.acc`: lines `Key : value`, then packed samples of one component.
//
// Source: GEM gmpe-smtk, sigma parser; columns have 14 characters, signs run together. Not used: network, processing,
// cut-off frequencies. The time of the first sample is not stated.
#include "ground/records/checks.hpp"
#include "ground/records/formats.hpp"
#include "ground/records/keys.hpp"
#include "ground/records/reader.hpp"
#include "ground/records/rows.hpp"

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace stickslip::records {
namespace {

constexpr std::size_t longest_header = 40;
constexpr const char *step_key = "Time Increment (s)", *count_key = "Number of Data", *peak_key = "PGA (m/s/s)";

}  // namespace

bool is_sigma(const Lines& lines) {
  const Keys header(lines, longest_header);
  if (!header.has(step_key) || !header.has(count_key)) return false;
  const std::size_t next = std::max(header.line(step_key), header.line(count_key)) + 1;
  return std::any_of(lines.begin() + static_cast<std::ptrdiff_t>(next),
                     lines.begin() + static_cast<std::ptrdiff_t>(std::min(lines.size(), longest_header)),
                     [](std::string_view line) { return has(line, "time series"); });
}

std::vector<Channel> read_sigma(const Lines& lines) {
  constexpr std::size_t width = 14;
  const Keys header(lines, longest_header);
  Channel channel{.name = header.text("Orientation")};
  channel.dt = checked_step(header.number(step_key), header.line(step_key));
  const std::size_t samples = header.samples(count_key);
  channel.title = joined({header.text("Event Date & Time"), header.text("Station Code / Name"), channel.name});

  Reader reader(lines);
  reader.block(std::max(header.line(step_key), header.line(count_key)) + 1, "header");
  std::string_view series;
  while (is_text(reader.peek())) series = reader.line("samples");
  const std::size_t series_line = reader.last();
  if (!has(series, "time series") || !has(series, "accel"))  // Accelaration time series in m/s/s
    refuse_line(series_line,
                "expected an acceleration time series, got " + quote(series.empty() ? lines[series_line] : series));
  channel.units = squeeze(after(series, " in "));
  channel.acceleration = reader.numbers(samples, "samples", width);
  reader.require_end(samples);
  if (header.has(peak_key)) check_peak(channel, header.value(peak_key), "m/s/s", header.line(peak_key));
  return {channel};
}

}  // namespace stickslip::records
