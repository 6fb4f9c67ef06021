// The spring that centers a slider.
#pragma once

#include "stickslip/base/requirements.hpp"

namespace stickslip {

/// A spring that draws a slider back to x = 0, per unit mass. Its force is under(w) x, where w = N+/g is the normal
/// force in units of the weight. The stiffness of a pendulum is proportional to w; any other spring does not feel it.
struct Spring {
  double stiffness = 0;   ///< wn^2, under the weight [1/s^2]
  bool pendulum = false;  ///< whether the weight makes the spring

  /// Stiffness under a normal force of `weight` times g [1/s^2].
  double under(double weight) const noexcept { return pendulum ? weight * stiffness : stiffness; }
  /// Rate of change of the stiffness while the weight changes at `weight_rate` [1/s]: [1/s^3].
  double rate(double weight_rate) const noexcept { return pendulum ? weight_rate * stiffness : 0; }
};

}  // namespace stickslip
