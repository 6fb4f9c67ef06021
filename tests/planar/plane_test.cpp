// Sliders in the plane: reference values, closed forms, and what happens near rest.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <string_view>
#include <vector>

#include "stickslip/core.hpp"
#include "stickslip/planar/integrate.hpp"
#include "support/catch.hpp"
#include "support/motions.hpp"
#include "support/reference.hpp"

using namespace stickslip;
using namespace test;
using Catch::Matchers::ContainsSubstring;

namespace {

constexpr double g = standard_gravity;

// Records the events of one segment.
struct Events {
  struct One {
    EventKind kind;
    double time;
    PlanarState state;
  };
  std::vector<One> all;

  void event(EventKind kind, double time, const PlanarState& state) { all.push_back({kind, time, state}); }
  std::vector<EventKind> kinds() const {
    std::vector<EventKind> result;
    for (const One& one : all) result.push_back(one.kind);
    return result;
  }
};

struct Outcome {
  PlanarState state;
  Events events;
};

template <class Law>
Outcome after(const PlanarSlider<Law>& slider, const PlanarLoadSegment& segment, Vector2 displacement = {},
              Vector2 velocity = {}) {
  Outcome outcome{PlanarState::at(displacement, velocity), {}};
  advance(slider, segment, outcome.state, outcome.events);
  return outcome;
}

// A load that changes linearly, without vertical motion.
PlanarLoadSegment under(double duration, Vector2 load, Vector2 rate = {}) {
  return {duration, load, load + duration * rate, g, g};
}

double distance(Vector2 a, Vector2 b) { return norm(a - b); }
double distance(Vector2 a, const std::vector<double>& b) { return norm(a - Vector2{b[0], b[1]}); }

std::vector<double> transverse_samples() {
  std::vector<double> n;
  for (int m = 0; m <= 400; ++m)
    n.push_back(static_cast<double>(1.5L * std::sin(0.9L * m + 1.1L) + 0.8L * std::cos(2.3L * m)));
  return n;
}
std::vector<double> vertical_samples() {
  std::vector<double> n;
  for (int m = 0; m <= 400; ++m) n.push_back(static_cast<double>(2.5L * std::cos(0.5L * m + 0.2L)));
  return n;
}

GroundMotion both(Interpolation interpolation = Interpolation::linear) {
  return record_a(interpolation).with_components(transverse_samples(), {});
}

reference::Value run(const char* id) { return reference::row("sliders", "planar", id); }

void check(const PlanarResponse& r, const reference::Value& run) {
  const double scale = r.peak, fast = 1;
  CHECK(distance(r.residual, run["displacement"].list()) <= 1e-12 * scale);
  CHECK(distance(r.state.velocity, run["velocity"].list()) <= 1e-12 * fast);
  const auto nodes = run["nodes"].as<std::vector<std::size_t>>();
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    CHECK(distance(r.displacement[nodes[k]], run["displacements"].items()[k].list()) <= 1e-12 * scale);
    CHECK(distance(r.velocity[nodes[k]], run["velocities"].items()[k].list()) <= 1e-12 * fast);
  }
  CHECK(std::abs(r.energy.imbalance()) <= 1e-12 * turnover(r.energy));
}

int count(const PlanarResponse& r, EventKind kind) {
  return static_cast<int>(std::ranges::count_if(r.events, [&](const PlanarEvent& e) { return e.kind == kind; }));
}

}  // namespace

TEST_CASE("slider in the plane: reference values", "[planar]") {
  SECTION("with a spring") {
    check(integrate(PlanarSlider(Coulomb(1), {.natural_frequency = 2}), both()), run("D.a1.spring2"));
  }
  SECTION("samples that are held") {
    check(integrate(PlanarSlider(Coulomb(1)), both(Interpolation::constant)), run("D.const.a1"));
  }
  SECTION("under vertical motion") {
    const PlanarResponse r =
        integrate(PlanarSlider(Coulomb(0.2 * g)), record_a().with_components(transverse_samples(), vertical_samples()));
    check(r, run("D.vertical"));
    CHECK(count(r, EventKind::breakaway) == 85);
    CHECK(count(r, EventKind::arrest) == 85);
    const double times[] = {0.2421805892561324316089599, 0.9275633441115507383855121, 0.9747532207858817127280861,
                            1.077138798020605534692992};
    for (std::size_t i = 0; i < 4; ++i) CHECK(std::abs(r.events[i].time - times[i]) <= 1e-10);
    CHECK(distance(r.events[1].displacement, Vector2{0.01275967575658130082776337, 0.001764761339376464785675089}) <=
          1e-12 * r.peak);
    CHECK(distance(r.events[3].displacement, Vector2{0.01188056220947602928207702, 0.002280414463393338615864469}) <=
          1e-12 * r.peak);
  }
  SECTION("along one line") {
    std::vector<double> aside = record_a_samples();
    for (double& n : aside) n *= 0.75;
    const PlanarResponse r = integrate(PlanarSlider(Coulomb(1)), record_a().with_components(aside, {}));
    CHECK(distance(r.residual, Vector2{-0.06264892900287149794929986, -0.04698669675215362346197489}) <=
          1e-12 * r.peak);
    CHECK(distance(r.state.velocity, Vector2{-0.1483637223625219509203106, -0.111272791771891463190233}) <= 1e-12);
    CHECK(count(r, EventKind::breakaway) == 14);  // the reference does not count the one at the start
    CHECK(count(r, EventKind::arrest) == 13);
    CHECK(count(r, EventKind::reversal) == 76);
  }
}

