// States at any times, for systems that are stepped through a ground motion.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "stickslip/ground/ground_motion.hpp"
#include "stickslip/run/detail/reading.hpp"

namespace stickslip::detail {

/// The states at any times of a motion that is made of single steps, whose parts can be stepped, too.
/// @param state    at the start
/// @param samples  of the response
/// @param end      of the response [s], when it has the state `last`
/// @param step     `step(state, duration, i, from, to)`: through segment i of the motion, from a part of it to another;
///                 without ground motion if there is no such segment
template <class State, class Step>
std::vector<State> states_by_steps(const GroundMotion& motion, std::span<const double> times, State state,
                                   std::size_t samples, double end, const State& last, Step&& step) {
  const std::vector<std::size_t> order = order_of(times, motion.time(0), end, motion.time(samples - 1));
  std::vector<State> states(times.size(), last);
  std::size_t next = 0;
  const auto through = [&](std::size_t i, double begin, double until) {
    const double duration = until - begin;
    State here = state;
    double now = 0;
    for (; next < order.size() && times[order[next]] < until; ++next) {
      const double then = std::max(times[order[next]] - begin, now);
      if (then > now) step(here, then - now, i, now / duration, then / duration);
      states[order[next]] = here;
      now = then;
    }
    if (next < order.size() && duration > 0) step(state, duration, i, 0.0, 1.0);
  };
  const std::size_t count = motion.segments();
  for (std::size_t i = 0; i < count && next < order.size(); ++i) through(i, motion.time(i), motion.time(i + 1));
  through(count, motion.time(count), end);
  return states;
}

}  // namespace stickslip::detail
