#include "stickslip/theory/pulse_chain.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <string>

#include "base/digits.hpp"
#include "stickslip/base/error.hpp"
#include "theory/pulse_chain/chain.hpp"
#include "theory/pulse_chain/growth.hpp"
#include "theory/pulse_chain/problem.hpp"
#include "theory/slip_excursion.hpp"
#include "theory/slip_walk.hpp"

namespace stickslip::theory {
namespace {

using namespace detail::pulse_chain;
using detail::digits;
using detail::require;
using detail::shortest;

void append(std::string& text, const std::string& sentence) { text += (text.empty() ? "" : " ") + sentence; }

void remark(Moments& moments, const std::string& sentence) { append(moments.remark, sentence); }

std::string strength_text(double sigma) { return "sigma / slip level = " + digits(sigma); }

/// Whether the levels differ by so little that the drift is off: by a third if refined, else by a tenth.
bool nearly_equal(const Coulomb& law, bool two_slots) {
  const double ratio = std::max(law.forward(), law.backward()) / std::min(law.forward(), law.backward());
  return ratio > 1 && ratio < (two_slots ? 4.0 / 3 : 1.1 - 1e-9);
}

/// Parameters for which no error was measured.
std::string range_remark(const Problem& problem, const PoissonOptions& options) {
  const auto& [step, push, sigma, block, arrivals, chance, shape] = problem;
  std::string text;
  if (!(arrivals.mirrored && block.law().forward() == block.law().backward()) && (arrivals.rate > 2 || sigma < 1.0 / 3))
    append(
        text,
        "Slip levels or amplitudes that differ both ways were tried for sigma / slip level from 1/3 on and up to two "
        "pulses to a step only.");
  if (arrivals.rate > 4)
    append(text, digits(arrivals.rate) + " pulses to a step of the pulse: nothing was tried above 4.");
  if (sigma < 0.125) append(text, strength_text(sigma) + ": nothing was tried below 0.125.");
  if (options.shape.values().size() != 2 || options.quantile)
    append(text, "Errors were measured for the symmetric rectangular pulse and Gaussian amplitudes only.");
  return text;
}

}  // namespace

void PulseChain::check(const Slider<Coulomb>& slider, const PoissonPulses& pulses) const {
  const Problem problem(slider, pulses);
  steps_of(problem.shape, two_slots(problem.sigma, refined_) ? 2 : 1);
}

namespace {

/// Of the displacement at a time [s], by the chain's cumulants.
detail::Slips slips_of(const Problem& problem, double time, bool refined, const std::function<void()>& progress) {
  if (problem.sigma < weakest || time == 0) return {};
  require(
      problem.sigma >= min_refined_sigma,
      "PulseChain: a distribution is known for sigma of at least 0.12 slip levels, or below 0.05 where nothing slips",
      problem.sigma);
  require(problem.arrivals.rate <= 4, "PulseChain: a distribution is known for at most 4 pulses to a step of the pulse",
          problem.arrivals.rate);
  const double length = problem.shape.length() / problem.shape.times()[1] * problem.step;
  require(time >= length,
          "PulseChain: a distribution is known at time 0 and from the length of a pulse on, " + shortest(length) + " s",
          time, "s");
  const Growth growth = growth_of<orders>(problem, refined, progress);
  const double t = time / problem.step, unit = problem.acceleration() * problem.step * problem.step;
  std::array<double, orders> found;
  double power = 1;
  for (std::size_t n = 0; n < orders; ++n) found[n] = (power *= unit) * growth.sum(n, t);
  return detail::gamma_slips(growth.sum(slipped, t), found);
}

}  // namespace

Interval PulseChain::peak(const Slider<Coulomb>& slider, const PoissonPulses& pulses, double probability,
                          const std::function<void()>& progress) const {
  const Problem problem(slider, pulses);
  require(probability > 0 && probability < 1, "PulseChain: probability must lie in (0, 1)", probability);
  const detail::Slips slips = slips_of(problem, pulses.duration(), refined_, progress);
  if (slips.count == 0) return {};
  const Steps steps = steps_of(problem.shape, 1);
  const Chain chain(problem.block, steps, problem.arrivals, 1, problem.drifting());
  const detail::SlipExcursion excursion(chain.excursions());
  const double unit = problem.acceleration() * problem.step * problem.step;
  const double peak = detail::slip_walk_peak(
      slips,
      [&](double slip) {
        detail::SlipExcursion::Parts farthest = excursion(slip / unit);
        for (double& distance : farthest) distance *= unit;
        return farthest;
      },
      probability);
  const bool known = problem.sigma > 0.333 && problem.sigma <= 20 && range_remark(problem, pulses.options()).empty() &&
                     problem.arrivals.rate <= 2 && probability >= 0.5 && probability <= 0.99 &&
                     pulses.duration() >= 10 * problem.step;
  const detail::RatioRange ratio =
      !known ? detail::RatioRange{0, std::numeric_limits<double>::infinity()} : detail::peak_ratio(slips.count);
  return {peak, peak / ratio.largest,
          ratio.smallest > 0 ? peak / ratio.smallest : std::numeric_limits<double>::infinity()};
}

DisplacementDistribution PulseChain::distribution(const Slider<Coulomb>& slider, const PoissonPulses& pulses,
                                                  double time, const std::function<void()>& progress) const {
  const Problem problem(slider, pulses);
  require(std::isfinite(time) && time >= 0, "PulseChain: time must be finite and at least 0", time, "s");
  std::string text = range_remark(problem, pulses.options());
  if (problem.sigma >= weakest && time > 0) {
    const bool two = two_slots(problem.sigma, refined_);
    if (problem.sigma < (two ? 0.2 : 1.0 / 3) - 1e-9)
      append(text, strength_text(problem.sigma) + ". " + detail::pulse_accuracy().weakest);
    if (nearly_equal(problem.block.law(), two)) append(text, detail::pulse_accuracy().near_levels);
  }
  return DisplacementDistribution(slips_of(problem, time, refined_, progress), text);
}

Moments PulseChain::predict(const Slider<Coulomb>& slider, const PoissonPulses& pulses, std::span<const double> times,
                            const std::function<void()>& progress) const {
  const Problem problem(slider, pulses);
  const auto& [step, push, sigma, block, arrivals, chance, shape] = problem;
  const PoissonOptions& options = pulses.options();
  for (const double time : times)
    require(std::isfinite(time) && time >= 0, "PulseChain: times must be finite and at least 0", time, "s");
  Moments moments;
  const std::size_t count = times.size();
  moments.time.assign(times.begin(), times.end());
  for (Estimates* e : {&moments.displacement_mean, &moments.displacement_variance, &moments.covariance,
                       &moments.velocity_mean, &moments.velocity_variance}) {
    e->value.assign(count, 0);
    e->error.assign(count, 0);
  }
  if (sigma < weakest) {
    remark(moments, "Nothing slips: the slip level is " + digits(1 / sigma) +
                        " times sigma, and the chance that the ground's acceleration exceeds it is " + digits(chance) +
                        ".");
    return moments;
  }

  const Growth growth = growth_of<2>(problem, refined_, progress);
  const double v_unit = problem.acceleration() * step, x_unit = v_unit * step;
  for (std::size_t i = 0; i < count; ++i) {
    const double t = times[i] / step, drift = growth.rate(0, t);
    moments.displacement_mean.value[i] = x_unit * growth.sum(0, t);
    moments.velocity_mean.value[i] = v_unit * drift;
    moments.displacement_variance.value[i] = x_unit * x_unit * growth.sum(1, t);
    moments.covariance.value[i] = x_unit * v_unit * growth.rate(1, t) / 2;
    moments.velocity_variance.value[i] = v_unit * v_unit * (growth.rate(squared_velocity, t) - drift * drift);
  }
  moments.growth_rate = {x_unit * v_unit * growth.rate(1, std::numeric_limits<double>::infinity()), 0};

  moments.remark = range_remark(problem, options);
  const bool two = two_slots(sigma, refined_);
  if (!two && sigma < 0.3)
    remark(moments, strength_text(sigma) + " is below 0.3. " + detail::pulse_accuracy().weak);
  else if (!two && sigma < 0.5 && arrivals.rate > 2)
    remark(moments, strength_text(sigma) + " is below 0.5, with more than two pulses to a step: refined is needed.");
  if (nearly_equal(block.law(), two)) remark(moments, detail::pulse_accuracy().near_levels);
  const double length = options.shape.length() * pulses.half_width();
  if (const auto n = std::ranges::count_if(times, [&](double t) { return t > 0 && t < length; });
      n > 0 && (sigma < 0.5 || arrivals.rate > 2))
    remark(moments,
           std::to_string(n) + " of the times " + (n == 1 ? "is" : "are") + " below " + digits(length) +
               " s, the length of a pulse: with sigma / slip level below 0.5 or more than two pulses to a step "
               "simulations differ there by up to a factor of 2.4.");
  if (options.stationary_start)
    remark(moments, "From rest as if no pulse had arrived before time zero: a stationary start is not followed.");
  return moments;
}

double PulseChain::final_rms(const Slider<Coulomb>& slider, const PoissonPulses& pulses,
                             const std::function<void()>& progress) const {
  const double end[] = {pulses.duration()};
  const Moments moments = predict(slider, pulses, end, progress);
  return std::hypot(std::sqrt(moments.displacement_variance.value[0]), moments.displacement_mean.value[0]);
}

}  // namespace stickslip::theory
