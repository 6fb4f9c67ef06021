// Records the events and sums of a motion during integration.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "stickslip/base/min_max.hpp"
#include "stickslip/run/detail/event_log.hpp"
#include "stickslip/sliding/detail/engine.hpp"
#include "stickslip/sliding/detail/sink.hpp"
#include "stickslip/sliding/observer.hpp"
#include "stickslip/sliding/response.hpp"
#include "stickslip/state/state.hpp"

namespace stickslip::detail {

/// Accumulates the sums over slips and stores the events.
class Recorder final : public Sink, public Pace<16384> {
 public:
  /// @param engine       of the slider
  /// @param loaded       the normal force may vary, or there may be stops: the engine adds the work against friction
  /// @param from         x at the start [m]
  /// @param event_limit  limit on the number of events; an event beyond it throws
  /// @param progress     called after each `work_per_report` segments, events or slips
  /// @param storage      memory for the events
  Recorder(const Engine& engine, bool loaded, double from, std::size_t event_limit,
           const std::function<void()>& progress, std::vector<Event> storage)
      : Sink(loaded || !engine.law().position ? Account::whole : Account::without_friction),
        Pace(progress),
        engine_(engine),
        closed_work_(account() != Account::whole && engine.law().closed_work),
        work_of_slips_(account() != Account::whole && !closed_work_),
        slip_from_(from),
        peak_(std::abs(from)),
        log_(event_limit, std::move(storage)) {}

  void begin_segment(double begin, double end) noexcept { log_.begin_segment(begin, end); }
  double last_event() const noexcept { return log_.last_event(); }

  void slide(const Slip& slip, const SlipFlow& /*flow*/) override {
    count_work();
    slip_direction_ = slip.direction;
    slip_distance_ += slip.distance;
    time_sliding_ += slip.duration;
    energy.input += slip.work;
    if (work_of_slips_) energy.dissipated += engine_.work(slip.from, slip.distance, slip.direction);
  }

  void event(EventKind kind, double time, const State& state) override {
    count_work();
    log_.add(kind, time, state.displacement, state.velocity);
    peak_ = std::max(peak_, std::abs(state.displacement));  // x is monotonic between events
    sliding_distance_ += slip_distance_;
    if (closed_work_) energy.dissipated += engine_.work(slip_from_, slip_distance_, slip_direction_);
    slip_from_ = state.displacement;
    slip_distance_ = 0;
  }

  /// Add many events of a law of constant levels at once, starting from rest. Equivalent to calls of `slide` and
  /// `event`, except that the work of the ground is not added.
  /// @param event  the k-th of `count`, in order
  template <class Generate>
  void events(std::size_t count, Generate&& event) {
    Event* const added = log_.grow(count);
    double x = slip_from_, time = 0, forward = 0, backward = 0, time_sliding = 0, peak = peak_;
    double slides = 0;  // 0 or 1: avoids an unpredictable branch
    for (std::size_t k = 0; k < count; ++k) {
      const Event e = added[k] = event(k);
      forward += std::max(e.displacement - x, 0.0);
      backward += std::max(x - e.displacement, 0.0);
      time_sliding += slides * (e.time - time);
      peak = std::max(peak, std::abs(e.displacement));
      slides = static_cast<double>(e.kind != EventKind::arrest);
      x = e.displacement;
      time = e.time;
    }
    sliding_distance_ += forward + backward;
    energy.dissipated += engine_.work(0, forward, Direction::forward) + engine_.work(0, backward, Direction::backward);
    time_sliding_ += time_sliding;
    peak_ = peak;
    slip_from_ = x;
  }

  void finish(Response& response) {
    response.events = log_.take();
    response.peak = peak_;
    response.sliding_distance = sliding_distance_;
    response.time_sliding = time_sliding_;
    response.energy = energy;
  }

 private:
  const Engine& engine_;
  bool closed_work_, work_of_slips_;  // the work against friction is added at events, or at each slip
  double slip_from_;                  // x at the start of the current slip
  double slip_distance_ = 0;
  Direction slip_direction_ = Direction::forward;
  double peak_;
  double sliding_distance_ = 0, time_sliding_ = 0;
  EventLog<double> log_;
};

/// Replaces a recorder if only the motion is needed.
class NoRecorder final : public Sink, public Pace<4096> {
 public:
  NoRecorder(std::size_t event_limit, const std::function<void()>& progress) : Pace(progress), events_(event_limit) {}

  void begin_segment(double, double) const noexcept {}
  void slide(const Slip&, const SlipFlow&) override {}
  void event(EventKind, double, const State&) override {
    count_work();
    ++events_;
  }

 private:
  EventCount events_;
};

}  // namespace stickslip::detail
