// A sweep in the plane gives the results of `integrate`, combination by combination.
#include "stickslip/sweep/planar_sweep.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "stickslip/planar/any_planar_slider.hpp"
#include "stickslip/planar/identity.hpp"
#include "support/catch.hpp"
#include "support/motions.hpp"

using namespace stickslip;
using namespace test;
using Catch::Matchers::ContainsSubstring;

namespace {

/// Two independent components that rise and fade, of noise; a vertical one under which a slider may leave the ground.
GroundMotion station(std::uint64_t seed, double vertical = 0, double dt = 0.02) {
  const std::size_t samples = 120;
  std::vector<double> n = gaussian(3 * seed, samples, 4), t = gaussian(3 * seed + 1, samples, 3), up;
  if (vertical > 0) up = gaussian(3 * seed + 2, samples, vertical);
  for (std::size_t i = 0; i < samples; ++i) {
    const double s = static_cast<double>(i) / static_cast<double>(samples - 1);
    for (auto* component : {&n, &t, &up})
      if (!component->empty()) (*component)[i] *= 4 * s * (1 - s);
  }
  return GroundMotion(std::move(n), dt).with_components(std::move(t), std::move(up));
}

std::vector<AnyPlanarSlider> sliders() {
  return {PlanarSlider(Coulomb(1)),
          PlanarSlider(Coulomb(0.3), {.natural_frequency = 3, .damping = 0.1, .stops = {0.05, 0.05, 0.6}}),
          PlanarSlider(VelocityDependent(0.3, 0.6, 20), {.natural_frequency = 2, .pendulum = true}),
          PlanarSlider(StaticKinetic(Coulomb(0.8), 1.1)),
          PlanarSlider(Coulomb(3), {.slope_degrees = 10}),
          PlanarSlider(Degrading({0, 0.2}, {1, 0.5}))};
}

bool equal_bits(const PlanarSweepTable& table, std::size_t i, const PlanarResponse& one, double sign) {
  return table.peak[i] == one.peak && table.residual[i] == sign * one.residual &&
         table.sliding_distance[i] == one.sliding_distance && table.events[i] == one.events.size() - 1 &&
         (table.airborne[i] != 0) == one.state.in_flight;
}

}  // namespace

TEST_CASE("each combination in the plane is what integrate says, to the bit", "[sweep][planar]") {
  const std::vector<AnyPlanarSlider> these = sliders();
  const std::vector<GroundMotion> motions{station(1), station(2, 6), station(3, 0, 0.01)};
  for (const bool settle : {false, true}) {
    const PlanarSweepTable table = sweep(these, motions, {.settle = settle, .threads = 2});
    CHECK(table.failures.empty());
    for (std::size_t s = 0; s < these.size(); ++s)
      for (std::size_t r = 0; r < motions.size(); ++r) {
        PlanarIntegrateOptions how{.settle = settle};
        how.may_end_in_flight = true;
        const PlanarResponse one = integrate(these[s], motions[r], how);
        CHECK(equal_bits(table, table.at(s, r), one, 1));
        CHECK(one.sliding_distance > 0);
        // On level ground reversed motion gives the mirror image; downhill remains downhill.
        const PlanarResponse other = integrate(these[s], motions[r].scaled(-1), how);
        const bool level = mounting_of(these[s]).slope_degrees < 1;
        CHECK(equal_bits(table, table.at(s, r, 1), level ? one : other, level ? -1 : 1));
        if (level)
          CHECK(norm(other.residual + one.residual) <= 1e-11 * one.sliding_distance);
        else
          CHECK(table.residual[table.at(s, r)] != -table.residual[table.at(s, r, 1)]);
      }
  }
}

TEST_CASE("impacts on a circular stop are counted with their radial speeds", "[sweep][planar]") {
  const std::vector<AnyPlanarSlider> these = sliders();
  const std::vector<GroundMotion> motions{station(1), station(2)};
  const PlanarSweepTable table = sweep(these, motions, {.settle = true});
  REQUIRE(table.impacts.size() == table.peak.size());
  for (std::size_t r = 0; r < 2; ++r) {
    const PlanarResponse one = integrate(these[1], motions[r], {.settle = true});
    std::uint64_t count = 0;
    double speed = 0;
    for (const PlanarEvent& e : one.events)
      if (e.kind == EventKind::impact) {
        ++count;
        speed = std::max(speed, dot(e.velocity, e.displacement) / norm(e.displacement));
      }
    CHECK(count > 0);
    for (std::size_t p = 0; p < 2; ++p) {
      CHECK(table.impacts[table.at(1, r, p)] == SideImpacts{count, speed});
      CHECK(table.impacts[table.at(0, r, p)] == SideImpacts{});
    }
  }
  CHECK(sweep(std::vector{PlanarSlider(Coulomb(1))}, motions).impacts.empty());
}

