// States of structures at any time, loops and the largest force of their interfaces.
#include "stickslip/structure/trajectory.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "stickslip/core.hpp"
#include "stickslip/friction/multi_pendulum.hpp"
#include "stickslip/friction/velocity_dependent.hpp"
#include "stickslip/structure/equipment_on_floor.hpp"
#include "stickslip/structure/flexible_slope.hpp"
#include "stickslip/structure/isolated_structure.hpp"
#include "support/catch.hpp"
#include "support/motions.hpp"

using namespace stickslip;
using namespace test;
using Catch::Matchers::ContainsSubstring;

namespace {

/// Record A, or its first part, with `parts` straight lines in place of one.
GroundMotion divided(int parts, std::size_t segments = 400) {
  const std::vector<double> coarse = record_a_samples();
  std::vector<double> n;
  for (std::size_t k = 0; k < segments; ++k)
    for (int i = 0; i < parts; ++i) n.push_back(std::lerp(coarse[k], coarse[k + 1], i / static_cast<double>(parts)));
  n.push_back(coarse[segments]);
  return {n, 0.1 / parts};
}

Structure building() { return Structure::shear_building({1, 1, 0.8}, {600, 500, 400}, Rayleigh{0.1, 0.002}); }

const Mounting spring{.natural_frequency = 2, .damping = 0.3};

const Slider bearing(MultiPendulum({2, 1}, {0.05, 0.1}, {0.5, 0.5}));

/// Systems of each kind, with friction of each form.
std::vector<SlidingStructure> systems() {
  return {IsolatedStructure(Slider(Coulomb(1), spring), building(), 1),
          IsolatedStructure(Slider(VelocityDependent(0.6, 1.2, 5), spring), building(), 1),
          IsolatedStructure(bearing, building(), 1), EquipmentOnFloor(Slider(Coulomb(1), spring), building(), 2, 0.3),
          EquipmentOnFloor(Slider(Coulomb(1), spring), building(), 2)};
}

Loop loop_of(const SlidingStructure& system, const GroundMotion& motion,
             const StructureIntegrateOptions& options = {}) {
  return largest_loop(system, motion, integrate(system, motion, options));
}

}  // namespace

TEST_CASE("states at any time are those of a motion with more samples", "[structure]") {
  const int parts = 8;
  const GroundMotion coarse = divided(1, 60), fine = divided(parts, 60);
  std::vector<double> times;
  for (std::size_t i = 0; i < fine.samples(); ++i) times.push_back(fine.time(fine.samples() - 1 - i));
  for (const SlidingStructure& system : systems()) {
    const StructureResponse few = integrate(system, coarse), many = integrate(system, fine);
    REQUIRE(few.peak > 0.01);
    const std::vector<StructureState> states = states_at(system, coarse, few, times);
    double apart = 0;
    for (std::size_t i = 0; i < times.size(); ++i) {
      const StructureState& state = states[times.size() - 1 - i];
      apart = std::max(
          {apart, std::abs(state.displacement - many.displacement[i]), std::abs(state.velocity - many.velocity[i])});
      for (std::size_t k = 0; k < state.modal_displacement.size(); ++k) {
        const auto row = static_cast<std::ptrdiff_t>(i), column = static_cast<std::ptrdiff_t>(k);
        apart = std::max({apart, std::abs(state.modal_displacement[k] - many.modal_displacement(row, column)),
                          std::abs(state.modal_velocity[k] - many.modal_velocity(row, column))});
      }
    }
    CAPTURE(apart);
    CHECK(apart < 1e-11);
  }
}

TEST_CASE("states are also known while a structure settles, from its start", "[structure]") {
  const IsolatedStructure system(Slider(Coulomb(1), spring), building(), 1);
  StructureIntegrateOptions options = StructureIntegrateOptions::settled();
  options.displacement = 0.1;
  options.velocity = 2;
  const GroundMotion motion = divided(1, 20);
  const StructureResponse r = integrate(system, motion, options);
  REQUIRE(r.displacement.size() > motion.samples());
  std::vector<double> times;
  for (std::size_t i = 0; i < r.displacement.size(); ++i) times.push_back(motion.time(i));
  const std::vector<StructureState> states = states_at(system, motion, r, times);
  for (std::size_t i = 0; i < times.size(); ++i) {
    CHECK(std::abs(states[i].displacement - r.displacement[i]) < 1e-14);
    CHECK(std::abs(states[i].velocity - r.velocity[i]) < 1e-13);
  }
  CHECK(states.front().displacement == 0.1);
  const double late[] = {times.back() + 1};
  CHECK_THROWS_WITH(states_at(system, motion, r, late), ContainsSubstring("the end of the response"));
  CHECK(states_at(system, motion, r, std::span<const double>()).empty());
}

