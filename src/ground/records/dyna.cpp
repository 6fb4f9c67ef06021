// ESM and ITACA: the DYNA header, one key per line.
#include "ground/records/formats.hpp"
#include "ground/records/reader.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace stickslip::records {
namespace {

bool is_header(std::string_view line) {
  line = trim(line);
  return line.find(':') != std::string_view::npos && !line.empty() && !is_digit(line[0]) && !is_sign(line[0]);
}

/// Index of the line with a key, or the number of lines.
std::size_t find_key(const Lines& lines, std::string_view key) {
  for (std::size_t i = 0; i < lines.size() && (is_header(lines[i]) || trim(lines[i]).empty()); ++i)
    if (same(trim(before(lines[i], ":")), key)) return i;
  return lines.size();
}

std::string_view value(const Lines& lines, std::string_view key) {
  const std::size_t line = find_key(lines, key);
  return line == lines.size() ? std::string_view() : trim(after(lines[line], ":"));
}

double number(const Lines& lines, std::string_view key) {
  const std::size_t line = find_key(lines, key);
  if (line == lines.size()) throw std::invalid_argument("the header has no " + quote(key));
  std::string_view text = value(lines, key);
  const std::optional<double> found = take_number(text);
  if (!found || !trim(text).empty())
    refuse_line(line, "expected a number after " + quote(key) + ", got " + quote(lines[line]));
  return *found;
}

}  // namespace

bool is_dyna(const Lines& lines) {
  return lines[0].starts_with("EVENT_NAME:") && find_key(lines, "SAMPLING_INTERVAL_S") < lines.size();
}

std::vector<Channel> read_dyna(const Lines& lines) {
  if (const std::string_view type = value(lines, "DATA_TYPE"); !type.empty() && !has(type, "ACCELERATION"))
    refuse_line(find_key(lines, "DATA_TYPE"), "expected acceleration, got " + quote(type));
  if (has(value(lines, "DATA_TYPE"), "SPECTR"))
    refuse_line(find_key(lines, "DATA_TYPE"),
                "expected an acceleration history, got " + quote(value(lines, "DATA_TYPE")));

  Channel channel{.name = squeeze(value(lines, "STREAM")),
                  .start = squeeze(value(lines, "DATE_TIME_FIRST_SAMPLE_YYYYMMDD_HHMMSS")),
                  .units = squeeze(value(lines, "UNITS")),
                  .dt = number(lines, "SAMPLING_INTERVAL_S")};
  channel.orientation = seed_orientation(channel.name);
  const std::string event = squeeze(value(lines, "EVENT_NAME")), id = squeeze(value(lines, "EVENT_ID"));
  channel.title = joined(
      {event.empty() || event == "None" ? id : event,
       squeeze(std::string(value(lines, "NETWORK")) + " " + std::string(value(lines, "STATION_CODE"))), channel.name});
  const std::size_t samples = as_count(number(lines, "NDATA"), find_key(lines, "NDATA"), "samples");

  std::size_t header = 0;
  while (header < lines.size() && (is_header(lines[header]) || trim(lines[header]).empty())) ++header;
  Reader reader(lines);
  reader.block(header, "header");
  channel.acceleration = reader.numbers(samples, "samples");
  reader.require_end(samples);
  return {channel};
}

}  // namespace stickslip::records
