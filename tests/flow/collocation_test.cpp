// Laws of numbers alone: as exact as the Taylor series of the same laws.
#include "stickslip/flow/collocation.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <stdexcept>
#include <vector>

#include "stickslip/core.hpp"
#include "stickslip/numerics/collocation.hpp"
#include "support/catch.hpp"
#include "support/motions.hpp"
#include "support/size.hpp"

using namespace stickslip;
using namespace test;

namespace {

/// Another law by its numbers.
template <class Law>
struct ByNumbers {
  static constexpr bool numeric = true;
  Law law;

  double resist(double x, double speed, Direction direction) const {
    return stickslip::resist(law, x, speed, direction);
  }
  double hold(double x, Direction direction) const { return stickslip::hold(law, x, direction); }
};

/// 1 up to x = 0.1 m, 0.5 from 0.2 m on, and straight between.
struct Steps {
  static constexpr bool numeric = true;
  double resist(double x, double, Direction) const { return 1 - 5 * std::min(std::max(x - 0.1, 0.0), 0.1); }
};
/// Not a number above 0.05 m/s.
struct Broken {
  static constexpr bool numeric = true;
  double resist(double, double speed, Direction) const { return speed > 0.05 ? not_a_number : 1; }
};
/// Smooth in the displacement and in the speed.
struct Smooth {
  static constexpr bool numeric = true;
  double resist(double x, double speed, Direction) const {
    return (1 + 0.3 * std::tanh(10 * x)) * (1 - 0.3 * std::tanh(5 * speed));
  }
};

const VelocityDependent liner(0.3, 0.6, 50), weakening(0.9, 0.4, 20);
const Stribeck stribeck(0.8, 0.4, 0.05, 2);
const Caster caster(0.7, 0.4);

static_assert(form_of<ByNumbers<Caster>> == Form::numeric && form_of<Caster> != Form::numeric);

GroundMotion with_vertical() {
  std::vector<double> up;
  for (int m = 0; m <= 400; ++m) up.push_back(4 * std::cos(0.5 * m + 0.2));
  return GroundMotion(record_a_samples(), 0.1).with_components({}, up);
}

template <class Law>
void same_motion(const Law& law, const Mounting& mounting, const GroundMotion& motion) {
  const Response one = integrate(Slider<Law>(law, mounting), motion);
  const Response other = integrate(Slider<ByNumbers<Law>>({law}, mounting), motion);
  REQUIRE(other.events.size() == one.events.size());
  double scale = 0, worst = 0;
  for (std::size_t i = 0; i < one.displacement.size(); ++i) {
    scale = std::max(scale, std::abs(one.displacement[i]));
    worst = std::max(worst, std::abs(one.displacement[i] - other.displacement[i]));
  }
  CHECK(worst <= 1e-10 * scale);
  CHECK(std::abs(other.energy.imbalance()) <= 1e-10 * one.energy.input);
}

}  // namespace

TEST_CASE("collocation is exact for polynomials of its degree", "[collocation]") {
  const auto& nodes = numerics::Collocation<8>::get();
  numerics::Collocation<8>::Values values, powers;
  const double c[] = {1, -2, 0.5, 3, -1, 0.25, 2, -0.75, 1.5};
  const auto at = [&](double t) {
    double sum = 0;
    for (int k = 8; k >= 0; --k) sum = sum * t + c[k];
    return sum;
  };
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = at(nodes.nodes[i]);
  CHECK(nodes.powers(nodes.chebyshev(values), 0, powers) == 8);
  // The coefficients of powers may be off by the round-off of the values times some 1e5.
  for (std::size_t k = 0; k < powers.size(); ++k) CHECK(std::abs(powers[k] - c[k]) <= 1e-10);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double t = nodes.nodes[i];
    double single = 0, twice = 0, half = 0, by_integral = 0, by_double = 0, by_half = 0;
    for (std::size_t k = 0; k < values.size(); ++k) {
      const double n = static_cast<double>(k);
      single += c[k] * std::pow(t, n + 1) / (n + 1);
      twice += c[k] * std::pow(t, n + 2) / ((n + 1) * (n + 2));
      half += c[k] * std::pow(t, n + 0.5) * std::tgamma(n + 1) * std::tgamma(0.5) / std::tgamma(n + 1.5);
      by_integral += nodes.integral[i][k] * values[k];
      by_double += nodes.double_integral[i][k] * values[k];
      by_half += nodes.half_integral[i][k] * values[k];
    }
    CHECK(std::abs(by_integral - single) <= 1e-14);
    CHECK(std::abs(by_double - twice) <= 1e-14);
    CHECK(std::abs(by_half - half) <= 1e-14 * 4);
  }
}

TEST_CASE("a law by its numbers moves as by its series", "[collocation]") {
  const Mounting plain{}, spring{.natural_frequency = 2}, damped{.natural_frequency = 2, .damping = 0.4},
      slope{.slope_degrees = 1, .one_way = true}, stops{.natural_frequency = 2, .stops = Stops(0.1, 0.1, 0.5)};
  const std::vector<GroundMotion> motions{with_vertical(), record_a(), record_a(Interpolation::constant)};
  for (const GroundMotion& motion : std::span(motions).first(size(3, 1)))
    for (const Mounting& mounting : {plain, spring, damped, slope, stops}) {
      same_motion(liner, mounting, motion);
      same_motion(stribeck, mounting, motion);
      same_motion(caster, mounting, motion);
    }
  same_motion(weakening, spring, record_a());
  Mounting pendulum = Slider<VelocityDependent>::friction_pendulum(liner, 2).mounting();
  same_motion(liner, pendulum, with_vertical());
}

