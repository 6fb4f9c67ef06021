// The motion in the plane between two events.
#pragma once

#include <cmath>

#include "stickslip/base/equal.hpp"
#include "stickslip/base/min_max.hpp"
#include "stickslip/base/vector2.hpp"
#include "stickslip/flow/closed_form.hpp"
#include "stickslip/numerics/root.hpp"
#include "stickslip/planar/detail/closing_slip.hpp"
#include "stickslip/planar/detail/held_slip.hpp"
#include "stickslip/planar/detail/path_series.hpp"
#include "stickslip/slider/slider.hpp"

namespace stickslip {

/// The load on a slider in the plane and its weight N+/g, both linear in time, from now on.
struct PlanarLoad {
  Vector2 start;           ///< p [m/s^2]
  Vector2 rate;            ///< its rate [m/s^3]
  double weight = 1;       ///< N+/g
  double weight_rate = 0;  ///< its rate [1/s]
};

/// A slip in the plane, whose progress is a function of a parameter from 0 to `last`: time, or regularized time, or the
/// part that is over of the last moments before a stop. It does not depend on the law: the level is one of its series.
struct PlanarPath {
  enum class Kind : unsigned char { series, held, stop };

  /// @param start      r [m]
  /// @param moving     r' at the start [m/s]
  /// @param time_given  for which the load is given [s]
  PlanarPath(const Mounting& mounting, Vector2 start, Vector2 moving, const PlanarLoad& acts,
             double time_given) noexcept
      : damping(mounting.damping),
        gap(mounting.stops.forward()),
        spring(mounting.spring()),
        place(start),
        velocity(moving),
        load(acts),
        duration(time_given) {}

  double damping, gap;          ///< of the mounting; the gap is infinite without stops
  Spring spring;                ///< of the mounting
  Vector2 place, velocity;      ///< at the start
  PlanarLoad load;              ///< from the start
  double duration;              ///< for which the load is given [s]
  double last = 0;              ///< largest value of the parameter
  PlanarProgress end;           ///< there: the motion is not known after it
  bool stops = false;           ///< whether it stops there
  bool turns = false;           ///< whether it does not stop but turns, in less time than can be resolved
  bool along_stop = false;      ///< whether it slides along a circular stop
  bool leaves = false;          ///< whether it leaves the stop along which it slides, at the end
  bool leaves_at_once = false;  ///< whether it leaves a circular stop at the start

  Kind kind = Kind::series;
  detail::PathSeries series;      ///< of Kind::series
  detail::HeldSlip held;          ///< of Kind::held
  detail::ClosingSlip closing{};  ///< of Kind::stop
  bool constant_level = false;    ///< whether the level times the weight is
  double level = 0;               ///< resistance at the start times the weight; near a stop, the mean [m/s^2]

  /// The time at which it stops [s], or `never` if it does not stop before its end.
  double stop() const noexcept { return stops ? end.time : never; }
  bool is_series() const noexcept { return kind == Kind::series; }

  /// The progress at a parameter.
  PlanarProgress at_parameter(double s) const noexcept {
    if (kind == Kind::stop) return closing.at(1 - s, end);
    if (kind == Kind::held) return detail::equal(s, last) ? end : held.at(s);
    return series.at(s);
  }
  double distance_at(double s) const noexcept {
    return is_series() ? series.value(series.s, s) : at_parameter(s).distance;
  }

  /// r'' at a parameter [m/s^2]; at a stop, its limit there.
  Vector2 acceleration_at(double s) const noexcept {
    if (kind == Kind::held) return held.acceleration(s);
    if (along_stop)
      return (1 / series.slope(series.t, s)) * Vector2{series.slope(series.vx, s), series.slope(series.vy, s)};
    // By its forces: near a stop the derivative of the velocity is the difference of large numbers.
    const bool at_stop = kind == Kind::stop;
    PlanarProgress at = at_parameter(s);
    if (at_stop) at.velocity = at_parameter(std::min(s, 1 - 0x1p-40)).velocity;  // of which the direction has a limit
    const double weight = load.weight + load.weight_rate * at.time, speed = norm(at.velocity);
    const Vector2 q = load.start + at.time * load.rate - spring.under(weight) * (place + at.way);
    const double resists = at_stop ? closing.level - damping * norm(velocity) : series.level(s);
    const double size = norm(q);
    const Vector2 direction = speed > 0 ? (1 / speed) * at.velocity : size > 0 ? (1 / size) * q : Vector2{};
    return q - resists * direction - damping * at.velocity;
  }

  /// The parameter at a time from 0 to the end [s].
  double parameter(double time) const noexcept {
    if (!(time < end.time)) return last;
    if (!(time > 0)) return 0;
    if (kind == Kind::stop)
      return numerics::root([&](double s) { return at_parameter(s).time - time; }, 0, -time, 1, end.time - time);
    if (kind == Kind::held) return std::min(held.parameter(time), last);
    return series.parameter(time, last, end.time);
  }
  PlanarProgress at(double time) const noexcept {
    PlanarProgress progress = at_parameter(parameter(time));
    progress.time = std::min(time, end.time);
    return progress;
  }

  /// The first parameter up to `until` at which the path reaches a distance [m] from its start; `never` if it does not.
  double parameter_at_distance(double distance, double until) const noexcept {
    if (!(distance_at(until) > distance)) return never;
    double low = 0, high = until;
    for (double s = until / 2;;) {
      (distance_at(s) < distance ? low : high) = s;
      const double next = low + (high - low) / 2;
      if (next <= low || next >= high) return high;
      s = next;
    }
  }

  /// The load of the spring at the start [m/s^2].
  Vector2 pull() const noexcept { return spring.under(load.weight) * place; }
  /// A bound on the load during the segment [m/s^2].
  double largest_load() const noexcept { return norm(load.start) + norm(load.rate) * duration; }

  /// Shorten the parameter to the end of the segment, and evaluate there.
  void finish() noexcept {
    end = at_parameter(last);
    if (end.time >= duration * (1 - 0x1p-50)) {
      if (end.time > duration) {
        last = parameter(duration);
        end = at_parameter(last);
      }
      end.time = duration;
    }
  }
};

}  // namespace stickslip