TEST_CASE("slider in the plane: single stops under linear loads", "[planar]") {
  const PlanarSlider slider(Coulomb(1));
  struct Case {
    Vector2 load, rate, velocity;
    double time;
    Vector2 place;
  };
  for (const Case& one : {Case{{0.3, 0.1},
                               {0.01, -0.2},
                               {1, 0.2},
                               1.476536375221915232104738,
                               {0.7358764916921887512870776, 0.1212282623051112609747199}},
                          Case{{0.3, 0.5},
                               {0.2, -0.1},
                               {0.4, 0},
                               0.8489334923735213248179781,
                               {0.1388355395036448155378624, 0.04874821078518921565179035}}}) {
    const Outcome to = after(slider, under(1.01 * one.time, one.load, one.rate), {}, one.velocity);
    REQUIRE(to.events.kinds() == std::vector{EventKind::arrest});
    CHECK(std::abs(to.events.all[0].time - one.time) <= 1e-10);
    CHECK(distance(to.state.displacement, one.place) <= 1e-12 * norm(one.place));
    CHECK(to.state.mode == PlanarMode::stuck);
    CHECK(to.state.velocity == Vector2{});
  }
}

TEST_CASE("slider in the plane: the closed form under a constant load", "[planar]") {
  // With z = tan(phi / 2), phi between load and velocity: see NEXT.md D. Here by quadrature of the polar equations in
  // the exponent of z, which has no cancellation.
  const PlanarSlider slider(Coulomb(1));
  for (const double load : {0.2, 0.5, 0.9, 0.999})
    for (const double phi : {0.0, 0.3, 1.5, 2.8, 3.1}) {
      const double u = 0.7, c = std::cos(phi / 2), s = std::sin(phi / 2);
      const double time = u * (1 + load * std::cos(phi)) / (1 - load * load);
      const double along = u * u * (std::pow(c, 4) / (2 * (1 - load)) - std::pow(s, 4) / (2 * (1 + load)));
      const double aside = u * u * std::sin(phi) * (c * c / (2 - load) + s * s / (2 + load));
      INFO("load " << load << ", angle " << phi);
      const Outcome to = after(slider, under(2 * time, {load, 0}), {}, {u * std::cos(phi), u * std::sin(phi)});
      REQUIRE(to.events.kinds() == std::vector{EventKind::arrest});
      const double scale = u * time;
      CHECK(std::abs(to.events.all[0].time - time) <= 1e-12 * time);
      CHECK(distance(to.state.displacement, Vector2{along, aside}) <= 1e-12 * scale);
    }
  // Beyond the level it never stops; rho = z / z0 is found from the time.
  for (const double load : {1.0, 1.3, 2.0, 7.0})
    for (const double phi : {0.4, 1.6, 2.9}) {
      const double u = 0.7, k = 1 / load, z0 = std::tan(phi / 2), from = u / (1 + z0 * z0);
      const auto power = [](double rho, double m) {
        return std::abs(m) < 1e-14 ? -std::log(rho) : -std::expm1(m * std::log(rho)) / m;
      };
      for (const double rho : {0.9, 0.3, 0.01}) {
        const double time = from / load * (power(rho, k - 1) + z0 * z0 * power(rho, k + 1));
        const double z = rho * z0, speed = u * std::pow(rho, k - 1) * (1 + z * z) / (1 + z0 * z0);
        const double along = from * from / load * (power(rho, 2 * k - 2) - std::pow(z0, 4) * power(rho, 2 * k + 2));
        const double aside = 2 * from * from / load * z0 * (power(rho, 2 * k - 1) + z0 * z0 * power(rho, 2 * k + 1));
        INFO("load " << load << ", angle " << phi << ", rho " << rho);
        const Outcome to = after(slider, under(time, {load, 0}), {}, {u * std::cos(phi), u * std::sin(phi)});
        const double angle = 2 * std::atan(z);
        CHECK(to.events.all.empty());
        CHECK(distance(to.state.displacement, Vector2{along, aside}) <= 1e-12 * to.state.sliding_distance);
        CHECK(distance(to.state.velocity, speed * Vector2{std::cos(angle), std::sin(angle)}) <=
              1e-12 * std::max(speed, u));
      }
    }
}

