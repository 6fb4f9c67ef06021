// Columns of numbers: acceleration alone, or seconds and accelerations.
#include "ground/records/formats.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace stickslip::records {
namespace {

/// Whether a line starts with a number, including NaN and infinity.
bool is_row(std::string_view line) {
  line = trim(line);
  const std::string_view token = line.substr(0, line.find_first_of(" \t,;"));
  const std::string_view word = token.substr(!token.empty() && is_sign(token[0]) ? 1 : 0);
  return !token.empty() && (Numeral(token).end == token.size() || same(word.substr(0, 3), "nan") || same(word, "inf") ||
                            same(word, "infinity"));
}

std::size_t first_row(const Lines& lines) {
  return static_cast<std::size_t>(std::ranges::find_if(lines, is_row) - lines.begin());
}

/// The texts in round or square brackets.
std::vector<std::string_view> bracketed(std::string_view line) {
  std::vector<std::string_view> texts;
  for (std::size_t open = line.find_first_of("(["); open != std::string_view::npos;
       open = line.find_first_of("([", open + 1)) {
    const std::size_t close = line.find(line[open] == '(' ? ')' : ']', open);
    if (close == std::string_view::npos) break;
    texts.push_back(trim(line.substr(open + 1, close - open - 1)));
    open = close;
  }
  return texts;
}

/// The labels in a line, one per column, or none.
std::vector<std::string_view> split_labels(std::string_view line, std::size_t columns) {
  line = trim(line);
  while (line.starts_with('#')) line = trim(line.substr(1));
  for (const char* separators : {",;\t", " \t"}) {
    std::vector<std::string_view> labels;
    for (std::string_view rest = line; labels.size() <= columns;) {
      const std::size_t end = std::min(rest.find_first_of(separators), rest.size());
      labels.push_back(trim(rest.substr(0, end)));
      if (end == rest.size()) break;
      rest = *separators == ' ' ? trim(rest.substr(end)) : rest.substr(end + 1);
    }
    if (labels.size() == columns) return labels;
  }
  return {};
}

/// Reads units, names and title from the lines before the rows: units and names from the lowest line that has them, the
/// title from the topmost comment.
/// @param channels  one a column of acceleration
void read_table_header(const Lines& lines, std::size_t rows, std::size_t columns, std::vector<Channel>& channels) {
  bool units_found = false, names_found = columns < 3;
  std::string title;
  for (std::size_t i = rows; i-- > 0;) {
    const std::string_view line = trim(lines[i]);
    if (!names_found && !line.empty()) {
      const std::vector<std::string_view> labels = split_labels(line, columns);
      names_found = !labels.empty();
      for (std::size_t k = 1; k < labels.size(); ++k)
        channels[k - 1].name = squeeze(labels[k].substr(0, labels[k].find_first_of("([")));
    }
    if (!units_found) {
      std::vector<std::string_view> labels = bracketed(line);
      if (columns > 1 && labels.size() > 1 && !is_second(labels[0]))
        refuse_line(i, "the first column must be time in seconds, its label says " + quote(labels[0]));
      if (columns == 1 && labels.size() > 1) labels = {labels.back()};
      std::string units;
      if (labels.size() > 1)
        units = labels[1];
      else if (labels.size() == 1 && has(line, "acc") && !is_second(labels[0]))
        units = labels[0];
      else
        units = stated_units(line);
      for (std::size_t k = 0; k < channels.size(); ++k)
        channels[k].units = labels.size() == columns && columns > 2 ? std::string(labels[k + 1]) : units;
      units_found = !units.empty();
      if (units_found) continue;
    }
    if (!line.starts_with('#')) continue;
    std::string text = squeeze(line.substr(1));
    if (has(text, ": ")) text = squeeze(after(text, ": "));
    while (!text.empty() && is_separator(text.back())) text.pop_back();
    if (!text.empty()) title = text;
  }
  for (Channel& channel : channels)
    channel.title = title.empty() || channel.name.empty() ? title : joined({title, channel.name});
}

/// The precision of printed times: a number of decimal places, as with %.2f, or of significant digits, as with %.3e
/// and %g.
///
/// Trailing zeros may be left out: the maximum number of places and of digits counts.
class Resolution {
 public:
  void add(std::string_view token) {
    const Numeral numeral(token);
    const std::string_view mantissa = token.substr(0, numeral.mantissa);
    std::string_view power = token.substr(numeral.exponent);
    if (power.starts_with('+')) power.remove_prefix(1);
    int exponent = 0;
    std::from_chars(power.data(), power.data() + power.size(), exponent);

    const auto position = [](std::size_t at) { return static_cast<int>(at); };
    const std::size_t point = std::min(mantissa.find('.'), mantissa.size());
    const int places = position(mantissa.size() - std::min(point + 1, mantissa.size()));
    max_places_ = std::max(max_places_, places - exponent);
    const std::size_t first = mantissa.find_first_of("123456789");
    if (first == std::string_view::npos) return decades_.push_back(std::numeric_limits<int>::min() / 2);
    const int before = position(point) - position(first);  // digits before the point; negative: zeros after it
    decades_.push_back((before > 0 ? before - 1 : before) + exponent);
    max_digits_ = std::max(max_digits_, (before > 0 ? before : before + 1) + places);
  }

