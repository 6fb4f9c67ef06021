// What holds for every friction law on every mounting.
#include <cmath>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "stickslip/core.hpp"
#include "support/catch.hpp"
#include "support/laws.hpp"
#include "support/motions.hpp"
#include "support/size.hpp"

using namespace stickslip;
using namespace test;

namespace {

struct Named {
  const char* name;
  Mounting mounting;
  bool level = true;    // and both ways: it has a mirror image, and no weight in it
  double vertical = 0;  // root mean square of the vertical acceleration [m/s^2]
};

const std::vector<Named>& mountings() {
  static const std::vector<Named> list{
      {"none", {}},
      {"spring", {.natural_frequency = 4}},
      {"spring and damper", {.natural_frequency = 4, .damping = 0.5}},
      {"stops", {.natural_frequency = 2, .stops = Stops(0.03, 0.05, 0.5)}},
      {"dead stops", {.stops = Stops(0.02, 0)}},
      {"slope", {.natural_frequency = 3, .slope_degrees = 2}, false},
      {"one way", {.natural_frequency = 3, .one_way = true}, false},
      {"pendulum under vertical motion", {.natural_frequency = 2.5, .pendulum = true}, false, 1},
      {"flight", {.natural_frequency = 1, .stops = Stops(0.2, 0.3)}, false, 9},
  };
  return list;
}

GroundMotion ground(std::uint64_t seed, double vertical) {
  const std::size_t samples = size(120, 30);
  std::vector<double> n = gaussian(seed, samples, 2, true);
  GroundMotion motion(n, 0.05);
  if (vertical == 0) return motion;
  std::vector<double> up = gaussian(seed + 1, samples, vertical, true);
  up.back() = 0;
  return motion.with_components({}, up);
}

// The same ground with a sample in the middle of each segment.
GroundMotion halved(const GroundMotion& motion) {
  const auto finer = [](std::span<const double> from) {
    std::vector<double> to;
    for (std::size_t i = 0; i + 1 < from.size(); ++i) {
      to.push_back(from[i]);
      to.push_back((from[i] + from[i + 1]) / 2);
    }
    if (!from.empty()) to.push_back(from.back());
    return to;
  };
  return GroundMotion(finer(motion.acceleration()), motion.dt() / 2).with_components({}, finer(motion.vertical()));
}

std::vector<double> times(double factor, std::span<const double> values) {
  std::vector<double> result(values.begin(), values.end());
  for (double& value : result) value *= factor;
  return result;
}

// Calls `work(example, slider, motion)` for each law on each mounting; `work` may capture nothing of the loop.
template <class Work>
void for_each_slider(Work&& work) {
  for_each_law([&](const auto& example) {
    for (const Named& on : mountings()) {
      if (taken_by(example.law, on.mounting) != on.mounting) continue;
      INFO(example.name << ", " << on.name);
      work(example, on, Slider(example.law, on.mounting), ground(11, on.vertical));
    }
  });
}

// Whether `integrate` gives the motion of the segments one by one.
template <class Example, class Slider>
void same_one_by_one(const Example& example, const Named& on, const Slider& slider, const GroundMotion& motion) {
  const Response r = integrate(slider, motion, {.may_end_in_flight = true});
  State state;
  std::vector<double> x{0}, v{0};
  const detail::LoadPieces pieces(motion, slider.slope());
  for (std::size_t i = 0; i < motion.segments(); ++i) {
    if (motion.has_vertical())
      advance(slider, pieces.segment(i), state);
    else
      advance(slider, motion.segment(i), state);
    x.push_back(state.displacement);
    v.push_back(state.velocity);
  }
  CHECK(difference(x, r.displacement) <= 10 * example.accuracy * r.peak);
  CHECK(state.in_flight == r.state.in_flight);
  CHECK(state.mode == r.state.mode);
  CHECK(state.sliding_distance == Approx(r.state.sliding_distance).epsilon(1e-6));
  CHECK((on.vertical > 0 || !state.in_flight));
  for (std::size_t i = 0; i < v.size(); ++i) CHECK((v[i] == 0) == (r.velocity[i] == 0));
}

}  // namespace

TEST_CASE("what the ground does on a slider is dissipated, lost in impacts, or still there", "[axioms]") {
  for_each_slider([](const auto& example, const Named&, const auto& slider, const GroundMotion& motion) {
    const auto far = resist(law_at(example.law, State{}), 1e3, 0.0, Direction::forward);
    const Mounting& mounting = slider.mounting();
    const bool rests = far > 0 || mounting.natural_frequency > 0 || mounting.stops;  // others may escape
    for (const bool settle : {false, rests}) {
      const Response r = integrate(slider, motion, {.settle = settle, .may_end_in_flight = true});
      CHECK(r.peak > 1e-3);
      CHECK(r.energy.dissipated > 0);
      CHECK(r.energy.impact >= 0);
      CHECK(r.energy.damped >= 0);
      CHECK(std::abs(r.energy.imbalance()) <= example.accuracy * turnover(r.energy));
      if (settle) CHECK(r.state.mode == Mode::stuck);
    }
  });
}

