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

#include "stickslip/detail/balanced.hpp"
#include "stickslip/friction/caster.hpp"
#include "stickslip/friction/coulomb.hpp"
#include "stickslip/friction/law.hpp"
#include "stickslip/ground/harmonic_motion.hpp"
#include "stickslip/series/series.hpp"
#include "stickslip/slider.hpp"
#include "stickslip/statistics/moments.hpp"
#include "stickslip/theory/theory.hpp"

namespace stickslip {

namespace detail {

inline series::Constant as_series(double level) noexcept { return {level}; }
template <series::Series S>
S as_series(const S& level) noexcept {
  return level;
}

/// A law that takes power series for the place.
template <class Law>
concept AnalyticLaw = PositionLaw<Law> && requires(const Law& law, const series::Variable& x) {
  as_series(law.resist(x, Direction::forward));
};

/// A law whose S^2 is convex in A^2, so that a curve of response folds once at most. Constant levels have it; and the
/// caster: sech(sqrt(u)) is a product of 1 / (1 + u / ((k - 1/2) pi)^2), so it and the square of its means are
/// completely monotonic, and stay so with the constant of its rolling resistance added.
template <class Law>
concept OneFoldLaw = ConstantLevelLaw<Law> || std::same_as<Law, Caster>;

/// A friction law of whatever type, as a cycle of motion asks for it.
struct CycledLaw {
  std::function<double(double x, Direction)> level;
  /// Coefficients of level(x + scale t) in powers of t: as many as there is room for, up to series::highest_order + 1.
  std::function<void(double x, double scale, Direction, std::span<double>)> expand;
  /// From -A to A, for A not far below the length over which the level changes; empty where it is not known.
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
  if constexpr (ConstantLevelLaw<Law>)
    result.mean_level = [level = law.resist(0.0, Direction::forward)](double) { return level; };
  else if constexpr (std::same_as<Law, Caster>)  // its work, at half the price where the amplitude is not small
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

/// How amplitude and phase go on, time by time.
struct HarmonicTransient {
  std::vector<double> amplitude;  ///< A [m]
  std::vector<double> phase;      ///< phi [rad], from -pi to pi; NaN where the amplitude is 0
};

/// Harmonic response by the method of slowly varying parameters, thesis 2.2 and 2.3, with its signs put right:
///     x'' + level(x) sgn(x') + wn^2 x = B cos(omega t),   x = A cos(omega t + phi),              (2.28), (2.50)
///     -2 omega A' + S(A) = B sin(phi),   -2 omega A phi' - omega^2 A + C(A) = B cos(phi)     (2.10) corrected, (2.11)
/// A and phi vary little within a cycle; so the motion is taken for a cosine about x = 0, which slides all the time.
///
/// What a cycle of amplitude A asks of a law is the work W(A) done against it: S = -W / (pi A), which is -4 a / pi for
/// Coulomb friction and -(4 a / pi) gd(A / 3l) / (A / 3l) - 4 rolling / pi for the caster, and S' follows from W and
/// the levels at +-A. Where the level does not depend on the direction, C = wn^2 A. A law that does not know its work
/// is integrated by quadrature, so that any law with a power series is covered; one that resists the two directions
/// differently is not, because its mass drifts. On a spring it does not: Coulomb friction of unequal levels is then
/// that of their mean about `center`, and all below is about that place.
///
/// Where it holds: B well above the slip level. For Coulomb friction without a spring it is 0.7 % off at B/a = 8, 3 %
/// at 4, 25 % at 2, and finds no motion from B = a, where motion begins, to 4 a / pi; see the exact orbits. It takes
/// the mean position for x = 0, where without a spring nothing holds it: an exact caster may creep away and escape.
/// That a caster's amplitude lies between those of Coulomb friction and of the ground, (2.34), is said of these
/// amplitudes, not of motions.
///
/// Reference: the thesis's chapter 2; N. M. Krylov, N. N. Bogoliubov, Introduction to Non-Linear Mechanics (1947).
class SlowlyVaryingParameters {
 public:
  /// Of Coulomb friction of 1 m/s^2 without a spring.
  SlowlyVaryingParameters() : SlowlyVaryingParameters(Coulomb(1)) {}

