// The distribution of the displacement under rare pulses: closed forms, independent quadrature, ensembles.
#include "stickslip/theory/displacement_distribution.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "stickslip/ensemble/run.hpp"
#include "stickslip/friction/caster.hpp"
#include "stickslip/theory/pulse_superposition.hpp"
#include "support/catch.hpp"

using namespace stickslip;
using namespace stickslip::theory;
using Catch::Matchers::ContainsSubstring;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

double normal_cdf(double z) { return std::erfc(-z / std::numbers::sqrt2) / 2; }

DisplacementDistribution distribution(const Slider<Coulomb>& block, const PoissonPulses& pulses,
                                      Overlap overlap = Overlap::none) {
  return PulseSuperposition(overlap).distribution(block, pulses, pulses.duration());
}

/// Where a block lies after the motion, ascending.
std::vector<double> simulated(const Slider<Coulomb>& block, const PoissonPulses& pulses) {
  EnsembleOptions options;
  options.members = 100'000;
  options.seed = 1;
  options.dt = pulses.duration();
  options.settle = true;
  options.velocity_spectrum = false;
  std::vector<double> x = run_ensemble(block, pulses, options).residual();
  std::ranges::sort(x);
  return x;
}

/// The share of ascending numbers that is at most x.
double share(const std::vector<double>& ascending, double x) {
  return static_cast<double>(std::ranges::upper_bound(ascending, x) - ascending.begin()) /
         static_cast<double>(ascending.size());
}

}  // namespace

TEST_CASE("the atom at zero is the chance that no pulse exceeds the slip level", "[displacement_distribution]") {
  for (const double sigma : {0.2, 0.5, 1.0, 3.0}) {
    const PoissonPulses pulses(1e-9, 1, sigma, 3e9);  // so rare that pulses of sigma = 0.2 do not act together
    const double expected = 3 * std::erfc(1 / sigma / std::numbers::sqrt2);
    const DisplacementDistribution d = distribution(Slider(Coulomb(1)), pulses);
    CAPTURE(sigma);
    CHECK(d.slips() == Approx(expected).epsilon(1e-12));
    CHECK(d.atom() == Approx(std::exp(-expected)).epsilon(1e-12));
    CHECK(d.cdf(0) == Approx((1 + d.atom()) / 2).epsilon(1e-12));  // as likely forward as backward
    CHECK(d.quantile(0.5) == 0);
    CHECK(d.cdf(infinity) == Approx(1).epsilon(1e-11));
    CHECK(d.cdf(-infinity) == 0);
  }
}

TEST_CASE("mean and variance are those of the superposition, and the excess kurtosis falls as 1 / t",
          "[displacement_distribution]") {
  for (const Overlap overlap : {Overlap::none, Overlap::thesis, Overlap::renewal})
    for (const Coulomb law : {Coulomb(1), Coulomb(1, 1.6)}) {
      const Slider block(law);
      const PoissonPulses pulses(0.05, 1, 1.3, 400);
      const Moments m = PulseSuperposition(overlap).predict(block, pulses, std::vector<double>{200, 400});
      const DisplacementDistribution early = PulseSuperposition(overlap).distribution(block, pulses, 200);
      const DisplacementDistribution late = PulseSuperposition(overlap).distribution(block, pulses, 400);
      CHECK(late.mean() == Approx(m.displacement_mean.value[1]).epsilon(1e-12).margin(1e-15));
      CHECK(late.variance() == Approx(m.displacement_variance.value[1]).epsilon(1e-12));
      CHECK(early.kurtosis() - 3 == Approx(2 * (late.kurtosis() - 3)).epsilon(1e-10));
      CHECK(early.skewness() == Approx(std::sqrt(2.0) * late.skewness()).epsilon(1e-10).margin(1e-15));
      // The tabulated density has them as well, to its step.
      const double step = late.displacement()[1] - late.displacement()[0];
      double mass = late.atom(), mean = 0, square = 0;
      for (std::size_t i = 0; i < late.density().size(); ++i) {
        const double part = late.density()[i] * step, x = late.displacement()[i];
        mass += part, mean += part * x, square += part * x * x;
      }
      CHECK(mass == Approx(1).epsilon(1e-11));
      CHECK(mean == Approx(late.mean()).epsilon(1e-4).margin(1e-10));
      CHECK(square - mean * mean == Approx(late.variance()).epsilon(2e-4));
    }
}

