// The caster: a pivoting wheel, whose slip level falls off as it aligns with the motion.
#pragma once

#include <cmath>
#include <limits>
#include <tuple>

#include "stickslip/base/error.hpp"
#include "stickslip/base/parts.hpp"
#include "stickslip/base/units.hpp"
#include "stickslip/friction/law.hpp"
#include "stickslip/numerics/root.hpp"
#include "stickslip/series/series.hpp"

namespace stickslip {

/// Four casters under a rigid mass, thesis (2.27): the slip level is a sech(x / reach) + rolling. The thesis writes 3l
/// for the reach and has no rolling resistance.
///
/// Rolling resistance acts along the wheel, on the fraction |tanh(x / reach)| of the distance that it rolls. The law
/// takes it as constant. This overestimates the resistance, by up to `rolling` where the wheel is perpendicular to the
/// motion and scrubs. Final displacements of carts that stay within their reach are therefore too small, by up to 26 %
/// for a rolling coefficient of 0.02; docs/caster.md has a table.
///
/// The law holds while the wheels are neither aligned with the motion nor flipped around. This is certain for |x| up to
/// about the reach (thesis A.2); beyond it a real wheel is sensitive to small disturbances.
class Caster {
 public:
  static constexpr bool symmetric = true;
  static constexpr const char* not_isotropic = "every wheel of a caster would have its own angle";

  static constexpr const char* class_name = "Caster";
  static constexpr auto parts() {
    return std::tuple(Part{"slip_level", &Caster::slip_level, "a", "m/s^2", Range::at_least(0)},
                      Part{"reach", &Caster::reach, "", "m", Range::above(0).or_infinite()},
                      Part{"rolling", &Caster::rolling, "", "m/s^2", Range::at_least(0), Listed::unless_zero});
  }

  /// @param slip_level  a, force per unit mass at x = 0, where the wheel is perpendicular to the motion [m/s^2],
  ///                    finite and at least 0
  /// @param reach       the distance over which the level falls off [m], positive; infinite for Coulomb friction
  /// @param rolling     resistance of rolling and of the bearings, per unit mass [m/s^2], finite and at least 0
  /// @throws std::invalid_argument naming the value
  Caster(double slip_level, double reach, double rolling = 0)
      : slip_level_(slip_level), reach_(reach), rolling_(rolling + 0.0) {  // minus zero is zero
    detail::check_parts(*this, class_name);
  }

  /// The law from the mechanics of a rigid wheel that trails its pivot (thesis appendix A, corrected).
  ///
  /// The wheel of width w trails its pivot by l and scrubs along its line of contact. The balance of moments about the
  /// pivot determines B = |2 v_n / (w theta')| at the midpoint of the contact line,
  ///     (B^2 + 4 (l/w) B) asinh(1/B) = sqrt(1 + B^2),
  /// and B determines the slip level a = mu g s, s = B asinh(1/B), and the reach l + w B / 2. The thesis drops a term
  /// in (A.12), which gives B = 4 l/w, s = B asinh(1/B) and the reach 3 l. Its friction is too high and its reach is
  /// wrong.
  ///
  /// @param mu           coefficient of friction between wheel and floor, finite and at least 0
  /// @param trail        l, horizontal distance from pivot to wheel axis [m], positive and finite
  /// @param wheel_width  w, length of the line of contact [m], positive and finite
  /// @param rolling_mu   coefficient of rolling resistance, finite and at least 0: rolling = rolling_mu g. It acts
  ///                     along the wheel, through the pivot, and does not change the balance of moments.
  /// @throws std::invalid_argument naming the value
  static Caster from_geometry(double mu, double trail, double wheel_width, double rolling_mu = 0) {
    check_geometry(mu, trail, wheel_width, rolling_mu);
    const double y = contact_angle(trail / wheel_width);
    return {mu * standard_gravity * (y / std::sinh(y)), trail + wheel_width / (2 * std::sinh(y)),
            rolling_mu * standard_gravity};
  }

  /// The law by the formulas of the thesis, for comparison: (A.15), (A.16) with corrected signs, (A.20) and (A.27).
  /// They give a = mu g (4 l/w) asinh(w / 4 l) and the reach 3 l.
  static Caster from_geometry_thesis(double mu, double trail, double wheel_width, double rolling_mu = 0) {
    check_geometry(mu, trail, wheel_width, rolling_mu);
    const double b = 4 * (trail / wheel_width);
    return {mu * standard_gravity * (b * std::asinh(1 / b)), 3 * trail, rolling_mu * standard_gravity};
  }

  double slip_level() const noexcept { return slip_level_; }
  double reach() const noexcept { return reach_; }
  double rolling() const noexcept { return rolling_; }
  /// The distance over which the level changes [m].
  double length_scale() const noexcept { return reach_; }

  template <class T>
  auto resist(const T& x, Direction) const {
    return slip_level_ * sech(x / reach_) + rolling_;
  }

  /// Work per unit mass against friction in sliding `distance` >= 0 from `from` [m^2/s^2]. The work of scrubbing is
  /// the slip level times the reach times the difference of two Gudermannians, evaluated without cancellation;
  /// the work of rolling resistance is added to it.
  double work(double from, double distance, Direction direction) const noexcept {
    const double half = distance / 2 / reach_;
    if (half < 0x1p-60) return resist(from, direction) * distance;  // constant over so short a distance
    const double middle = std::abs(from / reach_ + sign(direction) * half);
    const double ratio = std::exp(half - middle) * -std::expm1(-2 * half) / (1 + std::exp(-2 * middle));
    const double scrubbing = slip_level_ * (reach_ * (2 * std::atan(ratio)));  // ratio = sinh(half) / cosh(middle)
    return scrubbing + rolling_ * distance;
  }

 private:
  static void check_geometry(double mu, double trail, double wheel_width, double rolling_mu) {
    detail::require(std::isfinite(mu) && mu >= 0, "Caster: mu must be finite and at least 0", mu);
    detail::require(std::isfinite(rolling_mu) && rolling_mu >= 0, "Caster: rolling_mu must be finite and at least 0",
                    rolling_mu);
    detail::require(std::isfinite(trail) && trail > 0, "Caster: trail must be positive and finite", trail, "m");
    detail::require(std::isfinite(wheel_width) && wheel_width > 0, "Caster: wheel_width must be positive and finite",
                    wheel_width, "m");
  }

  // With B = 1 / sinh y the balance of moments is 4 l/w = (sinh y cosh y - y) / (y sinh y). Only the numerator cancels,
  // at small y, where it is a series. The quotient increases with y from 0 (a wide wheel) to infinity (a thin one); for
  // small y it is 2 y / 3.
  static double contact_angle(double trail_over_width) {
    const auto exceeds = [&](double y) {
      const double z = 2 * y, z2 = z * z;
      const double series =
          z * z2 / 12 * (1 + z2 / 20 * (1 + z2 / 42 * (1 + z2 / 72 * (1 + z2 / 110 * (1 + z2 / 156)))));
      return !((z < 0.5 ? series : (std::sinh(z) - z) / 2) / (y * std::sinh(y)) < 4 * trail_over_width);
    };
    return numerics::first_where(0, 6 * trail_over_width, exceeds);
  }

  double slip_level_;
  double reach_;
  double rolling_;
};

}  // namespace stickslip
