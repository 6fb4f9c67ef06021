// Sliders with any law in lanes give the results of a single slider: `advance_lanes` against `advance`, step by step.
#include "stickslip/lanes/series_lanes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <type_traits>
#include <vector>

#include "lanes/watch.hpp"
#include "support/catch.hpp"
#include "support/motions.hpp"

using namespace stickslip;
using namespace test;
using detail::LaneStates;
using detail::max_lanes;
using detail::SeriesLanes;

namespace {

/// Resists more one way, and more far away.
struct Ramp {
  double level;
  template <class T>
  auto resist(const T& x, Direction direction) const {
    return (direction == Direction::forward ? level : 1.5 * level) * (1 + x * x);
  }
};

/// Holds more than it resists.
struct StaticRamp : Ramp {
  double more;
  double hold(double x, Direction direction) const { return more * resist(x, direction); }
};

/// With each set of instructions that there is.
template <class Body>
void on_each_set(Body&& body) {
  body("baseline", [](const auto&... arguments) { detail::advance_lanes_anywhere(arguments...); });
#ifdef STICKSLIP_AVX2
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
    body("AVX2", [](const auto&... arguments) { detail::advance_lanes_avx2(arguments...); });
#endif
  body("this processor's", [](const auto&... arguments) { detail::advance_lanes(arguments...); });
}

/// Largest difference from `advance` of a step from the same state, by what moves in it; events too few fail.
template <class Law>
void compare(const char* name, const Slider<Law>& slider, double duration, double deviation, double tolerance) {
  on_each_set([&](const char* set, const auto& advance_lanes) {
    constexpr std::size_t steps = 150;
    std::mt19937_64 generator(7);
    std::normal_distribution<double> normal(0, deviation);
    std::vector<double> ground((steps + 1) * max_lanes), x(max_lanes), v(max_lanes), peak(max_lanes);
    for (double& n : ground) n = normal(generator);
    double worst_x = 0, worst_v = 0, worst_peak = 0;
    int events = 0;
    for (std::size_t k = 0; k < steps; ++k) {
      const double *const start = &ground[k * max_lanes], *const end = start + max_lanes;
      const std::vector<double> x0 = x, v0 = v;
      for (std::size_t i = 0; i < max_lanes; ++i) peak[i] = std::abs(x[i]);
      advance_lanes(SeriesLanes<Law>(slider, duration), max_lanes, start, end,
                    LaneStates{x.data(), v.data(), peak.data()});
      for (std::size_t i = 0; i < max_lanes; ++i) {
        State state = State::at(x0[i], v0[i]);
        Watch watch{std::abs(x0[i])};
        advance(slider, Segment{duration, start[i], end[i]}, state, watch);
        events += watch.events;
        const double unit_v = std::abs(v0[i]) + deviation * duration, unit_x = std::abs(x0[i]) + unit_v * duration;
        worst_v = std::max(worst_v, std::abs(v[i] - state.velocity) / unit_v);
        worst_x = std::max(worst_x, std::abs(x[i] - state.displacement) / unit_x);
        worst_peak = std::max(worst_peak, std::abs(peak[i] - watch.peak) / unit_x);
      }
    }
    INFO(name << ", " << set << ": x " << worst_x << ", v " << worst_v << ", peak " << worst_peak);
    CHECK(worst_x < tolerance);
    CHECK(worst_v < tolerance);
    CHECK(worst_peak < tolerance);
    CHECK(events > 900);
  });
}

}  // namespace

// A step leaves out 1e-14 of the largest term of its series, and is halved where that is more; stops and departures
// cost as much again. Without a power of x or speed in it, nothing is left out but round-off.
TEST_CASE("sliders of any law in lanes move as single ones, step by step", "[series_lanes]") {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  compare("spring", Slider<Coulomb>(Coulomb(1), 1.3), 0.1, 2, 1e-13);
  compare("stiff spring", Slider<Coulomb>(Coulomb(1), 10), 0.1, 2, 1e-13);
  compare("strong damper", Slider<Coulomb>(Coulomb(1), 1, 15), 0.1, 4, 1e-13);
  compare("spring and damper", Slider<Coulomb>(Coulomb(1), 1.3, 0.4), 0.1, 2, 1e-13);
  compare("damper, unequal levels", Slider<Coulomb>(Coulomb(1, 1.7), 0, 0.4), 0.1, 2, 1e-13);
  compare("one way, spring", Slider<Coulomb>(Coulomb(1, infinity), 1.3), 0.1, 2, 1e-13);
  compare("caster", Slider<Caster>(Caster(1, 1)), 0.1, 2, 1e-12);
  compare("caster, short reach", Slider<Caster>(Caster(1, 0.05)), 0.1, 2, 1e-11);
  compare("caster, spring", Slider<Caster>(Caster(1, 0.5), 1.3), 0.1, 2, 1e-12);
  compare("caster, spring, damper", Slider<Caster>(Caster(1, 0.5), 1.3, 0.2), 0.2, 2, 1e-12);
  compare("bump", Slider(Bump{1, 0.4}, 1.0), 0.1, 2, 1e-12);
  compare("ramp", Slider(Ramp{1}, 0.0), 0.1, 2, 1e-12);
  compare("ramp held", Slider(StaticRamp{{1}, 1.3}, 0.5), 0.1, 2, 1e-12);
  compare("weakening", Slider(RateDependent{1, 0.6, 0.1}, 1.0), 0.05, 2, 1e-12);
}

TEST_CASE("sliders in lanes are braked by what they cross within one step", "[series_lanes]") {
  // Far away the level has underflowed, and no coefficient of a series there tells of the bump in the middle.
  const auto check = [](const auto& slider, double from, double speed, double duration) {
    on_each_set([&](const char* set, const auto& advance_lanes) {
      std::vector<double> x(8, from), v(8, speed), peak(8), ground(8, 0.0);
      using Law = std::remove_cvref_t<decltype(slider.law())>;
      advance_lanes(SeriesLanes<Law>(slider, duration), 8, ground.data(), ground.data(),
                    LaneStates{x.data(), v.data(), peak.data()});
      State state = State::at(from, speed);
      advance(slider, Segment{duration, 0, 0}, state);
      INFO(set);
      CHECK(v[3] == Approx(state.velocity).epsilon(1e-12));
      CHECK(std::abs(v[3]) < std::abs(speed) * (1 - 1e-5));
    });
  };
  check(Slider(Bump{5, 0.003}), -0.1, 10, 0.02);
  check(Slider(Bump{5, 0.003}), 0.1, -10, 0.02);
  check(Slider(Caster(5, 1e-5), 1.0), -0.008, 2, 0.01);
}

TEST_CASE("a row of a few sliders in lanes moves as any other", "[series_lanes]") {
  on_each_set([](const char* set, const auto& advance_lanes) {
    std::vector<double> x(8, 0.0), v(8, 1.0), peak(8), start(8, -1.0), end(8, 3.0);
    const Slider<Coulomb> slider(Coulomb(1), 1.0);
    advance_lanes(SeriesLanes<Coulomb>(slider, 0.5), 3, start.data(), end.data(),
                  LaneStates{x.data(), v.data(), peak.data()});
    State state = State::at(0, 1);
    advance(slider, Segment{0.5, -1, 3}, state);
    INFO(set);
    for (std::size_t i = 0; i < 3; ++i) CHECK(v[i] == Approx(state.velocity).epsilon(1e-12));
  });
}