TEST_CASE("slider in the plane: rest is nearly passed", "[planar]") {
  const PlanarSlider slider(Coulomb(1));
  SECTION("reference values") {
    const Outcome wide = after(slider, under(1, {2, 0}), {}, {-1, 1e-3});
    CHECK(distance(wide.state.displacement, Vector2{0.05555558333329861114019095, 0.0002500037615841373481539721}) <=
          1e-14);
    CHECK(distance(wide.state.velocity, Vector2{0.6666668333332916666523438, 3.749998125001171874080811e-10}) <= 1e-14);
    const Outcome near = after(slider, under(1, {2, 0}), {}, {-1, 1e-12});
    CHECK(distance(near.state.displacement, Vector2{0.05555555555555555555555558, 2.5e-13}) <= 1e-14);
    CHECK(distance(near.state.velocity, Vector2{0.6666666666666666666666668, 0}) <= 1e-14);
    CHECK(wide.events.all.empty());
    // Its least speed is 7e-19 m/s: it may count as a reversal, but not as an arrest.
    for (const auto& event : near.events.all) CHECK(event.kind == EventKind::reversal);
  }
  SECTION("at any distance, and with the load near the level") {
    // With a load just above the level, a slider that comes in against it turns through 180 degrees.
    for (const double load : {2.0, 1.1, 1.001, 1.00001})
      for (const double aside : {1e-3, 1e-6, 1e-9, 1e-12}) {
        INFO("load " << load << ", aside " << aside);
        const double k = 1 / load, u = std::hypot(1, aside), z0 = (u + 1) / aside;
        // u^2/(1 + z0^2)^2 z0^4 is u^2 up to (aside/2)^2: what is left to the limit of small z has this factor.
        const double rho = 1e-2 / z0;  // to an angle of 0.02
        const auto power = [](double r, double m) {
          return std::abs(m) < 1e-14 ? -std::log(r) : -std::expm1(m * std::log(r)) / m;
        };
        const double from = u / (1 + z0 * z0);
        const double time = from / load * (power(rho, k - 1) + z0 * z0 * power(rho, k + 1));
        const double along = from * from / load * (power(rho, 2 * k - 2) - z0 * z0 * (z0 * z0) * power(rho, 2 * k + 2));
        const double across = 2 * from * from / load * z0 * (power(rho, 2 * k - 1) + z0 * z0 * power(rho, 2 * k + 1));
        const Outcome to = after(slider, under(time, {load, 0}), {}, {-1, aside});
        for (const auto& event : to.events.all) CHECK(event.kind == EventKind::reversal);  // see above
        CHECK(distance(to.state.displacement, Vector2{along, across}) <= 1e-12 * to.state.sliding_distance);
        CHECK(std::abs(to.state.displacement.transverse - across) <= 1e-9 * across);
      }
  }
}

TEST_CASE("slider in the plane: a near miss is no event, and a reversal on a line is one", "[planar]") {
  const PlanarSlider block(Coulomb(1.0));
  // Thrown against a load that it does not withstand, with a little speed aside.
  for (const double aside : {1e-3, 1e-6, 1e-9, 1e-12}) {
    const Outcome there = after(block, under(1, {1.5, 0}, {0.3, 0}), {}, {-0.5, aside});
    CHECK(there.events.all.empty());
    CHECK(there.state.displacement.transverse == Approx(0.14185268852 * aside).epsilon(1e-4));
  }
  for (const Vector2 toward : {Vector2{1, 0}, Vector2{0, 1}, Vector2{0.6, -0.8}, Vector2{1 / 3.0, std::sqrt(8.0) / 3}})
    CHECK(after(block, under(1, 1.5 * toward, 0.3 * toward), {}, -0.5 * toward).events.kinds() ==
          std::vector{EventKind::reversal});
}

