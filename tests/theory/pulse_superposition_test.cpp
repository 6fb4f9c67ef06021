// Superposition of pulses: independent values, limits, scaling, and the effects of other laws and shapes.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "stickslip/ensemble/run.hpp"
#include "stickslip/friction/caster.hpp"
#include "stickslip/theory/pulse_chain.hpp"
#include "stickslip/theory/pulse_superposition.hpp"
#include "support/catch.hpp"
#include "support/reference.hpp"

using namespace stickslip;
using namespace stickslip::theory;
using Catch::Matchers::ContainsSubstring;

namespace {

constexpr Overlap overlaps[] = {Overlap::none, Overlap::thesis, Overlap::renewal};
const std::vector<double> late = {100.0};

Slider<Coulomb> block(double level) { return Slider(Coulomb(level)); }

Moments predict(Overlap overlap, double rate, double sigma) {
  return PulseSuperposition(overlap).predict(block(1), PoissonPulses(rate, 1, sigma, 100), late);
}

}  // namespace

TEST_CASE("h and g of (5.35), (5.41) come out to 1e-12", "[pulse_superposition]") {
  for (const auto& row : reference::rows("pulse_superposition", "integrals")) {
    const double sigma = row["sigma"], h = row["h"], g = row["g"];
    CAPTURE(sigma);
    const Moments m = predict(Overlap::none, 1, sigma);  // (5.34), (5.40) with all else 1
    CHECK(m.velocity_variance.value[0] * sigma == Approx(h).epsilon(1e-12));
    CHECK(m.growth_rate.value * sigma == Approx(g).epsilon(1e-12));
  }
}

TEST_CASE("the overlap series come out to 1e-12, as printed and corrected", "[pulse_superposition]") {
  for (const auto& row : reference::rows("pulse_superposition", "series"))
    for (std::size_t i = 0; i < 3; ++i) {
      CAPTURE(row["sigma"], row["overlap"], i);
      const Moments m = predict(overlaps[i], row["overlap"], row["sigma"]);
      CHECK(m.velocity_variance.value[0] == Approx(row["velocity_variance"].list()[i]).epsilon(1e-12));
      CHECK(m.growth_rate.value == Approx(row["growth"].list()[i]).epsilon(1e-12));
      CHECK(m.displacement_variance.value[0] == Approx(100 * row["growth"].list()[i]).epsilon(1e-12));
      CHECK(m.covariance.value[0] == Approx(row["growth"].list()[i] / 2).epsilon(1e-12));
    }
}

TEST_CASE("the curves of figure 5.7 come out", "[pulse_superposition]") {
  for (const auto& row : reference::rows("pulse_superposition", "events"))
    for (std::size_t i = 0; i < 3; ++i) {
      CAPTURE(row["event"].as<std::string>(), row["mu"], row["gravity"], i);
      const PoissonPulses pulses = PoissonPulses::event(row["event"].as<std::string>());
      const PulseSuperposition theory(overlaps[i]);
      // The study's first column loses digits where sigma / a is small, for it integrates in one piece from the
      // threshold to infinity: 1e-10 at 0.146, 3e-4 at 0.102. See below.
      const bool coarse = i == 0 && pulses.sigma() < 0.15 * row["mu"] * row["gravity"];
      CHECK(theory.final_rms(block(row["mu"] * row["gravity"]), pulses) * 100 ==
            Approx(row["displacement"].list()[i]).epsilon(coarse ? 5e-4 : 1e-12));
      if (overlaps[i] == Overlap::thesis) {
        const Moments m = theory.predict(block(row["mu"] * row["gravity"]), pulses, late);
        CHECK(std::sqrt(m.velocity_variance.value[0]) * 100 == Approx(row["velocity"]).epsilon(1e-11));
      }
    }
}

TEST_CASE("pulses that hardly ever reach the slip level are counted to 1e-12", "[pulse_superposition]") {
  // (5.41) in 30 digits by mpmath, in a hundred pieces of the width in which the density falls by e.
  const double found =
      PulseSuperposition(Overlap::none).final_rms(block(0.5 * 9.81), PoissonPulses::event("moderate near field"));
  CHECK(found * 1e15 == Approx(1.139350776714514).epsilon(1e-12));
}

