// Exact results for Coulomb friction under white noise, along one axis, in the plane and in d dimensions: densities,
// transient moments, relaxation, drift.
#pragma once

#include <concepts>
#include <span>
#include <stdexcept>
#include <string>

#include "stickslip/friction/coulomb.hpp"
#include "stickslip/slider/slider.hpp"
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
/// In d dimensions, 2 for a block on a plane, friction opposes the velocity vector, and white noise of level S0 acts in
/// each coordinate, independently of the others:
///
///     dv = -a v / |v| dt + sqrt(2 D) dW,   dx = v dt
///
/// The levels must then be equal. The distribution is the same in all directions, so that coordinates are uncorrelated,
/// though not independent, and all have the same moments: means, variances, covariances, densities and spectra are
/// those of each coordinate. In two and more dimensions the velocity never returns to zero; see
/// docs/planar_white_noise.md.
///
/// With a level of 0 there is no stationary velocity in that direction: stationary values are then infinite, transient
/// ones remain valid. With an infinite backward level the slider never slides backward, as for `Coulomb`. Values at a
/// time are for a start from rest. Relative errors are 1e-12 or less; each time takes about 3 us in one dimension, and
/// 100 us in more.
///
/// References: T. K. Caughey, J. K. Dienes, J. Appl. Phys. 32 (1961), 2476-2479; I. Karatzas, S. E. Shreve, Ann.
/// Probab. 12 (1984), 819-828; transforms by the contour of J. A. C. Weideman, SIAM J. Numer. Anal. 44 (2006),
/// 2342-2362. In more dimensions: docs/planar_white_noise.md derives the results.
class WhiteNoise {
 public:
  /// In the units of the slip level and the noise: a = 1 m/s^2, S0 = 1 m^2/s^3.
  WhiteNoise() : WhiteNoise(Coulomb(1), 1.0) {}

  /// @param law  Coulomb friction; the two levels may differ
  /// @param s0   level S0 of the white ground acceleration, two-sided [m^2/s^3], positive and finite, or a white
  ///             Spectrum
  /// @param dimensions  of the velocity, from 1 to 6; the levels must be equal in more than one
  /// @throws std::invalid_argument naming the value
  WhiteNoise(const Coulomb& law, WhiteLevel s0, int dimensions = 1);

  /// @throws std::invalid_argument also if the slider has a spring
  WhiteNoise(const Slider<Coulomb>& slider, WhiteLevel s0, int dimensions = 1);

  /// @param slip_level  a, in all directions [m/s^2], finite and at least 0
  static WhiteNoise coulomb(double slip_level, WhiteLevel s0, int dimensions = 1) {
    return {Coulomb(slip_level), s0, dimensions};
  }

  static constexpr int max_dimensions = 6;

  const Coulomb& law() const noexcept { return law_; }
  double s0() const noexcept { return s0_; }
  int dimensions() const noexcept { return dimensions_; }

  /// Stationary probability density of the velocity, in more than one dimension of each of its components, at
  /// `velocity` [s/m]: two exponentials that meet at rest,
  ///     p(v) = exp(-a v / D) / (D / a + D / b) for v > 0,   exp(b v / D) / (D / a + D / b) for v < 0,
  /// with the levels a and b against forward and backward sliding; a / (2 D) exp(-a |v| / D) if they are equal. 0 if a
  /// level is 0; NaN for NaN. The velocity vector has a density proportional to exp(-a |v| / D) in any number of
  /// dimensions d, and its components have
  ///     p(v) = (a / D) (y / 2)^(d / 2) K_(d / 2)(y) / (sqrt(pi) Gamma((d + 1) / 2)),   y = a |v| / D,
  /// with a Bessel function K: y K_1(y) / pi in the plane, times a / D.
  double density(double velocity) const;

  /// Stationary probability density of the speed |v| [s/m], a Gamma distribution of shape d: (a / D)^d |v|^(d - 1)
  /// exp(-a |v| / D) / (d - 1)!. 0 for negative speeds and if a level is 0; NaN for NaN.
  double speed_density(double speed) const;

  /// Probability density of the velocity at `time`, given the velocity `start` at time 0 [s/m]. With y = |v| and
  /// y0 = |v0|:
  ///     exp(-(y - y0 + a t)^2 / 4 D t) / sqrt(4 pi D t) + q   on the side of the start,
  ///     exp(-a y / D) exp(-(y + y0 - a t)^2 / 4 D t) / sqrt(4 pi D t) + q   beyond rest,
  ///     q = a / (4 D) exp(-a y / D) erfc((y + y0 - a t) / sqrt(4 D t)).
  /// @param velocity  [m/s], finite
  /// @param time      [s], positive and finite
  /// @param start     [m/s], finite
  /// @throws std::invalid_argument naming the value; also if the levels differ, and in more than one dimension: no
  /// closed form is known
  double transition_density(double velocity, double time, double start = 0) const;

