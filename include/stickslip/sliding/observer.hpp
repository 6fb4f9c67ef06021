// Observers of a motion while it is computed.
#pragma once

#include "stickslip/sliding/response.hpp"
#include "stickslip/state/state.hpp"

namespace stickslip {

/// A slip or a part of one, in one direction and within one segment, as passed to an observer.
struct Slip {
  Direction direction;
  double from;      ///< x at the start [m]
  double distance;  ///< sliding distance, at least 0 up to round-off [m]
  double duration;  ///< [s]
  double work;      ///< work of the ground motion on the slider, per unit mass [m^2/s^2]

  double to() const noexcept { return from + sign(direction) * distance; }  ///< x at the end [m]
};

/// Receives each slip, or part of one, and each event while a motion is computed. Times are measured from the start of
/// the segment [s]. If it has `follow(flow, taken)`, it first receives the motion of each
/// slip, whose place and speed are `flow.at(t)`, and its duration [s].
template <class Observer>
concept MotionObserver = requires(Observer& observer, const Slip& slip, double time, EventKind kind, State state) {
  observer.slide(slip);
  observer.event(kind, time, state);
};

/// An observer that also receives the work against friction, and the energy lost in impacts and landings, each per unit
/// mass [m^2/s^2]. If it has `counts_energy()`, that says whether it needs the work against friction, which costs time.
template <class Observer>
concept EnergyObserver = MotionObserver<Observer> && requires(Observer& observer, double work) {
  observer.dissipate(work);
  observer.lose(work);
};

namespace detail {

template <EnergyObserver Observer>
bool counts_energy(const Observer& observer) noexcept {
  if constexpr (requires { observer.counts_energy(); })
    return observer.counts_energy();
  else
    return true;
}

}  // namespace detail

/// An observer that ignores everything.
struct NoObserver {
  void slide(const Slip&) const noexcept {}
  void event(EventKind, double, const State&) const noexcept {}
};

}  // namespace stickslip
