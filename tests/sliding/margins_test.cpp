// Margins of decisions: cases whose margins are known in closed form, scaling, and that they mean what they say.
#include "stickslip/sliding/margins.hpp"

#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

#include "stickslip/core.hpp"
#include "support/catch.hpp"
#include "support/motions.hpp"

using namespace stickslip;
using namespace test;

namespace {

template <class S, class M>
Margins margins_of(const S& slider, const M& motion, const IntegrateOptions& options = {}) {
  return margins(slider, motion, integrate(slider, motion, options));
}

/// The ground acceleration that loads a slider on level ground with these values, straight lines between them.
GroundMotion loads(std::vector<double> p, double dt = 1) {
  for (double& value : p) value = -value;
  return {std::move(p), dt};
}

}  // namespace

TEST_CASE("a load that all but breaks a slider away has the margin that was left", "[margins]") {
  CHECK(margins_of(Coulomb(1), loads({0, 0.75, 0})).load == 0.25);
  CHECK(margins_of(Coulomb(1), loads({0, -0.75, 0})).load == 0.25);
  CHECK(margins_of(Coulomb(1), loads({0, 0.5, 0.25, 0.75, 0, -0.5, 0})).load == 0.25);
  CHECK(margins_of(Coulomb(1), loads({0, 0.25, 0.75})).load == 0.25);  // which it holds to the end
  CHECK(margins_of(Coulomb(2, 0.8), loads({0, 0.5, 0, -0.6, 0})).load == Approx(0.25).epsilon(1e-15));
  CHECK(margins_of(StaticKinetic(Coulomb(1), 2), loads({0, 1.5, 0})).load == 0.25);
  CHECK(margins_of(Coulomb(1), steps({-0.25, -0.75, 0.5})).load == 0.25);  // held values
}

TEST_CASE("a load that just breaks a slider away has the margin by which it went beyond", "[margins]") {
  // The load goes to 1 + E and back at the same rate: the slip ends where it is 1 - sqrt(2) E.
  for (const double e : {0.25, 0.125, 1e-3})
    CHECK(margins_of(Coulomb(1), loads({0, 1 + e, 0})).load == Approx(e).epsilon(1e-12));
  CHECK(margins_of(Coulomb(1), loads({0, 2, 0}, 0.5)).load == Approx(1).epsilon(1e-12));
  CHECK(margins_of(StaticKinetic(Coulomb(0.125), 1), loads({0, 1.25, -0.5, -0.5})).load == Approx(0.25).epsilon(1e-12));
  CHECK(margins_of(Coulomb(1), steps({-1.25, 0.5, 0})).load == Approx(0.25).epsilon(1e-12));
}

TEST_CASE("where a slip ends the margin is that of the load to what holds", "[margins]") {
  // Thrown forward against a level of 1 under a load of 0.75 back: it stops at 0.25 from slipping back.
  IntegrateOptions thrown;
  thrown.velocity = 1;
  CHECK(margins_of(Coulomb(1), loads({-0.75, -0.75}), thrown).load == Approx(0.25).epsilon(1e-12));
  // And under one of 1.125 it turns round.
  CHECK(margins_of(Coulomb(1), loads({-1.125, -1.125}), thrown).load == Approx(0.125).epsilon(1e-12));
}

TEST_CASE("a stop that is nearly none has a small margin", "[margins]") {
  // B.graze of the reference: the load 0.8 + 0.45 t against 1; the speed falls to v0 - 2/45 at t = 4/9. Short of that
  // by delta it stops where the load is sqrt(0.9 delta) below the level.
  const GroundMotion motion = loads({0.8, 1.25});
  for (const double delta : {1e-4, 1e-6, 1e-8}) {
    IntegrateOptions thrown;
    thrown.velocity = 2.0 / 45 - delta;
    CHECK(margins_of(StaticKinetic(Coulomb(1), 1.3), motion, thrown).load ==
          Approx(std::sqrt(0.9 * delta)).epsilon(1e-15 / delta));
  }
}

TEST_CASE("what the end of the ground motion lets go has the margin of the load after it", "[margins]") {
  // The spring pulls with 1.2, of which the ground holds 1 until it stands still.
  const Slider slider(StaticKinetic(Coulomb(0.5), 1.15), 2);
  CHECK(margins_of(slider, loads({1, 1, 1}), from(0.3, 0, true)).load == Approx(1.2 / 1.15 - 1).epsilon(1e-12));
}

TEST_CASE("margins follow the normal force and the spring", "[margins]") {
  // N from g to 0.9 g and back under a load of 1, a level of 1.25.
  const double g = standard_gravity;
  const GroundMotion lighter = loads({1, 1, 1}).with_components({}, {0, -0.1 * g, 0});
  CHECK(margins_of(Coulomb(1.25), lighter).load == Approx(1 - 1 / (0.9 * 1.25)).epsilon(1e-13));
  // A spring that pulls back with 0.5 where it rests.
  IntegrateOptions drawn;
  drawn.displacement = 0.125;
  CHECK(margins_of(Slider(Coulomb(1), 2), loads({0, 0, 0.25, 0}), drawn).load == Approx(0.5).epsilon(1e-13));
}

