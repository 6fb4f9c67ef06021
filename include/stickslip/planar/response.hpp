// The response of a slider in the plane to a ground motion.
#pragma once

#include <string>
#include <vector>

#include "stickslip/planar/state.hpp"
#include "stickslip/sliding/response.hpp"
#include "stickslip/surface_heat.hpp"

namespace stickslip {

/// An instant at which a slider in the plane changes its mode, and the last one. A `reversal` is a stop of no duration;
/// generic motion in the plane has none, because its velocity turns without vanishing.
struct PlanarEvent {
  double time;           ///< [s]
  Vector2 displacement;  ///< r [m]
  Vector2 velocity;      ///< r' [m/s]; at an impact or a landing, before it
  EventKind kind;
};

/// The motion of a slider in the plane under one ground motion.
struct PlanarResponse {
  /// r at the samples of the motion [m]. With `settle`, if the slider still moves at the last sample, further samples
  /// follow with the last time step, up to the first at or after rest.
  std::vector<Vector2> displacement;
  std::vector<Vector2> velocity;    ///< r' at the same times [m/s]
  std::vector<PlanarEvent> events;  ///< in order of time; the last is the end
  double peak = 0;                  ///< largest |r| over all time, not only at samples [m]
  double peak_time = 0;             ///< its time [s]
  Vector2 peak_displacement{};      ///< r at that time [m]
  Vector2 residual{};               ///< r at the end [m]; final if the slider rests
  double sliding_distance = 0;      ///< path length [m]
  double time_sliding = 0;          ///< [s]
  /// The energy balance along the path, as for Response: the integrals of p.r', resist N+/g |r'| and c |r'|^2.
  Energy energy;
  std::vector<double> gap;  ///< between slider and ground at the same times, in flight [m]; empty if never in flight
  /// Temperature of the sliding surface at the same times [degrees Celsius]; empty if the law does not depend on it.
  std::vector<double> temperature;
  SurfaceHeat heat{};                 ///< of the sliding surface at the start
  bool truncated = false;             ///< as Response::truncated
  Contact contact = Contact::flight;  ///< the model used where N < 0
  std::string components;             ///< of the ground motion that acted, joined by " + "
  PlanarState state;                  ///< at the end: a motion can be continued from it
};

}  // namespace stickslip
