// Internal quantities are in SI units; conversions of other units are here.
#pragma once

#include "stickslip/base/requirements.hpp"

namespace stickslip {

/// Standard acceleration of gravity [m/s^2], exact by definition (CGPM 1901).
inline constexpr double standard_gravity = 9.80665;

}  // namespace stickslip
