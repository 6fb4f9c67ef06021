// The transport operator: a theory that carries the probability of the state, for blocks, casters and springs under
// noise.
#pragma once

#include <concepts>
#include <cstddef>
#include <functional>
#include <span>
#include <stdexcept>
#include <string>
#include <variant>

#include "stickslip/excitation/gaussian.hpp"
#include "stickslip/excitation/poisson.hpp"
#include "stickslip/excitation/spectrum.hpp"
#include "stickslip/friction/law.hpp"
#include "stickslip/slider/slider.hpp"
#include "stickslip/sliding/any_slider.hpp"
#include "stickslip/statistics/moments.hpp"
#include "stickslip/statistics/tally.hpp"
#include "stickslip/theory/displacement_distribution.hpp"
#include "stickslip/theory/shaping_filter.hpp"
#include "stickslip/theory/theory.hpp"
#include "stickslip/theory/velocity_distribution.hpp"

namespace stickslip::theory {

/// Stationary ground acceleration that is white, or white noise through a filter of two states: the noise that
/// `Transport` covers. A Gaussian process, stationary from time zero on, not periodic, with its spectrum down to zero
/// frequency.
class TwoStateNoise {
 public:
  /// White noise of the two-sided level s0 [m^2/s^3], positive and finite.
  TwoStateNoise(double s0) : filter_(s0) {}

  /// @throws std::invalid_argument unless the spectrum is white or Kanai and Tajimi's
  TwoStateNoise(const Spectrum& spectrum);

  /// @throws std::invalid_argument  more than two states, or a section with white noise of its own (b2 not 0)
  TwoStateNoise(const ShapingFilter& filter);

  /// The spectrum of an excitation. White noise whose samples are held, without correction for the interpolation, is
  /// independent from sample to sample, and is predicted as sampled.
  /// @throws std::invalid_argument also with an envelope
  TwoStateNoise(const GaussianExcitation& excitation);

  /// Of no or one section.
  const ShapingFilter& filter() const noexcept { return filter_; }

  bool white() const noexcept { return filter_.sections().empty(); }

  /// How long each value is held [s]; 0 for continuous noise.
  double held() const noexcept { return held_; }

  /// What distinguishes the motions of the excitation from this noise; empty if nothing does.
  const std::string& remark() const noexcept { return remark_; }

 private:
  ShapingFilter filter_;
  double held_ = 0;
  std::string remark_{};
};

/// What excites a slider of `Transport`. Pulses are those of two equal steps, up and down, without an envelope.
using TransportExcitation = std::variant<TwoStateNoise, PoissonPulses>;

/// Means over the stationary motion; the error of each is numerical.
struct TransportStationary {
  Estimate displacement_mean;      ///< [m]; NaN without a spring
  Estimate displacement_variance;  ///< [m^2]; infinite without a spring
  Estimate velocity_mean;          ///< [m/s]
  Estimate velocity_variance;      ///< [m^2/s^2]
  Estimate growth_rate;            ///< of the displacement variance [m^2/s]; 0 with a spring
  Estimate rest;                   ///< fraction of time at rest; 0 under continuous white noise
};

/// The work of a prediction: the finest grid, its steps, and the time of all grids.
struct TransportCost {
  std::size_t nodes = 0;
  std::size_t steps = 0;
  double seconds = 0;
};

class Transport;

/// The largest |x| from rest up to a time, by absorbing walls at -L and L: an exact step is lost if its path crosses
/// one. Values have a numerical error, by one refinement of step and grid; in the table of docs/transport.md it covers
/// the difference from simulation down to probabilities of 0.01.
class TransportPeak {
 public:
  TransportPeak(const Transport& theory, const AnySlider& slider, const TransportExcitation& excitation, double time);

  double time() const noexcept { return time_; }

  /// P(max |x| > level).
  /// @param level     [m], positive and finite
  /// @param progress  called regularly; may throw to stop the work; optional
  /// @throws std::invalid_argument naming the value
  /// Takes 5 to 20 s.
  Estimate exceedance(double level, const std::function<void()>& progress = {}) const;

