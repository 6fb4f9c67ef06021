// Two horizontal directions: the cost of a sample at rest and of a sliding sample, with and without a spring, and of a
// sample of an ensemble under random pairs, with motions and statistics, beside the return mapping that a user would
// write: backward Euler steps, which shrink the velocity vector by a dt.
//
// planar [--check] [--json] [--rounds N]
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <stickslip/core.hpp>
#include <stickslip/stickslip.hpp>
#include <string>
#include <vector>

#include "bench.hpp"
#include "stickslip/ensemble/run.hpp"
#include "stickslip/excitation/with_transverse.hpp"
#include "stickslip/planar/integrate.hpp"

using namespace stickslip;

namespace {

constexpr std::size_t samples = 4096;
constexpr double dt = 0.01, frequency = 3;
constexpr double weak = 0.3, strong = 4;  // slip levels that nearly always slip, and rarely [m/s^2]

// Noise with a correlation time of 0.1 s, from a separate multiplicative generator.
std::vector<double> noise(unsigned seed, double deviation) {
  std::vector<double> values(samples);
  double value = 0;
  unsigned state = seed;
  for (double& n : values) {
    double sum = -6;
    for (int i = 0; i < 12; ++i) sum += (state = state * 1664525U + 1013904223U) / 4294967296.0;
    n = value = 0.9 * value + 0.436 * deviation * sum;
  }
  values.back() = 0;
  return values;
}

const std::vector<double> axis = noise(1, 1.5), transverse = noise(3, 1.5);
const GroundMotion pair = GroundMotion(axis, dt).with_components(transverse);
const GroundMotion held = GroundMotion(axis, dt, Interpolation::constant).with_components(transverse);
const GroundMotion shaken = GroundMotion(axis, dt).with_components(transverse, noise(2, 1));

const WithTransverse random_pairs(GaussianExcitation(Spectrum::band_pass(0.05, 2, 40), dt, samples));

Ensemble ensemble_of(double level) {
  EnsembleOptions options;
  options.members = 5;
  options.threads = 1;
  return run_ensemble(PlanarSlider(Coulomb(level)), random_pairs, options);
}

PlanarSlider<Coulomb> on(double level, const Mounting& mounting = {}) { return PlanarSlider(Coulomb(level), mounting); }

// The peak of the same slider by return mapping, in `steps` steps a sample [m].
double mapped(double level, double wn, int steps) {
  const double h = dt / steps, spring = wn * wn;
  double x = 0, y = 0, vx = 0, vy = 0, peak = 0;
  for (std::size_t i = 0; i + 1 < samples; ++i)
    for (int k = 1; k <= steps; ++k) {
      const double part = static_cast<double>(k) / steps;
      const double nx = axis[i] + part * (axis[i + 1] - axis[i]);
      const double ny = transverse[i] + part * (transverse[i + 1] - transverse[i]);
      // (1 + wn^2 h^2) v = v0 - h (n + wn^2 x), less friction along it
      const double tx = vx - h * (nx + spring * x), ty = vy - h * (ny + spring * y);
      const double trial = std::sqrt(tx * tx + ty * ty);
      const double left = trial > h * level ? (trial - h * level) / (trial * (1 + spring * h * h)) : 0;
      vx = left * tx, vy = left * ty;
      x += h * vx, y += h * vy;
      peak = std::max(peak, x * x + y * y);
    }
  return std::sqrt(peak);
}

// The steps a sample with which the return mapping is off by at most a part of the peak.
int steps_for(double level, double wn, double part) {
  const double peak = integrate(on(level, {.natural_frequency = wn}), pair).peak;
  int steps = 1;
  while (steps < 1 << 14 && std::abs(mapped(level, wn, steps) - peak) > part * peak) steps *= 2;
  return steps;
}

void check() {
  const auto closes = [](const std::string& name, const auto& slider, const GroundMotion& motion) {
    const PlanarResponse r = integrate(slider, motion);
    bench::require_below(name + ": energy that does not add up", std::abs(r.energy.imbalance()),
                         1e-12 * (std::abs(r.energy.input) + r.energy.dissipated));
  };
  closes("sliding", on(weak), pair);
  closes("held loads", on(weak), held);
  closes("spring", on(weak, {.natural_frequency = frequency}), pair);
  closes("vertical motion", on(weak), shaken);
  closes("a stop that is hit", on(weak, {.stops = {0.02, 0.5}}), pair);
  // The return mapping converges to it, with the order of its step.
  for (const double wn : {0.0, frequency}) {
    const double peak = integrate(on(weak, {.natural_frequency = wn}), pair).peak;
    bench::require_below("peak beside that of the return mapping", std::abs(mapped(weak, wn, 256) / peak - 1), 0.01);
  }
  const double member = integrate(on(weak), random_pairs.sample(0, 3)).peak;
  bench::require_below("ensemble: peak of a member", std::abs(ensemble_of(weak).peak()[3] - member), 1e-12 * member);
  // One axis.
  const GroundMotion one = pair.with_components(std::vector<double>(samples));
  const double peak = integrate(Coulomb(weak), pair).peak;
  bench::require_below("one axis: peak", std::abs(integrate(on(weak), one).peak - peak), 1e-11 * peak);
}

}  // namespace

int main(int argc, char** argv) {
  const bench::Options asked = bench::options(argc, argv, "planar");
  check();
  if (asked.check) return EXIT_SUCCESS;

  bench::Bench bench(samples * 5);
  const auto add = [&](const std::string& name, const auto& slider, const GroundMotion& motion) {
    bench.add(name, [slider, &motion] {
      PlanarResponse r;
      for (int i = 0; i < 5; ++i) bench::keep(r = integrate(slider, motion, {}, std::move(r)));
    });
  };
  add("at rest", on(1e3), pair);
  add("sliding", on(weak), pair);
  add("sliding, held loads", on(weak), held);
  add("sliding, spring", on(weak, {.natural_frequency = frequency}), pair);
  add("sliding, vertical motion", on(weak), shaken);
  add("short slips", on(strong), pair);
  add("stop that is hit", on(weak, {.stops = {0.02, 0.5}}), pair);
  bench.add("ensemble of random pairs, sliding", [] { bench::keep(ensemble_of(weak)); });
  bench.add("ensemble of random pairs, rarely slipping", [] { bench::keep(ensemble_of(2 * strong)); });
  bench.add("motions of these pairs alone", [] {
    for (std::uint64_t i = 0; i < 5; ++i) bench::keep(random_pairs.sample(0, i));
  });
  bench.add("one axis, sliding", [] {
    Response r;
    for (int i = 0; i < 5; ++i) bench::keep(r = integrate(Slider(Coulomb(weak)), pair, {}, std::move(r)));
  });
  const int fine = steps_for(weak, 0, 1e-6);
  const auto add_mapped = [&](int steps) {
    bench.add("return mapping, " + std::to_string(steps) + " steps a sample", [steps] {
      for (int i = 0; i < 5; ++i) bench::keep(mapped(weak, 0, steps));
    });
  };
  add_mapped(1);
  add_mapped(fine);

  const auto timings = bench.run(asked.rounds);
  if (asked.json) {
    bench::print_rows(timings);
    return EXIT_SUCCESS;
  }
  bench::print_machine();
  bench::print_table("ns a sample", timings, 1);
  const double exact = integrate(on(weak), pair).peak;
  for (const int steps : {1, fine})
    std::printf("error of the peak by return mapping with %d steps a sample: %.1e\n", steps,
                std::abs(mapped(weak, 0, steps) / exact - 1));
  return EXIT_SUCCESS;
}
