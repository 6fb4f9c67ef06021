// The load on a slider over a segment, in the form that the event loop uses.
#pragma once

#include <cmath>
#include <numbers>

#include "stickslip/base/equal.hpp"
#include "stickslip/base/min_max.hpp"
#include "stickslip/flow/closed_form.hpp"
#include "stickslip/flow/detail/maker.hpp"
#include "stickslip/flow/sinusoidal.hpp"
#include "stickslip/ground/segment.hpp"
#include "stickslip/state/state.hpp"

namespace stickslip::detail {

/// A level [m/s^2] under a weight N+/g; an infinite level stays infinite even at zero weight.
constexpr double weigh(double weight, double level) noexcept { return level < never ? weight * level : never; }

/// The load on a slider over a segment, and the weight by which its friction is multiplied:
///
///     duration                // [s]
///     first()                 // load at the beginning [m/s^2]
///     before_end(left)        // load at the time `left` before the end [m/s^2]
///     weight(left)            // N+/g at that time
///     weigh(weight, level)    // a level under a weight [m/s^2]
///     departure(net, pull, forward, backward, left)
///                             // when the load exceeds a level, and the rise from there on. Now, `left` before the
///                             // end, the net load is within both; `pull` is the force of the spring at the end, levels
///                             // are for the weight g
///     slip(s, speed, acceleration, rise, now, left, level)
///                             // the start of a slip in the direction of sign s, at the load `now`; `rise` is that of its
///                             // departure, or 0; `level()` is the resistance there, for the weight g
template <class L>
concept SegmentLoad = requires(const L& load, double value, double (*level)()) {
  load.duration;
  load.first();
  load.before_end(value);
  load.weight(value);
  L::weigh(value, value);
  load.departure(value, value, value, value, value).mode;
  load.slip(value, value, value, value, value, value, level).speed;
};

/// A load that is linear in time, on level ground without vertical motion.
struct LinearLoad {
  double duration;  ///< [s]
  double start;     ///< ground acceleration at the beginning [m/s^2], the negative load
  double end;       ///< and at the end

  double first() const noexcept { return -start; }
  double before_end(double left) const noexcept { return -end + (end - start) * (left / duration); }
  static constexpr double weight(double) noexcept { return 1; }
  static constexpr double weigh(double, double level) noexcept { return level; }

  Departure departure(double net, double pull, double forward, double backward, double left) const noexcept {
    // How far the load ends beyond each level.
    const double above = -end - (forward + pull), below = end - (backward - pull);
    const auto delay = [&](double room, double beyond) { return left * (room / (room + beyond)); };
    if (above > 0) return {.mode = Mode::forward, .delay = delay(forward - net, above), .rise = above};
    if (below > 0) return {.mode = Mode::backward, .delay = delay(backward + net, below), .rise = below};
    return {};
  }

  template <class Level>
  Start slip(double s, double speed, double acceleration, double rise, double now, double /*left*/,
             const Level&) const noexcept {
    return {speed, acceleration, rise > 0 ? rise : s * (-end - now)};
  }
};

/// A load and a weight that are linear in time; N has one sign.
struct WeighedLoad {
  double duration;      ///< [s]
  double load_start;    ///< p at the beginning [m/s^2]
  double load_end;      ///< p at the end [m/s^2]
  double weight_start;  ///< N+/g at the beginning
  double weight_end;    ///< N+/g at the end

  double first() const noexcept { return load_start; }
  double before_end(double left) const noexcept { return load_end + (load_start - load_end) * (left / duration); }
  double weight(double left) const noexcept {
    if (equal(left, duration)) return weight_start;
    return left > 0 ? weight_end + (weight_start - weight_end) * (left / duration) : weight_end;
  }
  static constexpr double weigh(double weight, double level) noexcept { return detail::weigh(weight, level); }

