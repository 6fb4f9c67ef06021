// Structures that slide on a surface heated by friction: limits, balances, and an independent integration.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <vector>

#include "stickslip/core.hpp"
#include "stickslip/ensemble/run.hpp"
#include "stickslip/friction/kumar.hpp"
#include "stickslip/friction/velocity_dependent.hpp"
#include "stickslip/structure/equipment_on_floor.hpp"
#include "stickslip/structure/identity.hpp"
#include "stickslip/structure/isolated_structure.hpp"
#include "stickslip/structure/sweep.hpp"
#include "support/catch.hpp"
#include "support/heated_surface.hpp"
#include "support/motions.hpp"

using namespace stickslip;
using namespace test;

namespace {

using Parameters = KumarFriction::Parameters;

const Parameters usual{.mu_ref = 0.06, .static_pressure = 50e6, .reference_pressure = 50e6, .contact_radius = 0.2};

KumarFriction with_radius(double radius) {
  Parameters p = usual;
  p.contact_radius = radius;
  return KumarFriction(p);
}

GroundMotion shaking(bool vertical = false, int samples = 600) {
  std::vector<double> n, up;
  for (int m = 0; m <= samples; ++m) {
    n.push_back(3 * std::sin(0.07 * m) + 2 * std::cos(0.19 * m + 0.4));
    up.push_back(5 * std::cos(0.05 * m + 0.2));
  }
  const GroundMotion motion(n, 0.01);
  return vertical ? motion.with_components({}, up) : motion;
}

Structure building() { return Structure::shear_building({1, 1, 0.8}, {600, 500, 400}, Rayleigh{0.1, 0.002}); }
Structure without_mass() { return Structure::from_modes({1e-13}, {15}, {0.05}); }

double furthest(const std::vector<double>& a, const std::vector<double>& b) {
  REQUIRE(a.size() == b.size());
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, std::abs(a[i] - b[i]));
  return most;
}

std::vector<Mounting> mountings() {
  return {{},
          {.natural_frequency = 2, .damping = 0.2},
          {.natural_frequency = std::sqrt(standard_gravity / 2.2), .pendulum = true},
          {.natural_frequency = 1.5, .stops = Stops(0.03, 0.6)},
          {.one_way = true}};
}

/// One mode of a structure whose base slides with a speed at first, until it stops, by Heun's rule with even steps; the
/// heat is straight between steps, and its half-integral exact for that.
/// @return x, y, T
std::array<double, 3> independent_slip(const Parameters& p, double fraction, double w, double z, double v, double h) {
  const double edge = p.contact_radius * std::sqrt(std::numbers::pi / 4);
  std::vector<double> q;
  const auto mu = [&](double speed, double t) { return coefficient(p, std::max(speed, 0.0), t); };
  struct State {
    double x, v, y, rate;
  };
  const auto slope = [&](const State& s, double t) -> State {
    const double force = 2 * z * w * s.rate + w * w * s.y;
    const double a = (fraction * force - standard_gravity * mu(s.v, t)) / (1 - fraction);
    return {s.v, a, s.rate, -force - a};
  };
  const auto step = [&](const State& s, const State& by, double time) -> State {
    return {s.x + time * by.x, s.v + time * by.v, s.y + time * by.y, s.rate + time * by.rate};
  };
  const auto heat = [&](const State& s, double t) {
    return std::abs(s.x) < edge ? mu(s.v, t) * p.static_pressure * std::max(s.v, 0.0) : 0;
  };
  State now{0, v, 0, 0};
  double t = p.temperature;
  q.push_back(heat(now, t));
  for (;;) {
    const State begins = slope(now, t);
    State next = step(now, begins, h);
    double then = t;
    q.push_back(0);
    for (int sweep = 0; sweep < 4; ++sweep) {
      q.back() = heat(next, then);
      then = celsius(p, q, h);
      const State ends = slope(next, then);
      next = step(
          now,
          {(begins.x + ends.x) / 2, (begins.v + ends.v) / 2, (begins.y + ends.y) / 2, (begins.rate + ends.rate) / 2},
          h);
    }
    if (next.v <= 0) {
      const double part = now.v / (now.v - next.v);
      return {now.x + part * h * now.v / 2, now.y + part * (next.y - now.y), t + part * (then - t)};
    }
    now = next;
    t = then;
  }
}

}  // namespace

