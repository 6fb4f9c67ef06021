// Casters side by side do what one caster does: `advance_lanes` against `advance`, step by step.
#include "lanes/caster_lanes.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "lanes/instruction_sets.hpp"
#include "lanes/watch.hpp"
#include "stickslip/sliding/advance.hpp"
#include "support/catch.hpp"

using namespace stickslip;
using detail::max_lanes;
using test::Watch;

namespace {

struct Case {
  double slip_level, reach, deviation, duration;
};

}  // namespace

// A step leaves out 1e-13 of the velocity's unit, a reach a step, by an estimate that falls short by up to two hundred
// where terms cancel: 3e-11 is allowed. `advance` is nearer by orders. Each step starts from the lanes' own state, so
// errors do not add up; over a whole motion see the next case.
TEST_CASE("casters in lanes move as single ones, step by step, on every instruction set", "[caster_lanes]") {
  test::on_each_instruction_set([](const std::string& set) {
    for (const Case& c : {Case{1, 1, 2, 0.1}, Case{1, 1, 2, 0.5}, Case{1, 1, 2, 1}, Case{1, 0.2, 2, 0.1},
                          Case{1, 5, 3, 0.3}, Case{1, 1, 0.7, 0.3}, Case{0, 1, 1, 0.2}, Case{2, 1e6, 4, 0.1}}) {
      constexpr std::size_t steps = 150;
      std::mt19937_64 generator(7);
      std::normal_distribution<double> normal(0, c.deviation);
      std::vector<double> ground((steps + 1) * max_lanes), x(max_lanes), v(max_lanes), peak(max_lanes);
      for (double& n : ground) n = normal(generator);
      const Caster law(c.slip_level, c.reach);
      const Slider<Caster> slider(law);
      double worst_x = 0, worst_v = 0;
      int events = 0, wrong_peaks = 0;
      for (std::size_t k = 0; k < steps; ++k) {
        const double* const start = &ground[k * max_lanes];
        const double* const end = start + max_lanes;
        const std::vector<double> x0 = x, v0 = v;
        for (std::size_t i = 0; i < max_lanes; ++i) peak[i] = std::abs(x[i]);
        detail::advance_lanes(detail::CasterLanes{law, c.duration}, max_lanes, start, end,
                              {x.data(), v.data(), peak.data()});
        for (std::size_t i = 0; i < max_lanes; ++i) {
          State state = State::at(x0[i], v0[i]);
          Watch watch{std::abs(x0[i])};
          advance(slider, Segment{c.duration, start[i], end[i]}, state, watch);
          events += watch.events;
          // What is far away has lost the digits of a reach.
          const double unit_x = c.reach + std::abs(state.displacement) * 1e-3;
          const double unit_v = c.reach / c.duration + std::abs(state.velocity) * 1e-3;
          worst_x = std::max(worst_x, std::abs(x[i] - state.displacement) / unit_x);
          worst_v = std::max(worst_v, std::abs(v[i] - state.velocity) / unit_v);
          if (watch.peak > 0 && std::abs(peak[i] - std::max(watch.peak, std::abs(x[i]))) > 3e-11 * unit_x)
            ++wrong_peaks;
        }
      }
      INFO(set << ": slip level " << c.slip_level << ", reach " << c.reach << ", deviation " << c.deviation << ", step "
               << c.duration << ": " << worst_x * 1e12 << "e-12, " << worst_v * 1e12 << "e-12");
      CHECK(worst_x < 3e-11);
      CHECK(worst_v < 3e-11);
      CHECK(wrong_peaks == 0);
      if (c.slip_level > 0) CHECK(events > 100);
    }
  });
}

TEST_CASE("after a thousand steps casters in lanes are within 1e-9 of single ones", "[caster_lanes]") {
  constexpr std::size_t steps = 1000;
  std::mt19937_64 generator(11);
  std::normal_distribution<double> normal(0, 1);
  std::vector<double> ground((steps + 1) * max_lanes), x(max_lanes), v(max_lanes), peak(max_lanes);
  for (std::size_t i = 0; i < max_lanes; ++i) {  // an autoregressive motion, of standard deviation 2
    double last = 0;
    for (std::size_t k = 0; k <= steps; ++k) ground[k * max_lanes + i] = last = 0.8 * last + 1.2 * normal(generator);
  }
  const Caster law(1, 1);
  for (std::size_t k = 0; k < steps; ++k)
    detail::advance_lanes(detail::CasterLanes{law, 0.1}, max_lanes, &ground[k * max_lanes],
                          &ground[(k + 1) * max_lanes], {x.data(), v.data(), peak.data()});
  for (std::size_t i = 0; i < max_lanes; ++i) {
    State state;
    for (std::size_t k = 0; k < steps; ++k)
      advance(Slider<Caster>(law), Segment{0.1, ground[k * max_lanes + i], ground[(k + 1) * max_lanes + i]}, state);
    CHECK(std::abs(x[i] - state.displacement) < 1e-9 * std::max(1.0, std::abs(state.displacement)));
  }
}

TEST_CASE("a fast caster that crosses the origin within one step is braked there", "[caster_lanes]") {
  // It comes from 30 reaches away, where a series sees no friction, at 40 reaches a step.
  const Caster law(50, 1);
  std::vector<double> x(8, -30), v(8, 40), peak(8), ground(8, 0.0);
  detail::advance_lanes(detail::CasterLanes{law, 1}, 8, ground.data(), ground.data(),
                        {x.data(), v.data(), peak.data()});
  // Energy: v^2/2 falls by the work against friction, a l times pi, from far left to (nearly) far right.
  const double expected = std::sqrt(40 * 40 - 2 * law.work(-30, x[0] + 30, Direction::forward));
  CHECK(v[0] == Approx(expected).epsilon(1e-11));
  CHECK(v[0] < 36.2);
}

TEST_CASE("a caster in lanes is held by the level at its place", "[caster_lanes]") {
  const Caster law(1, 1);
  const double level = law.resist(1.5, Direction::forward);
  std::vector<double> x(8, 1.5), v(8, 0.0), peak(8), under(8, -0.999 * level), over(8, -1.001 * level);
  detail::advance_lanes(detail::CasterLanes{law, 0.1}, 8, under.data(), under.data(),
                        {x.data(), v.data(), peak.data()});
  CHECK(x[3] == 1.5);
  CHECK(v[3] == 0);
  detail::advance_lanes(detail::CasterLanes{law, 0.1}, 8, over.data(), over.data(), {x.data(), v.data(), peak.data()});
  CHECK(x[3] > 1.5);
  CHECK(v[3] > 0);
}
