// Slowly varying parameters: harmonic response by averaging over a cycle.
#pragma once

#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <functional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "stickslip/friction/caster.hpp"
#include "stickslip/friction/coulomb.hpp"
#include "stickslip/friction/law.hpp"
#include "stickslip/ground/harmonic_motion.hpp"
#include "stickslip/series/series.hpp"
#include "stickslip/slider/slider.hpp"
#include "stickslip/sliding/detail/balanced.hpp"
#include "stickslip/statistics/moments.hpp"
#include "stickslip/theory/theory.hpp"

namespace stickslip {

namespace detail {

inline series::Constant as_series(double level) noexcept { return {level}; }
template <series::Series S>
S as_series(const S& level) noexcept {
  return level;
}

/// A law whose level accepts a power series as the position.
template <class Law>
concept AnalyticLaw = PositionLaw<Law> && requires(const Law& law, const series::Variable& x) {
  as_series(law.resist(x, Direction::forward));
};

/// A law for which S^2 is convex in A^2, so that a response curve folds at most once. This holds for constant levels
/// and for the caster: sech(sqrt(u)) is a product of factors 1 / (1 + u / ((k - 1/2) pi)^2), so that it and the square
/// of its means are completely monotonic; adding the constant rolling resistance preserves this.
template <class Law>
concept OneFoldLaw = form_of<Law>
== Form::constant || std::same_as<Law, Caster>;

/// A friction law of any type, with what the averages over a cycle require.
struct CycledLaw {
  std::function<double(double x, Direction)> level;
  /// Coefficients of level(x + scale t) in powers of t: as many as the span holds, up to series::highest_order + 1.
  std::function<void(double x, double scale, Direction, std::span<double>)> expand;
  /// Work from -A to A, for A not far below the length over which the level changes; empty if unknown.
  std::function<double(double amplitude)> mean_level;
  bool one_fold;
};

template <AnalyticLaw Law>
CycledLaw cycled(const Law& law) {
  if constexpr (std::same_as<Law, Caster>)
    if (std::isinf(law.reach())) return cycled(Coulomb(law.slip_level() + law.rolling()));
  CycledLaw result{[law](double x, Direction direction) -> double { return law.resist(x, direction); },
                   [law](double x, double scale, Direction direction, std::span<double> coefficients) {
                     series::Coefficients t;
                     auto level = as_series(law.resist(series::Variable{&t}, direction));
                     for (std::size_t k = 0; k < coefficients.size(); ++k) {
                       const int order = static_cast<int>(k);
                       t[order] = order == 0 ? x : order == 1 ? scale : 0;
                       level.update(order);
                       coefficients[k] = level[order];
                     }
                   },
                   {},
                   OneFoldLaw<Law>};
  if constexpr (form_of<Law> == Form::constant)
    result.mean_level = [level = law.resist(0.0, Direction::forward)](double) { return level; };
  else if constexpr (std::same_as<Law, Caster>)  // from its work: half the cost if the amplitude is not small
    result.mean_level = [law](double a) {
      const double y = a / law.reach(), e = std::exp(-y);
      const double scrubbing = law.slip_level() * 2 * std::atan((1 - e) / (1 + e)) / y;
      return scrubbing + law.rolling();  // thesis (2.30), tanh(y / 2) = (1 - e) / (1 + e)
    };
  else if constexpr (LawWithWork<Law>)
    result.mean_level = [law](double a) { return law.work(-a, 2 * a, Direction::forward) / a / 2; };
  return result;
}

}  // namespace detail

namespace theory {

/// A periodic motion x = amplitude cos(omega t + phase) under B cos(omega t).
struct HarmonicSolution {
  double amplitude;  ///< A [m]
  double phase;      ///< phi [rad], from -pi to pi; NaN where the amplitude is 0
  bool stable;       ///< true if stable under small perturbations
};

/// Two frequencies [rad/s], lower and upper.
struct Branches {
  double lower, upper;
};

/// Amplitude and phase as functions of time.
struct HarmonicTransient {
  std::vector<double> amplitude;  ///< A [m]
  std::vector<double> phase;      ///< phi [rad], from -pi to pi; NaN where the amplitude is 0
};

/// Harmonic response by the method of slowly varying parameters, thesis 2.2 and 2.3, with corrected signs:
///     x'' + level(x) sgn(x') + wn^2 x = B cos(omega t),   x = A cos(omega t + phi),              (2.28), (2.50)
///     -2 omega A' + S(A) = B sin(phi),   -2 omega A phi' - omega^2 A + C(A) = B cos(phi)     (2.10) corrected, (2.11)
/// A and phi vary little within a cycle. The motion is therefore treated as a cosine about x = 0 that never sticks.
///
/// A law enters only by the work W(A) done against it in a cycle of amplitude A: S = -W / (pi A), which is -4 a / pi
/// for Coulomb friction and -(4 a / pi) gd(A / 3l) / (A / 3l) - 4 rolling / pi for the caster, and S' follows from W
/// and the levels at +-A. If the level does not depend on the direction, C = wn^2 A. The work of a law without a closed
/// form is integrated by quadrature, so that any law with a power series is covered. A law with different levels in the
/// two directions is not covered, because the mass drifts. On a spring it does not drift: Coulomb friction with unequal
/// levels is then equivalent to the mean level, for motion about `center`.
///
/// Range: B well above the slip level. For Coulomb friction without a spring the error is 0.7 % at B/a = 8, 3 % at 4
/// and 25 % at 2, and the method finds no motion from B = a, where motion begins, to 4 a / pi; compare the exact
/// orbits. It assumes the mean position x = 0, although nothing restores it without a spring: an exact caster may creep
/// away and escape. The statement (2.34) that the amplitude of a caster lies between those of Coulomb friction and of
/// the ground holds for these amplitudes, not for exact motions.
///
/// Reference: the thesis's chapter 2; N. M. Krylov, N. N. Bogoliubov, Introduction to Non-Linear Mechanics (1947).
class SlowlyVaryingParameters {
 public:
  /// For Coulomb friction of 1 m/s^2 without a spring.
  SlowlyVaryingParameters() : SlowlyVaryingParameters(Coulomb(1)) {}