TEST_CASE("one polarity has the bits of both, on any number of threads", "[sweep][planar]") {
  const std::vector<AnyPlanarSlider> these = sliders();
  const std::vector<GroundMotion> motions{station(4), station(5)};
  const PlanarSweepTable both = sweep(these, motions, {.threads = 1});
  for (const Polarity polarity : {Polarity::recorded, Polarity::reversed}) {
    const PlanarSweepTable one = sweep(these, motions, {.polarity = polarity, .threads = 4});
    CHECK(one.polarities == 1);
    for (std::size_t s = 0; s < these.size(); ++s)
      for (std::size_t r = 0; r < 2; ++r) {
        const std::size_t i = one.at(s, r), k = both.at(s, r, polarity == Polarity::reversed ? 1 : 0);
        CHECK(one.peak[i] == both.peak[k]);
        CHECK(one.residual[i] == both.residual[k]);
        CHECK(one.events[i] == both.events[k]);
      }
  }
}

TEST_CASE("under a load along one direction a sweep in the plane is a sweep on one axis", "[sweep][planar]") {
  const GroundMotion pair = station(6);
  std::vector<double> n(pair.acceleration().begin(), pair.acceleration().end()), t;
  for (const double a : n) t.push_back(0.75 * a);
  const GroundMotion collinear = GroundMotion(n, pair.dt()).with_components(std::move(t));
  const Mounting mounting{.natural_frequency = 2, .damping = 0.2};
  const PlanarSweepTable plane = sweep(std::vector{PlanarSlider(Coulomb(1), mounting)}, {collinear}, {.settle = true});
  const SweepTable axis = sweep(std::vector{Slider(Coulomb(1), mounting)}, {pair.scaled(1.25)}, {.settle = true});
  for (std::size_t p = 0; p < 2; ++p) {
    const double scale = axis.sliding_distance[p];
    CHECK(std::abs(plane.peak[p] - axis.peak[p]) <= 1e-11 * scale);
    CHECK(std::abs(plane.sliding_distance[p] - scale) <= 1e-11 * scale);
    CHECK(norm(plane.residual[p] - axis.residual[p] * Vector2{0.8, 0.6}) <= 1e-11 * scale);
  }
}

TEST_CASE("a motion without a transverse component fails and says so, and the others go on", "[sweep][planar]") {
  const std::vector<AnyPlanarSlider> these{PlanarSlider(Coulomb(1)),
                                           PlanarSlider(Coulomb(0), {.natural_frequency = 2})};
  const std::vector<GroundMotion> motions{station(7), line(1, 3, 1), station(8)};
  const PlanarSweepTable table = sweep(these, motions, {.settle = true});
  CHECK(table.failures.size() == 8);
  for (const SweepFailure& failure : table.failures) {
    const std::size_t i = table.at(failure.slider, failure.record, failure.polarity == Polarity::reversed ? 1 : 0);
    CHECK(std::isnan(table.peak[i]));
    CHECK(std::isnan(table.residual[i].axis));
    CHECK(std::isnan(table.residual[i].transverse));
    CHECK_THAT(failure.message,
               ContainsSubstring(failure.record == 1 ? "transverse component" : "does not come to rest"));
  }
  CHECK(table.peak[table.at(0, 0)] > 0);
  CHECK(table.peak[table.at(0, 2, 1)] > 0);
}

TEST_CASE("a sweep in the plane tells how far it is, ends with what its progress throws, and refuses nothing",
          "[sweep][planar]") {
  const std::vector<GroundMotion> motions{station(9), station(10)};
  SweepProgress last{};
  sweep(sliders(), motions, {.progress = [&](const SweepProgress& p) { last = p; }});
  CHECK(last.done == 24);
  CHECK(last.combinations == 24);
  struct Enough {};
  const std::vector<PlanarSlider<Coulomb>> many(2000, PlanarSlider(Coulomb(0.1)));
  CHECK_THROWS_AS(sweep(many, motions, {.progress = [](const SweepProgress&) { throw Enough{}; }}), Enough);
  CHECK_THROWS_WITH(sweep(std::vector<AnyPlanarSlider>{}, motions),
                    "sweep: needs at least one slider, got an empty list");
  CHECK_THROWS_WITH(sweep(sliders(), std::vector<GroundMotion>{}),
                    "sweep: needs at least one ground motion, got an empty list");
}

TEST_CASE("the identity of a slider in the plane is not that on one axis", "[identity][planar]") {
  const Mounting mounting{.natural_frequency = 2, .stops = {0.1, 0.1, 0.5}};
  CHECK(identity(PlanarSlider(Coulomb(1), mounting)) ==
        R"({"plane": true, "law": "Coulomb", "slip_level": 1, "backward": 1, "natural_frequency": 2, )"
        R"("stops": [0.1, 0.1, 0.5]})");
  CHECK(identity(AnyPlanarSlider(PlanarSlider(Coulomb(1)))) == identity(PlanarSlider(Coulomb(1))));
  CHECK(identity(PlanarSlider(Coulomb(1))) != identity(Slider(Coulomb(1))));
}
