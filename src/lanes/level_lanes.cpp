#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "lanes/level_lanes.cpp"
#include "lanes/level_lanes.hpp"

#include <hwy/foreach_target.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>

#include "lanes/blocks-inl.hpp"
#include "lanes/rests-inl.hpp"
#include "stickslip/base/error.hpp"
#include "stickslip/sliding/integrate.hpp"

#ifndef STICKSLIP_LEVEL_LANES
#define STICKSLIP_LEVEL_LANES
namespace stickslip::detail {

/// Moves a lane over segment i by the event loop.
void advance_lane(LevelLane& lane, const LevelGround& ground, std::size_t i);

}  // namespace stickslip::detail
#endif

HWY_BEFORE_NAMESPACE();
namespace stickslip::detail::HWY_NAMESPACE {

// Records the lanes at their events: between events, x is monotonic.
struct LevelAccount {
  Bool meant;  // lanes
  Bool indistinct = Bool::first(0);
  Real from, sliding_distance, events;

  HWY_INLINE void distinct(const Bool& are) { indistinct = indistinct | ~are; }
  HWY_INLINE void slide(const Blocks&, const Real&, const Real&, const Real&, const Real&, const Real&) {}
  HWY_INLINE void turn(const Bool& stuck, const Bool& stops, const Bool& back, const Real& x, const Real& t,
                       const Slip& slip) {
    const Bool turns = stuck | stops;
    const Bool goes_on = stops & slip.at_once & (slip.forward ^ back);  // the velocity only touched zero
    const Bool ends = but_not(stops, goes_on) & meant, late = turns & slip.later & meant;
    events = events + where(ends | (stuck & slip.at_once & meant), Real(1.0)) + where(late, Real(1.0));
    sliding_distance = sliding_distance + where(ends, abs(x - from));
    from = select(ends, x, from);
    distinct(~(turns & but_not((slip.at_once | slip.later) & (slip.velocity == 0), slip.stops)));
    distinct(~(stops & slip.later & (slip.begin <= t)));
  }
};

// The lanes of one vector, in memory.
struct LevelGroup {
  static constexpr std::size_t size = Real::size;
  alignas(64) double turned[size], forward[size], backward[size], lowest_held[size], highest_held[size];
  alignas(64) double x[size] = {}, v[size] = {}, peak[size] = {},
                     sliding_distance[size] = {}, from[size] = {}, events[size] = {};

  double lowest = -std::numeric_limits<double>::infinity(), highest = -lowest;  // n that holds all of them

  explicit LevelGroup(std::span<const LevelLane> these) {
    for (std::size_t k = 0; k < size; ++k) {
      const LevelLane& lane = these[std::min(k, these.size() - 1)];
      turned[k] = lane.turned ? -1 : 1;
      forward[k] = lane.law.sliding().forward();
      backward[k] = lane.law.sliding().backward();
      const double hold_forward = lane.law.static_forward(), hold_backward = lane.law.static_backward();
      lowest_held[k] = lane.turned ? -hold_backward : -hold_forward;
      highest_held[k] = lane.turned ? hold_forward : hold_backward;
      lowest = std::max(lowest, lowest_held[k]);
      highest = std::min(highest, highest_held[k]);
    }
  }

  void take(std::size_t k, const LevelLane& lane) {
    x[k] = lane.state.displacement;
    v[k] = lane.state.velocity;
    // It slides at a speed that is zero, or goes to sleep: here only what is stuck has none.
    if (v[k] == 0 && lane.state.mode != Mode::stuck)
      v[k] = sign(direction_of(lane.state.mode)) * std::numeric_limits<double>::denorm_min();
    peak[k] = lane.peak;
    sliding_distance[k] = lane.sliding_distance;
    from[k] = lane.slip_from;
    events[k] = static_cast<double>(lane.events);
  }
  void give(std::size_t k, LevelLane& lane) const {
    lane.state = State::at(x[k], v[k]);
    lane.peak = peak[k];
    lane.sliding_distance = sliding_distance[k];
    lane.slip_from = from[k];
    lane.events = static_cast<std::size_t>(events[k]);
  }
};

template <bool held>
HWY_INLINE void slide_group(const LevelGround& ground, std::span<LevelLane> these) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const double *const start = ground.start(), *const end = ground.end();
  const std::size_t segments = ground.segments();
  const double duration = ground.duration(), rate = 1 / duration;
  const Real h = duration, half = duration / 2, sixth = duration / 6;
  LevelGroup group(these);
  const Real turned = Real::load(group.turned), forward = Real::load(group.forward),
             backward = Real::load(group.backward);
  const Real min_held = Real::load(group.lowest_held), max_held = Real::load(group.highest_held);

