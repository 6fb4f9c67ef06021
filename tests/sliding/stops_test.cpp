// Stops: reference values, infinite bounces, limits, energy.
#include "stickslip/slider/stops.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "stickslip/core.hpp"
#include "support/catch.hpp"
#include "support/motions.hpp"
#include "support/outcome.hpp"
#include "support/reference.hpp"

using namespace stickslip;
using namespace test;

namespace {

Mounting within(const Stops& stops, double natural_frequency = 0, double damping = 0) {
  return {.natural_frequency = natural_frequency, .damping = damping, .stops = stops};
}

int impacts(const Response& r) {
  int result = 0;
  for (const Event& e : r.events) result += e.kind == EventKind::impact;
  return result;
}

/// @param digits  reliable digits of the sixteen: grazing impacts have a square-root singularity
void check(const char* id, const Response& r, double tolerance, bool at_once) {
  INFO(id);
  const auto expected = reference::row("sliders", "others", id);
  if (tolerance == 1e-12) {
    check_outcome(r, expected, at_once);
    CHECK(impacts(r) == expected["impacts"].as<int>());
  } else {
    CHECK(std::abs(r.residual - expected["displacement"]) <= tolerance * expected["peak"]);
    CHECK(std::abs(r.state.velocity - expected["velocity"]) <= tolerance * largest(r.velocity));
    CHECK(std::abs(r.sliding_distance - expected["sliding_distance"]) <= tolerance * expected["sliding_distance"]);
    const auto nodes = expected["nodes"].as<std::vector<std::size_t>>();
    for (std::size_t k = 0; k < nodes.size(); ++k)
      CHECK(std::abs(r.displacement[nodes[k]] - expected["displacements"].list()[k]) <= tolerance * expected["peak"]);
  }
  CHECK(r.peak == expected["peak"]);
  CHECK(std::abs(r.energy.imbalance()) <= 1e-12 * turnover(r.energy));
  CHECK(std::abs(r.energy.dissipated - expected["dissipated"]) <= tolerance * expected["dissipated"]);
}

}  // namespace

TEST_CASE("sliders between stops move as the reference does", "[stops]") {
  check("E.e0", integrate(Slider(Coulomb(0.5), within({0.1, 0})), record_a()), 1e-12, true);
  check("E.e0.9", integrate(Slider(Coulomb(0.5), within({0.1, 0.9})), record_a()), 1e-6, true);
  check("E.e0.8.strong", integrate(Slider(Coulomb(0.5), within({0.05, 0.8})), record_a().scaled(3)), 1e-6, true);
  check("E.e0.6.static", integrate(Slider(StaticKinetic(Coulomb(0.5), 0.8), within({0.1, 0.6})), record_a()), 1e-12,
        true);
}

TEST_CASE("infinitely many bounces end when their sum says", "[stops]") {
  // next_values.json E.zeno: a load of 2 m/s^2 presses a block of level 0.5 m/s^2 on a stop at 0.1 m with e = 0.7.
  const Response r = integrate(Slider(Coulomb(0.5), within({0.1, 0.7})), held(-2, 3));
  CHECK(r.events[1].kind == EventKind::impact);
  CHECK(std::abs(r.events[1].time - 0.3651483716701107423046465) <= 1e-15);
  CHECK(std::abs(r.events[1].velocity - 0.5477225575051661134569698) <= 1e-15);
  const Event& last = r.events[r.events.size() - 2];
  CHECK(last.kind == EventKind::arrest);
  CHECK(std::abs(last.time - 1.132657711007547520926875) <= 1e-14);
  CHECK(r.residual == 0.1);
  CHECK(r.state.mode == Mode::stuck);
  CHECK(std::abs(r.energy.imbalance()) <= 1e-14);
  // Each of them leaves rho times as fast as the one before; also with e = 1, because of friction.
  for (const double e : {0.7, 1.0}) {
    const Response bounces = integrate(Slider(Coulomb(0.5), within({0.1, e})), held(-2, 60));
    const double rho = e * std::sqrt(1.5 / 2.5);
    double before = 0;
    int counted = 0;
    for (const Event& event : bounces.events) {
      if (event.kind != EventKind::impact) continue;
      if (counted++ > 0 && counted < 20) CHECK(std::abs(event.velocity / before - rho) <= 1e-11);
      before = event.velocity;
    }
    CHECK(counted > 20);
    CHECK(bounces.state.mode == Mode::stuck);
  }
}

