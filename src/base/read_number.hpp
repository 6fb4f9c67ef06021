// A double from text, also where std::from_chars reads integers only.
#pragma once

#include <charconv>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

namespace stickslip::detail {

/// `read_number` without std::from_chars, in the C locale.
inline std::optional<double> read_number_by_strtod(std::string_view text) {
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

/// The finite decimal number that is the whole text, as std::from_chars reads it: with an optional minus sign, and
/// neither blanks nor a plus sign at the front. Nothing for any other text, and for a number beyond the range of
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
