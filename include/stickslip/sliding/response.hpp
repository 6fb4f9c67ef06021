// The response of a slider to a ground motion.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "stickslip/state.hpp"

namespace stickslip {

/// What a slider does where the ground falls away from under it faster than it falls itself, N = g + a_z < 0.
enum class Contact {
  /// It is in flight without friction, with the gap y'' = -N; spring, damper and stops continue to act. It lands when
  /// y = 0, plastically, with a friction impulse -mu |y'| against x' that can stop the slider but not reverse it.
  flight,
  /// It stays on the ground; friction is zero while N < 0.
  clipped
};

/// The kinds of event.
enum class EventKind : std::uint8_t {
  breakaway,  ///< a slip begins (or is already in progress at the start)
  reversal,   ///< the slip changes direction without sticking
  arrest,     ///< a slip ends and the slider sticks
  end,        ///< the motion is over
  impact,     ///< the slider hits a stop; the velocity is that before the impact
  liftoff,    ///< the slider leaves the ground
  landing     ///< the slider lands; the velocity is that before the friction impulse
};

/// An instant at which the slider changes its mode, and the last one.
struct Event {
  double time;          ///< [s]
  double displacement;  ///< x [m]
  double velocity;      ///< x' [m/s]
  EventKind kind;
};

/// Where the energy of the motion along x went, per unit mass [J/kg = m^2/s^2]:
///     initial + input = dissipated + damped + impact + kinetic + elastic.
struct Energy {
  double initial = 0;     ///< kinetic and elastic at the start
  double input = 0;       ///< work of the load on the slider, the integral of p x' dt; on level ground p = -n
  double dissipated = 0;  ///< work against friction, the integral of resist N+/g |x'| dt, and its impulses on landing
  double damped = 0;      ///< work on the damper, the integral of c x'^2 dt
  double kinetic = 0;     ///< x'^2 / 2 at the end
  double elastic = 0;     ///< wn^2 x^2 / 2 at the end
  double impact = 0;      ///< lost on stops, the sum of (1 - restitution^2) x'^2 / 2

  /// What does not add up [m^2/s^2]: round-off.
  double imbalance() const noexcept { return initial + input - dissipated - damped - impact - kinetic - elastic; }
};

/// The motion of a slider under one ground motion.
struct Response {
  /// x at the samples of the motion [m]. Where `integrate` was asked to settle and the slider still moves at the last
  /// of them, further samples follow at the motion's last step, up to the first at or after rest; `time(i)` of the
  /// motion is the time of each.
  std::vector<double> displacement;
  std::vector<double> velocity;  ///< x' at the same times [m/s]
  std::vector<Event> events;     ///< in order of time; the last is the end
  double peak = 0;               ///< largest |x| over all time, not only at samples [m]
  double residual = 0;           ///< x at the end [m]; final if the slider rests
  double sliding_distance = 0;   ///< length of the way slid [m]
  double time_sliding = 0;       ///< [s]
  Energy energy;
  std::vector<double> gap;  ///< between slider and ground at the same times, while it flies [m]; empty if it never did
  /// Whether displacement and velocity end before the slider rests, at ten times the number of samples of the motion.
  /// All else is that of the final rest.
  bool truncated = false;
  Contact contact = Contact::flight;  ///< what was asked of it where the ground falls away from under it
  std::string components = "axis";    ///< of the ground motion that acted, joined by " + "
  State state;                        ///< at the end: a motion can be continued from it
  /// Of the sliding surface at the same times [degrees Celsius], where the law depends on it; else empty.
  std::vector<double> temperature;
};

}  // namespace stickslip
