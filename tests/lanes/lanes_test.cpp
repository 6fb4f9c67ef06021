// Many blocks side by side do what one block does: `advance_lanes` against `advance`, on hard input.
#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <random>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "lanes/coulomb_lanes.hpp"
#include "lanes/instruction_sets.hpp"
#include "stickslip/ensemble/run.hpp"
#include "support/catch.hpp"
#include "support/motions.hpp"

using namespace stickslip;
using namespace test;
using detail::CoulombLanes;
using detail::LaneAccount;
using detail::LaneEvent;
using detail::max_lanes;

namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

/// What happens within segments.
struct Watch {
  double peak = 0, work = 0;
  std::vector<Event> events{};
  void slide(const Slip& slip) {
    peak = std::max(peak, std::abs(slip.to()));
    work += slip.work;
  }
  void event(EventKind kind, double time, const State& state) {
    events.push_back({time, state.displacement, state.velocity, kind});
  }
  auto count(EventKind kind) const { return std::ranges::count(events, kind, &Event::kind); }
  auto reversals() const { return count(EventKind::reversal); }
  auto arrests() const { return count(EventKind::arrest); }
  auto breakaways() const { return count(EventKind::breakaway); }
};

struct Case {
  const char* name;
  double forward, backward;
  double duration = 0.1;
  bool held = false;
  bool smooth = false;
  double scale = 1;  // of accelerations
};

/// How often the input was hard.
struct Hard {
  std::ptrdiff_t double_reversals = 0, dips = 0, stops_and_goes = 0, at_level = 0, indistinct = 0;
};

/// Ground accelerations of a lane: Gaussian of twice the level, and now and then a zero, the level itself (of either
/// sign) or the value before.
std::vector<double> hard_ground(std::uint64_t seed, std::size_t samples, const Case& c) {
  const double level = c.forward > 0 ? c.forward : 1;
  std::vector<double> n = gaussian(seed, samples, 2 * level, c.smooth);
  std::mt19937_64 bits(seed);
  for (std::size_t i = 0; i < samples; ++i) switch (bits() % 24) {
      case 0:
        n[i] = 0;
        break;
      case 1:
        n[i] = -c.forward;
        break;
      case 2:
        n[i] = std::isfinite(c.backward) ? c.backward : 1;
        break;
      case 3:
        n[i] = i > 0 ? n[i - 1] : 0;
        break;
      default:
        break;
    }
  for (double& value : n) value *= c.scale;
  return n;
}

