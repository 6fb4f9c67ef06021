// The state of a slider: position, velocity and mode.
#pragma once

#include <cstdint>

#include "stickslip/surface_heat.hpp"

namespace stickslip {

/// The two directions in which a slider can slide along its line.
enum class Direction : std::int8_t { backward = -1, forward = +1 };

/// +1 forward, -1 backward.
constexpr double sign(Direction direction) noexcept { return direction == Direction::forward ? 1.0 : -1.0; }

constexpr Direction opposite(Direction direction) noexcept {
  return direction == Direction::forward ? Direction::backward : Direction::forward;
}

/// Stuck, or sliding in a direction.
enum class Mode : std::int8_t { backward = -1, stuck = 0, forward = +1 };

constexpr Mode mode_of(Direction direction) noexcept { return static_cast<Mode>(direction); }

/// The direction of a mode that is not stuck.
constexpr Direction direction_of(Mode mode) noexcept { return static_cast<Direction>(mode); }

/// Everything on which future motion depends. The mode is stored, never inferred from (x, v): the same (x, v = 0) can
/// be a state of rest or the instant at which a slip begins.
struct State {
  double displacement = 0;  ///< x, relative to the ground [m]
  double velocity = 0;      ///< x', relative to the ground [m/s]; 0 if stuck, else never opposite to the mode
  Mode mode = Mode::stuck;
  bool in_flight = false;   ///< whether the slider has left the ground
  double gap = 0;           ///< between slider and ground, in flight [m]
  double gap_velocity = 0;  ///< rate of the gap, in flight [m/s]
  /// Total sliding distance so far, forward plus backward [m], at least 0. Updated only if the law depends on it
  /// (MemoryLaw).
  double sliding_distance = 0;
  /// Heat left in the sliding surface. Updated only if the law depends on its temperature (HeatedLaw).
  SurfaceHeat heat{};

  /// A state at rest if `velocity` is 0, else one that slides in its direction.
  static State at(double displacement, double velocity) noexcept {
    return {.displacement = displacement,
            .velocity = velocity,
            .mode = velocity > 0   ? Mode::forward
                    : velocity < 0 ? Mode::backward
                                   : Mode::stuck};
  }
};

}  // namespace stickslip
