// Coulomb friction under filtered noise, replaced by an equivalent viscous damper.
#pragma once

#include <concepts>
#include <functional>
#include <span>
#include <stdexcept>
#include <string>

#include "stickslip/excitation/spectrum.hpp"
#include "stickslip/friction/coulomb.hpp"
#include "stickslip/friction/law.hpp"
#include "stickslip/slider/slider.hpp"
#include "stickslip/statistics/moments.hpp"
#include "stickslip/theory/noise.hpp"
#include "stickslip/theory/theory.hpp"

namespace stickslip::theory {

/// The result of stationary linearization: the equivalent linear system x'' + zeta x' + wn^2 x = -n(t) and its
/// response.
struct StationaryPrediction {
  double damping;           ///< zeta_eq [1/s], thesis (4.20); infinite if no motion is predicted
  double velocity_std;      ///< [m/s], thesis (4.9); infinite without friction if the ground velocity is not stationary
  double displacement_std;  ///< of the stationary solution [m], thesis (4.12); infinite if there is none
  double growth_rate;  ///< final growth rate of the displacement variance [m^2/s], thesis (4.13); 0 if it does not grow
                       ///< or grows more slowly than time, infinite if it grows faster
  std::string remark;  ///< limits on the reliability of the values; empty if none

  Spectrum spectrum;         ///< of the ground acceleration
  double natural_frequency;  ///< wn [rad/s]

  /// Two-sided spectral density of the stationary velocity [m^2/s]: (m/s)^2 for each rad/s; thesis (4.8),
  ///     S(omega) / (omega^2 + zeta^2),   with a spring S omega^2 / ((omega^2 - wn^2)^2 + zeta^2 omega^2)
  /// Its integral over the whole line is velocity_std^2.
  /// @param omega  [rad/s], of either sign
  double velocity_spectrum(double omega) const;

  /// Exact transient moments of the linear system from rest at x = 0, as a simulation of it would give.
  ///     E[x_i x_j] = integral of S(omega) A_i A_j^* d omega,  A_i(omega) = int_0^t h_i(u) exp(-i omega u) du,   (4.5)
  /// with the impulse responses h. The velocity becomes stationary. Without a spring the displacement does not: after a
  /// start from rest it keeps the offset (initial ground velocity) / zeta, and its variance tends to displacement_std^2
  /// + (ground velocity variance) / zeta^2.
  /// @param times      [s], finite and at least 0, in any order
  /// @param progress  called at each time; may throw to stop the work; optional
  /// @throws std::invalid_argument  a time out of its range
  /// @throws ConvergenceError       a spectrum that cannot be integrated
  /// Accuracy: within 1e-8 of the values. Cost: about 0.3 to 2 ms for each time, independent of the time.
  Moments transient(std::span<const double> times, const std::function<void()>& progress = {}) const;
};

/// Stationary equivalent linearization of Coulomb friction under stationary Gaussian ground acceleration, thesis 4.3.
///
///     x'' + a sgn(x') + wn^2 x = -n(t)   by   x'' + zeta x' + wn^2 x = -n(t),                      thesis (4.1), (4.2)
///     zeta = sqrt(2/pi) a / sigma_v,   sigma_v^2 = int S(omega) / (omega^2 + zeta^2) d omega       (4.19), (4.20)
///
/// (with a spring S omega^2 / ((omega^2 - wn^2)^2 + zeta^2 omega^2)): the damper equivalent to friction on
/// average if the velocity were Gaussian. With G(zeta) = zeta^2 sigma_v^2(zeta), which rises with zeta from 0 to
/// sigma_n^2, this is G(zeta) = 2 a^2 / pi: there is one solution where sigma_n / a > sqrt(2/pi), (4.22), and none
/// below, where the method predicts no motion. The solution is bracketed, because the iteration (4.41) converges too
/// slowly near that threshold and cycles for bands far from zero.
///
/// Measured range: without a spring, or on one whose natural frequency exceeds those of at most a quarter of the
/// variance of the ground acceleration, the standard deviation of the velocity is right within 16 % from sigma_n / a
/// = 1.2 on, within 21 % under Kanai-Tajimi noise with a damping ratio above 0.9; on a stiffer spring it is too low,
/// down to 0.5 of the simulated one at 1.2 and 0.8 at 3. The displacement is wrong if the acceleration has no content at zero frequency: friction generates such content, so that x drifts,
/// which the linear system cannot reproduce. On a spring the displacement is too small until sigma_n is about four
/// times a. See docs/filtered_noise.md for numbers.
///
/// Reference: thesis 4.3; C. K. Constantinou, I. G. Tadjbakhsh, J. Struct. Eng. 110 (1984).
class StationaryLinearization {
 public:
  static std::string name() { return "StationaryLinearization"; }

  template <FrictionLaw Law, class E>
  Coverage covers(const Slider<Law>& slider, const E& excitation) const {
    return detail::coverage<StationaryNoise>(
        excitation, "StationaryLinearization: covers stationary Gaussian ground acceleration",
        [&](const StationaryNoise&) {
          if constexpr (std::same_as<Law, Coulomb>)
            check(slider);
          else
            throw std::invalid_argument(
                "StationaryLinearization: covers Coulomb friction, with or without a spring; a level that depends on "
                "the position has no stationary one");
        });
  }

  /// @param slider    Coulomb friction with equal levels, with or without a spring
  /// @param spectrum  of the ground acceleration; or an object that has one: a GaussianExcitation, a level of white
  /// noise
  /// @throws std::invalid_argument  unequal levels: friction then has a mean, and the slider drifts
  /// @throws ConvergenceError       a spectrum that cannot be integrated
  /// Accuracy: round-off for band-pass and white noise without a spring, else that of quadrature, 1e-9. Cost: 1 us, or
  /// 0.1 to 10 ms.
  StationaryPrediction predict(const Slider<Coulomb>& slider, const Spectrum& spectrum) const;
  StationaryPrediction predict(const Coulomb& law, const Spectrum& spectrum) const {
    return predict(Slider(law), spectrum);
  }
  StationaryPrediction predict(const Slider<Coulomb>& slider, const StationaryNoise& noise) const {
    return predict(slider, noise.spectrum());
  }

  /// The linear system from rest, `StationaryPrediction::transient`.
  Moments predict(const Slider<Coulomb>& slider, const StationaryNoise& noise, std::span<const double> times,
                  const std::function<void()>& progress = {}) const {
    return predict(slider, noise).transient(times, progress);
  }

  /// The factor by which the ground acceleration would have to be multiplied to be at the threshold of motion,
  /// sqrt(2/pi) a / sigma_n, thesis (4.22). If it is 1 or more, the method predicts no motion; 0 for white noise.
  double threshold(const Slider<Coulomb>& slider, const StationaryNoise& noise) const;
  double threshold(const Coulomb& law, const StationaryNoise& noise) const { return threshold(Slider(law), noise); }

  /// Other laws are not covered. A law that depends on the position has no stationary linearization, because x has no
  /// stationary variance. (Generalized linearization, in time, covers casters.)
  template <FrictionLaw Law>
  StationaryPrediction predict(const Slider<Law>&, const Spectrum&) const = delete;
  template <FrictionLaw Law>
  StationaryPrediction predict(const Law&, const Spectrum&) const = delete;

 private:
  static void check(const Slider<Coulomb>& slider);
};

}  // namespace stickslip::theory
