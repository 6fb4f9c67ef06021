// Sweeps of structures equal single integrations.
#include "stickslip/structure/sweep.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>
#include <string>
#include <vector>

#include "stickslip/core.hpp"
#include "stickslip/structure/equipment_on_floor.hpp"
#include "stickslip/structure/floor_motions.hpp"
#include "stickslip/structure/isolated_structure.hpp"
#include "structure/eigen.hpp"
#include "support/catch.hpp"
#include "support/size.hpp"

using namespace stickslip;
using Catch::Matchers::ContainsSubstring;

namespace {

using Bits = std::mt19937_64;

double uniform(Bits& bits, double low, double high) { return std::uniform_real_distribution(low, high)(bits); }

enum Kind { even, held, uneven, with_vertical };

// Rests at times, so that there is something to pass.
GroundMotion random_motion(Bits& bits, Kind kind = even, std::size_t samples = 150) {
  std::normal_distribution<> normal(0, 2);
  std::vector<double> n, up, times;
  double strength = 1, time = 0;
  for (std::size_t i = 0; i < samples; ++i) {
    if (i % 20 == 0) strength = uniform(bits, 0, 1) < 0.4 ? 0.03 : 1;
    n.push_back(strength * normal(bits));
    up.push_back(2 * normal(bits));
    times.push_back(time += uniform(bits, 0.01, 0.1));
  }
  if (kind == uneven) return GroundMotion(n, times);
  const GroundMotion motion(n, 0.05, kind == held ? Interpolation::constant : Interpolation::linear);
  return kind == with_vertical ? motion.with_components({}, up) : motion;
}

template <class S>
void check_equal(const std::vector<S>& structures, const std::vector<GroundMotion>& motions, bool settle,
                 double tolerance = 1e-12) {
  SweepOptions options;
  options.settle = settle;
  const SweepTable table = sweep(structures, motions, options);
  CHECK(table.failures.empty());
  for (std::size_t s = 0; s < structures.size(); ++s)
    for (std::size_t r = 0; r < motions.size(); ++r)
      for (const std::size_t p : {0, 1}) {
        StructureIntegrateOptions how;
        how.settle = settle;
        const StructureResponse one = integrate(structures[s], p == 0 ? motions[r] : motions[r].scaled(-1), how);
        const std::size_t i = table.at(s, r, p);
        const double scale = tolerance * std::max(one.sliding_distance, 1e-3);
        INFO("structure " << s << ", motion " << r << ", polarity " << p << ", margin " << one.margin);
        CHECK(std::abs(table.peak[i] - one.peak) <= scale);
        CHECK(std::abs(table.residual[i] - one.residual) <= scale);
        CHECK(std::abs(table.sliding_distance[i] - one.sliding_distance) <= scale);
        CHECK(table.events[i] == one.events.size() - 1);
        if (!table.impacts.empty()) CHECK(table.impacts[i].forward.count == impacts(one.events).forward.count);
      }
}

std::vector<FlexibleSlope> levels_of(FlexibleSlope slope) {
  std::vector<FlexibleSlope> slopes;
  for (const double ky : {0.0, 0.01, 0.03, 0.1, 0.2, 0.5}) {
    slope.ky_g = ky;
    slopes.push_back(slope);
  }
  slope.ky_g = 0;
  for (const double peak : {0.5, 2.0}) {
    slope.degrading = Degrading({0, 0.02, 0.1}, {peak, 0.7 * peak, 0.6 * peak});
    slopes.push_back(slope);
  }
  return slopes;
}

}  // namespace

TEST_CASE("a sweep of slopes equals single integrations", "[structure][sweep]") {
  Bits bits(1);
  for (int i = 0; i < test::size(60, 2); ++i) {
    FlexibleSlope slope;
    slope.height = uniform(bits, 5, 100);
    slope.shear_velocity = uniform(bits, 100, 800);
    slope.damping_ratio = i % 5 == 0 ? 1 : uniform(bits, 0.01, 0.3);
    slope.modes = 1 + i % 4;
    if (i % 3 == 0) slope.rock_velocity = uniform(bits, 800, 2000);
    slope.method = i % 2 == 0 ? SlopeMethod::coupled : SlopeMethod::decoupled;
    const auto kind = static_cast<Kind>(i % 4);
    const bool settle = i % 8 > 3;
    if (settle && slope.method == SlopeMethod::decoupled) slope.damping_ratio += 0.05;
    CAPTURE(i, slope.height, slope.shear_velocity, slope.damping_ratio, slope.modes);
    auto slopes = levels_of(slope);
    if (settle) slopes.erase(slopes.begin());  // without friction it never rests
    check_equal(slopes, {random_motion(bits, kind), random_motion(bits, kind)}, settle);
  }
}

