// The state of a slider: position, velocity and mode.
#pragma once

#include <cstdint>

#include "stickslip/state/pendulum_memory.hpp"
#include "stickslip/state/surface_heat.hpp"

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
  /// Where the elements of a MultiPendulum are. A state without it has come from the center in one motion.
  PendulumMemory pendulum{};

  /// A state at rest if `velocity` is 0, else one that slides in its direction.
  static State at(double displacement, double velocity) noexcept {
    return {.displacement = displacement,
            .velocity = velocity,
            .mode = velocity > 0   ? Mode::forward
                    : velocity < 0 ? Mode::backward
                                   : Mode::stuck};
  }
};

namespace detail {

/// A state without the memory of a law. The event loop carries it for laws without memory: it is much smaller to copy.
struct BareState {
  double displacement = 0, velocity = 0;
  Mode mode = Mode::stuck;
  bool in_flight = false;
  double gap = 0, gap_velocity = 0;

  BareState() = default;
  explicit BareState(const State& s) noexcept
      : displacement(s.displacement),
        velocity(s.velocity),
        mode(s.mode),
        in_flight(s.in_flight),
        gap(s.gap),
        gap_velocity(s.gap_velocity) {}
  explicit operator State() const noexcept {
    return {.displacement = displacement,
            .velocity = velocity,
            .mode = mode,
            .in_flight = in_flight,
            .gap = gap,
            .gap_velocity = gap_velocity};
  }
  /// Replaces these parts of a state.
  void store(State& s) const noexcept {
    s.displacement = displacement;
    s.velocity = velocity;
    s.mode = mode;
    s.in_flight = in_flight;
    s.gap = gap;
    s.gap_velocity = gap_velocity;
  }
};

}  // namespace detail

}  // namespace stickslip
