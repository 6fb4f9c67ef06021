// Where members come from: lists of sliders and records, random sliders, user-defined sources.
//
// The seeds are fixed. Each statistical check says how often a correct program would fail it with a new seed.
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <string>
#include <variant>
#include <vector>

#include "stickslip/ensemble/run.hpp"
#include "stickslip/excitation/random.hpp"
#include "support/catch.hpp"
#include "support/motions.hpp"

using namespace stickslip;
using namespace test;
using Catch::Matchers::ContainsSubstring;

namespace {

EnsembleOptions options(std::uint64_t members, std::uint64_t first = 0, unsigned threads = 2) {
  EnsembleOptions o;
  o.members = members;
  o.first_member = first;
  o.seed = 5;
  o.threads = threads;
  return o;
}

/// Records of different lengths and steps, one of them held and at uneven times.
std::vector<GroundMotion> records() {
  std::vector<GroundMotion> motions;
  for (std::uint64_t i = 0; i < 5; ++i)
    motions.emplace_back(gaussian(i, 40 + 11 * i, 2), 0.02 * static_cast<double>(1 + i % 3));
  motions.emplace_back(std::vector<double>{2, -3, 1, 2}, std::vector<double>{1, 1.5, 1.5, 4}, Interpolation::constant);
  return motions;
}

/// Motions of one duration and step.
std::vector<GroundMotion> alike() {
  std::vector<GroundMotion> motions;
  for (std::uint64_t i = 0; i < 7; ++i) motions.emplace_back(gaussian(i, 81, 2), 0.05);
  return motions;
}

RandomSlider blocks([](double mu) { return Coulomb::from_friction(mu); }, Lognormal(0.1, 0.4));

/// As good as the same: round-off of some ten roundings of the largest x in each of a hundred segments.
void check_members(const Ensemble& ensemble, const std::vector<Response>& expected) {
  const std::vector<double> peak = ensemble.peak(), residual = ensemble.residual();
  REQUIRE((peak.size() == expected.size() && residual.size() == expected.size()));
  for (std::size_t i = 0; i < peak.size(); ++i) {
    INFO("member " << i);
    REQUIRE(std::abs(peak[i] - expected[i].peak) <= 5e-13 * expected[i].peak);
    REQUIRE(std::abs(residual[i] - expected[i].residual) <= 5e-13 * expected[i].peak);
  }
}

}  // namespace

TEST_CASE("member i of a list of records is the slider under record i modulo n", "[ensemble]") {
  const OneOf motions(records());
  const Coulomb law(0.7, 1.2);
  for (const bool settle : {false, true}) {
    EnsembleOptions o = options(100, 64);
    o.settle = settle;
    const Ensemble ensemble = run_ensemble(law, motions, o);
    IntegrateOptions to_rest;
    to_rest.settle = settle;
    std::vector<Response> expected;
    for (std::size_t i = 64; i < 164; ++i) expected.push_back(integrate(law, motions.items()[i % 6], to_rest));
    check_members(ensemble, expected);
    std::vector<double> sorted = ensemble.peak();
    std::ranges::sort(sorted);
    CHECK(ensemble.quantile(0.5).value == sorted[49]);
    CHECK(ensemble.exceedance(sorted[79]).value == Approx(20.0 / 100).margin(6.0 / 100));  // six values, all repeated
  }
}