  /// Stationary mean velocity: the drift D / a - D / b [m/s]; 0 in more than one dimension.
  double mean() const;

  /// Stationary mean of the speed |v| [m/s]: d D / a; for levels that differ (D^2 / a^2 + D^2 / b^2) / (D / a + D / b).
  double mean_speed() const;

  /// Stationary variance of each component of the velocity: D^2 (1 / a^2 + 1 / b^2), which is 2 pi^2 S0^2 / a^2, thesis
  /// (3.48); in d dimensions (d + 1) D^2 / a^2 [m^2/s^2].
  double variance() const;

  /// Growth of the variance of each coordinate once the velocity is stationary: 2 D^3 (2 / a^4 + 1 / (a b)^2 + 2 /
  /// b^4), which is 10 pi^3 S0^3 / a^4, thesis (3.49); in d dimensions (d + 1) (2 d + 3) D^3 / a^4 [m^2/s]. Infinite if
  /// a level is 0: the variance then grows as t^3, and the growth rate of `predict` is NaN.
  double growth_rate() const;

  /// The rate at which the velocity forgets its start [1/s]: d a^2 / ((d + 1)^2 D), with the lower level if they
  /// differ. The slowest part of every transient, and of the autocovariance, decays as exp(-rate t), in one dimension
  /// times a power of t.
  double relaxation_rate() const;

  /// Autocovariance of each component of the stationary velocity, E[v_i(t) v_i(t + lag)] [m^2/s^2]. Its integral over
  /// all lags is `growth_rate()`. The error is at most 1e-12 of the variance.
  /// @param lag  of either sign [s]; NaN for NaN
  /// @throws std::invalid_argument if the levels differ or are 0
  double velocity_autocovariance(double lag) const;

  /// Two-sided spectral density of each component of the stationary velocity [m^2/s]: its variance is the integral over
  /// the whole line. In one dimension
  ///     S(w) = D^3 / (pi a^4) Re[(2 k^2 + 2 k + 1) / k^4],   2 k = 1 + sqrt(1 + 4 i w D / a^2)
  /// and in d, with Gauss's function F, rho = (k - 1) / k and b = 1 + (d - 1) (k - 1) / (2 k - 1),
  ///     S(w) = D / (pi w^2) (1 - Re[F(1, b - d; b + 1; rho^2) / (b k^2)])
  /// @param omega  [rad/s]; NaN for NaN
  /// @throws std::invalid_argument if the levels differ or are 0
  double velocity_spectrum(double omega) const;

  /// E|v|^n at `time`, from rest [(m/s)^n], by the transform
  ///     n! (1/k^(n+1) + 1/m^(n+1)) / (s (1/k + 1/m)),   2 D k = a + sqrt(a^2 + 4 D s),   m as k, of b
  /// In more than one dimension |v| is the speed, and the transform is (W.13) of docs/planar_white_noise.md.
  /// @param order  n, from 1 to 8
  /// @param time   [s], finite and at least 0
  /// @throws std::invalid_argument naming the value
  double absolute_moment(int order, double time) const;

  /// Means and covariances of each coordinate by time, from rest. In one dimension E[x v] and E[x^2] are also computed
  /// by their transforms, 3 / ((k - 1) (2 k - 1) k^4) + 2 / ((k - 1) (2 k - 1)^2 k^3) and 2 / (k (k - 1)) times that if
  /// the levels are equal, in units of D and a; in more dimensions by (W.13) and (W.14) of docs/planar_white_noise.md.
  /// @param times  [s], finite, at least 0, increasing
  /// @throws std::invalid_argument naming the value; also if a moment exceeds the range of doubles
  Moments predict(std::span<const double> times) const;

  /// The `Theory` interface, for any slider and noise, independent of those of this object, and in its number of
  /// dimensions. The name has the number if it is not 1.
  std::string name() const;

  template <FrictionLaw Law, class E>
  Coverage covers(const Slider<Law>& slider, const E& excitation) const {
    return detail::coverage<WhiteLevel>(excitation, "WhiteNoise: covers white noise", [&](const WhiteLevel& s0) {
      if constexpr (std::same_as<Law, Coulomb>)
        WhiteNoise(slider, s0, dimensions_);
      else
        throw std::invalid_argument("WhiteNoise: covers Coulomb friction without a spring");
    });
  }

  /// The prediction of `WhiteNoise(slider, s0, dimensions())`.
  Moments predict(const Slider<Coulomb>& slider, WhiteLevel s0, std::span<const double> times) const {
    return WhiteNoise(slider, s0, dimensions_).predict(times);
  }

 private:
  Coulomb law_;
  double s0_;
  int dimensions_;
};

}  // namespace stickslip::theory
