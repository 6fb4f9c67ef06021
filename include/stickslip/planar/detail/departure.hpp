// When a slider at rest in the plane begins to slip.
#pragma once

#include <cmath>

#include "stickslip/base/equal.hpp"
#include "stickslip/base/min_max.hpp"
#include "stickslip/base/vector2.hpp"
#include "stickslip/flow/closed_form.hpp"

namespace stickslip::detail {

/// The first time, up to `duration`, at which |q + rate t| exceeds level + level_rate t; `never` if it does not. An
/// equal load is held. The difference of the squares is a quadratic in time.
inline double exceeds(Vector2 q, Vector2 rate, double level, double level_rate, double duration) noexcept {
  const Vector2 gained = duration * rate;
  const double level_gained = duration * level_rate;
  // Scaled to near 1, so that squares neither overflow nor underflow.
  const double scale = std::max(std::max(norm(q), norm(gained)), std::max(level, std::abs(level_gained)));
  if (!(scale > 0)) return never;
  if (!(level < never)) return never;
  const Vector2 at = (1 / scale) * q, by = (1 / scale) * gained;
  const double l = level / scale, dl = level_gained / scale;
  // Whether the load exceeds the level is decided without scaling, as for the slip that begins.
  const double c = ((norm(q) - level) / scale) * (norm(at) + l);
  const double b = dot(at, by) - l * dl;
  const double a = dot(by, by) - dl * dl;
  if (c > 0) return 0;
  if (equal(c, 0)) {
    if (b > 0 || (equal(b, 0) && a > 0)) return 0;
    const double root = a > 0 ? -2 * b / a : never;
    return root < 1 ? root * duration : never;
  }
  // Where load and level vanish together, they only touch.
  const double square = b * b - a * c;
  if (!(square > 0x1p-48 * (b * b))) return never;
  const double root = std::sqrt(square);
  double part = never;
  if (b + root > 0) part = b > 0 || !(a > 0) ? -c / (b + root) : (root - b) / a;
  return part < 1 ? part * duration : never;
}

}  // namespace stickslip::detail