TEST_CASE("records of different durations have no statistics by time, and say so", "[ensemble][errors]") {
  const Ensemble ensemble = run_ensemble(Coulomb(1), OneOf(records()), options(100));
  CHECK(ensemble.time().empty());
  CHECK((ensemble.parts().times == EnsembleTimes{}));
  const std::string message =
      "Ensemble: no statistics by time, for the ground motions differ in duration; peak, residual, quantile and "
      "exceedance are there";
  CHECK_THROWS_AS(ensemble.displacement_mean(), std::domain_error);
  CHECK_THROWS_WITH(ensemble.displacement_mean(), message);
  CHECK_THROWS_WITH(ensemble.displacement_variance(), message);
  CHECK_THROWS_WITH(ensemble.velocity_mean(), message);
  CHECK_THROWS_WITH(ensemble.velocity_variance(), message);
  CHECK_THROWS_WITH(ensemble.covariance(), message);
  CHECK_THROWS_WITH(ensemble.moments(), message);
  CHECK_THROWS_WITH(ensemble.stationary(), message);
  CHECK_THROWS_WITH(ensemble.velocity_spectrum(), message);
  EnsembleOptions o = options(10);
  o.dt = 0.1;
  CHECK_THROWS_WITH(run_ensemble(Coulomb(1), OneOf(records()), o),
                    ContainsSubstring("dt must not be given where ground motions differ in duration") &&
                        ContainsSubstring("got 0.1 s"));
  // Parts are checked as ever.
  Ensemble::Parts parts = ensemble.parts();
  parts.times.dt = 0.1;
  CHECK_THROWS_WITH(Ensemble(parts), ContainsSubstring("without times there is no dt, got 0.1 s"));
}

TEST_CASE("records of one duration have statistics by time", "[ensemble]") {
  const OneOf motions(alike());
  const Ensemble ensemble = run_ensemble(Coulomb(1), motions, options(7));
  REQUIRE((ensemble.parts().times == EnsembleTimes{0.05, 81}));
  std::vector<Response> expected;
  for (const GroundMotion& motion : motions.items()) expected.push_back(integrate(Coulomb(1), motion));
  check_members(ensemble, expected);
  const Estimates mean = ensemble.displacement_mean();
  for (std::size_t k = 0; k < 81; ++k) {
    double sum = 0, scale = 0;
    for (const Response& r : expected) {
      sum += r.displacement[k] / 7;
      scale = std::max(scale, r.peak);
    }
    REQUIRE(std::abs(mean.value[k] - sum) <= 5e-13 * scale);
  }
  // Other steps in the same duration: times of their own.
  std::vector<GroundMotion> mixed = alike();
  mixed.emplace_back(gaussian(9, 41, 2), 0.1);
  const auto base = OneOf(mixed).time_base();
  REQUIRE(base);
  CHECK((base->duration == Approx(4) && base->dt == 0));
  CHECK(run_ensemble(Coulomb(1), OneOf(mixed), options(8)).parts().times.count == 513);
  CHECK_FALSE(OneOf(records()).time_base());
}

TEST_CASE("lists and random sliders have the same bits on 1, 2 and 3 threads, in parts, and resumed", "[ensemble]") {
  const auto check = [](const auto& sliders, const auto& motions) {
    const Ensemble whole = run_ensemble(sliders, motions, options(300, 0, 1));
    CHECK(run_ensemble(sliders, motions, options(300, 0, 2)) == whole);
    CHECK(run_ensemble(sliders, motions, options(300, 0, 3)) == whole);
    Ensemble parts = run_ensemble(sliders, motions, options(172, 128));
    parts.merge(run_ensemble(sliders, motions, options(128)));
    CHECK(parts == whole);
    const Ensemble begun = run_ensemble(sliders, motions, options(64, 64));
    CHECK(run_ensemble(sliders, motions, options(300), &begun) == whole);
    CHECK(whole.members() == 300);
  };
  check(blocks, OneOf(records()));
  check(blocks, OneOf(records(), Order::drawn));
  check(blocks, OneOf(alike(), Order::drawn));
  check(blocks, PoissonPulses(1, 0.5, 3, 5));
  check(OneOf(std::vector{Slider(Coulomb(1)), Slider(Coulomb(2), 1.5)}), OneOf(records()));
}

TEST_CASE("a member of random sliders is the slider that its index draws, under its motion", "[ensemble]") {
  const OneOf motions(records(), Order::drawn);
  const Ensemble ensemble = run_ensemble(blocks, motions, options(100, 64));
  std::vector<Response> expected;
  for (std::uint64_t i = 64; i < 164; ++i) expected.push_back(integrate(blocks.sample(5, i), motions.sample(5, i)));
  check_members(ensemble, expected);
}

