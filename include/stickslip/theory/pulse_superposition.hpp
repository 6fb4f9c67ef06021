// Superposition of Poisson pulses, each of which is assumed to find the slider at rest.
#pragma once

#include <cmath>
#include <concepts>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "stickslip/excitation/poisson.hpp"
#include "stickslip/friction/coulomb.hpp"
#include "stickslip/friction/law.hpp"
#include "stickslip/slider/slider.hpp"
#include "stickslip/state/state.hpp"
#include "stickslip/statistics/moments.hpp"
#include "stickslip/theory/displacement_distribution.hpp"
#include "stickslip/theory/pulse_response.hpp"
#include "stickslip/theory/theory.hpp"

namespace stickslip::detail {

/// The effect of a pulse of amplitude b [m/s^2] on a slider at rest at x [m].
struct PulseEffect {
  double offset;           ///< [m], infinite if the slider never stops
  double velocity_square;  ///< integral of x'^2 [m^2/s]
};

/// A point at which a motion with piecewise constant acceleration changes its acceleration.
struct PulseKnot {
  double time;
  Ride ride;
};

/// The properties of a slider that the superposition uses.
struct PulseSystem {
  bool constant_level;
  std::function<double(double, Direction)> level;          ///< (x, direction) [m/s^2]
  std::function<PulseEffect(double, double)> effect;       ///< (b, x)
  std::function<std::vector<PulseKnot>(double)> motion{};  ///< (b), from rest, under Coulomb friction alone
};

}  // namespace stickslip::detail

namespace stickslip::theory {

/// Treatment of pulses that overlap.
enum class Overlap {
  none,    ///< each pulse acts alone: thesis (5.34), (5.40)
  thesis,  ///< pulses that begin within dt of each other form a composite: (5.52) to (5.55) as printed
  renewal  ///< the same, corrected: a composite uses 1 + lambda dt pulses, so that composites are rarer by this
           ///< factor (errata to 5.52)
};

/// Superposition of the responses to single pulses, thesis 5.3:
///     E[x'^2] = lambda E[int v^2],  d/dt Var[x] = lambda E[dx^2],  d/dt E[x] = lambda E[dx]       (5.25), (5.28)
/// averaged over the distribution of amplitudes p(b); with overlaps, over composites of m + 1 pulses with the rms
/// amplitude sqrt(m + 1) sigma and the probability P(m; lambda dt) of (5.51).
///
/// Asymptotic in time: (5.38), (5.39) require t >> 4 dt; `from_rest` uses (5.25), (5.28) at any time. Accurate if
/// pulses are rare, lambda dt << 1, and exact for a frictionless slider with `none` and `renewal`. Otherwise the growth
/// rate is wrong by a factor: for lambda dt from 0.05 to 2 it is 1e-4 to 0.24 times the simulated one at sigma / a =
/// 1/3, and 1.02 to 7.5 times at 5. `PulseChain` is better for Coulomb friction.
///
/// Covers any friction law without a spring, unequal slip levels, any pulse shape after which the slider stops,
/// and with `none` any distribution of amplitudes, with any mean. With an envelope, the growth rate is integrated over
/// the strength (constant slip levels only). If the slip level depends on the position (Caster), the moments of the
/// effect of a pulse are functions of x: the moment equations
///     d/dt E[x] = E[r1(x)],  d/dt Var[x] = 2 Cov[x, r1(x)] + E[r2(x)],   rk(x) = lambda E[dx^k | x]
/// are closed by a Gaussian distribution of x, and `growth_rate` is that at x = 0. A caster escapes if its friction can
/// no longer stop it, because of pulses that overlap or after many pulses; the moments of this theory do not show this.
/// Before it returns anything, the theory therefore determines for the whole excitation (and for later times, if given)
/// the effect of overlaps on a block with the same level, by `PulseChain`, and the distance that the slider reaches. A
/// caster that escapes is rejected; if overlaps matter, `remark` states the factor. docs/pulse_superposition.md has the
/// conditions. For 231 simulated casters, all predictions that are returned are within 45 % of the rms, after that
/// factor.
///
/// Reference: thesis 5.3; Y. K. Lin, Probabilistic Theory of Structural Dynamics (1967), pp. 87-94.
class PulseSuperposition {
 public:
  /// Above this lambda dt the overlap series describes a single endless composite; it is rejected.
  static constexpr double max_overlap = 1e6;

