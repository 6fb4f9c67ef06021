// Exact results for Coulomb friction under white noise: densities, transient moments, drift.
#pragma once

#include <concepts>
#include <span>
#include <stdexcept>
#include <string>

#include "stickslip/friction/coulomb.hpp"
#include "stickslip/slider.hpp"
#include "stickslip/statistics/moments.hpp"
#include "stickslip/theory/noise.hpp"
#include "stickslip/theory/theory.hpp"

namespace stickslip::theory {

/// Exact results for Coulomb friction without a spring under white noise. The velocity is a diffusion toward rest,
///
///     dv = -a sgn(v) dt + sqrt(2 D) dW,   D = pi S0,   dx = v dt,                              thesis (3.48), (3.49)
///
/// with separate levels for the two directions if they differ. Other laws and springs have no closed form: another law
/// does not compile, and a spring is rejected.
///
/// With a level of 0 there is no stationary velocity in that direction: stationary values are then infinite, transient
/// ones remain valid. With an infinite backward level the slider never slides backward, as for `Coulomb`. Values at a
/// time are for a start from rest. Relative errors are 1e-12 or less; each time takes about 3 us.
///
/// References: T. K. Caughey, J. K. Dienes, J. Appl. Phys. 32 (1961), 2476-2479; I. Karatzas, S. E. Shreve, Ann.
/// Probab. 12 (1984), 819-828; transforms by the contour of J. A. C. Weideman, SIAM J. Numer. Anal. 44 (2006),
/// 2342-2362.
class WhiteNoise {
 public:
  /// In the units of the slip level and the noise: a = 1 m/s^2, S0 = 1 m^2/s^3.
  WhiteNoise() : WhiteNoise(Coulomb(1), 1.0) {}

  /// @param law  Coulomb friction; the two levels may differ
  /// @param s0   level S0 of the white ground acceleration, two-sided [m^2/s^3], positive and finite, or a white
  ///             Spectrum
  /// @throws std::invalid_argument naming the value
  WhiteNoise(const Coulomb& law, WhiteLevel s0);

  /// @throws std::invalid_argument also if the slider has a spring
  WhiteNoise(const Slider<Coulomb>& slider, WhiteLevel s0);

  /// @param slip_level  a, in both directions [m/s^2], finite and at least 0
  static WhiteNoise coulomb(double slip_level, WhiteLevel s0) { return {Coulomb(slip_level), s0}; }

  const Coulomb& law() const noexcept { return law_; }
  double s0() const noexcept { return s0_; }

  /// Stationary probability density of the velocity at `velocity` [s/m]: two exponentials that meet at rest,
  ///     p(v) = exp(-a v / D) / (D / a + D / b) for v > 0,   exp(b v / D) / (D / a + D / b) for v < 0,
  /// with the levels a and b against forward and backward sliding; a / (2 D) exp(-a |v| / D) if they are equal. 0 if a
  /// level is 0; NaN for NaN.
  double density(double velocity) const;

  /// Probability density of the velocity at `time`, given the velocity `start` at time 0 [s/m]. With y = |v|, y0 =
  /// |v0|:
  ///     exp(-(y - y0 + a t)^2 / 4 D t) / sqrt(4 pi D t) + q   on the side of the start,
  ///     exp(-a y / D) exp(-(y + y0 - a t)^2 / 4 D t) / sqrt(4 pi D t) + q   beyond rest,
  ///     q = a / (4 D) exp(-a y / D) erfc((y + y0 - a t) / sqrt(4 D t)).
  /// @param velocity  [m/s], finite
  /// @param time      [s], positive and finite
  /// @param start     [m/s], finite
  /// @throws std::invalid_argument naming the value; also if the levels differ: no closed form is known
  double transition_density(double velocity, double time, double start = 0) const;

  /// Stationary mean velocity: the drift D / a - D / b [m/s].
  double mean() const;

  /// Stationary variance of the velocity: D^2 (1 / a^2 + 1 / b^2), which is 2 pi^2 S0^2 / a^2, thesis (3.48) [m^2/s^2].
  double variance() const;

  /// Growth of the displacement variance once the velocity is stationary: 2 D^3 (2 / a^4 + 1 / (a b)^2 + 2 / b^4),
  /// which is 10 pi^3 S0^3 / a^4, thesis (3.49) [m^2/s]. Infinite if a level is 0: the variance then grows as t^3, and
  /// the growth rate of `predict` is NaN.
  double growth_rate() const;

  /// Two-sided spectral density of the stationary velocity [m^2/s]: its variance is the integral over the whole line.
  ///     S(w) = D^3 / (pi a^4) Re[(2 k^2 + 2 k + 1) / k^4],   2 k = 1 + sqrt(1 + 4 i w D / a^2)
  /// @param omega  [rad/s]; NaN for NaN
  /// @throws std::invalid_argument if the levels differ or are 0
  double velocity_spectrum(double omega) const;

  /// E|v|^n at `time`, from rest [(m/s)^n], by the transform
  ///     n! (1/k^(n+1) + 1/m^(n+1)) / (s (1/k + 1/m)),   2 D k = a + sqrt(a^2 + 4 D s),   m as k, of b
  /// @param order  n, from 1 to 8
  /// @param time   [s], finite and at least 0
  /// @throws std::invalid_argument naming the value
  double absolute_moment(int order, double time) const;

  /// Means and covariances by time, from rest. E[x v] and E[x^2] are also computed by their transforms, 3 / ((k - 1) (2
  /// k - 1) k^4) + 2 / ((k - 1) (2 k - 1)^2 k^3) and 2 / (k (k - 1)) times that if the levels are equal, in units of D
  /// and a.
  /// @param times  [s], finite, at least 0, increasing
  /// @throws std::invalid_argument naming the value; also if a moment exceeds the range of doubles
  Moments predict(std::span<const double> times) const;

  /// The `Theory` interface, for any slider and noise; independent of those of this object.
  static std::string name() { return "WhiteNoise"; }

  template <FrictionLaw Law, class E>
  static Coverage covers(const Slider<Law>& slider, const E& excitation) {
    return detail::coverage<WhiteLevel>(excitation, "WhiteNoise: covers white noise", [&](const WhiteLevel& s0) {
      if constexpr (std::same_as<Law, Coulomb>)
        WhiteNoise(slider, s0);
      else
        throw std::invalid_argument("WhiteNoise: covers Coulomb friction without a spring");
    });
  }

  /// The prediction of `WhiteNoise(slider, s0)`.
  static Moments predict(const Slider<Coulomb>& slider, WhiteLevel s0, std::span<const double> times) {
    return WhiteNoise(slider, s0).predict(times);
  }

 private:
  Coulomb law_;
  double s0_;
};

}  // namespace stickslip::theory