TEST_CASE("margins under a harmonic motion are those of its crests", "[margins]") {
  CHECK(margins_of(Coulomb(1), HarmonicMotion(0.75, 3, 100)).load == Approx(0.25).epsilon(1e-13));
  CHECK(margins_of(Coulomb(1, 0.8), HarmonicMotion(0.75, 3, 1e4, 1e4)).load == Approx(0.0625).epsilon(1e-12));
  // The first crest comes at once: it begins to slip with an excess of 0.25.
  CHECK(margins_of(Coulomb(1), HarmonicMotion(1.25, 3, 0.01)).load == Approx(0.25).epsilon(1e-13));
}

TEST_CASE("margins do not depend on the scale", "[margins]") {
  const GroundMotion quake = record_a();
  for (const double level : {0.5, 1.0, 2.0}) {
    const Margins one = margins_of(Coulomb(level), quake), other = margins_of(Coulomb(4 * level), quake.scaled(4));
    CHECK(one.load > 0);
    CHECK(one.load < 1);
    CHECK(other.load == one.load);
    CHECK(margins_of(Coulomb(level), quake.scaled(-1)).load == one.load);
  }
}

TEST_CASE("margins follow the memory of a law", "[margins]") {
  // Thrown at 1 m/s the slider goes until it stops at a level that has fallen meanwhile; a load of half of that level
  // then leaves a margin of 0.5 of what holds.
  const Degrading law({0, 0.5}, {2, 1});
  IntegrateOptions thrown;
  thrown.velocity = 1;
  const GroundMotion quiet = loads({0, 0, 0});
  const Response r = integrate(law, quiet, thrown);
  State state;
  state.displacement = r.residual;
  state.sliding_distance = r.sliding_distance;
  const double level = hold(law.at(state), r.residual, Direction::forward);
  CHECK(level < 2);
  const GroundMotion motion = loads({0, 0, level / 2, 0});
  const Response pushed = integrate(law, motion, thrown);
  CHECK(margins(law, motion, pushed).load == Approx(0.5).epsilon(1e-12));
}

TEST_CASE("the margin of a breakaway under a vanishing normal force does not depend on the samples", "[margins]") {
  // It breaks away while the load rises and the normal force falls below zero, and slides on when it presses again.
  IntegrateOptions clipped;
  clipped.contact = Contact::clipped;
  std::vector<double> found;
  for (const int parts : {1, 2, 10, 100}) {
    std::vector<double> n, times, up;
    for (int j = 0; j <= parts; ++j) {
      const double f = static_cast<double>(j) / parts;
      n.push_back(0.3 + 0.2 * f);
      times.push_back(0.1 * f);
      up.push_back(-20 * f);
    }
    n.push_back(0.5);
    times.push_back(0.2);
    up.push_back(0);
    found.push_back(margins_of(Coulomb(1), GroundMotion(n, times).with_components({}, up), clipped).load);
  }
  CHECK(found.front() > 0.1);
  for (const double margin : found) CHECK(margin == Approx(found.front()).epsilon(1e-9));
}

TEST_CASE("levels that are zero or infinite decide nothing", "[margins]") {
  CHECK(margins_of(Coulomb(0), record_a()).load == infinity);
  CHECK(margins_of(Coulomb(0), record_a()).impact == infinity);
  CHECK(margins_of(Coulomb(1, infinity), loads({0, -9, 0})).load == 1);  // at rest without a load, forward
  CHECK(margins_of(Slider(Coulomb(1), {.one_way = true}), loads({0, -9, 0})).load == 1);
  CHECK(margins_of(Coulomb(1), record_a()).impact == infinity);  // no stops
}

TEST_CASE("a change of the levels by less than the margin keeps all decisions", "[margins]") {
  // What the margin is for: static friction above kinetic, whose response jumps where a decision changes.
  const GroundMotion quake = record_a();
  int kept = 0;
  for (int k = 0; k < 12; ++k) {
    const double level = 1 + 0.05 * k;
    const auto slider = [&](double factor) { return StaticKinetic(Coulomb(level), 1.3 * level * factor); };
    const Response r = integrate(slider(1), quake);
    const double margin = margins(slider(1), quake, r).load;
    // Later loads at rest move with earlier slips no more than the levels do, without a spring.
    for (const double factor : {1 + 0.01 * margin, 1 - 0.01 * margin}) {
      const Response other = integrate(slider(factor), quake);
      CHECK(other.events.size() == r.events.size());
      ++kept;
    }
  }
  CHECK(kept == 24);
}

TEST_CASE("a stop that is missed or met by little has a small impact margin", "[margins]") {
  // Thrown at v0 against a level of 1 it goes v0^2 / 2 = 0.5.
  IntegrateOptions thrown;
  thrown.velocity = 1;
  const GroundMotion still = loads({0, 0}, 10);
  const auto margin = [&](double gap, double restitution) {
    return margins_of(Slider(Coulomb(1), {.stops = Stops(gap, 9, restitution)}), still, thrown).impact;
  };
  CHECK(margin(0.625, 0.5) == Approx(0.2).epsilon(1e-12));
  CHECK(margin(0.51, 0.5) == Approx(0.01 / 0.51).epsilon(1e-12));
  CHECK(margin(0.49, 0.5) == Approx(0.01 / 0.49).epsilon(1e-12));
  CHECK(margin(0.4, 0) == Approx(0.25).epsilon(1e-12));
  // Pressed on the stop by a load above the level it comes back to it however slow: no decision but the first.
  const GroundMotion pressed = loads({2, 2}, 10);
  const Slider slider(Coulomb(1), {.stops = Stops(0.5, 0.5, 0.5)});
  CHECK(margins_of(slider, pressed).impact > 0.01);
}