TEST_CASE("a mirrored slider on mirrored ground moves in mirror image", "[axioms]") {
  for_each_slider([](const auto& example, const Named& on, const auto& slider, const GroundMotion& motion) {
    if (!on.level) return;
    Mounting turned = on.mounting;
    if (const Stops s = turned.stops) turned.stops = Stops(s.backward(), s.forward(), s.restitution());
    const GroundMotion mirrored(times(-1, motion.acceleration()), motion.dt());
    const Response one = integrate(slider, motion),
                   other = integrate(Slider(example.mirror(example.law), turned), mirrored);
    CHECK(difference(one.displacement, times(-1, other.displacement)) <= example.accuracy * one.peak);
    CHECK(one.events.size() == other.events.size());
  });
}

TEST_CASE("lengths and times that are measured in other units change nothing else", "[axioms]") {
  for_each_slider([](const auto& example, const Named& on, const auto& slider, const GroundMotion& motion) {
    if constexpr (!std::is_same_v<std::remove_cvref_t<decltype(example.scale)>, std::nullptr_t>) {
      if (!on.level) return;
      const double length = 8, time = 0.5;  // powers of two: no rounding
      Mounting scaled = on.mounting;
      scaled.natural_frequency /= time;
      scaled.damping /= time;
      if (const Stops s = scaled.stops)
        scaled.stops = Stops(s.forward() * length, s.backward() * length, s.restitution());
      const GroundMotion there(times(length / (time * time), motion.acceleration()), motion.dt() * time);
      const Response one = integrate(slider, motion);
      const Response other = integrate(Slider(example.scale(example.law, length, time), scaled), there);
      CHECK(difference(times(length, one.displacement), other.displacement) <= example.accuracy * other.peak);
      CHECK(one.events.size() == other.events.size());
    }
  });
}

TEST_CASE("a ground motion may be cut anywhere", "[axioms]") {
  for_each_slider([](const auto& example, const Named&, const auto& slider, const GroundMotion& motion) {
    const IntegrateOptions options{.may_end_in_flight = true};
    const Response one = integrate(slider, motion, options), other = integrate(slider, halved(motion), options);
    std::vector<double> every_other;
    for (std::size_t i = 0; i < other.displacement.size(); i += 2) every_other.push_back(other.displacement[i]);
    CHECK(difference(one.displacement, every_other) <= 100 * example.accuracy * one.peak);
    CHECK(one.events.size() == other.events.size());
  });
}

TEST_CASE("what the ground does later changes nothing before", "[axioms]") {
  for_each_slider([](const auto&, const Named&, const auto& slider, const GroundMotion& motion) {
    const std::size_t kept = motion.samples() / 2;
    const std::span<const double> up = motion.vertical();
    const GroundMotion before =
        GroundMotion({motion.acceleration().begin(), motion.acceleration().begin() + kept}, motion.dt())
            .with_components({}, {up.begin(), up.empty() ? up.end() : up.begin() + kept});
    const IntegrateOptions options{.contact = Contact::clipped};
    const Response whole = integrate(slider, motion, options), part = integrate(slider, before, options);
    CHECK(std::vector(whole.displacement.begin(), whole.displacement.begin() + kept) == part.displacement);
  });
}

TEST_CASE("a state holds all that matters: segments one by one give the same motion", "[axioms]") {
  for_each_slider([](const auto& example, const Named& on, const auto& slider, const GroundMotion& motion) {
    same_one_by_one(example, on, slider, motion);
  });
}

TEST_CASE("many segments at rest are passed as one by one, also under loads equal to the level", "[axioms]") {
  for_each_slider([](const auto& example, const Named& on, const auto& slider, const GroundMotion& motion) {
    // Strong for two of twelve samples, and equal to what is held in one of the others.
    std::vector<double> n(motion.acceleration().begin(), motion.acceleration().end());
    const double holds = hold(law_at(example.law, State{}), 0, Direction::forward);
    for (std::size_t i = 0; i < n.size(); ++i) n[i] = i % 12 < 2 ? n[i] : i % 12 == 8 ? -holds : 0.05 * n[i];
    for (const Interpolation between : {Interpolation::linear, Interpolation::constant}) {
      const GroundMotion quiet = GroundMotion(n, motion.dt(), between)
                                     .with_components({}, {motion.vertical().begin(), motion.vertical().end()});
      same_one_by_one(example, on, slider, quiet);
    }
  });
}

TEST_CASE("nothing moves while the load is within what holds at rest", "[axioms]") {
  for_each_law([](const auto& example) {
    INFO(example.name);
    const double holds = std::min(hold(law_at(example.law, State{}), 0, Direction::forward),
                                  hold(law_at(example.law, State{}), 0, Direction::backward));
    const GroundMotion motion = ground(3, 0);
    const GroundMotion weak(times(holds / motion.peak_acceleration(), motion.acceleration()), motion.dt());
    const GroundMotion strong(times(1.2 * holds / motion.peak_acceleration(), motion.acceleration()), motion.dt());
    for (const Mounting& on : {Mounting{}, Mounting{.natural_frequency = 5, .damping = 1}}) {
      CHECK(integrate(Slider(example.law, on), weak).sliding_distance == 0);
      CHECK(integrate(Slider(example.law, on), strong).sliding_distance > 0);
    }
  });
}
