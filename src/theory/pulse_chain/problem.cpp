#include "theory/pulse_chain/problem.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "stickslip/base/error.hpp"
#include "stickslip/theory/pulse_response.hpp"
#include "stickslip/theory/theory.hpp"

namespace stickslip::detail::pulse_chain {

Steps steps_of(const PulseShape& shape, int slots) {
  const auto times = shape.times();
  const auto values = shape.values();
  const double step = times[1];
  for (std::size_t i = 1; i + 1 < times.size(); ++i)
    require(std::abs(times[i + 1] - times[i] - step) <= 1e-9 * step, "PulseChain: the pulse must have equal steps",
            times[i + 1] - times[i]);
  const std::size_t most = slots == 1 ? 4 : 2;
  require(values.size() >= 2 && values.size() <= most,
          "PulseChain: the pulse must have 2 to " + std::to_string(most) + " steps",
          static_cast<double>(values.size()));
  double largest = 0;
  for (const double value : values) largest = std::max(largest, std::abs(value));
  constexpr int finest = 12;
  for (int parts = 1; parts <= finest; ++parts) {
    Steps steps{{}, 1.0 / parts};
    int net = 0;
    bool fits = true;
    for (const double value : values) {
      const double multiple = value / largest * parts;
      steps.values.push_back(static_cast<int>(std::lround(multiple)));
      net += steps.values.back();
      fits = fits && std::abs(multiple - steps.values.back()) < 1e-9;
    }
    if (!fits) continue;
    require(net == 0, "PulseChain: the pulse must leave no net velocity", net * largest / parts);
    return steps;
  }
  throw std::invalid_argument(
      "PulseChain: the values of the pulse must be multiples of a twelfth, or of a greater "
      "part, of the largest one");
}

namespace {

constexpr double max_arrivals = 50;
/// With unequal levels or asymmetric amplitudes nothing is known beyond these limits.
constexpr double strongest_drift = 20, greatest_ratio = 4;

/// An upper bound of the probability that the acceleration of Gaussian pulses exceeds the slip level.
double chance_to_slip(const Arrivals& arrivals, double length) {
  const double mean = arrivals.rate * length;
  double probability = std::exp(-mean), sum = 0;
  for (int k = 1; k < 2000; ++k) {
    probability *= mean / k;
    sum += probability * std::erfc(1 / (arrivals.sigma * std::sqrt(2.0 * k)));
  }
  return sum;
}

/// The levels in units of the smaller one.
Slider<Coulomb> unit_block(const Coulomb& law) {
  const double level = std::min(law.forward(), law.backward());
  return Slider(law.forward() == law.backward() ? Coulomb(1) : Coulomb(law.forward() / level, law.backward() / level));
}

}  // namespace

Problem::Problem(const Slider<Coulomb>& slider, const PoissonPulses& pulses)
    : block(Coulomb(1)), shape(pulses.options().shape) {
  const Coulomb& law = slider.law();
  const double level = std::min(law.forward(), law.backward()), other = std::max(law.forward(), law.backward());
  const PoissonOptions& options = pulses.options();
  detail::require_no_spring(slider.natural_frequency(), "PulseChain");
  detail::require_plain(slider, "PulseChain");
  if (options.envelope) throw std::invalid_argument("PulseChain: an envelope is not covered; PulseSuperposition does");
  double largest = 0;
  for (const double value : options.shape.values()) largest = std::max(largest, std::abs(value));
  step = options.shape.times()[1] * pulses.half_width();
  push = pulses.sigma() * largest;
  sigma = push / level;
  arrivals = {pulses.rate() * step, std::min(sigma, strongest), options.quantile};
  if (options.quantile) {
    const std::vector<double> all = amplitudes(options.quantile);
    arrivals.mirrored = symmetric(all);
    arrivals.fourth = 0;
    for (const double b : all) arrivals.fourth += b * b * b * b / static_cast<double>(all.size());
  }
  if (level != other || !arrivals.mirrored)
    require(sigma <= strongest_drift,
            "PulseChain: with slip levels or amplitudes that differ both ways sigma must be at most 20 slip levels",
            sigma);
  if (level != other) {
    require(arrivals.mirrored,
            "PulseChain: amplitudes must be symmetric, quantile(u) = -quantile(1 - u), where slip levels differ: their "
            "ratio must then be 1",
            other / level);
    block = unit_block(law);
    require(other <= greatest_ratio * level || !drifting(),
            "PulseChain: where sigma exceeds 3 times the smaller slip level the other one must be at most 4 times it",
            other / level);
  }
  require(arrivals.rate <= max_arrivals, "PulseChain: pulses to a step of the pulse must be at most 50", arrivals.rate);
  if (sigma > strongest)
    require(arrivals.rate <= 1 || sigma >= 1000 * std::exp(3 * arrivals.rate),
            "PulseChain: with " + shortest(arrivals.rate) +
                " pulses to a step of the pulse, sigma must be at most 256 slip levels or so many that nothing is left "
                "of friction, 1000 exp(3 x " +
                shortest(arrivals.rate) + ")",
            sigma);
  chance = options.quantile || sigma >= weakest ? 1 : chance_to_slip(arrivals, options.shape.length());
  if (sigma < weakest)
    require(chance < 1e-12,
            "PulseChain: sigma must be at least a twentieth of the slip level where pulses are this many", sigma);
}

}  // namespace stickslip::detail::pulse_chain
