// A mass on friction, with an optional spring and an optional damper.
#pragma once

#include <cmath>
#include <utility>

#include "stickslip/error.hpp"
#include "stickslip/friction/law.hpp"
#include "stickslip/units.hpp"

namespace stickslip {

/// A mass on friction, with an optional centering spring and an optional viscous damper:
///     x'' + resist sgn(x') + c x' + wn^2 x = -n(t),                                   thesis (2.27), (2.50), (4.2)
/// x the displacement relative to the ground [m], n the ground acceleration [m/s^2]. At rest it stays while
///     -hold_backward <= -(n + wn^2 x) <= hold_forward.
template <FrictionLaw Law>
class Slider {
 public:
  /// @param law                what holds and what resists
  /// @param natural_frequency  wn, of the spring and the mass without friction [rad/s], finite and at least 0; 0 is no
  ///                           spring
  /// @param damping            c, of the damper per unit mass [1/s], finite and at least 0; 2 wn times the
  ///                           damping ratio
  /// @throws std::invalid_argument naming the value
  explicit Slider(Law law, double natural_frequency = 0, double damping = 0)
      : law_(std::move(law)),
        natural_frequency_(natural_frequency + 0.0),  // minus zero is zero
        stiffness_(natural_frequency * natural_frequency),
        damping_(damping + 0.0) {
    detail::require(std::isfinite(stiffness_) && natural_frequency >= 0,
                    "Slider: natural_frequency must be finite and at least 0", natural_frequency, "rad/s");
    detail::require(std::isfinite(damping) && damping >= 0, "Slider: damping must be finite and at least 0", damping,
                    "1/s");
  }

  /// A slider in cups, thesis (2.49) as corrected: each wheel stands in a bowl and climbs its side, a pendulum of the
  /// length of the bowl's radius less the wheel's,
  ///     wn = sqrt(g / (cup_radius - wheel_radius))
  /// to first order in x / (cup_radius - wheel_radius); the next term is the third.
  /// @param cup_radius    radius of curvature of the bowl [m], finite
  /// @param wheel_radius  of the wheel that rolls in it [m], at least 0 and less than cup_radius; 0, a point that
  ///                      slides, is the thesis's form
  /// @param damping       as above
  /// @throws std::invalid_argument naming the value
  static Slider in_cup(Law law, double cup_radius, double wheel_radius = 0, double damping = 0) {
    detail::require(std::isfinite(cup_radius) && cup_radius > 0, "Slider: cup_radius must be positive and finite",
                    cup_radius, "m");
    detail::require(
        wheel_radius >= 0 && wheel_radius < cup_radius,
        "Slider: wheel_radius must be at least 0 and less than the cup's " + detail::shortest(cup_radius) + " m",
        wheel_radius, "m");
    return Slider(std::move(law), std::sqrt(standard_gravity / (cup_radius - wheel_radius)), damping);
  }

  const Law& law() const noexcept { return law_; }
  double natural_frequency() const noexcept { return natural_frequency_; }

  /// wn^2, spring stiffness per unit mass [1/s^2].
  double stiffness() const noexcept { return stiffness_; }

  /// c [1/s].
  double damping() const noexcept { return damping_; }

 private:
  Law law_;
  double natural_frequency_;
  double stiffness_;
  double damping_;
};

}  // namespace stickslip
