// The end of a slip in the plane.
#pragma once

#include <cmath>

#include "stickslip/base/vector2.hpp"
#include "stickslip/planar/detail/held_slip.hpp"

namespace stickslip::detail {

/// The last moments of a stop under a constant load. In tau, u + v_q, v_q - u and the velocity across the load decay
/// exponentially, at the rates w a - Q, w a + Q and w a.
struct ClosingSlip {
  Vector2 to;                  ///< direction of the load
  double level, load;          ///< w a and Q [m/s^2]
  double plus, minus, across;  ///< u + v_q, u - v_q, and the velocity across [m/s]

  HeldSlip slip() const noexcept { return {to, level, load, plus, minus, across}; }

  /// What is left from the time on at which u - v_q has decayed to a fraction g. Without friction the velocity only
  /// reverses: u + v_q is then 0.
  PlanarProgress to_stop(double g) const noexcept {
    const double slow = level - load, fast = level + load;
    const double p = plus > 0 ? plus * std::pow(g, slow / fast) : 0, m = minus * g,
                 c = across * std::pow(g, level / fast);
    const double along = ((p > 0 ? p * p / slow : 0) - m * m / fast) / 8;
    const double aside = c * ((p > 0 ? p / (level + slow) : 0) + m / (level + fast)) / 2;
    PlanarProgress left;
    left.time = ((p > 0 ? p / slow : 0) + m / fast) / 2;
    left.way = along * to + aside * turned(to);
    left.velocity = ((p - m) / 2) * to + c * turned(to);
    left.distance = ((p > 0 ? p * p / slow : 0) + m * m / fast) / 8 + (p > 0 ? p * m / (4 * level) : 0);
    return left;
  }
  /// The progress at that time, from the progress at the stop.
  PlanarProgress at(double g, const PlanarProgress& end) const noexcept {
    const PlanarProgress left = to_stop(g);
    return {end.time - left.time, end.way - left.way, left.velocity, end.distance - left.distance};
  }
};

}  // namespace stickslip::detail