TEST_CASE("without friction it is Poisson's mixture of Gaussian laws", "[displacement_distribution]") {
  // Each pulse leaves b dt^2: F(x) = sum_n P(n) Phi(x / (sigma dt^2 n^(1/2))). The tabulated variance is 1e-5 too
  // large, of which the cdf shows a quarter at most.
  const double count = 2.5;
  const DisplacementDistribution d = distribution(Slider(Coulomb(0)), PoissonPulses(0.01, 1, 2, count / 0.01));
  CHECK(d.atom() == Approx(std::exp(-count)).epsilon(1e-12));
  for (const double x : {-9.0, -3.0, -0.5, 0.1, 1.0, 4.0, 12.0}) {
    double expected = x >= 0 ? std::exp(-count) : 0, weight = std::exp(-count);
    for (int n = 1; n < 60; ++n) expected += (weight *= count / n) * normal_cdf(x / (2 * std::sqrt(n)));
    CAPTURE(x);
    CHECK(d.cdf(x) == Approx(expected).margin(3e-6));
    CHECK(d.cdf(d.quantile(expected)) == Approx(expected).margin(1e-11));
    CHECK(d.quantile(expected) == Approx(x).margin(1e-4));
  }
  CHECK(d.kurtosis() == Approx(3 + 3 / count).epsilon(1e-12));
}

TEST_CASE("the characteristic function is the exponential of that of single slips", "[displacement_distribution]") {
  // E[exp(iu dx)] with dx of (5.8), a = dt = 1, by Simpson's rule over amplitudes.
  for (const double sigma : {0.5, 2.0}) {
    const PoissonPulses pulses(0.01, 1, sigma, 200);
    const DisplacementDistribution d = distribution(Slider(Coulomb(1)), pulses);
    for (const double u : {0.3, 1.0, 4.0}) {
      double sum = 0;  // of (cos(u dx) - 1) p(b), both signs
      constexpr int pieces = 200'000;
      const double width = 12 * sigma / pieces;
      for (int i = 0; i <= pieces; ++i) {
        const double b = 1 + i * width, dx = b * (b - 1) * (b - 1) / ((b + 1) * (b + 1));
        const double weight = i == 0 || i == pieces ? 1 : i % 2 ? 4 : 2;
        sum += weight * (std::cos(u * dx) - 1) * std::exp(-b * b / (2 * sigma * sigma));
      }
      const double mean = 2 * sum * width / 3 / (sigma * std::sqrt(2 * std::numbers::pi));
      CAPTURE(sigma, u);
      CHECK(d.characteristic(u).real() == Approx(std::exp(2 * mean)).epsilon(1e-5));
      CHECK(std::abs(d.characteristic(u).imag()) < 1e-9);
    }
    CHECK(d.characteristic(0).real() == Approx(1).epsilon(1e-11));
  }
}

TEST_CASE("amplitudes of another law: the uniform one has bounds, and so has a single slip",
          "[displacement_distribution]") {
  PoissonOptions options;
  const double most = 2 * std::sqrt(3.0);  // sigma = 2: b between -most and most
  options.quantile = PoissonPulses::each([](double u) { return std::sqrt(3.0) * (2 * u - 1); });
  const PoissonPulses pulses(1e-4, 1, 2, 3e4, options);
  const DisplacementDistribution d = distribution(Slider(Coulomb(1)), pulses);
  CHECK(d.slips() == Approx(3 * (1 - 1 / most)).epsilon(1e-11));
  const Moments m =
      PulseSuperposition(Overlap::none).predict(Slider(Coulomb(1)), pulses, std::vector<double>{pulses.duration()});
  CHECK(d.variance() == Approx(m.displacement_variance.value[0]).epsilon(1e-12));
  // E[dx^n] of (5.8) by Simpson's rule.
  double square = 0, fourth = 0;
  constexpr int pieces = 100'000;
  for (int i = 0; i <= pieces; ++i) {
    const double b = 1 + (most - 1) * i / pieces, dx = b * (b - 1) * (b - 1) / ((b + 1) * (b + 1));
    const double weight = (i == 0 || i == pieces ? 1.0 : i % 2 ? 4.0 : 2.0) * (1 - 1 / most) / (3.0 * pieces);
    square += 3 * weight * dx * dx, fourth += 3 * weight * dx * dx * dx * dx;
  }
  CHECK(d.variance() == Approx(square).epsilon(1e-10));
  CHECK(d.kurtosis() == Approx(3 + fourth / (square * square)).epsilon(1e-10));
}

