// A mass on a viscous damper: the linear system that approximates a slider with friction.
#pragma once

#include "stickslip/friction/coulomb.hpp"
#include "stickslip/slider/slider.hpp"

namespace stickslip {

/// A mass on a viscous damper, with an optional centering spring: a slider without friction,
///     x'' + c x' + wn^2 x = -n(t),                                                                 thesis (4.2), (5.2)
/// which is stuck only at rest under zero load. The thesis writes zeta for c.
class ViscousSlider : public Slider<Coulomb> {
 public:
  /// @param damping            c [1/s], finite and at least 0; 2 wn times the damping ratio
  /// @param natural_frequency  wn [rad/s], finite and at least 0; 0 is no spring
  /// @throws std::invalid_argument naming the value
  explicit ViscousSlider(double damping, double natural_frequency = 0)
      : Slider(Coulomb(0), natural_frequency, damping) {}
};

}  // namespace stickslip