TEST_CASE("a frictionless slider moves as the ground, but for the thesis's series", "[pulse_superposition]") {
  const PulseShape three({0, 0.5, 2, 3}, {1, -1, 1});
  for (const PulseShape& shape : {PulseShape(), three})
    for (const double level : {0.0, 1e-13}) {
      const PoissonPulses pulses(0.7, 0.4, 2, 50, {.shape = shape});
      CAPTURE(level, shape.length());
      for (const Overlap overlap : overlaps) {
        const Moments m = PulseSuperposition(overlap).predict(block(level), pulses, late);
        const double bias = overlap == Overlap::thesis ? 1 + 0.7 * 0.4 : 1;  // errata to (5.52)
        CHECK(m.velocity_variance.value[0] == Approx(bias * pulses.ground_velocity_variance()).epsilon(1e-12));
        CHECK(m.growth_rate.value == Approx(bias * pulses.ground_displacement_variance(1)).epsilon(1e-12));
      }
    }
}

TEST_CASE("near no friction the series follow their expansion in 1 / sigma_B", "[pulse_superposition]") {
  // values.json pulse.overlap_bias.*: limit and E[sqrt(m + 1)], ten to twelve digits; the next term is O(sigma_B^-2).
  struct Row {
    double overlap, root, velocity, growth;
  };
  for (const auto& [p, root, velocity, growth] : {Row{0.1, 1.04094710564517, 1.09975091316, 1.09933587493},
                                                  Row{1, 1.37273264035752, 1.99967149522, 1.99912409379},
                                                  Row{2, 1.68286382955979, 2.99959726057, 2.99892613475}}) {
    const double sigma = 1e4;
    const Moments m = predict(Overlap::thesis, p, sigma);
    const double v = m.velocity_variance.value[0] / (2.0 / 3 * p * sigma * sigma);
    const double r = m.growth_rate.value / (p * sigma * sigma);
    CHECK(v == Approx(velocity).epsilon(1e-11));
    CHECK(r == Approx(growth).epsilon(1e-11));
    CHECK(std::abs(v - (1 + p - 3 * std::sqrt(2 / std::numbers::pi) * root / sigma)) < 50 / (sigma * sigma));
    CHECK(std::abs(r - (1 + p - 8 * std::sqrt(2 / std::numbers::pi) * root / sigma)) < 50 / (sigma * sigma));
  }
}

TEST_CASE("only sigma / a and lambda Dt matter", "[pulse_superposition]") {
  for (const Overlap overlap : overlaps) {
    const Moments unit = predict(overlap, 0.8, 1.3);
    const double a = 2.5e-3, dt = 30;
    const Moments m = PulseSuperposition(overlap).predict(block(a), PoissonPulses(0.8 / dt, dt, 1.3 * a, 1e4), late);
    CHECK(m.velocity_variance.value[0] == Approx(std::pow(a * dt, 2) * unit.velocity_variance.value[0]).epsilon(1e-12));
    CHECK(m.growth_rate.value == Approx(a * a * std::pow(dt, 3) * unit.growth_rate.value).epsilon(1e-12));
  }
}

TEST_CASE("series of thousands of terms are summed, those without a meaning refused", "[pulse_superposition]") {
  // At lambda Dt = p the composites are of p + 1 pulses or so: a single Gaussian law, to a relative 1 / p.
  const double p = 2e4;
  const Moments series = predict(Overlap::renewal, p, 0.02);
  const Moments one = predict(Overlap::none, p / (1 + p), 0.02 * std::sqrt(p + 1));
  CHECK(series.growth_rate.value == Approx(one.growth_rate.value).epsilon(10 / p));
  CHECK_THAT(series.remark, ContainsSubstring("Pulses overlap much"));
  CHECK_THROWS_WITH(PulseSuperposition().predict(block(1), PoissonPulses(2e6, 1, 1, 10), late),
                    ContainsSubstring("means nothing") && ContainsSubstring("2e+06"));
}