TEST_CASE("lengths scale with a dt^2", "[displacement_distribution]") {
  const DisplacementDistribution unit = distribution(Slider(Coulomb(1)), PoissonPulses(0.01, 1, 1.5, 500));
  const DisplacementDistribution other = distribution(Slider(Coulomb(3)), PoissonPulses(0.1, 0.1, 4.5, 50));
  for (const double p : {1e-9, 1e-4, 0.1, 0.3, 0.9, 0.999, 1 - 1e-9})
    CHECK(other.quantile(p) == Approx(0.03 * unit.quantile(p)).epsilon(1e-6).margin(1e-12));
}

TEST_CASE("a block that slips one way never lies behind its start", "[displacement_distribution]") {
  const DisplacementDistribution d = distribution(Slider(Coulomb(1, infinity)), PoissonPulses(0.01, 1, 1.5, 500));
  const double step = d.displacement()[1] - d.displacement()[0];
  CHECK(d.cdf(-step) < 1e-10);
  CHECK(d.mean() > 0);
  CHECK(d.skewness() > 0);
}

TEST_CASE("rare pulses: quantiles are those of ensembles of 100,000", "[displacement_distribution][statistics]") {
  // 60 comparisons within three standard errors, of which right ones would fail one in 370: 15 % of all seeds would,
  // and this one is fixed. Pulses that overlap, 4 lambda dt of the slips, shift a probability by less than 2e-4, an
  // eighth of a standard error in the middle.
  struct Case {
    Coulomb law;
    double sigma, pulses;
  };
  for (const auto& [law, sigma, count] :
       {Case{Coulomb(1), 1 / 3.0, 400}, Case{Coulomb(1), 0.5, 40}, Case{Coulomb(1), 1, 5}, Case{Coulomb(1), 3, 5},
        Case{Coulomb(1, 1.6), 1.5, 5}, Case{Coulomb(1, infinity), 1, 10}}) {
    const Slider block(law);
    const PoissonPulses pulses(1e-5, 1, sigma, count / 1e-5);
    const DisplacementDistribution d = distribution(block, pulses);
    const std::vector<double> x = simulated(block, pulses);
    const double n = static_cast<double>(x.size());
    const double at_rest = share(x, 0) - static_cast<double>(std::ranges::lower_bound(x, 0.0) - x.begin()) / n;
    CAPTURE(sigma, d.slips(), d.atom(), at_rest);
    CHECK(std::abs(at_rest - d.atom()) < 3 * std::sqrt(d.atom() * (1 - d.atom()) / n));
    for (const double p : {0.01, 0.05, 0.2, 0.35, 0.5, 0.65, 0.8, 0.95, 0.99}) {
      const double q = d.quantile(p), expected = d.cdf(q), found = share(x, q);
      CAPTURE(p, q, expected, found);
      CHECK(std::abs(found - expected) < 3 * std::sqrt(expected * (1 - expected) / n));
    }
  }
}

TEST_CASE("how far pulses that overlap put the distribution off", "[displacement_distribution][statistics]") {
  // The largest difference of the two cdfs, by 100,000 members; of right ones it is above 0.0062 for one
  // seed in 1000 (Kolmogorov). docs/pulse_superposition.md has the table; 20 pulses each.
  struct Row {
    double overlap, sigma, none, renewal;
  };
  for (const auto& [overlap, sigma, none, renewal] :
       {Row{1e-3, 0.5, 0.0062, 0.0062}, Row{1e-3, 1, 0.0062, 0.0062}, Row{1e-3, 3, 0.0062, 0.0062},
        Row{0.01, 0.5, 0.02, 0.017}, Row{0.01, 1, 0.015, 0.012}, Row{0.01, 3, 0.0062, 0.0062}, Row{0.1, 1, 0.08, 0.055},
        Row{0.1, 3, 0.012, 0.0085}}) {
    const Slider block(Coulomb(1));
    const PoissonPulses pulses(overlap, 1, sigma, 20 / overlap);
    const std::vector<double> x = simulated(block, pulses);
    for (const Overlap how : {Overlap::none, Overlap::renewal}) {
      const DisplacementDistribution d = distribution(block, pulses, how);
      double most = 0;
      for (std::size_t i = 0; i < x.size(); i += 10) most = std::max(most, std::abs(d.cdf(x[i]) - share(x, x[i])));
      CAPTURE(overlap, sigma, how == Overlap::none, most);
      CHECK(most < (how == Overlap::none ? none : renewal));
    }
  }
}

