// The response map of the caster, thesis figure 2.2: seven curves, B/a from 0.5 to 8, of 400 points each. As a function
// of the amplitude, a curve is a formula; as a function of the frequency, where several amplitudes may exist, it
// requires root finding.
//
// response_map [--check] [--json] [--rounds N]
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <stickslip/stickslip.hpp>
#include <string>
#include <vector>

#include "bench.hpp"

using namespace stickslip;

namespace {

constexpr double strengths[] = {0.5, 1, 1.25, 1.3, 2, 4, 8};  // B/a
constexpr std::size_t points = 400;
constexpr double natural_frequency = 0.7;

/// From `first` to `last`, in even ratios.
std::vector<double> geometric(double first, double last) {
  std::vector<double> values;
  for (std::size_t i = 0; i < points; ++i)
    values.push_back(first * std::pow(last / first, static_cast<double>(i) / (points - 1)));
  return values;
}

// A user-defined law: the caster again.
struct Own {
  template <class T>
  auto resist(const T& x, Direction) const {
    return 1.0 * sech(x);
  }
};

/// A and the frequency, for A from far below the reach to far above it.
double along_amplitudes(const theory::SlowlyVaryingParameters& svp, const std::vector<double>& amplitudes) {
  double sum = 0;
  for (const double B : strengths)
    for (const double amplitude : amplitudes) {
      const double frequency = svp.frequency(B, amplitude).upper;
      if (frequency > 0) sum += frequency;
    }
  return sum;
}

double along_frequencies(const theory::SlowlyVaryingParameters& svp, const std::vector<double>& frequencies) {
  double sum = 0;
  for (const double B : strengths)
    for (const double omega : frequencies)
      for (const theory::HarmonicSolution& solution : svp.response(B, omega)) sum += solution.amplitude;
  return sum;
}

void check(const std::string& name, const theory::SlowlyVaryingParameters& svp, double wn, double allowed,
           const std::vector<double>& frequencies) {
  std::size_t found = 0;
  double worst = 0;
  for (const double B : strengths)
    for (const double omega : frequencies)
      for (const theory::HarmonicSolution& solution : svp.response(B, omega)) {
        const double s = svp.dissipative(solution.amplitude),
                     e = svp.in_phase(solution.amplitude) - omega * omega * solution.amplitude;
        const double scale = B * B + (wn * wn + omega * omega) * solution.amplitude * B;
        worst = std::max(worst, std::abs(s * s + e * e - B * B) / scale);
        ++found;
      }
  bench::require_below(name + ": residual of (2.16)", worst, allowed);
  bench::require(found > frequencies.size(), name + ": solutions", static_cast<double>(found),
                 static_cast<double>(frequencies.size()));
}

}  // namespace

int main(int argc, char** argv) {
  const bench::Options options = bench::options(argc, argv, "response_map");
  const std::vector<double> amplitudes = geometric(1e-3, 1e3), frequencies = geometric(0.05, 5);
  const theory::SlowlyVaryingParameters coulomb(Coulomb(1)), caster(Caster(1, 1)),
      sprung(Slider(Caster(1, 1), natural_frequency)), own(Own{});
  check("Coulomb", coulomb, 0, 1e-14, frequencies);
  check("caster", caster, 0, 1e-14, frequencies);
  check("caster, spring", sprung, natural_frequency, 1e-14, frequencies);
  check("user's law", own, 0, 1e-8, {0.1, 0.5, 1, 2});  // S by quadrature to 1e-10
  if (options.check) return EXIT_SUCCESS;

  const double curve_points = static_cast<double>(std::size(strengths) * points);
  bench::Bench work(1);
  work.add("caster, by amplitude", curve_points * 1e3, [&] { bench::keep(along_amplitudes(caster, amplitudes)); });
  work.add("Coulomb, by frequency", curve_points * 1e3, [&] { bench::keep(along_frequencies(coulomb, frequencies)); });
  work.add("caster, by frequency", curve_points * 1e3, [&] { bench::keep(along_frequencies(caster, frequencies)); });
  work.add("caster, spring, by frequency", curve_points * 1e3,
           [&] { bench::keep(along_frequencies(sprung, frequencies)); });
  const std::vector<double> few{0.1, 0.5, 1, 2};
  work.add("user's law, by frequency", static_cast<double>(std::size(strengths) * few.size()) * 1e3,
           [&] { bench::keep(along_frequencies(own, few)); });
  const std::vector<bench::Timing> timings = work.run(options.rounds);

  if (options.json) {
    std::printf("{");
    for (std::size_t i = 0; i < timings.size(); ++i)
      std::printf("%s%s: {\"median_us\": %.6g, \"spread\": %.3g}", i == 0 ? "" : ", ",
                  bench::json_string(timings[i].name).c_str(), timings[i].median(), timings[i].spread());
    std::printf("}\n");
    return EXIT_SUCCESS;
  }
  bench::print_machine();
  bench::print_table("microseconds a point of a curve", timings, 2);
  return EXIT_SUCCESS;
}