  Departure departure(double net, double pull, double forward, double backward, double left) const noexcept {
    const double above = load_end - (weigh(weight_end, forward) + pull);
    const double below = -load_end - (weigh(weight_end, backward) - pull);
    if (!(above > 0) && !(below > 0)) return {};
    const double now = weight(left);
    // The room is not negative; contracted, its product may round otherwise than where that was decided.
    const auto delay = [&](double room, double beyond) {
      return left * (std::max(room, 0.0) / (std::max(room, 0.0) + beyond));
    };
    const double first = above > 0 ? delay(weigh(now, forward) - net, above) : never;
    const double second = below > 0 ? delay(weigh(now, backward) + net, below) : never;
    if (first < second) return {.mode = Mode::forward, .delay = first, .rise = above};
    return {.mode = Mode::backward, .delay = second, .rise = below};
  }

  template <class Level>
  LoadStart slip(double s, double speed, double acceleration, double rise, double now, double left,
                 const Level& level) const {
    const double resists = level(), weight_now = weight(left);
    const double gained = s * (load_end - now), weight_gained = weight_end - weight_now;
    return {{speed, acceleration, rise > 0 ? rise : gained - resists * weight_gained},
            gained,
            weight_now,
            weight_gained,
            resists,
            rise > 0};
  }
};

/// A load that is a cosine in time, on level ground without vertical motion.
struct CosineLoad {
  double duration, amplitude, omega, phase;  ///< as in HarmonicSegment

  double first() const noexcept { return amplitude * std::cos(phase); }
  double before_end(double left) const noexcept { return amplitude * std::cos(phase + omega * (duration - left)); }
  static constexpr double weight(double) noexcept { return 1; }
  static constexpr double weigh(double, double level) noexcept { return level; }

  Departure departure(double net, double pull, double forward, double backward, double left) const noexcept {
    const double most = amplitude * (omega * left);  // bound on the change of the load
    if (net + most <= forward && net - most >= -backward) return {};
    const double now = phase + omega * (duration - left);
    const double one = time_to_exceed(forward + pull, now);
    const double other = time_to_exceed(backward - pull, now + std::numbers::pi);
    if (std::min(one, other) > left) return {};
    const bool forth = one < other;
    return {.mode = forth ? Mode::forward : Mode::backward, .delay = forth ? one : other, .rise = amplitude};
  }

  template <class Level>
  SinusoidalStart slip(double s, double speed, double acceleration, double rise, double /*now*/, double left,
                       const Level&) const noexcept {
    const double now = phase + omega * (duration - left);
    // A slip that begins at its level does so before the load is largest; the round-off of a phase of many cycles may put
    // it after that.
    if (rise > 0 && !(s * std::sin(now) < 0)) return {speed, acceleration, amplitude, omega, -at_top};
    return {speed, acceleration, s * amplitude, omega, now};
  }

 private:
  static constexpr double at_top = 0x1p-40;  // from this phase before it the load rises by less than round-off

  // Time until B cos(phase) rises above a level [s]. If round-off has already put it above the level, the time is zero
  // while it rises, and about a period while it falls.
  double time_to_exceed(double level, double from) const noexcept {
    const double room = (amplitude - level) / (2 * amplitude);  // at most 1
    if (!(room > 0)) return never;                              // a load that only touches the level does not exceed it
    const double above = 2 * std::asin(std::sqrt(std::min(room, 1.0)));  // above the level while |phase| is less
    const double now = std::remainder(from, 2 * std::numbers::pi);
    if (now < -above) return (-above - now) / omega;
    return now < -at_top ? 0 : (2 * std::numbers::pi - above - now) / omega;
  }
};

/// The load of a segment on level ground.
constexpr LinearLoad load_of(const Segment& s) noexcept { return {s.duration, s.start, s.end}; }
constexpr CosineLoad load_of(const HarmonicSegment& s) noexcept { return {s.duration, s.amplitude, s.omega, s.phase}; }
constexpr const WeighedLoad& load_of(const WeighedLoad& load) noexcept { return load; }

}  // namespace stickslip::detail
