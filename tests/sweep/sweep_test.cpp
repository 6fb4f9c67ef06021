// A sweep gives the results of `integrate`, combination by combination.
#include "stickslip/sweep/sweep.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>
#include <stdexcept>
#include <variant>
#include <vector>

#include "lanes/instruction_sets.hpp"
#include "stickslip/friction/caster.hpp"
#include "stickslip/friction/degrading.hpp"
#include "stickslip/friction/multi_pendulum.hpp"
#include "stickslip/friction/static_kinetic.hpp"
#include "stickslip/friction/velocity_dependent.hpp"
#include "support/catch.hpp"
#include "support/motions.hpp"
#include "support/size.hpp"

using namespace stickslip;
using namespace test;

namespace {

/// A record like a real one: noise within an envelope, with quiet before and after, of a random strength and step.
GroundMotion quake(std::uint64_t seed) {
  std::mt19937_64 bits(seed);
  const auto draw = [&](double from, double to) { return std::uniform_real_distribution<double>(from, to)(bits); };
  const auto samples = static_cast<std::size_t>(draw(40, 1500));
  const double strength = std::exp(draw(-2, 2)), peak = draw(0.1, 0.6) * static_cast<double>(samples);
  std::vector<double> n = gaussian(seed, samples, strength, bits() % 2 == 0);
  for (std::size_t i = 0; i < samples; ++i) {
    const double t = static_cast<double>(i) / peak;
    n[i] *= t * std::exp(1 - t);
    if (bits() % 64 == 0) n[i] = 0;
  }
  return {std::move(n), draw(0.002, 0.1), bits() % 4 == 0 ? Interpolation::constant : Interpolation::linear};
}

/// Levels in the two directions: equal, one-way, different.
Coulomb block(std::mt19937_64& bits) {
  const auto level = [&] { return std::exp(std::uniform_real_distribution<double>(-4, 1.5)(bits)); };
  const double forward = bits() % 50 == 0 ? 0 : level();
  switch (bits() % 3) {
    case 0:
      return Coulomb(forward);
    case 1:
      return Coulomb(forward, infinity);
    default:
      return Coulomb(forward, level());
  }
}

/// The largest error of a sweep against `integrate`, as a part of the way slid and of what moves the slider, and how
/// many numbers of events differ.
struct Differences {
  double error = 0;
  std::size_t combinations = 0, events = 0, moved = 0;
};

template <FrictionLaw Law, class Work>
auto of(const Slider<Law>& slider, const Work& work) {
  return work(slider);
}
template <class... S, class Work>
auto of(const std::variant<S...>& slider, const Work& work) {
  return std::visit(work, slider);
}

template <class S>
Differences differences(const SweepTable& table, const std::vector<S>& sliders,
                        const std::vector<GroundMotion>& motions, const SweepOptions& options) {
  Differences d;
  for (std::size_t s = 0; s < sliders.size(); ++s)
    for (std::size_t r = 0; r < motions.size(); ++r)
      for (std::size_t p = 0; p < table.polarities; ++p) {
        const bool reversed = options.polarity == Polarity::reversed || p == 1;
        const Response expected = of(sliders[s], [&](const auto& slider) {
          return integrate(slider, motions[r].scaled(reversed ? -1 : 1), {.settle = options.settle});
        });
        const std::size_t i = table.at(s, r, p);
        const double reach = expected.sliding_distance + motions[r].dt() * motions[r].dt();
        for (const double error : {table.peak[i] - expected.peak, table.residual[i] - expected.residual,
                                   table.sliding_distance[i] - expected.sliding_distance})
          d.error = std::max(d.error, std::isfinite(error) ? std::abs(error) / reach : infinity);
        d.events += table.events[i] != expected.events.size() - 1;
        d.moved += expected.sliding_distance > 0;
        ++d.combinations;
      }
  return d;
}

}  // namespace

TEST_CASE("a sweep agrees with integrate for each combination, including the number of events", "[sweep]") {
  std::mt19937_64 bits(1);
  std::vector<Slider<Coulomb>> sliders;
  for (int i = 0; i < 50; ++i) sliders.emplace_back(block(bits));
  std::vector<GroundMotion> motions;
  const std::uint64_t records = size(100, 10);
  for (std::uint64_t seed = 0; seed < records; ++seed) motions.push_back(quake(seed));
  on_each_instruction_set([&](const std::string& name) {
    const SweepOptions options{.threads = 1};
    const SweepTable table = sweep(sliders, motions, options);
    const Differences d = differences(table, sliders, motions, options);
    INFO(name);
    CHECK(d.combinations == 100 * records);
    CHECK(d.moved > 50 * records);
    CHECK(d.events == 0);
    CHECK(d.error < 1e-12);
    CHECK(table.failures.empty());
  });
}

