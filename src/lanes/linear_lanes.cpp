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

  alignas(64) Row y, u, way_of_n, base, stiffness, damping, limit, least, lowest, highest, dip;
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

/// The motion of a slip after a part of the segment, where the time unit is its duration: distance, speed, acceleration.
struct SlipNow {
  double distance, speed, acceleration;
};

/// A slip within a segment, by the series of its step.
struct LinearSlip {
  const LinearStepOf& step;
  double speed, net, gain;  ///< at its start, and the rise of the load from there on per unit time
  double damping = step.damping * step.duration, stiffness = step.stiffness * step.duration * step.duration;

  HWY_INLINE SlipNow at(double part) const {
    const hn::CappedTag<double, 4> tag;
    const auto p = hn::Set(tag, part), p2 = hn::Mul(p, p);
    alignas(64) double basis[4];
    for (std::size_t k = 0; k < 4; k += hn::Lanes(tag)) {
      constexpr std::size_t last = LinearStepOf::terms - 1;
      auto even = hn::Load(tag, &step.series[last - 1][k]), odd = hn::Load(tag, &step.series[last][k]);
      for (std::size_t n = last - 1; n > 0; n -= 2) {
        even = hn::MulAdd(even, p2, hn::Load(tag, &step.series[n - 2][k]));
        odd = hn::MulAdd(odd, p2, hn::Load(tag, &step.series[n - 1][k]));
      }
      hn::Store(hn::MulAdd(odd, p, even), tag, basis + k);
    }
    SlipNow now;
    now.speed = speed * basis[0] + net * basis[1] + gain * basis[2];
    now.distance = speed * basis[1] + net * basis[2] + gain * basis[3];
    now.acceleration = net + gain * part - damping * now.speed - stiffness * now.distance;
    return now;
  }

  /// When the speed vanishes, which is positive at first, or rises from zero, and is not at `left`; and the distance up to
  /// then. Negative if it is not found.
  HWY_INLINE double stop(double left, double speed_at_left, double& distance) const {
    // A parabola, and from there on the inverse of the series of the speed.
    const double begins = net - damping * speed, bends = (speed_at_left - speed - begins * left) / (left * left);
    double t = speed > 0 ? 2 * speed / (std::sqrt(begins * begins - 4 * bends * speed) - begins) : -begins / bends;
    for (int i = 0; i < 4; ++i) {
      if (!(t > 0 && t <= left)) return -1;
      const SlipNow now = at(t);
      if (!(now.acceleration < 0)) return -1;
      const double jerk = gain - damping * now.acceleration - stiffness * now.speed;
      const double snap = -(damping * jerk + stiffness * now.acceleration);
      const double one = -now.speed / now.acceleration, two = jerk / (2 * now.acceleration),
                   three = snap / (6 * now.acceleration);
      const double moves = one * (1 - one * (two - one * (2 * two * two - three)));
      t += moves;
      if (std::abs(moves) <= 1e-4 * t && std::abs(two * moves) <= 1e-4) {
        distance = now.distance + moves * (now.speed + moves * (now.acceleration / 2 + moves * (jerk / 6)));
        return t > 0 && t <= left ? t : -1;
      }
    }
    return -1;
  }
};

