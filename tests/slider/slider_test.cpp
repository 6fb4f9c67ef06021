// A slider: a law and a spring. When it holds, and how its spring brings it back.
#include <numbers>

#include "support/catch.hpp"
#include "support/motions.hpp"

using namespace stickslip;
using namespace test;

namespace {
constexpr double pi = std::numbers::pi;
}

TEST_CASE("a slider is its law and its spring", "[slider]") {
  const Slider slider(Coulomb(2, 3), 1.5);
  CHECK(slider.law().backward() == 3);
  CHECK(slider.natural_frequency() == 1.5);
  CHECK(slider.stiffness() == 2.25);
  CHECK(Slider(Coulomb(1)).stiffness() == 0);
}

TEST_CASE("Slider names the arguments that it rejects", "[slider][errors]") {
  const std::string rule = "Slider: natural_frequency must be finite and at least 0, got ";
  CHECK_THROWS_WITH(Slider(Coulomb(1), -1), rule + "-1 rad/s");
  CHECK_THROWS_WITH(Slider(Coulomb(1), not_a_number), rule + "nan rad/s");
  CHECK_THROWS_WITH(Slider(Coulomb(1), infinity), rule + "inf rad/s");
  CHECK_THROWS_WITH(Slider(Coulomb(1), 1e200), rule + "1e+200 rad/s");  // its square is not finite
  CHECK_THROWS_AS(Slider(Coulomb(1), -1), std::invalid_argument);
}

TEST_CASE("a slider at rest holds while load and spring stay within its levels", "[slider]") {
  // -1.5 <= -(n + wn^2 x) <= 1 with wn = 2, x = 0.25: n from -2 to 0.5.
  const Slider slider(Coulomb(1, 1.5), 2);
  for (const double n : {-2.0, -1.0, 0.0, 0.5})
    CHECK(count(integrate(slider, held(n, 5), from(0.25)).events) == Counts{});
  CHECK(integrate(slider, held(-2 - 0x1p-50, 1), from(0.25)).events[0].kind == EventKind::breakaway);
  CHECK(integrate(slider, held(0.5 + 0x1p-50, 1), from(0.25)).events[0].kind == EventKind::breakaway);
  CHECK(integrate(slider, held(-3, 1), from(0.25)).displacement[1] > 0.25);
  CHECK(integrate(slider, held(2, 1), from(0.25)).displacement[1] < 0.25);
}

TEST_CASE("a stretched spring rings down by twice the friction each swing, and sticks off center", "[slider]") {
  // values.json edge.spring_ringdown: 3.5 to -1.5 to -0.5, half a period each; it must not creep back to 0.
  for (const double sense : {1.0, -1.0}) {
    const Response r = integrate(Slider(Coulomb(1), 1), held(0, 4 * pi), from(3.5 * sense));
    CHECK(std::abs(r.residual + 0.5 * sense) <= 2e-15);
    REQUIRE(r.events.size() == 4);
    CHECK(r.events[0].kind == EventKind::breakaway);
    CHECK(r.events[1].kind == EventKind::reversal);
    CHECK(std::abs(r.events[1].displacement + 1.5 * sense) <= 2e-15);
    CHECK(std::abs(r.events[1].time - pi) <= 2e-15);
    CHECK(r.events[2].kind == EventKind::arrest);
    CHECK(std::abs(r.events[2].time - 2 * pi) <= 4e-15);
    CHECK(r.peak == 3.5);
    CHECK(r.state.mode == Mode::stuck);
  }
}

TEST_CASE("a spring that just balances friction where it stops holds there", "[slider]") {
  // values.json edge.spring_ringdown_tie: 3 to -1. Rounding decides whether it slips once more, by a rounding.
  const Response r = integrate(Slider(Coulomb(1), 1), held(0, 4 * pi), from(3));
  CHECK(std::abs(r.residual + 1) <= 2e-15);
  CHECK(r.state.mode == Mode::stuck);
}