TEST_CASE("on slopes, under vertical motion and with static friction a sweep is what integrate says, events counted",
          "[sweep][long]") {
  using Any = std::variant<Slider<Coulomb>, Slider<StaticKinetic<Coulomb>>>;
  std::mt19937_64 bits(4);
  const auto draw = [&](double from, double to) { return std::uniform_real_distribution<double>(from, to)(bits); };
  std::vector<Any> sliders;
  while (sliders.size() < 50) {
    const Coulomb law = block(bits);
    const Mounting mounting{.slope_degrees = bits() % 2 == 0 ? std::array{0.0, 5.0, 20.0}[bits() % 3] : 0,
                            .one_way = bits() % 3 == 0};
    const double rise = bits() % 2 == 0 ? 1 + draw(0, 1) : 1;
    // Otherwise it would slide indefinitely under its own weight.
    if (law.forward() <= 1.1 * standard_gravity * std::tan(mounting.slope_degrees * std::numbers::pi / 180)) continue;
    if (rise > 1)
      sliders.push_back(Slider(StaticKinetic(law, rise * law.forward(), rise * law.backward()), mounting));
    else
      sliders.push_back(Slider(law, mounting));
  }
  std::vector<GroundMotion> motions;
  const std::uint64_t records = size(100, 10);
  for (std::uint64_t seed = 0; seed < records; ++seed) {
    const GroundMotion motion = quake(200 + seed);
    // A third stays horizontal; under some of the rest the ground falls away.
    std::vector<double> up = gaussian(300 + seed, motion.samples(), draw(0.1, 3), false);
    up.back() = 0;
    motions.push_back(seed % 3 == 0 ? motion : motion.with_components({}, std::move(up)));
  }
  on_each_instruction_set([&](const std::string& name) {
    const SweepOptions options{.settle = true, .threads = 1};
    const SweepTable table = sweep(sliders, motions, options);
    const Differences d = differences(table, sliders, motions, options);
    INFO(name);
    CHECK(d.combinations == 100 * records);
    CHECK(d.moved > 40 * records);
    CHECK(d.events == 0);
    CHECK(d.error < 1e-12);
    CHECK(table.failures.empty());
  });
}

namespace {

using Linear = std::variant<Slider<Coulomb>, Slider<StaticKinetic<Coulomb>>, Slider<Degrading>, Slider<MultiPendulum>>;

/// Sliders whose motion is linear between events: on springs, soft and stiff for the steps of `quake`, with dampers, and
/// with stops; with a static level; of friction that changes with the distance; of several surfaces.
Linear linear_slider(std::mt19937_64& bits) {
  const auto draw = [&](double from, double to) { return std::uniform_real_distribution<double>(from, to)(bits); };
  const auto sometimes = [&](double value) { return bits() % 2 == 0 ? value : 0; };
  Mounting mounting{.natural_frequency = sometimes(std::exp(draw(-1, 4))), .damping = sometimes(draw(0, 3))};
  const Stops stops(std::exp(draw(-6, 0)), std::exp(draw(-6, 0)), draw(0, 0.6));
  const double level = std::exp(draw(-3, 1));
  switch (bits() % 5) {
    case 0:
      if (bits() % 2 == 0) mounting.stops = stops;
      mounting.one_way = bits() % 4 == 0;
      return Slider(block(bits), mounting);
    case 1:
      return Slider(StaticKinetic(Coulomb(level), 1.3 * level, 1.3 * level), mounting);
    case 2: {
      const double reach = std::exp(draw(-4, 0));
      return Slider(Degrading({0, reach, 3 * reach}, {level, 0.4 * level, 0.6 * level}), mounting);
    }
    case 3:
      return Slider(MultiPendulum({0.4, 2, 3}, {0.01, draw(0.03, 0.06), draw(0.06, 0.1)}, {0.06, 0.3, 0.3}, 0.3, true));
    default: {
      std::vector<double> radii, mu, capacities;
      for (std::uint64_t k = 1 + bits() % 5; k > 0; --k) {
        radii.push_back(bits() % 12 == 0 ? infinity : draw(0.3, 3));
        mu.push_back(bits() % 3 == 0 ? 0.05 : draw(0.01, 0.1));
        capacities.push_back(bits() % 5 == 0 ? infinity : draw(0.01, 0.1));
      }
      return Slider(MultiPendulum(radii, mu, capacities, 0.2));
    }
  }
}

}  // namespace