TEST_CASE("a sweep of equivalent-linear slopes equals single integrations", "[structure][sweep]") {
  Bits bits(2);
  for (int i = 0; i < test::size(10, 1); ++i) {
    FlexibleSlope slope;
    slope.height = uniform(bits, 10, 100);
    slope.shear_velocity = uniform(bits, 200, 800);
    slope.soil = HyperbolicSoil(uniform(bits, 5e-4, 5e-3));
    slope.modes = 1 + i % 3;
    check_equal(levels_of(slope), {random_motion(bits), random_motion(bits, i % 2 == 0 ? even : held)}, false);
  }
}

TEST_CASE("a sweep of structures equals single integrations", "[structure][sweep][long]") {
  Bits bits(3);
  for (int i = 0; i < test::size(25, 1); ++i) {
    const auto kind = static_cast<Kind>(i % 4);
    const std::vector<GroundMotion> motions{random_motion(bits, kind), random_motion(bits, kind)};
    const double stiff = uniform(bits, 100, 2000);
    const Structure classical = Structure::shear_building({1, 1, 0.8}, {stiff, stiff, stiff}, 0.03);
    RealMatrix dashpot = classical.damping();
    dashpot(0, 0) += 2;
    const Structure other(classical.mass(), dashpot, classical.stiffness());
    std::vector<SlidingStructure> structures;
    for (const Structure& structure : {classical, other})
      for (const double level : {0.2, 0.5, 1.0, 3.0}) {
        const Coulomb law(level, 1.3 * level);
        Mounting springs;
        springs.natural_frequency = 2;
        springs.damping = 0.1;
        Mounting stops;
        stops.stops = Stops(0.02, 0.03, 0.3);
        structures.push_back(IsolatedStructure(Slider(law), structure, 1));
        structures.push_back(IsolatedStructure(Slider(law, springs), structure, 1));
        structures.push_back(IsolatedStructure(Slider(law, stops), structure, 1));
        structures.push_back(IsolatedStructure(Slider(StaticKinetic(law, 1.5 * level, 1.5 * level)), structure, 1));
        structures.push_back(EquipmentOnFloor(Slider(law), structure, 3));
        structures.push_back(EquipmentOnFloor(Slider(law, springs), structure, 2, 0.3));
      }
    // Rebounds between two stops under a ringing structure lose digits: STRUCTURES, traps.
    check_equal(structures, motions, false, 1e-9);
  }
}

TEST_CASE("a sweep of structures has the same bits for any threads, and other groups", "[structure][sweep]") {
  Bits bits(4);
  const std::vector<GroundMotion> motions{random_motion(bits), random_motion(bits)};
  std::vector<FlexibleSlope> slopes;
  for (const double height : {20.0, 50.0})
    for (int k = 0; k < 80; ++k)
      slopes.push_back({.ky_g = 0.005 * k, .height = height, .shear_velocity = 300, .damping_ratio = 0.1});
  SweepOptions options;
  options.threads = 1;
  const SweepTable one = sweep(slopes, motions, options);
  options.threads = 3;
  const SweepTable three = sweep(slopes, motions, options);
  CHECK(one.peak == three.peak);
  CHECK(one.events == three.events);
  const SweepTable alone = sweep(std::vector{slopes[90]}, motions);
  CHECK(alone.peak[0] == one.peak[one.at(90, 0, 0)]);
  // More levels slide less.
  for (std::size_t k = 1; k < 80; ++k) CHECK(one.peak[one.at(k, 0, 0)] <= one.peak[one.at(k - 1, 0, 0)]);
}

TEST_CASE("a combination that fails does not end a sweep of structures", "[structure][sweep][long]") {
  const GroundMotion quake({0, 3, -3, 0, 2, 0}, 0.2);
  // Undamped and not slowed by the sliding, it makes the block slide again at any time.
  std::vector<FlexibleSlope> slopes;
  for (const double ky : {0.005, 10.0})
    slopes.push_back({.ky_g = ky, .height = 50, .shear_velocity = 300, .method = SlopeMethod::decoupled});
  SweepOptions options;
  options.settle = true;
  options.polarity = Polarity::recorded;
  const SweepTable table = sweep(slopes, {GroundMotion(quake)}, options);
  REQUIRE(table.failures.size() == 1);
  CHECK(table.failures[0].slider == 0);
  CHECK_THAT(table.failures[0].message, ContainsSubstring("does not come to rest within 1000000 steps"));
  CHECK(std::isnan(table.peak[0]));
  CHECK(table.peak[1] <= 0);

  CHECK_THROWS_WITH(sweep(std::vector<FlexibleSlope>{{.ky_g = 0.1, .height = -1}}, {GroundMotion(quake)}),
                    ContainsSubstring("height must be positive and finite, got -1 m"));
  CHECK_THROWS_WITH(sweep(std::vector<FlexibleSlope>{}, {GroundMotion(quake)}), ContainsSubstring("empty list"));
}