  /// The level that max |x| does not exceed with a probability [m].
  /// @param probability  from 0.01 to 0.999
  /// @throws std::invalid_argument naming the value
  /// @returns 0, with an error of a thousandth of the rms displacement, if more than this part hardly moves
  /// @throws ConvergenceError  no such level within a factor of 1000 of the rms displacement
  /// Takes 10 to 30 s: `exceedance`, at a level found with a coarse grid.
  Estimate quantile(double probability, const std::function<void()>& progress = {}) const;

 private:
  double tolerance_;
  AnySlider slider_;
  TransportExcitation excitation_;
  double time_;
};

/// The prediction of `Transport`: moments by time. Their errors are numerical, what steps and grids contribute, by
/// refinement.
class TransportPrediction : public Moments {
 public:
  TransportPrediction(Moments moments, const TransportCost& cost, const Transport& theory, const AnySlider& slider,
                      const TransportExcitation& excitation);

  const TransportCost& cost() const noexcept { return cost_; }

  /// The stationary motion, `Transport::stationary`.
  TransportStationary stationary(const std::function<void()>& progress = {}) const;

  /// The distribution of the displacement at a time, `Transport::displacement`.
  DisplacementDistribution displacement(double at, const std::function<void()>& progress = {}) const;

  /// The distribution of the velocity at a time, `Transport::velocity`.
  VelocityDistribution velocity(double at, const std::function<void()>& progress = {}) const;

  /// The peak up to a time.
  /// @param end  [s], positive and finite
  /// @throws std::invalid_argument naming the value
  TransportPeak peak(double end) const;

 private:
  TransportCost cost_;
  double tolerance_;
  AnySlider slider_;
  TransportExcitation excitation_;
};

/// The transport operator. Over a step the load is held at its value in the middle, and the step has two exact parts:
/// S, the slider's own motion under a constant load, and Z, the step of the filter,
///
///     (T f)(x, v, z) = (Z f)(S(x, v; n(z)), z),     p_(k+1) = T' p_k,
///
/// of second order in the step. Functions of the state are represented by their values at nodes, probability by
/// the adjoint: docs/transport.md derives it and tabulates its errors. Moments are those of `p`; growth is the solution
/// of a linear system for the stationary `p` and for `p` times displacement. Each value is extrapolated from two steps
/// (white noise: more); its error is that of the extrapolation, plus the change when degrees and windows of the grid
/// are refined. Steps and grids are refined until the errors of the variances at the last time and of the growth rate
/// are below the tolerance.
///
/// Covers Coulomb friction with equal, unequal and one-way levels, friction that depends on the speed
/// (`VelocityDependent`, `Stribeck`), and static friction above kinetic; with or without a spring and a damper; with a
/// one-way mounting; on slopes without vertical motion. White noise, and noise from a filter of two states, such as
/// Kanai and Tajimi's or one without content at zero frequency. Casters are covered under noise, without a slope;
/// static friction under filtered or held noise, slopes under these and pulses.
/// The damping ratio of the filter is from 0.1 to 1.5, its rms acceleration at least 0.35 times the lower level at rest
/// and at most 20 times the least resistance, and the spring at most 5 times as fast as it. Under white noise one level
/// is at most 10 times the other, or infinite, wn pi S0 / a^2 at least 0.05, and a caster on a spring has
/// a reach wn >= 3 pi S0. Under filtered noise a caster has no spring, a reach of at least a / wg^2, and the noise content
/// at zero frequency, an rms acceleration from 0.7 a to 6 a and a damping ratio of the filter from 0.3 to 0.9, for which
/// its errors were measured. Under filtered noise static friction on a spring needs a tolerance of at least 0.05, and
/// is equal both ways and at most twice the kinetic one, wn at most 3 wg, the rms acceleration from 0.7 a to 3 a and the
/// damping ratio of the filter from 0.3 to 0.9.
///
/// Pulses of two equal steps, up and down, with Gaussian amplitudes, are moved to the nodes of a lattice of times, of
/// one and two slots to a half width Dt; the state of the ground is then the last batches of pulses. The stated error
/// is that of the lattice, which docs/transport.md measures. Covered are Coulomb friction and laws of the speed, with
/// or without a spring and a damper; rms amplitudes from 0.3 to 6 times the lower level, 0.03 to 10 pulses in Dt, an
/// rms acceleration of at least 0.25 of the level, and wn Dt up to 3.
class Transport {
 public:
  /// @param tolerance  relative, from 1e-6 to 0.3
  /// @throws std::invalid_argument naming the value
  explicit Transport(double tolerance = 1e-2);

