// Derivatives of statistics: Euler's theorem, differences with common random numbers, white noise, refusals.
#include "stickslip/ensemble/sensitivity.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "stickslip/ensemble/run.hpp"
#include "stickslip/excitation/with_vertical.hpp"
#include "stickslip/friction/degrading.hpp"
#include "stickslip/theory/white_noise.hpp"
#include "support/catch.hpp"
#include "support/motions.hpp"

using namespace stickslip;
using namespace test;
using Catch::Matchers::ContainsSubstring;

namespace {

GaussianExcitation shaking() {
  return {Spectrum::band_pass(0.05, 2, 40), 0.02, 401, {.envelope = Envelope::from_table({0, 1, 6, 8}, {0, 1, 1, 0})}};
}

EnsembleOptions members(std::uint64_t count, bool settle = false) {
  EnsembleOptions o;
  o.members = count;
  o.seed = 5;
  o.settle = settle;
  o.velocity_spectrum = false;
  return o;
}

EnsembleSensitivityOptions derivatives(std::uint64_t count, bool settle = false) {
  EnsembleSensitivityOptions o;
  o.members = count;
  o.seed = 5;
  o.settle = settle;
  return o;
}

/// Values of the statistics: E[peak], E[x], E[x^2], rms.
std::array<double, 4> statistics(const Ensemble& ensemble) {
  std::array<double, 4> sum{};
  const std::vector<double> peak = ensemble.peak(), residual = ensemble.residual();
  const auto n = static_cast<double>(peak.size());
  for (std::size_t i = 0; i < peak.size(); ++i) {
    sum[0] += peak[i] / n;
    sum[1] += residual[i] / n;
    sum[2] += residual[i] * residual[i] / n;
  }
  sum[3] = std::sqrt(sum[2]);
  return sum;
}
std::array<Estimate, 4> estimates(const EnsembleSensitivity& s) {
  return {s.peak_mean, s.residual_mean, s.residual_mean_square, s.residual_rms};
}

}  // namespace

TEST_CASE("a scaled ground motion and level scale the response: Euler's theorem", "[ensemble][sensitivity]") {
  // x is homogeneous of degree 1 in the level and the ground motion: a dx/da + dx/dscale = x, to some hundred roundings
  // of the largest term; its square is of degree 2.
  const auto check = [](const auto& slider, const auto& motions, double level) {
    const Ensemble ensemble = run_ensemble(slider, motions, members(200, true));
    const auto by_level = ensemble_sensitivity(slider, motions, Parameter::slip_level, derivatives(200, true));
    const auto by_scale = ensemble_sensitivity(slider, motions, Parameter::scale, derivatives(200, true));
    for (std::size_t i = 0; i < 200; ++i) {
      const double scale = std::abs(level * by_level.peak[i]) + ensemble.peak()[i] + std::abs(by_scale.residual[i]);
      REQUIRE(std::abs(level * by_level.peak[i] + by_scale.peak[i] - ensemble.peak()[i]) <= 1e-10 * scale);
      REQUIRE(std::abs(level * by_level.residual[i] + by_scale.residual[i] - ensemble.residual()[i]) <= 1e-10 * scale);
    }
    const auto value = statistics(ensemble);
    const auto a = estimates(by_level), b = estimates(by_scale);
    const std::array<double, 4> degree{1, 1, 2, 1};
    for (std::size_t k = 0; k < 4; ++k)
      CHECK(std::abs(level * a[k].value + b[k].value - degree[k] * value[k]) <=
            1e-9 * (std::abs(b[k].value) + value[0] * (k == 2 ? value[0] : 1)));
  };
  check(Slider(Coulomb(1)), shaking(), 1);
  check(Slider(Coulomb(0.8), 2, 0.3), shaking(), 0.8);
  check(Slider(Coulomb(0.5)), PoissonPulses(2, 0.2, 3, 10), 0.5);
}

TEST_CASE("each member's derivative is that of sensitivity, on any number of threads", "[ensemble][sensitivity]") {
  const Slider slider(Coulomb(1), 2);
  const GaussianExcitation motions = shaking();
  EnsembleSensitivityOptions o = derivatives(100);
  o.first_member = 10;
  std::vector<EnsembleSensitivity> runs;
  for (const unsigned threads : {1U, 2U, 3U}) {
    o.threads = threads;
    runs.push_back(ensemble_sensitivity(slider, motions, Parameter::natural_frequency, o));
  }
  for (std::size_t i = 0; i < 100; ++i) {
    const GroundMotion motion = motions.sample(5, 10 + i);
    const Sensitivity one = sensitivity(slider, motion, integrate(slider, motion), Parameter::natural_frequency);
    REQUIRE((runs[0].peak[i] == one.peak && runs[0].residual[i] == one.residual));
  }
  for (const auto& run : runs) {
    CHECK((run.peak == runs[0].peak && run.residual == runs[0].residual));
    for (std::size_t k = 0; k < 4; ++k)
      CHECK((estimates(run)[k].value == estimates(runs[0])[k].value &&
             estimates(run)[k].error == estimates(runs[0])[k].error));
  }
}