/// Moves lane k over segment i through its events, if its levels are constant and none of its decisions is close.
/// @return whether it did; if not, nothing has changed
HWY_INLINE bool pass_events(LinearGroup& group, std::size_t k, LinearLane& lane, const LevelGround& ground,
                            std::size_t i) {
  constexpr double close = 0x1p-36;
  const LinearLevels* const levels = lane.levels;
  if (levels == nullptr || !levels->step->smooth) return false;
  const LinearStepOf& step = *levels->step;
  const double h = step.duration, turn = lane.turned ? 1 : -1;
  const double first = turn * ground.start()[i], last = turn * ground.end()[i], gain = last - first;
  SweepWatch watch = lane.watch;
  const auto event = [&](double x) {
    ++watch.events;
    watch.pass(x);
  };
  double sign = lane.state.mode == Mode::stuck ? 0 : stickslip::sign(direction_of(lane.state.mode));
  double y = group.y[k], u = group.u[k] * h, net = 0, left = 1;  // while it is stuck y is x
  if (sign != 0) net = (sign * first - levels->resist(sign) - step.stiffness * y) * (h * h);
  for (int events = 0;; ++events) {
    if (events > 8) return false;
    if (sign == 0) {
      const double pull = step.stiffness * y, now = last - gain * left - pull, end = last - pull;
      const double tie = close * (std::abs(last) + std::abs(pull) + std::abs(gain));
      if (!(levels->room(1, y) > 0 && levels->room(-1, y) > 0)) return false;
      const double above = end - levels->hold_forward, below = -end - levels->hold_backward;
      if (now > levels->hold_forward || -now > levels->hold_backward) return false;
      if (std::abs(above) <= tie || std::abs(below) <= tie) return false;
      if (!(above > 0) && !(below > 0)) break;
      sign = above > 0 ? 1 : -1;
      const double beyond = above > 0 ? above : below, hold = levels->hold(sign);
      const double room = hold - sign * now;
      left -= left * (room / (room + beyond));
      event(y);
      y *= sign;
      u = 0;
      net = (hold - levels->resist(sign)) * (h * h);
      continue;
    }
    const LinearSlip slip{step, u, net, sign * gain * (h * h)};
    const SlipNow end = slip.at(left);
    const double limit = LinearRegime::limit_of(y, levels->room(sign, sign * y));
    if (!(y + end.distance < limit)) return false;
    if (end.speed > 0) {
      const double begins = net - slip.damping * u, ends = end.acceleration;
      if (!(begins >= 0 || ends <= 0 || u > 0.1 * ends - 1.1 * begins)) return false;
      y += end.distance;
      u = end.speed;
      break;
    }
    double distance = 0;
    const double time = slip.stop(left, end.speed, distance);
    if (!(time > 0)) return false;
    left -= time;
    y += distance;
    if (!(y < limit)) return false;
    const double pull = step.stiffness * y, onward = sign * (last - gain * left) - pull;  // the net load
    const double tie = close * (std::abs(last) + std::abs(pull) + std::abs(gain));
    if (onward > levels->hold(sign) - tie || std::abs(-onward - levels->hold(-sign)) <= tie) return false;
    event(sign * y);
    if (-onward > levels->hold(-sign)) {
      net = (-onward - levels->resist(-sign)) * (h * h);
      sign = -sign;
      y = -y;
      u = 0;
    } else {
      y *= sign;
      sign = 0;
    }
  }
  lane.watch = watch;
  lane.state.mode = sign == 0 ? Mode::stuck : sign > 0 ? Mode::forward : Mode::backward;
  lane.state.displacement = sign < 0 ? -y : y;
  lane.state.velocity = sign == 0 ? 0 : sign * (u / h);
  group.take(k, lane);
  return true;
}

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
                highest = Lanes::load(group.highest), dip = Lanes::load(group.dip);
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
      // Within one arch, a speed that ends above zero is zero before only if it falls at first and rises at the end. A
      // smooth acceleration departs from its chord by less than a tenth of its largest value.
      const Lanes falls = dip * (0.1 * ends - 1.1 * begins);
      const auto passes = (speed > least) & ((begins >= 0) | (ends <= 0) | (u > falls)) & (there < limit) &
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
      if (!pass_events(group, k, these[k], ground, i)) advance_lane(group, k, these[k], ground, i);
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
  limit[k] = highest[k] = dip[k] = never;
  lowest[k] = -never;
  least[k] = -1;
}

void LinearGroup::take(std::size_t k, const LinearLane& lane) {
  hold(k);
  if (lane.failed) return;
  const LinearRegime regime = lane.levels != nullptr ? lane.levels->regime(lane.state) : lane.mover->regime(lane.state);
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
  if (step.smooth) dip[k] = step.duration;
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
