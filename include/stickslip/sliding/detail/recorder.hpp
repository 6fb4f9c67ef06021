// Records the events and sums of a motion during integration.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "stickslip/base/function.hpp"
#include "stickslip/base/min_max.hpp"
#include "stickslip/error.hpp"
#include "stickslip/sliding/detail/engine.hpp"
#include "stickslip/sliding/detail/sink.hpp"
#include "stickslip/sliding/observer.hpp"
#include "stickslip/sliding/response.hpp"
#include "stickslip/state.hpp"

namespace stickslip::detail {

/// Maximum number of events in a motion. Without a spring there are at most five per segment.
constexpr std::size_t max_events(std::size_t segments) noexcept { return 1'000'000 + 8 * segments; }

/// Whether an energy falls too little within a duration to vanish before the longest one. After many cycles only.
inline bool rings_on(double before, double after, double duration, double longest) noexcept {
  return duration >= 8192 && before - after < before * (duration / longest);
}

[[noreturn, gnu::noinline]] inline void refuse_more_events(std::size_t event_limit,
                                                           double time = std::numeric_limits<double>::quiet_NaN()) {
  throw ConvergenceError(
      "more than " + std::to_string(event_limit) + " events" +
      (std::isnan(time) ? "" : " up to " + shortest(time) + " s") +
      ": the spring is too stiff, the slip level too low, or the restitution too near 1, for segments this "
      "long");
}

/// Accumulates the sums over slips and stores the events.
class Recorder final : public Sink {
 public:
  static constexpr std::uint32_t work_per_report = 16384;  // segments, events or steps, each far below a millisecond

  /// @param engine       of the slider
  /// @param loaded       the normal force may vary, or there may be stops: the engine adds the work against friction
  /// @param from         x at the start [m]
  /// @param event_limit  limit on the number of events; an event beyond it throws
  /// @param progress     called after each `work_per_report` segments, events or steps; may throw
  /// @param storage      memory for the events
  Recorder(const Engine& engine, bool loaded, double from, std::size_t event_limit,
           const std::function<void()>& progress, std::vector<Event> storage)
      : Sink(loaded || !engine.law().position ? Account::whole : Account::without_friction),
        engine_(engine),
        closed_work_(account() != Account::whole && engine.law().closed_work),
        work_of_slips_(account() != Account::whole && !closed_work_),
        slip_from_(from),
        peak_(std::abs(from)),
        events_(std::move(storage)),
        event_limit_(event_limit),
        progress_(progress) {
    events_.clear();
  }

  /// @param begin, end  times of the next segment [s]
  void begin_segment(double begin, double end) noexcept {
    segment_begins_ = begin;
    segment_ends_ = end;
  }

  /// Call the progress callback. The loop over segments does so regularly; within long segments, events and slips do.
  void report_progress() const {
    if (progress_) progress_();
  }

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
    if (events_.size() >= event_limit_) refuse_more_events(event_limit_, segment_begins_ + time);
    // Rounding may move the sum past the end of the segment.
    const double when = std::min(segment_begins_ + time, segment_ends_);
    events_.push_back({when, state.displacement, state.velocity, kind});
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
    if (events_.size() + count > event_limit_) refuse_more_events(event_limit_, segment_begins_);
    events_.resize(events_.size() + count);
    Event* const added = events_.data() + (events_.size() - count);
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

  /// Time of the last event [s]; minus infinity before the first.
  double last_event() const noexcept {
    return events_.empty() ? -std::numeric_limits<double>::infinity() : events_.back().time;
  }

  void finish(double time, const State& state, Response& response) {
    begin_segment(time, time);
    event(EventKind::end, 0, state);
    response.events = std::move(events_);
    response.peak = peak_;
    response.sliding_distance = sliding_distance_;
    response.time_sliding = time_sliding_;
    response.energy = energy;
  }

 private:
  void count_work() {
    if (++work_ % work_per_report == 0) report_progress();
  }

  const Engine& engine_;
  bool closed_work_, work_of_slips_;  // the work against friction is added at events, or at each slip
  double segment_begins_ = 0, segment_ends_ = 0;
  double slip_from_;  // x at the start of the current slip
  double slip_distance_ = 0;
  Direction slip_direction_ = Direction::forward;
  double peak_;
  double sliding_distance_ = 0, time_sliding_ = 0;
  std::vector<Event> events_;
  std::size_t event_limit_;
  std::uint32_t work_ = 0;
  const std::function<void()>& progress_;
};

/// Replaces a recorder if only the motion is needed.
class NoRecorder final : public Sink {
 public:
  static constexpr std::uint32_t work_per_report = 4096;  // segments or events

  explicit NoRecorder(std::size_t event_limit, const std::function<void()>& progress)
      : event_limit_(event_limit), progress_(progress) {}

  void begin_segment(double, double) const noexcept {}
  void report_progress() const {
    if (progress_) progress_();
  }
  void slide(const Slip&, const SlipFlow&) override {}
  void event(EventKind, double, const State&) override {
    if (++events_ % work_per_report != 0) return;
    report_progress();
    if (events_ > event_limit_) refuse_more_events(event_limit_);
  }

 private:
  std::size_t event_limit_, events_ = 0;
  const std::function<void()>& progress_;
};

}  // namespace stickslip::detail