TEST_CASE("where nothing slips the answer is zero, and says why", "[pulse_superposition]") {
  const Moments m = predict(Overlap::renewal, 0.5, 1e-5);
  CHECK(m.growth_rate.value == 0);
  CHECK(m.velocity_variance.value[0] == 0);
  CHECK_THAT(m.remark, ContainsSubstring("Nothing slips"));
  // With many at once they do, where none alone would.
  CHECK(predict(Overlap::none, 0.5, 0.01).growth_rate.value == 0);
  CHECK(predict(Overlap::thesis, 0.5, 0.01).growth_rate.value > 0);
}

TEST_CASE("short times are said to be short", "[pulse_superposition]") {
  const PoissonPulses pulses(0.5, 1, 1, 100);
  CHECK(PulseSuperposition().predict(block(1), pulses, late).remark.empty());
  const Moments m = PulseSuperposition().predict(block(1), pulses, std::vector<double>{0, 5, 100});
  CHECK_THAT(m.remark, ContainsSubstring("1 of the times is below 40 s"));
  CHECK(m.displacement_variance.value[0] == 0);
}

TEST_CASE("from rest: without friction the ground's moments, at any time", "[pulse_superposition]") {
  const double rate = 3, half_width = 1.0 / 6, sigma = 2.5;
  const PoissonPulses pulses(rate, half_width, sigma, 20);
  std::vector<double> times;
  for (const double t : {0.0, 0.01, 0.5, 1.0, 1.3, 1.99, 5.0, 60.0}) times.push_back(t * half_width);
  const Moments m = PulseSuperposition(Overlap::none).from_rest(block(0), pulses, times);
  const double unit = pulses.ground_displacement_variance(half_width);
  for (std::size_t i = 0; i < times.size(); ++i) {
    // A pulse has moved the ground by t^2 / 2, then by 1 - (2 - t)^2 / 2, then by 1: squares, integrated.
    const double t = times[i] / half_width, u = std::max(2 - t, 0.0);
    const double x = t < 1   ? std::pow(t, 5) / 20
                     : t < 2 ? 1.0 / 20 + (t - 1) - (1 - u * u * u) / 3 + (1 - std::pow(u, 5)) / 20
                             : t - 37.0 / 30;
    CHECK(m.displacement_variance.value[i] == Approx(unit * x).epsilon(1e-9));
    CHECK(m.velocity_variance.value[i] ==
          Approx(pulses.ground_velocity_variance() * (t < 1 ? t * t * t : 2 - u * u * u) / 2).epsilon(1e-9));
    CHECK(m.displacement_mean.value[i] == Approx(0).margin(1e-12));
  }
}

