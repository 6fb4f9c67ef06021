// The motion between samples.
#include "stickslip/sliding/trajectory.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "stickslip/core.hpp"
#include "support/catch.hpp"
#include "support/laws.hpp"
#include "support/motions.hpp"

using namespace stickslip;
using namespace test;

namespace {

std::vector<Mounting> mountings() {
  return {{},
          {.natural_frequency = 3, .damping = 0.2, .stops = Stops(0.03, 0.05, 0.5)},
          {.natural_frequency = 3, .slope_degrees = 2, .one_way = true},
          {.natural_frequency = 2.5, .pendulum = true}};
}

// A motion, and the same motion with two more samples in each step: after a third, and after two thirds.
GroundMotion shaken() {
  std::vector<double> up = gaussian(8, 40, 7, true);
  up.back() = 0;
  return GroundMotion(gaussian(7, 40, 2, true), 0.06).with_components({}, up);
}
GroundMotion thirds(const GroundMotion& motion) {
  const auto finer = [](std::span<const double> from) {
    std::vector<double> to;
    for (std::size_t i = 0; i + 1 < from.size(); ++i)
      for (int k = 0; k < 3; ++k) to.push_back(std::lerp(from[i], from[i + 1], k / 3.0));
    to.push_back(from.back());
    return to;
  };
  return GroundMotion(finer(motion.acceleration()), motion.dt() / 3).with_components({}, finer(motion.vertical()));
}

}  // namespace

TEST_CASE("the motion between samples is that of a motion with more samples", "[trajectory]") {
  const GroundMotion motion = shaken(), finer = thirds(motion);
  for_each_law([&](const auto& example) {
    for (const Mounting& mounting : mountings()) {
      INFO(example.name << ", natural frequency " << mounting.natural_frequency);
      const Slider slider(example.law, taken_by(example.law, mounting));
      const IntegrateOptions from{.displacement = 0.01, .velocity = 0.1, .may_end_in_flight = true};
      const Response coarse = integrate(slider, motion, from), fine = integrate(slider, finer, from);
      std::vector<double> times;
      for (std::size_t i = fine.displacement.size(); i-- > 0;)
        times.push_back(std::min(finer.time(i), motion.time(39)));
      const std::vector<State> states = states_at(slider, motion, coarse, times);
      double worst = 0;
      for (std::size_t i = 0; i < times.size(); ++i)
        worst = std::max(worst, std::abs(states[i].displacement - fine.displacement[times.size() - 1 - i]));
      CHECK(worst <= 10 * example.accuracy * std::max(fine.peak, 0.1));
    }
  });
}

namespace {

/// Checks the arcs of a trajectory against each other and against the equation of motion.
struct Checks final : TrajectoryReader {
  explicit Checks(const Trajectory& one) : trajectory(one), now(one.begin()) {}

  void arc(const Arc& arc) override {
    const Mounting& on = trajectory.mounting();
    gap = std::max(gap, std::abs(arc.begin - now));
    now = arc.end;
    duration += arc.duration;
    const State last = arc.at(arc.duration);
    if (place) jump = std::max(jump, std::abs(arc.start.displacement - *place));
    place = last.displacement;
    if (landed) dissipated += (*landed * *landed - arc.start.velocity * arc.start.velocity) / 2;
    landed.reset();
    const auto energy = [&](const State& at) { return at.velocity * at.velocity / 2 + trajectory.elastic(at); };
    dissipated += arc.work - (energy(last) - energy(arc.start));
    if (arc.rests()) return;
    for (const double part : {0.2, 0.7}) {
      const double t = part * arc.duration, weight = arc.weight(t);
      const State at = arc.at(t);
      const Direction direction = direction_of(at.mode);
      const double opposes = sign(direction) * weight * trajectory.resist(at, weight, direction) +
                             on.damping * at.velocity + trajectory.pull(at.displacement, weight);
      const double p = arc.load(t).load, scale = std::abs(p) + std::abs(opposes);
      unbalanced = std::max(unbalanced, std::abs(arc.acceleration(t) + opposes - p) / scale);
    }
  }
  void event(EventKind kind, double time, const State& state, const Load&) override {
    if (kind == EventKind::landing) landed = state.velocity;
    if (kind == EventKind::end) gap = std::max(gap, std::abs(time - now));
  }

