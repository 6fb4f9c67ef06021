// What a motion in the plane is shown to while it is computed, for code that is compiled once for all laws.
#pragma once

#include "stickslip/planar/flow.hpp"
#include "stickslip/planar/observer.hpp"
#include "stickslip/planar/state.hpp"
#include "stickslip/planar/vector.hpp"
#include "stickslip/sliding/response.hpp"

namespace stickslip::detail {

/// A PlanarFlow of any law, with the functions of the same names; valid while it is shown.
class PlanarSlipFlow {
 public:
  template <class Flow>
  explicit PlanarSlipFlow(const Flow& flow) noexcept : flow_(&flow), answers_(&answers_of<Flow>) {}

  Vector2 place() const { return answers_->place(flow_); }
  PlanarProgress at_parameter(double s) const { return answers_->at_parameter(flow_, s); }
  Vector2 acceleration_at(double s) const { return answers_->acceleration_at(flow_, s); }
  double largest_radius(double until, double peak, double& where) const {
    return answers_->largest_radius(flow_, until, peak, where);
  }
  PlanarWork work(double s) const { return answers_->work(flow_, s); }

 private:
  struct Answers {
    Vector2 (*place)(const void*);
    PlanarProgress (*at_parameter)(const void*, double);
    Vector2 (*acceleration_at)(const void*, double);
    double (*largest_radius)(const void*, double, double, double&);
    PlanarWork (*work)(const void*, double);
  };
  template <class Flow>
  static constexpr Answers answers_of{
      [](const void* flow) { return static_cast<const Flow*>(flow)->place(); },
      [](const void* flow, double s) { return static_cast<const Flow*>(flow)->at_parameter(s); },
      [](const void* flow, double s) { return static_cast<const Flow*>(flow)->acceleration_at(s); },
      [](const void* flow, double until, double peak, double& where) {
        return static_cast<const Flow*>(flow)->largest_radius(until, peak, where);
      },
      [](const void* flow, double s) { return static_cast<const Flow*>(flow)->work(s); }};

  const void* flow_;
  const Answers* answers_;
};

/// Receives each event of a motion in the plane, and each flow with its last parameter and the time at which it begins
/// [s]; also the work of friction impulses on landing and the energy lost in impacts, per unit mass [m^2/s^2].
class PlanarSink {
 public:
  virtual void follow(const PlanarSlipFlow& flow, double last, double begin) = 0;
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

  void follow(const PlanarSlipFlow& flow, double last, double begin) override {
    if constexpr (requires { observer_.follow(flow, last, begin); }) observer_.follow(flow, last, begin);
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

  template <class Flow>
  void follow(const Flow& flow, double last, double time) {
    sink.follow(PlanarSlipFlow(flow), last, begin + time);
  }
  void event(EventKind kind, double time, const PlanarState& state) { sink.event(kind, begin + time, state); }
  void dissipate(double work) { sink.dissipate(work); }
  void lose(double energy) { sink.lose(energy); }
};

}  // namespace stickslip::detail
