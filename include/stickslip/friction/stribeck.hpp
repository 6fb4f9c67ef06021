// Friction that falls from a static to a kinetic level with increasing speed.
#pragma once

#include <cmath>
#include <tuple>

#include "stickslip/base/error.hpp"
#include "stickslip/base/parts.hpp"
#include "stickslip/friction/law.hpp"
#include "stickslip/series/series.hpp"

namespace stickslip {

/// The Stribeck law:
///     a(|x'|) = a_kinetic + (a_static - a_kinetic) exp(-(|x'| / velocity)^exponent)
/// The limit of friction at rest is a_static. The friction force does not jump at breakaway.
///
/// Source: B. Armstrong-Helouvry, P. Dupont, C. Canudas de Wit, A survey of models, analysis tools and compensation
/// methods for the control of machines with friction, Automatica 30 (1994), 1083-1138.
class Stribeck {
 public:
  static constexpr bool symmetric = true;
  static constexpr bool static_above_kinetic = true;
  static constexpr int max_exponent = 31;

  static constexpr const char* class_name = "Stribeck";
  static constexpr auto parts() {
    return std::tuple(Part{"static", &Stribeck::static_level, "a_static", "m/s^2", Range::at_least(0)},
                      Part{"kinetic", &Stribeck::kinetic_level, "a_kinetic", "m/s^2", Range::at_least(0)},
                      Part{"velocity", &Stribeck::velocity, "velocity", "m/s", Range::above(0).or_infinite()},
                      Part{"exponent", &Stribeck::exponent, "exponent", "", Range::between(1, max_exponent)});
  }

  /// @param static_level   a_static, force per unit mass at rest [m/s^2], finite and at least the kinetic one
  /// @param kinetic_level  a_kinetic, force per unit mass at high speed [m/s^2], finite and at least 0
  /// @param velocity       speed at which the level has fallen by 63 % of the difference [m/s], positive
  /// @param exponent       an integer from 1 to 31
  /// @throws std::invalid_argument naming the value
  Stribeck(double static_level, double kinetic_level, double velocity, int exponent)
      : static_(static_level), kinetic_(kinetic_level), velocity_(velocity), exponent_(exponent) {
    detail::check_parts(*this, class_name);
    detail::require(static_level >= kinetic_level,
                    "Stribeck: the static level must be finite and at least the kinetic one of " +
                        detail::shortest(kinetic_level) + " m/s^2",
                    static_level, "m/s^2");
  }

  double static_level() const noexcept { return static_; }
  double kinetic_level() const noexcept { return kinetic_; }
  double velocity() const noexcept { return velocity_; }
  int exponent() const noexcept { return exponent_; }
  /// The speed over which the level changes [m/s].
  double speed_scale() const noexcept { return velocity_; }

  static constexpr bool isotropic() noexcept { return true; }

  template <class X, class Speed>
  auto resist(const X&, const Speed& speed, Direction) const {
    using std::exp;
    using std::pow;
    return kinetic_ + (static_ - kinetic_) * exp(-pow(speed / velocity_, exponent_));
  }

 private:
  double static_, kinetic_, velocity_;
  int exponent_;
};

}  // namespace stickslip
