// One piece of a motion of the ground, and the load it puts on a slider.
//
// The event loop (advance.hpp) asks a piece three things: its first load, when the load outgrows what holds a slider at
// rest, and the start of a flow, which knows how the load goes on from there.
#pragma once

#include <cmath>
#include <numbers>

#include "stickslip/detail/min_max.hpp"
#include "stickslip/flow/closed_form.hpp"
#include "stickslip/flow/sinusoidal.hpp"
#include "stickslip/state.hpp"

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

/// Ground acceleration n(t) = -amplitude cos(phase + omega t), thesis (2.28), within `duration`.
struct HarmonicSegment {
  double duration;   ///< [s], finite, at least 0
  double amplitude;  ///< B [m/s^2], positive and finite
  double omega;      ///< [rad/s], positive, with a finite square
  double phase;      ///< at its beginning [rad], of some periods at most

  double first_load() const noexcept { return amplitude * std::cos(phase); }

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