  explicit PulseSuperposition(Overlap overlap = Overlap::renewal) : overlap_(overlap) {}

  Overlap overlap() const noexcept { return overlap_; }

  std::string name() const;

  /// Only `predict` determines whether a caster escapes.
  template <FrictionLaw Law, class E>
  Coverage covers(const Slider<Law>& slider, const E& excitation) const {
    return detail::coverage<PoissonPulses>(excitation, "PulseSuperposition: covers PoissonPulses",
                                           [&](const PoissonPulses& pulses) { check(slider, pulses); });
  }

  /// @param slider  without a spring
  /// @param pulses  the excitation
  /// @param times   of the moments [s], finite, at least 0
  /// @param progress  called regularly; may throw to stop the work; optional
  /// @return moments; velocities are stationary, `growth_rate` NaN under an envelope. `remark` states that times are
  ///         too short, that nothing slips and why, the factor by which overlaps matter for a caster, and the fraction
  ///         of pulses that would make it escape
  /// @throws std::invalid_argument naming what is not covered or the rejected value, and why a caster escapes within
  ///         the excitation, for any times
  /// Coulomb friction: integrals over the amplitudes to 1e-13; 20 to 60 us. Casters: 0.1 to 10 s, most for a large
  /// displacement variance.
  template <PositionLaw Law>
  Moments predict(const Slider<Law>& slider, const PoissonPulses& pulses, std::span<const double> times,
                  const std::function<void()>& progress = {}) const {
    check(slider, pulses);
    return predict(system(slider, pulses), pulses, times, progress);
  }

  /// Moments at any time from rest on, by Campbell's theorem. With z(u, b) the response to a pulse that began u ago,
  ///     E[x(t)] = lambda E[int_0^t z du],  Var[x(t)] = lambda E[int_0^t z^2 du],                 (5.25), (5.28)
  /// likewise with z' for the velocity, and Cov[x, x'] = lambda E[z(t)^2] / 2, (5.59). Overlapping responses are added:
  /// exact for lambda dt -> 0 at every time, and without friction with `none`. At large times the moments tend to the
  /// lines of `predict`.
  /// @param slider  Coulomb friction without a spring, unequal slip levels too
  /// @param pulses  without an envelope; no pulse arrives before time zero
  /// @param times   of the moments [s], finite, at least 0
  /// @param progress  called regularly; may throw to stop the work; optional
  /// @throws std::invalid_argument naming what is not covered or the rejected value
  /// Integrals over time in closed form, over the amplitudes to 1e-5; 0.1 to 1 ms, and about 10 us for each time.
  Moments from_rest(const Slider<Coulomb>& slider, const PoissonPulses& pulses, std::span<const double> times,
                    const std::function<void()>& progress = {}) const {
    check(slider, pulses);
    return from_rest(system(slider, pulses), pulses, times, progress);
  }

  /// Above this lambda dt `distribution` is not covered.
  static constexpr double max_overlap_of_distribution = 0.1;

  /// The distribution of the displacement at a time. Pulses arrive independently, and each pulse that exceeds the slip
  /// level adds its offset, so that x is a compound Poisson sum with the mean and variance of `predict`,
  ///     E[exp(iux)] = exp(lambda t E[exp(iu dx) - 1])
  /// With overlaps the sum is over composites, which arrive at the rate lambda / (1 + lambda dt) (`renewal`).
  ///
  /// Exact for lambda dt -> 0 and t >> 4 dt. `detail::pulse_accuracy().rare` states the errors due to overlaps; where
  /// they change the standard deviation by more than 5 %, `remark` of the result gives the factor, found with
  /// `PulseChain`.
  /// @param slider  with constant slip levels, which may differ, without a spring
  /// @param pulses  without an envelope, lambda dt at most 0.1
  /// @param time    [s], finite and at least 0
  /// @throws std::invalid_argument naming what is not covered or the rejected value; also if overlaps change the
  ///         standard deviation by more than a factor of 2
  /// Takes some 30 ms.
  template <PositionLaw Law>
  DisplacementDistribution distribution(const Slider<Law>& slider, const PoissonPulses& pulses, double time) const {
    check(slider, pulses);
    return distribution(system(slider, pulses), pulses, time);
  }