  /// One unit of the last place of each time [s].
  std::vector<double> units() const {
    std::vector<double> units;
    units.reserve(decades_.size());
    for (int previous = 0; const int decade : decades_) {
      const int exponent = std::max(-max_places_, decade + 1 - max_digits_);
      units.push_back(!units.empty() && exponent == previous ? units.back() : std::pow(10., exponent));
      previous = exponent;
    }
    return units;
  }

 private:
  int max_places_ = std::numeric_limits<int>::min() / 2;
  int max_digits_ = 0;
  std::vector<int> decades_{};  // of the first digit of each time
};

/// The smallest step for which even times can lie within their bounds.
///
/// It is the steepest line from an upper bound to a later lower bound. A line that is not steep enough is replaced by
/// the one that exceeds it most, until none does.
double smallest_step(const std::vector<double>& lower, const std::vector<double>& upper) {
  const std::size_t last = lower.size() - 1;
  for (double step = (lower[last] - upper[0]) / static_cast<double>(last);;) {
    double steeper = step, most = 0, lowest = upper[0];
    for (std::size_t i = 1, from = 0; i <= last; ++i) {
      const double line = static_cast<double>(i) * step;
      if (const double excess = lower[i] - line - lowest; excess > most) {
        most = excess;
        steeper = (lower[i] - upper[from]) / static_cast<double>(i - from);
      }
      if (const double top = upper[i] - line; top < lowest) {
        lowest = top;
        from = i;
      }
    }
    if (!(steeper > step)) return step;
    step = steeper;
  }
}

/// The step of times that are even within their printed precision: the shortest decimal that fits them all.
std::optional<double> even_step(const std::vector<double>& times, const std::vector<double>& units) {
  const std::size_t count = times.size();
  const double length = times.back() - times.front(), mean = length / static_cast<double>(count - 1);
  const double coarsest = *std::ranges::max_element(units);
  const double farthest = std::max(std::abs(times.front()), std::abs(times.back()));
  const double sums =
      2 * static_cast<double>(count) * std::numeric_limits<double>::epsilon() * farthest;  // if accumulated
  if (!std::isfinite(length)) return std::nullopt;
  // Rounding explains uneven steps only where it is too small to hide a missing sample, and only in records that are
  // long against it. The margin exceeds the rounding of a print by a tenth, for times computed in single precision.
  for (const double rounding : {0., 0.55}) {
    if (rounding > 0 && (mean < 2 * coarsest || length < 100 * coarsest)) break;
    std::vector<double> lower(count), upper(count), minus_lower(count), minus_upper(count);
    for (std::size_t i = 0; i < count; ++i) {
      const double margin = rounding * units[i] + sums;
      minus_lower[i] = -(lower[i] = times[i] - times[0] - margin);
      minus_upper[i] = -(upper[i] = times[i] - times[0] + margin);
    }
    const double smallest = smallest_step(lower, upper), largest = -smallest_step(minus_upper, minus_lower);
    if (!(smallest <= largest)) continue;
    const double middle = smallest / 2 + largest / 2;
    for (double power = 1; std::abs(middle) * power < 1e15; power *= 10)
      if (const double dt = std::round(middle * power) / power; smallest <= dt && dt <= largest)
        return dt + 0.;  // no -0
    return middle;
  }
  return std::nullopt;
}

/// The fields of a row. Blanks around a single comma or semicolon belong to the separator.
void split_row(std::string_view row, std::vector<std::string_view>& fields) {
  fields.clear();
  row = trim(row);
  for (std::size_t begin = 0, at = 0;; ++at) {
    if (at < row.size() && !is_separator(row[at])) continue;
    fields.push_back(row.substr(begin, at - begin));
    if (at == row.size()) return;
    bool mark = !is_blank(row[at]);
    while (at + 1 < row.size() && (is_blank(row[at + 1]) || (!mark && is_separator(row[at + 1])))) {
      ++at;
      mark = mark || !is_blank(row[at]);
    }
    begin = at + 1;
  }
}

/// Whether commas are decimal points: columns are parted by something else, each comma is between digits, and no point
/// is in any row.
bool has_decimal_commas(const Lines& lines, std::size_t rows) {
  bool found = false;
  for (std::size_t i = rows; i < lines.size(); ++i) {
    const std::string_view row = trim(lines[i]);
    if (row.find('.') != std::string_view::npos) return false;
    for (std::size_t at = row.find(','); at != std::string_view::npos; at = row.find(',', at + 1)) {
      if (at == 0 || at + 1 == row.size() || !is_digit(row[at - 1]) || !is_digit(row[at + 1])) return false;
      if (row.find_first_of("; \t") == std::string_view::npos) return false;
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

}  // namespace

bool is_table(const Lines& lines) { return first_row(lines) < lines.size(); }

bool is_column(const Lines& lines) {
  const std::size_t row = first_row(lines);
  return row < lines.size() && trim(lines[row]).find_first_of(" \t,;") == std::string_view::npos;
}

std::vector<Channel> read_table(const Lines& lines) {
  const std::size_t rows = first_row(lines);
  for (std::size_t i = 0; i < rows; ++i)
    if (is_damaged_row(lines[i])) refuse_line(i, "expected finite numbers, got " + quote(lines[i]));
  const bool commas = has_decimal_commas(lines, rows);

  std::vector<std::string_view> fields;
  std::string with_points;
  const auto split = [&](std::string_view row) {
    if (commas) {
      with_points = row;
      std::ranges::replace(with_points, ',', '.');
      row = with_points;
    }
    split_row(row, fields);
  };
  split(lines[rows]);
  const std::size_t columns = fields.size(), timed = columns > 1 ? 1 : 0;
  std::vector<Channel> channels(columns - timed);
  read_table_header(lines, rows, columns, channels);

  const auto hint = [&] { return columns > 2 ? "; known formats are: " + known_formats() : std::string(); };
  Resolution resolution;
  std::vector<double> times;
  for (std::size_t i = rows; i < lines.size(); ++i) {
    if (trim(lines[i]).empty()) continue;
    split(lines[i]);
    if (fields.size() != columns)
      refuse_line(i, "expected " + std::to_string(columns) + (columns == 1 ? " column" : " columns") + " as in line " +
                         std::to_string(rows + 1) + ", got " + std::to_string(fields.size()) + " in " +
                         quote(lines[i]) + hint());
    for (std::size_t k = 0; k < columns; ++k) {
      std::string_view rest = fields[k];
      const std::optional<double> value = take_number(rest);
      if (!value || !rest.empty())
        refuse_line(i, "expected finite numbers, got " + quote(fields[k].empty() ? lines[i] : fields[k]));
      (k < timed ? times : channels[k - timed].acceleration).push_back(*value);
    }
    if (timed == 1) resolution.add(fields[0]);
    if (columns > 2 && times.size() > 1 && !(times.back() > times[times.size() - 2]))
      refuse_line(i, "the first column must be time, which increases, got " + quote(fields[0]) + hint());
  }
  if (channels[0].acceleration.size() < 2) refuse_line(rows, "at least two rows of numbers are needed, got 1" + hint());
  if (timed == 0) return channels;
  const std::optional<double> dt = even_step(times, resolution.units());
  for (Channel& channel : channels) {
    if (dt)
      channel.dt = *dt;
    else
      channel.times = times;
  }
  return channels;
}

}  // namespace stickslip::records
