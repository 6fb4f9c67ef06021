// Coulomb friction: the same slip level everywhere.
#pragma once

#include <cmath>
#include <limits>
#include <tuple>

#include "stickslip/base/equal.hpp"
#include "stickslip/base/error.hpp"
#include "stickslip/base/min_max.hpp"
#include "stickslip/base/parts.hpp"
#include "stickslip/base/units.hpp"
#include "stickslip/friction/law.hpp"

namespace stickslip {

/// Coulomb friction, thesis (2.20): the slip level is a = mu g at any position.
///
/// The two directions may differ: `forward` is the level against forward sliding (x' > 0), `backward` against backward
/// sliding. With an infinite `backward` level the slider is a Newmark block, which slides only forward. (The slope of
/// the ground is a property of the slider, see Mounting.)
class Coulomb {
 public:
  static constexpr bool constant_while_sliding = true;

  static constexpr const char* class_name = "Coulomb";
  static constexpr auto parts() {
    return std::tuple(Part{"slip_level", &Coulomb::forward, "a", "m/s^2", Range::at_least(0)},
                      Part{"backward", &Coulomb::backward, "", "m/s^2", Range::at_least(0).or_infinite()});
  }

  /// @param slip_level  a, force per unit mass [m/s^2], finite and at least 0 (0 is frictionless)
  /// @throws std::invalid_argument naming the value
  explicit Coulomb(double slip_level) : Coulomb(slip_level, slip_level) {}

  /// @param slip_level  against forward sliding [m/s^2], finite and at least 0
  /// @param backward    against backward sliding [m/s^2], at least 0; infinite: never slides backward
  /// @throws std::invalid_argument naming the value
  Coulomb(double slip_level, double backward) : forward_(slip_level), backward_(backward) {
    detail::check_parts(*this, class_name);
  }

  /// A block on level ground: a = mu g.
  /// @param mu  coefficient of friction, finite and at least 0
  static Coulomb from_friction(double mu) {
    detail::require(std::isfinite(mu) && mu >= 0, "Coulomb: mu must be finite and at least 0", mu);
    return Coulomb(mu * standard_gravity);
  }

  double forward() const noexcept { return forward_; }
  double backward() const noexcept { return backward_; }
  /// Whether the levels are equal.
  bool isotropic() const noexcept { return detail::equal(forward_, backward_); }

  template <class T>
  double resist(const T&, Direction direction) const noexcept {
    return direction == Direction::forward ? forward_ : backward_;
  }

  /// Work per unit mass against friction in sliding `distance` >= 0 [m^2/s^2].
  double work(double, double distance, Direction direction) const noexcept {
    return detail::equal(distance, 0) ? 0 : resist(0, direction) * distance;
  }

 private:
  double forward_;
  double backward_;
};

}  // namespace stickslip
