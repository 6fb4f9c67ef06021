// What a motion in the plane is shown to while it is computed, for code that is compiled once for all laws.
#pragma once

#include "stickslip/base/vector2.hpp"
#include "stickslip/planar/observer.hpp"
#include "stickslip/planar/path.hpp"
#include "stickslip/planar/state.hpp"
#include "stickslip/sliding/response.hpp"

namespace stickslip::detail {

/// Receives each event of a motion in the plane, and each slip with its last parameter and the time at which it begins
/// [s]; also the work of friction impulses on landing and the energy lost in impacts, per unit mass [m^2/s^2].
class PlanarSink {
 public:
  virtual void follow(const PlanarPath& path, double last, double begin) = 0;
  virtual void event(EventKind kind, double time, const PlanarState& state) = 0;
  virtual void dissipate(double /*work*/) {}
  virtual void lose(double /*energy*/) {}

 protected:
  ~PlanarSink() = default;
};

/// Shows a motion to an observer of any type.
template <PlanarObserver Observer>
class PlanarObserverSink final : public PlanarSink {
 public:
  /// @param observer  held by reference
  explicit PlanarObserverSink(Observer& observer) noexcept : observer_(observer) {}

  void follow(const PlanarPath& path, double last, double begin) override {
    if constexpr (requires { observer_.follow(path, last, begin); }) observer_.follow(path, last, begin);
  }
  void event(EventKind kind, double time, const PlanarState& state) override { observer_.event(kind, time, state); }
  void dissipate([[maybe_unused]] double work) override {
    if constexpr (PlanarEnergyObserver<Observer>) observer_.dissipate(work);
  }
  void lose([[maybe_unused]] double energy) override {
    if constexpr (PlanarEnergyObserver<Observer>) observer_.lose(energy);
  }

 private:
  Observer& observer_;
};

/// A part of a segment for the event loop, with times from the start of the whole segment.
struct WithinPlanarSegment {
  PlanarSink& sink;
  double begin;  // of the part [s]

  void follow(const PlanarPath& path, double last, double time) { sink.follow(path, last, begin + time); }
  void event(EventKind kind, double time, const PlanarState& state) { sink.event(kind, begin + time, state); }
  void dissipate(double work) { sink.dissipate(work); }
  void lose(double energy) { sink.lose(energy); }
};

}  // namespace stickslip::detail
