// One piece of a motion of the ground, and the load it puts on a slider.
//
// The event loop (advance.hpp) asks a piece three things: its first load, when the load outgrows what holds a slider at
// rest, and the start of a flow, which knows how the load goes on from there. One with a normal force that varies also
// says its weight, by which all friction is multiplied.
#pragma once

#include <cmath>
#include <numbers>

#include "stickslip/detail/equal.hpp"
#include "stickslip/detail/min_max.hpp"
#include "stickslip/flow/closed_form.hpp"
#include "stickslip/flow/sinusoidal.hpp"
#include "stickslip/state.hpp"
#include "stickslip/units.hpp"

namespace stickslip {

/// How and when a slider at rest begins to slip; stuck where it does not.
struct Departure {
  Mode mode = Mode::stuck;
  double delay = 0;  ///< from now [s]
};

/// Ground acceleration n(t) running straight from `start` to `end` within `duration`.
/// The load on a slider is p(t) = -n(t), the inertia force per unit mass.
struct Segment {
  double duration;  ///< [s], finite, at least 0
  double start;     ///< ground acceleration at its beginning [m/s^2], finite
  double end;       ///< ground acceleration at its end [m/s^2], finite; equal to `start` where a value is held

  double first_load() const noexcept { return -start; }
  /// p, `left` before the end [m/s^2].
  double load_before_end(double left) const noexcept { return -end + (end - start) * (left / duration); }

  /// Of a slider at rest, whose load net of its spring's pull is within both levels now.
  /// @param left  time to the end, positive [s]
  Departure departure(double net, double pull, double forward, double backward, double left) const noexcept {
    // What the load gains beyond the level, as the flow will have it: positive, however they are rounded.
    const double above = -end - (forward + pull), below = end - (backward - pull);
    if (above > 0) return {Mode::forward, left * ((forward - net) / ((forward - net) + above))};
    if (below > 0) return {Mode::backward, left * ((backward + net) / ((backward + net) + below))};
    return {};
  }

  /// Of a slip that goes in the direction of sign `s` under a load of `load` now [m/s^2].
  Start slip(double s, double speed, double acceleration, double load, double /*left*/) const noexcept {
    return {speed, acceleration, s * (-end - load)};
  }
};

/// The load p on a slider and the normal force N under it, both per unit mass and running straight within `duration`:
///     p = (g + a_z) sin(slope) - n cos(slope),    N = (g + a_z) cos(slope) + n sin(slope)
/// where n is the horizontal ground acceleration, positive toward the downhill side, and a_z the upward one [m/s^2].
/// Friction is what the law says times N+ / g, N+ = max(N, 0).
struct LoadSegment {
  double duration;      ///< [s], finite, at least 0
  double load_start;    ///< p at its beginning [m/s^2], finite
  double load_end;      ///< p at its end [m/s^2], finite
  double normal_start;  ///< N at its beginning [m/s^2], finite
  double normal_end;    ///< N at its end [m/s^2], finite

  /// p and N at a time within it [m/s^2].
  double load(double time) const noexcept { return load_start + (load_end - load_start) * (time / duration); }
  double normal(double time) const noexcept { return normal_start + (normal_end - normal_start) * (time / duration); }
};

namespace detail {

/// A piece of a load segment within which N has one sign, as the event loop asks it.
struct WeighedSegment {
  double duration;      ///< [s]
  double load_start;    ///< p at its beginning [m/s^2]
  double load_end;      ///< p at its end [m/s^2]
  double weight_start;  ///< N+ / g at its beginning, by which all friction is multiplied
  double weight_end;    ///< N+ / g at its end

  double first_load() const noexcept { return load_start; }
  /// p, `left` before its end [m/s^2].
  double load_before_end(double left) const noexcept { return load_end + (load_start - load_end) * (left / duration); }

  /// N+ / g, `left` before its end.
  double weight(double left) const noexcept {
    if (equal(left, duration)) return weight_start;
    return left > 0 ? weight_end + (weight_start - weight_end) * (left / duration) : weight_end;
  }

  /// A level [m/s^2] under this weight; what holds for good holds under none.
  static double weigh(double weight, double level) noexcept { return level < never ? weight * level : never; }

