// Formatting of numbers with errors.
#pragma once

#include <string>

#include "stickslip/statistics/tally.hpp"

namespace stickslip::python {

/// A number to four significant digits.
std::string digits(double value);

/// "0.59712 +- 0.00021": the error to two digits, the value to the same decimal place.
std::string with_error(const Estimate& estimate);

}  // namespace stickslip::python
