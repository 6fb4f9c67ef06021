// Errors and their messages.
//
// Public functions check their input once. The message names the rejected value and the rule, for example
// `GroundMotion: dt must be positive and finite, got -0.01 s`. Internal functions do not check it again.
#pragma once

#include <charconv>
#include <stdexcept>
#include <string>
#include <string_view>

#include "stickslip/base/requirements.hpp"

namespace stickslip {

/// A computation did not converge or complete. The message states how far it came and what to change.
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

/// Throws unless the rule holds.
inline void require(bool holds, std::string_view rule, double value, std::string_view unit = {}) {
  if (!holds) refuse(rule, value, unit);
}

}  // namespace detail
}  // namespace stickslip
