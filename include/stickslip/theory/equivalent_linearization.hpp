// Generalized equivalent linearization: the transient covariance of a slider under shaped noise.
#pragma once

#include <concepts>
#include <functional>
#include <span>
#include <string>
#include <variant>

#include "stickslip/base/equal.hpp"
#include "stickslip/friction/caster.hpp"
#include "stickslip/friction/coulomb.hpp"
#include "stickslip/friction/law.hpp"
#include "stickslip/slider/slider.hpp"
#include "stickslip/statistics/moments.hpp"
#include "stickslip/theory/noise.hpp"
#include "stickslip/theory/shaping_filter.hpp"
#include "stickslip/theory/theory.hpp"

namespace stickslip {
class SlidingStructure;
}

namespace stickslip::detail {

struct ShapedProblem;

/// A law in the form that the compiled library uses: Coulomb friction and casters without rolling resistance, for which
/// it has closed forms, or the level of any other law.
using LinearizedLaw = std::variant<Coulomb, Caster, std::function<double(double, Direction)>>;

/// The level of a law, which keeps its type: the library recognizes a caster with rolling resistance by it.
template <PositionLaw Law>
struct LevelOf {
  Law law;
  double operator()(double x, Direction direction) const { return law.resist(x, direction); }
};

template <PositionLaw Law>
LinearizedLaw linearized_law(const Law& law) {
  if constexpr (std::same_as<Law, Coulomb>) {
    return law;
  } else {
    if constexpr (std::same_as<Law, Caster>)
      if (equal(law.rolling(), 0)) return law;
    return LevelOf<Law>{law};
  }
}

}  // namespace stickslip::detail