TEST_CASE("from rest: rates are derivatives, and late moments are lines beside those of predict",
          "[pulse_superposition]") {
  const double infinity = std::numeric_limits<double>::infinity();
  for (const Coulomb law : {Coulomb(1), Coulomb(1, 1.6), Coulomb(0.8, infinity)})
    for (const Overlap overlap : overlaps) {
      const PoissonPulses pulses(0.2, 1, 1.4, 100);
      const PulseSuperposition theory(overlap);
      const double h = 1e-3;
      for (const double t : {0.3, 1.2, 1.9, 2.7, 3.5}) {
        const Moments m = theory.from_rest(Slider(law), pulses, std::vector<double>{t - h, t, t + h});
        // The second-order error of the difference and, where a response stops within it, h^2 of a step of the slope.
        const auto slope = [&](const Estimates& e) { return (e.value[2] - e.value[0]) / (2 * h); };
        CHECK(slope(m.displacement_variance) == Approx(2 * m.covariance.value[1]).epsilon(1e-4));
        CHECK(slope(m.displacement_mean) == Approx(m.velocity_mean.value[1]).epsilon(1e-4).margin(1e-12));
      }
      // The last one that moves stops at 4 dt; with levels that differ later, one in 1e12 after 20 dt.
      const std::vector<double> times = {400, 50, 100};
      const Moments m = theory.from_rest(Slider(law), pulses, times),
                    late_ones = theory.predict(Slider(law), pulses, times);
      CHECK(m.remark.empty());
      CHECK(m.growth_rate.value == late_ones.growth_rate.value);
      CHECK(m.displacement_variance.value[0] - m.displacement_variance.value[2] ==
            Approx(300 * m.growth_rate.value).epsilon(1e-9));
      CHECK(m.displacement_mean.value[0] - m.displacement_mean.value[2] ==
            Approx(late_ones.displacement_mean.value[0] - late_ones.displacement_mean.value[2])
                .epsilon(1e-9)
                .margin(1e-12));
      for (std::size_t i = 0; i < 3; ++i) {
        CHECK(m.velocity_variance.value[i] == Approx(late_ones.velocity_variance.value[i]).epsilon(1e-9));
        CHECK(m.velocity_mean.value[i] == Approx(late_ones.velocity_mean.value[i]).epsilon(1e-9).margin(1e-12));
        CHECK(m.covariance.value[i] == Approx(late_ones.covariance.value[i]).epsilon(1e-9));
        // By where the line begins: within the 4 dt that a response takes, either side of 0.
        CHECK(std::abs(m.displacement_variance.value[i] / late_ones.displacement_variance.value[i] - 1) < 4 / times[i]);
      }
    }
  const PoissonPulses pulses(0.2, 1, 1.4, 100);
  PoissonOptions envelope;
  envelope.envelope = Envelope(1, 10, 1);
  CHECK_THROWS_WITH(PulseSuperposition().from_rest(block(1), PoissonPulses(0.2, 1, 1, 100, envelope), late),
                    ContainsSubstring("does not cover an envelope"));
  CHECK_THROWS_WITH(PulseSuperposition().from_rest(block(1), pulses, std::vector<double>{-1}),
                    ContainsSubstring("finite and at least 0, got -1 s"));
}

TEST_CASE("from rest: rare pulses follow an ensemble's at every time", "[pulse_superposition][statistics]") {
  // Overlaps matter by a few times lambda dt = 0.003: 3 %. Three standard errors on top, 80 comparisons of fixed seeds:
  // with new seeds, one of them would fail one time in five if each were at its bound.
  for (const double sigma : {1.0, 3.0}) {
    const Slider slider(Coulomb(1, 1.6));
    const PoissonPulses pulses(3e-3, 1, sigma, 8);
    EnsembleOptions options;
    options.members = 400'000;
    options.seed = 4;
    options.dt = 0.25;
    options.velocity_spectrum = false;
    const Moments found = run_ensemble(slider, pulses, options).moments();
    const Moments m = PulseSuperposition(Overlap::none).from_rest(slider, pulses, found.time);
    for (const double time : {0.5, 1.0, 1.25, 1.5, 2.0, 3.0, 5.0, 8.0}) {
      const auto i = static_cast<std::size_t>(std::lround(time / 0.25));
      const auto within = [&](const Estimates& theory, const Estimates& e) {
        CAPTURE(sigma, time, theory.value[i], e.value[i], e.error[i]);
        CHECK(std::abs(theory.value[i] - e.value[i]) < 0.03 * std::abs(theory.value[i]) + 3 * e.error[i]);
      };
      within(m.displacement_mean, found.displacement_mean);
      within(m.displacement_variance, found.displacement_variance);
      within(m.covariance, found.covariance);
      within(m.velocity_mean, found.velocity_mean);
      within(m.velocity_variance, found.velocity_variance);
    }
  }
}

