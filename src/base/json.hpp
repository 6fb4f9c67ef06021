// Helpers that write the JSON of a configuration.
#pragma once

#include <cmath>
#include <cstdint>
#include <span>
#include <string>

#include "stickslip/base/error.hpp"

namespace stickslip::detail {

/// A number as the shortest text that reads back the same. JSON has no infinity: null stands for it.
inline std::string json(double value) { return std::isfinite(value) ? shortest(value) : "null"; }

inline std::string json(std::uint64_t value) {
  return '"' + std::to_string(value) + '"';
}  // beyond a double's integers

inline std::string json(std::span<const double> values) {
  std::string text = "[";
  for (const double value : values) text.append(text.size() > 1 ? ", " : "").append(json(value));
  return text + "]";
}

}  // namespace stickslip::detail
