// PEER AT2.
#include "ground/records/formats.hpp"
#include "ground/records/reader.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace stickslip::records {

namespace {

/// The line that states the number of samples and the time step, among the first ones; the number of lines if none does.
std::size_t size_line(const Lines& lines) {
  constexpr std::size_t first_lines = 10;  // four, and blank ones
  for (std::size_t i = 0; i < std::min(lines.size(), first_lines); ++i)
    if (has(lines[i], "NPTS") && has(lines[i], "DT")) return i;
  return lines.size();
}

/// The line before one that is not blank.
std::size_t line_before(const Lines& lines, std::size_t line) {
  while (line-- > 0)
    if (!trim(lines[line]).empty()) return line;
  return lines.size();
}

}  // namespace

bool is_peer(const Lines& lines) {
  const std::size_t size = size_line(lines);
  if (size == lines.size()) return false;
  const std::size_t quantity = line_before(lines, size);
  return quantity < lines.size() && line_before(lines, quantity) < lines.size();
}

std::vector<Channel> read_peer(const Lines& lines) {
  const std::size_t size = size_line(lines), quantity = line_before(lines, size);
  const auto says = [&](std::string_view word) { return has(lines[quantity], word); };
  if (!says("ACCELERATION") || says("SPECTR") || says("PSEUDO") || says("FOURIER"))
    refuse_line(quantity, "expected a PEER file of acceleration (AT2), got " + quote(lines[quantity]));
  std::string_view line = lines[size], rest;
  std::optional<double> count = labeled_number(line, "NPTS", rest), dt = labeled_number(line, "DT", rest);
  if (count && dt) {
    rest = trim(rest);
    const std::string_view unit = rest.substr(0, rest.find_first_of(" \t,;."));
    if (!unit.empty() && !is_second(unit)) refuse_line(size, "the time step must be in seconds, got " + quote(unit));
  } else if (!count && !dt) {
    rest = trim(line);
    count = take_number(rest);
    rest = after_separator(rest);
    dt = take_number(rest);
    if (!same(after_separator(rest).substr(0, 4), "NPTS")) dt.reset();
  }
  if (!count || !dt)
    refuse_line(size, "expected 'NPTS= 4096, DT= .0100 SEC' or '4096 .0100 NPTS, DT', got " + quote(line));
  const std::size_t samples = as_count(*count, size, "samples");

  // Event, date, station, component; in the first database then the number of the station, in brackets.
  std::string title = squeeze(lines[line_before(lines, quantity)]), remark;
  if (const std::size_t open = title.rfind('('); title.ends_with(')') && open != std::string::npos) {
    remark = " " + title.substr(open);
    title = squeeze(title.substr(0, open));
  }
  const std::size_t comma = title.rfind(',');
  const std::string name = comma == std::string::npos ? std::string() : squeeze(title.substr(comma + 1));
  title.insert(name.empty() ? title.size() : comma, remark);
  Channel component{.name = name, .title = title, .units = stated_units(lines[quantity]), .dt = *dt};
  Reader reader(lines);
  reader.block(size + 1, "header");
  component.acceleration = reader.numbers(samples, "samples");
  reader.require_end(samples);
  return {component};
}

}  // namespace stickslip::records