TEST_CASE("slider in the plane: breakaway", "[planar]") {
  const PlanarSlider slider(Coulomb(1));
  SECTION("where the load reaches the level") {
    const Outcome to = after(slider, under(1, {0.8, 0.6}, {0.3, 0.6}));
    CHECK(distance(to.state.displacement, Vector2{0.07293842000774387221449207, 0.07232161917885461791946632}) <=
          1e-13);
    CHECK(distance(to.state.velocity, Vector2{0.2138707232632279747454249, 0.2247861791354402054634227}) <= 1e-13);
    CHECK(to.events.kinds() == std::vector{EventKind::breakaway});
  }
  SECTION("under a load that exceeds the level") {
    const Outcome to = after(slider, under(1, {1.2, 0.5}, {-0.1, 0.9}));
    CHECK(distance(to.state.displacement, Vector2{0.1609172249577715212516635, 0.1376942190141755446386946}) <= 1e-13);
    CHECK(distance(to.state.velocity, Vector2{0.3456885673550172170518822, 0.3683797094821198527786504}) <= 1e-13);
  }
  SECTION("at the first of two roots") {
    // |q|^2 = 1 at t = 0.3 and 0.9, with q.rate = 0 between: the load leaves the circle, and returns.
    const double half = 0.3, away = std::sqrt(1 + half * half);
    const Outcome to = after(slider, {1.2, {away, 0.6}, {away, -0.6}, g, g});
    CHECK(to.events.kinds().front() == EventKind::breakaway);
    CHECK(to.events.all[0].time == 0);  // outside from the start
    // Through the circle: in at 0.2, out at 1.0.
    const double height = std::sqrt(1 - 0.16);
    const Outcome out = after(slider, {1.2, {0.4, height}, {-0.8, height}, g, g});
    REQUIRE(!out.events.all.empty());
    CHECK(std::abs(out.events.all[0].time - 0.8) <= 1e-15);
  }
  SECTION("a double root is held, and what is above it slips") {
    // A load at rest and a weight that dips to it: |q|^2 - (w)^2 touches zero; friction holds an equal load.
    const Outcome held = after(slider, {2, {1, -1}, {1, 1}, std::sqrt(2.0) * g, std::sqrt(2.0) * g});
    CHECK(held.events.all.empty());
    CHECK(held.state.mode == PlanarMode::stuck);
    // The distance of a chord from the center is the level: it touches the circle from outside.
    const Outcome touches = after(slider, {2, {1, -1}, {1, 1}, g, g});
    CHECK(touches.events.kinds().front() == EventKind::breakaway);
    CHECK(touches.events.all[0].time == 0);
    // The level just above and below a load that is tangent to it: |q|^2 = 1 + (t - 1)^2, level^2 <= 1.
    const Outcome above = after(slider, {1, {0.6, 0.8}, {0.8, 0.6}, g, g});
    CHECK(above.events.all.empty());
  }
  SECTION("where the vertical component unloads it") {
    // |q| = 0.5 held, w = 1 - 0.6 t: leaves at t = 5/6; turned by any angle.
    for (const double angle : {0.0, 0.5, 2.1, 4.0}) {
      const Vector2 q{0.5 * std::cos(angle), 0.5 * std::sin(angle)};
      const Outcome to = after(slider, {1, q, q, g, 0.4 * g});
      REQUIRE(to.events.kinds() == std::vector{EventKind::breakaway});
      CHECK(std::abs(to.events.all[0].time - 5.0 / 6) <= 1e-15);
      // u' = 0.6 (t - 5/6): u = 0.3/36, s = 0.1/216.
      CHECK(std::abs(norm(to.state.velocity) - 0.3 / 36) <= 1e-15);
      CHECK(std::abs(to.state.sliding_distance - 0.1 / 216) <= 1e-16);
    }
  }
  SECTION("under a load that falls at once") {
    // Collinear: u = 0.1 t - t^2, which stops at 0.1 after 1/6000.
    const Outcome to = after(slider, {1, {1.1, 0}, {-0.9, 0}, g, g});
    REQUIRE(to.events.kinds() == std::vector{EventKind::breakaway, EventKind::arrest});
    CHECK(std::abs(to.events.all[1].time - 0.1) <= 1e-10);
    CHECK(std::abs(to.state.displacement.axis - 1 / 6000.0) <= 1e-15);
    const Outcome turning = after(slider, {1, {1.001, 0}, {-0.9, 0.3}, g, g});
    CHECK(turning.state.mode == PlanarMode::stuck);
    CHECK(turning.state.sliding_distance > 0);
  }
  SECTION("exactly at the level") {
    const Outcome held = after(slider, under(1, {0.6, 0.8}));
    CHECK(held.events.all.empty());
    const Outcome falls = after(slider, under(1, {0.6, 0.8}, {-0.1, -0.1}));
    CHECK(falls.events.all.empty());
    const Outcome grows = after(slider, under(1, {1, 0}, {0.1, 0}));
    REQUIRE(grows.events.kinds() == std::vector{EventKind::breakaway});
    CHECK(grows.events.all[0].time == 0);
    CHECK(std::abs(grows.state.displacement.axis - 0.1 / 6) <= 1e-16);
  }
}