  Real x = 0.0, v = 0.0;
  for (std::size_t i = 0;;) {
    const Bool stuck = v == 0, back = v < 0;
    if (all(stuck)) {
      i = next_departure(ground, i, group.lowest, group.highest);
      if (i == segments) break;
    }
    // While all go on as they are: `way` is the sign that the ground acceleration speeds it up with.
    const Real direction = select(back, Real(-1.0), 1.0), step = direction * h;
    const Real way = where(~stuck, -direction * turned), against = where(~stuck, select(back, -backward, -forward));
    const Real least = where(stuck, Real(-1.0));
    const Real low = select(stuck, min_held, -infinity), high = select(stuck, max_held, infinity);
    Real speed = abs(v), first = multiply_add(way, start[i], against);
    Bool eventful = Bool::first(0);
    // What holds a lane at the end of a segment holds it at the beginning of the next one, but for the first of all.
    const bool surely = i == 0;
    for (;;) {
      const Real n = end[i], last = multiply_add(way, n, against);
      // The speed is a parabola: it stays above the least of its Bernstein coefficients `speed`, `middle` and `after`.
      const Real middle = multiply_add(half, first, speed), after = multiply_add(half, last, middle);
      eventful = ~(min(middle, after) > least) | (n < low) | (n > high);
      if (HWY_UNLIKELY(any(eventful)) || surely) {
        eventful = eventful | (stuck & Bool::first(surely ? Real::size : 0));
        const Real mean = multiply_add(sixth, (first + first) + last, speed);
        const Real there = multiply_add(step, mean, x), last_v = direction * after;
        Blocks blocks{forward,
                      backward,
                      turned * -start[i],
                      turned * -end[i],
                      turned * ((start[i] - end[i]) * rate),
                      h,
                      Real::load(group.peak)};
        LevelAccount account{.meant = eventful,
                             .from = Real::load(group.from),
                             .sliding_distance = Real::load(group.sliding_distance),
                             .events = Real::load(group.events)};
        v = direction * speed;
        Real moved_x = x, moved_v = v;
        blocks.move(moved_x, moved_v, account);
        const std::uint64_t alone = bits(account.indistinct & eventful);
        if (HWY_UNLIKELY(alone != 0)) {
          // A velocity that is zero at the end of a segment, or near enough: by the event loop.
          x.store(group.x);
          v.store(group.v);
          for (std::uint64_t rest = alone; rest != 0; rest &= rest - 1) {
            const auto k = static_cast<std::size_t>(std::countr_zero(rest));
            if (k < these.size()) group.give(k, these[k]);
          }
        }
        x = select(eventful, moved_x, there);
        v = select(eventful, moved_v, where(~stuck, last_v));
        select(eventful, blocks.peak, Real::load(group.peak)).store(group.peak);
        account.from.store(group.from);
        account.sliding_distance.store(group.sliding_distance);
        account.events.store(group.events);
        if (HWY_UNLIKELY(alone != 0)) {
          x.store(group.x);
          v.store(group.v);
          for (std::uint64_t rest = alone; rest != 0; rest &= rest - 1) {
            const auto k = static_cast<std::size_t>(std::countr_zero(rest));
            if (k >= these.size()) continue;
            advance_lane(these[k], ground, i);
            group.take(k, these[k]);
          }
          x = Real::load(group.x);
          v = Real::load(group.v);
        }
        ++i;
        break;
      }
      x = multiply_add(step, multiply_add(sixth, (first + first) + last, speed), x);
      speed = after;
      if (++i == segments) {
        v = direction * speed;
        break;
      }
      first = held ? multiply_add(way, start[i], against) : last;
    }
    if (i == segments) break;
  }
  x.store(group.x);
  v.store(group.v);
  for (std::size_t k = 0; k < these.size(); ++k) group.give(k, these[k]);
}

