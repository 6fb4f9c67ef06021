#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "lanes/linear_lanes.cpp"
#include "lanes/linear_lanes.hpp"

#include <hwy/foreach_target.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "base/attempt.hpp"
#include "lanes/pack-inl.hpp"
#include "lanes/rests-inl.hpp"

#ifndef STICKSLIP_LINEAR_LANES
#define STICKSLIP_LINEAR_LANES
namespace stickslip::detail {

/// The lanes of one vector, as arrays over them. A lane that slides has y = sign x, its speed u, and what its step
/// needs (LinearRegime, LinearStepOf); n is the ground acceleration. One that is stuck has steps that are zero.
struct LinearGroup {
  static constexpr std::size_t most = 16;
  using Row = double[most];

  alignas(64) Row y, u, way_of_n, base, stiffness, damping, limit, least, lowest, highest;
  alignas(64) Row speed_u, speed_q, speed_g, way_u, way_q, way_g, end_u, end_q, end_g;
  Row from;  // y where the memory of the lane is

  /// Makes lane k one that is stuck and holds any load.
  void hold(std::size_t k) noexcept;
  /// Takes over lane k.
  void take(std::size_t k, const LinearLane& lane);
  /// Puts the motion of lane k since then into its state.
  void give(std::size_t k, LinearLane& lane) const;
};

/// Moves lane k over segment i by its event loop.
void advance_lane(LinearGroup& group, std::size_t k, LinearLane& lane, const LevelGround& ground, std::size_t i);

}  // namespace stickslip::detail
#endif

HWY_BEFORE_NAMESPACE();
namespace stickslip::detail::HWY_NAMESPACE {

using Lanes = Pack<1>;

HWY_INLINE void slide_group(const LevelGround& ground, std::span<LinearLane> these) {
  constexpr std::size_t size = Lanes::size;
  static_assert(size <= LinearGroup::most);
  const double *const start = ground.start(), *const end = ground.end();
  const std::size_t segments = ground.segments();
  LinearGroup group{};
  for (std::size_t k = 0; k < size; ++k)
    if (k < these.size())
      group.take(k, these[k]);
    else
      group.hold(k);
  bool stuck = false;
  for (std::size_t i = 0; i < segments; ++i) {
    stuck = true;
    for (std::size_t k = 0; k < size; ++k) stuck &= group.least[k] < 0;
    if (stuck) {
      i = next_departure(ground, i, *std::max_element(group.lowest, group.lowest + size),
                         *std::min_element(group.highest, group.highest + size));
      if (i == segments) break;
    }
    const Lanes way_of_n = Lanes::load(group.way_of_n), base = Lanes::load(group.base),
                stiffness = Lanes::load(group.stiffness), damping = Lanes::load(group.damping);
    const Lanes limit = Lanes::load(group.limit), least = Lanes::load(group.least), lowest = Lanes::load(group.lowest),
                highest = Lanes::load(group.highest);
    const Lanes speed_u = Lanes::load(group.speed_u), speed_q = Lanes::load(group.speed_q),
                speed_g = Lanes::load(group.speed_g);
    const Lanes way_u = Lanes::load(group.way_u), way_q = Lanes::load(group.way_q), way_g = Lanes::load(group.way_g);
    const Lanes end_u = Lanes::load(group.end_u), end_q = Lanes::load(group.end_q), end_g = Lanes::load(group.end_g);
    Lanes y = Lanes::load(group.y), u = Lanes::load(group.u);
    std::uint64_t eventful = 0;
    for (; i < segments; ++i) {
      const Lanes first = start[i], last = end[i];
      const Lanes q = nfma(stiffness, y, multiply_add(way_of_n, first, -base)), gain = way_of_n * (last - first);
      const Lanes speed = multiply_add(speed_u, u, multiply_add(speed_g, gain, speed_q * q));
      const Lanes there = y + multiply_add(way_q, q, multiply_add(way_u, u, way_g * gain));
      const Lanes begins = nfma(damping, u, q), ends = multiply_add(end_u, u, multiply_add(end_g, gain, end_q * q));
      // Within one arch, a speed that ends above zero is zero before only if it falls at first and rises at the end.
      const auto passes = (speed > least) & ((begins >= 0) | (ends <= 0)) & (there < limit) &
                          (min(first, last) >= lowest) & (max(first, last) <= highest);
      eventful = bits(~passes);
      if (HWY_UNLIKELY(eventful != 0)) {
        y.store(group.y);
        u.store(group.u);
        alignas(64) LinearGroup::Row all_there, all_speed;
        there.store(all_there);
        speed.store(all_speed);
        for (std::size_t k = 0; k < size; ++k) {
          if (eventful >> k & 1) continue;
          group.y[k] = all_there[k];
          group.u[k] = all_speed[k];
        }
        break;
      }
      y = there;
      u = speed;
    }
    if (eventful == 0) {
      y.store(group.y);
      u.store(group.u);
      break;
    }
    for (std::uint64_t rest = eventful; rest != 0; rest &= rest - 1) {
      const auto k = static_cast<std::size_t>(std::countr_zero(rest));
      advance_lane(group, k, these[k], ground, i);
    }
  }
  for (std::size_t k = 0; k < these.size(); ++k) group.give(k, these[k]);
}

void SlideLinear(const LevelGround& ground, std::span<LinearLane> sliders) {
  for (std::size_t i = 0; i < sliders.size(); i += Lanes::size)
    slide_group(ground, sliders.subspan(i, std::min(Lanes::size, sliders.size() - i)));
}

}  // namespace stickslip::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace stickslip::detail {
namespace {

HWY_EXPORT(SlideLinear);

}  // namespace