TEST_CASE("derivatives of statistics are the limits of differences with the same seed",
          "[ensemble][sensitivity][long]") {
  // A difference over 2 h is the mean of the derivative over that interval, which jumps where the order of events
  // changes. The midpoint rule of n panels is off by at most half a panel's variation in each, so by V / 2n of the
  // variation V in all; twice that, because V is taken from the points of the rule alone.
  constexpr int n = 16;
  const auto check = [](const auto& slider_at, Parameter parameter, double at, double h) {
    const auto value = [&](double a) { return statistics(run_ensemble(slider_at(a), shaking(), members(200, true))); };
    const auto above = value(at + h), below = value(at - h);
    std::array<double, 4> mean{}, variation{}, last{};
    for (int i = 0; i < n; ++i) {
      const auto now = estimates(
          ensemble_sensitivity(slider_at(at + h * (2 * i + 1 - n) / n), shaking(), parameter, derivatives(200, true)));
      for (std::size_t k = 0; k < 4; ++k) {
        mean[k] += now[k].value / n;
        if (i > 0) variation[k] += std::abs(now[k].value - last[k]);
        last[k] = now[k].value;
      }
    }
    for (std::size_t k = 0; k < 4; ++k) {
      INFO("statistic " << k);
      const double difference = (above[k] - below[k]) / (2 * h);
      CHECK(std::abs(difference - mean[k]) <= variation[k] / n);
    }
  };
  check([](double a) { return Slider(Coulomb(a)); }, Parameter::slip_level, 1, 0.1);
  check([](double w) { return Slider(Coulomb(0.5), w, 0.2); }, Parameter::natural_frequency, 3, 0.3);
  check([](double c) { return Slider(Coulomb(0.5), 3, c); }, Parameter::damping, 0.5, 0.1);
  check([](double degrees) { return Slider(Coulomb(1), {.slope_degrees = degrees, .one_way = true}); },
        Parameter::slope, 3, 0.3);
}

TEST_CASE("under white noise the rms displacement falls as the square of the level",
          "[ensemble][sensitivity][statistics]") {
  // D = 1, a = 1, so that by dimensions E[x^2] = D^4 / a^6 F(a^2 t / D); F is known, and late F = 10 a^2 t / D, so that
  // the rms falls as a^-2. 5 standard errors: once in 1.7 million seeds. Steps of 0.02 D / a^2 add some 1 %.
  const double s0 = 1 / std::numbers::pi, duration = 40, h = 1e-4;
  const GaussianExcitation noise(Spectrum::white(s0), 0.02, 2001,
                                 {.interpolation = Interpolation::constant,
                                  .correct_interpolation = false,
                                  .random_amplitudes = true,
                                  .zero_frequency = true});
  const auto s = ensemble_sensitivity(Coulomb(1), noise, Parameter::slip_level, derivatives(2000));
  const double times[] = {duration};
  const auto exact = [&](double a) {
    return theory::WhiteNoise::coulomb(a, s0).predict(times).displacement_variance.value[0];
  };
  const double variance = exact(1), slope = (exact(1 + h) - exact(1 - h)) / (2 * h);
  CHECK(std::abs(s.residual_mean_square.value - slope) < 5 * s.residual_mean_square.error);
  CHECK(std::abs(s.residual_rms.value - slope / (2 * std::sqrt(variance))) < 5 * s.residual_rms.error);
  const double exponent = slope / (2 * variance);  // of the rms, with its transient
  CHECK(std::abs(exponent + 2) < 0.2);
  CHECK(std::abs(s.residual_rms.value / std::sqrt(variance) + 2) <
        std::abs(exponent + 2) + 5 * s.residual_rms.error / std::sqrt(variance));
  CHECK(std::abs(s.residual_mean.value) < 5 * s.residual_mean.error);  // by symmetry
}