TEST_CASE("unequal levels and amplitudes of nonzero mean drift", "[pulse_superposition][statistics]") {
  // Rare pulses: superposition becomes right, and the ensemble says so. Three standard errors, five comparisons of
  // fixed seeds: with new seeds, they would fail one time in 75. What overlaps do at lambda Dt = 1e-3 is a part in 200.
  const PoissonPulses plain(1e-3, 1, 3, 4e4);
  PoissonOptions exponential;  // one-sided amplitudes of mean square 1
  exponential.quantile = PoissonPulses::each([](double u) { return -std::log1p(-u) / std::numbers::sqrt2; });
  const PoissonPulses biased(1e-3, 1, 3, 4e4, exponential);
  EnsembleOptions options;
  options.members = 4000;
  options.seed = 3;
  options.dt = 4e3;
  options.velocity_spectrum = false;
  const auto check = [&](const Coulomb& law, const PoissonPulses& pulses) {
    const Ensemble ensemble = run_ensemble(law, pulses, options);
    const Moments found = ensemble.moments();
    const Moments m = PulseSuperposition(Overlap::none).predict(Slider(law), pulses, found.time);
    const std::size_t end = found.time.size() - 1;
    CAPTURE(m.displacement_mean.value[end], found.displacement_mean.value[end], m.displacement_variance.value[end],
            found.displacement_variance.value[end]);
    CHECK(std::abs(m.displacement_mean.value[end] - found.displacement_mean.value[end]) <
          3 * found.displacement_mean.error[end] + std::abs(m.displacement_mean.value[end]) / 200);
    CHECK(std::abs(m.displacement_variance.value[end] - found.displacement_variance.value[end]) <
          3 * found.displacement_variance.error[end] + m.displacement_variance.value[end] / 200);
  };
  check(Coulomb(0.7, 2), plain);
  check(Coulomb(1), biased);
  check(Coulomb(0.8, std::numeric_limits<double>::infinity()), plain);
  // A symmetric slider under symmetric pulses does not drift.
  CHECK(predict(Overlap::none, 0.5, 1).displacement_mean.value[0] == Approx(0).margin(1e-14));
}

TEST_CASE("a law of amplitudes given by its quantiles is integrated as closely", "[pulse_superposition]") {
  // Two values: one pulse's closed form. sqrt(3) (2u - 1): uniform, integrated by other means (midpoints, 1e-9).
  PoissonOptions two, uniform;
  two.quantile = PoissonPulses::each([](double u) { return u < 0.5 ? -1.0 : 1.0; });
  uniform.quantile = PoissonPulses::each([](double u) { return std::sqrt(3.0) * (2 * u - 1); });
  const PulseResponse r = pulse_response(block(1), 2.5, 1);
  const Moments m = PulseSuperposition(Overlap::none).predict(block(1), PoissonPulses(0.3, 1, 2.5, 100, two), late);
  CHECK(m.growth_rate.value == Approx(0.3 * r.offset * r.offset).epsilon(1e-12));
  CHECK(m.velocity_variance.value[0] == Approx(0.3 * r.velocity_square).epsilon(1e-12));
  double sum = 0;
  const int n = 100'000;
  for (int i = 0; i < n; ++i) {
    const double offset = pulse_response(block(1), 2.5 * std::sqrt(3.0) * (i + 0.5) / n, 1).offset;
    sum += offset * offset / n;
  }
  CHECK(PulseSuperposition(Overlap::none)
            .predict(block(1), PoissonPulses(0.3, 1, 2.5, 100, uniform), late)
            .growth_rate.value == Approx(0.3 * sum).epsilon(1e-8));
  CHECK_THROWS_WITH(PulseSuperposition().predict(block(1), PoissonPulses(0.3, 1, 2.5, 100, two), late),
                    ContainsSubstring("overlap must be none"));
}

TEST_CASE("an envelope's strength is integrated over", "[pulse_superposition]") {
  const PoissonPulses plain(0.5, 1, 2, 400);
  PoissonOptions options;
  options.envelope = Envelope::from_table({0, 400}, {1, 1});
  const std::vector<double> times = {50, 400};
  const Moments expected = PulseSuperposition().predict(block(1), plain, times);
  const Moments constant = PulseSuperposition().predict(block(1), PoissonPulses(0.5, 1, 2, 400, options), times);
  for (std::size_t i = 0; i < 2; ++i) {
    CHECK(constant.displacement_variance.value[i] == Approx(expected.displacement_variance.value[i]).epsilon(1e-12));
    CHECK(constant.velocity_variance.value[i] == Approx(expected.velocity_variance.value[i]).epsilon(1e-12));
  }
  CHECK(std::isnan(constant.growth_rate.value));
  // Without friction the growth goes as the square of the strength, here t / 400.
  options.envelope = Envelope::from_table({0, 400}, {0, 1});
  const Moments ramp = PulseSuperposition().predict(block(0), PoissonPulses(0.5, 1, 2, 400, options), times);
  CHECK(ramp.displacement_variance.value[1] == Approx(plain.ground_displacement_variance(400) / 3).epsilon(1e-12));
}

