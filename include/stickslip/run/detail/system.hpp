// What the event loop asks a sliding system, and what a system asks the flows of its law.
#pragma once

#include <concepts>

#include "stickslip/flow/closed_form.hpp"

namespace stickslip::detail {

/// How a system begins to slip: from rest, or from a stop of no duration. After a stop of no duration it reverses, or
/// goes on as before because its velocity merely touched zero.
enum class Resumption { from_rest, onward, reversed };

/// A sliding system during one segment. It holds its state and knows its laws, loads and bounds; the event loop
/// (loop.hpp) only knows the order in which it asks:
///
///     left(), elapsed()        // time to the end, and since the beginning of the segment [s]
///     state()                  // for observers; resting_state() if it has just stopped
///     at_rest()                // whether nothing slides; other parts of the system may move
///     has_stopped()            // whether a slip has just ended, at this time
///     departure()              // when the next slip begins: `departs()` in this segment, after `delay`. If it does
///                              // not depart, the system is at the end of the segment
///     depart(departure)        // goes there, and says how it resumes
///     slide()                  // the slip from here on: `stop`, its first stop or `never`, and its flow. What decided a
///                              // departure is where the slip starts
///     passage(slide)           // where it passes a bound or a change of its law before that stop: `passes`, `leg`
///     show(slide, leg, observer)
///     pass(slide, passage, observer), proceed(slide, leg), stop(slide, leg)
///                              // go to the end of a leg; the first two return whether the segment goes on
///     most_steps               // that a hundredth of a segment can take
///     stall()                  // throws, because it takes more
template <class System>
concept SlidingSystem = requires(System& system, const System& now) {
  { now.left() } -> std::convertible_to<double>;
  { now.elapsed() } -> std::convertible_to<double>;
  { now.at_rest() } -> std::convertible_to<bool>;
  { now.has_stopped() } -> std::convertible_to<bool>;
  { system.departure().departs() } -> std::convertible_to<bool>;
  { system.depart(system.departure()) } -> std::same_as<Resumption>;
  { system.slide().stop } -> std::convertible_to<double>;
  { system.passage(system.slide()).passes } -> std::convertible_to<bool>;
  { System::most_steps } -> std::convertible_to<int>;
  now.state();
  now.resting_state();
  now.stall();
};

/// A part of a slip: the time it takes, the flow's progress at its end, and how much the load changes meanwhile.
struct Leg {
  double time = 0;  ///< [s]
  Progress end{};
  double gain = 0;  ///< [m/s^2]
};

}  // namespace stickslip::detail