TEST_CASE("a stop holds any load toward it and none away from it", "[stops]") {
  const Slider slider(Coulomb(0.5), within({0.1, 0}));
  // Pressed on it with ten times the level; then drawn off as soon as the load is beyond the level the other way.
  const Response r = integrate(slider, GroundMotion({-5, -5, 1, 1}, std::vector<double>{0, 2, 3, 4}));
  CHECK(r.displacement[1] == 0.1);
  CHECK(r.velocity[1] == 0);
  const auto leaves = std::ranges::find_if(r.events.begin() + 1, r.events.end(),
                                           [](const Event& e) { return e.kind == EventKind::breakaway; });
  REQUIRE(leaves != r.events.end());
  CHECK(leaves->time == Approx(2 + 5.5 / 6).margin(1e-14));  // n = -5 + 6 (t - 2) passes 0.5
  CHECK(leaves->displacement == 0.1);
}

TEST_CASE("stops on one side, and unequal ones", "[stops]") {
  const GroundMotion motion = record_a();
  const Response one = integrate(Slider(Coulomb(0.5), within({infinity, 0.03, 0.5})), motion);
  CHECK(impacts(one) > 0);
  for (const Event& e : one.events)
    if (e.kind == EventKind::impact) CHECK((e.displacement == -0.03 && e.velocity < 0));
  CHECK(*std::ranges::min_element(one.displacement) >= -0.03);
  // Mirrored: the stops, the law and the motion.
  const Response other = integrate(Slider(Coulomb(0.5), within({0.03, infinity, 0.5})), motion.scaled(-1));
  CHECK(other.residual == -one.residual);
  CHECK(impacts(other) == impacts(one));
}

TEST_CASE("energy closes between stops, whatever else acts", "[stops]") {
  for (const double e : {0.0, 0.3, 1.0})
    for (const double gap : {0.01, 0.05}) {
      CAPTURE(e, gap);
      const auto closes = [&](const auto& slider, const GroundMotion& motion) {
        const Response r = integrate(slider, motion);
        CHECK(std::abs(r.energy.imbalance()) <= 1e-12 * turnover(r.energy));
        CHECK(r.peak <= gap);
        CHECK(impacts(r) > 0);
        if (e == 1) CHECK(std::abs(r.energy.impact) <= 1e-12 * turnover(r.energy));
      };
      const GroundMotion motion = broadband(9, 800);
      closes(Slider(Coulomb(0.3), within({gap, e})), motion);
      closes(Slider(Coulomb(0.3), within({gap, e}, 4)), motion);
      closes(Slider(Coulomb(0.3), within({gap, e}, 4, 0.8)), motion);
      closes(Slider(Caster(0.3, 0.05), within({gap, e})), motion);
      closes(Slider(VelocityDependent(0.2, 0.5, 8), within({gap, e}, 3)), motion);
      std::vector<double> up = gaussian(17, 800, 8);
      up.back() = 0;
      closes(Slider(Coulomb(0.3), within({gap, e})), motion.with_components({}, up));
    }
}

TEST_CASE("a stop acts from the largest displacement inward", "[stops]") {
  // The event loop skips stops in segments within which they cannot be reached.
  for (const double frequency : {0.0, 4.0, 15.0})
    for (const bool vertical : {false, true}) {
      CAPTURE(frequency, vertical);
      GroundMotion motion = broadband(3, 400);
      if (vertical) motion = motion.with_components({}, gaussian(5, 400, 1));
      const Response free = integrate(Slider(Coulomb(0.3), frequency), motion);
      const auto at = [&](double gap) {
        return integrate(Slider(Coulomb(0.3), within({gap, 0.4}, frequency)), motion);
      };
      const Response outside = at(free.peak * (1 + 1e-12));
      CHECK(impacts(outside) == 0);
      CHECK(std::abs(outside.residual - free.residual) <= 1e-12 * free.peak);
      CHECK(std::abs(outside.energy.dissipated - free.energy.dissipated) <= 1e-12 * turnover(free.energy));
      const Response inside = at(free.peak * (1 - 1e-9));
      CHECK(impacts(inside) >= 1);
      CHECK(inside.peak == free.peak * (1 - 1e-9));
    }
}

TEST_CASE("stops of constant friction in closed form and in series agree", "[stops]") {
  // The event loop of the series looks for a stop in every step.
  for (const double frequency : {0.0, 4.0})
    for (const double part : {0.2, 0.5, 0.9}) {
      CAPTURE(frequency, part);
      const GroundMotion motion = broadband(11, 300);
      const double gap = part * integrate(Slider(Coulomb(0.3), frequency), motion).peak;
      const Mounting mounting = within({gap, 0.4}, frequency);
      const Response one = integrate(Slider(Coulomb(0.3), mounting), motion);
      const Response other = integrate(Slider(VelocityDependent(0.3, 0.3, 10), mounting), motion);
      CHECK(impacts(one) > 0);
      CHECK(impacts(one) == impacts(other));
      CHECK(std::abs(one.residual - other.residual) <= 1e-9 * gap);  // an impact multiplies round-off
      CHECK(std::abs(one.energy.dissipated - other.energy.dissipated) <= 1e-9 * turnover(other.energy));
      CHECK(std::abs(one.energy.impact - other.energy.impact) <= 1e-9 * turnover(other.energy));
    }
}