TEST_CASE("slider in the plane: a circular stop", "[planar]") {
  const double gap = 0.05;
  const auto with = [&](double restitution, double natural_frequency = 0) {
    return PlanarSlider(Coulomb(0.1), {.natural_frequency = natural_frequency, .stops = Stops(gap, restitution)});
  };
  SECTION("reflects the radial velocity") {
    for (const double angle : {0.0, 1.1, 3.0, 5.5}) {
      const Vector2 outward{std::cos(angle), std::sin(angle)}, sideways = turned(outward);
      // Without load it slides straight: from the center it meets the stop head on.
      const Outcome head_on = after(with(0.5), under(0.1, {}), {}, 1 * outward);
      REQUIRE(head_on.events.kinds() == std::vector{EventKind::impact});
      const double hits = (1 - std::sqrt(1 - 2 * 0.1 * gap)) / 0.1, fast = 1 - 0.1 * hits, left = 0.1 - hits;
      CHECK(std::abs(head_on.events.all[0].time - hits) <= 1e-13);
      const double back = 0.5 * fast;
      CHECK(distance(head_on.state.velocity, -(back - 0.1 * left) * outward) <= 1e-13);
      // At an angle of 45 degrees only the radial component is reduced.
      const Outcome aslant = after(with(0.5), under(0.1, {}), -std::sqrt(0.5) * gap * sideways, outward);
      REQUIRE(!aslant.events.all.empty());
      CHECK(aslant.events.all[0].kind == EventKind::impact);
      CHECK(std::abs(norm(aslant.events.all[0].state.displacement) - gap) <= 1e-15);
    }
  }
  SECTION("is met at a tangent") {
    // Straight along a chord, the shorter the nearer it is to a tangent. Without loss in the radial direction the speed
    // only falls by friction, and the slider stays within the circle.
    for (const double off : {1e-3, 1e-6, 1e-9}) {
      INFO("within by " << off);
      const double height = gap * (1 - off), half = gap * std::sqrt(off * (2 - off));
      const Outcome to = after(with(1), under(0.06, {}), {-half / 2, height}, {1, 0});
      CHECK(norm(to.state.displacement) <= gap * (1 + 1e-14));
      CHECK(std::abs(norm(to.state.velocity) - 0.994) <= 1e-12);
    }
    // Along the circle from the start: the stop holds it while u^2/d exceeds the inward load. Where they are equal,
    // neither decision matters.
    const auto bent = [&](double load) { return after(with(0), under(0.02, {0, -load}), {0, gap}, {1, 0}).state; };
    CHECK(bent(15).mode == PlanarMode::along_stop);
    CHECK(norm(bent(15).displacement) == Approx(gap).epsilon(1e-14));
    CHECK(bent(25).mode == PlanarMode::sliding);
    CHECK(norm(bent(25).displacement) < 0.99 * gap);
    const double critical = 1 / gap;
    for (const double off : {1e-9, 1e-12, 1e-15}) {
      CHECK(distance(bent(critical * (1 + off)).displacement, bent(critical * (1 - off)).displacement) <=
            1e-2 * off + 1e-15);
      CHECK(distance(bent(critical * (1 + off)).velocity, bent(critical * (1 - off)).velocity) <= off + 1e-13);
    }
  }
  SECTION("is slid along while pressed") {
    // Pressed by (4, 0) at angle 0.5: u' = -4 sin(psi) - 0.1 from psi = 0.5, u^2/2 = d (4 (cos psi - cos 0.5) - ...).
    const Vector2 place{gap * std::cos(0.5), gap * std::sin(0.5)};
    const Outcome to = after(with(0), under(5, {4, 0}), place);
    CHECK(to.state.mode == PlanarMode::stuck);
    CHECK(norm(to.state.displacement) == Approx(gap).epsilon(1e-14));
    // It comes to rest within the angle at which friction holds the load along the stop.
    CHECK(std::abs(4 * to.state.displacement.transverse / gap) <= 0.1 * (1 + 1e-12));
    const double angle = std::atan2(to.state.displacement.transverse, to.state.displacement.axis);
    // Work of the load = friction: d 4 (cos psi - cos 0.5) = 0.1 s, without a change of direction.
    if (to.events.kinds().size() == 2)
      CHECK(std::abs(4 * gap * (std::cos(angle) - std::cos(0.5)) - 0.1 * to.state.sliding_distance) <= 1e-14);
    CHECK(to.events.kinds().front() == EventKind::breakaway);
    CHECK(to.events.kinds().back() == EventKind::arrest);
  }
  SECTION("ends infinitely many bounces") {
    const Outcome to = after(with(0.6), under(5, {1, 0.2}), {0.01, 0.01});
    CHECK(to.state.mode == PlanarMode::stuck);
    CHECK(norm(to.state.displacement) == Approx(gap).epsilon(1e-14));
    CHECK(to.events.all.size() > 10);
  }
  SECTION("is left when the load turns") {
    const PlanarLoadSegment turns{1.5, {1, 0}, {-0.5, 0.075}, g, g};
    const Outcome to = after(with(0), turns, {gap, 0});
    CHECK(norm(to.state.displacement) < gap);
    REQUIRE(!to.events.all.empty());
    CHECK(to.events.all[0].kind == EventKind::breakaway);
    CHECK(to.events.all[0].time > 1);
  }
}

TEST_CASE("slider in the plane: a law that acts with a high power of the speed", "[planar]") {
  // Along one line, u' = 0.1 t - (a(u) - a(0)) from the level on, by the classical rule of order 4.
  for (const int exponent : {2, 3, 9, 20}) {
    const Stribeck law(1.3, 0.8, 0.02, exponent);
    const auto slope = [&](double t, double u) { return 0.1 * t + 0.5 * -std::expm1(-std::pow(u / 0.02, exponent)); };
    const int steps = 2000;
    const double h = 1.0 / steps;
    double u = 0;
    for (int i = 0; i < steps; ++i) {
      const double t = i * h, a = slope(t, u), b = slope(t + h / 2, u + h / 2 * a), c = slope(t + h / 2, u + h / 2 * b),
                   d = slope(t + h, u + h * c);
      u += h / 6 * (a + 2 * b + 2 * c + d);
    }
    INFO("exponent " << exponent);
    const Vector2 along{0.6, -0.8};
    const Outcome to = after(PlanarSlider(law), {1, 1.3 * along, 1.4 * along, g, g});
    CHECK(distance(to.state.velocity, u * along) <= 1e-8 * u);
  }
}