  double tolerance() const noexcept { return tolerance_; }

  std::string name() const { return "Transport"; }

  template <FrictionLaw Law, class E>
  Coverage covers(const Slider<Law>& slider, const E& excitation) const {
    return detail::coverage<TransportExcitation>(
        excitation, "Transport: covers white noise, noise from a filter of two states, and Poisson pulses",
        [&](const TransportExcitation& any) {
          if constexpr (std::convertible_to<const Slider<Law>&, AnySlider>)
            check(slider, any);
          else
            throw std::invalid_argument("Transport: covers laws of the library");
        });
  }

  /// Moments from rest on.
  /// @param slider  positive levels, which may differ, the backward one also infinite; spring and damper optional. On a
  ///                slope the levels are the ground accelerations that just move it, and the rms acceleration is at
  ///                most g / (4.5 tan(slope)), so that it does not lift off
  ///                Without a spring a caster's growth rate is NaN
  /// @param excitation  noise, stationary from time zero on, or pulses
  /// @param times   [s], finite, at least 0, increasing; under pulses 0 or at least 2 half widths, with
  ///                `stationary_start` 3
  /// @param progress  called regularly; may throw to stop the work; optional
  /// @throws std::invalid_argument naming what is not covered or the rejected value
  /// @throws ConvergenceError  the tolerance is not reached within the largest grid; names the best value and its
  ///                           error. Not under pulses, where the error of the lattice is larger, and stated
  /// Takes 0.3 to 2 s for a block, up to 20 s at the edges of the range, 2 to 8 s for static friction, 2 to 60 s with a
  /// spring, 3 to 300 s for a caster, under filtered noise with a tolerance of 0.1;
  /// under pulses 0.2 to 5 s for a block, 2 to 25 s with a spring.
  TransportPrediction predict(const AnySlider& slider, const TransportExcitation& excitation,
                              std::span<const double> times, const std::function<void()>& progress = {}) const;

  /// The stationary motion.
  /// @throws as `predict`; also for casters, which become stationary slowly at best
  TransportStationary stationary(const AnySlider& slider, const TransportExcitation& excitation,
                                 const std::function<void()>& progress = {}) const;

  /// The distribution of the displacement at a time, with x on a grid that becomes fine towards the start. The atom is
  /// the probability that the slider has not slipped, of the excitation alone. `error_at` bounds the numerical error of
  /// each probability: docs/transport.md compares it with simulation, down to probabilities of 1e-4.
  /// @param slider  as for `predict`
  /// @param excitation  as for `predict`
  /// @param time  [s], positive and finite
  /// @throws std::invalid_argument naming the value
  /// Takes 1 to 20 s.
  DisplacementDistribution displacement(const AnySlider& slider, const TransportExcitation& excitation, double time,
                                        const std::function<void()>& progress = {}) const;

  /// The distribution of the velocity at a time, with the probability of rest: of each value the probability that the
  /// load of the last step leads below it, integrated over that load exactly.
  /// @param slider  as for `predict`
  /// @param excitation  as for `predict`
  /// @param time    [s], positive and finite
  /// @throws std::invalid_argument naming the value
  /// Takes 1 to 20 s.
  VelocityDistribution velocity(const AnySlider& slider, const TransportExcitation& excitation, double time,
                                const std::function<void()>& progress = {}) const;

 private:
  void check(const AnySlider& slider, const TransportExcitation& excitation) const;

  double tolerance_;
};

}  // namespace stickslip::theory
