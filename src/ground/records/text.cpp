#include "ground/records/text.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <stdexcept>

#include "base/read_number.hpp"
#include "stickslip/base/error.hpp"

namespace stickslip::records {
namespace {

/// Whether a sequence is a character: no overlong form, no surrogate, nothing above U+10FFFF.
bool is_character(std::string_view sequence) {
  const auto bytes = [sequence](std::size_t count) {
    unsigned value = 0;
    for (const char c : sequence.substr(0, count)) value = value << 8 | static_cast<unsigned char>(c);
    return value;
  };
  switch (sequence.size()) {
    case 1:
      return true;
    case 2:
      return bytes(1) >= 0xC2;
    case 3:
      return bytes(2) >= 0xE0A0 && bytes(2) / 0x20 != 0xEDA0 / 0x20;
    case 4:
      return bytes(2) >= 0xF090 && bytes(2) < 0xF490;
    default:
      return false;
  }
}

}  // namespace

bool same(std::string_view a, std::string_view b) {
  return std::ranges::equal(a, b, [](char x, char y) { return lower(x) == lower(y); });
}

std::string_view trim(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

std::size_t sequence(std::string_view text) {
  const auto lead = static_cast<unsigned char>(text[0]);
  const std::size_t length = lead < 0x80   ? 1
                             : lead < 0xC0 ? 0
                             : lead < 0xE0 ? 2
                             : lead < 0xF0 ? 3
                             : lead < 0xF8 ? 4
                                           : 0;
  const auto continues = [](char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; };
  return length > 0 && length <= text.size() && std::ranges::all_of(text.substr(1, length - 1), continues) ? length : 0;
}

std::string printable(std::string_view text, std::size_t longest) {
  std::string result;
  while (!text.empty()) {
    const std::size_t length = sequence(text);
    std::string_view shown = text.substr(0, length);
    if (!is_character(shown)) shown = "\xEF\xBF\xBD";  // U+FFFD, the replacement character
    if ((shown >= "\0" && shown < " ") || shown == "\x7F" || (shown >= "\xC2\x80" && shown < "\xC2\xA0")) shown = " ";
    if (result.size() + shown.size() > longest) return result + "...";
    result += shown;
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return result;
}

std::string squeeze(std::string_view text) {
  constexpr std::size_t longest = 256;  // each channel of a file repeats the names of event and station
  std::string result;
  for (const char c : printable(trim(text), longest))
    if (c != ' ' || !(result.empty() || result.back() == ' ')) result += c;
  if (result.ends_with(' ')) result.pop_back();
  return result;
}

std::string_view after_separator(std::string_view text) {
  text = trim(text);
  if (text.starts_with(',') || text.starts_with(';')) text = trim(text.substr(1));
  return text;
}

std::size_t find(std::string_view text, std::string_view key) {
  const auto alike = [](char a, char b) { return lower(a) == lower(b); };
  const auto found = std::search(text.begin(), text.end(), key.begin(), key.end(), alike);
  return found == text.end() && !key.empty() ? std::string_view::npos : static_cast<std::size_t>(found - text.begin());
}

std::string_view after(std::string_view text, std::string_view key) {
  const std::size_t at = find(text, key);
  return at == std::string_view::npos ? std::string_view() : text.substr(at + key.size());
}

std::string quote(std::string_view text) { return printable(trim(text), 48).insert(0, 1, '\'') += '\''; }

std::string joined(std::initializer_list<std::string> parts) {
  std::string result;
  for (const std::string& part : parts)
    if (!part.empty()) result += (result.empty() ? "" : ", ") + part;
  return result;
}

std::string first_word(std::string_view text) {
  text = trim(text);
  text = text.substr(0, text.find_first_of(" \t,;()"));
  while (text.ends_with('.')) text.remove_suffix(1);
  return std::string(text);
}

void refuse_line(std::size_t index, const std::string& message) { throw BadLine(index, message); }

std::optional<double> take_number(std::string_view& text) {
  if (const std::optional<double> number = detail::take_short_number(text)) return number;
  const Numeral numeral(text);
  std::string_view token = text.substr(0, numeral.end);
  std::string standard;
  if (numeral.end > numeral.mantissa && lower(token[numeral.mantissa]) != 'e') {
    standard.append(token.substr(0, numeral.mantissa)).append("e").append(token.substr(numeral.exponent));
    token = standard;
  }
  if (token.starts_with('+')) token.remove_prefix(1);
  const std::optional<double> value = detail::read_number(token);
  if (value) text.remove_prefix(numeral.end);
  return value;
}

namespace {

/// Appends the numbers in columns of a line, or nothing if not every column holds blanks or one number, with a point
/// unless all are whole.
bool append_columns(std::vector<double>& values, std::string_view line, std::size_t width, bool whole) {
  const std::size_t count = values.size();
  for (std::size_t column = 0; column < line.size(); column += width) {
    std::string_view field = trim(line.substr(column, width));
    if (field.empty()) continue;
    const bool pointed = field.find('.') != std::string_view::npos;
    const std::optional<double> value = take_number(field);
    if (!value || !field.empty() || pointed == whole) {
      values.resize(count);
      return false;
    }
    values.push_back(*value);
  }
  return true;
}

/// Appends numbers that run together, which have as many decimal places as the last of the line; or nothing.
bool append_places(std::vector<double>& values, std::string_view line) {
  const std::size_t count = values.size();
  line = trim(line);
  const std::size_t places = line.size() - 1 - line.rfind('.');
  while (!line.empty()) {
    const std::size_t point = line.find('.'), end = point == std::string_view::npos ? point : point + 1 + places;
    std::string_view number = line.substr(0, end);
    const std::optional<double> value = end <= line.size() ? take_number(number) : std::nullopt;
    if (!value || !number.empty()) {
      values.resize(count);
      return false;
    }
    values.push_back(*value);
    line = trim(line.substr(end));
  }
  return true;
}

}  // namespace

std::string_view append_numbers(std::vector<double>& values, std::string_view line, std::size_t width) {
  const bool whole = width > 0 && line.find('.') == std::string_view::npos;
  if (whole && append_columns(values, line, width, true)) return {};
  const std::size_t count = values.size();
  for (std::string_view rest = trim(line); !rest.empty(); rest = trim(rest)) {
    const std::string_view here = rest;
    const std::optional<double> value = take_number(rest);
    if (!value || !(rest.empty() || is_blank(rest[0]) || is_sign(rest[0]))) {
      if (width == 0 || whole) return here;
      const std::vector<double> before(values.begin() + static_cast<std::ptrdiff_t>(count), values.end());
      values.resize(count);
      if (append_columns(values, line, width, false) || append_places(values, line)) return {};
      values.insert(values.end(), before.begin(), before.end());
      return here;
    }
    values.push_back(*value);
  }
  return {};
}

std::optional<double> labeled_number(std::string_view line, std::string_view label, std::string_view& rest) {
  const auto in_word = [](char c) { return is_digit(c) || (lower(c) >= 'a' && lower(c) <= 'z'); };
  std::size_t at = 0;
  for (std::size_t skip; (skip = find(line.substr(at), label)) != std::string_view::npos;) {
    at += skip;
    const bool starts = at == 0 || !in_word(line[at - 1]);
    at += label.size();
    if (!starts || (at < line.size() && in_word(line[at]))) continue;
    rest = trim(line.substr(at));
    if (rest.starts_with('=') || rest.starts_with(':')) rest = trim(rest.substr(1));
    const std::optional<double> value = take_number(rest);
    return rest.starts_with('.') || (!rest.empty() && is_sign(rest[0])) ? std::nullopt : value;
  }
  return std::nullopt;
}

std::size_t fortran_width(std::string_view format) {
  std::string_view rest = trim(format);
  while (!rest.empty() && is_digit(rest[0])) rest.remove_prefix(1);
  std::size_t width = 0;
  if (!rest.empty() && std::string_view("feig").find(lower(rest[0])) != std::string_view::npos)
    std::from_chars(rest.data() + 1, rest.data() + rest.size(), width);
  return width;
}

bool ends_cut_off(std::string_view line) {
  const auto is_letter = [](char c) { return lower(c) == 'e' || lower(c) == 'd'; };
  // From the right: the last number, then how far the exponents of the two before it reach behind their letters.
  line = trim(line);
  const auto length_of_last = [&] {
    const std::string_view word = line.substr(line.find_last_of(" \t") + 1);
    line = trim(line.substr(0, line.size() - word.size()));
    const auto letter = std::find_if(word.rbegin(), word.rend(), is_letter);
    return letter == word.rend() ? std::size_t{0} : static_cast<std::size_t>(letter - word.rbegin()) + 1;
  };
  const std::size_t last = length_of_last(), before = length_of_last();
  return before > last && length_of_last() == before;
}

std::size_t as_count(double value, std::size_t line, std::string_view what) {
  if (!(value >= 0 && value < 1e15 && value == std::floor(value)))
    refuse_line(line, "the number of " + std::string(what) + " must be a whole number, got " + detail::shortest(value));
  return static_cast<std::size_t>(value);
}

std::string stated_units(std::string_view line) {
  std::string_view rest = after(line, "unit");
  if (!rest.empty() && lower(rest[0]) == 's') rest.remove_prefix(1);
  const std::size_t start = rest.find_first_not_of(" \t:=");
  if (start == 0 || start == std::string_view::npos) return {};  // another word, such as United
  rest.remove_prefix(start);
  if (same(rest.substr(0, 3), "of ")) rest = trim(rest.substr(3));
  rest = rest.substr(0, rest.find_first_of(" \t,;("));
  while (rest.ends_with('.')) rest.remove_suffix(1);
  return std::string(rest);
}

bool is_second(std::string_view unit) {
  constexpr std::string_view names[] = {"s", "sec", "secs", "second", "seconds"};
  return std::ranges::any_of(names, [unit](std::string_view name) { return same(unit, name); });
}

}  // namespace stickslip::records