  /// As above; `pull` is the spring's at the end, `forward` and `backward` are levels under the weight g.
  Departure departure(double net, double pull, double forward, double backward, double left) const noexcept {
    const double above = load_end - (weigh(weight_end, forward) + pull);
    const double below = -load_end - (weigh(weight_end, backward) - pull);
    if (!(above > 0) && !(below > 0)) return {};
    const double now = weight(left);
    const auto delay = [&](double room, double beyond) { return left * (room / (room + beyond)); };
    const double first = above > 0 ? delay(weigh(now, forward) - net, above) : never;
    const double second = below > 0 ? delay(weigh(now, backward) + net, below) : never;
    if (first < second) return {Mode::forward, first};
    return {Mode::backward, second};
  }

  /// As above; `level` is what resists under the weight g when it begins [m/s^2].
  LoadStart slip(double s, double speed, double acceleration, double now, double left, double level) const noexcept {
    const double weight_now = weight(left), gained = s * (load_end - now), weight_gained = weight_end - weight_now;
    return {{speed, acceleration, gained - level * weight_gained}, gained, weight_now, weight_gained, level};
  }
};

/// The angle of the ground to the horizontal.
struct Slope {
  double sine, cosine;

  Slope(double angle) noexcept : sine(std::sin(angle)), cosine(std::cos(angle)) {}  // [rad]
};

/// The load and the normal force that a piece of ground motion makes on a slope.
/// @param n, up   horizontal and upward ground acceleration at both ends [m/s^2]
inline LoadSegment load_segment(const Segment& n, const Slope& slope, double up_start = 0, double up_end = 0) noexcept {
  const double heavy_start = standard_gravity + up_start, heavy_end = standard_gravity + up_end;
  const auto [s, c] = slope;
  return {n.duration, heavy_start * s - n.start * c, heavy_end * s - n.end * c, heavy_start * c + n.start * s,
          heavy_end * c + n.end * s};
}

}  // namespace detail

/// Ground acceleration n(t) = -amplitude cos(phase + omega t), thesis (2.28), within `duration`.
struct HarmonicSegment {
  double duration;   ///< [s], finite, at least 0
  double amplitude;  ///< B [m/s^2], positive and finite
  double omega;      ///< [rad/s], positive, with a finite square
  double phase;      ///< at its beginning [rad], of some periods at most

  double first_load() const noexcept { return amplitude * std::cos(phase); }
  /// p, `left` before its end [m/s^2].
  double load_before_end(double left) const noexcept { return amplitude * std::cos(phase + omega * (duration - left)); }

  Departure departure(double net, double pull, double forward, double backward, double left) const noexcept {
    const double most = amplitude * (omega * left);  // that it can gain, or lose
    if (net + most <= forward && net - most >= -backward) return {};
    const double now = phase + omega * (duration - left);
    const double one = time_to_exceed(forward + pull, now);
    const double other = time_to_exceed(backward - pull, now + std::numbers::pi);
    if (std::min(one, other) > left) return {};
    return one < other ? Departure{Mode::forward, one} : Departure{Mode::backward, other};
  }

  SinusoidalStart slip(double s, double speed, double acceleration, double /*load*/, double left) const noexcept {
    return {speed, acceleration, s * amplitude, omega, phase + omega * (duration - left)};
  }

 private:
  // Time until B cos(phase) rises above a level [s]. Where it is above already, but for rounding, that is now while it
  // rises, and a period later when it falls.
  double time_to_exceed(double level, double from) const noexcept {
    const double room = (amplitude - level) / (2 * amplitude);           // at most 1
    if (!(room > 0)) return never;                                       // a tangent load holds
    const double above = 2 * std::asin(std::sqrt(std::min(room, 1.0)));  // above the level up to this phase
    const double now = std::remainder(from, 2 * std::numbers::pi);
    if (now < -above) return (-above - now) / omega;
    constexpr double at_top = 0x1p-40;  // from where it gains less than round-off
    return now < -at_top ? 0 : (2 * std::numbers::pi - above - now) / omega;
  }
};

}  // namespace stickslip