TEST_CASE("a caster of great reach is a block", "[pulse_superposition]") {
  const PoissonPulses pulses(0.02, 1, 1.2, 4000);
  const std::vector<double> times = {1000, 4000};
  for (const Overlap overlap : overlaps) {
    const Moments fixed = PulseSuperposition(overlap).predict(block(1), pulses, times);
    const Moments wide = PulseSuperposition(overlap).predict(Slider(Caster(1, 1e5)), pulses, times);
    for (std::size_t i = 0; i < 2; ++i)
      CHECK(wide.displacement_variance.value[i] == Approx(fixed.displacement_variance.value[i]).epsilon(1e-6));
  }
}

TEST_CASE("a caster under rare pulses spreads as in an ensemble", "[pulse_superposition][statistics]") {
  // Three standard errors and the part in 100 that overlaps do; two comparisons, which would fail one time in 185.
  const PoissonPulses pulses(2e-3, 1, 1.5, 3e4);
  const Slider caster(Caster(1, 4));
  EnsembleOptions options;
  options.members = 4000;
  options.seed = 4;
  options.dt = 1e4;
  options.velocity_spectrum = false;
  const Moments found = run_ensemble(caster, pulses, options).moments();
  const Moments m = PulseSuperposition(Overlap::none).predict(caster, pulses, found.time);
  const Moments fixed = PulseSuperposition(Overlap::none).predict(block(1), pulses, found.time);
  for (const std::size_t i : {1U, 3U}) {
    CAPTURE(m.displacement_variance.value[i], found.displacement_variance.value[i],
            found.displacement_variance.error[i], m.remark);
    CHECK(std::abs(m.displacement_variance.value[i] - found.displacement_variance.value[i]) <
          3 * found.displacement_variance.error[i] + 0.01 * m.displacement_variance.value[i]);
  }
  CHECK(m.displacement_variance.value[3] > 1.1 * fixed.displacement_variance.value[3]);
}

namespace {

/// The rms displacement of casters at the end of the motion, and its standard error.
Estimate simulated_rms(const Caster& caster, const PoissonPulses& pulses, std::uint64_t members) {
  EnsembleOptions options;
  options.members = members;
  options.seed = 1;
  options.dt = pulses.duration() / 8;
  options.velocity_spectrum = false;
  const Estimates found = run_ensemble(caster, pulses, options).moments().displacement_variance;
  const double rms = std::sqrt(found.value.back());
  return {rms, found.error.back() / (2 * rms)};
}

/// Refused, or as good as it says: within 30 %, or, where the remark says that overlaps matter, that close to what is
/// left of the error when the factor by which it fails for a block is put right.
void check_caster(Overlap overlap, const Caster& caster, const PoissonPulses& pulses, std::uint64_t members) {
  const PulseSuperposition theory(overlap);
  double found;
  std::string remark;
  try {
    const Moments m = theory.predict(Slider(caster), pulses, std::vector<double>{pulses.duration()});
    found = std::sqrt(m.displacement_variance.value[0]);
    remark = m.remark;
  } catch (const std::invalid_argument& refusal) {
    CHECK_THAT(refusal.what(), ContainsSubstring("escapes") || ContainsSubstring("no theory covers both"));
    return;
  }
  if (remark.find("Pulses overlap: under Coulomb friction") != std::string::npos) {
    const Slider fixed = block(caster.slip_level());
    found *= PulseChain().final_rms(fixed, pulses) / theory.final_rms(fixed, pulses);
  }
  const Estimate expected = simulated_rms(caster, pulses, members);
  CAPTURE(found, expected.value, expected.error, remark);
  CHECK(std::abs(found - expected.value) < 0.3 * expected.value + 3 * expected.error);
}

}  // namespace