namespace stickslip::theory {

/// The friction of the equivalent linear system, x'' = a21 x + a22 x', thesis (3.2).
struct LinearFriction {
  double a21;  ///< stiffness due to friction, of either sign, without that of the spring [1/s^2]
  double a22;  ///< minus the equivalent damping, not positive [1/s]
};

/// Generalized equivalent linearization, thesis 3.3 and 3.4, extended to excitation that is neither white nor
/// stationary. At each time, friction is replaced by the linear force with the least mean-square error. With the states
/// of the filter that shapes the excitation, z = (x, x', filter), the covariance Q about the mean m satisfies
///
///     Q' = A Q + (A Q)^T + 2 pi S0 b b^T                                                                 (3.9)
///     m_x' = m_v,   m_v' = -E F - c m_v - wn^2 m_x,   F = level sgn(x')
///
/// where the row of x' in A contains -wn^2 + a21, -c + a22 and the output of the filter times the envelope, and
/// [a21 a22] = -E[(F - E F) (x - m_x, x' - m_v)] Cov^-1, (3.5) corrected. Under white noise these are
///
///     q11' = 2 q12                                                                                      (3.32)
///     q12' = (a21 - wn^2) q11 + a22 q12 + q22                                                (3.33) corrected
///     q22' = 2 (a21 - wn^2) q12 + 2 a22 q22 + 2 pi S0                                        (3.34) corrected
///
/// The thesis sets a21 to zero (3.24), which is correct only if x and x' are uncorrelated, and simplifies the level of
/// a caster (3.28).
///
/// Covers Coulomb friction, also with unequal levels, casters and any symmetric law, level(x, forward) = level(-x,
/// backward); springs and dampers; white noise, any spectrum through a `ShapingFilter`, Gaussian excitation
/// with an envelope, and Poisson pulses by their second moments. The response is not Gaussian: for Coulomb friction
/// under white noise the stationary velocity variance is 21 % low and the growth of the displacement variance 51 %,
/// `WhiteNoise` is exact; with `Force::laplace` the velocity variance is exact and the growth 20 % low for equal
/// levels. With gamma = S(0)^2 / (reach a^3), while a caster breaks loose, for z of (3.30) from 5 to 0.01, its
/// displacement variance is too low by a factor that grows as gamma falls: at most 1.4 at gamma = 0.03, 3 at 0.01, 10
/// at 0.005, 40 at 0.003, 2000 at 0.001. No motion is predicted while the rms acceleration is below sqrt(2/pi) times
/// the slip level; at such times the velocity variance is 0. The remark of a prediction states which of these concern
/// it. docs/equivalent_linearization.md has measured errors.
///
/// With a structure whose interface slides (IsolatedStructure, EquipmentOnFloor), z = (x, x', y, y', filter), y its
/// modes; the rows of their rates hold the equations of the sliding structure, and friction acts on those of x' and y'
/// through the mass of the interface. While friction holds the interface its damping is so large that the structure
/// moves as if it were stuck.
///
/// In d dimensions, friction opposes the velocity vector, and the same excitation acts in each coordinate,
/// independently of the others. The linear force a22 v with the least mean-square error has
///
///     a22 = -E[|v| level] / E[|v|^2] = -sqrt(2) Gamma((d + 1) / 2) / (d Gamma(d / 2)) a / sqrt(q22)
///
/// for a Gaussian velocity, and -a / sqrt((d + 1) q22) with `Force::laplace`, for the density exp(-|v| / b) that is
/// exact under white noise. Moments are those of each coordinate, and equal to those along one axis with a slip level
/// lower by a factor of sqrt(pi) Gamma((d + 1) / 2) / (d Gamma(d / 2)), pi / 4 in the plane, or sqrt(2 / (d + 1)).
/// Covers Coulomb friction with equal levels, springs that are the same in all directions, and dampers. Under white
/// noise in the plane the stationary velocity variance is 15 % low and the growth of the displacement variance 38 %;
/// with `Force::laplace` the velocity variance is exact and the growth 14 % low.
///
/// References: W. D. Iwan, A. B. Mason, Int. J. Non-Linear Mech. 15 (1980), 71-82; T. S. Atalik, S. Utku, Earthq. Eng.
/// Struct. Dyn. 4 (1976), 411-420; S. H. Crandall, S. S. Lee, J. H. Williams, J. Appl. Mech. 41 (1974), 1094-1098.
class EquivalentLinearization {
 public:
  enum class Force {
    gaussian,      ///< Gaussian expectations of the law itself
    gaussian_a22,  ///< the same with a21 = 0, as in thesis (3.24)
    laplace,       ///< expectations by the exact density under white noise, two exponentials; Coulomb only
    thesis         ///< a level of a / (1 + (x / reach)^2), (3.28) to (3.30), and a21 = 0; Coulomb and casters only
  };
  enum class Start {
    rest,   ///< x = x' = 0
    thesis  ///< (3.38) to (3.40): a^6 q11 / S0^4 = 0.01, a^4 q12 / S0^3 = 5.4e-8, a^2 q22 / S0^2 = 1.3e-5; for white
            ///< noise without an envelope, equal levels and no damper
  };
  struct Options {
    Force force = Force::gaussian;
    Start start = Start::rest;
    double tolerance = 1e-10;     ///< approximate relative error of the results; from 1e-12 to 1e-2
    ShapingFilter::Fit filter{};  ///< for spectra other than white, Kanai-Tajimi and Clough-Penzien
    int dimensions = 1;           ///< of the motion, from 1 to 6: 2 for a block on a plane
  };

  EquivalentLinearization() : EquivalentLinearization(Options{}) {}

  /// @throws std::invalid_argument for a tolerance or a number of dimensions out of range, and for the thesis's force
  /// or start in more than one dimension
  explicit EquivalentLinearization(Options options);

  const Options& options() const noexcept { return options_; }

  /// The name, with the force and the number of dimensions unless they are the defaults.
  std::string name() const;

  /// A user-defined law is checked only at x = 0; `predict` checks it over the range of the displacement. Only
  /// `predict` determines whether a filter fits the spectrum.
  template <FrictionLaw Law, class E>
  Coverage covers(const Slider<Law>& slider, const E& excitation) const {
    return detail::coverage<ShapedNoise>(
        excitation, "EquivalentLinearization: covers white noise, spectra, GaussianExcitation and PoissonPulses",
        [&](const ShapedNoise& noise) {
          detail::require_one_level(slider, "EquivalentLinearization");
          if constexpr (PositionLaw<Law>) check(detail::linearized_law(slider.law()), slider.damping(), noise);
        });
  }