TEST_CASE("standard errors are those of repetitions", "[ensemble][sensitivity][statistics]") {
  // Of 60 runs of 100 members the scatter over the stated error squared is chi^2 of 59 degrees of freedom over 59, less
  // exactly so for heavy tails: beyond 0.4 and 2.1 once in 10^5 seeds each way.
  constexpr std::size_t runs = 60;
  std::array<std::vector<double>, 4> values;
  std::array<double, 4> squares{};
  for (std::size_t i = 0; i < runs; ++i) {
    EnsembleSensitivityOptions o = derivatives(100);
    o.first_member = 100 * i;
    const auto found = estimates(ensemble_sensitivity(Coulomb(0.6), shaking(), Parameter::slip_level, o));
    for (std::size_t k = 0; k < 4; ++k) {
      values[k].push_back(found[k].value);
      squares[k] += found[k].error * found[k].error / runs;
    }
  }
  for (std::size_t k = 0; k < 4; ++k) {
    double mean = 0, scatter = 0;
    for (const double value : values[k]) mean += value / runs;
    for (const double value : values[k]) scatter += (value - mean) * (value - mean) / (runs - 1);
    INFO("statistic " << k << ", ratio " << scatter / squares[k]);
    CHECK((scatter / squares[k] > 0.4 && scatter / squares[k] < 2.1));
  }
}

TEST_CASE("members that never move have derivatives of zero", "[ensemble][sensitivity]") {
  const auto s = ensemble_sensitivity(Coulomb(100), shaking(), Parameter::slip_level, derivatives(10));
  for (const Estimate& one : estimates(s)) CHECK((one.value == 0 && one.error == 0));
}

TEST_CASE("sliders of any source and vertical motion have derivatives, if members stay on the ground",
          "[ensemble][sensitivity]") {
  const RandomSlider blocks([](double mu) { return Coulomb::from_friction(mu); }, Lognormal(0.08, 0.3));
  CHECK(ensemble_sensitivity(blocks, shaking(), Parameter::slip_level, derivatives(50)).peak_mean.value < 0);
  const WithVertical both(GaussianExcitation(shaking().spectrum(), 0.02, 401, shaking().options()), 0.5);
  CHECK(ensemble_sensitivity(Coulomb(1), both, Parameter::slip_level, derivatives(50)).peak_mean.value < 0);
  const WithVertical strong(shaking(), 20.0);
  CHECK_THROWS_WITH(ensemble_sensitivity(Coulomb(1), strong, Parameter::slip_level, derivatives(50)),
                    ContainsSubstring("ensemble_sensitivity: member ") &&
                        ContainsSubstring("must not leave the ground") && ContainsSubstring("use contact = clipped"));
  EnsembleSensitivityOptions clipped = derivatives(50);
  clipped.contact = Contact::clipped;
  CHECK(ensemble_sensitivity(Coulomb(1), strong, Parameter::slip_level, clipped).peak_mean.error > 0);
}

TEST_CASE("sources without a derivative of the mean are rejected", "[ensemble][sensitivity][errors]") {
  const auto refusal = [](const auto& slider, Parameter parameter = Parameter::slip_level) {
    try {
      ensemble_sensitivity(slider, shaking(), parameter, derivatives(10));
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
    return std::string("none");
  };
  const auto covers = [&](const std::string& message, const std::string& got) {
    CHECK_THAT(message, ContainsSubstring("ensemble_sensitivity: covers Coulomb friction without stops, got " + got) &&
                            ContainsSubstring("; take differences of two ensembles with the same seed"));
  };
  covers(refusal(StaticKinetic(Coulomb(1), 1.3)), "static friction above kinetic: its response jumps");
  covers(refusal(Stribeck(2, 1, 0.1, 1)), "static friction above kinetic: its response jumps");
  covers(refusal(VelocityDependent(0.3, 0.6, 50)), "a law whose level changes during a slip");
  covers(refusal(Caster(1, 0.5)), "a law whose level changes during a slip");
  covers(refusal(Degrading({0, 0.1}, {1, 0.5})), "a law whose level changes during a slip");
  covers(refusal(Slider(Coulomb(1), {.stops = Stops(0.1, 0.7)})), "stops: near a grazing impact");
  CHECK(refusal(Slider<Coulomb>::friction_pendulum(Coulomb(1), 2)) == "none");
  CHECK_THAT(refusal(Coulomb(1), Parameter::natural_frequency), ContainsSubstring("without a spring"));
  CHECK_THROWS_WITH(ensemble_sensitivity(Coulomb(1), shaking(), Parameter::slip_level, derivatives(1)),
                    "ensemble_sensitivity: members must be at least 2, for standard errors, got 1");
  EnsembleSensitivityOptions late = derivatives(10);
  late.first_member = UINT64_MAX - 4;
  CHECK_THROWS_WITH(ensemble_sensitivity(Coulomb(1), shaking(), Parameter::slip_level, late),
                    ContainsSubstring("first_member + members must be less than 2^64"));
  EnsembleSensitivityOptions ended = derivatives(1000);
  ended.progress = [](std::uint64_t, std::uint64_t) { throw std::runtime_error("enough"); };
  CHECK_THROWS_WITH(ensemble_sensitivity(Coulomb(1), shaking(), Parameter::slip_level, ended), "enough");
}
