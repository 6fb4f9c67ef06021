// Theories of Poisson pulses: the cost of a prediction, and its accuracy.
//
// pulse_theories [--check] [--json] [--rounds N] [--map]
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <stickslip/stickslip.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "bench.hpp"

using namespace stickslip;
using theory::Overlap;
using theory::PulseChain;
using theory::PulseSuperposition;

namespace {

constexpr double duration = 1000;  // [s]; the half width is 1 s, the slip level 1 m/s^2

PoissonPulses pulses(double rate, double sigma) { return {rate, 1, sigma, duration}; }

const Slider block(Coulomb(1));
const std::vector<double> late = {duration};

/// Values of an independent program, 100,000 records each: values.json mc.poisson.*.
struct Measured {
  double sigma, rate, growth, growth_error, velocity_variance;
};
constexpr Measured measured[] = {{1, 1, 0.0981565, 0.00071, 0.251948}, {5, 0.5, 3.531026, 0.0253, 6.536836}};

void check() {
  for (const Measured& m : measured)
    for (const bool refined : {false, true}) {
      const Moments found = PulseChain(refined).predict(block, pulses(m.rate, m.sigma), late);
      // The documented accuracy of the theory, and three standard errors.
      const double part = refined ? 0.03 : 0.1;
      bench::require_below("chain: growth rate", std::abs(found.growth_rate.value / m.growth - 1),
                           part + 3 * m.growth_error / m.growth);
      bench::require_below("chain: velocity variance",
                           std::abs(found.velocity_variance.value[0] / m.velocity_variance - 1), refined ? 0.03 : 0.07);
    }
  // Thesis (5.55) at sigma_B = 1, lambda Dt = 1: values.json pulse.series.sB1.ldt1.0.
  const Moments series = PulseSuperposition(Overlap::thesis).predict(block, pulses(1, 1), late);
  bench::require_below("overlap series", std::abs(series.growth_rate.value / 0.0961466433152774650 - 1), 1e-12);
  // Without friction, 5 pulses expected: Poisson's mixture of Gaussian laws.
  const auto mixture = PulseSuperposition(Overlap::none).distribution(Slider(Coulomb(0)), pulses(0.005, 1), duration);
  double expected = std::exp(-5.0), weight = expected;
  for (int n = 1; n < 80; ++n) expected += (weight *= 5.0 / n) * std::erfc(-2 / std::sqrt(2.0 * n)) / 2;
  bench::require_below("distribution", std::abs(mixture.cdf(2) - expected), 3e-6);
}

// ---- timing

constexpr int curve_points = 31;  // mu from 0.01 to 0.61

template <class Theory>
double figure_57(const Theory& theory) {
  double sum = 0;
  for (const std::string_view event : PoissonPulses::events())
    for (int i = 0; i < curve_points; ++i)
      sum += theory.final_rms(Slider(Coulomb::from_friction(0.01 + 0.02 * i)), PoissonPulses::event(event));
  return sum;
}

/// Milliseconds of one prediction.
std::vector<bench::Timing> time_points(int rounds) {
  bench::Bench bench(1'000'000);  // items are a millionth of a call: ns per item are ms per call
  for (const auto& [sigma, rate] : {std::pair{1.0 / 3, 0.5},
                                    {1.0 / 3, 2.0},
                                    {1.0, 0.5},
                                    {1.0, 2.0},
                                    {3.0, 2.0},
                                    {5.0, 0.5},
                                    {5.0, 2.0},
                                    {20.0, 0.5},
                                    {20.0, 2.0}}) {
    char name[64];
    std::snprintf(name, sizeof name, "chain, sigma/a %.3g, lambda dt %.3g", sigma, rate);
    bench.add(name, [=] { bench::keep(PulseChain().predict(block, pulses(rate, sigma), late)); });
  }
  bench.add("superposition, sigma/a 1, lambda dt 0.5",
            [] { bench::keep(PulseSuperposition().predict(block, pulses(0.5, 1), late)); });
  bench.add("distribution by FFT, sigma/a 1, lambda dt 0.1",
            [] { bench::keep(PulseSuperposition().distribution(block, pulses(0.1, 1), duration)); });
  return bench.run(rounds);
}

std::vector<bench::Timing> time_slow(int rounds) {
  bench::Bench bench(1'000'000);
  for (const auto& [sigma, rate] : {std::pair{1.0 / 3, 0.5}, {1.0, 0.5}, {1.0, 2.0}}) {
    char name[64];
    std::snprintf(name, sizeof name, "refined chain, sigma/a %.3g, lambda dt %.3g", sigma, rate);
    bench.add(name, [=] { bench::keep(PulseChain(true).predict(block, pulses(rate, sigma), late)); });
  }
  bench.add("figure 5.7, 124 points: superposition", [] { bench::keep(figure_57(PulseSuperposition())); });
  bench.add("figure 5.7, 124 points: chain", [] { bench::keep(figure_57(PulseChain())); });
  return bench.run(rounds);
}

// ---- the map

struct Ratio {
  double value, error;
};

/// Ratio of theory to simulation.
Ratio ratio(double theory, const Estimate& found) {
  return {theory / found.value, theory / found.value * (found.error / found.value)};
}

void print_map() {
  constexpr std::array sigmas = {0.2, 0.25, 1.0 / 3, 0.5, 1.0, 2.0, 3.0, 5.0, 10.0, 20.0};
  constexpr std::array rates = {0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 4.0};
  constexpr double max_pulses = 1e8;  // of one ensemble
  std::printf("theory / simulation, its standard error in the last digits; R growth rate, V velocity variance\n");
  std::printf("%7s %6s %22s %22s %13s %6s %6s %6s %6s %13s %6s %6s %6s %6s\n", "sigma/a", "rate", "R", "V", "R: chain",
              "fine", "none", "thesis", "renew", "V: chain", "fine", "none", "thesis", "renew");
  for (const double sigma : sigmas)
    for (const double rate : rates) {
      const PoissonPulses source = pulses(rate, sigma);
      EnsembleOptions how;
      how.members = static_cast<std::uint64_t>(max_pulses / (rate * duration));
      how.seed = 1;
      how.threads = 1;
      how.dt = duration / 32;
      how.velocity_spectrum = false;
      const Stationary found = run_ensemble(block, source, how).stationary();
      const Estimate growth = found.growth_rate, variance = found.velocity_variance;
      std::vector<Moments> theories = {PulseChain().predict(block, source, late),
                                       PulseChain(true).predict(block, source, late)};
      for (const Overlap overlap : {Overlap::none, Overlap::thesis, Overlap::renewal})
        theories.push_back(PulseSuperposition(overlap).predict(block, source, late));
      std::printf("%7.4f %6.3g %12.5g (%7.1g) %12.5g (%7.1g)", sigma, rate, growth.value, growth.error, variance.value,
                  variance.error);
      for (std::size_t i = 0; i < theories.size(); ++i) {
        const Ratio r = ratio(theories[i].growth_rate.value, growth);
        i == 0 ? std::printf(" %6.3f+-%5.3f", r.value, r.error) : std::printf(" %6.3g", r.value);
      }
      for (std::size_t i = 0; i < theories.size(); ++i) {
        const Ratio r = ratio(theories[i].velocity_variance.value[0], variance);
        i == 0 ? std::printf(" %6.3f+-%5.3f", r.value, r.error) : std::printf(" %6.3g", r.value);
      }
      std::printf("\n");
      std::fflush(stdout);
    }
}

void print_rows(const std::vector<bench::Timing>& rows, bool& first) {
  for (const bench::Timing& timing : rows) {
    std::printf("%s\n  %s: {\"median\": %.4f, \"least\": %.4f, \"spread\": %.3f}", first ? "" : ",",
                bench::json_string(timing.name).c_str(), timing.median(), timing.least(), timing.spread());
    first = false;
  }
}

}  // namespace

int main(int argc, char** argv) {
  const bench::Options asked = bench::options(argc, argv, "pulse_theories", "--map");
  if (asked.additional) {
    bench::print_machine();
    print_map();
    return EXIT_SUCCESS;
  }
  check();
  if (asked.check) return EXIT_SUCCESS;

  const auto points = time_points(asked.rounds), slow = time_slow(std::max(3, asked.rounds / 4));
  if (asked.json) {
    bool first = true;
    std::printf("{\"unit\": \"ms\", \"rows\": {");
    print_rows(points, first);
    print_rows(slow, first);
    std::printf("}}\n");
    return EXIT_SUCCESS;
  }
  bench::print_machine();
  std::printf("answers checked; times over %d rounds (refined, figures: %d)\n", asked.rounds,
              std::max(3, asked.rounds / 4));
  bench::print_table("ms per prediction", points, points.size() - 1);
  bench::print_table("ms", slow, slow.size() - 2);
  return EXIT_SUCCESS;
}
