// Poisson pulses that arrive at the nodes of a lattice: a theory with memory between pulses.
#pragma once

#include <concepts>
#include <functional>
#include <span>
#include <stdexcept>
#include <string>

#include "stickslip/excitation/poisson.hpp"
#include "stickslip/friction/coulomb.hpp"
#include "stickslip/slider/slider.hpp"
#include "stickslip/statistics/moments.hpp"
#include "stickslip/statistics/tally.hpp"
#include "stickslip/theory/detail/pulse_accuracy.hpp"
#include "stickslip/theory/displacement_distribution.hpp"
#include "stickslip/theory/theory.hpp"

namespace stickslip::theory {

/// The synchronized-arrival chain: Coulomb friction under Poisson pulses, without simulation. It is the recommended
/// pulse theory for Coulomb friction.
///
/// Pulses begin only at the nodes of a lattice of times; the number at each node has a Poisson distribution. The ground
/// acceleration is then constant between nodes, and the velocity together with the last few batches of pulses is a
/// Markov chain, which is solved on a grid, from rest on. The distribution of the acceleration, its spectrum, the
/// response to a single pulse and the response without friction remain exact. The error in the response to pairs of
/// pulses, whose delays are multiples of the spacing, is corrected to second order in lambda dt. docs/pulse_chain.md
/// derives the theory and tabulates its errors.
///
/// Against simulation, for the symmetric rectangular pulse and Gaussian amplitudes, lambda dt from 0.05 to 2 (4):
/// growth rate and velocity variance are within 4 % (9 %) for sigma / a from 1 to 20, within 9 % (13 %) from 1/3 on.
/// Below 1/3 they are too high: `remark` states by how much, in the words of `detail::pulse_accuracy`. With `refined`
/// they are within 5 % from 1/3 on, and the final rms of the thesis's events within 5 % down to 0.13; above
/// sigma / a = 1 `refined` has no effect. During the first pulse length after a start from rest, E[x^2] and E[v^2] are
/// within 10 % (lambda dt up to 1) and 17 % (up to 2) for sigma / a from 1/2 on, at any time down to dt / 20; for other
/// parameters `remark` states an error of up to a factor of 2.4. Later they are within 12 %.
///
/// If the two slip levels differ (also for one-way sliding), or the amplitudes have a mean, the displacement drifts:
/// the mean velocity is within 8 % for levels that differ by a third or more (12 % for 1.1 times, 20 % for 1.05; if
/// refined 27 and 39 %, which `remark` states), the growth rate within 12 % (18 % for one-way sliding at lambda dt = 2)
/// and the velocity variance within 8 % (13 %), for sigma over the smaller level from 1/3 to 20 and lambda dt up to 2.
/// If sigma exceeds 3 times the smaller level, the other level may be at most 4 times as large.
///
/// Covers Coulomb friction without a spring; pulses of two to four equal steps (two if refined) whose values are
/// multiples of a common unit and which leave no net velocity; any distribution of amplitudes, but only symmetric ones
/// if the levels differ.
class PulseChain {
 public:
  /// @param refined  use two slots per step of the pulse for sigma / a from 0.12 to 1, and extrapolate from one and two
  ///                 below 1/2: more accurate, 0.1 to 10 s
  explicit PulseChain(bool refined = false) : refined_(refined) {}

  bool refined() const noexcept { return refined_; }

  std::string name() const { return refined_ ? "PulseChain, refined" : "PulseChain"; }

  /// A distribution of amplitudes given by its quantile function is evaluated at 16384 quantiles.
  template <FrictionLaw Law, class E>
  Coverage covers(const Slider<Law>& slider, const E& excitation) const {
    return detail::coverage<PoissonPulses>(
        excitation, "PulseChain: covers PoissonPulses", [&](const PoissonPulses& pulses) {
          if constexpr (std::same_as<Law, Coulomb>)
            check(slider, pulses);
          else
            throw std::invalid_argument("PulseChain: covers Coulomb friction; PulseSuperposition covers other laws");
        });
  }

