// Numbers in remarks, with the digits that a person reads.
#pragma once

#include <cstdio>
#include <string>

namespace stickslip::detail {

/// Four significant digits.
inline std::string digits(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

}  // namespace stickslip::detail