TEST_CASE("slider in the plane: landing against a stop", "[planar]") {
  // Without friction in flight, bounces end pressed against the stop; then it lands there.
  const PlanarSlider slider(Coulomb(1), {.natural_frequency = 1, .stops = Stops(0.2, 0.3)});
  PlanarState state = PlanarState::at({0.1998545231246214, 0}, {-0.024268584631095109, 0});
  state.in_flight = true;
  state.gap = 0.02700275118042458;
  state.gap_velocity = -0.2262078043700933;
  Events events;
  advance(slider, {0.05, {2.455045020134007, 0}, {2.4613901337469444, 0}, 17.702704625323157, 22.728423525320437},
          state, events);
  CHECK(state.mode == PlanarMode::stuck);
  CHECK_FALSE(state.in_flight);
  CHECK(norm(state.displacement) == Approx(0.2).epsilon(1e-14));
  CHECK(state.sliding_distance > 2 * (0.2 - 0.1998545231246214));
  CHECK(state.sliding_distance < 5e-4);
  CHECK(events.all.back().kind == EventKind::landing);
}

TEST_CASE("slider in the plane: what it refuses", "[planar]") {
  CHECK_THROWS_WITH(PlanarSlider(Coulomb(1, 0.7)), ContainsSubstring("different levels forward and backward"));
  CHECK_THROWS_WITH(PlanarSlider(StaticKinetic(Coulomb(1, 0.7), 1.4)),
                    ContainsSubstring("different levels forward and backward"));
  CHECK_THROWS_WITH(PlanarSlider(Degrading({0, 1}, {1, 2}, {1, 1})),
                    ContainsSubstring("different levels forward and backward"));
  CHECK_THROWS_WITH(PlanarSlider(Coulomb(1), {.one_way = true}), ContainsSubstring("one_way has no meaning"));
  CHECK_THROWS_WITH(PlanarSlider(Coulomb(1), {.stops = Stops(0.1, 0.2, 0.5)}),
                    ContainsSubstring("0.1 m forward and 0.2 m backward"));
  const PlanarSlider slider(Coulomb(1), {.stops = Stops(0.1, 0.5)});
  CHECK_THROWS_WITH(integrate(slider, record_a()), ContainsSubstring("transverse component"));
  CHECK_THROWS_WITH(integrate(slider, both(), {.displacement = {0.08, 0.08}}), ContainsSubstring("within the stop"));
  CHECK_THROWS_WITH(integrate(slider, both(), {.velocity = {0, not_a_number}}), ContainsSubstring("must be finite"));
  CHECK_THROWS_WITH(integrate(slider, both(), {.sliding_distance = -1}), ContainsSubstring("sliding_distance"));
  PlanarState state;
  CHECK_THROWS_WITH(advance(slider, under(1, {infinity, 0}), state), ContainsSubstring("must be finite"));
  state.displacement = {0.2, 0};
  CHECK_THROWS_WITH(advance(slider, under(1, {}), state), ContainsSubstring("within the stop"));
  CHECK(state.displacement == Vector2{0.2, 0});
  static_assert(!IsotropicLaw<Caster>);
  static_assert(IsotropicLaw<Coulomb> && IsotropicLaw<StaticKinetic<Coulomb>> && IsotropicLaw<VelocityDependent> &&
                IsotropicLaw<Stribeck> && IsotropicLaw<Degrading>);
}

TEST_CASE("slider in the plane: along a stop, friction that rises in the last moment", "[planar]") {
  // While it is fast, the power series of the speed knows nothing of the static level, which acts only just before a
  // stop. Reference: the angle along the stop, by DOP853 in long double.
  const PlanarSlider slider(Stribeck(0.637, 0.332, 0.02, 5), {.stops = Stops(0.02, 0.02, 0.3)});
  PlanarState state = PlanarState::at({0.02 * std::cos(0.8), 0.02 * std::sin(0.8)},
                                      {-0.15 * std::sin(0.8), 0.15 * std::cos(0.8)}),
              parts = state;
  advance(slider, PlanarSegment{0.6, {-2, 0}, {-2, 0}}, state);
  for (int i = 0; i < 60; ++i) advance(slider, PlanarSegment{0.01, {-2, 0}, {-2, 0}}, parts);
  CHECK(norm(state.displacement - Vector2{0.01994353, -0.00150188}) <= 1e-8);
  CHECK(norm(state.displacement - parts.displacement) <= 1e-11);
}

