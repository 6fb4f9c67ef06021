// Structures on bearings with several surfaces: limits, balances, and an integration in small steps.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "stickslip/core.hpp"
#include "stickslip/ensemble/run.hpp"
#include "stickslip/friction/multi_pendulum.hpp"
#include "stickslip/structure/equipment_on_floor.hpp"
#include "stickslip/structure/identity.hpp"
#include "stickslip/structure/isolated_structure.hpp"
#include "stickslip/structure/sweep.hpp"
#include "support/catch.hpp"
#include "support/motions.hpp"

using namespace stickslip;
using namespace test;

namespace {

MultiPendulum triple() { return MultiPendulum({0.4, 2, 2}, {0.01, 0.04, 0.08}, {0.06, 0.2, 0.2}, 0.5, true); }
MultiPendulum with_flat() { return MultiPendulum({1.5, infinity}, {0.03, 0.06}, {0.15, 0.1}, 0.3); }

GroundMotion shaking(double scale = 1, bool vertical = false) {
  std::vector<double> n, up;
  for (int m = 0; m <= 300; ++m) {
    n.push_back(scale * (3 * std::sin(0.14 * m) + 2 * std::cos(0.38 * m + 0.4)));
    up.push_back(5 * std::cos(0.1 * m + 0.2));
  }
  const GroundMotion motion(n, 0.02);
  return vertical ? motion.with_components({}, up) : motion;
}

Structure building() { return Structure::shear_building({1, 1, 0.8}, {600, 500, 400}, Rayleigh{0.1, 0.002}); }
Structure without_mass() { return Structure::from_modes({1e-13}, {15}, {0.05}); }

}  // namespace

TEST_CASE("a structure without mass moves its bearing as the slider alone", "[structure][pendulum]") {
  for (const bool vertical : {false, true})
    for (const MultiPendulum& law : {triple(), with_flat()})
      for (const double scale : {1.0, 2.0}) {
        const Slider<MultiPendulum> slider(law, Mounting{.damping = 0.1});
        const GroundMotion motion = shaking(scale, vertical);
        const Response plain = integrate(slider, motion, {.settle = true, .contact = Contact::clipped});
        const StructureResponse r =
            integrate(IsolatedStructure(slider, without_mass()), motion, StructureIntegrateOptions::settled());
        const std::size_t common = std::min(r.displacement.size(), plain.displacement.size());
        for (std::size_t i = 0; i < common; ++i)
          CHECK(std::abs(r.displacement[i] - plain.displacement[i]) <= 1e-10 * plain.peak);
        CHECK(r.peak == Approx(plain.peak).epsilon(1e-10));
        CHECK(std::abs(r.residual - plain.residual) <= 1e-9 * plain.peak);
        CHECK(r.energy.dissipated == Approx(plain.energy.dissipated).epsilon(1e-9));
        CHECK(r.energy.elastic == Approx(plain.energy.elastic).epsilon(1e-8));
        CHECK(r.energy.impact == Approx(plain.energy.impact).epsilon(1e-9).margin(1e-12));
        CHECK(impacts(r.events) == impacts(r.events));
        CHECK(impacts(r.events).forward.count == impacts(plain.events).forward.count);
      }
}

TEST_CASE("the energy of a building on a bearing with several surfaces is balanced", "[structure][pendulum]") {
  for (const bool vertical : {false, true})
    for (const MultiPendulum& law : {triple(), with_flat()}) {
      const Slider<MultiPendulum> slider(law);
      for (const SlidingStructure& system :
           {static_cast<const SlidingStructure&>(IsolatedStructure(slider, building(), 1)),
            static_cast<const SlidingStructure&>(EquipmentOnFloor(slider, building(), 3, 0.3)),
            static_cast<const SlidingStructure&>(EquipmentOnFloor(slider, building(), 3))}) {
        const GroundMotion motion = shaking(1.5, vertical);
        const StructureResponse r = integrate(system, motion), m = integrate(system, motion.scaled(-1));
        CHECK(r.time_sliding > 1);
        CHECK(std::abs(r.energy.imbalance()) <= 1e-11 * r.energy.dissipated);
        CHECK(std::abs(m.residual + r.residual) <= 1e-11 * r.peak);
        // In two parts: the state carries where the elements are.
        StructureState state = system.rest();
        const detail::LoadPieces pieces(motion, 0);
        for (std::size_t i = 0; i < motion.segments(); ++i) advance(system, pieces.segment(i), state);
        CHECK(std::abs(state.displacement - r.residual) <= 1e-11 * r.peak);
        const PendulumMemory &one = state.pendulum, &other = r.final_state.pendulum;
        CHECK(one.moving == other.moving);
        for (std::size_t k = 0; k < one.place.size(); ++k)
          CHECK(std::abs(one.place[k] - other.place[k]) <= 1e-11 * r.peak);
      }
    }
}

