// The covariance under white noise for one caster, with each force: steps and time of one solution.
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <vector>

#include "bench.hpp"
#include "stickslip/theory/equivalent_linearization.hpp"
#include "stickslip/theory/white_noise.hpp"
#include "theory/covariance.hpp"

using namespace stickslip;
using theory::EquivalentLinearization;
using Force = EquivalentLinearization::Force;

namespace {

constexpr double pi = std::numbers::pi;

struct Bump {  // a user's law
  double slip_level, reach;
  template <class T>
  auto resist(const T& x, Direction) const {
    using std::exp;
    return slip_level * exp(-(x / reach) * (x / reach));
  }
};

double apart(const Moments& a, const Moments& b) {
  double largest = 0;
  for (const auto figure : {&Moments::displacement_variance, &Moments::covariance, &Moments::velocity_variance})
    for (std::size_t i = 0; i < a.time.size(); ++i)
      largest = std::max(largest, std::abs((a.*figure).value[i] / (b.*figure).value[i] - 1));
  return largest;
}

}  // namespace

int main(int argc, char** argv) {
  const bench::Options options = bench::options(argc, argv, "equivalent_linearization");

  // Thesis figures 3.1 to 3.3: a^2 t / S0 from 0.1 to 1000, nine times a decade.
  std::vector<double> times;
  for (int i = 0; i <= 36; ++i) times.push_back(std::pow(10, i / 9.0 - 1));
  const Caster wheel(1, 100);  // gamma = 0.01
  constexpr double tolerance = 1e-8;
  const EquivalentLinearization gaussian({.tolerance = tolerance}),
      thesis({.force = Force::thesis, .tolerance = tolerance});
  const theory::WhiteNoise exact = theory::WhiteNoise::coulomb(1, 1.0);

  bench::require_below(
      "gaussian force, relative error",
      apart(gaussian.predict(wheel, 1, times), EquivalentLinearization({.tolerance = 1e-12}).predict(wheel, 1, times)),
      10 * tolerance);
  bench::require_below(
      "thesis's force, relative error",
      apart(thesis.predict(wheel, 1, times),
            EquivalentLinearization({.force = Force::thesis, .tolerance = 1e-12}).predict(wheel, 1, times)),
      10 * tolerance);
  // (3.47) and (3.49), the growth of late displacements
  const std::vector<double> late = {1e4, 2e4};
  const auto growth = [&](const Moments& m) {
    return (m.displacement_variance.value[1] - m.displacement_variance.value[0]) / 1e4;
  };
  bench::require_below("growth, equivalent linearization",
                       std::abs(growth(gaussian.predict(Coulomb(1), 1, late)) / (std::pow(pi, 5) / 2) - 1), 1e-7);
  bench::require_below("growth, exact", std::abs(growth(exact.predict(late)) / (10 * pi * pi * pi) - 1), 1e-10);
  if (options.check) return 0;

  constexpr int repeats = 10;
  bench::Bench work(repeats);
  const auto solve = [&](const std::string& name, auto&& predict) {
    work.add(name, [predict] {
      for (int i = 0; i < repeats; ++i) bench::keep(predict());
    });
  };
  solve("caster, gaussian", [&] { return gaussian.predict(wheel, 1, times); });
  solve("caster, thesis", [&] { return thesis.predict(wheel, 1, times); });
  solve("Coulomb", [&] { return gaussian.predict(Coulomb(1), 1, times); });
  solve("a user's law, gaussian", [&] { return gaussian.predict(Bump{1, 100}, 1, times); });
  solve("Coulomb, exactly", [&] { return exact.predict(times); });
  std::vector<bench::Timing> timings = work.run(options.rounds);
  for (bench::Timing& timing : timings)
    for (double& time : timing.times) time /= 1000;

  if (options.json) {
    std::printf("{\"machine\": %s", bench::json_string(bench::processor()).c_str());
    for (const auto& timing : timings)
      std::printf(", %s: {\"us\": %.4g, \"spread\": %.3g}", bench::json_string(timing.name).c_str(), timing.median(),
                  timing.spread());
    std::printf("}\n");
    return 0;
  }
  bench::print_machine();
  std::printf("\n");
  for (const auto& [name, force] : {std::pair{"gaussian", Force::gaussian}, std::pair{"thesis", Force::thesis}})
    for (const double wanted : {1e-6, 1e-8, 1e-10}) {
      const auto solution = detail::solve_covariance(wheel, 0, 1, times, {.force = force, .tolerance = wanted});
      std::printf("%-9s tolerance %g: %ld steps, %ld evaluations\n", name, wanted, solution.steps,
                  solution.evaluations);
    }
  bench::print_table("gamma = 0.01, 37 times: us per solution", timings, 0);
}