  /// @param slider  any law of equal resistance both ways, with or without a spring; a law alone will do; or Coulomb
  ///                friction of any finite levels on a spring
  /// @throws std::invalid_argument  the levels forward and backward, seen from both sides of x = 0, differ on average
  template <detail::AnalyticLaw Law>
  explicit SlowlyVaryingParameters(const Slider<Law>& slider) : SlowlyVaryingParameters(detail::balanced(slider)) {
    detail::require_plain(slider, "SlowlyVaryingParameters");
  }
  template <class Law>
  requires(!std::same_as<Law, SlowlyVaryingParameters> &&
           detail::AnalyticLaw<Law>) explicit SlowlyVaryingParameters(const Law& law)
      : SlowlyVaryingParameters(Slider<Law>(law)) {}

  /// Where the motion swings about, x = center + A cos(omega t + phi) [m]: (backward - forward) / (2 wn^2) for Coulomb
  /// friction of unequal levels on a spring, which is exactly that of their mean about this place; else 0.
  double center() const noexcept { return center_; }

  /// S(A) = (1/pi) int f sin(theta) dtheta over a cycle, thesis (2.12), (2.22), (2.30): what dissipates, at most 0.
  /// @param amplitude  A [m], finite and at least 0; at 0, the limit
  /// @return [m/s^2]
  /// @throws std::invalid_argument for another amplitude
  /// Coulomb and caster to round-off for every A / 3l, some 40 ns. Other laws by quadrature, to a relative 1e-10, 5 us;
  /// what is narrower than a hundredth of the amplitude and away from x = 0 may be missed there.
  double dissipative(double amplitude) const;

  /// S'(A), thesis (2.38), as accurate, in [1/s^2].
  double dissipative_slope(double amplitude) const;

  /// C(A) = (1/pi) int f cos(theta) dtheta, the spring's part included, thesis (2.13), (2.46), (2.52): what acts in
  /// phase with x.
  /// @param amplitude  A [m], finite and at least 0
  /// @return [m/s^2]
  double in_phase(double amplitude) const;

  /// C'(A), in [1/s^2].
  double in_phase_slope(double amplitude) const;

  /// Every periodic solution other than rest, by increasing amplitude: S^2 + (C - omega^2 A)^2 = B^2, thesis (2.16);
  /// phi = atan2(S, C - omega^2 A), (2.17) corrected; stable where S' + S/A <= 0, (2.18) corrected, which friction
  /// always meets, and (C/A - omega^2) (C' - omega^2) + S S'/A > 0, (2.19).
  ///
  /// Rest, A = 0, is not among them: it is there for every omega; see `rests`. At resonance, omega = wn, no amplitude
  /// is stable: Coulomb friction lets it grow indefinitely where B exceeds 4 a / pi, the caster from its unstable
  /// solution on. Without friction there is the one amplitude B / |omega^2 - wn^2|, which is neutral and counts as
  /// stable. At a fold, to round-off, where two solutions meet, both, one or none of them.
  ///
  /// @param B      amplitude of the force per unit mass, and so of the ground acceleration [m/s^2], positive and finite
  /// @param omega  [rad/s], positive and finite
  /// @throws std::invalid_argument  naming the value
  /// @throws std::overflow_error    amplitudes beyond the range of doubles
  /// Coulomb and caster: all of them, amplitudes to round-off; 0.1 to 4 us. Other laws are searched at 8 amplitudes an
  /// octave, between which no two folds are told apart, up to 1e12 times the length over which the level changes; 20 us
  /// to 2 ms.
  std::vector<HarmonicSolution> response(double B, double omega) const;

  /// Frequencies at which the amplitude is A: omega^2 = C/A -+ sqrt(B^2 - S^2) / A, thesis (2.25), (2.32), (2.48),
  /// (2.53). NaN where none is real: both below the least amplitude, the lower one also where it would be imaginary.
  /// Without a spring there is the upper one alone.
  /// @param B          [m/s^2], positive and finite
  /// @param amplitude  A [m], positive and finite
  /// @return [rad/s]
  /// @throws std::invalid_argument naming the value
  Branches frequency(double B, double amplitude) const;