// The same where the normal force varies, or static friction is above kinetic.
template <bool held>
HWY_INLINE void slide_weighed_group(const LevelGround& ground, std::span<LevelLane> these) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const std::size_t segments = ground.segments(), next = ground.next();
  const double *const to_hold = ground.end(), *const load = ground.load(), *const weight = ground.weight();
  const Real h = ground.duration(), half = ground.duration() / 2, sixth = ground.duration() / 6;
  LevelGroup group(these);
  const Real forward = Real::load(group.forward), backward = Real::load(group.backward);
  // The loads that are held for certain, whatever the rounding of -p / W.
  constexpr double surely_held = 1 - 0x1p-50;
  const Real min_held = Real::load(group.lowest_held) * surely_held;
  const Real max_held = Real::load(group.highest_held) * surely_held;

  Real x = 0.0, v = 0.0;
  for (std::size_t i = 0; i < segments;) {
    const Bool stuck = v == 0, back = v < 0;
    if (all(stuck)) {
      i = next_departure(ground, i, group.lowest * surely_held, group.highest * surely_held);
      if (i == segments) break;
    }
    const Real direction = select(back, Real(-1.0), 1.0), step = direction * h;
    const Real way = where(~stuck, direction), against = where(~stuck, select(back, -backward, -forward));
    const Real least = where(stuck, Real(-1.0));
    const Real low = select(stuck, min_held, -infinity), high = select(stuck, max_held, infinity);
    Real speed = abs(v), first = multiply_add(way, load[i], against * weight[i]);
    Bool eventful = Bool::first(i == 0 ? Real::size : 0) & stuck;
    for (;; ++i) {
      const Real last = multiply_add(way, load[i + next], against * weight[i + next]);
      const Real middle = multiply_add(half, first, speed), after = multiply_add(half, last, middle);
      const Real n = to_hold[i];
      eventful = eventful | ~(min(middle, after) > least) | (n < low) | (n > high);
      const Real there = multiply_add(step, multiply_add(sixth, (first + first) + last, speed), x);
      if (HWY_UNLIKELY(any(eventful))) {
        x.store(group.x);
        (direction * speed).store(group.v);
        for (std::uint64_t rest = bits(eventful); rest != 0; rest &= rest - 1) {
          const auto k = static_cast<std::size_t>(std::countr_zero(rest));
          // The last lane fills the vector.
          if (k >= these.size()) {
            group.take(k, these.back());
            continue;
          }
          group.give(k, these[k]);
          advance_lane(these[k], ground, i);
          group.take(k, these[k]);
        }
        x = select(eventful, Real::load(group.x), there);
        v = select(eventful, Real::load(group.v), where(~stuck, direction * after));
        ++i;
        break;
      }
      x = there;
      speed = after;
      if (i + 1 == segments) {
        v = where(~stuck, direction * speed);
        ++i;
        break;
      }
      first = held ? multiply_add(way, load[i + 1], against * weight[i + 1]) : last;
    }
  }
  x.store(group.x);
  v.store(group.v);
  for (std::size_t k = 0; k < these.size(); ++k) group.give(k, these[k]);
}

void SlideLevels(const LevelGround& ground, std::span<LevelLane> blocks) {
  for (std::size_t i = 0; i < blocks.size(); i += Real::size) {
    const std::span<LevelLane> these = blocks.subspan(i, std::min(Real::size, blocks.size() - i));
    if (ground.weighed() && ground.held())
      slide_weighed_group<true>(ground, these);
    else if (ground.weighed())
      slide_weighed_group<false>(ground, these);
    else if (ground.held())
      slide_group<true>(ground, these);
    else
      slide_group<false>(ground, these);
  }
}

}  // namespace stickslip::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace stickslip::detail {
namespace {

HWY_EXPORT(SlideLevels);

struct Watch {
  LevelLane& lane;

  void slide(const stickslip::Slip&) const noexcept {}
  void event(EventKind, double, const State& state) const noexcept {
    ++lane.events;
    add(state);
  }
  void add(const State& state) const noexcept {
    lane.peak = std::max(lane.peak, std::abs(state.displacement));
    lane.sliding_distance += std::abs(state.displacement - lane.slip_from);
    lane.slip_from = state.displacement;
  }
};

}  // namespace