  /// @param slider  any law of equal resistance both ways, with or without a spring, or a law alone; or Coulomb
  ///                friction of any finite levels on a spring
  /// @throws std::invalid_argument  the forward and backward levels, averaged over both sides of x = 0, differ
  template <detail::AnalyticLaw Law>
  explicit SlowlyVaryingParameters(const Slider<Law>& slider) : SlowlyVaryingParameters(detail::balanced(slider)) {
    detail::require_plain(slider, "SlowlyVaryingParameters");
  }
  template <class Law>
  requires(!std::same_as<Law, SlowlyVaryingParameters> &&
           detail::AnalyticLaw<Law>) explicit SlowlyVaryingParameters(const Law& law)
      : SlowlyVaryingParameters(Slider<Law>(law)) {}

  /// Mean position of the motion, x = center + A cos(omega t + phi) [m]: (backward - forward) / (2 wn^2) for Coulomb
  /// friction with unequal levels on a spring, which is exactly equivalent to the mean level about this position;
  /// otherwise 0.
  double center() const noexcept { return center_; }

  /// S(A) = (1/pi) int f sin(theta) dtheta over a cycle, thesis (2.12), (2.22), (2.30): the dissipative part, at most
  /// 0.
  /// @param amplitude  A [m], finite and at least 0; at 0, the limit
  /// @return [m/s^2]
  /// @throws std::invalid_argument for any other amplitude
  /// Coulomb and caster: to round-off for every A / 3l, about 40 ns. Other laws: quadrature to a relative 1e-10, 5 us;
  /// features narrower than a hundredth of the amplitude and away from x = 0 may be missed.
  double dissipative(double amplitude) const;

  /// S'(A) [1/s^2], thesis (2.38), with the same accuracy.
  double dissipative_slope(double amplitude) const;

