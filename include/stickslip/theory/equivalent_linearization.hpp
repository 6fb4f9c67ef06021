// Generalized equivalent linearization: the transient covariance of a slider under shaped noise.
#pragma once

#include <concepts>
#include <functional>
#include <span>
#include <string>
#include <variant>

#include "stickslip/detail/equal.hpp"
#include "stickslip/friction/caster.hpp"
#include "stickslip/friction/coulomb.hpp"
#include "stickslip/friction/law.hpp"
#include "stickslip/slider.hpp"
#include "stickslip/statistics/moments.hpp"
#include "stickslip/theory/noise.hpp"
#include "stickslip/theory/shaping_filter.hpp"
#include "stickslip/theory/theory.hpp"

namespace stickslip::detail {

/// A law as the library takes it in: the two that it has closed forms for, of casters those without rolling
/// resistance, or the level of any other.
using LinearizedLaw = std::variant<Coulomb, Caster, std::function<double(double, Direction)>>;

template <PositionLaw Law>
LinearizedLaw linearized_law(const Law& law) {
  if constexpr (std::same_as<Law, Coulomb>) {
    return law;
  } else {
    if constexpr (std::same_as<Law, Caster>)
      if (equal(law.rolling(), 0)) return law;
    return [law](double x, Direction direction) -> double { return law.resist(x, direction); };
  }
}

}  // namespace stickslip::detail

namespace stickslip::theory {

/// The friction of the equivalent linear system, x'' = a21 x + a22 x', thesis (3.2).
struct LinearFriction {
  double a21;  ///< stiffness that friction lends or takes [1/s^2]; the spring's is apart
  double a22;  ///< damping, not positive [1/s]
};

/// Generalized equivalent linearization, thesis 3.3 and 3.4, for excitation that is neither white nor stationary. At
/// each time the friction is replaced by the linear force nearest to it in the mean square. With the states of the
/// filter that shapes the excitation, z = (x, x', filter), the covariance Q about the mean m follows
///
///     Q' = A Q + (A Q)^T + 2 pi S0 b b^T                                                                 (3.9)
///     m_x' = m_v,   m_v' = -E F - c m_v - wn^2 m_x,   F = level sgn(x')
///
/// where the row of x' in A has -wn^2 + a21, -c + a22 and the acceleration of the filter, times the envelope, and
/// [a21 a22] = -E[(F - E F) (x - m_x, x' - m_v)] Cov^-1, (3.5) corrected. Under white noise these are
///
///     q11' = 2 q12                                                                                      (3.32)
///     q12' = (a21 - wn^2) q11 + a22 q12 + q22                                                (3.33) corrected
///     q22' = 2 (a21 - wn^2) q12 + 2 a22 q22 + 2 pi S0                                        (3.34) corrected
///
/// The thesis takes a21 for zero (3.24), which it is only where x and x' are uncorrelated, and simplifies a caster's
/// level (3.28).
///
/// Covers Coulomb friction, also of unequal levels, casters and any law that is the same both ways, level(x, forward) =
/// level(-x, backward); springs and dampers; white noise, any spectrum through a `ShapingFilter`, Gaussian excitation
/// with an envelope, and Poisson pulses by their second moments. The response is not Gaussian: for Coulomb friction
/// under white noise the stationary velocity variance is 21 % low and the growth of the displacement variance 51 %, see
/// `WhiteNoise` for what is exact; `Force::laplace` has the velocity variance exactly and 20 % too little growth. For
/// casters of small gamma = S0^2 / (reach a^3) the displacement variance is low by a factor of three while they break
/// loose. Where the rms acceleration is below sqrt(2/pi) times the slip level no motion is predicted at all.
/// docs/equivalent_linearization.md has the errors by measurement.
///
/// References: W. D. Iwan, A. B. Mason, Int. J. Non-Linear Mech. 15 (1980), 71-82; T. S. Atalik, S. Utku, Earthq. Eng.
/// Struct. Dyn. 4 (1976), 411-420; S. H. Crandall, S. S. Lee, J. H. Williams, J. Appl. Mech. 41 (1974), 1094-1098.
class EquivalentLinearization {
 public:
  enum class Force {
    gaussian,      ///< Gaussian expectations of the law itself
    gaussian_a22,  ///< the same, but a21 = 0: (3.24) as the thesis has it
    laplace,       ///< expectations by the density that white noise makes exactly, two exponentials; Coulomb only
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
    double tolerance = 1e-10;     ///< about the relative error of the answers; from 1e-12 to 1e-2
    ShapingFilter::Fit filter{};  ///< for spectra other than white, Kanai-Tajimi and Clough-Penzien
  };

  EquivalentLinearization() : EquivalentLinearization(Options{}) {}

  /// @throws std::invalid_argument for a tolerance out of its range
  explicit EquivalentLinearization(Options options);

  const Options& options() const noexcept { return options_; }

  /// With the force where it is not the usual one.
  std::string name() const;

  /// A law of your own is looked at where x = 0; `predict` looks at it as far as the slider goes. Whether a filter fits
  /// the spectrum only `predict` finds.
  template <FrictionLaw Law, class E>
  Coverage covers(const Slider<Law>& slider, const E& excitation) const {
    return detail::coverage<ShapedNoise>(
        excitation, "EquivalentLinearization: covers white noise, spectra, GaussianExcitation and PoissonPulses",
        [&](const ShapedNoise& noise) {
          detail::require_one_level(slider, "EquivalentLinearization");
          if constexpr (PositionLaw<Law>) check(detail::linearized_law(slider.law()), slider.damping(), noise);
        });
  }

