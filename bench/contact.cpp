// Supports and laws beyond level ground: the cost of vertical motion, a slope, stops, static friction, and friction
// that depends on the speed, the sliding distance or the temperature, compared with the same slider without them.
//
// contact [--check] [--json] [--rounds N]
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <stickslip/core.hpp>
#include <stickslip/stickslip.hpp>
#include <string>
#include <vector>

#include "bench.hpp"

using namespace stickslip;

namespace {

constexpr std::size_t samples = 4096;
constexpr double dt = 0.01, level = 1, frequency = 3;

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

const GroundMotion horizontal(noise(1, 1.5), dt);
const GroundMotion shaken = horizontal.with_components({}, noise(2, 1));

Slider<Coulomb> on(const Mounting& mounting) { return Slider(Coulomb(level), mounting); }

KumarFriction heated(double conductivity = 18) {
  return KumarFriction({.mu_ref = 0.1,
                        .static_pressure = 50e6,
                        .reference_pressure = 50e6,
                        .contact_radius = 0.2,
                        .conductivity = conductivity});
}

void check() {
  const auto closes = [](const std::string& name, const auto& slider, const GroundMotion& motion) {
    const Response r = integrate(slider, motion);
    bench::require_below(name + ": energy that does not add up", std::abs(r.energy.imbalance()),
                         1e-12 * (std::abs(r.energy.input) + r.energy.dissipated));
  };
  const Coulomb law(level);
  closes("vertical motion", law, shaken);
  closes("stops that are hit", on({.stops = {0.02, 0.5}}), shaken);
  closes("slope", on({.slope_degrees = 3}), shaken);
  const GroundMotion still = horizontal.with_components({}, std::vector<double>(samples));
  const auto same = [](const std::string& name, const Response& one, const Response& other) {
    bench::require_below(name + ": residual", std::abs(one.residual - other.residual), 1e-12 * other.peak);
    bench::require_below(name + ": peak", std::abs(one.peak - other.peak), 1e-12 * other.peak);
  };
  same("a vertical motion of none", integrate(law, still), integrate(law, horizontal));
  same("stops far away", integrate(on({.stops = {1e3, 0.5}}), horizontal), integrate(law, horizontal));
  same("equal levels", integrate(StaticKinetic(law, level), horizontal), integrate(law, horizontal));
  same("a level that stays", integrate(Degrading({0, 1}, {level, level}), horizontal), integrate(law, horizontal));
  closes("degrading, spring", Slider(Degrading({0, 0.5, 2}, {level, 0.5 * level, level}), frequency), shaken);
  closes("temperature", Slider(heated(), frequency), horizontal);
  const KumarFriction cold = heated(std::numeric_limits<double>::infinity());
  const double fast = cold.level(1e3, 1, 0);
  const Response one = integrate(Slider(cold, frequency), horizontal);
  const Response other = integrate(Slider(VelocityDependent(fast / 2, fast, 100), frequency), horizontal);
  bench::require_below("a surface that stays cold: peak", std::abs(one.peak - other.peak), 1e-7 * other.peak);
  same("equal speeds", integrate(VelocityDependent(level, level, 20), horizontal), integrate(law, horizontal));
}

}  // namespace

int main(int argc, char** argv) {
  const bench::Options asked = bench::options(argc, argv, "contact");
  check();
  if (asked.check) return EXIT_SUCCESS;

  bench::Bench bench(samples * 20);
  const auto add = [&](const std::string& name, const auto& slider, const GroundMotion& motion) {
    bench.add(name, [slider, &motion] {
      Response r;
      for (int i = 0; i < 20; ++i) bench::keep(r = integrate(slider, motion, {}, std::move(r)));
    });
  };
  const VelocityDependent liner(0.5 * level, level, 20);
  const Degrading degrading({0, 0.5, 2}, {level, 0.5 * level, level});
  add("Coulomb", Slider(Coulomb(level)), horizontal);
  add("Coulomb, vertical motion", Slider(Coulomb(level)), shaken);
  add("Coulomb, stops far away", on({.stops = {1e3, 0.5}}), horizontal);
  add("Coulomb, slope", on({.slope_degrees = 3}), horizontal);
  add("static above kinetic", Slider(StaticKinetic(Coulomb(level), 1.3 * level)), horizontal);
  add("Coulomb, spring", on({.natural_frequency = frequency}), horizontal);
  add("Coulomb, spring, vertical motion", on({.natural_frequency = frequency}), shaken);
  add("Coulomb, spring, stops far away", on({.natural_frequency = frequency, .stops = {1e3, 0.5}}), horizontal);
  add("degrading", Slider(degrading), horizontal);
  add("degrading, vertical motion", Slider(degrading), shaken);
  add("degrading, spring", Slider(degrading, frequency), horizontal);
  add("velocity-dependent, spring", Slider(liner, frequency), horizontal);
  add("velocity-dependent, spring, vertical motion", Slider(liner, frequency), shaken);
  add("velocity-dependent, pendulum, vertical motion",
      Slider(liner, Mounting{.natural_frequency = frequency, .pendulum = true}), shaken);

  add("pressure, speed and temperature, spring", Slider(heated(), frequency), horizontal);

  const auto timings = bench.run(asked.rounds);
  if (asked.json) {
    bench::print_rows(timings);
    return EXIT_SUCCESS;
  }
  bench::print_machine();
  std::printf("%zu samples 0.01 s apart; answers checked; ns of processor time, %d rounds\n", samples, asked.rounds);
  bench::print_table("integrate, each sample", timings, 0);
  return EXIT_SUCCESS;
}
