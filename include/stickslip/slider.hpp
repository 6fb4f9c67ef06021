// The system that moves: a friction law, and a spring if it has one.
#pragma once

#include <cmath>
#include <utility>

#include "stickslip/error.hpp"
#include "stickslip/friction/law.hpp"

namespace stickslip {

/// A mass on friction, with an optional centering spring:
///     x'' + level(x) sgn(x') + wn^2 x = -n(t),                                        thesis (2.27), (2.50)
/// x the displacement relative to the ground [m], n the ground acceleration [m/s^2]. At rest it stays while
///     -level_backward <= -(n + wn^2 x) <= level_forward.
template <FrictionLaw Law>
class Slider {
 public:
  /// @param law                gives the slip level
  /// @param natural_frequency  wn, of the spring and the mass without friction [rad/s], finite and at least 0; 0 is
  /// none
  /// @throws std::invalid_argument naming the value
  explicit Slider(Law law, double natural_frequency = 0)
      : law_(std::move(law)), natural_frequency_(natural_frequency), stiffness_(natural_frequency * natural_frequency) {
    detail::require(std::isfinite(stiffness_) && natural_frequency >= 0,
                    "Slider: natural_frequency must be finite and at least 0", natural_frequency, "rad/s");
  }

  const Law& law() const noexcept { return law_; }
  double natural_frequency() const noexcept { return natural_frequency_; }

  /// wn^2, spring stiffness per unit mass [1/s^2].
  double stiffness() const noexcept { return stiffness_; }

 private:
  Law law_;
  double natural_frequency_;
  double stiffness_;
};

}  // namespace stickslip