TEST_CASE("a long ring-down ends within the band where friction holds the spring", "[slider]") {
  // Each half swing is 2 a / wn^2 shorter: from 1 m with a = 0.001, wn = 10: 50,000 swings in one segment.
  const Slider slider(Coulomb(0.001), 10);
  const Response r = integrate(slider, held(0, 1), from(1.0 + 0.3e-5, 0, true));
  CHECK(r.state.mode == Mode::stuck);
  CHECK(std::abs(r.residual) <= 1e-5);
  const Counts counts = count(r.events);
  CHECK(counts.breakaways == 1);
  CHECK(counts.arrests == 1);
  CHECK(counts.reversals == 49'999);
  // x is rounded twice a swing, its square by double that: 50,000 * 4 * 1.1e-16, if all go one way.
  CHECK(std::abs(r.energy.imbalance()) <= 2.2e-11 * r.energy.initial);
}

TEST_CASE("a spring that vanishes leaves the block alone, by the square of its frequency", "[slider]") {
  // The spring's force is at most wn^2 X; friction never drives two motions apart, so that x differs by at most
  // wn^2 X T^2 / 2.
  const GroundMotion motion = record_a();
  const Response none = integrate(Coulomb(1), motion);
  double last = infinity;
  for (const double frequency : {1e-1, 1e-2, 1e-3, 1e-4}) {
    const Response slow = integrate(Slider(Coulomb(1), frequency), motion);
    const double apart = difference(none.displacement, slow.displacement);
    CHECK(apart <= frequency * frequency * slow.peak * 40 * 40 / 2 + 1e-13 * none.peak);
    CHECK(apart <= last / 50);  // a hundredth, in the limit
    last = apart;
  }
  for (const double frequency : {1e-9, 1e-100, 1e-160, 1e-200}) {
    const Response slow = integrate(Slider(Coulomb(1), frequency), motion);
    CHECK(difference(none.displacement, slow.displacement) <= 1e-13 * none.peak);
    CHECK(count(none.events) == count(slow.events));
    const Response caster = integrate(Slider(Caster(1, 0.5), frequency), motion);
    CHECK(difference(caster.displacement, integrate(Caster(1, 0.5), motion).displacement) <= 1e-13 * none.peak);
  }
}

TEST_CASE("a very stiff spring lets the slider follow the load within its friction", "[slider]") {
  // -a <= -(n + wn^2 x) <= a but for the free swing, which starts with no speed: |x + n / wn^2| <= 2 a / wn^2.
  for (const double frequency : {1e4, 1e8, 1e50, 1e150}) {
    const GroundMotion motion = record_a();
    const Response r = integrate(Slider(Coulomb(1), frequency), motion);
    const double stiffness = frequency * frequency;
    double worst = 0;
    for (std::size_t i = 0; i < motion.samples(); ++i)
      worst = std::max(worst, std::abs(stiffness * r.displacement[i] + motion.acceleration()[i]));
    CHECK(worst <= 2);
    CHECK(worst > 0.5);
    CHECK(grammatical(r));
  }
}

TEST_CASE("a spring swings many times within one piece of the ground motion", "[slider]") {
  // wn = 50 for 1 s are eight periods. Under a steady pull without friction x = -n (1 - cos wn t) / wn^2.
  const Response free = integrate(Slider(Coulomb(0), 50), held(2, 1));
  CHECK(std::abs(free.residual + 2 * (1 - std::cos(50.0)) / 2500) <= 1e-16);
  CHECK(count(free.events) == Counts{1, 0, 15});
  // With friction each half swing loses 2 a / wn^2: from 0 to (n - a) 2 / wn^2, ...
  const Response braked = integrate(Slider(Coulomb(0.3), 50), held(-2, 1));
  std::vector<double> turns;
  for (const Event& e : braked.events)
    if (e.kind == EventKind::reversal || e.kind == EventKind::arrest) turns.push_back(e.displacement * 2500);
  REQUIRE(turns.size() == 3);  // 2 + 1.4, 2 - 0.8, 2 + 0.2
  CHECK(std::abs(turns[0] - 3.4) <= 1e-14);
  CHECK(std::abs(turns[1] - 1.2) <= 1e-14);
  CHECK(std::abs(turns[2] - 2.2) <= 1e-14);
  CHECK(braked.state.mode == Mode::stuck);
  // And the same in 97 pieces.
  const Response pieces = integrate(Slider(Coulomb(0.3), 50), GroundMotion(std::vector<double>(98, -2.0), 1.0 / 97));
  CHECK(std::abs(pieces.residual - braked.residual) <= 1e-15 * braked.peak * 8);
  CHECK(count(pieces.events) == count(braked.events));
}

TEST_CASE("settling under a steady pull over, a slider held off center by the ground is let go", "[slider]") {
  // wn^2 x = 3 with n = -2.5 and a = 1 holds; when the motion ends, 3 > 1 pulls it back: 3 to -1, where it sticks.
  const Slider slider(Coulomb(1), 1);
  const Response held_there = integrate(slider, held(-2.5, 1), from(3));
  CHECK(held_there.residual == 3);
  const Response settled = integrate(slider, held(-2.5, 1), from(3, 0, true));
  CHECK(std::abs(settled.residual + 1) <= 2e-15);
  CHECK(settled.displacement[1] == 3);
  REQUIRE(settled.displacement.size() == 6);  // at 2, 3, 4 and, after the rest at 1 + pi, 5 s
  CHECK(settled.displacement[2] == Approx(1 + 2 * std::cos(1)));
  CHECK(settled.displacement.back() == settled.residual);
  CHECK(settled.state.mode == Mode::stuck);
  CHECK(settled.events.front().kind == EventKind::breakaway);
  CHECK(settled.events.front().time == 1);
  CHECK(std::abs(settled.events.back().time - (1 + pi)) <= 4e-15);
}

TEST_CASE("in a cup a slider swings as a pendulum of the bowl's radius less the wheel's") {
  // (2.49) corrected; a seconds pendulum is g / pi^2 long.
  const double length = standard_gravity / (std::numbers::pi * std::numbers::pi);
  const auto seconds = Slider<Coulomb>::in_cup(Coulomb(0), length + 0.04, 0.04);
  CHECK(std::abs(seconds.natural_frequency() - std::numbers::pi) <= 1e-14);
  const Response half = integrate(seconds, GroundMotion(std::vector<double>{0, 0}, 1), from(0.01));
  CHECK(std::abs(half.residual + 0.01) <= 1e-15);
  CHECK(Slider<Caster>::in_cup(Caster(1, 0.1), 0.5).natural_frequency() == std::sqrt(standard_gravity / 0.5));
  CHECK(Slider<Coulomb>::in_cup(Coulomb(1), 1, 0, 0.3).damping() == 0.3);
  CHECK_THROWS_WITH(Slider<Coulomb>::in_cup(Coulomb(1), 0), "Slider: cup_radius must be positive and finite, got 0 m");
  CHECK_THROWS_WITH(Slider<Coulomb>::in_cup(Coulomb(1), 0.1, 0.1),
                    "Slider: wheel_radius must be at least 0 and less than the cup's 0.1 m, got 0.1 m");
  CHECK_THROWS_AS(Slider<Coulomb>::in_cup(Coulomb(1), not_a_number), std::invalid_argument);
}
