// What a motion under one ground motion consists of, on one axis and in the plane.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "stickslip/base/requirements.hpp"

namespace stickslip {

/// Behavior of a slider while the ground accelerates away from it faster than it can fall, N = g + a_z < 0.
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
/// @tparam Place  a number on one axis, a Vector2 in the plane
template <class Place>
struct EventAt {
  double time;         ///< [s]
  Place displacement;  ///< relative to the ground [m]
  Place velocity;      ///< [m/s]
  EventKind kind;
};

/// The energy balance of the motion along x, per unit mass [J/kg = m^2/s^2]:
///     initial + input = dissipated + damped + impact + kinetic + elastic.
struct Energy {
  double initial = 0;     ///< kinetic and elastic at the start
  double input = 0;       ///< work of the load on the slider, the integral of p x' dt; on level ground p = -n
  double dissipated = 0;  ///< work against friction, the integral of resist N+/g |x'| dt, and its impulses on landing
  double damped = 0;      ///< work on the damper, the integral of c x'^2 dt
  double kinetic = 0;     ///< x'^2 / 2 at the end
  double elastic = 0;     ///< wn^2 x^2 / 2 at the end, and what the springs in the law hold
  double impact = 0;      ///< lost on stops, the sum of (1 - restitution^2) x'^2 / 2

  /// The imbalance of these terms [m^2/s^2]: round-off.
  double imbalance() const noexcept { return initial + input - dissipated - damped - impact - kinetic - elastic; }
};

/// The motion of a slider under one ground motion.
/// @tparam Place  a number x on one axis, a Vector2 r in the plane
template <class Place, class State>
struct ResponseOf {
  /// Displacement at the samples of the motion [m]. With `settle`, if the slider still moves at the last sample,
  /// further samples follow with the last time step of the motion, up to the first at or after rest. Sample i is at
  /// `time(i)` of the motion.
  std::vector<Place> displacement;
  std::vector<Place> velocity;         ///< at the same times [m/s]
  std::vector<EventAt<Place>> events;  ///< in order of time; the last is the end
  double peak = 0;                     ///< largest distance from the origin over all time, not only at samples [m]
  Place residual{};                    ///< displacement at the end [m]; final if the slider rests
  double sliding_distance = 0;         ///< path length, on one axis in both directions [m]
  double time_sliding = 0;             ///< [s]
  Energy energy;                       ///< along the path
  std::vector<double> gap;  ///< between slider and ground at the same times, in flight [m]; empty if never in flight
  /// Whether displacement and velocity end before the slider rests, at ten times the number of samples of the motion.
  /// All other values are those of the final rest.
  bool truncated = false;
  Contact contact = Contact::flight;  ///< the model used where N < 0
  std::string components = "axis";    ///< of the ground motion that acted, joined by " + "
  State state;                        ///< at the end: a motion can be continued from it
  /// Temperature of the sliding surface at the same times [degrees Celsius]; empty if the law does not depend on it.
  std::vector<double> temperature;
};

/// The displacements and velocities at the samples of a ground motion.
template <class Place>
struct HistoriesOf {
  std::vector<Place> displacement;  ///< [m]
  std::vector<Place> velocity;      ///< [m/s]
};

}  // namespace stickslip