TEST_CASE("carts in the four earthquakes: right as far as it says, or refused", "[pulse_superposition][statistics]") {
  // Fixed seed. A tail of escaped members makes the error of an rms uncertain itself; none of those is answered.
  for (const Caster& cart : {Caster::from_geometry_thesis(0.5, 0.04, 0.032), Caster::from_geometry(0.5, 0.04, 0.032)})
    for (const std::string_view name : PoissonPulses::events())
      for (const Overlap overlap : {Overlap::none, Overlap::renewal}) {
        CAPTURE(cart.reach(), name, overlap == Overlap::none);
        check_caster(overlap, cart, PoissonPulses::event(name), 2000);
      }
  // The thesis's cart, of which 0.024 m were predicted where it moves 0.4 m, and 0.28 mm where it moves 4.8 mm.
  const Slider cart(Caster::from_geometry_thesis(0.5, 0.04, 0.032));
  const PulseSuperposition theory;
  CHECK_THROWS_WITH(
      theory.final_rms(cart, PoissonPulses::event("great very near field")),
      "PulseSuperposition: the slider escapes within 60 s: overlapping pulses move it by 0.119 m rms, more "
      "than half of the 0.158 m over which the slip level halves");
  CHECK_THROWS_WITH(theory.final_rms(cart, PoissonPulses::event("great near field")),
                    ContainsSubstring("no theory covers both"));
  CHECK_THAT(theory.predict(cart, PoissonPulses::event("moderate very near field"), {}).remark,
             ContainsSubstring("3.21 times that of this theory"));
}

TEST_CASE("casters that escape, and those that do not", "[pulse_superposition][statistics]") {
  // docs/pulse_superposition.md has the map; here some of its corners, a = dt = 1.
  struct Run {
    double sigma, rate, reach, pulses;
  };
  for (const auto& [sigma, rate, reach, count] :
       {Run{0.35, 0.1, 3, 300}, Run{0.5, 0.003, 0.3, 3000}, Run{0.5, 0.5, 0.3, 30}, Run{0.7, 0.02, 0.3, 30},
        Run{0.7, 0.1, 1, 3000}, Run{0.7, 0.02, 10, 300}, Run{1, 0.02, 3, 300}, Run{1, 1, 1, 30}, Run{1.5, 0.1, 10, 300},
        Run{2, 0.1, 300, 300}, Run{3, 0.5, 100, 300}})
    for (const Overlap overlap : {Overlap::none, Overlap::renewal}) {
      CAPTURE(sigma, rate, reach, count, overlap == Overlap::none);
      check_caster(overlap, Caster(1, reach), PoissonPulses(rate, 1, sigma, count / rate), 1000);
    }
}

TEST_CASE("whether a caster escapes is asked of all the excitation, not of the times", "[pulse_superposition][long]") {
  const Slider caster(Caster(1, 1));
  const PoissonPulses pulses(0.1, 1, 0.7, 3e4);
  for (const std::vector<double>& times :
       {std::vector<double>{}, std::vector<double>{0.0}, std::vector<double>{50.0}, std::vector<double>{3e4}})
    CHECK_THROWS_WITH(PulseSuperposition().predict(caster, pulses, times), ContainsSubstring("30000 s"));
  // Nor of how it gets there: what outgrows the friction only at the end is refused at once.
  const PoissonPulses strong(0.5, 1, 2, 600);
  CHECK_THROWS_WITH(PulseSuperposition().predict(Slider(Caster(1, 3)), strong, std::vector<double>{1.0}),
                    ContainsSubstring("its rms displacement exceeds four times"));
  // Times after the end are allowed, too.
  const PoissonPulses early(0.5, 1, 2, 30);
  CHECK_NOTHROW(PulseSuperposition().predict(Slider(Caster(1, 10)), early, std::vector<double>{30.0}));
  CHECK_THROWS_WITH(PulseSuperposition().predict(Slider(Caster(1, 10)), early, std::vector<double>{6e3}),
                    ContainsSubstring("6000 s"));
}

TEST_CASE("where overlaps cannot be looked into the remark says so", "[pulse_superposition]") {
  const PulseShape uneven({0, 1, 3}, {1, -0.5});
  const Moments m = PulseSuperposition().predict(
      Slider(Caster(1, 50)), PoissonPulses(1e-3, 1, 1, 1e4, {.shape = uneven}), std::vector<double>{1e4});
  CHECK_THAT(m.remark, ContainsSubstring("overlapping pulses is unknown: PulseChain: the pulse must have equal steps"));
}