void LinearGroup::hold(std::size_t k) noexcept {
  for (Row* row : {&y, &u, &way_of_n, &base, &stiffness, &damping, &speed_u, &speed_q, &speed_g, &way_u, &way_q, &way_g,
                   &end_u, &end_q, &end_g, &from})
    (*row)[k] = 0;
  limit[k] = highest[k] = never;
  lowest[k] = -never;
  least[k] = -1;
}

void LinearGroup::take(std::size_t k, const LinearLane& lane) {
  hold(k);
  if (lane.failed) return;
  const LinearRegime regime = lane.mover->regime(lane.state);
  if (lane.state.mode == Mode::stuck) {
    y[k] = from[k] = lane.state.displacement;
    // The load is -n.
    lowest[k] = lane.turned ? regime.low : -regime.high;
    highest[k] = lane.turned ? regime.high : -regime.low;
    return;
  }
  const LinearStepOf& step = *regime.step;
  y[k] = from[k] = regime.sign * lane.state.displacement;
  u[k] = std::abs(lane.state.velocity);
  way_of_n[k] = lane.turned ? regime.sign : -regime.sign;
  base[k] = regime.base;
  stiffness[k] = step.stiffness;
  damping[k] = step.damping;
  limit[k] = regime.limit;
  least[k] = 0;
  speed_u[k] = step.speed_u;
  speed_q[k] = step.speed_q;
  speed_g[k] = step.speed_g;
  way_u[k] = step.way_u;
  way_q[k] = step.way_q;
  way_g[k] = step.way_g;
  end_u[k] = step.end_u;
  end_q[k] = step.end_q;
  end_g[k] = step.end_g;
}

void LinearGroup::give(std::size_t k, LinearLane& lane) const {
  if (lane.failed || lane.state.mode == Mode::stuck) return;
  const double toward = sign(direction_of(lane.state.mode));
  if (y[k] > from[k]) lane.mover->slid(lane.state, y[k] - from[k]);
  lane.state.displacement = toward * y[k];
  lane.state.velocity = toward * u[k];
}

void advance_lane(LinearGroup& group, std::size_t k, LinearLane& lane, const LevelGround& ground, std::size_t i) {
  group.give(k, lane);
  const double s = lane.turned ? -1 : 1;
  const Segment segment{ground.duration(), s * ground.start()[i], s * ground.end()[i]};
  attempt([&] { lane.mover->advance(segment, lane.state, lane.watch); }, [&](const char*) { lane.failed = true; });
  if (!(std::abs(lane.state.displacement) < 1e100 && std::abs(lane.state.velocity) < 1e100)) lane.failed = true;
  group.take(k, lane);
}

void slide_linear(const LevelGround& ground, std::span<LinearLane> lanes, bool settle) {
  HWY_DYNAMIC_DISPATCH(SlideLinear)(ground, lanes);
  for (LinearLane& lane : lanes) {
    if (lane.failed) continue;
    if (settle)  // also what is at rest: its spring may pull more than it holds when the ground acceleration ends
      attempt([&] { lane.mover->settle(lane.state, lane.watch); }, [&](const char*) { lane.failed = true; });
    lane.watch.add(lane.state);
  }
}

}  // namespace stickslip::detail
#endif