  /// The same for a structure with a sliding interface, of at most 12 modes.
  template <class E>
  Coverage covers(const SlidingStructure& system, const E& excitation) const {
    return detail::coverage<ShapedNoise>(
        excitation, "EquivalentLinearization: covers white noise, spectra, GaussianExcitation and PoissonPulses",
        [&](const ShapedNoise& noise) { check(system, noise); });
  }

  /// Means and covariances by time, from rest. Means are zero unless the levels differ.
  ///
  /// Under white noise without an envelope, unequal levels or a damper, the equations are integrated over the logarithm
  /// of time, in variables that keep the covariance positive definite at any scale: the logarithms of q11 and q22
  /// relative to those without friction, (3.41) and (3.43), and the correlation. Without friction the result is in
  /// closed form. In all other cases Q is integrated in time (only its rows of x and x' if the covariance of the filter
  /// is stationary): by backward differentiation where friction may hold the slider, otherwise by explicit steps. A
  /// velocity below sqrt(tolerance) / 10 of that at the first requested time, or of the rms acceleration over the mean
  /// rate of the filter, then counts as rest. This is about the relative error just after an abrupt start; it decays
  /// quickly.
  ///
  /// @param slider     the law, its spring and damper
  /// @param noise      level S0 of white ground acceleration, two-sided [m^2/s^3], a Spectrum, a ShapingFilter, a
  ///                   GaussianExcitation (its sampling and duration have no effect), or PoissonPulses
  /// @param times      [s], finite, at least 0, increasing
  /// @param progress  called every thousand steps; may throw to stop the work; optional
  /// @returns also the growth rate if the velocity becomes stationary: pi^5 S0^3 / (2 a^4) for Coulomb friction under
  /// white noise, (3.47), and 0 with a spring. Without a spring, a law that is constant far away, such as that of a
  /// caster with rolling resistance, has the growth rate of Coulomb friction with that level, or 0 if friction holds
  /// the slider at x = 0. NaN if the velocity does not become stationary, under an envelope, and for other laws. The
  /// remark states the misfit of a filter that is not exact
  /// @throws std::invalid_argument for times out of range, a law that is not symmetric, a case that the force does not
  /// cover, and a spectrum that no filter of the given order fits, with its misfit
  /// @throws ConvergenceError with the time reached, if the tolerance cannot be met
  /// Cost: 1 ms under white noise, otherwise 1 to 200 ms, and the fit of the filter.
  template <PositionLaw Law>
  Moments predict(const Slider<Law>& slider, const ShapedNoise& noise, std::span<const double> times,
                  const std::function<void()>& progress = {}) const {
    detail::require_one_level(slider, "EquivalentLinearization");
    return predict(detail::linearized_law(slider.law()), slider.natural_frequency(), slider.damping(), noise, times,
                   progress);
  }
  template <PositionLaw Law>
  Moments predict(const Law& law, const ShapedNoise& noise, std::span<const double> times,
                  const std::function<void()>& progress = {}) const {
    return predict(Slider<Law>(law), noise, times, progress);
  }

  /// The same of the sliding interface of a structure, from rest: an IsolatedStructure or EquipmentOnFloor of at most
  /// 12 modes, whose law depends on the position at most, without stops and not one way. Always by the covariance in
  /// time. The remark then compares the threshold of motion with the force on the interface while it is stuck.
  /// Cost: 0.03 s with one mode, 0.2 s with three, 1 s with five, 16 s with ten.
  Moments predict(const SlidingStructure& system, const ShapedNoise& noise, std::span<const double> times,
                  const std::function<void()>& progress = {}) const;