void advance_lane(LevelLane& lane, const LevelGround& ground, std::size_t i) {
  Watch watch{lane};
  const double duration = ground.duration();
  const std::size_t end = i + ground.next();
  BareState state(lane.state);
  if (ground.weighed()) {
    const WeighedLoad load{duration, ground.load()[i], ground.load()[end], ground.weight()[i], ground.weight()[end]};
    detail::advance(BlockFlows(lane.law, Polynomial{}), load, state, watch);
  } else {
    const double s = lane.turned ? -1 : 1;
    const Segment segment{duration, s * ground.start()[i], s * ground.end()[i]};
    detail::advance(BlockFlows(lane.law.sliding(), Polynomial{}), segment, state, watch);
  }
  state.store(lane.state);
}

LevelGround::LevelGround(const GroundMotion& motion)
    : start_(motion.acceleration().data()),
      next_(motion.interpolation() == Interpolation::linear ? 1 : 0),
      segments_(motion.segments()),
      duration_(motion.dt()),
      peak_(motion.peak_acceleration()) {
  find_extremes();
}

LevelGround::LevelGround(const GroundMotion& motion, double slope_degrees, bool flipped)
    : next_(motion.interpolation() == Interpolation::linear ? 1 : 0),
      segments_(motion.segments()),
      duration_(motion.dt()),
      peak_(0),
      slope_degrees_(slope_degrees) {
  const double slope = slope_degrees * (std::numbers::pi / 180), s = std::sin(slope), c = std::cos(slope);
  const std::span<const double> n = motion.acceleration(), up = motion.vertical();
  const std::size_t values = segments_ + next_;
  load_.resize(values);
  weight_.resize(values);
  held_back_.resize(values);
  for (std::size_t i = 0; i < values; ++i) {
    const double horizontal = flipped ? -n[i] : n[i], heavy = standard_gravity + (up.empty() ? 0 : up[i]);
    load_[i] = slope == 0 ? -horizontal : heavy * s - horizontal * c;
    weight_[i] = (slope == 0 ? heavy : heavy * c + horizontal * s) / standard_gravity;
    held_back_[i] = -load_[i] / weight_[i];
    peak_ = std::max({peak_, std::abs(load_[i]), weight_[i], weight_[i] > 1e-60 ? 0 : never});
  }
  start_ = held_back_.data();
  find_extremes();
}

void LevelGround::find_extremes() {
  for (std::size_t i = 0; i < segments_; i += block) {
    const auto [low, high] = std::minmax_element(end() + i, end() + std::min(i + block, segments_));
    lowest_.push_back(*low);
    highest_.push_back(*high);
  }
}

bool LevelGround::usable() const noexcept {
  return std::isfinite(duration_) && duration_ > 1e-60 && duration_ < 1e60 && peak_ < 1e60;
}

bool has_level_lanes(const StaticKinetic<Coulomb>& law) noexcept {
  const auto usual = [](double level) { return level == 0 || (level > 1e-60 && level < 1e60); };
  const auto usual_backward = [&](double level) { return usual(level) || std::isinf(level); };
  return usual(law.sliding().forward()) && usual(law.static_forward()) && usual_backward(law.sliding().backward()) &&
         usual_backward(law.static_backward());
}

void slide_levels(const LevelGround& ground, std::span<LevelLane> lanes, bool settle) {
  HWY_DYNAMIC_DISPATCH(SlideLevels)(ground, lanes);
  for (LevelLane& lane : lanes) {
    const Watch watch{lane};
    if (settle && lane.state.mode != Mode::stuck) {
      const Slider slider(lane.law, Mounting{.slope_degrees = ground.slope_degrees()});
      const EngineOf engine(slider);
      ObserverSink sink(watch);
      try {
        detail::settle(engine, lane.state, [&](double duration) {
          advance(engine, Segment{duration, 0, 0}, !slider.plain(), Contact::flight, lane.state, sink);
        });
      } catch (const ConvergenceError& error) {
        lane.failure = error.what();
      }
    }
    watch.add(lane.state);
  }
}

}  // namespace stickslip::detail
#endif
