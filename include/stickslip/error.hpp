// Errors, and how their messages are written.
//
// Input is checked once, at the door: what is refused is named with its value and the rule it breaks, as
// `GroundMotion: dt must be positive and finite, got -0.01 s`. Inside, nothing is checked again.
#pragma once

#include <charconv>
#include <stdexcept>
#include <string>
#include <string_view>

#include "stickslip/detail/requirements.hpp"

namespace stickslip {

/// A computation that could not reach what was asked of it: the message says how far it came and what to change.
/// `stickslip.ConvergenceError` (a RuntimeError) in Python.
class ConvergenceError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

namespace detail {

/// The shortest decimal string that reads back as the same double.
inline std::string shortest(double value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value).ptr;
  return {text, end};
}

/// Throws std::invalid_argument "<rule>, got <value> <unit>".
[[noreturn]] inline void refuse(std::string_view rule, double value, std::string_view unit = {}) {
  std::string message(rule);
  message.append(", got ").append(shortest(value));
  if (!unit.empty()) message.append(" ").append(unit);
  throw std::invalid_argument(message);
}

/// Refuses unless the rule holds.
inline void require(bool holds, std::string_view rule, double value, std::string_view unit = {}) {
  if (!holds) refuse(rule, value, unit);
}

}  // namespace detail
}  // namespace stickslip
