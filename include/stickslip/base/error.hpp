// Errors and their messages.
//
// Public functions check their input once. The message names the rejected value and the rule, for example
// `GroundMotion: dt must be positive and finite, got -0.01 s`. Internal functions do not check it again.
#pragma once

#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <string_view>

#include "stickslip/base/equal.hpp"
#include "stickslip/base/requirements.hpp"

namespace stickslip {

/// A computation did not converge or complete. The message states how far it came and what to change.
/// `stickslip.ConvergenceError` (a RuntimeError) in Python.
class ConvergenceError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

namespace detail {

/// `shortest` without std::to_chars, for a finite value, in the C locale.
inline std::string shortest_printed(double value) {
  char text[512];  // the largest double has 309 digits before the point
  int places = 0;
  do std::snprintf(text, sizeof text, "%.*e", places, value);
  while (!equal(std::strtod(text, nullptr), value) && ++places < 17);
  const std::string scientific(text);
  places -= std::atoi(text + scientific.find('e') + 1);
  std::snprintf(text, sizeof text, "%.*f", places > 0 ? places : 0, value);
  const std::string fixed(text);
  return fixed.size() <= scientific.size() ? fixed : scientific;
}

template <class Double>  // so that the branch not taken is not compiled
std::string shortest_of(Double value) {
  char text[32];
  if constexpr (requires { std::to_chars(text, text, value); }) {
    const auto end = std::to_chars(text, text + sizeof text, value).ptr;
    return {text, end};
  } else {  // older versions of libc++
    if (std::isnan(value)) return "nan";
    if (std::isinf(value)) return value > 0 ? "inf" : "-inf";
    return shortest_printed(value);
  }
}

/// The shortest decimal string that reads back as the same double.
inline std::string shortest(double value) { return shortest_of(value); }

/// Throws std::invalid_argument "<rule>, got <value> <unit>".
[[noreturn]] inline void refuse(std::string_view rule, double value, std::string_view unit = {}) {
  std::string message(rule);
  message.append(", got ").append(shortest(value));
  if (!unit.empty()) message.append(" ").append(unit);
  throw std::invalid_argument(message);
}

/// Throws unless the rule holds.
inline void require(bool holds, std::string_view rule, double value, std::string_view unit = {}) {
  if (!holds) refuse(rule, value, unit);
}

}  // namespace detail
}  // namespace stickslip
