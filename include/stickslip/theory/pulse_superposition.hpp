// Poisson pulses as if each found the slider at rest.
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
#include "stickslip/slider.hpp"
#include "stickslip/state.hpp"
#include "stickslip/statistics/moments.hpp"
#include "stickslip/theory/displacement_distribution.hpp"
#include "stickslip/theory/pulse_response.hpp"
#include "stickslip/theory/theory.hpp"

namespace stickslip::detail {

/// What a pulse of amplitude b [m/s^2] leaves of a slider that lay at x [m].
struct PulseEffect {
  double offset;           ///< [m], infinite where it never stops
  double velocity_square;  ///< integral of x'^2 [m^2/s]
};

/// Where a motion of constant accelerations begins another one.
struct PulseKnot {
  double time;
  Ride ride;
};

/// A slider as the superposition sees it.
struct PulseSystem {
  bool constant_level;
  std::function<double(double, Direction)> level;          ///< (x, direction) [m/s^2]
  std::function<PulseEffect(double, double)> effect;       ///< (b, x)
  std::function<std::vector<PulseKnot>(double)> motion{};  ///< (b), from rest, under Coulomb friction alone
};

}  // namespace stickslip::detail

namespace stickslip::theory {

/// How pulses that overlap are counted.
enum class Overlap {
  none,    ///< each acts alone: thesis (5.34), (5.40)
  thesis,  ///< those that begin within dt of another's begin are one with it: (5.52) to (5.55) as printed
  renewal  ///< the same, corrected: each composite takes up 1 + lambda dt pulses, so they come 1 + lambda dt times
           ///< more rarely (errata to 5.52)
};

/// Superposition of the responses to single pulses, thesis 5.3:
///     E[x'^2] = lambda E[int v^2],  d/dt Var[x] = lambda E[dx^2],  d/dt E[x] = lambda E[dx]       (5.25), (5.28)
/// over the amplitudes' law p(b); with overlaps, of sqrt(m + 1) sigma and the probability P(m; lambda dt) of (5.51).
///
/// Asymptotic in time: (5.38), (5.39) ask for t >> 4 dt; `from_rest` is (5.25), (5.28) themselves. Right where pulses
/// are rare, lambda dt << 1, and exact for a frictionless slider with `none` and `renewal`; else off by factors, down
/// to 1/4000 (`none`) and 1/14 (the others) of the growth rate at sigma / a = 1/3, up to 3.7 times (`thesis`) at 5.
/// `PulseChain` is better for Coulomb friction.
///
/// Covers any friction law without a spring, unequal slip levels, any pulse shape that lets the slider stop, and with
/// `none` any law of amplitudes, of any mean. An envelope of the pulses: the growth is integrated over its strength
/// (constant slip levels only). Where the slip level depends on the position (Caster), the moments of a pulse's effect
/// are functions of x: the equations of the moments
///     d/dt E[x] = E[r1(x)],  d/dt Var[x] = 2 Cov[x, r1(x)] + E[r2(x)],   rk(x) = lambda E[dx^k | x]
/// are closed by a Gaussian law of x, and `growth_rate` is that at x = 0. A caster escapes where its friction can no
/// longer stop it, by pulses that overlap or by the last ones of many; no moment of this theory says so. Hence, before
/// anything is answered, it is asked for all of the excitation (and for later times, where there are any) what the
/// overlaps do to a block of the same level, by `PulseChain`, and how far the slider comes: where it escapes it is
/// refused, where the overlaps matter `remark` has the factor by which they do. docs/pulse_superposition.md has the
/// conditions; of 231 casters that were simulated, all that is answered is within 45 % of the rms, after that factor.
///
/// Reference: thesis 5.3; Y. K. Lin, Probabilistic Theory of Structural Dynamics (1967), pp. 87-94.
class PulseSuperposition {
 public:
  /// Above this lambda dt the overlap series describes one never-ending composite, and is refused.
  static constexpr double max_overlap = 1e6;

  explicit PulseSuperposition(Overlap overlap = Overlap::renewal) : overlap_(overlap) {}

  Overlap overlap() const noexcept { return overlap_; }

  std::string name() const;

  /// Whether a caster escapes is found by `predict` alone.
  template <FrictionLaw Law, class E>
  Coverage covers(const Slider<Law>& slider, const E& excitation) const {
    return detail::coverage<PoissonPulses>(excitation, "PulseSuperposition: covers PoissonPulses",
                                           [&](const PoissonPulses& pulses) { check(slider, pulses); });
  }

  /// @param slider  without a spring
  /// @param pulses  the excitation
  /// @param times   where to answer [s], finite, at least 0
  /// @param progress  called regularly; may throw to stop the work; optional
  /// @return moments; velocities are stationary, `growth_rate` NaN under an envelope. `remark` says where times are too
  ///         short, where nothing slips and why, by how much overlaps are missed for a caster, and which share of the
  ///         pulses would carry it off
  /// @throws std::invalid_argument naming what is not covered or the value refused, and why a caster escapes within the
  ///         excitation, whatever the times are
  /// Integrals over the amplitudes to 1e-13, Coulomb; 20 to 60 us. A caster takes 0.1 to 10 s, most where it spreads
  /// far.
  template <PositionLaw Law>
  Moments predict(const Slider<Law>& slider, const PoissonPulses& pulses, std::span<const double> times,
                  const std::function<void()>& progress = {}) const {
    check(slider, pulses);
    return predict(system(slider, pulses), pulses, times, progress);
  }