TEST_CASE("random parameters have the distribution that was asked for", "[ensemble][statistics]") {
  // Mean and variance of n standard normal numbers: normal to 1 %, beyond 5 standard errors once in 1.7 million seeds.
  constexpr std::size_t n = 20'000;
  const RandomSlider sliders(
      [](double mu, double period) { return Slider(Coulomb::from_friction(mu), 6.283185307179586 / period); },
      Lognormal(0.3, 0.4), Uniform(1, 3));
  double mean = 0, square = 0, product = 0, uniform = 0;
  std::size_t below_median = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const auto [mu, period] = sliders.values(11, i);
    const double z = std::log(mu / 0.3) / 0.4, u = (period - 2) * std::sqrt(3.0);
    mean += z / n;
    square += z * z / n;
    product += z * u / n;
    uniform += u / n;
    below_median += mu < 0.3;
    REQUIRE(sliders.sample(11, i).law().forward() == Coulomb::from_friction(mu).forward());
  }
  const double error = 1 / std::sqrt(static_cast<double>(n));
  CHECK(std::abs(mean) < 5 * error);
  CHECK(std::abs(square - 1) < 5 * std::sqrt(2.0) * error);
  CHECK(std::abs(uniform) < 5 * error);
  CHECK(std::abs(product) < 5 * error);  // parameters are independent
  CHECK(std::abs(static_cast<double>(below_median) / n - 0.5) < 5 * 0.5 * error);
}

TEST_CASE("a parameter keeps its draws where another's distribution changes", "[ensemble]") {
  const auto make = [](double mu, double wn) { return Slider(Coulomb::from_friction(mu), wn); };
  const RandomSlider random(make, Uniform(0.1, 0.2), Lognormal(2, 0.5));
  const RandomSlider fixed(make, 0.15, Lognormal(2, 0.5));
  for (std::uint64_t i = 0; i < 100; ++i) {
    CHECK(random.values(3, i)[1] == fixed.values(3, i)[1]);
    CHECK(fixed.values(3, i)[0] == 0.15);
    CHECK(random.values(3, i)[0] != random.values(4, i)[0]);
  }
}

TEST_CASE("each record is drawn as often as any other, whatever slider is drawn", "[ensemble][statistics]") {
  // Counts of n members are within 5 standard errors but once in 1.7 million seeds each, of which there are eleven.
  constexpr std::size_t n = 12'000;
  const std::vector<GroundMotion> list = records();
  const OneOf motions(list, Order::drawn);
  const OneOf sliders(std::vector{Slider(Coulomb(1)), Slider(Coulomb(2))}, Order::drawn);
  std::array<std::size_t, 12> counts{};
  for (std::size_t i = 0; i < n; ++i) {
    const auto motion = static_cast<std::size_t>(&motions.sample(1, i) - motions.items().data());
    const auto slider = static_cast<std::size_t>(&sliders.sample(1, i) - sliders.items().data());
    REQUIRE((motion < 6 && slider < 2));
    ++counts[2 * motion + slider];
  }
  const double p = 1.0 / 12, error = std::sqrt(p * (1 - p) / n);
  for (const std::size_t count : counts) CHECK(std::abs(static_cast<double>(count) / n - p) < 5 * error);
}

TEST_CASE("a list holds sliders of any kind", "[ensemble]") {
  using Any = std::variant<Slider<Coulomb>, Slider<Caster>, ViscousSlider>;
  const OneOf sliders(std::vector<Any>{Slider(Coulomb(1)), Slider(Caster(1, 0.5), 2.0), ViscousSlider(0.7, 3)});
  const OneOf motions(alike());
  const Ensemble ensemble = run_ensemble(sliders, motions, options(21));
  const std::vector<double> peak = ensemble.peak();
  for (std::size_t i = 0; i < 21; ++i) {
    const GroundMotion& motion = motions.items()[i % 7];
    const double expected = i % 3 == 0   ? integrate(Coulomb(1), motion).peak
                            : i % 3 == 1 ? integrate(Slider(Caster(1, 0.5), 2.0), motion).peak
                                         : integrate(ViscousSlider(0.7, 3), motion).peak;
    CHECK(peak[i] == Approx(expected).epsilon(1e-10));
  }
  EnsembleOptions o = options(21);
  o.settle = true;
  CHECK_THROWS_WITH(run_ensemble(sliders, motions, o), ContainsSubstring("does not come to rest"));
}