TEST_CASE("a structure without mass heats its surface as the slider alone", "[structure][kumar]") {
  // Both are accurate to 1e-7 of their scale; the temperature rises by some hundred degrees.
  for (const bool vertical : {false, true})
    for (const double radius : {0.2, 0.03, infinity})
      for (const Mounting& mounting : mountings()) {
        const Slider<KumarFriction> slider(with_radius(radius), mounting);
        const GroundMotion motion = shaking(vertical);
        const SurfaceHeat warm = SurfaceHeat::with(slider.law().half_integral_at(60));
        const Response plain = integrate(slider, motion, {.settle = true, .contact = Contact::clipped, .heat = warm});
        StructureIntegrateOptions options = StructureIntegrateOptions::settled();
        options.heat = warm;
        const StructureResponse r = integrate(IsolatedStructure(slider, without_mass()), motion, options);
        REQUIRE(r.temperature.size() == r.displacement.size());
        CHECK(r.temperature[0] == Approx(60).epsilon(1e-12));
        const std::size_t common = std::min(r.displacement.size(), plain.displacement.size());
        for (std::size_t i = 0; i < common; i += 3) {
          CHECK(std::abs(r.displacement[i] - plain.displacement[i]) <= 1e-6 * plain.peak);
          CHECK(std::abs(r.temperature[i] - plain.temperature[i]) <= 1e-4);
        }
        CHECK(std::abs(r.residual - plain.residual) <= 1e-6 * plain.peak);
        CHECK(r.energy.dissipated == Approx(plain.energy.dissipated).epsilon(1e-6));
        // The heat counts: what the test would miss otherwise.
        if (radius > 0.1 && !mounting.stops)
          CHECK(std::abs(integrate(IsolatedStructure(slider, without_mass()), motion).peak - r.peak) > 1e-3 * r.peak);
      }
}

TEST_CASE("on a surface that stays cold a structure has friction that depends on the speed", "[structure][kumar]") {
  Parameters p = usual;
  p.conductivity = infinity;
  p.temperature = 35;
  const double fast = standard_gravity * 0.06 * 0.79 * (std::pow(0.7, 0.7) + 0.4);
  for (const Mounting& mounting : mountings()) {
    const Slider<KumarFriction> one(KumarFriction(p), mounting);
    const Slider<VelocityDependent> other(VelocityDependent(fast / 2, fast, 100), mounting);
    const auto check = [&](const SlidingStructure& heated, const SlidingStructure& cold) {
      const StructureResponse a = integrate(heated, shaking()), b = integrate(cold, shaking());
      CHECK(furthest(a.displacement, b.displacement) <= 1e-10 * b.peak);
      CHECK(a.events.size() == b.events.size());
      CHECK(furthest(a.floors.peak_acceleration, b.floors.peak_acceleration) <= 1e-8);
      CHECK(*std::ranges::max_element(a.temperature) == 35);
    };
    check(IsolatedStructure(one, building(), 1), IsolatedStructure(other, building(), 1));
    check(EquipmentOnFloor(one, building(), 3, 0.3), EquipmentOnFloor(other, building(), 3, 0.3));
    check(EquipmentOnFloor(one, building(), 3), EquipmentOnFloor(other, building(), 3));
  }
}

TEST_CASE("a slip of a structure under heating is that of an independent integration", "[structure][kumar][long]") {
  const double fraction = 0.6, w = 12, z = 0.04;
  const Structure one = Structure::from_modes({fraction}, {w}, {z}, {{1}});
  for (const double radius : {infinity, 0.3}) {
    Parameters p = usual;
    p.contact_radius = radius;
    const IsolatedStructure system(Slider<KumarFriction>(KumarFriction(p)), one);
    StructureState state = system.rest();
    state.velocity = 1;
    state.mode = Mode::forward;
    // To just after the first stop.
    double stop = 0, y = 0;
    StructureIntegrateOptions options;
    options.velocity = 1;
    const StructureResponse r = integrate(system, GroundMotion(std::vector<double>(2001, 0.0), 0.002), options);
    for (const Event& event : r.events)
      if (stop <= 0 && (event.kind == EventKind::arrest || event.kind == EventKind::reversal)) stop = event.time;
    REQUIRE(stop > 0);
    advance(system, Segment{stop, 0, 0}, state);
    y = state.modal_displacement[0] / std::sqrt(fraction);
    const double celsius = KumarFriction(p).temperature(State{.heat = state.heat});
    double before = 0;
    for (const double h : {2e-3, 1e-3, 5e-4}) {
      const auto [x, other_y, other_celsius] = independent_slip(p, fraction, w, z, 1, h);
      const double error = std::abs(x - state.displacement) + std::abs(other_y - y);
      UNSCOPED_INFO(h << ": " << x - state.displacement << ", " << other_y - y << ", " << other_celsius - celsius);
      // Of second order but for the start, where the temperature is a root of time; of first where heat jumps.
      if (before > 0 && radius > 1) CHECK(before / error >= 2.2);
      if (h < 6e-4) {
        CHECK(error <= (radius > 1 ? 1e-5 : 5e-4));
        CHECK(std::abs(other_celsius - celsius) <= (radius > 1 ? 2e-4 : 0.05));
      }
      before = error;
    }
  }
}

