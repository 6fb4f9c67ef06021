// Observers of a motion in the plane while it is computed.
#pragma once

#include "stickslip/planar/state.hpp"
#include "stickslip/sliding/response.hpp"

namespace stickslip {

/// Receives each event of a motion in the plane while it is computed; times are measured from the start of the segment
/// [s]. If it has `follow(flow, last, begin)`, it also receives each PlanarPath, its last parameter, and the time at
/// which it begins.
template <class Observer>
concept PlanarObserver = requires(Observer& observer, double time, EventKind kind, const PlanarState& state) {
  observer.event(kind, time, state);
};

/// An observer that also receives the energy lost in impacts and the work of friction impulses on landing, per unit
/// mass [m^2/s^2].
template <class Observer>
concept PlanarEnergyObserver = PlanarObserver<Observer> && requires(Observer& observer, double work) {
  observer.dissipate(work);
  observer.lose(work);
};

/// An observer that ignores everything.
struct NoPlanarObserver {
  void event(EventKind, double, const PlanarState&) const noexcept {}
};

}  // namespace stickslip