  /// C(A) = (1/pi) int f cos(theta) dtheta, including that of the spring, thesis (2.13), (2.46), (2.52): the part in
  /// phase with x.
  /// @param amplitude  A [m], finite and at least 0
  /// @return [m/s^2]
  double in_phase(double amplitude) const;

  /// C'(A) [1/s^2].
  double in_phase_slope(double amplitude) const;

  /// Every periodic solution other than rest, by increasing amplitude: S^2 + (C - omega^2 A)^2 = B^2, thesis (2.16);
  /// phi = atan2(S, C - omega^2 A), (2.17) corrected; stable where S' + S/A <= 0, (2.18) corrected, which always
  /// holds for friction, and (C/A - omega^2) (C' - omega^2) + S S'/A > 0, (2.19).
  ///
  /// Rest, A = 0, is not included: it is a solution for every omega; see `rests`. At resonance, omega = wn, no
  /// amplitude is stable: with Coulomb friction it grows without bound if B exceeds 4 a / pi; with a caster it does so
  /// from the unstable solution on. Without friction the only amplitude is B / |omega^2 - wn^2|, which is neutral and
  /// counts as stable. At a fold, where two solutions coincide to round-off, the result has both, one or none of them.
  ///
  /// @param B      amplitude of the ground acceleration, the force per unit mass [m/s^2], positive and finite
  /// @param omega  [rad/s], positive and finite
  /// @throws std::invalid_argument  naming the value
  /// @throws std::overflow_error    amplitudes beyond the range of doubles
  /// Coulomb and caster: all solutions, with amplitudes to round-off; 0.1 to 4 us. For other laws the search uses 8
  /// amplitudes per octave, up to 1e12 times the length over which the level changes, and does not separate two folds
  /// between neighboring amplitudes; 20 us to 2 ms.
  std::vector<HarmonicSolution> response(double B, double omega) const;

  /// Frequencies at which the amplitude is A: omega^2 = C/A -+ sqrt(B^2 - S^2) / A, thesis (2.25), (2.32), (2.48),
  /// (2.53). NaN where not real: both below the minimum amplitude, the lower one also where its square is negative.
  /// Without a spring only the upper one exists.
  /// @param B          [m/s^2], positive and finite
  /// @param amplitude  A [m], positive and finite
  /// @return [rad/s]
  /// @throws std::invalid_argument naming the value
  Branches frequency(double B, double amplitude) const;

  /// Frequencies between which solutions of amplitude A are unstable, for any B: the locus of vertical tangencies,
  /// (2.19) as an equation, thesis (2.41), (2.42). The lower one is 0 if the zone extends to zero frequency, as always
  /// without a spring. If both are equal, as for Coulomb friction, all solutions are stable; NaN if S rises with A and
  /// no such frequency exists.
  /// @param amplitude  A [m], positive and finite
  /// @return [rad/s]
  /// @throws std::invalid_argument naming the value
  Branches stability_boundary(double amplitude) const;

  /// The minimum amplitude of any solution at any frequency: -S(A) = B, thesis (2.36), (2.37), by bracketing. 0 for B
  /// of at least -S(0) = 4 a / pi; infinite if there is none, as for Coulomb friction below that value.
  /// @param B  [m/s^2], positive and finite
  /// @return [m]
  /// @throws std::invalid_argument naming the value
  double min_amplitude(double B) const;

  /// Whether a small motion decays to rest: B <= -S(0), which is 4 a / pi. The exact slider rests only for B <= a;
  /// between a and 4 a / pi it has a small motion that sticks twice per cycle.
  bool rests(double B) const;