  /// The stationary moments, A Q + (A Q)^T + 2 pi S0 b b^T = 0 with the A that belongs to Q, at a single, infinite
  /// time.
  ///
  /// Without a spring only the velocity is stationary: the displacement variance is infinite if it grows (at
  /// `growth_rate`), and NaN if it does not, because it then depends on the start; the displacement mean is infinite if
  /// the levels differ. Below the threshold of motion all moments are zero.
  ///
  /// Accuracy 1e-9. Cost: 0.1 to 5 ms, and the fit of the filter.
  /// @throws std::invalid_argument if there is no stationary state, with the reason: an envelope; no spring and a level
  /// that depends on the position; no friction and no damper; friction that cannot dissipate the input power, such as a
  /// caster with a short reach
  template <PositionLaw Law>
  Moments stationary(const Slider<Law>& slider, const ShapedNoise& noise) const {
    detail::require_one_level(slider, "EquivalentLinearization");
    return stationary(detail::linearized_law(slider.law()), slider.natural_frequency(), slider.damping(), noise);
  }

  /// The same of the sliding interface of a structure.
  Moments stationary(const SlidingStructure& system, const ShapedNoise& noise) const;

  /// The equivalent linear friction for a given covariance of displacement and velocity,
  ///     a22 = -sqrt(2 / (pi q22)) E[level(x) | x' = 0],                                                (3.25)
  ///     a21 = -E[level'(x) sgn(x')],                                                                   (3.22)
  /// (3.29) and 0 for the thesis's force, -a / sqrt(2 q22) and 0 for the Laplacian. For laws other than Coulomb and
  /// caster by quadrature of the level; its slope is not needed.
  /// @param q11, q22  variances of x [m^2] and x' [m^2/s^2], positive and finite
  /// @param q12       their covariance [m^2/s], q12^2 < q11 q22
  /// @throws as `predict`
  template <PositionLaw Law>
  LinearFriction coefficients(const Law& law, double q11, double q12, double q22) const {
    return coefficients(detail::linearized_law(law), q11, q12, q22);
  }

 private:
  void check(const detail::LinearizedLaw& law, double damping, const ShapedNoise& noise) const;
  void check(const SlidingStructure& system, const ShapedNoise& noise) const;
  Moments predict(const detail::ShapedProblem& problem, std::span<const double> times,
                  const std::function<void()>& progress) const;
  Moments stationary(const detail::ShapedProblem& problem) const;
  Moments predict(const detail::LinearizedLaw& law, double natural_frequency, double damping, const ShapedNoise& noise,
                  std::span<const double> times, const std::function<void()>& progress) const;
  Moments stationary(const detail::LinearizedLaw& law, double natural_frequency, double damping,
                     const ShapedNoise& noise) const;
  LinearFriction coefficients(const detail::LinearizedLaw& law, double q11, double q12, double q22) const;

  Options options_;
};

/// The time at which a caster under white noise breaks loose, by equivalent linearization: its rms displacement then
/// equals the reach (z = 1 in (3.30)), and friction decreases.
struct TransitionTime {
  double thesis;  ///< (3.51): S0 / a^2 (1 / (pi^5 gamma^2) + pi^2 / 4) [s]. Simulated casters break loose earlier: by a
                  ///< factor of 1.1 at gamma = 0.01, 2.1 at 0.005, 3.2 at 0.003, 4.2 at 0.002 and 6.3 at 0.001
  double with_intercept;  ///< later by 47 pi^2 / 48 S0 / a^2, the delay of q11 behind (3.47) that (3.51) neglects [s]
};

/// @param slider  a caster with friction and without a spring; the times are infinite for an infinite reach. (3.51)
///                assumes a stationary velocity and is unreliable for gamma = S0^2 / (reach a^3) above 0.02
/// @param s0      level of the white noise [m^2/s^3], or a white Spectrum
/// @throws std::invalid_argument without friction, or with a spring
TransitionTime transition_time(const Slider<Caster>& slider, WhiteLevel s0);
inline TransitionTime transition_time(const Caster& law, WhiteLevel s0) {
  return transition_time(Slider<Caster>(law), s0);
}

}  // namespace stickslip::theory
