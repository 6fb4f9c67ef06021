// A double from text, also where std::from_chars reads integers only.
#pragma once

#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

namespace stickslip::detail {

/// Takes a number whose digits make a whole number of at most 2^53 and whose power of ten is at most 22 in magnitude: the
/// product or quotient of the two is then correctly rounded (W. D. Clinger, PLDI 1990). One pass over the digits; nothing
/// for other numbers, and where a sign follows, which may begin an exponent or another number. Exponents may have the
/// letter D of Fortran. Ten times as fast as strtod of Emscripten.
inline std::optional<double> take_short_number(std::string_view& text) {
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  const auto is_sign = [](char c) { return c == '+' || c == '-'; };
  const auto is_letter = [](char c) { return c == 'e' || c == 'E' || c == 'd' || c == 'D'; };
  static constexpr double powers[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                                      1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
  const char *at = text.data(), *const end = at + text.size();
  const bool negative = at < end && *at == '-';
  if (at < end && is_sign(*at)) ++at;
  std::uint64_t mantissa = 0;
  const char* const whole = at;
  for (; at < end && is_digit(*at); ++at) mantissa = 10 * mantissa + static_cast<std::uint64_t>(*at - '0');
  std::ptrdiff_t digits = at - whole, power = 0;
  if (at < end && *at == '.') {
    const char* const places = ++at;
    for (; at < end && is_digit(*at); ++at) mantissa = 10 * mantissa + static_cast<std::uint64_t>(*at - '0');
    power = places - at;
    digits += at - places;
  }
  if (digits == 0 || digits > 18 || mantissa > std::uint64_t{1} << 53 || (at < end && is_sign(*at)))
    return std::nullopt;
  if (at < end && is_letter(*at)) {
    ++at;
    const bool down = at < end && *at == '-';
    if (at < end && is_sign(*at)) ++at;
    const char* const figures = at;
    std::ptrdiff_t exponent = 0;
    for (; at < end && is_digit(*at) && at - figures < 4; ++at) exponent = 10 * exponent + (*at - '0');
    if (at == figures || (at < end && is_digit(*at))) return std::nullopt;
    power += down ? -exponent : exponent;
  }
  if (power < -22 || power > 22) return std::nullopt;
  const auto value = static_cast<double>(mantissa);
  const double result = power < 0 ? value / powers[-power] : value * powers[power];
  text.remove_prefix(static_cast<std::size_t>(at - text.data()));
  return negative ? -result : result;
}

/// `read_number` without std::from_chars of doubles, in the C locale.
inline std::optional<double> read_number_by_strtod(std::string_view text) {
  constexpr auto none = std::string_view::npos;
  if (text.empty() || text.front() == '+' || text.find_first_not_of("+-.0123456789eE") != none) return std::nullopt;
  std::string_view rest = text;
  if (const std::optional<double> number = take_short_number(rest); number && rest.empty()) return number;
  const std::string copy(text);
  char* stop = nullptr;
  const double value = std::strtod(copy.c_str(), &stop);
  if (stop != copy.c_str() + copy.size() || !std::isfinite(value)) return std::nullopt;
  const std::string_view mantissa = text.substr(0, text.find_first_of("eE"));
  if (!(std::abs(value) > 0) && mantissa.find_first_of("123456789") != none) return std::nullopt;
  return value;
}

/// Parses the whole text as a finite decimal number, as std::from_chars does: with an optional minus sign, and neither
/// blanks nor a plus sign at the front. Returns nothing for any other text, and for a number beyond the range of
/// doubles.
template <class Double = double>  // so that the branch not taken is not compiled
std::optional<double> read_number(std::string_view text) {
  const char* const end = text.data() + text.size();
  Double value = 0;
  if constexpr (requires { std::from_chars(end, end, value); }) {
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc() || stop != end || !std::isfinite(value)) return std::nullopt;
    return value;
  } else {  // older versions of libc++
    return read_number_by_strtod(text);
  }
}

}  // namespace stickslip::detail