TEST_CASE("a source of members of one's own runs as the built-in ones do", "[ensemble]") {
  struct Stronger {
    std::vector<GroundMotion> motions = records();
    Member<Slider<Coulomb>, const GroundMotion&> member(std::uint64_t, std::uint64_t index) const {
      return {Slider(Coulomb(1 + static_cast<double>(index))), motions[index % motions.size()]};
    }
    std::optional<TimeBase> time_base() const { return std::nullopt; }
    EnsembleConfiguration configuration() const { return {{"source", "\"Stronger\""}}; }
  };
  const Stronger source;
  const Ensemble ensemble = run_ensemble(source, options(12));
  std::vector<Response> expected;
  for (std::size_t i = 0; i < 12; ++i)
    expected.push_back(integrate(Coulomb(1 + static_cast<double>(i)), source.motions[i % 6]));
  check_members(ensemble, expected);
  CHECK(ensemble.configuration()[0].second == "\"Stronger\"");
}

TEST_CASE("what lists and random sliders depend on is told, so that no other members are merged", "[ensemble]") {
  const auto slider = [](const Ensemble& e) { return e.configuration()[0].second; };
  const auto motion = [](const Ensemble& e) { return e.configuration()[1].second; };
  const Ensemble one = run_ensemble(blocks, OneOf(records()), options(64));
  CHECK_THAT(slider(one),
             ContainsSubstring(R"("random": [{"distribution": "Lognormal", "median": 0.1, "beta": 0.4}])"));
  CHECK_THAT(motion(one), ContainsSubstring(R"("motions": 6, "digest": ")"));
  const auto refused = [&](const auto& sliders, const auto& motions) {
    Ensemble copy = one;
    CHECK_THROWS_WITH(copy.merge(run_ensemble(sliders, motions, options(64, 64))), ContainsSubstring("cannot merge"));
  };
  const RandomSlider others([](double mu) { return Coulomb::from_friction(2 * mu); }, Lognormal(0.1, 0.4));
  refused(others, OneOf(records()));  // the same parameters, another slider
  refused(blocks, OneOf(records(), Order::drawn));
  std::vector<GroundMotion> changed = records();
  changed[3] = changed[3].scaled(-1);
  refused(blocks, OneOf(changed));
  changed = records();
  std::swap(changed[0], changed[1]);
  refused(blocks, OneOf(changed));
}

TEST_CASE("bad lists and parameters are named", "[ensemble][errors]") {
  CHECK_THROWS_WITH(OneOf(std::vector<GroundMotion>{}), "OneOf: needs at least one item, got an empty list");
  const RandomSlider slippery([](double mu) { return Coulomb::from_friction(mu); }, Normal(0.1, 0.05));
  // A draw is negative once in 44 members: none of the first 1000 is, in one of 10^10 seeds.
  std::uint64_t member = 0;
  while (slippery.values(5, member)[0] >= 0) ++member;
  REQUIRE(member < 1000);
  const std::string got = detail::shortest(slippery.values(5, member)[0]);
  CHECK_THROWS_WITH(
      run_ensemble(slippery, OneOf(records()), options(member + 1, 0, 1)),
      "RandomSlider: member " + std::to_string(member) + ": Coulomb: mu must be finite and at least 0, got " + got);
  CHECK_THROWS_WITH(RandomSlider([](double mu) { return Coulomb::from_friction(mu); }, Uniform(-2, -1)),
                    ContainsSubstring("Coulomb: mu must be finite and at least 0, got -1.75"));
}
