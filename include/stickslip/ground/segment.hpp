// A segment of a ground motion, and the load it exerts on a slider.
//
// A segment gives the event loop (advance.hpp) its first load, the time at which the load exceeds the friction that
// holds a slider at rest (`departure`), and the start of a flow, which contains the further course of the load
// (`slip`). A segment with a variable normal force also gives the weight by which all friction is multiplied.
#pragma once

#include <cmath>
#include <numbers>

#include "stickslip/base/equal.hpp"
#include "stickslip/base/min_max.hpp"
#include "stickslip/flow/closed_form.hpp"
#include "stickslip/flow/sinusoidal.hpp"
#include "stickslip/state.hpp"
#include "stickslip/units.hpp"

namespace stickslip {

/// The direction and the time in which a slider at rest begins to slip; stuck if it stays at rest.
struct Departure {
  Mode mode = Mode::stuck;
  double delay = 0;  ///< from now [s]
};

/// Ground acceleration n(t), linear from `start` to `end` within `duration`.
/// The load on a slider is p(t) = -n(t), the inertia force per unit mass.
struct Segment {
  double duration;  ///< [s], finite, at least 0
  double start;     ///< ground acceleration at its beginning [m/s^2], finite
  double end;       ///< ground acceleration at its end [m/s^2], finite; equal to `start` if the value is held

  double first_load() const noexcept { return -start; }
  /// p at the time `left` before the end [m/s^2].
  double load_before_end(double left) const noexcept { return -end + (end - start) * (left / duration); }

  /// The departure of a slider at rest. The net load, p minus the pull of the spring, is now within both levels.
  /// @param net   net load now [m/s^2]
  /// @param pull  force of the spring, per unit mass [m/s^2]
  /// @param left  time to the end, positive [s]
  Departure departure(double net, double pull, double forward, double backward, double left) const noexcept {
    // How far the load ends beyond each level. Computed as in the flow, to have the same sign under round-off.
    const double above = -end - (forward + pull), below = end - (backward - pull);
    if (above > 0) return {Mode::forward, left * ((forward - net) / ((forward - net) + above))};
    if (below > 0) return {Mode::backward, left * ((backward + net) / ((backward + net) + below))};
    return {};
  }

  /// The start of a slip in the direction of sign `s`, at the present load `load` [m/s^2].
  Start slip(double s, double speed, double acceleration, double load, double /*left*/) const noexcept {
    return {speed, acceleration, s * (-end - load)};
  }
};

/// The load p on a slider and the normal force N under it, both per unit mass and linear within `duration`:
///     p = (g + a_z) sin(slope) - n cos(slope),    N = (g + a_z) cos(slope) + n sin(slope)
/// where n is the horizontal ground acceleration, positive toward the downhill side, and a_z the upward one [m/s^2].
/// Friction is the level of the law times N+ / g, N+ = max(N, 0).
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

/// A part of a load segment within which N has one sign, in the form that the event loop uses.
struct WeighedSegment {
  double duration;      ///< [s]
  double load_start;    ///< p at its beginning [m/s^2]
  double load_end;      ///< p at its end [m/s^2]
  double weight_start;  ///< N+ / g at its beginning, by which all friction is multiplied
  double weight_end;    ///< N+ / g at its end

  double first_load() const noexcept { return load_start; }
  /// p at the time `left` before its end [m/s^2].
  double load_before_end(double left) const noexcept { return load_end + (load_start - load_end) * (left / duration); }

  /// N+ / g at the time `left` before its end.
  double weight(double left) const noexcept {
    if (equal(left, duration)) return weight_start;
    return left > 0 ? weight_end + (weight_start - weight_end) * (left / duration) : weight_end;
  }

  /// A level [m/s^2] under this weight; an infinite level stays infinite even at zero weight.
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

  /// As above; `level` is the resistance at the start, under the weight g [m/s^2].
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

/// The load and the normal force that a segment of ground motion causes on a slope.
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
  double phase;      ///< at its beginning [rad], at most a few periods

  double first_load() const noexcept { return amplitude * std::cos(phase); }
  /// p, `left` before its end [m/s^2].
  double load_before_end(double left) const noexcept { return amplitude * std::cos(phase + omega * (duration - left)); }

  Departure departure(double net, double pull, double forward, double backward, double left) const noexcept {
    const double most = amplitude * (omega * left);  // bound on the change of the load
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
  // Time until B cos(phase) rises above a level [s]. If round-off has already put it above the level, the time is zero
  // while it rises, and about a period while it falls.
  double time_to_exceed(double level, double from) const noexcept {
    const double room = (amplitude - level) / (2 * amplitude);  // at most 1
    if (!(room > 0)) return never;                              // a load that only touches the level does not exceed it
    const double above = 2 * std::asin(std::sqrt(std::min(room, 1.0)));  // above the level while |phase| is less
    const double now = std::remainder(from, 2 * std::numbers::pi);
    if (now < -above) return (-above - now) / omega;
    constexpr double at_top = 0x1p-40;  // from here the load rises by less than round-off
    return now < -at_top ? 0 : (2 * std::numbers::pi - above - now) / omega;
  }
};

}  // namespace stickslip