namespace {

/// A law that counts its evaluations.
struct Counted {
  static inline std::size_t asked = 0;
  template <class T>
  auto resist(const T& x, Direction) const {
    ++asked;
    return 1.0 / (1.0 + x * x / 100.0);
  }
};

}  // namespace

TEST_CASE("the progress callback is called between single responses, and what it throws ends the work",
          "[pulse_superposition]") {
  const Slider slider(Counted{});
  const PoissonPulses pulses(0.02, 1, 1.5, 1e4);
  std::size_t calls = 0, before = Counted::asked = 0, most = 0;
  const auto watch = [&] {
    ++calls;
    most = std::max(most, Counted::asked - std::exchange(before, Counted::asked));
  };
  PulseSuperposition().predict(slider, pulses, late, watch);
  CAPTURE(calls, most, Counted::asked);
  CHECK(calls > 10'000);
  CHECK(most < Counted::asked / 1000);
  for (const std::size_t end : {std::size_t{1}, std::size_t{100}, calls / 2, calls}) {
    std::size_t left = end;
    const auto stop = [&] {
      if (--left == 0) throw std::runtime_error("stop");
    };
    CHECK_THROWS_WITH(PulseSuperposition().predict(slider, pulses, late, stop), "stop");
    CHECK(left == 0);
  }
}

TEST_CASE("the largest |x| of Brownian motion", "[pulse_superposition]") {
  const auto probability = [](double z) {  // by images, as many as a double can see
    double sum = 0;
    for (int k = -200; k <= 200; ++k) {
      const auto cdf = [](double x) { return std::erfc(-x / std::numbers::sqrt2) / 2; };
      sum += (k % 2 ? -1 : 1) * (cdf((2 * k + 1) * z) - cdf((2 * k - 1) * z));
    }
    return sum;
  };
  for (const double p : {1e-6, 0.01, 0.3, 0.499, 0.501, 0.9, 0.999}) {
    const double z = peak_from_growth(4, 0.25, p);  // a spread of 1 at the end
    CAPTURE(p, z);
    CHECK(probability(z) == Approx(p).epsilon(1e-9).margin(1e-15));
  }
  CHECK(peak_from_growth(2, 9, 0.9) == Approx(std::sqrt(18.0) * peak_from_growth(1, 1, 0.9)).epsilon(1e-14));
  CHECK(peak_from_growth(0, 9, 0.9) == 0);
  CHECK(peak_from_growth(1, 1, 1 - 1e-16) > 8);
  CHECK(peak_from_growth(1, 1, 1e-300) > 0);
  CHECK_THROWS_WITH(peak_from_growth(-1, 1, 0.5),
                    "peak_from_growth: growth_rate must be finite and at least 0, got -1 m^2/s");
  CHECK_THROWS_WITH(peak_from_growth(1, 1, 1), "peak_from_growth: probability must lie in (0, 1), got 1");
  CHECK_THROWS_WITH(peak_from_growth(1, -1, 0.5), ContainsSubstring("duration"));
}

TEST_CASE("PulseSuperposition rejects arguments that it does not cover", "[pulse_superposition]") {
  const PoissonPulses pulses(0.5, 1, 2, 100);
  CHECK_THROWS_WITH(PulseSuperposition().predict(Slider(Coulomb(1), 2), pulses, late), ContainsSubstring("spring"));
  CHECK_THROWS_WITH(PulseSuperposition().predict(block(1), pulses, std::vector<double>{-1}),
                    "PulseSuperposition: times must be finite and at least 0, got -1 s");
  CHECK_THROWS_WITH(PulseSuperposition(Overlap::none)
                        .predict(block(0), PoissonPulses(0.5, 1, 2, 100, {.shape = PulseShape({0, 1}, {1})}), late),
                    ContainsSubstring("never stops"));
  PoissonOptions options;
  options.envelope = Envelope(1, 10, 1);
  CHECK_THROWS_WITH(PulseSuperposition().predict(Slider(Caster(1, 5)), PoissonPulses(0.5, 1, 2, 100, options), late),
                    ContainsSubstring("envelope"));
}
