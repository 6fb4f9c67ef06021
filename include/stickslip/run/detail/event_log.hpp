// The events of a motion, recorded as they come.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "stickslip/base/error.hpp"
#include "stickslip/base/function.hpp"
#include "stickslip/base/min_max.hpp"
#include "stickslip/run/response.hpp"

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

/// Calls a function after each `work_per_report` pieces of work, each far below a millisecond.
template <std::uint32_t per_report>
class Pace {
 public:
  static constexpr std::uint32_t work_per_report = per_report;

  /// @param progress  held by reference; may be empty, and may throw
  explicit Pace(const std::function<void()>& progress) noexcept : progress_(progress) {}

  void report_progress() const {
    if (progress_) progress_();
  }
  void count_work() {
    if (++work_ % per_report == 0) report_progress();
  }

 private:
  std::uint32_t work_ = 0;
  const std::function<void()>& progress_;
};

/// Counts the events of a motion whose events are not kept.
class EventCount {
 public:
  explicit EventCount(std::size_t limit) noexcept : limit_(limit) {}
  void operator++() {
    if (++events_ > limit_) refuse_more_events(limit_);
  }

 private:
  std::size_t limit_, events_ = 0;
};

/// The events of a motion, with times from the beginning of the ground motion.
template <class Place>
class EventLog {
 public:
  /// @param limit    on the number of events; an event beyond it throws
  /// @param storage  memory for the events
  EventLog(std::size_t limit, std::vector<EventAt<Place>> storage) : events_(std::move(storage)), limit_(limit) {
    events_.clear();
  }

  /// @param begin, end  times of the next segment [s]
  void begin_segment(double begin, double end) noexcept {
    begins_ = begin;
    ends_ = end;
  }
  double segment_begins() const noexcept { return begins_; }
  double segment_ends() const noexcept { return ends_; }
  /// The time of an instant of the segment [s]. Rounding may move the sum past its end.
  double when(double time) const noexcept { return std::min(begins_ + time, ends_); }

  void add(EventKind kind, double time, const Place& displacement, const Place& velocity) {
    if (events_.size() >= limit_) refuse_more_events(limit_, begins_ + time);
    events_.push_back({when(time), displacement, velocity, kind});
  }
  /// Room for many events at once, to be written.
  EventAt<Place>* grow(std::size_t count) {
    if (events_.size() + count > limit_) refuse_more_events(limit_, begins_);
    events_.resize(events_.size() + count);
    return events_.data() + (events_.size() - count);
  }

  /// Time of the last event [s]; minus infinity before the first.
  double last_event() const noexcept {
    return events_.empty() ? -std::numeric_limits<double>::infinity() : events_.back().time;
  }
  std::vector<EventAt<Place>> take() noexcept { return std::move(events_); }

 private:
  std::vector<EventAt<Place>> events_;
  std::size_t limit_;
  double begins_ = 0, ends_ = 0;  // of the segment [s]
};

}  // namespace stickslip::detail
