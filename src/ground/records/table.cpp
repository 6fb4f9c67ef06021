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
#include "ground/records/checks.hpp"
#include "ground/records/formats.hpp"
#include "ground/records/labels.hpp"
#include "ground/records/times.hpp"
#include "ground/records/units.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "stickslip/base/error.hpp"
#include "stickslip/base/plausibility.hpp"
#include "stickslip/ground/orientation.hpp"

namespace stickslip::records {
namespace {

/// The length of the number at the front of a text that holds nothing but numbers, as columns of a fixed width that run
/// together: -9.2364-11.9725. Each but the last has a point, each but the first a sign. Otherwise 0.
std::size_t first_of_run(std::string_view text) {
  const std::size_t end = Numeral(text).end;
  const bool has_point = text.substr(0, end).find('.') != std::string_view::npos;
  return end == text.size() || (has_point && is_sign(text[end])) ? end : 0;
}

/// Whether a text begins as a number does, including NaN and infinity.
bool is_numeral(std::string_view token) {
  const std::string_view word = token.substr(!token.empty() && is_sign(token[0]) ? 1 : 0);
  return !token.empty() &&
         (first_of_run(token) > 0 || same(word.substr(0, 3), "nan") || same(word, "inf") || same(word, "infinity"));
}

/// Whether a line starts with a number.
bool is_row(std::string_view line) {
  line = trim(line);
  if (line.starts_with('"')) line.remove_prefix(1);
  return is_numeral(line.substr(0, line.find_first_of(" \t,;\"")));
}

/// Whether a line has a word that is no number: a title such as `1995 Kobe`.
bool has_word(std::string_view line) {
  std::vector<std::string_view> fields;
  split_row(line, fields);
  return std::ranges::any_of(fields, [](std::string_view field) {
    return !field.empty() && !is_numeral(field) && lower(field[0]) >= 'a' && lower(field[0]) <= 'z';
  });
}

/// Whether a line starts with a date: 2024-01-17T05:46, 17.01.2024.
bool is_dated(std::string_view line) {
  line = trim(line);
  std::string_view token = line.substr(0, line.find_first_of(" \tT,;"));
  const auto is_mark = [](char c) { return c == '-' || c == '/' || c == '.'; };
  return token.size() >= 8 && token.size() <= 10 && std::ranges::count_if(token, is_mark) == 2 &&
         std::ranges::count_if(token, is_digit) == static_cast<std::ptrdiff_t>(token.size()) - 2;
}

/// The first line of a table whose rows start with a text or an empty column: it follows labels, and ends with a number.
/// The number of lines if there is none.
std::size_t first_row_of_text(const Lines& lines) {
  std::vector<std::string_view> fields;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    split_row(lines[i], fields);
    if (fields.size() < 2 || !is_numeral(fields.back()) || is_comment(lines[i])) continue;
    const std::vector<Label> labels = labels_in(lines[i - 1], fields.size());
    if (std::ranges::any_of(labels, [](const Label& label) { return label.quantity == Quantity::acceleration; }))
      return i;
  }
  return lines.size();
}

/// The first line that starts with a number, but for titles above a heading that has other lines below them.
std::size_t first_row(const Lines& lines) {
  const auto find = [&](std::size_t from) {
    return static_cast<std::size_t>(
        std::find_if(lines.begin() + static_cast<std::ptrdiff_t>(from), lines.end(), is_row) - lines.begin());
  };
  std::size_t row = find(0);
  while (row < lines.size() && has_word(lines[row])) {
    const std::size_t next = find(row + 1);
    if (next == lines.size() || (next == row + 1 && !size_in(lines[row])))
      break;  // rows with words among their numbers are damaged
    row = next;
  }
  return row < lines.size() ? row : first_row_of_text(lines);
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

/// Rejects commas that may separate thousands: each is followed by three digits, numbers with one do not begin with zero,
/// and other numbers have none, nor points.
void refuse_thousands(const Lines& lines, std::size_t rows) {
  std::size_t example = lines.size();
  bool without = false;
  for (std::size_t i = rows; i < lines.size(); ++i) {
    if (is_comment(lines[i])) continue;
    std::string_view row = trim(lines[i]);
    for (std::size_t at = 0; at < row.size();) {
      const std::size_t end = std::min(row.find_first_of("; \t\"", at), row.size());
      std::string_view field = row.substr(at, end - at);
      at = end + 1;
      if (!field.empty() && is_sign(field[0])) field.remove_prefix(1);
      const std::size_t comma = field.find(',');
      if (comma == std::string_view::npos) {
        without = without || field.size() > 1;
      } else {
        if (field[0] == '0' || field.size() != comma + 4) return;
        example = i;
      }
    }
  }
  if (example < lines.size() && without)
    refuse_line(example, "commas may separate thousands or decimals in " + quote(lines[example]) +
                             ": write numbers without separators of thousands");
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

bool is_same_unit(std::string_view a, std::string_view b) {
  const auto one = find_acceleration_unit(a), other = find_acceleration_unit(b);
  return one && other ? one->value == other->value : same(a, b);
}

/// What stands above the rows.
struct Heading {
  std::vector<Label> labels{};       // one for each column, or none
  std::size_t line = 0;              // of the labels
  std::vector<std::string> units{};  // one for each column, or one of acceleration for all, or none
  std::string direction{};           // of the record
  std::size_t units_line = 0;
  Size size{};
  std::size_t size_line = 0;
  std::string title{};

  bool has_times() const {
    return std::ranges::any_of(labels, [](const Label& label) { return label.quantity == Quantity::time; });
  }
};

/// The direction in a line that states nothing else: `# Component: UP`, `Orientation = vertical`, `# VERTICAL COMPONENT`.
std::string direction_of(std::string_view line) {
  line = without_mark(line);
  for (const std::string_view key : {"component", "comp.", "comp", "channel", "direction", "orientation"}) {
    std::string_view rest;
    if (same(line.substr(0, key.size()), key))
      rest = trim(line.substr(key.size()));
    else if (line.size() > key.size() && same(line.substr(line.size() - key.size()), key))
      rest = trim(line.substr(0, line.size() - key.size()));
    if (rest.starts_with(':') || rest.starts_with('=')) rest = trim(rest.substr(1));
    if (rest.empty() || rest.find_first_of(" \t,;") != std::string_view::npos) continue;
    if (std::string found = orientation_in(rest); !found.empty()) return found;
  }
  return {};
}

Heading heading_of(const Lines& lines, std::size_t rows, std::size_t columns) {
  Heading heading;
  bool labels_possible = true;  // in the last line that states nothing else
  for (std::size_t i = rows; i-- > 0;) {
    const std::string_view line = trim(lines[i]);
    if (is_ruler(line)) continue;
    if (std::vector<std::string> units = units_in(line, columns); !units.empty()) {
      const bool as_many = heading.units.size() == units.size();
      if (!heading.units.empty() && !(as_many && std::ranges::equal(heading.units, units, is_same_unit)))
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
    if (const std::string direction = direction_of(line); !direction.empty()) {
      if (!heading.direction.empty() && heading.direction != direction)
        refuse_line(i, "states another direction than a line below it: " + quote(line));
      heading.direction = direction;
      continue;
    }
    if (heading.labels.empty()) {
      // In the last line that states nothing else; above other lines only if it labels times.
      heading.labels = labels_in(line, columns);
      if (!std::exchange(labels_possible, false) && !heading.has_times()) heading.labels.clear();
      heading.line = i;
      if (i > 0 && is_level(lines[i - 1], columns)) {
        while (i > 0 && is_level(lines[i - 1], columns)) --i;
        const auto level = [&](std::size_t at) { return lines.begin() + static_cast<std::ptrdiff_t>(at); };
        heading.labels = labels_of_levels({level(i), level(heading.line + 1)}, columns);
      }
      // What stands above one column is a label only if it speaks of an acceleration, or is no comment.
      if (columns == 1 && is_comment(line) && !heading.labels.empty() &&
          heading.labels[0].quantity != Quantity::acceleration)
        heading.labels.clear();
      if (!heading.labels.empty()) continue;
    }
    if (!line.starts_with('#')) continue;
    std::string text = squeeze(line.substr(1));
    if (has(text, ": ")) text = squeeze(after(text, ": "));
    while (!text.empty() && is_separator(text.back())) text.pop_back();
    if (std::string_view rest = text; take_number(rest) && rest.empty()) continue;  // a number is no name
    if (!text.empty()) heading.title = text;
  }
  // Labels that do not fit the columns must not be lost.
  for (std::size_t i = rows; i-- > 0 && heading.labels.empty() && columns > 1;) {
    const std::string_view line = trim(lines[i]);
    if (is_ruler(line) || is_comment(line)) continue;
    const std::vector<std::string_view> parts = split_at(line, ",;\t");
    const bool labels =
        parts.size() > 1 && label_of(parts[0]).quantity == Quantity::time && label_of(parts[1]).is_recognized();
    if (labels || (label_of(first_word(line)).quantity == Quantity::time && label_of(line).quantity == Quantity::other))
      refuse_line(i, "labels do not fit the " + std::to_string(columns) + " columns of numbers: " + quote(line));
    break;
  }
  return heading;
}

/// The columns that hold times and accelerations.
struct Columns {
  std::optional<std::size_t> time{};
  double seconds = 1;  // in the unit of time
  std::vector<std::size_t> other_times{};
  std::vector<std::size_t> acceleration{};
};

/// @param row  the fields of the first row
Columns columns_of(const Heading& heading, const std::vector<std::string_view>& row) {
  Columns columns;
  const std::size_t count = row.size();
  const bool by_column = heading.units.size() > 1 || (count == 1 && heading.units.size() == 1);
  // Where one column says that it is an acceleration, or states a unit of it, one that says nothing is none.
  const bool some =
      std::ranges::any_of(heading.labels, [](const Label& label) { return label.quantity == Quantity::acceleration; });
  std::string others;
  for (std::size_t k = 0; k < count; ++k) {
    Label label = heading.labels.empty() ? Label() : heading.labels[k];
    if (!heading.labels.empty() && !label.is_recognized() && !is_numeral(row[k])) continue;  // a column of text
    const std::string& unit = by_column ? heading.units[k] : std::string();
    if (const std::string other = quantity_with_unit(unit); !other.empty()) {
      label.quantity = Quantity::other;
      label.other = other;
      label.text = unit;
    }
    if (const std::optional<double> seconds = find_time_unit(unit)) {
      label.quantity = Quantity::time;
      label.seconds = *seconds;
    }
    if (label.quantity == Quantity::other && (label.other == "a period" || label.other == "a frequency"))
      refuse_line(heading.line, (k == 0 ? "the first column is " : "a column is ") + label.other + " (" +
                                    quote(label.text) + "): this is a spectrum, not an acceleration history");
    if (label.other == "a time in an unknown unit")
      refuse_line(heading.line, "the time must be in seconds or milliseconds, its label says " + quote(label.text));
    if (label.quantity == Quantity::time && !columns.time) {
      columns.time = k;
      columns.seconds = label.seconds;
    } else if (label.quantity == Quantity::time && label.text.size() > 1) {
      columns.other_times.push_back(k);
    } else if (label.quantity == Quantity::other) {
      others += (others.empty() ? "; " : ", ") + quote(label.text) + " is " + label.other;
    } else if (label.quantity != Quantity::index &&
               (!some || label.quantity == Quantity::acceleration || !label.direction.empty() || k == 0 ||
                label.quantity == Quantity::time)) {
      columns.acceleration.push_back(k);
    }
  }
  if (columns.acceleration.empty())
    refuse_line(heading.labels.empty() ? heading.units_line : heading.line, "no column holds an acceleration" + others);
  return columns;
}

/// What a first column without a label holds.
enum class First { times, row_numbers, acceleration };

/// Whether a number of seconds is a usual step of records.
bool is_usual_step(double seconds) { return plausible_range("time step of a record").holds(seconds); }

/// The digits behind the point of a number.
std::size_t decimals(std::string_view number) {
  const std::string_view mantissa = number.substr(0, Numeral(number).mantissa);
  return mantissa.size() - std::min(mantissa.find('.'), mantissa.size());
}

/// Whether numbers count 0, 1, 2 or 1, 2, 3.
bool counts_rows(const std::vector<double>& values) {
  bool counts = values.size() > 2 && (values[0] == 0 || values[0] == 1);
  for (std::size_t i = 1; i < values.size() && counts; ++i) counts = values[i] == values[0] + static_cast<double>(i);
  return counts;
}

First first_column(const std::vector<double>& values, const Resolution& printed) {
  if (counts_rows(values)) return First::row_numbers;
  Channel even;
  if (!std::is_sorted(values.begin(), values.end(), std::less_equal<>())) return First::acceleration;
  set_times(even, values, printed.units());
  const bool is_time = even.dt && is_usual_step(*even.dt) && std::abs(values[0]) <= 10 * *even.dt;
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
  channel.orientation = heading.direction;
  channel.units_from = "line " + std::to_string(heading.units_line + 1);
  std::optional<double> stated = heading.size.samples;
  std::size_t line = heading.size_line;
  // A first number that is the number of the others counts them; a time step may follow.
  const auto total = static_cast<double>(samples.size());
  if (first.empty() && samples.size() > 10 && (samples[0] == total - 1 || samples[0] == total - 2)) {
    const bool step = samples[0] == total - 2;
    if (!step || is_usual_step(samples[1])) {
      if (step && !channel.dt) channel.dt = samples[1];
      samples.erase(samples.begin(), samples.begin() + (step ? 2 : 1));
    }
  }
  if (!first.empty()) {  // a number of samples, and perhaps a time step
    line = row;
    std::string_view count = first[0];
    stated = take_number(count);
    if (first.size() > 1) {
      std::string_view step = first[1];
      const std::optional<double> dt = take_number(step);
      if (dt) checked_step(*dt, row);
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

/// The largest over the smallest mean square of the steps from each column to the next, and from the last to the first
/// one of the next row: about 1 for one record in reading order, not for a component beside a similar one.
double uneven_steps(const std::vector<std::vector<double>>& columns) {
  const std::size_t rows = columns.back().size() - 1;
  double least = std::numeric_limits<double>::infinity(), most = 0;
  for (std::size_t k = 0; k < columns.size() && rows >= 20; ++k) {
    double sum = 0;
    const bool last = k + 1 == columns.size();
    for (std::size_t i = 0; i < rows; ++i) {
      const double step = (last ? columns[0][i + 1] : columns[k + 1][i]) - columns[k][i];
      sum += step * step;
    }
    least = std::min(least, sum);
    most = std::max(most, sum);
  }
  return most > 0 ? most / least : 1;
}

}  // namespace

bool is_table(const Lines& lines) {
  // TSPAIR and SLIST of IRIS, which ObsPy reads, state their unit and step in this line.
  return first_row(lines) < lines.size() && !lines[0].starts_with("TIMESERIES ");
}

namespace {

/// @param run_together  whether numbers follow each other without a blank
std::vector<Channel> read_columns(const Lines& lines, bool run_together) {
  std::size_t rows = first_row(lines);
  for (std::size_t i = 0; i < rows; ++i)
    if (is_damaged_row(lines[i])) refuse_line(i, "expected finite numbers, got " + quote(lines[i]));
  const bool commas = has_decimal_commas(lines, rows);
  if (commas) refuse_thousands(lines, rows);

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
    if (!run_together) return;
    std::vector<std::string_view> parts;
    for (std::string_view field : fields) {
      for (std::size_t end = first_of_run(field); end > 0 && end < field.size(); end = first_of_run(field)) {
        parts.push_back(field.substr(0, end));
        field.remove_prefix(end);
      }
      parts.push_back(field);
    }
    fields = std::move(parts);
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
    // `200 0.01` above numbers in other lines, or above times from zero.
    std::string_view clock = second < lines.size() ? fields[0] : std::string_view();
    const std::optional<double> begin = take_number(clock);
    const bool alone = first.size() == 2 && second < lines.size() &&
                       (fields.size() != 2 || (begin && std::abs(*begin) < 1 && !is_whole(first[1])));
    bool pointed = first.size() == 1 && second < lines.size();
    for (std::size_t i = second, seen = 0; pointed && i < lines.size() && seen < 100; i = next(i + 1), ++seen)
      pointed = !std::ranges::any_of(fields, is_whole);
    if (alone || pointed) {
      counts = first;
      rows = second;
    }
    take(rows);
  }
  // A time step alone above lines of several numbers, or above as many decimals in every line of one.
  std::optional<double> dt;
  if (counts.empty() && fields.size() == 1 && top == rows) {
    const std::string first(fields[0]);
    std::string_view rest = first;
    const std::optional<double> value = take_number(rest);
    const std::size_t second = next(rows + 1);
    if (value && rest.empty() && is_usual_step(*value) && second < lines.size()) {
      if (fields.size() > 2) {
        dt = value;
        rows = second;
      } else if (fields.size() == 1) {
        const std::size_t places = decimals(fields[0]);
        bool even = places > decimals(first);
        for (std::size_t i = second, seen = 0; even && i < lines.size() && seen < 100; i = next(i + 1), ++seen)
          even = decimals(fields[0]) == places;
        take(second);
        if (even || (is_whole(fields[0]) && fields[0].size() > 1))
          refuse_line(rows, quote(first) + " may be a time step or a sample: write 'dt = " + first +
                                "', or a sample with as many decimals as the others");
      }
    }
    take(rows);
  }
  const std::size_t columns = fields.size();
  Heading heading = heading_of(lines, top, columns);
  if (dt && !heading.size.dt) {
    heading.size.dt = dt;
    heading.size_line = top;
  }
  // A title of as many words as there are columns is no line of labels: the first column plainly holds times.
  if (columns > 1 && !heading.labels.empty() && heading.labels[0].is_unclear() && !heading.has_times()) {
    std::vector<double> begin;
    Resolution printed;
    for (std::size_t i = next(rows); i < lines.size() && begin.size() < 20; i = next(i + 1)) {
      std::string_view rest = fields[0];
      begin.push_back(take_number(rest).value_or(-1));
      printed.add(fields[0]);
    }
    if (first_column(begin, printed) == First::times) heading.labels.clear();
  }
  take(rows);
  Columns roles = columns_of(heading, fields);

  const auto hint = [&] {
    return columns > 2 ? std::string("; record_formats lists what agencies write") : std::string();
  };
  // Texts that change tell records apart where no times do.
  std::vector<std::pair<std::size_t, std::string>> texts;
  for (std::size_t k = 0; k < columns && !heading.labels.empty() && !roles.time; ++k)
    if (!is_numeral(fields[k]) && !heading.labels[k].is_recognized()) texts.emplace_back(k, fields[k]);
  std::vector<bool> used(columns, heading.labels.empty());
  for (const std::size_t k : roles.acceleration) used[k] = true;
  for (const std::size_t k : roles.other_times) used[k] = true;
  if (roles.time) used[*roles.time] = true;
  const std::size_t clock = roles.time.value_or(0);
  std::vector<std::vector<double>> values(columns);
  Resolution resolution;
  std::size_t count = 0, hole = 0;  // an empty line between numbers
  for (std::size_t i = next(rows), after; i < lines.size(); i = after, ++count) {
    const bool is_short = fields.size() < columns;
    for (std::size_t k = 0; k < std::min(columns, fields.size()); ++k) {
      if (!used[k]) continue;
      std::string_view rest = fields[k];
      const std::optional<double> value = take_number(rest);
      if (!value || !rest.empty()) {
        if (first_of_run(fields[k]) > 0 && !run_together) return read_columns(lines, true);
        const bool dated = roles.time == k && is_dated(fields[k]);
        refuse_line(i, (dated ? "times must be seconds, got the date " : "expected finite numbers, got ") +
                           quote(fields[k].empty() ? lines[i] : fields[k]));
      }
      values[k].push_back(*value);
    }
    for (const auto& [k, text] : texts)
      if (k < fields.size() && fields[k] != text)
        refuse_line(i, "column " + std::to_string(k + 1) + " changes from " + quote(text) + " to " + quote(fields[k]) +
                           ", and no column holds times: one file for each record is needed");
    if (clock < fields.size() && columns > 1) resolution.add(fields[clock]);
    const std::size_t got = fields.size();
    after = next(i + 1);
    for (std::size_t line = i + 1; line < after && after < lines.size() && hole == 0; ++line)
      if (!is_comment(lines[line])) hole = line;
    if (got > columns || (is_short && (after < lines.size() || !heading.labels.empty() || count < 2)))
      refuse_line(i, "expected " + std::to_string(columns) + (columns == 1 ? " column" : " columns") + " as in line " +
                         std::to_string(rows + 1) + ", got " + std::to_string(got) + " in " + quote(lines[i]) + hint());
    if (is_short) break;  // the last line of numbers in reading order
  }

  const bool ragged = values.back().size() < values.front().size();
  const First first = columns > 1 && !roles.time && !ragged && !values[0].empty() ? first_column(values[0], resolution)
                                                                                  : First::acceleration;
  if (hole > 0 && !roles.time && first != First::times && (columns == 1 || !heading.labels.empty()))
    refuse_line(hole, "an empty line between numbers: a sample may be missing");
  if (heading.labels.empty() && !roles.time) {
    if (first == First::acceleration) {
      // Two rows at least say whether columns are components.
      for (std::size_t k = 1; k < columns && !ragged && values[0].size() > 2; ++k)
        if (values[k] == values[k - 1])
          refuse_line(rows, "columns " + std::to_string(k) + " and " + std::to_string(k + 1) +
                                " are equal and have no labels: keep one of them");
      if (columns > 1 && values[0].size() > 2 && (variation_ratio(values) > 0.8 || uneven_steps(values) > 3))
        refuse_line(rows,
                    "the first of " + std::to_string(columns) +
                        " columns is not time (even, from about zero, in steps of 0.0005 to 0.1 s), and the numbers"
                        " are not one record in reading order: label the columns, as in 'Time (s), N (g), E (g)'" +
                        hint());
      return in_reading_order(values, counts, heading, top);
    }
    if (first == First::times) roles.time = 0;
    roles.acceleration.erase(roles.acceleration.begin());
  } else if (const Label label = heading.labels.empty() ? Label() : heading.labels[0];
             roles.acceleration.size() > 1 && roles.acceleration[0] == 0 && label.quantity == Quantity::unknown &&
             label.unit.empty() && counts_rows(values[0])) {
    roles.acceleration.erase(roles.acceleration.begin());
  }
  if (count < 2) refuse_line(rows, "at least two rows of numbers are needed, got 1" + hint());
  const auto is_negative = [](double value) { return value < 0; };
  const auto has_signs = [&](std::size_t k) { return std::ranges::any_of(values[k], is_negative); };
  if (roles.time && !heading.labels.empty() && heading.labels[*roles.time].name == "T" &&
      !std::ranges::any_of(roles.acceleration, has_signs))
    refuse_line(heading.line,
                "T may be a period, and no acceleration is negative: if this is an acceleration history"
                " and no spectrum, label its times t or time");
  std::vector<Channel> channels;
  for (const std::size_t k : roles.acceleration) {
    Channel channel{.title = heading.title, .acceleration = std::move(values[k])};
    if (!heading.labels.empty()) {
      const Label& label = heading.labels[k];
      channel.label = label.text;
      channel.orientation = label.direction;
      channel.units = label.unit;
      // The numbers with which pandas labels columns are no azimuths.
      if (roles.acceleration.size() > 1 && !(is_whole(label.name) && label.name.size() < 3)) channel.name = label.name;
      if (!channel.name.empty()) channel.title = joined({heading.title, channel.name});
      if (heading.title.empty()) channel.title.clear();
    }
    if (channel.orientation.empty() && roles.acceleration.size() == 1) channel.orientation = heading.direction;
    const std::string unit = heading.units.empty()       ? std::string()
                             : heading.units.size() == 1 ? heading.units[0]
                                                         : heading.units[k];
    if (!unit.empty() && !channel.units.empty() && !is_same_unit(unit, channel.units))
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
  if (!counts.empty()) {
    std::string_view text = counts[0];
    if (const double stated = take_number(text).value_or(0); as_count(stated, top, "samples") != count)
      refuse_line(top, "states " + counts[0] + " samples, but " + std::to_string(count) + " rows follow");
  }
  if (!roles.time) return channels;
  for (const std::size_t k : roles.other_times)
    if (values[k] != values[*roles.time])
      refuse_line(heading.line, "columns " + std::to_string(*roles.time + 1) + " and " + std::to_string(k + 1) +
                                    " are times that differ: one file for each record is needed");
  const std::vector<double>& clocked = values[*roles.time];
  if (const auto late = std::adjacent_find(clocked.begin(), clocked.end(), std::greater_equal<>());
      late != clocked.end()) {
    std::size_t line = next(rows);
    for (auto at = clocked.begin(); at <= late; ++at) line = next(line + 1);
    refuse_line(line, "times must increase, got " + quote(fields[*roles.time]) + " after " + detail::shortest(*late));
  }
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

}  // namespace

std::vector<Channel> read_table(const Lines& lines) { return read_columns(lines, false); }

}  // namespace stickslip::records
