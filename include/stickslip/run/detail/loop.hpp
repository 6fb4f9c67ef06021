// The event loop: the order in which a sliding system is asked.
#pragma once

#include <cmath>
#include <utility>

#include "stickslip/base/equal.hpp"
#include "stickslip/flow/closed_form.hpp"
#include "stickslip/run/detail/system.hpp"
#include "stickslip/run/response.hpp"

namespace stickslip::detail {

/// Notices an event loop that takes too many steps, or meets numbers that overflow, within a hundredth of its segment.
/// @tparam most_steps  in a hundredth of the segment
template <int most_steps>
class Standstill {
 public:
  explicit Standstill(double duration) : duration_(duration), mark_(duration) {}

  /// Count a step.
  /// @param left  time to the end of the segment [s]
  bool stalls(double left) {
    if (++steps_ < most_steps) [[likely]]
      return false;
    steps_ = 0;
    return !(std::exchange(mark_, left) - left >= duration_ / 100);
  }

 private:
  double duration_;
  double mark_;  // time left at the last check [s]
  int steps_ = 0;
};

/// The time left in a segment after a part of a slip [s]. A time below its resolution passes as the smallest one: slips
/// could otherwise follow each other without end.
inline double pass_time(double left, double time) noexcept {
  const double after = left - time;
  return after < left || !(time > 0) ? after : std::nextafter(left, 0.0);
}

/// Move a system through a segment, from event to event.
template <SlidingSystem System, class Observer>
[[gnu::always_inline]] inline void advance(System& system, Observer& observer) {
  Standstill<System::most_steps> standstill(system.left());
  for (;;) {
    if (system.at_rest()) {
      const auto departure = system.departure();
      const bool sticks = !departure.departs() || departure.delay > 0;
      if (sticks && system.has_stopped()) observer.event(EventKind::arrest, system.elapsed(), system.resting_state());
      if (!departure.departs()) return;
      const Resumption resumption = system.depart(departure);
      if (sticks || resumption == Resumption::from_rest)
        observer.event(EventKind::breakaway, system.elapsed(), system.state());
      else if (resumption == Resumption::reversed)
        observer.event(EventKind::reversal, system.elapsed(), system.state());
      if (!(system.left() > 0)) return;
    }

    const auto slide = system.slide();
    if (const auto passage = system.passage(slide); passage.passes) {
      system.show(slide, passage.leg, observer);
      if (!system.pass(slide, passage, observer)) return;
    } else if (equal(slide.stop, never)) {  // kept apart from a stop: together they take 5 to 10 % longer
      const auto leg = slide.whole();
      system.show(slide, leg, observer);
      if (!system.proceed(slide, leg)) return;
    } else {
      const auto leg = slide.until(slide.stop);
      system.show(slide, leg, observer);
      system.stop(slide, leg);
    }
    if (standstill.stalls(system.left())) [[unlikely]]
      system.stall();
  }
}

}  // namespace stickslip::detail