TEST_CASE("a slider without weight leaves a circular stop where the load turns away, once", "[planar]") {
  // The radial load is 1e-7 of its parts there: what is left of it is their round-off, and no reason to hit the stop
  // again.
  const Slider<StaticKinetic<Coulomb>> bearing(StaticKinetic(Coulomb(1.1338549088848986), 1.4354823696117416),
                                               {.natural_frequency = 2, .stops = Stops(0.05, 0), .pendulum = true});
  PlanarState flies;
  flies.displacement = {0.04999999630294101, 1.9227737424311445e-05};
  flies.velocity = {4.0187606889277514e-08, -0.0001045042456918136};
  flies.mode = PlanarMode::sliding;
  flies.in_flight = true;
  flies.gap = 0.01035277703568338;
  flies.gap_velocity = 0.1;
  const PlanarSegment away{
      0.3, {-1.1404526064060418, 4.649507940894259e-4}, {6.451391477227298, 2.7549467783084466e-3}};
  advance(PlanarSlider(bearing), detail::load_segment(away, 0, -15.010699174031759, -4.577072063374134), flies,
          NoPlanarObserver{}, Contact::flight);
  CHECK(flies.displacement.axis < 0);

  const Slider<Degrading> block(Degrading({0.02, 0.08}, {1.4, 1.9}),
                                {.natural_frequency = 1, .damping = 5, .stops = Stops(0.02, 0.3)});
  PlanarState slides;
  slides.displacement = (0.02 / std::hypot(0.01994667415314038, 0.0014595171216678197)) *
                        Vector2{-0.01994667415314038, 0.0014595171216678197};
  slides.velocity = 0.0832 * turned(slides.displacement);
  slides.mode = PlanarMode::along_stop;
  slides.sliding_distance = 0.1;
  const PlanarSegment back{0.21622967564111706, {0.21304112288938054, -5.688e-3}, {-11.940293393958726, 4.4475e-4}};
  advance(PlanarSlider(block), detail::load_segment(back, 0, -11.837916073174412, -8.984359677001986), slides,
          NoPlanarObserver{}, Contact::clipped);
  CHECK(slides.displacement.axis > 0);
}

namespace {

// x and x' from rest at 0, by the classical rule of order 4.
template <class Acceleration>
std::array<double, 2> from_rest(double duration, Acceleration&& acceleration) {
  const int steps = 4000;
  const double h = duration / steps;
  double x = 0, v = 0;
  for (int i = 0; i < steps; ++i) {
    const double t = i * h, a = acceleration(t, x), b = acceleration(t + h / 2, x + h / 2 * v),
                 c = acceleration(t + h / 2, x + h / 2 * v + h * h / 4 * a),
                 d = acceleration(t + h, x + h * v + h * h / 2 * b);
    x += h * v + h * h / 6 * (a + b + c);
    v += h / 6 * (a + 2 * b + 2 * c + d);
  }
  return {x, v};
}

}  // namespace

TEST_CASE("slider in the plane: from rest along a circular stop", "[planar]") {
  // Without curvature of its path it would leave the circle along the tangent.
  const double gap = 0.05, level = 0.5, duration = 0.2;
  for (const double angle : {0.0, 0.5, 2.0, 4.5})
    for (const double side : {1.0, -1.0}) {
      INFO("at an angle of " << angle << ", to the side " << side);
      const Vector2 outward{std::cos(angle), std::sin(angle)}, sideways = side * turned(outward);
      const auto check = [&](const Outcome& to, std::array<double, 2> along) {
        const auto [psi, rate] = along;
        const Vector2 place = std::cos(psi) * outward + std::sin(psi) * sideways;
        CHECK(distance(to.state.displacement, gap * place) <= 1e-13);
        CHECK(distance(to.state.velocity, gap * rate * side * turned(place)) <= 1e-12);
        CHECK(to.state.mode == PlanarMode::along_stop);
        CHECK(to.events.kinds() == std::vector{EventKind::breakaway});
      };
      // A load along the stop, which soon presses the slider against it. The work of the load is that of friction and
      // the kinetic energy.
      const PlanarSlider slider(Coulomb(level), {.stops = Stops(gap, 0.3)});
      const Outcome pushed = after(slider, under(duration, sideways), gap * outward);
      check(pushed, from_rest(duration, [&](double, double psi) { return (std::cos(psi) - level) / gap; }));
      const double speed = norm(pushed.state.velocity);
      CHECK(std::abs(dot(pushed.state.displacement, sideways) - level * pushed.state.sliding_distance -
                     speed * speed / 2) <= 1e-14);
      // The weight and the load, partly outward, begin at zero.
      for (const double presses : {0.0, 0.2}) {
        const PlanarLoadSegment grows{duration, {}, presses * outward + sideways, 0, g};
        check(after(slider, grows, gap * outward), from_rest(duration, [&](double t, double psi) {
                return t / duration * (std::cos(psi) - presses * std::sin(psi) - level) / gap;
              }));
      }
      // A load along the stop that is held, also for some time after the radial part has turned inward.
      const PlanarLoadSegment turns{duration, 0.8 * level * sideways + outward, 0.8 * level * sideways - outward, g, g};
      const Outcome leaves = after(slider, turns, gap * outward);
      CHECK(norm(leaves.state.displacement) < gap);
      CHECK(leaves.state.mode == PlanarMode::sliding);
      REQUIRE(leaves.events.kinds() == std::vector{EventKind::breakaway});
      CHECK(std::abs(leaves.events.all[0].time - duration * (1 + 0.6 * level) / 2) <= 1e-15);
    }
}

