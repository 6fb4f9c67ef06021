// K-NET and KiK-net.
#include "ground/records/checks.hpp"
#include "ground/records/formats.hpp"
#include "ground/records/reader.hpp"

#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace stickslip::records {
namespace {

constexpr std::size_t header_lines = 17;

/// The text after the label of a header line.
std::string_view value(const Lines& lines, std::string_view label, std::size_t& line) {
  for (line = 0; line < header_lines; ++line)
    if (same(lines[line].substr(0, label.size()), label)) return trim(lines[line].substr(label.size()));
  throw std::invalid_argument("the header has no line " + quote(label));
}

double number(const Lines& lines, std::string_view label) {
  std::size_t line = 0;
  std::string_view text = value(lines, label, line);
  const std::optional<double> found = take_number(text);
  if (!found) refuse_line(line, "expected a number after " + quote(label) + ", got " + quote(lines[line]));
  return *found;
}

}  // namespace

bool is_knet(const Lines& lines) {
  return lines.size() > header_lines && same(lines[0].substr(0, 11), "Origin Time") &&
         same(lines[5].substr(0, 12), "Station Code");
}

std::vector<Channel> read_knet(const Lines& lines) {
  std::size_t line = 0;
  const std::string station = squeeze(value(lines, "Station Code", line));
  const std::string origin = squeeze(value(lines, "Origin Time", line));
  Channel channel{.start = squeeze(value(lines, "Record Time", line)), .units = "gal"};

  const double frequency = number(lines, "Sampling Freq(Hz)"), duration = number(lines, "Duration Time(s)");
  channel.dt = 1 / frequency;
  const std::size_t samples = as_count(std::round(frequency * duration), 11, "samples");

  // N-S, E-W, U-D; of KiK-net 1 to 3 in the borehole and 4 to 6 at the surface.
  channel.name = squeeze(value(lines, "Dir.", line));
  if (channel.name.find_first_not_of("0123456789-") == std::string::npos) channel.orientation = "unknown";
  if (channel.name.size() == 1 && channel.name[0] >= '1' && channel.name[0] <= '6') {
    channel.orientation = std::string_view("NEZ")[static_cast<std::size_t>(channel.name[0] - '1') % 3];
    channel.sensor = channel.name[0] < '4' ? "borehole" : "surface";
  }

  std::string_view text = value(lines, "Scale Factor", line);  // 3920(gal)/6182761
  const std::optional<double> numerator = take_number(text);
  text = trim(text);
  const bool gal = same(text.substr(0, 5), "(gal)");
  text = gal ? trim(text.substr(5)) : text;
  const bool over = text.starts_with('/');
  text = over ? trim(text.substr(1)) : text;
  const std::optional<double> denominator = take_number(text);
  if (!numerator || !gal || !over || !denominator || !text.empty() || !(*denominator != 0))
    refuse_line(line, "expected a scale factor as '3920(gal)/6182761', got " + quote(lines[line]));

  channel.title = joined({origin, squeeze(station + " " + channel.sensor), channel.name});
  Reader reader(lines);
  reader.block(header_lines, "header");
  channel.acceleration = reader.numbers(samples, "samples", 9);
  reader.require_end(samples);
  for (double& n : channel.acceleration) n *= *numerator / *denominator;
  const std::string_view peak = value(lines, "Max. Acc. (gal)", line);
  check_peak(channel, peak, line);
  return {channel};
}

}  // namespace stickslip::records