TEST_CASE("sliders whose motion is linear between events are swept as integrate moves them", "[sweep]") {
  std::mt19937_64 bits(5);
  std::vector<Linear> sliders;
  for (int i = 0; i < 61; ++i) sliders.push_back(linear_slider(bits));
  std::vector<GroundMotion> motions;
  const std::uint64_t records = size(7, 2);
  for (std::uint64_t seed = 0; seed < records; ++seed) motions.push_back(quake(500 + seed));
  motions.push_back({{0, 3, -2, 1, 0}, std::vector<double>{0, 0.5, 0.75, 2, 2.5}});  // uneven steps
  on_each_instruction_set([&](const std::string& name) {
    const SweepOptions options{.settle = true, .threads = 1};
    const SweepTable table = sweep(sliders, motions, options);
    const Differences d = differences(table, sliders, motions, options);
    INFO(name);
    CHECK(d.combinations == 2 * sliders.size() * motions.size());
    CHECK(2 * d.moved > d.combinations);
    CHECK(d.events == 0);
    CHECK(d.error < 1e-11);
    CHECK(table.failures.empty());
  });
}

TEST_CASE("with short steps sliders on springs pass their events as integrate moves them", "[sweep]") {
  using Any = std::variant<Slider<Coulomb>, Slider<StaticKinetic<Coulomb>>>;
  std::mt19937_64 bits(6);
  const auto draw = [&](double from, double to) { return std::uniform_real_distribution<double>(from, to)(bits); };
  std::vector<GroundMotion> motions;
  for (std::uint64_t seed = 0; seed < size(8, 3); ++seed) motions.push_back(quake(900 + seed));
  motions.emplace_back(gaussian(7, 400, 2), 0.02);  // begins beyond the level
  std::vector<Any> sliders;
  while (sliders.size() < 64) {
    const double wn = draw(0, 7);
    Mounting mounting{.natural_frequency = wn, .damping = bits() % 2 == 0 ? draw(0, 0.6) * wn : 0};
    mounting.one_way = bits() % 4 == 0;
    if (bits() % 4 == 0) mounting.stops = Stops(draw(0.05, 0.2), draw(0.05, 0.2), 0.3);
    const Coulomb law = block(bits);
    if (!(law.forward() > 0)) continue;  // would never rest
    if (bits() % 3 == 0)
      sliders.push_back(Slider(StaticKinetic(law, 1.4 * law.forward(), 1.4 * law.backward()), mounting));
    else
      sliders.push_back(Slider(law, mounting));
  }
  on_each_instruction_set([&](const std::string& name) {
    const SweepOptions options{.settle = true, .threads = 1};
    const SweepTable table = sweep(sliders, motions, options);
    const Differences d = differences(table, sliders, motions, options);
    INFO(name);
    CHECK(2 * d.moved > d.combinations);
    CHECK(d.events == 0);
    CHECK(d.error < 1e-11);
    CHECK(table.failures.empty());
  });
}

TEST_CASE("settled, in one polarity or both, with sliders of all kinds, a sweep is what integrate says", "[sweep]") {
  using Any = std::variant<Slider<Coulomb>, Slider<Caster>, Slider<VelocityDependent>>;
  const std::vector<Any> mixed{Slider(Coulomb(0.3)),           Slider(Caster(0.5, 1e6)),
                               Slider(Coulomb(0.2, infinity)), Slider(Coulomb(0.4), 3),
                               Slider(Coulomb(0.4), 0, 0.5),   Slider(VelocityDependent(0.2, 0.5, 20))};
  std::mt19937_64 bits(2);
  std::vector<Slider<Coulomb>> blocks;
  for (int i = 0; i < 21; ++i)
    if (const Coulomb law = block(bits); law.forward() > 0) blocks.emplace_back(law);
  std::vector<GroundMotion> motions;
  for (std::uint64_t seed = 100; seed < 110; ++seed) motions.push_back(quake(seed));
  motions.push_back({{0, 3, -2, 1, 0}, std::vector<double>{0, 0.5, 0.75, 2, 2.5}});  // uneven steps
  motions.push_back(broadband(3, 9000));
  for (const Polarity polarity : {Polarity::recorded, Polarity::reversed, Polarity::both}) {
    const SweepOptions options{.polarity = polarity, .settle = true};
    const SweepTable table = sweep(blocks, motions, options);
    CHECK(table.polarities == (polarity == Polarity::both ? 2 : 1));
    const Differences d = differences(table, blocks, motions, options);
    CHECK(d.events == 0);
    CHECK(d.error < 1e-11);  // 9000 samples sum up
  }
  const SweepTable table = sweep(mixed, motions, {.settle = true});
  for (std::size_t s = 0; s < mixed.size(); ++s)
    for (std::size_t r = 0; r < motions.size(); ++r)
      for (std::size_t p = 0; p < 2; ++p) {
        const GroundMotion motion = motions[r].scaled(p == 0 ? 1 : -1);
        const Response expected =
            std::visit([&](const auto& slider) { return integrate(slider, motion, {.settle = true}); }, mixed[s]);
        const double allowed = 1e-11 * (1 + expected.sliding_distance);
        CHECK(std::abs(table.peak[table.at(s, r, p)] - expected.peak) < allowed);
        CHECK(std::abs(table.residual[table.at(s, r, p)] - expected.residual) < allowed);
        CHECK(table.events[table.at(s, r, p)] == expected.events.size() - 1);
      }
}