TEST_CASE("a slider that cannot slide back stays at the stop, for whatever reason", "[stops]") {
  const Stops stops(0.01, 0.8);
  const GroundMotion motion({-1, -3, -3, 2, 0, 0}, 0.2);
  const auto stays = [&](const auto& newmark, const auto& one_way) {
    for (const bool settle : {false, true}) {
      const Response infinite = integrate(newmark, motion, from(0, 0, settle));
      const Response ratchet = integrate(one_way, motion, from(0, 0, settle));
      CHECK(impacts(infinite) == 1);
      CHECK(infinite.residual == 0.01);
      CHECK(infinite.state.mode == Mode::stuck);
      CHECK(infinite.displacement == ratchet.displacement);
      CHECK(infinite.velocity == ratchet.velocity);
      CHECK(infinite.energy.impact == ratchet.energy.impact);
      CHECK(infinite.events.size() == ratchet.events.size());
    }
    State state = State::at(0.005, 0.3);
    advance(newmark, Segment{0.5, -2, 2}, state);
    CHECK(state.displacement == 0.01);
    CHECK(state.mode == Mode::stuck);
  };
  const Mounting both{.stops = stops}, forward{.one_way = true, .stops = stops};
  stays(Slider(Coulomb(1.5, infinity), both), Slider(Coulomb(1.5), forward));
  stays(Slider(StaticKinetic(Coulomb(1.5, infinity), 1.6, infinity), both),
        Slider(StaticKinetic(Coulomb(1.5), 1.6), forward));
  stays(Slider<Coulomb>::friction_pendulum(Coulomb(1.5, infinity), 2, both),
        Slider<Coulomb>::friction_pendulum(Coulomb(1.5), 2, forward));
}

TEST_CASE("knots of a law between stops change nothing where the level does not", "[stops]") {
  std::vector<double> knots;
  for (int i = 0; i < 400; ++i) knots.push_back(0.0037 * i);
  const Degrading law(knots, std::vector<double>(knots.size(), 0.5));
  for (const double e : {0.5, 0.9})
    for (const bool vertical : {false, true}) {
      CAPTURE(e, vertical);
      const Mounting mounting = within({0.008, 0.01, e});
      GroundMotion motion(gaussian(23, 25, 2), 0.1);
      if (vertical) motion = motion.with_components({}, gaussian(7, 25, 1));
      const Response one = integrate(Slider(Coulomb(0.5), mounting), motion);
      const Response other = integrate(Slider(law, mounting), motion);
      CHECK(impacts(one) > 10);
      REQUIRE(one.events.size() == other.events.size());
      for (std::size_t i = 0; i < one.events.size(); ++i) {
        CHECK(one.events[i].kind == other.events[i].kind);
        CHECK(std::abs(one.events[i].time - other.events[i].time) <= 1e-7);
      }
      CHECK(std::abs(one.residual - other.residual) <= 1e-7 * 0.01);  // impacts multiply round-off
    }
}

TEST_CASE("bounces are skipped only while the load is practically constant", "[stops]") {
  // The load exceeds the level by 1e-6 m/s^2 and falls. At a stop far from x = 0 the bounces are below round-off, but
  // under a constant load they would take a millisecond. What happens does not depend on where the stop is.
  const auto last_rest = [](double gap) {
    struct Rests {
      double last = 0;
      void slide(const Slip&) {}
      void event(EventKind kind, double time, const State&) {
        if (kind == EventKind::arrest) last = time;
      }
    } rests;
    State state = State::at(gap, 1e-6);
    const double load = 1 + 1e-6;
    advance(Slider(Coulomb(1), {.stops = Stops(gap, 0.5)}), Segment{0.5, -load, -load + 2}, state, rests);
    CHECK(state.mode == Mode::stuck);
    return rests.last;
  };
  const double near = last_rest(1e-3);
  CHECK(near > 0);
  CHECK(last_rest(1e3) == Approx(near).epsilon(1e-6));
}

TEST_CASE("stops that cannot be are refused", "[stops]") {
  CHECK_THROWS_WITH(Stops(0, 0.5), "Stops: gap must be positive, got 0 m");
  CHECK_THROWS_WITH(Stops(0.1, -1, 0.5), "Stops: backward must be positive, got -1 m");
  CHECK_THROWS_WITH(Stops(0.1, 1.5), "Stops: restitution must be from 0 to 1, got 1.5");
  CHECK_THROWS_WITH(Stops(0.1, not_a_number), "Stops: restitution must be from 0 to 1, got nan");
  CHECK_THROWS_WITH(integrate(Slider(Coulomb(1), within({0.1, 0})), record_a(), from(0.2)),
                    "integrate: displacement must be between the stops, from -0.1 to 0.1 m, got 0.2 m");
}