TEST_CASE("slider in the plane: a load equal to the level along a circular stop", "[planar]") {
  // Held with one bit less or more, and left inward as soon as the load turns. Turned or cut in two, it is the same.
  const double gap = 0.05;
  const Stribeck law(0.5, 0.3, 0.05, 1);
  const PlanarSlider slider(law, {.natural_frequency = 2, .stops = Stops(gap, 0.5), .pendulum = true});
  const double pull = 4 * gap;
  for (const double angle : {0.0, 0.7, 1.1, 2.0, 3.3, 5.0}) {
    INFO("at an angle of " << angle);
    const Vector2 outward{std::cos(angle), std::sin(angle)}, sideways = turned(outward);
    const Outcome rests = after(slider, under(0.5, pull * outward + 0.5 * sideways), gap * outward);
    // A load that is rounded to more than the level pushes with that excess.
    CHECK(distance(rests.state.displacement, gap * outward) <= 1e-15);
    CHECK(distance(rests.state.velocity, Vector2{}) <= 1e-15);
    // From the level on the load grows inward: u' = rate t + 0.2 (1 - exp(-u / 0.05)) + 4 x, x the way.
    const double rate = 3, duration = 0.1;
    const PlanarLoadSegment grows{duration, (pull - 0.5) * outward, (pull - 0.5 - rate * duration) * outward, g, g};
    const Outcome slides = after(slider, grows, gap * outward);
    const int steps = 4000;
    const double h = duration / steps;
    double u = 0, x = 0;
    const auto slope = [&](double t, double way, double speed) {
      return rate * t - 0.2 * std::expm1(-speed / 0.05) - 4 * way;
    };
    for (int i = 0; i < steps; ++i) {
      const double t = i * h, a = slope(t, x, u), b = slope(t + h / 2, x + h / 2 * u, u + h / 2 * a),
                   c = slope(t + h / 2, x + h / 2 * u + h * h / 4 * a, u + h / 2 * b),
                   d = slope(t + h, x + h * u + h * h / 2 * b, u + h * c);
      x += h * u + h * h / 6 * (a + b + c);
      u += h / 6 * (a + 2 * b + 2 * c + d);
    }
    CHECK(distance(slides.state.displacement, (gap - x) * outward) <= 1e-12);
    CHECK(distance(slides.state.velocity, -u * outward) <= 1e-11);
    CHECK(slides.events.all.size() <= 3);
  }
}

TEST_CASE("slider in the plane: a pendulum whose weight and load begin at zero", "[planar]") {
  // Straight toward the center: x'' = t/T (wn^2 (r - x) - level). The pull of the way x acts only from t^5 on.
  const double wn = 6, duration = 0.1, place = 0.05, level = 1;
  const PlanarSlider slider(Coulomb(level), {.natural_frequency = wn, .pendulum = true});
  const auto [x, speed] =
      from_rest(duration, [&](double t, double way) { return t / duration * (wn * wn * (place - way) - level); });
  const Vector2 outward{0.6, -0.8};
  const Outcome to = after(slider, {duration, {}, {}, 0, g}, place * outward);
  CHECK(distance(to.state.displacement, (place - x) * outward) <= 1e-13);
  CHECK(distance(to.state.velocity, -speed * outward) <= 1e-12);
}

TEST_CASE("slider in the plane: a slip that begins at the level, whether at rest or too slow to matter", "[planar]") {
  // The load equals the level and turns away from it: the speed grows with the third power of the time.
  const PlanarLoadSegment turns{0.02, {2, 0}, {2, -2}, g, g};
  const PlanarSlider slider(Coulomb(2), {.damping = 2});
  const Outcome rests = after(slider, turns);
  CHECK(norm(rests.state.velocity) > 5e-3);
  for (const double speed : {1e-14, 1e-20, 1e-30, 1e-60})
    CHECK(distance(after(slider, turns, {}, {speed, 0}).state.velocity, rests.state.velocity) <= 1e-12);
}

TEST_CASE("slider in the plane: load and weight that vanish together hold the slider", "[planar]") {
  // The pull of a pendulum is proportional to its weight. By round-off alone it would exceed the level at the end.
  for (const double place : {2.7e-6, 6.8e-4, 0.03})
    for (const Vector2 toward : {Vector2{1, 0}, Vector2{0.52052605, -0.85384977}, Vector2{0.6, 0.8}}) {
      const PlanarSlider slider(StaticKinetic(Coulomb(0.5), 0.75), {.natural_frequency = 2, .pendulum = true});
      const Outcome to = after(slider, {0.02, {}, {}, 0.5 * g, 0}, place * toward);
      CHECK(to.state.mode == PlanarMode::stuck);
      CHECK(to.events.all.empty());
    }
}
