// CSMNC, the strong-motion network of China: a header of 16 lines, the last one blank, and packed samples of one
// component.
//
// Source: files of the China Strong Motion Network Center, Institute of Engineering Mechanics; CSMNC2SAC. Uncorrected
// and corrected acceleration are read; blocks of velocity and displacement behind it are left out. Not used:
// coordinates, depth, magnitude, site, instrument, time of the peak, duration, time before the event.
#include "ground/records/checks.hpp"
#include "ground/records/formats.hpp"
#include "ground/records/reader.hpp"
#include "ground/records/rows.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace stickslip::records {
namespace {

constexpr const char *count_label = "NO. OF POINTS", *step_label = "EQUALLY SPACED INTERVALS OF";

/// The text after a label and its colon.
std::string_view value(std::string_view line, std::string_view label) {
  std::string_view rest = trim(after(line, label));
  return rest.starts_with(':') ? trim(rest.substr(1)) : rest;
}

bool is_size(std::string_view line) { return has(line, count_label) && has(line, step_label); }

}  // namespace

bool is_csmnc(const Lines& lines) {
  constexpr std::size_t longest_header = 40;
  const auto end = lines.begin() + static_cast<std::ptrdiff_t>(std::min(lines.size(), longest_header));
  return std::any_of(lines.begin(), end, is_size);
}

std::vector<Channel> read_csmnc(const Lines& lines) {
  Reader reader(lines);
  std::vector<Channel> channels;
  std::string event, station, name, start;
  std::string_view quantity;  // the line that names it, of the last block
  std::size_t quantity_line = 0, samples = 0;
  while (!reader.done()) {
    if (samples > 0 && !is_text(reader.peek())) reader.require_end(samples);
    std::string_view peak, previous;
    std::size_t peak_line = 0, duration_line = 0;
    double dt = 0, duration = 0;
    for (bool sized = false; !sized || is_text(reader.peek());) {
      const std::string_view line = reader.line(sized ? "samples" : count_label);
      if (same(trim(line).substr(0, 9), "epicenter")) event = squeeze(previous);
      if (same(trim(line).substr(0, 8), "station:")) station = squeeze(first_word(value(line, "station")));
      if (same(trim(line).substr(0, 5), "comp.")) name = squeeze(value(line, "comp."));
      if (has(line, "RECORDER TIME")) start = squeeze(value(line, "RECORDER TIME"));
      if (has(line, "UNIT:")) {
        quantity = line;
        quantity_line = reader.last();
      }
      if (has(line, "PEAK VALUE")) {
        peak = value(line, "PEAK VALUE");
        peak_line = duration_line = reader.last();
        std::string_view seconds = value(line, "DURATION");
        duration = take_number(seconds).value_or(0);
      }
      if (is_size(line)) {
        std::string_view count = value(line, count_label), step = value(line, step_label);
        const std::optional<double> number = take_number(count), seconds = take_number(step);
        if (!number || !seconds || !is_second(first_word(trim(step))))
          refuse_line(reader.last(),
                      "expected 'NO. OF POINTS: 8800 EQUALLY SPACED INTERVALS OF: 0.005 SEC', got " + quote(line));
        samples = as_count(*number, reader.last(), "samples");
        dt = checked_step(*seconds, reader.last());
        sized = true;
      }
      previous = line;
    }
    if (quantity.empty())
      throw std::invalid_argument("the header has no line 'UNCORRECTED ACCELERATION UNIT: CM/SEC/SEC'");
    Channel channel{.name = name, .title = joined({event, station, name}), .start = start, .dt = dt};
    channel.acceleration = reader.numbers(samples, "samples");
    if (!has(quantity, "ACCELERATION") || has(quantity, "SPECTR")) continue;
    channel.units = squeeze(value(quantity, "UNIT"));
    check_peak(channel, peak, peak_line);
    check_duration(channel, duration, duration_line);
    channels.push_back(std::move(channel));
  }
  if (channels.empty()) refuse_line(quantity_line, "expected acceleration, got " + quote(quantity));
  return channels;
}

}  // namespace stickslip::records