TEST_CASE("a block that is alike both ways does the same the other way under the reversed motion", "[sweep]") {
  const std::vector<GroundMotion> motions{quake(7), quake(8)};
  const SweepTable table = sweep(std::vector{Coulomb(0.1), Coulomb(0.5)}, motions);
  for (std::size_t s = 0; s < 2; ++s)
    for (std::size_t r = 0; r < 2; ++r) {
      CHECK(table.peak[table.at(s, r)] == table.peak[table.at(s, r, 1)]);
      CHECK(table.residual[table.at(s, r)] == -table.residual[table.at(s, r, 1)]);
      CHECK(table.residual[table.at(s, r)] != 0);
    }
}

TEST_CASE("the results of a sweep depend neither on the threads nor on the other sliders", "[sweep]") {
  std::mt19937_64 bits(3);
  std::vector<Slider<Coulomb>> sliders;
  for (int i = 0; i < 33; ++i) sliders.emplace_back(block(bits));
  std::vector<GroundMotion> motions;
  for (std::uint64_t seed = 200; seed < 220; ++seed) motions.push_back(quake(seed));
  const SweepTable one = sweep(sliders, motions, {.threads = 1}), four = sweep(sliders, motions, {.threads = 4});
  CHECK(one.peak == four.peak);
  CHECK(one.residual == four.residual);
  CHECK(one.events == four.events);
  std::vector<GroundMotion> last{motions.back()};
  const SweepTable alone = sweep(sliders, last);
  for (std::size_t s = 0; s < sliders.size(); ++s) CHECK(alone.peak[alone.at(s, 0)] == one.peak[one.at(s, 19)]);
}

TEST_CASE("one-way displacement never grows with the yield acceleration", "[sweep]") {
  std::vector<Coulomb> levels;
  for (int i = 1; i <= 200; ++i) levels.emplace_back(0.02 * i, infinity);
  const std::vector<GroundMotion> motions{quake(11), quake(12), quake(14)};
  const SweepTable table = sweep(levels, motions, {.settle = true});
  for (std::size_t s = 1; s < levels.size(); ++s)
    for (std::size_t r = 0; r < motions.size(); ++r)
      for (std::size_t p = 0; p < 2; ++p)
        CHECK(table.residual[table.at(s, r, p)] <= table.residual[table.at(s - 1, r, p)] * (1 + 1e-12));
}

TEST_CASE("a combination that fails is not a number and says why, and the others go on", "[sweep]") {
  const std::vector<Slider<Coulomb>> sliders{Slider(Coulomb(0)), Slider(Coulomb(0.5)), Slider(Coulomb(0), 2)};
  const std::vector<GroundMotion> motions{line(1, 3, 1), line(0.1, 0.2, 1)};
  const SweepTable table = sweep(sliders, motions, {.polarity = Polarity::recorded, .settle = true, .threads = 2});
  CHECK(table.failures.size() == 4);
  for (const SweepFailure& failure : table.failures) {
    CHECK(failure.slider != 1);
    CHECK(std::isnan(table.peak[table.at(failure.slider, failure.record)]));
    CHECK_THAT(failure.message, Catch::Matchers::ContainsSubstring("does not come to rest"));
  }
  CHECK(table.peak[table.at(1, 0)] > 0);
  CHECK(table.peak[table.at(1, 1)] == 0);
}

TEST_CASE("a sweep tells how far it is, and ends with what its progress callback throws", "[sweep]") {
  const std::vector<GroundMotion> motions(3, quake(1));
  SweepProgress last{};
  sweep(std::vector{Coulomb(1), Coulomb(2)}, motions, {.progress = [&](const SweepProgress& p) { last = p; }});
  CHECK(last.done == 12);
  CHECK(last.combinations == 12);
  struct Enough {};
  const std::vector<Caster> casters(2000, Caster(0.5, 0.05));
  CHECK_THROWS_AS(sweep(casters, motions, {.progress = [](const SweepProgress&) { throw Enough{}; }}), Enough);
}

TEST_CASE("a sweep of nothing is refused", "[sweep]") {
  CHECK_THROWS_WITH(sweep(std::vector<Coulomb>{}, {quake(1)}), "sweep: needs at least one slider, got an empty list");
  CHECK_THROWS_WITH(sweep(std::vector{Coulomb(1)}, std::vector<GroundMotion>{}),
                    "sweep: needs at least one ground motion, got an empty list");
}
