// Keeps the account of a motion while it is computed, or none.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "stickslip/detail/function.hpp"
#include "stickslip/detail/min_max.hpp"
#include "stickslip/error.hpp"
#include "stickslip/friction/law.hpp"
#include "stickslip/sliding/observer.hpp"
#include "stickslip/sliding/response.hpp"
#include "stickslip/state.hpp"

namespace stickslip::detail {

/// Events that a motion may have; without a spring one has five a segment at most.
constexpr std::size_t max_events(std::size_t segments) noexcept { return 1'000'000 + 8 * segments; }

[[noreturn, gnu::noinline]] inline void refuse_more_events(std::size_t most_events,
                                                           double time = std::numeric_limits<double>::quiet_NaN()) {
  throw ConvergenceError("more than " + std::to_string(most_events) + " events" +
                         (std::isnan(time) ? "" : " up to " + shortest(time) + " s") +
                         ": the spring is too stiff, or the slip level too low, for segments this long");
}

/// A flow that can have a damper.
template <class Flow>
concept FlowWithDamper = requires(const Flow& flow, double time) {
  flow.damped_work(time);
};

/// Sums up slips and keeps events.
/// @tparam in_steps  slips come in many steps, of which a segment may have so many that they must beat
/// @tparam loaded    the normal force may vary, and there may be stops: the event loop tells the work against friction
template <FrictionLaw Law, bool in_steps = !ConstantLevelLaw<Law>, bool loaded = false>
class Recorder {
 public:
  static constexpr std::uint32_t work_a_beat = 16384;  // segments, events or steps, each far below a millisecond

  /// @param from         x at the start [m]
  /// @param most_events  more are refused
  /// @param heartbeat    called now and then, see `work_a_beat`; may throw
  /// @param storage      memory for the events
  Recorder(const Law& law, double from, std::size_t most_events, const std::function<void()>& heartbeat,
           std::vector<Event> storage)
      : law_(law),
        slip_from_(from),
        peak_(std::abs(from)),
        events_(std::move(storage)),
        most_events_(most_events),
        heartbeat_(heartbeat) {
    events_.clear();
  }

  /// @param begin, end  times of the segment that is next [s]
  void begin_segment(double begin, double end) noexcept {
    segment_begins_ = begin;
    segment_ends_ = end;
  }

  /// For the loop over segments, now and then; long segments beat by themselves, with events and steps of Taylor flows.
  void heartbeat() const {
    if (heartbeat_) heartbeat_();
  }

  /// Work that only a flow knows: on a damper, and against friction that depends on more than the place.
  template <class Flow>
  requires(!PositionLaw<Law> || FlowWithDamper<Flow>) void follow(const Flow& flow, double taken) {
    if constexpr (FlowWithDamper<Flow>) damped_ += flow.damped_work(taken);
    if constexpr (!PositionLaw<Law> && !loaded) dissipated_ += flow.friction_work(taken);
    if constexpr (requires { flow.pendulum_work(taken); }) input_ += flow.pendulum_work(taken);
  }

  void dissipate(double work) requires loaded { dissipated_ += work; }
  void lose(double energy) requires loaded { impact_ += energy; }

  void slide(const Slip& slip) {
    if constexpr (in_steps) beat();
    slip_direction_ = slip.direction;
    slip_distance_ += slip.distance;
    time_sliding_ += slip.duration;
    input_ += slip.work;
    if constexpr (PositionLaw<Law> && !LawWithWork<Law> && !loaded)
      dissipated_ += friction_work(law_, slip.from, slip.distance, slip.direction);
  }

  void event(EventKind kind, double time, const State& state) {
    beat();
    if (events_.size() >= most_events_) refuse_more_events(most_events_, segment_begins_ + time);
    // The sum can be rounded past the end, where the next segment begins.
    const double when = std::min(segment_begins_ + time, segment_ends_);
    events_.push_back({when, state.displacement, state.velocity, kind});
    peak_ = std::max(peak_, std::abs(state.displacement));  // between events x runs one way
    sliding_distance_ += slip_distance_;
    if constexpr (LawWithWork<Law> && !loaded) dissipated_ += law_.work(slip_from_, slip_distance_, slip_direction_);
    slip_from_ = state.displacement;
    slip_distance_ = 0;
  }

  /// Many at once, from a rest on: as `slide` and `event` would tell of them one by one, but for the work of the
  /// ground.
  /// @param event  the k-th of `count`, in order
  template <class Generate>
  void events(std::size_t count, Generate&& event) requires ConstantLevelLaw<Law> {
    if (events_.size() + count > most_events_) refuse_more_events(most_events_, segment_begins_);
    events_.resize(events_.size() + count);
    Event* const added = events_.data() + (events_.size() - count);
    double x = slip_from_, time = 0, forward = 0, backward = 0, time_sliding = 0, peak = peak_;
    double slides = 0;  // 0 or 1: without a jump, which would be a gamble
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
  void beat() {
    if (++beats_ % work_a_beat == 0) heartbeat();
  }

  const Law& law_;
  double segment_begins_ = 0, segment_ends_ = 0;
  double slip_from_;  // x where the slip at hand began
  double slip_distance_ = 0;
  Direction slip_direction_ = Direction::forward;
  double peak_;
  double sliding_distance_ = 0, time_sliding_ = 0, input_ = 0, dissipated_ = 0, damped_ = 0, impact_ = 0;
  std::vector<Event> events_;
  std::size_t most_events_;
  std::uint32_t beats_ = 0;
  const std::function<void()>& heartbeat_;
};

/// In the place of a recorder, where nothing is asked but the motion.
class NoRecorder : public NoObserver {
 public:
  static constexpr std::uint32_t work_a_beat = 4096;  // segments or events

  explicit NoRecorder(std::size_t most_events, const std::function<void()>& heartbeat)
      : most_events_(most_events), heartbeat_(heartbeat) {}

  void begin_segment(double, double) const noexcept {}
  void heartbeat() const {
    if (heartbeat_) heartbeat_();
  }
  void event(EventKind, double, const State&) {
    if (++events_ % work_a_beat != 0) return;
    heartbeat();
    if (events_ > most_events_) refuse_more_events(most_events_);
  }

 private:
  std::size_t most_events_, events_ = 0;
  const std::function<void()>& heartbeat_;
};

}  // namespace stickslip::detail
