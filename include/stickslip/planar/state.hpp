// The state of a slider in the plane.
#pragma once

#include <cstdint>

#include "stickslip/base/equal.hpp"
#include "stickslip/base/vector2.hpp"
#include "stickslip/state/surface_heat.hpp"

namespace stickslip {

/// Stuck, sliding freely, or sliding along a circular stop that it is pressed against.
enum class PlanarMode : std::uint8_t { stuck, sliding, along_stop };

/// Everything on which the future motion of a slider in the plane depends. As in State, the mode is stored, never
/// inferred from the velocity.
struct PlanarState {
  Vector2 displacement;  ///< r, relative to the ground [m]
  Vector2 velocity;      ///< r', relative to the ground [m/s]; 0 if stuck
  PlanarMode mode = PlanarMode::stuck;
  bool in_flight = false;       ///< whether the slider has left the ground
  double gap = 0;               ///< between slider and ground, in flight [m]
  double gap_velocity = 0;      ///< rate of the gap, in flight [m/s]
  double sliding_distance = 0;  ///< path length so far [m], at least 0
  /// Heat left in the sliding surface. Updated only if the law depends on its temperature (HeatedLaw).
  SurfaceHeat heat{};

  /// A state at rest if `velocity` is 0, else one that slides.
  static PlanarState at(Vector2 displacement, Vector2 velocity) noexcept {
    PlanarState state{.displacement = displacement, .velocity = velocity};
    if (!detail::equal(velocity.axis, 0) || !detail::equal(velocity.transverse, 0)) state.mode = PlanarMode::sliding;
    return state;
  }
};

}  // namespace stickslip