TEST_CASE("sweeps and ensembles of buildings on bearings equal integrate", "[structure][pendulum]") {
  std::vector<IsolatedStructure> systems;
  for (const MultiPendulum& law : {triple(), with_flat()}) systems.emplace_back(Slider(law), building(), 1);
  for (const bool settle : {false, true}) {
    const std::vector<GroundMotion> motions{shaking(0.3), shaking(1), shaking(1.5, true)};
    SweepOptions options;
    options.settle = settle;
    const SweepTable table = sweep(systems, motions, options);
    CHECK(table.failures.empty());
    for (std::size_t s = 0; s < systems.size(); ++s)
      for (std::size_t r = 0; r < motions.size(); ++r)
        for (const std::size_t p : {0, 1}) {
          StructureIntegrateOptions how;
          how.settle = settle;
          const StructureResponse one = integrate(systems[s], p == 0 ? motions[r] : motions[r].scaled(-1), how);
          const std::size_t i = table.at(s, r, p);
          CHECK(std::abs(table.peak[i] - one.peak) <= 1e-10 * one.peak);
          CHECK(std::abs(table.residual[i] - one.residual) <= 1e-10 * one.peak);
        }
  }
}

// Steps of 2e-6 s without events: the force of the bearing along its path is that of `trace`, which imposes displacements.
TEST_CASE("a mode on a triple pendulum is that of small steps", "[structure][pendulum][long]") {
  const double fraction = 0.7, w = 15, z = 0.05, h = 2e-6;
  const MultiPendulum law = triple();
  const GroundMotion motion = shaking(1);
  const StructureResponse exact =
      integrate(IsolatedStructure(Slider(law), Structure::from_modes({fraction}, {w}, {z}, {{1}})), motion);
  double x = 0, v = 0, y = 0, rate = 0, peak = 0, furthest = 0;
  State bearing;
  for (std::size_t i = 0; i < motion.segments(); ++i) {
    const Segment s = motion.segment(i);
    const auto steps = static_cast<int>(std::lround(s.duration / h));
    for (int k = 0; k < steps; ++k) {
      const double n = s.start + (s.end - s.start) * (k + 0.5) / steps;
      const double force = 2 * z * w * rate + w * w * y, demand = fraction * force - (1 - fraction) * n;
      // At rest the springs of the elements may push against the demand.
      const auto level = [&](Direction d) { return standard_gravity * sign(d) * law.force(bearing.pendulum, d); };
      Mode wants = v > 0 ? Mode::forward : v < 0 ? Mode::backward : Mode::stuck;
      if (v == 0 && demand > level(Direction::forward)) wants = Mode::forward;
      if (v == 0 && -demand > level(Direction::backward)) wants = Mode::backward;
      double a = 0;
      if (wants != Mode::stuck) {
        const Direction direction = direction_of(wants);
        a = (demand - sign(direction) * level(direction)) / (1 - fraction);
        bearing.mode = wants;
      }
      double next = v + h * a;
      if (v != 0 && v * next <= 0) next = 0, a = -v / h;
      const double way = std::abs(h * next);
      if (way > 0) law.slide(bearing, way);
      x += h * next;
      v = next;
      rate += h * (-force - a - n);
      y += h * rate;
      peak = std::max(peak, std::abs(x));
    }
    furthest = std::max(furthest, std::abs(x - exact.displacement[i + 1]));
  }
  CHECK(peak == Approx(exact.peak).epsilon(1e-3));
  CHECK(furthest <= 2e-3 * exact.peak);
}
