// Formatting of numbers with errors.
#pragma once

#include <string>

#include "stickslip/base/vector2.hpp"
#include "stickslip/statistics/tally.hpp"

namespace stickslip::python {

/// A number to four significant digits, and those of a vector.
std::string digits(double value);
inline std::string digits(Vector2 v) { return "(" + digits(v.axis) + ", " + digits(v.transverse) + ")"; }

/// "0.59712 +- 0.00021": the error to two digits, the value to the same decimal place.
std::string with_error(const Estimate& estimate);

}  // namespace stickslip::python
