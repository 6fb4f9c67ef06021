#include "stickslip/sliding/effective.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "stickslip/sliding/integrate.hpp"
#include "support/catch.hpp"
#include "support/motions.hpp"

using namespace stickslip;
using namespace test;

namespace {

template <class S, class M>
Loop loop_of(const S& slider, const M& motion, const IntegrateOptions& options = {}) {
  return largest_loop(slider, motion, integrate(slider, motion, options));
}

}  // namespace

TEST_CASE("the largest loop on Coulomb friction has its closed form", "[effective]") {
  const double level = 0.5, wn = 2;
  const Slider slider(Coulomb(level), wn);
  const auto interpolation = GENERATE(Interpolation::linear, Interpolation::constant);
  const Loop loop = loop_of(slider, record_a(interpolation));
  CHECK(loop.force == Approx(wn * wn * loop.displacement + level).epsilon(1e-14));
  CHECK(loop.area == Approx(4 * level * loop.displacement).epsilon(1e-11));
  CHECK(loop.stiffness() == Approx(wn * wn + level / loop.displacement).epsilon(1e-14));
  CHECK(loop.damping() == Approx(2 / std::numbers::pi * level / (level + wn * wn * loop.displacement)).epsilon(1e-11));
  // a law that takes the Taylor flow
  const Loop same = loop_of(Slider(Disguised{level}, wn), record_a(interpolation));
  CHECK(same.area == Approx(loop.area).epsilon(1e-10));
}

TEST_CASE("a linear loop at resonance has the damping ratio", "[effective]") {
  const double ratio = 0.1, wn = 3;
  const Slider slider(Coulomb(0), wn, 2 * ratio * wn);
  // x'' + 2 ratio wn x' + wn^2 x = cos(wn t): x = sin(wn t) / (2 ratio wn^2)
  const HarmonicMotion motion(1, wn, 10, 0.01);
  const Loop loop = loop_of(slider, motion, from(0, 1 / (2 * ratio * wn)));
  CHECK(loop.displacement == Approx(1 / (2 * ratio * wn * wn)).epsilon(1e-9));
  CHECK(loop.period() == Approx(2 * std::numbers::pi / wn).epsilon(1e-12));
  // pi c wn D^2 of a cycle
  const double damping = 2 * ratio * wn;
  CHECK(loop.area == Approx(std::numbers::pi * damping * wn * loop.displacement * loop.displacement).epsilon(1e-9));
  CHECK(loop.damping() == Approx(ratio).epsilon(1e-9));
}

TEST_CASE("a weight that is not g changes the loop as it changes spring and friction", "[effective]") {
  // Under a constant vertical acceleration the levels are those times N/g, and so is the spring of a pendulum.
  const double level = 0.5, wn = 2, weight = 1.3;
  const std::vector<double> up(record_a().samples(), (weight - 1) * standard_gravity);
  const GroundMotion heavy = record_a(Interpolation::constant).with_components({}, up);
  for (const bool pendulum : {false, true}) {
    const Loop loop = loop_of(Slider(Coulomb(level), {.natural_frequency = wn, .pendulum = pendulum}), heavy);
    const double d = loop.displacement, stiffness = wn * wn * (pendulum ? weight : 1);
    CHECK(loop.stiffness() == Approx(stiffness + level * weight / d).epsilon(1e-12));
    CHECK(loop.area == Approx(4 * level * weight * d).epsilon(1e-10));
  }
  // Without it a pendulum is a spring.
  const Slider spring(Coulomb(level), wn), pendulum(Coulomb(level), {.natural_frequency = wn, .pendulum = true});
  const Loop one = loop_of(spring, record_a()), other = loop_of(pendulum, record_a());
  CHECK(other.period() == Approx(one.period()).epsilon(1e-10));
  CHECK(other.damping() == Approx(one.damping()).epsilon(1e-10));
}

TEST_CASE("on a slope the loop is about the position where the spring balances the weight", "[effective]") {
  // Pushed up the slope from there, by a velocity, against friction under N = g cos(slope).
  const double degrees = 10, wn = 2, level = 0.4, angle = degrees * std::numbers::pi / 180;
  const double center = standard_gravity * std::sin(angle) / (wn * wn), friction = level * std::cos(angle);
  const Slider slider(Coulomb(level), {.natural_frequency = wn, .slope_degrees = degrees});
  const Loop loop = loop_of(slider, line(0, 0, 3), from(center, -1));
  // wn^2 D^2 / 2 + a D = 1 / 2
  const double d = (std::sqrt(friction * friction + wn * wn) - friction) / (wn * wn);
  CHECK(loop.displacement == Approx(d).epsilon(1e-12));
  CHECK(loop.stiffness() == Approx(wn * wn + friction / d).epsilon(1e-12));
  CHECK(loop.area == Approx(4 * friction * d).epsilon(1e-12));
}

TEST_CASE("a stop is not in the loop that it ends", "[effective]") {
  const double level = 0.4, wn = 2, gap = 0.1;
  const Slider slider(Coulomb(level), {.natural_frequency = wn, .stops = Stops(gap, 0.5)});
  const Loop loop = loop_of(slider, line(0, 0, 3), from(0, 1));
  CHECK(loop.displacement == gap);
  CHECK(loop.stiffness() == Approx(wn * wn + level / gap).epsilon(1e-12));
  CHECK(loop.area == Approx(4 * level * gap).epsilon(1e-12));
}

TEST_CASE("what has no loop is refused with the reason", "[effective]") {
  const Slider slider(Coulomb(1), 2);
  const GroundMotion still = line(0, 0, 0.1);
  CHECK_THROWS_WITH(loop_of(Slider(Coulomb(1)), record_a()), Catch::Matchers::ContainsSubstring("on a spring"));
  CHECK_THROWS_WITH(loop_of(slider, still), Catch::Matchers::ContainsSubstring("never slips"));
  CHECK_THROWS_WITH(loop_of(slider, still, from(1)), Catch::Matchers::ContainsSubstring("at the start"));
  CHECK_THROWS_WITH(loop_of(slider, still, from(0, 1)), Catch::Matchers::ContainsSubstring("not over"));
}