  /// Means and covariances by time, from rest. Means are zero but for unequal levels.
  ///
  /// Under white noise without envelope, unequal levels and damper integrated over the logarithm of time, in variables
  /// that keep the covariance positive definite: the logarithms of q11 and q22 relative to those without friction,
  /// (3.41) and (3.43), and the correlation. So any scale will do. A slider without friction is answered in closed form
  /// there. Otherwise Q is integrated in time, its rows of x and x' alone where the filter's own covariance stays
  /// stationary: by backward differentiation where friction may hold the slider, by explicit steps elsewhere. A
  /// velocity of sqrt(tolerance) / 10 of that at the first time asked for, or of the rms acceleration over the filter's
  /// mean rate, then counts as rest, which is about the relative error just after an abrupt start, and soon fades.
  ///
  /// @param slider     the law, its spring and damper
  /// @param noise      level S0 of white ground acceleration, two-sided [m^2/s^3], a Spectrum, a ShapingFilter, a
  ///                   GaussianExcitation, whose sampling and duration do not matter, or PoissonPulses
  /// @param times      [s], finite, at least 0, increasing
  /// @param progress  called every thousand steps; may throw to stop the work; optional
  /// @returns also the growth rate where the velocity becomes stationary: pi^5 S0^3 / (2 a^4) for Coulomb friction
  /// under white noise, (3.47), and 0 with a spring that holds the displacement; NaN where it does not, under an
  /// envelope, or for other laws. The remark has the misfit of a filter that is not exact
  /// @throws std::invalid_argument for times out of range, a law that is not the same both ways, what the force does
  /// not cover, and a spectrum that no filter of the order asked for fits, with its misfit
  /// @throws ConvergenceError with the time reached where the tolerance is out of reach
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

  /// The stationary moments, A Q + (A Q)^T + 2 pi S0 b b^T = 0 with the A that Q asks for, at one time, infinity.
  ///
  /// Without a spring the velocity alone is stationary: the displacement variance is infinite where it grows, at
  /// `growth_rate`, and NaN where it does not, for then it depends on the start; the displacement mean is infinite
  /// where levels differ. Below the threshold of motion all is zero.
  ///
  /// @throws std::invalid_argument where there is none, with the reason: an envelope; no spring and a level that
  /// depends on the position; no friction and no damper; friction that cannot hold what the noise gives, as of a caster
  /// whose reach is too short Accuracy 1e-9. Cost: 0.1 to 5 ms, and the fit of the filter.
  template <PositionLaw Law>
  Moments stationary(const Slider<Law>& slider, const ShapedNoise& noise) const {
    detail::require_one_level(slider, "EquivalentLinearization");
    return stationary(detail::linearized_law(slider.law()), slider.natural_frequency(), slider.damping(), noise);
  }

  /// The equivalent linear friction where displacement and velocity have the covariance given,
  ///     a22 = -sqrt(2 / (pi q22)) E[level(x) | x' = 0],                                                (3.25)
  ///     a21 = -E[level'(x) sgn(x')],                                                                   (3.22)
  /// (3.29) and 0 by the thesis's force, -a / sqrt(2 q22) and 0 by the Laplacian. For laws other than Coulomb and
  /// caster by quadrature of the level alone, whose slope is not needed.
  /// @param q11, q22  variances of x [m^2] and x' [m^2/s^2], positive and finite
  /// @param q12       their covariance [m^2/s], q12^2 < q11 q22
  /// @throws as `predict`
  template <PositionLaw Law>
  LinearFriction coefficients(const Law& law, double q11, double q12, double q22) const {
    return coefficients(detail::linearized_law(law), q11, q12, q22);
  }

 private:
  void check(const detail::LinearizedLaw& law, double damping, const ShapedNoise& noise) const;
  Moments predict(const detail::LinearizedLaw& law, double natural_frequency, double damping, const ShapedNoise& noise,
                  std::span<const double> times, const std::function<void()>& progress) const;
  Moments stationary(const detail::LinearizedLaw& law, double natural_frequency, double damping,
                     const ShapedNoise& noise) const;
  LinearFriction coefficients(const detail::LinearizedLaw& law, double q11, double q12, double q22) const;

  Options options_;
};

/// When a caster under white noise breaks loose, by equivalent linearization: its rms displacement has then come to the
/// reach (z = 1 in (3.30)) and friction fades.
struct TransitionTime {
  double thesis;          ///< (3.51): S0 / a^2 (1 / (pi^5 gamma^2) + pi^2 / 4) [s]
  double with_intercept;  ///< later by 47 pi^2 / 48 S0 / a^2, the delay of q11 behind (3.47), which (3.51) drops [s]
};

/// @param slider  a caster without a spring, of some friction; infinite for an infinite reach. gamma = S0^2 / (reach
///                a^3); (3.51) counts on a stationary velocity, and says little for gamma over 0.02
/// @param s0      level of the white noise [m^2/s^3], or a white Spectrum
/// @throws std::invalid_argument without friction, or with a spring
TransitionTime transition_time(const Slider<Caster>& slider, WhiteLevel s0);
inline TransitionTime transition_time(const Caster& law, WhiteLevel s0) {
  return transition_time(Slider<Caster>(law), s0);
}

}  // namespace stickslip::theory