  const Trajectory& trajectory;
  double now, gap = 0, duration = 0, jump = 0, unbalanced = 0, dissipated = 0;
  std::optional<double> place, landed;
};

}  // namespace

TEST_CASE("the arcs of a trajectory follow each other, and balance forces and energy", "[trajectory]") {
  const GroundMotion motion = shaken();
  for_each_law([&](const auto& example) {
    for (const Mounting& mounting : mountings()) {
      INFO(example.name << ", natural frequency " << mounting.natural_frequency);
      const Slider slider(example.law, taken_by(example.law, mounting));
      const Response r = integrate(slider, motion, {.displacement = 0.01, .velocity = 0.1, .may_end_in_flight = true});
      const auto one = trajectory(slider, motion, r);
      Checks found(*one);
      one->read(found, one->end());
      CHECK(found.gap <= 1e-14);
      CHECK(found.duration == Approx(one->end() - one->begin()).epsilon(1e-12));
      CHECK(found.jump <= 10 * example.accuracy * std::max(r.peak, 0.1));
      // The accuracy is that of x over its scale: the acceleration, its second derivative, has fewer digits.
      CHECK(found.unbalanced <= 1e4 * example.accuracy);
      const double input = r.energy.dissipated + r.energy.damped;
      CHECK(std::abs(found.dissipated - input) <= 100 * example.accuracy * (input + r.energy.initial + 1));
    }
  });
}

TEST_CASE("a state at the time of an event has its position", "[trajectory]") {
  const GroundMotion motion = shaken();
  const Slider slider(Coulomb(1), Mounting{.natural_frequency = 3, .stops = Stops(0.03, 0.02, 0.5)});
  const Response r = integrate(slider, motion, {.settle = true});
  std::vector<double> times;
  for (const Event& e : r.events) times.push_back(e.time);
  const std::vector<State> states = states_at(slider, motion, r, times);
  for (std::size_t i = 0; i < times.size(); ++i)
    CHECK(std::abs(states[i].displacement - r.events[i].displacement) < 1e-11);
  CHECK(states.back().mode == Mode::stuck);
}

TEST_CASE("the motion under a cosine is known between samples", "[trajectory]") {
  const HarmonicMotion coarse(2, 7, 3, 1.0), fine(2, 7, 3, 0.125);
  const Slider slider(Coulomb(1), Mounting{.natural_frequency = 4});
  const Response few = integrate(slider, coarse, {.settle = true}), many = integrate(slider, fine, {.settle = true});
  std::vector<double> times;
  for (std::size_t i = 0; i < fine.samples(); ++i) times.push_back(fine.time(i));
  const std::vector<State> states = states_at(slider, coarse, few, times);
  for (std::size_t i = 0; i < times.size(); ++i) {
    CHECK(std::abs(states[i].displacement - many.displacement[i]) <= 1e-11);
    CHECK(std::abs(states[i].velocity - many.velocity[i]) <= 1e-10);
  }
}

TEST_CASE("a time outside a response is refused by its value", "[trajectory]") {
  const GroundMotion motion({0, -3, 0}, 0.5);
  const Response r = integrate(Coulomb(1), motion);
  for (const double time : {-0.1, 1.1, infinity, not_a_number})
    CHECK_THROWS_AS(states_at(Coulomb(1), motion, r, std::vector{time}), std::invalid_argument);
  CHECK_THROWS_WITH(states_at(Coulomb(1), motion, r, std::vector{1.5}),
                    Catch::Matchers::ContainsSubstring("from 0 to 1 s") && Catch::Matchers::ContainsSubstring("1.5"));
}
