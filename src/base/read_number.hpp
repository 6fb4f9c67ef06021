// A double from text, also where std::from_chars reads integers only.
#pragma once

#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

namespace stickslip::detail {

/// The number that is the whole text if it has a mantissa of at most 2^53 and a decimal exponent of at most 22 in
/// magnitude: both are then exact as doubles, and their product or quotient is correctly rounded (W. D. Clinger, PLDI
/// 1990). Nothing for other numbers, and for text that is none. Ten times as fast as strtod of Emscripten.
inline std::optional<double> read_short_number(std::string_view text) {
  const char* at = text.data();
  const char* const end = at + text.size();
  const bool negative = at < end && *at == '-';
  if (negative) ++at;
  std::uint64_t mantissa = 0;
  int digits = 0, exponent = 0;
  const auto take = [&](int shift) {
    for (; at < end && *at >= '0' && *at <= '9'; ++at, ++digits, exponent -= shift)
      mantissa = 10 * mantissa + static_cast<std::uint64_t>(*at - '0');
  };
  take(0);
  if (at < end && *at == '.') {
    ++at;
    take(1);
  }
  if (digits == 0 || digits > 18 || mantissa > std::uint64_t{1} << 53) return std::nullopt;
  if (at < end && (*at == 'e' || *at == 'E')) {
    if (++at < end && *at == '+') ++at;
    int power = 0;
    const auto [stop, error] = std::from_chars(at, end, power);
    if (error != std::errc() || power < -100 || power > 100 || (at > text.data() && at[-1] == '+' && *at == '-'))
      return std::nullopt;
    at = stop;
    exponent += power;
  }
  if (at != end || exponent < -22 || exponent > 22) return std::nullopt;
  static constexpr double powers[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                                      1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
  const auto value = static_cast<double>(mantissa);
  const double result = exponent < 0 ? value / powers[-exponent] : value * powers[exponent];
  return negative ? -result : result;
}

/// `read_number` without std::from_chars of doubles, in the C locale.
inline std::optional<double> read_number_by_strtod(std::string_view text) {
  if (const std::optional<double> number = read_short_number(text)) return number;
  constexpr auto none = std::string_view::npos;
  if (text.empty() || text.front() == '+' || text.find_first_not_of("+-.0123456789eE") != none) return std::nullopt;
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
