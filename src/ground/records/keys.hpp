// Headers of lines `key : value`.
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

#include "ground/records/text.hpp"

namespace stickslip::records {

/// The text of a line without the mark of a comment.
inline std::string_view uncommented(std::string_view line) {
  line = trim(line);
  while (line.starts_with('#')) line = trim(line.substr(1));
  return line;
}

/// Number of the lines at the top of a file that are blank or begin with #.
inline std::size_t comment_lines(const Lines& lines) {
  const auto is_row = [](std::string_view line) { return !trim(line).empty() && !trim(line).starts_with('#'); };
  return static_cast<std::size_t>(std::find_if(lines.begin(), lines.end(), is_row) - lines.begin());
}

/// The lines `key : value` at the top of a file, also behind the mark of a comment.
///
/// A key may stand before a unit or a remark: `Data` is the key of `Data: 1`, `#Data (gal): 1` and `DATA, C1 : 1`, not
/// of `Dataset: 1`.
class Keys {
 public:
  /// @param end  number of lines of the header, or the most that it may have
  Keys(const Lines& lines, std::size_t end)
      : lines_(lines.begin(), lines.begin() + static_cast<std::ptrdiff_t>(std::min(end, lines.size()))) {}

  bool has(std::string_view key) const { return find(key) < lines_.size(); }

  /// Index of the first line with a key.
  std::size_t line(std::string_view key) const {
    const std::size_t found = find(key);
    if (found == lines_.size()) throw std::invalid_argument("the header has no " + quote(key));
    return found;
  }

  /// Empty where the header has no such key.
  std::string_view value(std::string_view key) const {
    const std::size_t found = find(key);
    return found == lines_.size() ? std::string_view() : trim(after(lines_[found], ":"));
  }

  std::string text(std::string_view key) const { return squeeze(value(key)); }

  double number(std::string_view key) const {
    const std::size_t found = line(key);
    std::string_view rest = value(key);
    const std::optional<double> number = take_number(rest);
    if (!number || !trim(rest).empty())
      refuse_line(found, "expected a number after " + quote(key) + ", got " + quote(lines_[found]));
    return *number;
  }

  std::size_t samples(std::string_view key) const { return as_count(number(key), line(key), "samples"); }

 private:
  std::size_t find(std::string_view key) const {
    const auto in_word = [](char c) { return is_digit(c) || c == '_' || (lower(c) >= 'a' && lower(c) <= 'z'); };
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      std::string_view label = uncommented(lines_[i]);
      const std::size_t colon = label.find(':');
      if (colon == std::string_view::npos) continue;
      label = trim(label.substr(0, colon));
      if (same(label.substr(0, key.size()), key) && (label.size() == key.size() || !in_word(label[key.size()])))
        return i;
    }
    return lines_.size();
  }

  Lines lines_;
};

}  // namespace stickslip::records