TEST_CASE("floor motions are the accelerations of the floors", "[structure]") {
  Bits bits(5);
  for (const Kind kind : {even, held, uneven}) {
    const GroundMotion quake = random_motion(bits, kind);
    const Structure classical = Structure::shear_building({1, 1, 0.8}, {600, 500, 400}, 0.03);
    RealMatrix dashpot = classical.damping();
    dashpot(0, 0) += 2;
    const Structure other(classical.mass(), dashpot, classical.stiffness());
    const Structure modes = Structure::from_modes({0.6}, {9}, {0.1}, {{1.2}});
    for (const Structure& structure : {classical, other, modes}) {
      const EquipmentOnFloor bolted(Slider(Coulomb(1e6)), structure, 1);
      const RealMatrix expected = integrate(bolted, quake).floors.acceleration;
      const auto floors = floor_motions(structure, quake);
      REQUIRE(floors.size() == static_cast<std::size_t>(structure.floors()));
      for (const int parts : {1, 3}) {
        const auto these = floor_motions(structure, quake, parts);
        for (std::size_t k = 0; k < floors.size(); ++k) {
          REQUIRE(these[k].samples() == (quake.samples() - 1) * static_cast<std::size_t>(parts) + 1);
          double most = 0;
          // Where values are held, a floor that hears the ground at once jumps at the samples.
          const bool jumps = kind == held && !structure.has_matrices();
          for (std::size_t i = 0; !jumps && i < quake.samples(); ++i)
            most = std::max(most, std::abs(these[k].acceleration()[i * static_cast<std::size_t>(parts)] -
                                           expected(static_cast<std::ptrdiff_t>(i), static_cast<std::ptrdiff_t>(k))));
          CHECK(most <= 1e-12 * detail::view(expected).cwiseAbs().maxCoeff());
        }
      }
      CHECK(floors[0].name() == "floor 1");
    }
  }
  const GroundMotion quake = random_motion(bits);
  const Structure bare = Structure::from_modes({0.6}, {9}, {0.1});
  CHECK_THROWS_WITH(floor_motions(bare, quake), ContainsSubstring("give from_modes the shapes"));
  const Structure one = Structure::shear_building({1}, {100}, 0.05);
  CHECK_THROWS_WITH(floor_motions(one, quake, 0), ContainsSubstring("parts must be at least 1, got 0"));
}

TEST_CASE("sliders on floor motions approach equipment without mass", "[structure]") {
  Bits bits(6);
  const GroundMotion quake = random_motion(bits);
  const Structure building = Structure::shear_building({1, 1, 0.8}, {600, 500, 400}, 0.03);
  const double exact = integrate(EquipmentOnFloor(Slider(Coulomb(1)), building, 3), quake).peak;
  double last = never;
  for (const int parts : {1, 4, 16}) {
    const double error =
        std::abs(sweep(std::vector{Coulomb(1)}, floor_motions(building, quake, parts)).peak[4] / exact - 1);
    CHECK(error < last / 4);  // of second order: a sixteenth
    last = error;
  }
  CHECK(last < 1e-3);
}

TEST_CASE("a structure that is too fast for the time step fails alone in a sweep", "[structure][sweep]") {
  Bits bits(7);
  const std::vector<GroundMotion> motions{random_motion(bits)};
  const Structure building = Structure::shear_building({1, 1, 0.8}, {600, 500, 400}, 0.03);
  Mounting extreme;
  extreme.natural_frequency = 1e9;
  // They share the stuck motion, whichever comes first.
  const std::vector<IsolatedStructure> structures{{Slider(Coulomb(1), extreme), building, 1},
                                                  {Slider(Coulomb(1)), building, 1}};
  const SweepTable table = sweep(structures, motions);
  REQUIRE(table.failures.size() == 2);
  CHECK(table.failures[0].slider == 0);
  CHECK_THAT(table.failures[0].message, ContainsSubstring("too fast for the time step"));
  CHECK(table.peak[table.at(1, 0, 0)] == Approx(integrate(structures[1], motions[0]).peak).epsilon(1e-12));

  const std::vector<FlexibleSlope> slopes{{.ky_g = 0.1, .height = 1e-6, .shear_velocity = 600},
                                          {.ky_g = 0.1, .height = 50, .shear_velocity = 600}};
  const SweepTable both = sweep(slopes, motions);
  REQUIRE(both.failures.size() == 2);
  CHECK(both.failures[0].slider == 0);
}
