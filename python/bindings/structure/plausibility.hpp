// Warnings about properties of structures that are likely in another unit: the only place of these rules.
#pragma once

#include <string>

#include "friction/plausibility.hpp"

namespace stickslip::python {

/// Structures are damped by 0.5 to 20 %, strained soil on compliant rock by up to 50 %.
inline void check_damping_ratio(const std::string& who, const std::string& name, double ratio) {
  if (ratio >= 1 && ratio <= 100)
    warn_of_unit(who + ": " + name + " = " + digits(ratio) +
                 " is critical damping or more; if it is in percent, give " + name + "=" + digits(ratio / 100));
}

/// Yield accelerations in use are at most 1 g. Above 100 g nothing is meant to slip.
inline void check_yield_acceleration(double ky_g) {
  if (ky_g > 2 && ky_g <= 100)
    warn_of_unit("FlexibleSlope: ky_g = " + digits(ky_g) +
                 " is more than any slope has; if it is in percent of g, give ky_g=" + digits(ky_g / 100));
}

}  // namespace stickslip::python
