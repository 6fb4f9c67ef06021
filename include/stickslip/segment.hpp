// One straight piece of a ground motion.
#pragma once

namespace stickslip {

/// Ground acceleration n(t) running straight from `start` to `end` within `duration`.
/// The load on a slider is p(t) = -n(t), the inertia force per unit mass.
struct Segment {
  double duration;  ///< [s], finite, at least 0
  double start;     ///< ground acceleration at its beginning [m/s^2], finite
  double end;       ///< ground acceleration at its end [m/s^2], finite; equal to `start` where a value is held
};

}  // namespace stickslip
