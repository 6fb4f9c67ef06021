// What can be seen of a motion while it is computed.
#pragma once

#include "stickslip/sliding/response.hpp"
#include "stickslip/state.hpp"

namespace stickslip {

/// A slip or a part of one, in one direction and within one segment, as a watcher of the motion sees it.
struct Slip {
  Direction direction;
  double from;      ///< x where it began [m]
  double distance;  ///< way slid, at least 0 but for round-off [m]
  double duration;  ///< [s]
  double work;      ///< of the ground on it [m^2/s^2]

  double to() const noexcept { return from + sign(direction) * distance; }  ///< x where it ended [m]
};

/// Watches a motion while it is computed: each slip or part of one, and each event. Times count from the beginning of
/// the segment [s]. One that has `follow(flow, taken)` is also shown each flow and how long it lasts [s].
template <class Observer>
concept MotionObserver = requires(Observer& observer, const Slip& slip, double time, EventKind kind, State state) {
  observer.slide(slip);
  observer.event(kind, time, state);
};

/// Watches nothing.
struct NoObserver {
  void slide(const Slip&) const noexcept {}
  void event(EventKind, double, const State&) const noexcept {}
};

}  // namespace stickslip
