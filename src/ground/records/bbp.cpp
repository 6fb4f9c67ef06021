// SCEC Broadband Platform, `.bbp`: comments that describe the columns, rows of time and components.
//
// Source: SCEC Broadband Platform, its files and converters. The columns are described by `# Column 2: N/S component
// ground acceleration (cm/s^2) (+ is 000)` or `# Column 2: North-south acceleration (cm/s/s) (+ is northward)`. Files
// with their labels in one line are tables. Not used: coordinates, distance, corner frequencies.
#include "ground/records/checks.hpp"
#include "ground/records/formats.hpp"
#include "ground/records/keys.hpp"
#include "ground/records/reader.hpp"
#include "ground/records/rows.hpp"

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace stickslip::records {
namespace {

/// Indices of the lines that describe columns 1, 2, ... in this order.
std::vector<std::size_t> column_lines(const Lines& lines) {
  std::vector<std::size_t> found;
  for (std::size_t i = 0, end = comment_lines(lines); i < end; ++i) {
    const std::string label = "Column " + std::to_string(found.size() + 1) + ":";
    if (same(uncommented(lines[i]).substr(0, label.size()), label)) found.push_back(i);
  }
  return found;
}

/// The text in the first brackets that state no sign.
std::string_view unit_of(std::string_view text) {
  for (std::size_t open = text.find('('); open != std::string_view::npos; open = text.find('(', open + 1))
    if (const std::string_view inside = trim(before(text.substr(open + 1), ")")); !inside.starts_with('+'))
      return inside;
  return {};
}

/// Reads `N/S component ground acceleration (cm/s^2) (+ is 000)`.
Channel component(std::string_view text, std::size_t line) {
  if (!has(text, "acceleration") || has(text, "spectr"))
    refuse_line(line, "expected a column of acceleration, got " + quote(text));
  Channel channel{.name = squeeze(before(before(before(text, "acceleration"), "ground"), "component")),
                  .units = squeeze(unit_of(after(text, "acceleration")))};
  std::string_view positive = trim(before(after(text, "(+ is"), ")"));  // 090, northward
  if (has(positive, "ward")) positive = before(positive, "ward");
  channel.orientation = squeeze(positive);
  return channel;
}

}  // namespace

bool is_bbp(const Lines& lines) {
  const std::vector<std::size_t> columns = column_lines(lines);
  return columns.size() > 1 && has(after(lines[columns[0]], ":"), "time");
}

std::vector<Channel> read_bbp(const Lines& lines) {
  const std::vector<std::size_t> columns = column_lines(lines);
  if (const std::string_view unit = unit_of(lines[columns[0]]); !is_second(unit))
    refuse_line(columns[0], "the first column must be time in seconds, got " + quote(uncommented(lines[columns[0]])));
  std::string station, start;
  const std::size_t first = comment_lines(lines);
  for (std::size_t i = 0; i < first; ++i) {
    const std::string_view text = uncommented(lines[i]);
    if (same(text.substr(0, 8), "station:")) station = squeeze(text.substr(8));
    if (same(text.substr(0, 5), "time=")) start = squeeze(text.substr(5));
  }

  Reader reader(lines);
  reader.block(first, "header");
  Rows rows = read_rows(reader, columns.size());
  const double dt = printed_step(rows, lines);
  std::vector<Channel> channels;
  for (std::size_t k = 1; k < columns.size(); ++k) {
    Channel channel = component(trim(after(lines[columns[k]], ":")), columns[k]);
    channel.title = joined({station, channel.name});
    channel.start = start;
    channel.dt = dt;
    channel.acceleration = std::move(rows.columns[k]);
    channels.push_back(std::move(channel));
  }
  return channels;
}

}  // namespace stickslip::records