  /// Moments at any time from rest on, Campbell's theorem: with z(u, b) the response to a pulse that began u ago,
  ///     E[x(t)] = lambda E[int_0^t z du],  Var[x(t)] = lambda E[int_0^t z^2 du],                         (5.25),
  ///     (5.28)
  /// the same of z' for the velocity, and Cov[x, x'] = lambda E[z(t)^2] / 2, (5.59). Responses that overlap are added:
  /// exact for lambda dt -> 0 at every time, and without friction with `none`. Late ones tend to the lines of
  /// `predict`.
  /// @param slider  Coulomb friction without a spring, unequal slip levels too
  /// @param pulses  without an envelope, from rest as if no pulse had arrived before time zero
  /// @param times   where to answer [s], finite, at least 0
  /// @param progress  called regularly; may throw to stop the work; optional
  /// @throws std::invalid_argument naming what is not covered or the value refused
  /// Integrals over time in closed form, over the amplitudes to 1e-5; 0.1 to 1 ms, and some 10 us for each time.
  Moments from_rest(const Slider<Coulomb>& slider, const PoissonPulses& pulses, std::span<const double> times,
                    const std::function<void()>& progress = {}) const {
    check(slider, pulses);
    return from_rest(system(slider, pulses), pulses, times, progress);
  }

  /// Above this lambda dt `distribution` is refused.
  static constexpr double max_overlap_of_distribution = 0.1;

  /// The distribution of the displacement at a time: pulses come independently, each that exceeds the slip level adds
  /// its offset, so that x is a compound Poisson sum. With its mean and variance those of `predict`,
  ///     E[exp(iux)] = exp(lambda t E[exp(iu dx) - 1])
  /// with overlaps, of composites as they come: lambda / (1 + lambda dt) of them a second (`renewal`).
  ///
  /// Exact for lambda dt -> 0 and t >> 4 dt; docs/pulse_superposition.md has the errors measured up to lambda dt = 0.1.
  /// @param slider  of constant slip levels, which may be unequal, without a spring
  /// @param pulses  without an envelope, lambda dt at most 0.1
  /// @param time    [s], finite and at least 0
  /// @throws std::invalid_argument naming what is not covered or the value refused
  /// Takes 10 to 25 ms.
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
    return {ConstantLevelLaw<Law>,
            [&slider](double x, Direction direction) { return slider.law().resist(x, direction); },
            [&slider, &pulses](double b, double x) {
              try {
                const detail::Ride end = detail::ride(slider, pulses.options().shape, b, pulses.half_width(), x);
                return detail::PulseEffect{end.state.displacement - x, end.velocity_square};
              } catch (const ConvergenceError&) {  // where the slip level is as good as zero
                return detail::PulseEffect{std::numeric_limits<double>::infinity(), 0};
              }
            },
            std::move(motion)};
  }

  template <FrictionLaw Law>
  void check(const Slider<Law>& slider, const PoissonPulses& pulses) const {
    detail::require_no_spring(slider.natural_frequency(), "PulseSuperposition");
    detail::require_plain(slider, "PulseSuperposition");
    check(ConstantLevelLaw<Law>, pulses);
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

/// The peak that Brownian motion without drift, whose variance is growth_rate t, does not exceed with a probability:
/// the L with
///     P(|x| <= L on [0, T]) = (4 / pi) sum_k (-1)^k / (2k+1) exp(-(2k+1)^2 pi^2 growth_rate T / (8 L^2)) = probability
/// and by images (reflections) where this converges slowly. For a slider an estimate: its displacement is Brownian
/// motion only over many slips, and the way out and back within a pulse comes on top. Of the peak that 5 % of blocks
/// exceed in the thesis's four events it is, with the growth by `PulseChain`, 0.96 to 0.99 for sigma / a from 0.5 to 5
/// in the great events (60 s), 0.89 to 0.98 in the moderate ones (15 s), and from 0.88 to 1.32 down to sigma / a = 0.2.
/// Below that fewer than 5 % may slip at all, and it means nothing. `PulseChain::peak` is nearer, at other
/// probabilities too.
/// @param growth_rate  of the displacement variance [m^2/s], finite and at least 0
/// @param duration     T [s], finite and at least 0
/// @param probability  that the peak is not exceeded, in (0, 1)
/// @return L [m], to a relative 1e-14
/// @throws std::invalid_argument naming the value
/// Reference: W. Feller, An Introduction to Probability Theory and Its Applications, vol. 2 (1971), X.5.
double peak_from_growth(double growth_rate, double duration, double probability);

}  // namespace stickslip::theory
