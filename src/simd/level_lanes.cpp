#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simd/level_lanes.cpp"
#include "simd/level_lanes.hpp"

#include <hwy/foreach_target.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "simd/pack-inl.hpp"
#include "stickslip/error.hpp"
#include "stickslip/sliding/integrate.hpp"

#ifndef STICKSLIP_LEVEL_GROUP
#define STICKSLIP_LEVEL_GROUP
namespace stickslip::detail {

/// Coulomb friction, either of whose levels may be infinite.
struct Levels {
  static constexpr bool constant_while_sliding = true;
  double forward, backward;

  template <class X>
  double resist(const X&, Direction direction) const noexcept {
    return direction == Direction::forward ? forward : backward;
  }
};

/// The lanes of one vector. Those that slide have left out the last straight part of their way, `distance`.
struct LevelGroup {
  static constexpr std::size_t most = row_padding;

  alignas(64) double way[most] = {};   ///< -1 forward, +1 backward: the sign of n that speeds it up; 0 stuck
  alignas(64) double level[most] = {};  ///< that it slides against; 0 where it is stuck
  alignas(64) double least[most];       ///< what its speed must stay above; less than 0 where it is stuck
  alignas(64) double speed[most] = {}, distance[most] = {};
  alignas(64) double next_speed[most], next_distance[most];  ///< at the end of the segment, if it goes on as it was
  double lowest, highest;  ///< ground acceleration that holds all lanes which are stuck [m/s^2]
  std::size_t sliding = 0;
  std::span<LevelLane> lanes;

  explicit LevelGroup(std::span<LevelLane> these) : lanes(these) {
    std::fill_n(least, most, -1.0);
    look();
  }

  State state(std::size_t k) const noexcept {
    const double s = -way[k];
    return {lanes[k].state.displacement + s * distance[k], s * speed[k], static_cast<Mode>(static_cast<int>(s))};
  }

  /// Moves the lanes over a segment: those in `marked`, and those that it does not hold, by the event loop.
  void move(std::uint64_t marked, double duration, double start, double end);

 private:
  void look() noexcept {
    lowest = -std::numeric_limits<double>::infinity();
    highest = -lowest;
    sliding = 0;
    for (std::size_t k = 0; k < lanes.size(); ++k)
      if (way[k] == 0) {
        lowest = std::max(lowest, -lanes[k].forward);
        highest = std::min(highest, lanes[k].backward);
      } else {
        ++sliding;
      }
  }
};

}  // namespace stickslip::detail
#endif

HWY_BEFORE_NAMESPACE();
namespace stickslip::detail::HWY_NAMESPACE {

using Real = Pack<1>;
using Bool = Real::Mask;

// The first of `count` places from `from` on where `a` is below `lowest` or `b` above `highest`; count where there is
// none.
HWY_INLINE std::size_t first_outside(const double* a, const double* b, std::size_t from, std::size_t count,
                                     double lowest, double highest) {
  const Real low = lowest, high = highest;
  std::size_t i = from;
  for (; i + Real::size <= count; i += Real::size) {
    const Bool outside = (Real::load(a + i) < low) | (Real::load(b + i) > high);
    if (HWY_UNLIKELY(any(outside))) return i + static_cast<std::size_t>(std::countr_zero(bits(outside)));
  }
  while (i < count && !(a[i] < lowest || b[i] > highest)) ++i;
  return i;
}

// The next segment that moves a lane of a group that is stuck.
HWY_INLINE std::size_t next_departure(const LevelGround& ground, std::size_t i, const LevelGroup& group) {
  constexpr std::size_t block = LevelGround::block;
  const double *const start = ground.start(), *const end = ground.end();
  const std::size_t segments = ground.segments();
  // What holds a lane at the end of a segment holds it at the beginning of the next one.
  if (i == 0 && (start[0] < group.lowest || start[0] > group.highest)) return 0;
  const std::size_t begun = std::min((i + block - 1) / block * block, segments);
  i = first_outside(end, end, i, begun, group.lowest, group.highest);
  if (i < begun || begun == segments) return i;
  const std::size_t in = first_outside(ground.lowest().data(), ground.highest().data(), begun / block,
                                       ground.lowest().size(), group.lowest, group.highest);
  return first_outside(end, end, std::min(in * block, segments), segments, group.lowest, group.highest);
}

template <bool held>
HWY_INLINE void slide_group(const LevelGround& ground, LevelGroup& group) {
  const double *const start = ground.start(), *const end = ground.end();
  const std::size_t segments = ground.segments();
  const double duration = ground.duration();
  const Real h = duration, half = duration / 2, sixth = duration / 6;
  for (std::size_t i = 0;;) {
    if (group.sliding == 0) {
      i = next_departure(ground, i, group);
      if (i == segments) return;
      group.move(0, duration, start[i], end[i]);
      ++i;
    }
    if (i == segments) return;
    if (group.sliding == 0) continue;

    const Real way = Real::load(group.way), against = -Real::load(group.level), least = Real::load(group.least);
    const double lowest = group.lowest, highest = group.highest;
    Real speed = Real::load(group.speed), distance = Real::load(group.distance);
    Real first = multiply_add(way, start[i], against);  // acceleration; 0 where it is stuck
    for (;; ++i) {
      const double n = end[i];
      const Real last = multiply_add(way, n, against);
      // The speed is a parabola: it stays above the least of its Bernstein coefficients `speed`, `middle` and `after`.
      const Real middle = multiply_add(half, first, speed), after = multiply_add(half, last, middle);
      const Real gone = multiply_add(h, multiply_add(sixth, (first + first) + last, speed), distance);
      const Bool stops = ~(min(middle, after) > least);
      if (HWY_UNLIKELY(any(stops) || n < lowest || n > highest)) {
        speed.store(group.speed);
        distance.store(group.distance);
        after.store(group.next_speed);
        gone.store(group.next_distance);
        group.move(bits(stops), duration, start[i], n);
        ++i;
        break;
      }
      speed = after;
      distance = gone;
      if (i + 1 == segments) {
        speed.store(group.speed);
        distance.store(group.distance);
        return;
      }
      first = held ? multiply_add(way, start[i + 1], against) : last;
    }
  }
}

void SlideLevels(const LevelGround& ground, std::span<LevelLane> blocks) {
  for (std::size_t i = 0; i < blocks.size(); i += Real::size) {
    const std::span<LevelLane> these = blocks.subspan(i, std::min(Real::size, blocks.size() - i));
    LevelGroup group(these);
    if (ground.held())
      slide_group<true>(ground, group);
    else
      slide_group<false>(ground, group);
    for (std::size_t k = 0; k < these.size(); ++k) these[k].state = group.state(k);
  }
}

}  // namespace stickslip::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace stickslip::detail {
namespace {

HWY_EXPORT(SlideLevels);

// Takes the account of a lane at its events: between them x runs one way.
struct Watch {
  LevelLane& lane;

