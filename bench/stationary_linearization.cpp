// Stationary linearization: the map of thesis figure 4.1, other spectra, and ensembles of the linear system compared
// with those of the slider.
//
// stationary_linearization [--check] [--json] [--rounds N]
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <stickslip/stickslip.hpp>
#include <string>
#include <utility>
#include <vector>

#include "bench.hpp"

using namespace stickslip;

namespace {

constexpr int side = 20;  // of the map: Omega1 and dOmega from 0.1 to 2
constexpr double pi = std::numbers::pi, band = 20 / (pi * pi);
constexpr std::size_t samples = 1024, members = 1000;

const theory::StationaryLinearization method;

Spectrum figure_44() { return Spectrum::band_pass(1, band, 2 * band); }
Spectrum soil() { return Spectrum::kanai_tajimi(0.1, 15, 0.6); }
GaussianExcitation shaking() { return {figure_44(), 0.1, samples}; }
PoissonPulses pulses() { return PoissonPulses::event("great very near field"); }

double map() {
  double sum = 0;
  for (int i = 1; i <= side; ++i)
    for (int j = 1; j <= side; ++j)
      sum += method.predict(Coulomb(1), Spectrum::band_pass(1, 0.1 * i, 0.1 * (i + j))).velocity_std;
  return sum;
}

EnsembleOptions options(bool velocity_spectrum = false) {
  EnsembleOptions result;
  result.members = members;
  result.seed = 1;
  result.threads = 1;
  result.velocity_spectrum = velocity_spectrum;
  return result;
}

void check() {
  // values.json: eql.O1_2.0264237.dO_2.0264237, eql.O1_0.1.dO_0.35, eql.O1_1.0.dO_0.32, eql.fig44.linear_transient
  const auto near = [](const std::string& what, double found, double wanted, double allowed) {
    bench::require_below(what + ", relative", std::abs(found / wanted - 1), allowed);
  };
  const auto p = method.predict(Coulomb(1), figure_44());
  near("damping of figure 4.4", p.damping, 1.253278653954749998, 1e-13);
  near("deviation of x", p.displacement_std, 0.2369294374108595, 1e-13);
  near("near the threshold", method.predict(Coulomb(1), Spectrum::band_pass(1, 1, 1.32)).damping, 15.96868062615432689,
       1e-11);
  near("transient", std::sqrt(p.transient(std::vector{1.0}).velocity_variance.value[0]), 0.7904907371388612, 1e-8);
  // Each point of the map solves (4.35).
  for (int i = 1; i <= side; ++i)
    for (int j = 1; j <= side; ++j) {
      const double low = 0.1 * i, high = 0.1 * (i + j);
      const double z = method.predict(Coulomb(1), Spectrum::band_pass(1, low, high)).damping;
      if (std::isfinite(z))
        bench::require_below("a point of the map",
                             std::abs(pi * z * std::atan((high - low) / (z + low * high / z)) - 1), 1e-13);
      else
        bench::require_below("a point of the map without motion", high - low, 1 / pi);
    }
  const ViscousSlider linear(p.damping);
  const auto members_of = [&](const auto& excitation) {
    const Ensemble e = run_ensemble(linear, excitation, options());
    const auto peak = e.peak(), residual = e.residual();
    double worst = 0;
    for (std::uint64_t i = 0; i < 50; ++i) {
      const Response r = integrate(linear, excitation.sample(1, i));
      worst = std::max({worst, std::abs(peak[i] - r.peak), std::abs(residual[i] - r.residual)});
    }
    return worst;
  };
  bench::require_below("members of the linear ensemble from integrate's [m]", members_of(shaking()), 1e-12);
  bench::require_below("... under pulses [m]", members_of(pulses()), 1e-12);
}

struct Table {
  std::string title;
  std::vector<bench::Timing> timings;
};

Table time_theory(int rounds) {
  bench::Bench bench(1);
  bench.add("map of figure 4.1, 400 points", 1e3, [] { bench::keep(map()); });
  bench.add("a point by quadrature: Kanai-Tajimi", 1e3, [] { bench::keep(method.predict(Coulomb(1), soil())); });
  bench.add("... with a spring", 1e3, [] { bench::keep(method.predict(Slider(Coulomb(1), 3), soil())); });
  const auto band_pass = method.predict(Coulomb(1), figure_44()), from_soil = method.predict(Coulomb(1), soil());
  const std::vector<double> times{0.1, 1, 10, 100};
  bench.add("from rest, a time: band-pass", 4e3, [=] { bench::keep(band_pass.transient(times)); });
  bench.add("... Kanai-Tajimi", 4e3, [=] { bench::keep(from_soil.transient(times)); });
  return {"theory: us", bench.run(rounds)};
}

Table time_ensembles(int rounds) {
  bench::Bench bench(members * samples);
  const ViscousSlider linear(method.predict(Coulomb(1), figure_44()).damping);
  bench.add("viscous, run_ensemble", [=] { bench::keep(run_ensemble(linear, shaking(), options())); });
  bench.add("... velocity spectrum as well", [=] { bench::keep(run_ensemble(linear, shaking(), options(true))); });
  bench.add("Coulomb, run_ensemble", [] { bench::keep(run_ensemble(Coulomb(1), shaking(), options())); });
  bench.add("viscous, integrate one by one", [=, response = Response()]() mutable {
    for (std::uint64_t i = 0; i < members; ++i) {
      response = integrate(linear, shaking().sample(1, i), {}, std::move(response));
      bench::keep(response);
    }
  });
  double steps = 0;
  for (std::uint64_t i = 0; i < members; ++i) steps += static_cast<double>(pulses().sample(1, i).segments());
  bench.add("viscous, pulses, run_ensemble: a step", steps + 512.0 * members,
            [=] { bench::keep(run_ensemble(linear, pulses(), options())); });
  return {"ensembles: ns per sample", bench.run(rounds)};
}

}  // namespace

int main(int argc, char** argv) {
  const bench::Options asked = bench::options(argc, argv, "stationary_linearization");
  check();
  if (asked.check) return EXIT_SUCCESS;
  const std::vector<Table> tables{time_theory(asked.rounds), time_ensembles(asked.rounds)};
  if (asked.json) {
    std::printf("{");
    const char* before = "";
    for (const Table& table : tables)
      for (const bench::Timing& t : table.timings)
        std::printf("%s%s: %.6g", std::exchange(before, ", "), bench::json_string(t.name).c_str(), t.median());
    std::printf("}\n");
    return EXIT_SUCCESS;
  }
  bench::print_machine();
  std::printf("answers checked; times over %d rounds\n", asked.rounds);
  for (const Table& table : tables) bench::print_table(table.title, table.timings, 0);
  return EXIT_SUCCESS;
}
