#include "ground/records/rows.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "ground/records/checks.hpp"
#include "ground/records/times.hpp"
#include "stickslip/base/error.hpp"

namespace stickslip::records {

void Rows::require_size(std::size_t stated) const {
  const std::string count = std::to_string(stated) + " samples the header states";
  if (size() < stated)
    throw std::invalid_argument("the file ends after " + std::to_string(size()) + " of the " + count);
  if (size() > stated) refuse_line(lines[stated], "more than the " + count);
}

Rows read_rows(Reader& reader, std::size_t columns, std::size_t width) {
  Rows rows{.columns = std::vector<std::vector<double>>(columns)};
  std::vector<double> row;
  while (!reader.done()) {
    const std::string_view line = reader.line("samples");
    row.clear();
    if (const std::string_view failed = append_numbers(row, line, width); !failed.empty())
      refuse_line(reader.last(), "expected finite numbers, got " + quote(failed));
    if (row.size() != columns)
      refuse_line(reader.last(), "expected " + std::to_string(columns) + " numbers, got " + std::to_string(row.size()) +
                                     " in " + quote(line));
    for (std::size_t k = 0; k < columns; ++k) rows.columns[k].push_back(row[k]);
    rows.lines.push_back(reader.last());
  }
  if (rows.size() < 2) throw std::invalid_argument("at least two rows of numbers are needed");
  return rows;
}

bool is_text(std::string_view line) {
  line = trim(line);
  const std::string_view word = line.substr(0, line.find_first_of(" \t,;"));
  if (same(word, "nan") || same(word, "inf") || same(word, "infinity")) return false;
  return line.empty() || (lower(line[0]) >= 'a' && lower(line[0]) <= 'z');
}

double printed_step(const Rows& rows, const Lines& lines) {
  const std::vector<double>& times = rows.columns[0];
  Resolution resolution;
  for (const std::size_t line : rows.lines) {
    const std::string_view row = trim(lines[line]);
    resolution.add(row.substr(0, row.find_first_of(" \t")));
  }
  Channel channel;
  set_times(channel, times, resolution.units());
  if (channel.dt) return checked_step(*channel.dt, rows.lines[1]);

  const double first = times[1] - times[0];
  std::size_t row = 2;
  while (row + 1 < rows.size() && std::abs(times[row] - times[row - 1] - first) <= 0.5 * std::abs(first)) ++row;
  row = std::min(row, rows.size() - 1);
  refuse_line(rows.lines[row], "expected evenly spaced times, got " + quote(lines[rows.lines[row]]));
}

}  // namespace stickslip::records