  void slide(const Slip&) const noexcept {}
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

void LevelGroup::move(std::uint64_t marked, double duration, double start, double end) {
  const Segment segment{duration, start, end};
  for (std::size_t k = 0; k < lanes.size(); ++k) {
    LevelLane& lane = lanes[k];
    const bool stuck = way[k] == 0;
    const bool held = std::min(start, end) >= -lane.forward && std::max(start, end) <= lane.backward;
    if (stuck ? held : (marked >> k & 1) == 0) {
      if (!stuck) {
        speed[k] = next_speed[k];
        distance[k] = next_distance[k];
      }
      continue;
    }
    State state = this->state(k);
    const Levels law{lane.forward, lane.backward};
    Watch watch{lane};
    detail::advance(law, Polynomial{}, segment, state, watch);
    lane.state.displacement = state.displacement;
    speed[k] = std::abs(state.velocity);
    distance[k] = 0;
    if (state.mode == Mode::stuck) {
      way[k] = level[k] = 0;
      least[k] = -1;
    } else {
      const Direction direction = direction_of(state.mode);
      way[k] = -sign(direction);
      level[k] = law.resist(0, direction);
      least[k] = 0;
    }
  }
  look();
}

LevelGround::LevelGround(const GroundMotion& motion)
    : start_(motion.acceleration().data()),
      end_(start_ + (motion.interpolation() == Interpolation::linear ? 1 : 0)),
      segments_(motion.segments()),
      duration_(motion.dt()) {
  for (std::size_t i = 0; i < segments_; i += block) {
    double low = end_[i], high = low;
    for (std::size_t k = i; k < std::min(i + block, segments_); ++k) {
      low = std::min(low, end_[k]);
      high = std::max(high, end_[k]);
    }
    lowest_.push_back(low);
    highest_.push_back(high);
  }
}

bool has_level_lanes(const GroundMotion& motion) noexcept {
  return std::isfinite(motion.dt()) && motion.dt() > 1e-60 && motion.dt() < 1e60 && motion.peak_acceleration() < 1e60;
}

void slide_levels(const LevelGround& ground, std::span<LevelLane> lanes, bool settle) {
  HWY_DYNAMIC_DISPATCH(SlideLevels)(ground, lanes);
  for (LevelLane& lane : lanes) {
    Watch watch{lane};
    const Slider<Levels> slider(Levels{lane.forward, lane.backward});
    if (settle && lane.state.mode != Mode::stuck) {
      try {
        detail::settle(slider, lane.state, [&](double duration) {
          advance(slider, Segment{duration, 0, 0}, lane.state, watch);
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
