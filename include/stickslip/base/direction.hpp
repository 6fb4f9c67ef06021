// The unit vector at an angle.
#pragma once

#include <cmath>
#include <numbers>
#include <utility>

#include "stickslip/base/requirements.hpp"

namespace stickslip::detail {

struct CosSin {
  double cos, sin;
};

/// Cosine and sine of an angle in degrees, exact at multiples of 90.
inline CosSin cos_sin(double degrees) noexcept {
  int quarters = 0;
  const double rest = std::remquo(degrees, 90, &quarters) * (std::numbers::pi / 180);
  CosSin of{std::cos(rest), std::sin(rest)};
  for (int turn = quarters & 3; turn > 0; --turn) of.cos = -std::exchange(of.sin, of.cos);
  return of;
}

}  // namespace stickslip::detail
