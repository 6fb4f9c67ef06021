// Where a slider is, how fast it moves, and in which mode.
#pragma once

#include <cstdint>

#include "stickslip/surface_heat.hpp"

namespace stickslip {

/// The two ways a slider can slide along its line.
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

/// All that the motion to come depends on. The mode is carried, never derived again from (x, v): the same (x, v = 0)
/// can be a rest or the instant in which a slip begins.
struct State {
  double displacement = 0;  ///< x, relative to the ground [m]
  double velocity = 0;      ///< x', relative to the ground [m/s]; 0 where stuck, else never against the mode
  Mode mode = Mode::stuck;
  bool in_flight = false;   ///< whether the slider has left the ground
  double gap = 0;           ///< between slider and ground, in flight [m]
  double gap_velocity = 0;  ///< rate of the gap, in flight [m/s]
  /// Slid so far, forward and backward alike [m], at least 0. Counted where the law depends on it (MemoryLaw), else
  /// left as it is.
  double sliding_distance = 0;
  /// Left at the surface, where the law depends on its temperature (HeatedLaw), else cold.
  SurfaceHeat heat{};

  /// At rest where `velocity` is 0, else sliding the way it points.
  static State at(double displacement, double velocity) noexcept {
    return {.displacement = displacement,
            .velocity = velocity,
            .mode = velocity > 0   ? Mode::forward
                    : velocity < 0 ? Mode::backward
                                   : Mode::stuck};
  }
};

}  // namespace stickslip