/// Each segment from the same state in both; returns the largest error in roundings (epsilon) of what moves them.
double compare(const Case& c, std::size_t segments, Hard& hard) {
  const Slider<Coulomb> slider(Coulomb(c.forward * c.scale, c.backward * c.scale));
  const CoulombLanes lanes{slider.law().forward(), slider.law().backward(), c.duration};
  std::vector<std::vector<double>> ground;
  for (std::uint64_t lane = 0; lane < max_lanes; ++lane) ground.push_back(hard_ground(lane, segments + 1, c));

  std::array<State, max_lanes> state{};
  std::array<double, max_lanes> x{}, v{}, peak{}, start{}, end{}, work{};
  std::array<std::array<LaneEvent, LaneAccount::max_events>, max_lanes> events{};
  std::array<LaneEvent*, max_lanes> next{};
  constexpr std::array<double, max_lanes> no_work{};
  double worst = 0;
  for (std::size_t i = 0; i < segments; ++i) {
    for (std::size_t lane = 0; lane < max_lanes; ++lane) {
      start[lane] = ground[lane][i];
      end[lane] = c.held ? start[lane] : ground[lane][i + 1];
      x[lane] = peak[lane] = state[lane].displacement;
      v[lane] = state[lane].velocity;
      peak[lane] = std::abs(peak[lane]);
    }
    auto with_x = x, with_v = v;
    detail::advance_lanes(lanes, max_lanes, start.data(), end.data(), {x.data(), v.data(), peak.data()});
    for (std::size_t lane = 0; lane < max_lanes; ++lane) next[lane] = events[lane].data();
    LaneAccount account{static_cast<std::uint32_t>(i), next.data(), no_work.data(), work.data(), 0};
    auto told_x = with_x, told_v = with_v, told_peak = peak;
    detail::advance_lanes(lanes, start.data(), end.data(), {with_x.data(), with_v.data(), told_peak.data()},
                          {told_x.data(), told_v.data(), told_peak.data()}, &account);
    if (told_x != x || told_v != v) worst = infinity;  // who looks on changes nothing
    for (std::size_t lane = 0; lane < max_lanes; ++lane) {
      const State before = state[lane];
      Watch watch{.peak = std::abs(before.displacement)};
      advance(slider, Segment{c.duration, start[lane], end[lane]}, state[lane], watch);
      const double level = std::isfinite(lanes.backward) ? std::max(lanes.forward, lanes.backward) : lanes.forward;
      const double dv = (std::abs(start[lane]) + std::abs(end[lane]) + level) * c.duration;
      const double v_scale = std::abs(before.velocity) + dv,
                   x_scale = std::abs(before.displacement) + v_scale * c.duration;
      const State& after = state[lane];
      if (v_scale > 0) {
        const double dx_error = std::abs(x[lane] - after.displacement), peak_error = std::abs(peak[lane] - watch.peak);
        worst =
            std::max({worst, std::abs(v[lane] - after.velocity) / v_scale, dx_error / x_scale, peak_error / x_scale});
        if (!(dx_error + peak_error + std::abs(v[lane]) < infinity)) worst = infinity;
      }
      const double load = std::max(std::abs(start[lane]), std::abs(end[lane]));
      if ((account.indistinct >> lane & 1) != 0) {
        ++hard.indistinct;
      } else if (before.velocity != 0 || before.mode == Mode::stuck) {  // not half way in a reversal
        worst = std::max(worst, std::abs(work[lane] - watch.work) / std::max(load * v_scale * c.duration, 1e-300));
        const std::span<const LaneEvent> told(events[lane].data(), next[lane]);
        if (!std::ranges::equal(told, watch.events, {}, &LaneEvent::kind, &Event::kind)) worst = infinity;
        for (std::size_t k = 0; k < told.size() && worst < infinity; ++k) {
          worst = std::max(worst, std::abs(told[k].displacement - watch.events[k].displacement) / x_scale);
          // The root of a rounding at worst, where a stop is a grazing one.
          if (!(std::abs(told[k].time - watch.events[k].time) <= 2 * std::sqrt(epsilon) * c.duration)) worst = infinity;
          if (told[k].segment != i) worst = infinity;
        }
      }
      const bool same_way = before.velocity * after.velocity > 0;
      hard.double_reversals += watch.reversals() >= 2;
      hard.dips += same_way && (watch.reversals() >= 2 || watch.arrests() >= 1);
      hard.stops_and_goes += watch.arrests() >= 1 && watch.breakaways() >= 1;
      hard.at_level += before.velocity == 0 && start[lane] == -lanes.forward;
    }
  }
  return worst / epsilon;
}

/// One segment for one block; the other lanes are empty.
State one(const CoulombLanes& slider, double velocity, double start, double end, double* peak = nullptr) {
  std::array<double, max_lanes> x{}, v{velocity}, largest{}, from{start}, to{end};
  detail::advance_lanes(slider, detail::row_padding, from.data(), to.data(), {x.data(), v.data(), largest.data()});
  if (peak) *peak = largest[0];
  return State::at(x[0], v[0]);
}

/// The sums over a block of members, with their peaks and residuals.
struct Simulated {
  std::vector<double> peak, residual;
  detail::Tally tally;
};

