// Harmonic ground motion: the cost of a cycle of integrate, compared with a sampled motion of the same accuracy; and
// the cost of orbits.
//
// orbits [--check] [--json] [--rounds N]
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <stickslip/stickslip.hpp>
#include <string>
#include <vector>

#include "bench.hpp"

using namespace stickslip;

namespace {

constexpr double load = 1.5, omega = 0.7, slip_level = 1, reach = 1, frequency = 1.3;
constexpr double cycles = 200;
constexpr double fine = 4000;  // samples per cycle, for an error of some 1e-6 per cycle

const double period = 2 * std::numbers::pi / omega;

template <class Visit>
void for_each_slider(Visit&& visit) {
  visit("Coulomb", Slider(Coulomb(slip_level)));
  visit("Coulomb, spring", Slider(Coulomb(slip_level), frequency));
  visit("Caster", Slider(Caster(slip_level, reach)));
  visit("Caster, spring", Slider(Caster(slip_level, reach), frequency));
}

/// The motion with this many samples per cycle.
HarmonicMotion motion(double samples) { return {load, omega, cycles * period, period / samples}; }

// Orbits of a caster as its frequency rises: from the large orbit around the fold to the small one.
constexpr double caster_load = 1, caster_omega = 0.5, low = 0.3, high = 2;
OrbitBranch caster_branch() {
  const Caster law(slip_level, reach);
  return continuation(law, orbits(law, caster_load, caster_omega).back(), low, high);
}

void check() {
  for_each_slider([](const std::string& name, const auto& slider) {
    const Response exact = integrate(slider, motion(64)), coarse = integrate(slider, motion(1));
    bench::require_below(name + ": x where it is asked for once a cycle", std::abs(exact.residual - coarse.residual),
                         1e-11 * exact.peak);
    bench::require_below(name + ": energy that does not add up", std::abs(exact.energy.imbalance()),
                         1e-12 * load * exact.sliding_distance);
    bench::require_below(name + ": x of fine samples",
                         std::abs(integrate(slider, motion(1).sampled(period / fine)).residual - exact.residual),
                         1e-3 * exact.peak);
    for (const Orbit& orbit : orbits(slider, load, omega)) {
      IntegrateOptions start;
      start.displacement = orbit.state.displacement;
      start.velocity = orbit.state.velocity;
      const double end = integrate(slider, HarmonicMotion(load, omega, period), start).residual;
      bench::require_below(name + ": an orbit that does not close", std::abs(end - orbit.state.displacement),
                           1e-10 * orbit.amplitude);
    }
  });
  const OrbitBranch branch = caster_branch();
  bench::require(branch.folds.size() == 1, "folds of the branch", static_cast<double>(branch.folds.size()), 1);
}

}  // namespace

int main(int argc, char** argv) {
  const bench::Options asked = bench::options(argc, argv, "orbits");
  check();
  if (asked.check) return EXIT_SUCCESS;

  const GroundMotion sampled = motion(1).sampled(period / fine);
  bench::Bench integration(static_cast<std::size_t>(cycles));
  for_each_slider([&](const std::string& name, const auto& slider) {
    integration.add(name + ", x once a cycle", [slider] { bench::keep(integrate(slider, motion(1))); });
    integration.add(name + ", x 64 times a cycle", [slider] { bench::keep(integrate(slider, motion(64))); });
    integration.add(name + ", 4000 straight lines a cycle",
                    [slider, &sampled] { bench::keep(integrate(slider, sampled)); });
  });
  bench::Bench shooting(1);
  shooting.add("Coulomb, closed form", 100, [] {
    for (int i = 0; i < 100; ++i) bench::keep(orbits(Coulomb(slip_level), 3, omega));
  });
  shooting.add("Coulomb, spring, Den Hartog", 100, [] {
    for (int i = 0; i < 100; ++i) bench::keep(orbits(Slider(Coulomb(slip_level), frequency), 3, omega));
  });
  shooting.add("Coulomb, spring, with stops",
               [] { bench::keep(orbits(Slider(Coulomb(slip_level), frequency), 1.2, omega)); });
  shooting.add("Caster, all three", [] { bench::keep(orbits(Caster(slip_level, reach), caster_load, caster_omega)); });
  shooting.add("Caster, continuation, each orbit", static_cast<double>(caster_branch().orbits.size()),
               [] { bench::keep(caster_branch()); });

  const auto cycle_times = integration.run(asked.rounds), orbit_times = shooting.run(asked.rounds);
  if (asked.json) {
    std::printf("{\"commit\": %s, \"rows\": {", bench::json_string(build_info().commit).c_str());
    const char* comma = "";
    for (const auto* timings : {&cycle_times, &orbit_times})
      for (const bench::Timing& timing : *timings) {
        std::printf("%s\n  %s: {\"median\": %.3f, \"least\": %.3f, \"spread\": %.3f}", comma,
                    bench::json_string(timing.name).c_str(), timing.median(), timing.least(), timing.spread());
        comma = ",";
      }
    std::printf("}}\n");
    return EXIT_SUCCESS;
  }
  bench::print_machine();
  std::printf("B = %g m/s^2 at %g rad/s, slip level %g m/s^2; answers checked; ns of processor time, %d rounds\n", load,
              omega, slip_level, asked.rounds);
  bench::print_table("integrate, each cycle", cycle_times, 0);
  bench::print_table("orbits, each call", orbit_times, 0);
  return EXIT_SUCCESS;
}