  /// @param slider  no spring; the levels may differ
  /// @param pulses  the excitation, without an envelope; no pulse arrives before time zero
  /// @param times   of the moments [s], finite, at least 0
  /// @param progress  called regularly; may throw to stop the work; optional
  /// @return moments from rest on. `remark` states parameters outside the range of the theory, and that nothing slips
  /// @throws std::invalid_argument naming what is not covered or the rejected value
  /// @throws ConvergenceError if the chain does not become stationary within its steps
  /// Takes 3 to 100 ms.
  Moments predict(const Slider<Coulomb>& slider, const PoissonPulses& pulses, std::span<const double> times,
                  const std::function<void()>& progress = {}) const;

  /// The distribution of the displacement at a time, by closure: a compound Poisson distribution of slips with
  /// gamma-distributed lengths that has the first four cumulants of the chain, and its probability of no slip,
  ///     nu(d) ~ |d|^(k-1) exp(-|d| / theta)    one k for both directions, two theta; docs/pulse_chain.md, section 6
  ///
  /// `detail::pulse_accuracy().distribution` states the errors; outside of its range so does `remark` of the result.
  /// @param slider  as for `predict`
  /// @param pulses  as for `predict`
  /// @param time    [s], finite, 0 or at least the length of a pulse; sigma / a must be at least 0.12 (or below 0.05,
  ///                where nothing slips), and lambda dt at most 4
  /// @param progress  called regularly; may throw to stop the work; optional
  /// @throws std::invalid_argument naming what is not covered or the rejected value; also if the kurtosis is more than
  ///         0.1 below the minimum for a sum of slips
  /// @throws ConvergenceError if the chain does not become stationary within its steps
  /// Takes 15 to 250 ms, refined up to a few seconds.
  DisplacementDistribution distribution(const Slider<Coulomb>& slider, const PoissonPulses& pulses, double time,
                                        const std::function<void()>& progress = {}) const;

  /// An estimate of the quantile of the peak, the largest |x| up to the end of the motion [m], between bounds. It is
  /// that of a random walk whose steps are the slips of `distribution`, in a Poisson-distributed number, solved on a
  /// grid of 301 points with absorbing walls at the peak. How far the block goes during a slip, beyond the point where
  /// the slip ends, follows from its length, by the responses to one pulse and to two that overlap.
  /// docs/pulse_chain.md, section 7.
  ///
  /// The bounds are the estimate divided by the largest and by the smallest ratio of an estimate to a simulation found
  /// in the range that `detail::pulse_accuracy().peak` states; outside that range they are 0 and infinity. They are not
  /// confidence bounds.
  /// @param slider  as for `predict`
  /// @param pulses  as for `predict`; over `pulses.duration()`
  /// @param probability  that the peak is not exceeded, in (0, 1)
  /// @param progress  called regularly; may throw to stop the work; optional
  /// @return 0 if that fraction does not slip at all
  /// @throws as `distribution`, and std::invalid_argument for the probability
  /// Takes 0.1 to 1 s, refined up to 10 s.
  Interval peak(const Slider<Coulomb>& slider, const PoissonPulses& pulses, double probability,
                const std::function<void()>& progress = {}) const;

  /// (E[x^2(t_d)])^(1/2) at the end of the motion, t_d = pulses.duration() [m]: thesis figure 5.7.
  double final_rms(const Slider<Coulomb>& slider, const PoissonPulses& pulses,
                   const std::function<void()>& progress = {}) const;

 private:
  void check(const Slider<Coulomb>& slider, const PoissonPulses& pulses) const;

  bool refined_;
};

}  // namespace stickslip::theory

namespace stickslip::detail {

/// Contributions of single pulses and of pairs, in units of the slip level and the step: see docs/pulse_chain.md,
/// section 3.
struct PairCoefficients {
  double single = 0;   ///< c1: one pulse alone
  double pair = 0;     ///< c2: the integral over all offsets
  double lattice = 0;  ///< c2(m): the sum over the offsets of the lattice
};

struct PairTable {
  PairCoefficients growth, velocity;
};

/// For the symmetric rectangular pulse and Gaussian amplitudes of rms `sigma`, `slots` per step.
PairTable pair_coefficients(double sigma, int slots);

}  // namespace stickslip::detail
