// ESM and ITACA: the DYNA header, one key per line.
#include "ground/records/checks.hpp"
#include "ground/records/formats.hpp"
#include "ground/records/keys.hpp"
#include "ground/records/reader.hpp"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace stickslip::records {
namespace {

bool is_header(std::string_view line) {
  line = trim(line);
  return line.find(':') != std::string_view::npos && !line.empty() && !is_digit(line[0]) && !is_sign(line[0]);
}

std::size_t header_lines(const Lines& lines) {
  std::size_t count = 0;
  while (count < lines.size() && (is_header(lines[count]) || trim(lines[count]).empty())) ++count;
  return count;
}

}  // namespace

bool is_dyna(const Lines& lines) { return Keys(lines, header_lines(lines)).has("SAMPLING_INTERVAL_S"); }

std::vector<Channel> read_dyna(const Lines& lines) {
  const std::size_t first = header_lines(lines);
  const Keys header(lines, first);
  if (const std::string_view type = header.value("DATA_TYPE"); !type.empty() && !has(type, "ACCELERATION"))
    refuse_line(header.line("DATA_TYPE"), "expected acceleration, got " + quote(type));
  if (has(header.value("DATA_TYPE"), "SPECTR") || has(header.value("DATA_TYPE"), "PSEUDO"))
    refuse_line(header.line("DATA_TYPE"), "expected an acceleration history, got " + quote(header.value("DATA_TYPE")));

  Channel channel{.name = header.text("STREAM"),
                  .start = header.text("DATE_TIME_FIRST_SAMPLE_YYYYMMDD_HHMMSS"),
                  .units = header.text("UNITS"),
                  .dt = header.number("SAMPLING_INTERVAL_S")};
  const std::string event = header.text("EVENT_NAME"), id = header.text("EVENT_ID");
  channel.title = joined({event.empty() || same(event, "none") ? id : event,
                          squeeze(header.text("NETWORK") + " " + header.text("STATION_CODE")), channel.name});
  const std::size_t samples = header.samples("NDATA");

  Reader reader(lines);
  reader.block(first, "header");
  channel.acceleration = reader.numbers(samples, "samples");
  reader.require_end(samples);
  if (header.has("PGA_CM/S^2")) check_peak(channel, header.value("PGA_CM/S^2"), "cm/s^2", header.line("PGA_CM/S^2"));
  if (!header.value("DURATION_S").empty())
    check_duration(channel, header.number("DURATION_S"), header.line("DURATION_S"));
  return {channel};
}

}  // namespace stickslip::records