TEST_CASE("a structure without mass, or one that is stiff, has the loop and the largest force of the slider",
          "[structure]") {
  const auto check = [](const AnySlider& slider, bool stiff = false) {
    const Response plain = integrate(slider, record_a());
    const Loop expected = largest_loop(slider, record_a(), plain);
    const double force = peak_force(slider, record_a(), plain).force;
    const auto errors = [&](double fraction, double frequency, double tolerance) {
      const IsolatedStructure system(slider, Structure::from_modes({fraction}, {frequency}, {0.05}));
      const StructureResponse r = integrate(system, record_a());
      const Loop found = largest_loop(system, record_a(), r);
      CHECK(found.period() == Approx(expected.period()).epsilon(tolerance));
      CHECK(found.damping() == Approx(expected.damping()).epsilon(tolerance));
      CHECK(std::abs(peak_force(system, record_a(), r).force) == Approx(force).epsilon(tolerance));
    };
    errors(1e-12, 8, 1e-10);
    // As the period of the structure: D by up to 3.2e-3 at 1000 rad/s, by 3e-4 at 10000.
    if (stiff) errors(0.5, 1000, 3e-3);
  };
  for (const double damping : {0.0, 0.3}) {
    const Mounting on{.natural_frequency = 2, .damping = damping};
    check(Slider(Coulomb(1), on), damping > 0);
    check(Slider(Coulomb(0.8, 1.3), on), !(damping > 0));
    check(Slider(VelocityDependent(0.6, 1.2, 5), on));
  }
  check(bearing);
}

TEST_CASE("a loop has the energy that the interface takes up to the peak", "[structure]") {
  // Without ground motion, and dampers in the structure, that is what is missing at the peak.
  const Structure undamped = Structure::shear_building({1, 1, 0.8}, {600, 500, 400}, Rayleigh{});
  StructureIntegrateOptions push;
  push.velocity = 2;
  const auto check = [&](const AnySlider& slider) {
    const IsolatedStructure system(slider, undamped, 1);
    const StructureResponse r = integrate(system, line(0, 0, 3), push);
    const Loop loop = largest_loop(system, line(0, 0, 3), r);
    CHECK(loop.displacement == r.peak);
    const auto is_peak = [&](const Event& e) { return std::abs(e.displacement) == r.peak; };
    const double time = std::ranges::find_if(r.events, is_peak)->time;
    const StructureResponse half = integrate(system, line(0, 0, time), push);
    CHECK(half.sliding_distance == Approx(r.peak).epsilon(1e-12));
    CHECK(loop.area == Approx(4 * (half.energy.dissipated + half.energy.damped)).epsilon(1e-11));
  };
  check(Slider(Coulomb(1), {.natural_frequency = 2}));
  check(Slider(Coulomb(1), spring));
  check(Slider(VelocityDependent(0.6, 1.2, 5), spring));
  check(bearing);
}

TEST_CASE("the loop and the largest force are those of many samples", "[structure]") {
  const GroundMotion fine = divided(64, 100), coarse = divided(1, 100);
  for (const SlidingStructure& system : systems()) {
    const StructureResponse many = integrate(system, fine), few = integrate(system, coarse);
    const InterfacePoint peak = peak_force(system, coarse, few);
    double largest = 0;
    for (const double force : many.interface_force) largest = std::max(largest, std::abs(force));
    CHECK(std::abs(peak.force) >= largest * (1 - 1e-11));
    CHECK(std::abs(peak.force) <= largest * 1.01);  // between samples 1.6 ms apart
    const double at[] = {peak.time};
    CHECK(states_at(system, coarse, few, at)[0].displacement == Approx(peak.displacement).epsilon(1e-9));

    const Loop loop = largest_loop(system, coarse, few), same = loop_of(system, fine);
    CHECK(loop.force == Approx(same.force).epsilon(1e-9));
    CHECK(loop.area == Approx(same.area).epsilon(1e-9));
    // The points of the loops include the force on arrival, and jumps to the other side of friction.
    double nearest = 1;
    for (const InterfacePoint& point : interface_loops(system, coarse, few))
      nearest = std::min(nearest, std::abs(std::abs(point.displacement) - loop.displacement) +
                                      std::abs(std::abs(point.force) - loop.force));
    CHECK(nearest < 1e-9);
  }
}

TEST_CASE("vertical motion weighs the loop of a structure as that of a slider", "[structure]") {
  const std::vector<double> up(record_a().samples(), 3.0);
  const GroundMotion heavy = record_a().with_components({}, up);
  for (const bool pendulum : {false, true}) {
    const Slider slider(Coulomb(0.5), {.natural_frequency = 2, .pendulum = pendulum});
    const IsolatedStructure system(slider, Structure::from_modes({1e-12}, {8}, {0.05}));
    const Response plain = integrate(slider, heavy);
    const Loop expected = largest_loop(slider, heavy, plain), found = loop_of(system, heavy);
    CHECK(found.period() == Approx(expected.period()).epsilon(1e-10));
    CHECK(found.damping() == Approx(expected.damping()).epsilon(1e-10));
  }
}

TEST_CASE("a structure without a loop is refused with the reason", "[structure]") {
  const GroundMotion still = line(0, 0, 0.1);
  const auto on = [](const AnySlider& slider) { return IsolatedStructure(slider, building(), 1); };
  CHECK_THROWS_WITH(loop_of(on(Slider(Coulomb(1))), record_a()), ContainsSubstring("on a spring"));
  CHECK_THROWS_WITH(loop_of(on(Slider(Coulomb(1), 2)), still), ContainsSubstring("never slips"));
  StructureIntegrateOptions aside;
  aside.displacement = 1;
  CHECK_THROWS_WITH(loop_of(on(Slider(Coulomb(1), 2)), still, aside), ContainsSubstring("at the start"));
  const FlexibleSlope slope{.ky_g = 0.05, .height = 20, .shear_velocity = 200, .damping_ratio = 0.1};
  CHECK_THROWS_WITH(loop_of(sliding_structure(slope, properties(slope, record_a())), record_a()),
                    ContainsSubstring("on a spring"));
}
