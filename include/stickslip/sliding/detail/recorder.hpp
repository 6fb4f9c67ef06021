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
#include "stickslip/friction/law.hpp"
#include "stickslip/sliding/observer.hpp"
#include "stickslip/sliding/response.hpp"
#include "stickslip/state.hpp"

namespace stickslip::detail {

/// Maximum number of events in a motion. Without a spring there are at most five per segment.
constexpr std::size_t max_events(std::size_t segments) noexcept { return 1'000'000 + 8 * segments; }

[[noreturn, gnu::noinline]] inline void refuse_more_events(std::size_t event_limit,
                                                           double time = std::numeric_limits<double>::quiet_NaN()) {
  throw ConvergenceError(
      "more than " + std::to_string(event_limit) + " events" +
      (std::isnan(time) ? "" : " up to " + shortest(time) + " s") +
      ": the spring is too stiff, the slip level too low, or the restitution too near 1, for segments this "
      "long");
}

/// A flow that can have a damper.
template <class Flow>
concept FlowWithDamper = requires(const Flow& flow, double time) {
  flow.damped_work(time);
};

/// Accumulates the sums over slips and stores the events.
/// @tparam in_steps  slips come in steps, possibly enough per segment that they must report progress themselves
/// @tparam loaded    normal force may vary, and there may be stops: the event loop supplies the work against friction
template <FrictionLaw Law, bool in_steps = (form_of<Law> != Form::constant), bool loaded = false>
class Recorder {
 public:
  static constexpr std::uint32_t work_per_report = 16384;  // segments, events or steps, each far below a millisecond

  /// @param from         x at the start [m]
  /// @param event_limit  limit on the number of events; an event beyond it throws
  /// @param progress     called after each `work_per_report` segments, events or steps; may throw
  /// @param storage      memory for the events
  Recorder(const Law& law, double from, std::size_t event_limit, const std::function<void()>& progress,
           std::vector<Event> storage)
      : law_(law),
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

  /// Call the progress callback. The loop over segments does so regularly; within long segments, events and steps of
  /// Taylor flows do.
  void report_progress() const {
    if (progress_) progress_();
  }

  /// Add the work that only a flow can compute: on a damper, and against friction that depends on more than x.
  template <class Flow>
  requires(!PositionLaw<Law> || FlowWithDamper<Flow>) void follow(const Flow& flow, double taken) {
    if constexpr (FlowWithDamper<Flow>) damped_ += flow.damped_work(taken);
    if constexpr (!PositionLaw<Law> && !loaded) dissipated_ += flow.friction_work(taken);
    if constexpr (requires { flow.pendulum_work(taken); }) input_ += flow.pendulum_work(taken);
  }

  void dissipate(double work) requires loaded { dissipated_ += work; }
  void lose(double energy) requires loaded { impact_ += energy; }

  void slide(const Slip& slip) {
    if constexpr (in_steps) count_work();
    slip_direction_ = slip.direction;
    slip_distance_ += slip.distance;
    time_sliding_ += slip.duration;
    input_ += slip.work;
    if constexpr (PositionLaw<Law> && !LawWithWork<Law> && !loaded)
      dissipated_ += friction_work(law_, slip.from, slip.distance, slip.direction);
  }

  void event(EventKind kind, double time, const State& state) {
    count_work();
    if (events_.size() >= event_limit_) refuse_more_events(event_limit_, segment_begins_ + time);
    // Rounding may move the sum past the end of the segment.
    const double when = std::min(segment_begins_ + time, segment_ends_);
    events_.push_back({when, state.displacement, state.velocity, kind});
    peak_ = std::max(peak_, std::abs(state.displacement));  // x is monotonic between events
    sliding_distance_ += slip_distance_;
    if constexpr (LawWithWork<Law> && !loaded) dissipated_ += law_.work(slip_from_, slip_distance_, slip_direction_);
    slip_from_ = state.displacement;
    slip_distance_ = 0;
  }

  /// Add many events at once, starting from rest. Equivalent to calls of `slide` and `event`, except that the work of
  /// the ground is not added.
  /// @param event  the k-th of `count`, in order
  template <class Generate>
  void events(std::size_t count, Generate&& event) requires(form_of<Law> == Form::constant) {
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
    dissipated_ += law_.work(0, forward, Direction::forward) + law_.work(0, backward, Direction::backward);
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
    response.energy.input = input_;
    response.energy.dissipated = dissipated_;
    response.energy.damped = damped_;
    response.energy.impact = impact_;
  }

 private:
  void count_work() {
    if (++work_ % work_per_report == 0) report_progress();
  }

  const Law& law_;
  double segment_begins_ = 0, segment_ends_ = 0;
  double slip_from_;  // x at the start of the current slip
  double slip_distance_ = 0;
  Direction slip_direction_ = Direction::forward;
  double peak_;
  double sliding_distance_ = 0, time_sliding_ = 0, input_ = 0, dissipated_ = 0, damped_ = 0, impact_ = 0;
  std::vector<Event> events_;
  std::size_t event_limit_;
  std::uint32_t work_ = 0;
  const std::function<void()>& progress_;
};

/// Replaces a recorder if only the motion is needed.
class NoRecorder : public NoObserver {
 public:
  static constexpr std::uint32_t work_per_report = 4096;  // segments or events

  explicit NoRecorder(std::size_t event_limit, const std::function<void()>& progress)
      : event_limit_(event_limit), progress_(progress) {}

  void begin_segment(double, double) const noexcept {}
  void report_progress() const {
    if (progress_) progress_();
  }
  void event(EventKind, double, const State&) {
    if (++events_ % work_per_report != 0) return;
    report_progress();
    if (events_ > event_limit_) refuse_more_events(event_limit_);
  }

 private:
  std::size_t event_limit_, events_ = 0;
  const std::function<void()>& progress_;
};

}  // namespace stickslip::detail