  /// (E[x^2(t_d)])^(1/2) at the end of the motion, t_d = pulses.duration() [m], thesis 5.6 and figure 5.7.
  template <PositionLaw Law>
  double final_rms(const Slider<Law>& slider, const PoissonPulses& pulses,
                   const std::function<void()>& progress = {}) const {
    const double end[] = {pulses.duration()};
    const Moments moments = predict(slider, pulses, end, progress);
    return std::hypot(std::sqrt(moments.displacement_variance.value[0]), moments.displacement_mean.value[0]);
  }

 private:
  template <PositionLaw Law>
  static detail::PulseSystem system(const Slider<Law>& slider, const PoissonPulses& pulses) {
    std::function<std::vector<detail::PulseKnot>(double)> motion;
    if constexpr (std::same_as<Law, Coulomb>)
      motion = [&slider, &pulses](double b) {
        std::vector<detail::PulseKnot> knots;
        detail::ride(slider, pulses.options().shape, b, pulses.half_width(), 0,
                     [&](double time, const detail::Ride& ride) {
                       knots.push_back({time, ride});
                     });
        return knots;
      };
    return {form_of<Law> == Form::constant,
            [&slider](double x, Direction direction) { return slider.law().resist(x, direction); },
            [&slider, &pulses](double b, double x) {
              try {
                const detail::Ride end = detail::ride(slider, pulses.options().shape, b, pulses.half_width(), x);
                return detail::PulseEffect{end.state.displacement - x, end.velocity_square};
              } catch (const ConvergenceError&) {  // where the slip level is practically zero
                return detail::PulseEffect{std::numeric_limits<double>::infinity(), 0};
              }
            },
            std::move(motion)};
  }

  template <FrictionLaw Law>
  void check(const Slider<Law>& slider, const PoissonPulses& pulses) const {
    detail::require_no_spring(slider.natural_frequency(), "PulseSuperposition");
    detail::require_plain(slider, "PulseSuperposition");
    check(form_of<Law> == Form::constant, pulses);
  }
  void check(bool constant_level, const PoissonPulses& pulses) const;
  Moments predict(const detail::PulseSystem& system, const PoissonPulses& pulses, std::span<const double> times,
                  const std::function<void()>& progress) const;
  Moments from_rest(const detail::PulseSystem& system, const PoissonPulses& pulses, std::span<const double> times,
                    const std::function<void()>& progress) const;
  DisplacementDistribution distribution(const detail::PulseSystem& system, const PoissonPulses& pulses,
                                        double time) const;

  Overlap overlap_;
};

/// The quantile of the peak of Brownian motion without drift, with the variance growth_rate t: the L with
///     P(|x| <= L on [0, T]) = (4 / pi) sum_k (-1)^k / (2k+1) exp(-(2k+1)^2 pi^2 growth_rate T / (8 L^2)) = probability
/// and by images (reflections) where this series converges slowly. For a slider this is an estimate: its displacement
/// resembles Brownian motion only over many slips, and the motion out and back within a pulse is left out. With the
/// growth rate of `PulseChain`, the ratio to the peak that 5 % of blocks exceed in the thesis's four events is 0.96 to
/// 0.99 for sigma / a from 0.5 to 5 in the great events (60 s), 0.89 to 0.98 in the moderate ones (15 s), and 0.88 to
/// 1.32 down to sigma / a = 0.2. Below that fewer than 5 % may slip at all, and the estimate has no meaning.
/// `PulseChain::peak` is more accurate, also at other probabilities.
/// @param growth_rate  of the displacement variance [m^2/s], finite and at least 0
/// @param duration     T [s], finite and at least 0
/// @param probability  that the peak is not exceeded, in (0, 1)
/// @return L [m], to a relative 1e-14
/// @throws std::invalid_argument naming the value
/// Reference: W. Feller, An Introduction to Probability Theory and Its Applications, vol. 2 (1971), X.5.
double peak_from_growth(double growth_rate, double duration, double probability);

}  // namespace stickslip::theory
