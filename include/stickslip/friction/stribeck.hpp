// Friction that falls from a static to a kinetic level with increasing speed.
#pragma once

#include <cmath>
#include <tuple>

#include "stickslip/base/parts.hpp"
#include "stickslip/error.hpp"
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
  static constexpr int max_exponent = 31;

  /// @param static_level   a_static, force per unit mass at rest [m/s^2], finite and at least the kinetic one
  /// @param kinetic_level  a_kinetic, force per unit mass at high speed [m/s^2], finite and at least 0
  /// @param velocity       speed at which the level has fallen by 63 % of the difference [m/s], positive
  /// @param exponent       an integer from 1 to 31
  /// @throws std::invalid_argument naming the value
  Stribeck(double static_level, double kinetic_level, double velocity, int exponent)
      : static_(static_level), kinetic_(kinetic_level), velocity_(velocity), exponent_(exponent) {
    detail::require(std::isfinite(kinetic_level) && kinetic_level >= 0,
                    "Stribeck: the kinetic level must be finite and at least 0", kinetic_level, "m/s^2");
    detail::require(std::isfinite(static_level) && static_level >= kinetic_level,
                    "Stribeck: the static level must be finite and at least the kinetic one of " +
                        detail::shortest(kinetic_level) + " m/s^2",
                    static_level, "m/s^2");
    detail::require(velocity > 0, "Stribeck: velocity must be positive", velocity, "m/s");
    detail::require(exponent >= 1 && exponent <= max_exponent, "Stribeck: exponent must be a whole number from 1 to 31",
                    exponent);
  }

  double static_level() const noexcept { return static_; }
  double kinetic_level() const noexcept { return kinetic_; }
  double velocity() const noexcept { return velocity_; }
  int exponent() const noexcept { return exponent_; }

  static constexpr bool isotropic() noexcept { return true; }

  static constexpr const char* class_name = "Stribeck";
  static constexpr auto parts() {
    return std::tuple(Part{"static", &Stribeck::static_level}, Part{"kinetic", &Stribeck::kinetic_level},
                      Part{"velocity", &Stribeck::velocity}, Part{"exponent", &Stribeck::exponent});
  }

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