TEST_CASE("a law by its numbers under a harmonic motion", "[collocation]") {
  const HarmonicMotion motion(3, 6, 20);
  for (const double frequency : {0.0, 2.0}) {
    const Response one = integrate(Slider(caster, frequency), motion);
    const Response other = integrate(Slider(ByNumbers<Caster>{caster}, frequency), motion);
    CHECK(std::abs(other.peak - one.peak) <= 1e-10 * one.peak);
    CHECK(other.events.size() == one.events.size());
  }
}

TEST_CASE("kinks in a law by numbers are crossed", "[collocation]") {
  // Degrading has the same levels as long as the slider runs one way.
  const GroundMotion motion = line(0, -3, 2);
  const Response one = integrate(Slider<Degrading>(Degrading({0.1, 0.2}, {1, 0.5}), Mounting{.one_way = true}), motion);
  const Response other = integrate(Slider<Steps>({}, Mounting{.one_way = true}), motion);
  CHECK(one.peak > 0.25);
  CHECK(std::abs(other.peak - one.peak) <= 1e-10 * one.peak);
}

TEST_CASE("a law that is not a number is refused", "[collocation]") {
  REQUIRE_THROWS_AS(integrate(Broken{}, record_a()), ConvergenceError);
}

namespace {

/// A law with its series, and the same by its numbers alone, which records the range in which it is called and has no
/// level beyond a limit.
struct Growing {
  double by_x, by_speed;

  template <class X, class Speed>
  auto resist(const X& x, const Speed& speed, Direction) const {
    return 1 + by_x * (x * x) + by_speed * (speed * speed);
  }
};
struct Watched {
  static constexpr bool numeric = true;
  Growing law;
  double* farthest;
  double* fastest;
  double limit_x = infinity, limit_speed = infinity;

  double resist(double x, double speed, Direction direction) const {
    *farthest = std::max(*farthest, std::abs(x));
    *fastest = std::max(*fastest, speed);
    if (std::abs(x) > limit_x || speed > limit_speed) throw InvalidLevel("no level");
    return law.resist(x, speed, direction);
  }
};

}  // namespace

TEST_CASE("a law by its numbers is not called where no force of the step leads", "[collocation]") {
  const GroundMotion motion({1.26, 2.68, 1.7, -.85, -2.9, -1.5, .8, 2.2, 2.4, -2.3}, 0.05);
  for (const Growing law : {Growing{100, 0}, Growing{0, 20}, Growing{30, 5}})
    for (const double frequency : {0.0, 3.0, 15.0, 40.0}) {
      CAPTURE(law.by_x, law.by_speed, frequency);
      double farthest = 0, fastest = 0;
      const auto watched = [&](double limit_x, double limit_speed) {
        return Slider<Watched>({law, &farthest, &fastest, limit_x, limit_speed}, frequency);
      };
      const Response one = integrate(Slider(law, frequency), motion, from(0, 0, true));
      double highest = 0;
      for (const Event& e : one.events) highest = std::max(highest, std::abs(e.velocity));
      highest = std::max(highest, largest(one.velocity));
      const Response other = integrate(watched(infinity, infinity), motion, from(0, 0, true));
      CHECK(std::abs(other.residual - one.residual) <= 1e-9 * one.peak);
      // No load of 3 m/s^2 does more in the first second of the rest, the longest trial step.
      CHECK(farthest <= 1.5);
      CHECK(fastest <= 4);
      // An exception outside the motion changes the steps, not the motion.
      const Response limited = integrate(watched(1.05 * one.peak, 1.5 * highest), motion, from(0, 0, true));
      CHECK(std::abs(limited.residual - one.residual) <= 1e-9 * one.peak);

      State whole = State::at(0.01, 0.3), series = whole;
      advance(watched(infinity, infinity), Segment{1, 0, 0}, whole);  // one long step
      advance(Slider(law, frequency), Segment{1, 0, 0}, series);
      CHECK(std::abs(whole.displacement - series.displacement) <= 1e-9);
    }
}

TEST_CASE("where the motion itself leaves a law by its numbers, its exception is passed on", "[collocation]") {
  double farthest = 0, fastest = 0;
  State state = State::at(0, 0.3);
  const State before = state;
  const Growing law{1, 1};
  CHECK_THROWS_AS(advance(Slider<Watched>({law, &farthest, &fastest, 0.02}), Segment{1, 0, 0}, state), InvalidLevel);
  CHECK_THROWS_AS(advance(Slider<Watched>({law, &farthest, &fastest, infinity, 0.5}), Segment{1, -3, -3}, state),
                  InvalidLevel);
  CHECK_THROWS_AS(advance(Slider<Watched>({law, &farthest, &fastest, infinity, 0}), Segment{1, -3, -3}, state),
                  InvalidLevel);
  CHECK(state.displacement == before.displacement);
  CHECK(state.velocity == before.velocity);
}

TEST_CASE("a step from rest need not grow because its forces are rounded", "[collocation]") {
  // At breakaway the net acceleration is zero. Over a short step it stays below round-off of the load and the level.
  const Slider<Smooth> slider{Smooth{}};
  const detail::BareState state(State::at(0.02, 0));
  const double level = slider.law().resist(0.02, 0, Direction::forward);
  for (const double weight_gained : {0.0, 0.3, -0.3})
    for (double longest = 1e-2; longest > 1e-14; longest /= 4) {
      CAPTURE(longest, weight_gained);
      const LoadStart start{{0, 0, 2 - level * weight_gained}, 2, 0.9, weight_gained, level};
      detail::Cooling cooling;
      const CollocationFlow<Smooth, LoadStart> flow(slider, Direction::forward, state, start, 0.1, longest, cooling);
      CHECK(flow.horizon() == longest);
    }
}