Simulated simulate(detail::Simulator& simulator, const EnsembleTimes& times, std::uint64_t first, std::size_t members) {
  const std::atomic<bool> stopped = false;
  detail::Block block(times, true, false, stopped);
  block.begin(members);
  simulator.simulate(first, members, block);
  const auto count = static_cast<std::ptrdiff_t>(members);
  return {{block.peak().begin(), block.peak().begin() + count},
          {block.residual().begin(), block.residual().begin() + count},
          block.finish()};
}

/// Largest difference of two rows of numbers, by the largest number.
double relative(std::span<const double> a, std::span<const double> b) {
  return difference(a, b) == 0 ? 0 : difference(a, b) / largest(a);
}

}  // namespace

TEST_CASE("blocks in lanes move as single ones, segment by segment, on every instruction set", "[lanes]") {
  // A segment is up to three slips of some ten roundings each, and the times of stops cost as many; where a stop is a
  // grazing one its time is uncertain by the root of a rounding, but then velocity and acceleration vanish with it.
  const Case cases[] = {
      {"equal levels", 1, 1},
      {"equal levels, long segments", 1, 1, 3.0},
      {"equal levels, smooth ground", 1, 1, 0.1, false, true},
      {"held loads", 1, 1, 0.1, true},
      {"unequal levels", 1, 1.6},
      {"unequal levels the other way", 1.6, 0.3, 1.0},
      {"one way", 1, infinity, 0.5},
      {"one way, held", 1, infinity, 0.5, true},
      {"no friction", 0, 0},
      {"no friction forward", 0, 1, 0.1},
      {"no friction forward, never backward", 0, infinity, 0.1},
      {"tiny", 1, 1.3, 1e-3, false, false, 1e-100},
      {"huge", 1, 1.3, 1e3, false, false, 1e90},
  };
  on_each_instruction_set([&](const std::string& set) {
    Hard all;
    for (const Case& c : cases) {
      Hard hard;
      INFO(set << ": " << c.name);
      CHECK(compare(c, 1500, hard) < 16);
      all.double_reversals += hard.double_reversals;
      all.dips += hard.dips;
      all.stops_and_goes += hard.stops_and_goes;
      all.at_level += hard.at_level;
      CHECK(hard.indistinct < 1500);  // of 96,000 segments: those with a stop or a level at one of their ends
    }
    // The input is as hard as it should be.
    CHECK(all.double_reversals > 400);
    CHECK(all.dips > 4000);
    CHECK(all.stops_and_goes > 4000);
    CHECK(all.at_level > 4000);
  });
}

TEST_CASE("a block whose velocity dips through zero within a segment stops, though its ends show nothing", "[lanes]") {
  // v = 0.3 - 1.5 t + 1.5 t^2 is 0.3 at both ends of the segment and negative between. It stops at 0.2764 s, is held
  // until n = -1 at 0.5 s, and ends with 3 (0.5)^2 / 2.
  on_each_instruction_set([](const std::string& set) {
    INFO(set);
    const double stop = (1.5 - std::sqrt(0.45)) / 3;
    const double first = stop * (0.3 - stop * (0.75 - stop * 0.5));
    for (const double s : {1.0, -1.0}) {
      double peak = 0;
      const State end = one({1, 1, 1}, s * 0.3, s * 0.5, s * -2.5, &peak);
      CHECK(s * end.velocity == Approx(0.375).epsilon(1e-15));
      CHECK(s * end.displacement == Approx(first + 0.0625).epsilon(1e-15));
      CHECK(peak == std::abs(end.displacement));
    }
  });
}

TEST_CASE("two reversals in one segment are those of 50 digits, and the peak is that between them", "[lanes]") {
  on_each_instruction_set([](const std::string& set) {
    INFO(set);
    // values.json edge.two_reversals_one_segment (mpmath, 50 digits)
    double peak = 0;
    const State end = one({1, 1, 1}, 0.02, 4, -6, &peak);
    CHECK(end.displacement == Approx(0.01542150464203804175432394215294192359768).epsilon(1e-14));
    CHECK(end.velocity == Approx(1.203935482821959107268081822123250367044).epsilon(1e-14));
    Watch watch;
    State state = State::at(0, 0.02);
    advance(Slider(Coulomb(1)), Segment{1, 4, -6}, state, watch);
    CHECK(watch.reversals() == 2);
    CHECK(watch.peak > end.displacement);  // it went farther back
    CHECK(peak == Approx(watch.peak).epsilon(1e-14));
  });
}