TEST_CASE("a distribution says how overlaps change its standard deviation, or is rejected",
          "[displacement_distribution]") {
  // The ratio of the remark, that of the growth rates to the power 1/2, is independent of the time.
  struct Row {
    double overlap, sigma;
    Overlap how;
    const char* ratio;
  };
  for (const auto& [overlap, sigma, how, ratio] :
       {Row{0.01, 0.5, Overlap::none, "0.62"}, Row{0.01, 0.5, Overlap::renewal, "0.6"},
        Row{0.1, 1, Overlap::none, "0.67"}, Row{0.1, 1, Overlap::renewal, "0.81"}})
    for (const double pulses : {20.0, 500.0}) {
      CAPTURE(overlap, sigma, pulses);
      const DisplacementDistribution d =
          distribution(Slider(Coulomb(1)), PoissonPulses(overlap, 1, sigma, pulses / overlap), how);
      CHECK_THAT(d.remark(), ContainsSubstring("standard deviation is " + std::string(ratio)));
    }
  for (const double sigma : {1.0, 3.0})
    CHECK(distribution(Slider(Coulomb(1)), PoissonPulses(1e-3, 1, sigma, 2e4)).remark().empty());
  // Simulated: 0.24 and 0.43 of the standard deviation, at 200 pulses; 0.08 at 500 pulses of sigma / a = 0.35.
  for (const double sigma : {0.5, 0.35})
    for (const Overlap how : {Overlap::none, Overlap::renewal})
      CHECK_THROWS_WITH(distribution(Slider(Coulomb(1)), PoissonPulses(0.1, 1, sigma, 5e3), how),
                        ContainsSubstring("within a factor of 2 of that by PulseChain"));
  // The chain does not cover pulses of five steps: the effect of overlaps is then unknown, if there are any.
  const PulseShape five({0, 1, 2, 3, 4, 5}, {1, -1, 1, -1, 0});
  const PoissonOptions options{.shape = five};
  CHECK_THAT(distribution(Slider(Coulomb(1)), PoissonPulses(0.01, 1, 1, 1000, options), Overlap::none).remark(),
             ContainsSubstring("0.5 pulses overlap, with unknown effect"));
  CHECK(distribution(Slider(Coulomb(1)), PoissonPulses(0.01, 1, 1, 100, options), Overlap::none).remark().empty());
}

TEST_CASE("DisplacementDistribution rejects arguments that it does not cover", "[displacement_distribution]") {
  const Slider block(Coulomb(1));
  const PoissonPulses pulses(0.01, 1, 2, 100);
  const PulseSuperposition theory;
  CHECK_THROWS_WITH(theory.distribution(block, PoissonPulses(0.2, 1, 2, 100), 10),
                    "PulseSuperposition: a distribution is for rare pulses, rate x half_width at most 0.1, got 0.2");
  CHECK_THROWS_WITH(theory.distribution(block, pulses, -1),
                    "PulseSuperposition: time must be finite and at least 0, got -1 s");
  CHECK_THROWS_WITH(theory.distribution(block, pulses, infinity), ContainsSubstring("finite"));
  CHECK_THROWS_WITH(theory.distribution(Slider(Caster(1, 5)), pulses, 1), ContainsSubstring("constant slip levels"));
  CHECK_THROWS_WITH(theory.distribution(Slider(Coulomb(1), 2), pulses, 1), ContainsSubstring("spring"));
  CHECK_THROWS_WITH(theory.distribution(block, PoissonPulses(0.01, 1, 2, 100, {.envelope = Envelope(1, 10, 1)}), 1),
                    ContainsSubstring("envelope"));
  CHECK_THROWS_WITH(
      theory.distribution(Slider(Coulomb(0)), PoissonPulses(0.01, 1, 2, 100, {.shape = PulseShape({0, 1}, {1})}), 1),
      ContainsSubstring("never stops"));
  const DisplacementDistribution d = theory.distribution(block, pulses, 50);
  CHECK_THROWS_WITH(d.quantile(1e-10), ContainsSubstring("at least 1e-9 and at most 1 - 1e-9, got 1e-10"));
  CHECK_THROWS_WITH(d.quantile(std::nan("")), ContainsSubstring("probability"));
  CHECK_THROWS_WITH(d.cdf(std::nan("")), ContainsSubstring("must be a number"));
  CHECK_THROWS_WITH(d.characteristic(infinity), ContainsSubstring("finite"));
  // At time zero it lies where it lay.
  const DisplacementDistribution now = theory.distribution(block, pulses, 0);
  CHECK(now.atom() == 1);
  CHECK(now.quantile(0.999) == 0);
  CHECK(now.cdf(-1e-300) == 0);
  CHECK(now.characteristic(3) == 1.0);
}
