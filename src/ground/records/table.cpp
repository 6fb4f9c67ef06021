// Numbers without a format of an agency: columns of times and accelerations, or accelerations in reading order.
//
// The rules, in the order in which they apply:
//   1. The heading is what stands above the first line that begins with a number. Its last line labels the columns, if
//      it has a part for each and one of them is known. A line that states nothing but a unit, a time step or a number
//      of samples states it; every other line is a remark, which states nothing.
//   2. With labels: times are in the column that says so; other columns are accelerations, unless their label or unit
//      names another quantity or they are numbers of rows.
//   3. Without labels: the first of several columns holds times if it is even, begins near zero and has steps from 0.5
//      to 100 ms; it holds numbers of rows if it counts 0, 1, 2 or 1, 2, 3. Otherwise all are accelerations in reading
//      order. A number of samples may precede them.
#include "ground/records/formats.hpp"
#include "ground/records/labels.hpp"
#include "ground/records/times.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "stickslip/error.hpp"
#include "stickslip/ground/orientation.hpp"

namespace stickslip::records {
namespace {

/// Whether a text begins as a number does, including NaN and infinity.
bool is_numeral(std::string_view token) {
  const std::string_view word = token.substr(!token.empty() && is_sign(token[0]) ? 1 : 0);
  return !token.empty() && (Numeral(token).end == token.size() || same(word.substr(0, 3), "nan") || same(word, "inf") ||
                            same(word, "infinity"));
}

/// Whether a line starts with a number.
bool is_row(std::string_view line) {
  line = trim(line);
  if (line.starts_with('"')) line.remove_prefix(1);
  return is_numeral(line.substr(0, line.find_first_of(" \t,;\"")));
}

std::size_t first_row(const Lines& lines) {
  return static_cast<std::size_t>(std::ranges::find_if(lines, is_row) - lines.begin());
}

/// Whether commas are decimal points: columns are parted by something else, each comma is between digits, and no point
/// is in any row.
bool has_decimal_commas(const Lines& lines, std::size_t rows) {
  bool found = false;
  for (std::size_t i = rows; i < lines.size(); ++i) {
    const std::string_view row = trim(lines[i]);
    if (is_comment(row)) continue;
    if (row.find('.') != std::string_view::npos) return false;
    const bool quoted = row.find('"') != std::string_view::npos;
    for (std::size_t at = row.find(','); at != std::string_view::npos; at = row.find(',', at + 1)) {
      if (quoted && at > 0 && at + 1 < row.size() && row[at - 1] == '"' && row[at + 1] == '"') continue;
      if (at == 0 || at + 1 == row.size() || !is_digit(row[at - 1]) || !is_digit(row[at + 1])) return false;
      if (!quoted && row.find_first_of("; \t") == std::string_view::npos) return false;
      found = true;
    }
  }
  return found;
}

/// Whether a line before the first row looks like a row whose first number cannot be read, as `****, 0.1`.
bool is_damaged_row(std::string_view line) {
  line = trim(line);
  const std::size_t end = std::min(line.find_first_of(" \t,;"), line.size());
  const auto is_mark = [](char c) { return c == '*' || c == '.' || is_sign(c) || is_digit(c); };
  if (line.empty() || !std::ranges::all_of(line.substr(0, end), is_mark)) return false;
  std::string_view second = after_separator(line.substr(end));
  return take_number(second) && second.empty();
}

/// Whether a line only separates others.
bool is_ruler(std::string_view line) { return line.find_first_not_of("#%!*=-_ \t,;") == std::string_view::npos; }

/// A number that is printed without a point: a count.
bool is_whole(std::string_view token) {
  token = trim(token);
  return !token.empty() && token.find_first_not_of("0123456789") == std::string_view::npos;
}

/// What stands above the rows.
struct Heading {
  std::vector<Label> labels{};       // one for each column, or none
  std::size_t line = 0;              // of the labels
  std::vector<std::string> units{};  // one for each column, or one for all, or none
  std::size_t units_line = 0;
  Size size{};
  std::size_t size_line = 0;
  std::string title{};
};

Heading heading_of(const Lines& lines, std::size_t rows, std::size_t columns) {
  Heading heading;
  bool labels_possible = true;  // in the last line that states nothing else
  for (std::size_t i = rows; i-- > 0;) {
    const std::string_view line = trim(lines[i]);
    if (is_ruler(line)) continue;
    if (std::vector<std::string> units = units_in(line, columns); !units.empty()) {
      if (!heading.units.empty() && heading.units != units)
        refuse_line(i, "states other units than line " + std::to_string(heading.units_line + 1) + ": " + quote(line));
      heading.units = std::move(units);
      heading.units_line = i;
      continue;
    }
    if (const std::optional<Size> size = size_in(line)) {
      if (size->dt && heading.size.dt && *size->dt != *heading.size.dt)
        refuse_line(i,
                    "states another time step than line " + std::to_string(heading.size_line + 1) + ": " + quote(line));
      if (size->dt) heading.size.dt = size->dt;
      if (size->samples) heading.size.samples = size->samples;
      heading.size_line = i;
      continue;
    }
    if (std::exchange(labels_possible, false)) {
      heading.labels = labels_in(line, columns);
      heading.line = i;
      if (!heading.labels.empty()) continue;
    }
    if (!line.starts_with('#')) continue;
    std::string text = squeeze(line.substr(1));
    if (has(text, ": ")) text = squeeze(after(text, ": "));
    while (!text.empty() && is_separator(text.back())) text.pop_back();
    if (std::string_view rest = text; take_number(rest) && rest.empty()) continue;  // a number is no name
    if (!text.empty()) heading.title = text;
  }
  return heading;
}

/// The columns that hold times and accelerations.
struct Columns {
  std::optional<std::size_t> time{};
  double seconds = 1;  // in the unit of time
  std::vector<std::size_t> acceleration{};
};

Columns columns_of(const Heading& heading, std::size_t count) {
  Columns columns;
  for (std::size_t k = 0; k < heading.labels.size(); ++k) {
    const Label& label = heading.labels[k];
    if (k == 0 && label.quantity == Quantity::other && (label.other == "a period" || label.other == "a frequency"))
      refuse_line(heading.line, "the first column is " + label.other + " (" + quote(label.text) +
                                    "): this is a spectrum, not an acceleration history");
    if (label.quantity == Quantity::time && !columns.time) {
      columns.time = k;
      columns.seconds = label.seconds;
    } else if (label.quantity == Quantity::acceleration || label.quantity == Quantity::unknown) {
      columns.acceleration.push_back(k);
    }
  }
  if (heading.labels.empty()) {
    for (std::size_t k = 0; k < count; ++k) columns.acceleration.push_back(k);
  } else if (columns.acceleration.empty()) {
    std::string known;
    for (const Label& label : heading.labels)
      if (label.quantity == Quantity::other)
        known += (known.empty() ? "; " : ", ") + quote(label.text) + " is " + label.other;
    refuse_line(heading.line, "no column holds an acceleration" + known);
  }
  return columns;
}

/// What a first column without a label holds.
enum class First { times, row_numbers, acceleration };

/// Whether numbers count 0, 1, 2 or 1, 2, 3.
bool counts_rows(const std::vector<double>& values) {
  bool counts = values.size() > 2 && (values[0] == 0 || values[0] == 1);
  for (std::size_t i = 1; i < values.size() && counts; ++i) counts = values[i] == values[0] + static_cast<double>(i);
  return counts;
}

First first_column(const std::vector<double>& values, const Resolution& printed) {
  constexpr double shortest = 0.0005, longest = 0.1;  // steps of records [s]
  if (counts_rows(values)) return First::row_numbers;
  Channel even;
  if (!std::ranges::is_sorted(values, std::less_equal<>())) return First::acceleration;
  set_times(even, values, printed.units());
  const bool is_time = even.dt && *even.dt >= shortest * (1 - 1e-9) && *even.dt <= longest * (1 + 1e-9) &&
                       std::abs(values[0]) <= 10 * *even.dt;
  return is_time ? First::times : First::acceleration;
}

/// The sum of squared differences between numbers that follow each other in reading order, over that within columns.
/// Samples of one record in reading order vary less than those of different components.
double variation_ratio(const std::vector<std::vector<double>>& columns) {
  double in_order = 0, within = 0;
  std::size_t of_order = 0, of_columns = 0;
  const auto square = [](double value) { return value * value; };
  for (std::size_t i = 0; i < columns[0].size(); ++i)
    for (std::size_t k = 0; k < columns.size() && i < columns[k].size(); ++k) {
      if (k > 0) {
        in_order += square(columns[k][i] - columns[k - 1][i]);
        ++of_order;
      }
      if (i > 0) {
        within += square(columns[k][i] - columns[k][i - 1]);
        ++of_columns;
      }
    }
  return of_order > 0 && of_columns > 0 && within > 0
             ? in_order / static_cast<double>(of_order) / (within / static_cast<double>(of_columns))
             : 0;
}

/// Reads the accelerations that follow each other in lines of any number of columns.
/// @param first  the fields of a line above them with their number
std::vector<Channel> in_reading_order(const std::vector<std::vector<double>>& columns,
                                      const std::vector<std::string>& first, const Heading& heading, std::size_t row) {
  Channel channel{.title = heading.title, .dt = heading.size.dt};
  std::vector<double>& samples = channel.acceleration;
  for (std::size_t i = 0; i < columns[0].size(); ++i)
    for (std::size_t k = 0; k < columns.size() && i < columns[k].size(); ++k) samples.push_back(columns[k][i]);
  if (!heading.units.empty()) channel.units = heading.units[0];
  channel.units_from = "line " + std::to_string(heading.units_line + 1);
  std::optional<double> stated = heading.size.samples;
  std::size_t line = heading.size_line;
  if (!first.empty()) {  // a number of samples, and perhaps a time step
    line = row;
    std::string_view count = first[0];
    stated = take_number(count);
    if (first.size() > 1) {
      std::string_view step = first[1];
      const std::optional<double> dt = take_number(step);
      if (dt && channel.dt && *dt != *channel.dt)
        refuse_line(row, "states another time step than line " + std::to_string(heading.size_line + 1) + ": " +
                             quote(first[1]));
      channel.dt = dt;
    }
  }
  channel.step_from = "line " + std::to_string(line + 1);
  if (stated && as_count(*stated, line, "samples") != samples.size())
    refuse_line(line, "states " + detail::shortest(*stated) + " samples, but " + std::to_string(samples.size()) +
                          " numbers follow");
  if (samples.size() < 2) refuse_line(row, "at least two numbers are needed, got 1");
  return {std::move(channel)};
}

}  // namespace

bool is_table(const Lines& lines) {
  // TSPAIR and SLIST of IRIS, which ObsPy reads, state their unit and step in this line.
  return first_row(lines) < lines.size() && !lines[0].starts_with("TIMESERIES ");
}

std::vector<Channel> read_table(const Lines& lines) {
  std::size_t rows = first_row(lines);
  for (std::size_t i = 0; i < rows; ++i)
    if (is_damaged_row(lines[i])) refuse_line(i, "expected finite numbers, got " + quote(lines[i]));
  const bool commas = has_decimal_commas(lines, rows);

  std::vector<std::string_view> fields;
  std::string with_points;
  const auto split = [&](std::string_view row) {
    if (commas) {
      with_points = row;
      const bool quoted = row.find('"') != std::string_view::npos;
      for (std::size_t at = 0; at < with_points.size(); ++at)
        if (with_points[at] == ',' && (!quoted || (at > 0 && is_digit(with_points[at - 1])))) with_points[at] = '.';
      row = with_points;
    }
    split_row(row, fields);
  };
  const auto is_empty = [](std::string_view field) { return field.empty(); };
  /// Whether a line holds numbers; then `fields` are its columns, without empty ones at the end.
  const auto take = [&](std::size_t line) {
    if (trim(lines[line]).empty() || is_comment(lines[line])) return false;
    split(lines[line]);
    while (fields.size() > 1 && fields.back().empty()) fields.pop_back();
    return !std::ranges::all_of(fields, is_empty);
  };
  const auto next = [&](std::size_t line) {
    while (line < lines.size() && !take(line)) ++line;
    return line;
  };

  // A number of samples, and perhaps a time step, on a line of their own above numbers with points.
  std::vector<std::string> counts;
  take(rows);
  const std::size_t top = rows;
  if (const std::vector<std::string> first(fields.begin(), fields.end());
      first.size() <= 2 && is_whole(first[0]) && first[0].size() > 1) {
    const std::size_t second = next(rows + 1);
    const bool alone = first.size() == 2 && second < lines.size() && fields.size() != 2;
    bool pointed = first.size() == 1 && second < lines.size();
    for (std::size_t i = second, seen = 0; pointed && i < lines.size() && seen < 100; i = next(i + 1), ++seen)
      pointed = !std::ranges::any_of(fields, is_whole);
    if (alone || pointed) {
      counts = first;
      rows = second;
    }
    take(rows);
  }
  const std::size_t columns = fields.size();
  const Heading heading = heading_of(lines, top, columns);
  Columns roles = columns_of(heading, columns);

  const auto hint = [&] {
    return columns > 2 ? std::string("; record_formats lists what agencies write") : std::string();
  };
  std::vector<bool> used(columns, heading.labels.empty());
  for (const std::size_t k : roles.acceleration) used[k] = true;
  if (roles.time) used[*roles.time] = true;
  const std::size_t clock = roles.time.value_or(0);
  std::vector<std::vector<double>> values(columns);
  Resolution resolution;
  std::size_t count = 0;
  for (std::size_t i = next(rows), after; i < lines.size(); i = after, ++count) {
    const bool is_short = fields.size() < columns;
    for (std::size_t k = 0; k < std::min(columns, fields.size()); ++k) {
      if (!used[k]) continue;
      std::string_view rest = fields[k];
      const std::optional<double> value = take_number(rest);
      if (!value || !rest.empty())
        refuse_line(i, "expected finite numbers, got " + quote(fields[k].empty() ? lines[i] : fields[k]));
      values[k].push_back(*value);
    }
    if (clock < fields.size() && columns > 1) resolution.add(fields[clock]);
    const std::size_t got = fields.size();
    after = next(i + 1);
    if (got > columns || (is_short && (after < lines.size() || !heading.labels.empty() || count < 2)))
      refuse_line(i, "expected " + std::to_string(columns) + (columns == 1 ? " column" : " columns") + " as in line " +
                         std::to_string(rows + 1) + ", got " + std::to_string(got) + " in " + quote(lines[i]) + hint());
    if (is_short) break;  // the last line of numbers in reading order
  }

  const bool ragged = values.back().size() < values.front().size();
  const First first = heading.labels.empty() && columns > 1 && counts.empty() && !ragged
                          ? first_column(values[0], resolution)
                          : First::acceleration;
  if (heading.labels.empty()) {
    if (first == First::acceleration) {
      // Two rows at least say whether columns are components.
      if (columns > 1 && values[0].size() > 2 && variation_ratio(values) > 1)
        refuse_line(rows,
                    "the first of " + std::to_string(columns) +
                        " columns is not time (even, from about zero, in steps of 0.0005 to 0.1 s), and the numbers"
                        " are not one record in reading order: label the columns, as in 'Time (s), N (g), E (g)'" +
                        hint());
      return in_reading_order(values, counts, heading, top);
    }
    if (first == First::times) roles.time = 0;
    roles.acceleration.erase(roles.acceleration.begin());
  } else if (const Label& label = heading.labels[0]; roles.acceleration.size() > 1 && roles.acceleration[0] == 0 &&
                                                     label.quantity == Quantity::unknown && label.unit.empty() &&
                                                     counts_rows(values[0])) {
    roles.acceleration.erase(roles.acceleration.begin());
  }
  if (count < 2) refuse_line(rows, "at least two rows of numbers are needed, got 1" + hint());
  std::vector<Channel> channels;
  for (const std::size_t k : roles.acceleration) {
    Channel channel{.title = heading.title, .acceleration = std::move(values[k])};
    if (!heading.labels.empty()) {
      const Label& label = heading.labels[k];
      channel.label = label.text;
      channel.orientation = orientation_in(label.name);
      channel.units = label.unit;
      if (roles.acceleration.size() > 1) channel.name = label.name;
      if (!channel.name.empty()) channel.title = joined({heading.title, channel.name});
      if (heading.title.empty()) channel.title.clear();
    }
    const std::string unit = heading.units.empty()       ? std::string()
                             : heading.units.size() == 1 ? heading.units[0]
                                                         : heading.units[k];
    if (!unit.empty() && !channel.units.empty() && !same(unit, channel.units))
      refuse_line(heading.units_line, "states the unit " + quote(unit) + ", but the label of column " +
                                          std::to_string(k + 1) + " states " + quote(channel.units));
    const auto line = [](std::size_t index) { return "line " + std::to_string(index + 1); };
    channel.units_from = channel.units.empty() ? line(heading.units_line)
                                               : "label of column " + std::to_string(k + 1) + ", " + line(heading.line);
    if (channel.units.empty()) channel.units = unit;
    channel.dt = heading.size.dt;
    channel.step_from = roles.time ? "times in column " + std::to_string(*roles.time + 1) : line(heading.size_line);
    channels.push_back(std::move(channel));
  }
  if (heading.size.samples && as_count(*heading.size.samples, heading.size_line, "samples") != count)
    refuse_line(heading.size_line, "states " + detail::shortest(*heading.size.samples) + " samples, but " +
                                       std::to_string(count) + " rows follow");
  if (!roles.time) return channels;
  std::vector<double> times = std::move(values[*roles.time]), units = resolution.units();
  for (double& t : times) t *= roles.seconds;
  for (double& u : units) u *= roles.seconds;
  for (Channel& channel : channels) {
    channel.dt.reset();
    set_times(channel, times, units);
    if (heading.size.dt && channel.dt && std::abs(*heading.size.dt - *channel.dt) > 1e-3 * *channel.dt)
      refuse_line(heading.size_line, "states a time step of " + detail::shortest(*heading.size.dt) +
                                         " s, but the times have one of " + detail::shortest(*channel.dt) + " s");
  }
  return channels;
}

}  // namespace stickslip::records