  /// Frequencies between which solutions of amplitude A are unstable, whatever their B: the locus of vertical
  /// tangencies, (2.19) as an equation, thesis (2.41), (2.42). The lower one is 0 where the zone reaches there, as it
  /// always does without a spring. Where both are the same, as for Coulomb friction, all are stable; NaN where S rises
  /// with A and there is no such frequency.
  /// @param amplitude  A [m], positive and finite
  /// @return [rad/s]
  /// @throws std::invalid_argument naming the value
  Branches stability_boundary(double amplitude) const;

  /// The least amplitude of any solution, whatever the frequency: -S(A) = B, thesis (2.36), (2.37), by bracketing.
  /// 0 for B of at least -S(0) = 4 a / pi; infinite where there is none, as for Coulomb friction below that.
  /// @param B  [m/s^2], positive and finite
  /// @return [m]
  /// @throws std::invalid_argument naming the value
  double min_amplitude(double B) const;

  /// Whether a small motion dies down to rest: B <= -S(0), which is 4 a / pi. The exact motion rests only for B <= a;
  /// from there to 4 a / pi it is a small one that sticks twice a cycle.
  bool rests(double B) const;

  /// Amplitude and phase on their way, from the averaged equations (2.10) corrected and (2.11). A motion that dies down
  /// stays at rest where `rests`.
  /// @param B, omega   as for `response`
  /// @param amplitude  at t = 0 [m], finite and at least 0
  /// @param phase      at t = 0 [rad], finite: x(0) - center() = A cos(phi), x'(0) = -omega A sin(phi)
  /// @param times      [s], increasing, from 0 on
  /// @param progress  called regularly; may throw to stop the work; optional
  /// @throws std::invalid_argument  naming the value
  /// @throws ConvergenceError       with the time reached, after a million steps
  /// By SUNDIALS CVODE, Adams' formulas in A cos(phi), A sin(phi); local errors 1e-10 of A and 1e-12 B / omega^2.
  HarmonicTransient transient(double B, double omega, double amplitude, double phase, std::span<const double> times,
                              const std::function<void()>& progress = {}) const;

  /// The solution that a motion comes to in the end: one of `response`, or rest (amplitude 0), or, at resonance, an
  /// infinite amplitude. Without friction, the one about which it turns indefinitely.
  ///
  /// The averaged equations contract areas, by (S' + S/A) / (2 omega), so that they have no closed orbits, and a motion
  /// which turns about a stable solution once, with all others outside, can't leave it.
  /// Parameters as for `transient`.
  /// @throws ConvergenceError  where that is not decided after a hundred thousand turns: within round-off of the
  ///                           boundary between two solutions
  HarmonicSolution settles_on(double B, double omega, double amplitude, double phase,
                              const std::function<void()>& progress = {}) const;

  /// x and x' by time from rest at x = 0, by `transient`, whose parameters and exceptions they are: means without
  /// scatter.
  Moments predict(const HarmonicMotion& motion, std::span<const double> times,
                  const std::function<void()>& progress = {}) const;

  /// As a `Theory`, of any slider, whatever this one is of.
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

  /// As of `SlowlyVaryingParameters(slider)`.
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

  // Mean of the levels at +-x, which is the same both ways.
  double level(double x) const;
  // -pi S / 4, the mean level over a cycle, B + S, S S' / A; what friction adds to C; and derivatives.
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
      1;  // length over which the level changes [m]; 0 where the power series does not tell, infinite: never
  bool directed_ = false;  // whether the level depends on the direction
  // Power series in (A / reach)^2, but for a factor: of mean_level, in_phase_friction and their derivatives.
  std::array<double, orders / 2 + 1> mean_{};
  std::array<double, orders / 2> mean_slope_{}, in_phase_{}, in_phase_slope_{};
};

}  // namespace theory
}  // namespace stickslip