TEST_CASE("balance, mirror image and pieces of the motion of a structure on a heated surface", "[structure][kumar]") {
  for (const bool vertical : {false, true})
    for (const double radius : {0.2, 0.03})
      for (const Mounting& mounting : mountings()) {
        const Slider<KumarFriction> slider(with_radius(radius), mounting);
        const GroundMotion motion = shaking(vertical);
        for (const SlidingStructure& system : {SlidingStructure(IsolatedStructure(slider, building(), 1)),
                                               SlidingStructure(EquipmentOnFloor(slider, building(), 3, 0.3)),
                                               SlidingStructure(EquipmentOnFloor(slider, building(), 3))}) {
          const StructureResponse r = integrate(system, motion);
          CHECK(r.time_sliding > 0);
          CHECK(std::abs(r.energy.imbalance()) <= 1e-12 * (std::abs(r.energy.input) + r.energy.dissipated));
          if (!mounting.one_way) {
            const StructureResponse mirrored = integrate(system, motion.scaled(-1));
            CHECK(mirrored.residual == -r.residual);
            CHECK(mirrored.temperature == r.temperature);
          }
          // In a user's own loop steps may differ, to the accuracy of the law.
          StructureState state = system.rest();
          const detail::LoadPieces pieces(motion, 0);
          for (std::size_t i = 0; i < motion.segments(); ++i) advance(system, pieces.segment(i), state);
          CHECK(std::abs(state.displacement - r.residual) <= 1e-7 * r.peak);
          CHECK(std::abs(slider.law().temperature(State{.heat = state.heat}) - r.temperature.back()) <= 1e-4);
        }
      }
}

TEST_CASE("sweeps and ensembles of structures on a heated surface equal single integrations",
          "[structure][kumar][sweep]") {
  std::vector<IsolatedStructure> systems;
  for (const double radius : {0.2, 0.03})
    for (const Mounting& mounting : mountings())
      systems.emplace_back(Slider(with_radius(radius), mounting), building(), 1);
  // Weak at times, so that there is something to pass while the surface cools.
  std::vector<double> n, up;
  for (int m = 0; m <= 800; ++m) {
    n.push_back((m / 100 % 2 == 0 ? 1 : 0.05) * (2 * std::sin(0.07 * m) + 3 * std::cos(0.19 * m + 0.4)));
    up.push_back(4 * std::cos(0.05 * m + 0.2));
  }
  const GroundMotion level(n, 0.01);
  const std::vector<GroundMotion> motions{level, level.with_components({}, up)};
  SweepOptions options;
  options.settle = true;
  const SweepTable table = sweep(systems, motions, options);
  CHECK(table.failures.empty());
  for (std::size_t s = 0; s < systems.size(); ++s)
    for (std::size_t m = 0; m < motions.size(); ++m) {
      const StructureResponse r = integrate(systems[s], motions[m], StructureIntegrateOptions::settled());
      const std::size_t i = table.at(s, m, 0);
      CHECK(std::abs(table.peak[i] - r.peak) <= 1e-7 * r.peak);
      CHECK(std::abs(table.residual[i] - r.residual) <= 1e-7 * r.peak);
    }
  const GaussianExcitation noise(Spectrum::kanai_tajimi(0.01, 12, 0.6), 0.01, 801);
  EnsembleOptions four;
  four.members = 4;
  four.seed = 7;
  const Ensemble e = run_ensemble(systems[0], noise, four);
  for (std::size_t i = 0; i < 4; ++i) {
    const StructureResponse r = integrate(systems[0], noise.sample(7, i));
    CHECK(std::abs(e.peak()[i] - r.peak) <= 1e-7 * r.peak);
    CHECK(e.peak_floor_acceleration().on_floor(1)[i] == Approx(r.floors.peak_acceleration[0]).epsilon(1e-6));
  }
}