  /// Transient amplitude and phase, from the averaged equations (2.10) corrected and (2.11). A motion that has decayed
  /// stays at rest if `rests`.
  /// @param B, omega   as for `response`
  /// @param amplitude  at t = 0 [m], finite and at least 0
  /// @param phase      at t = 0 [rad], finite: x(0) - center() = A cos(phi), x'(0) = -omega A sin(phi)
  /// @param times      [s], at least 0, increasing
  /// @param progress  called regularly; may throw to stop the work; optional
  /// @throws std::invalid_argument  naming the value
  /// @throws ConvergenceError       with the time reached, after a million steps
  /// By SUNDIALS CVODE, Adams' formulas in A cos(phi), A sin(phi); local errors 1e-10 of A and 1e-12 B / omega^2.
  HarmonicTransient transient(double B, double omega, double amplitude, double phase, std::span<const double> times,
                              const std::function<void()>& progress = {}) const;

  /// The solution that a motion finally approaches: one of `response`, rest (amplitude 0) or, at resonance, an infinite
  /// amplitude. Without friction: the solution around which amplitude and phase circulate.
  ///
  /// The averaged equations contract areas, by (S' + S/A) / (2 omega), so that they have no closed orbits. A motion
  /// that has circled a stable solution once, with all others outside, therefore cannot leave it.
  /// Parameters as for `transient`.
  /// @throws ConvergenceError  if this is undecided after a hundred thousand turns: within round-off of the boundary
  ///                           between two solutions
  HarmonicSolution settles_on(double B, double omega, double amplitude, double phase,
                              const std::function<void()>& progress = {}) const;

  /// x and x' by time from rest at x = 0, as means without scatter. Parameters and exceptions as for `transient`.
  Moments predict(const HarmonicMotion& motion, std::span<const double> times,
                  const std::function<void()>& progress = {}) const;

  /// The `Theory` interface, for any slider; independent of the slider of this object.
  static std::string name() { return "SlowlyVaryingParameters"; }

  template <FrictionLaw Law, class E>
  static Coverage covers(const Slider<Law>& slider, const E& excitation) {
    const auto check = [&](const HarmonicMotion&) {
      if constexpr (detail::AnalyticLaw<Law>)
        SlowlyVaryingParameters{slider};
      else
        throw std::invalid_argument("SlowlyVaryingParameters: covers laws that take power series");
    };
    return detail::coverage<HarmonicMotion>(excitation, "SlowlyVaryingParameters: covers HarmonicMotion", check);
  }

  /// The prediction of `SlowlyVaryingParameters(slider)`.
  template <detail::AnalyticLaw Law>
  static Moments predict(const Slider<Law>& slider, const HarmonicMotion& motion, std::span<const double> times,
                         const std::function<void()>& progress = {}) {
    return SlowlyVaryingParameters(slider).predict(motion, times, progress);
  }

 private:
  struct Balance;
  class Plane;

  SlowlyVaryingParameters(detail::CycledLaw law, double natural_frequency);

  template <class Law>
  explicit SlowlyVaryingParameters(const detail::Balanced<Law>& balanced)
      : SlowlyVaryingParameters(detail::cycled(balanced.slider.law()), balanced.slider.natural_frequency()) {
    center_ = balanced.center;
  }

  // Mean of the levels at +-x, which is equal in both directions.
  double level(double x) const;
  // -pi S / 4, the mean level over a cycle, B + S, S S' / A; the contribution of friction to C; derivatives.
  double mean_level(double amplitude) const;
  double mean_level_slope(double amplitude, double mean_level) const;
  double surplus(double B, double amplitude, double mean_level) const;
  double fold_term(double amplitude, double mean_level) const;
  double in_phase_friction(double amplitude) const;
  double in_phase_friction_slope(double amplitude) const;

  static constexpr std::size_t orders = 24;  // of the power series at x = 0

  detail::CycledLaw law_;
  double natural_frequency_;
  double center_ = 0;
  double reach_ =
      1;  // length over which the level changes [m]; 0 if the power series does not show it, infinite: never
  bool directed_ = false;  // whether the level depends on the direction
  // Power series in (A / reach)^2, up to a factor, of mean_level, in_phase_friction and their derivatives.
  std::array<double, orders / 2 + 1> mean_{};
  std::array<double, orders / 2> mean_slope_{}, in_phase_{}, in_phase_slope_{};
};

}  // namespace theory
}  // namespace stickslip
