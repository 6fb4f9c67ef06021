// Poisson pulses that arrive in step: a theory that knows what one pulse leaves to the next.
#pragma once

#include <concepts>
#include <functional>
#include <span>
#include <stdexcept>
#include <string>

#include "stickslip/excitation/poisson.hpp"
#include "stickslip/friction/coulomb.hpp"
#include "stickslip/slider.hpp"
#include "stickslip/statistics/moments.hpp"
#include "stickslip/theory/displacement_distribution.hpp"
#include "stickslip/theory/theory.hpp"

namespace stickslip::theory {

/// The synchronized-arrival chain: Coulomb friction under Poisson pulses, without simulation. The library's usual pulse
/// theory for Coulomb friction.
///
/// Pulses may begin at the nodes of a lattice alone, as many as Poisson's law gives to each: ground acceleration is
/// then constant over slots, and velocity and the last few batches are a Markov chain, which is solved on a grid, from
/// rest on. The law of the acceleration and its spectrum, the response to a single pulse and to no friction stay exact;
/// what pairs of pulses do at the lattice's offsets instead of all is put right to the second order in lambda dt.
/// docs/pulse_chain.md derives it and has the map of its errors.
///
/// Against simulation, for the symmetric rectangular pulse and Gaussian amplitudes, lambda dt from 0.05 to 2 (4):
/// growth rate and velocity variance are within 4 % (9 %) for sigma / a from 1 to 20, within 9 % (13 %) from 1/3 on.
/// Below that they are too high: the growth rate by 19 % at 1/4 and 41 % at 1/5, the final rms of the thesis's events
/// (lambda dt = 1/2) by 9 % at 1/4, 16 % at 1/5, 27 % at 1/6 and 37(3) % at 0.15. Refined they are within 5 % from 1/3
/// on, and the final rms within 5 % down to 0.13; above sigma / a = 1 refined is the same. From rest on, before a
/// pulse's length is over, E[x^2] and E[v^2] are within 10 % (lambda dt up to 1) and 17 % (up to 2) for sigma / a from
/// 1/2 on, at any time down to dt / 20; else `remark` says that they are off by up to a factor of 2.4. After that they
/// are within 12 %.
///
/// Where the two slip levels differ, one way too, or amplitudes have a mean, the displacement drifts: the mean velocity
/// is within 8 % for levels that differ by a third or more (12 % for 1.1 times), the growth rate within 12 % (18 % one
/// way at lambda dt = 2) and the velocity variance within 8 % (13 %), for sigma over the smaller level from 1/3 to 20
/// and lambda dt up to 2. Above sigma = 3 smaller levels the other level is at most 4 times the smaller one.
///
/// Covers Coulomb friction without a spring; pulses of two to four equal steps, two if refined, whose values are
/// multiples of a common unit and which leave no net velocity; any law of amplitudes, symmetric ones where the levels
/// differ.
class PulseChain {
 public:
  /// @param refined  two slots to a step of the pulse from sigma / a = 0.12 to 1, below 1/2 extrapolated with one: more
  ///                 exact, 0.1 to 10 s
  explicit PulseChain(bool refined = false) : refined_(refined) {}

  bool refined() const noexcept { return refined_; }

  std::string name() const { return refined_ ? "PulseChain, refined" : "PulseChain"; }

  /// A law of amplitudes by its quantile function is asked for 16384 of them.
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
  /// @param pulses  the excitation, without an envelope; from rest as if no pulse had arrived before time zero
  /// @param times   where to answer [s], finite, at least 0
  /// @param progress  called regularly; may throw to stop the work; optional
  /// @return moments from rest on. `remark` says where the theory is outside of its range, and where nothing slips
  /// @throws std::invalid_argument naming what is not covered or the value refused
  /// @throws ConvergenceError if the chain does not become stationary within its steps
  /// Takes 3 to 100 ms.
  Moments predict(const Slider<Coulomb>& slider, const PoissonPulses& pulses, std::span<const double> times,
                  const std::function<void()>& progress = {}) const;

  /// The distribution of the displacement at a time, by closure: the chain's first four cumulants, and its chance that
  /// nothing has slipped yet, are those of a compound Poisson law of slips of gamma-distributed lengths,
  ///     nu(d) ~ |d|^(k-1) exp(-|d| / theta)    one k for both ways, two theta; docs/pulse_chain.md, section 6
  ///
  /// Of 100,000 blocks with equal levels, lambda dt from 0.05 to 2, at 10, 40 and 160 dt, a probability is off by less
  /// than 0.03 for sigma / a from 1/2 to 20, refined from 1/3 on; refined by less than 0.07 at 1/4 and 1/5.
  /// @param slider  as for `predict`
  /// @param pulses  as for `predict`
  /// @param time    [s], finite, 0 or at least the length of a pulse; sigma / a must be at least 0.12 (or below 0.05,
  ///                where nothing slips) and pulses to a step at most 4
  /// @param progress  called regularly; may throw to stop the work; optional
  /// @throws std::invalid_argument naming what is not covered or the value refused; also where the kurtosis is below
  ///         what a sum of slips can have by more than 0.1
  /// @throws ConvergenceError if the chain does not become stationary within its steps
  /// Takes 15 to 250 ms, refined up to some seconds.
  DisplacementDistribution distribution(const Slider<Coulomb>& slider, const PoissonPulses& pulses, double time,
                                        const std::function<void()>& progress = {}) const;

  /// An estimate of the largest |x| up to the end of the motion that a block does not exceed with a probability [m]:
  /// that of a walk whose steps are the slips of `distribution`, as many as Poisson's law has it, solved on a grid of
  /// 301 places with walls at the peak. On each slip the block goes farther out by the factor that one pulse and two
  /// that overlap have in the mean square. docs/pulse_chain.md, section 7.
  ///
  /// In the thesis's four events, mu from 0.05 to 0.7 where sigma / a is 0.2 to 5 (refined below 0.3), of the 95 % peak
  /// of 40,000 blocks 0.99 to 1.10, of the 99 % one 0.99 to 1.11, and of the median 0.97 to 1.04 unless fewer than two
  /// slips are expected. Measured for equal levels.
  /// @param slider  as for `predict`
  /// @param pulses  as for `predict`; over `pulses.duration()`
  /// @param probability  that the peak is not exceeded, in (0, 1)
  /// @param progress  called regularly; may throw to stop the work; optional
  /// @return 0 where that many do not slip at all
  /// @throws as `distribution`, and std::invalid_argument for the probability
  /// Takes 60 to 350 ms, refined up to 10 s.
  double peak(const Slider<Coulomb>& slider, const PoissonPulses& pulses, double probability,
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

/// What pairs of pulses do, in units of the slip level and the step: see docs/pulse_chain.md, section 3.
struct PairCoefficients {
  double single = 0;   ///< c1: one pulse alone
  double pair = 0;     ///< c2: the integral over all offsets
  double lattice = 0;  ///< c2(m): the sum over the lattice's
};

struct PairTable {
  PairCoefficients growth, velocity;
};

/// For the symmetric rectangular pulse and Gaussian amplitudes of rms `sigma`, `slots` to a step.
PairTable pair_coefficients(double sigma, int slots);

}  // namespace stickslip::detail