TEST_CASE("a block in a lane holds at the level itself", "[lanes]") {
  on_each_instruction_set([](const std::string& set) {
    INFO(set);
    for (const double level : {1.0, 0.1, 1e-300, 3e17})
      for (const auto& [start, end] : {std::pair{level, level}, std::pair{-level, level}, std::pair{0.0, -level}}) {
        const State after = one({level, level, 0.1}, 0, start, end);
        CHECK(after.displacement == 0);
        CHECK(after.velocity == 0);
      }
    CHECK(one({1, infinity, 0.1}, 0, 1e100, 1e100).velocity == 0);
    CHECK(one({1, 1, 0.1}, 0, -std::nextafter(1, 2), -1).displacement > 0);
  });
}

TEST_CASE("a whole block of members side by side has the sums of its members one by one", "[lanes]") {
  // 300 segments, each off by some ten roundings of the scale of x (above): 7e-13 if all went one way.
  const auto [samples, options, law, dt, settle, members] = GENERATE(
      std::tuple{301, GaussianOptions{}, Coulomb(1), 0.1, false, 64},
      std::tuple{301, GaussianOptions{}, Coulomb(1), 0.1, true, 5},
      std::tuple{302, GaussianOptions{.random_amplitudes = true, .zero_frequency = true, .period = 400},
                 Coulomb(0.7, 1.9), 0.3, true, 64},
      std::tuple{301, GaussianOptions{.interpolation = Interpolation::constant}, Coulomb(1, infinity), 0.2, false, 63},
      std::tuple{301, GaussianOptions{.envelope = Envelope(3, 10, 0.3)}, Coulomb(0.5), 0.1, true, 33},
      std::tuple{2, GaussianOptions{.period = 300}, Coulomb(0.5), 0.1, true, 64});
  const GaussianExcitation excitation(Spectrum::white(1), 0.1, static_cast<std::size_t>(samples), options);
  const EnsembleTimes times = detail::ensemble_times(dt, TimeBase{excitation.duration(), excitation.dt()});
  const auto count = static_cast<std::size_t>(members);
  on_each_instruction_set([&](const std::string& set) {
    INFO(set << ": " << samples << " samples, " << members << " members");
    const Simulated lanes = simulate(*detail::lanes_simulator(Slider(law), excitation, 3, settle), times, 128, count);
    const Slider<Coulomb> slider(law);
    const PairedMembers members_alone(slider, excitation);
    detail::MemberSimulator simulator(members_alone, 3, settle);
    const Simulated one_by_one = simulate(simulator, times, 128, count);
    CHECK(relative(lanes.peak, one_by_one.peak) < 7e-13);
    CHECK(relative(lanes.residual, one_by_one.residual) < 7e-13);
    CHECK(lanes.tally.count == count);
    for (std::size_t m = 0; m < detail::Tally::moments; ++m) {
      const auto moment = static_cast<detail::Tally::Moment>(m);
      INFO("moment " << m);
      CHECK(relative(lanes.tally.moment(moment), one_by_one.tally.moment(moment)) < 4 * 7e-13);  // up to fourth powers
    }
    CHECK(relative(lanes.tally.density_mean(), one_by_one.tally.density_mean()) < 2 * 7e-13);
    CHECK(relative(lanes.tally.density_scatter(), one_by_one.tally.density_scatter()) < 4 * 7e-13);
    for (std::size_t a = 0; a < detail::features; ++a) {
      INFO("feature " << a);
      CHECK(std::abs(lanes.tally.mean(a) - one_by_one.tally.mean(a)) <=
            4 * 7e-13 * std::sqrt(lanes.tally.scatter(a, a)));
    }
  });
}
