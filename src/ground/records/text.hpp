// The text of a record file: words, numbers, lines.
#pragma once

#include <cstddef>
#include <initializer_list>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace stickslip::records {

using Lines = std::vector<std::string_view>;

inline bool is_blank(char c) { return c == ' ' || c == '\t'; }

inline bool is_separator(char c) { return is_blank(c) || c == ',' || c == ';'; }

inline char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

bool same(std::string_view a, std::string_view b);

std::string_view trim(std::string_view text);

/// Bytes of the UTF-8 sequence at the front of `text`, or 0.
std::size_t sequence(std::string_view text);

/// External text as valid UTF-8 of at most `longest` bytes, with blanks for control characters.
std::string printable(std::string_view text, std::size_t longest);

/// A name in a file, with each run of blanks reduced to one.
std::string squeeze(std::string_view text);

/// The text without leading blanks and one leading comma or semicolon.
std::string_view after_separator(std::string_view text);

/// Position of `key` in `text`, ignoring case, or npos.
std::size_t find(std::string_view text, std::string_view key);

inline bool has(std::string_view text, std::string_view key) { return find(text, key) != std::string_view::npos; }

inline std::string_view before(std::string_view text, std::string_view key) { return text.substr(0, find(text, key)); }

std::string_view after(std::string_view text, std::string_view key);

/// The beginning of a text, for a message.
std::string quote(std::string_view text);

std::string joined(std::initializer_list<std::string> parts);

/// The first word of a text, without brackets and points at its end.
std::string first_word(std::string_view text);

/// What is wrong with a line of a file.
class BadLine : public std::invalid_argument {
 public:
  BadLine(std::size_t line, const std::string& message) : std::invalid_argument(message), index(line) {}

  std::size_t index;
};

[[noreturn]] void refuse_line(std::size_t index, const std::string& message);

inline bool is_digit(char c) { return c >= '0' && c <= '9'; }

inline bool is_sign(char c) { return c == '+' || c == '-'; }

/// The number at the front of a text, as C or Fortran prints it: +.5, 1.0D-03.
///
/// Fortran omits the letter of a large exponent: 1.234-100 is 1.234E-100, while 1.234-100.5 are two numbers.
struct Numeral {
  explicit Numeral(std::string_view text) {
    const auto is = [text](std::size_t at, auto... kinds) { return at < text.size() && (kinds(text[at]) || ...); };
    const auto digits = [&](std::size_t at) {
      while (is(at, is_digit)) ++at;
      return at;
    };
    const auto is_point = [](char c) { return c == '.'; };
    const auto is_letter = [](char c) { return lower(c) == 'e' || lower(c) == 'd'; };

    const std::size_t start = is(0, is_sign) ? 1 : 0, whole = digits(start);
    const bool point = is(whole, is_point);
    mantissa = point ? digits(whole + 1) : whole;
    if (mantissa == start + (point ? 1 : 0)) return;
    exponent = end = mantissa;

    const bool letter = is(mantissa, is_letter);
    const std::size_t first = mantissa + (letter ? 1 : 0), figures = first + (is(first, is_sign) ? 1 : 0);
    const std::size_t last = digits(figures);
    if (last == figures || !(letter || (point && figures > first && !is(last, is_point, is_letter)))) return;
    exponent = first;
    end = last;
  }

  std::size_t mantissa = 0;  ///< where it ends
  std::size_t exponent = 0;  ///< where its sign or first digit is; `mantissa` if there is neither it nor a letter
  std::size_t end = 0;       ///< 0 if the text starts with no number
};

/// Takes the finite number at the front of `text`.
std::optional<double> take_number(std::string_view& text);

/// Appends the numbers of a line. Returns the position of the first error, or nothing.
///
/// A sign may separate two numbers. With a `width`, whole numbers fill columns of that many characters, and need no
/// blanks between them. Numbers with points are read at their blanks, which may not keep to the columns, unless they run
/// together: then they have two points.
std::string_view append_numbers(std::vector<double>& values, std::string_view line, std::size_t width);

/// The number after a label, as in `DT= .01`, or nothing; `rest` becomes what follows it.
std::optional<double> labeled_number(std::string_view line, std::string_view label, std::string_view& rest);

/// Width of a column in a Fortran format such as `8F10.6`, or 0.
std::size_t fortran_width(std::string_view format);

/// Whether the last number of a line has a shorter exponent than the others, two or more, or none: the line was cut.
bool ends_cut_off(std::string_view line);

std::size_t as_count(double value, std::size_t line, std::string_view what);

/// Whether a unit is the second.
bool is_second(std::string_view unit);

/// The unit that a line states after the word "unit": `units of G.`, `units=cm/sec2(04)`, `Unit: m/s^2`.
std::string stated_units(std::string_view line);

}  // namespace stickslip::records
