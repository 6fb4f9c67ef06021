// The event loop: one slider over one segment of ground motion.
#pragma once

#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "stickslip/flow/harmonic.hpp"
#include "stickslip/flow/polynomial.hpp"
#include "stickslip/flow/taylor.hpp"
#include "stickslip/friction/law.hpp"
#include "stickslip/response.hpp"
#include "stickslip/segment.hpp"
#include "stickslip/slider.hpp"
#include "stickslip/state.hpp"

namespace stickslip {

/// Watches a motion while it is computed: each slip or part of one, and each event. Times count from the beginning of
/// the segment [s].
template <class Observer>
concept MotionObserver = requires(Observer& observer, Direction direction, double number, EventKind kind, State state) {
  /// (direction, x where it began [m], way slid [m], time taken [s], work of the ground on it [m^2/s^2])
  observer.slide(direction, number, number, number, number);
  observer.event(kind, number, state);
};

/// Watches nothing.
struct NoObserver {
  void slide(Direction, double, double, double, double) const noexcept {}
  void event(EventKind, double, const State&) const noexcept {}
};

namespace detail {

/// The end of a stick: after `delay`, sliding in `direction` with the net acceleration `acceleration`.
struct Release {
  double delay;
  Direction direction;
  double acceleration;
};

/// When a slider at rest under a load that runs straight from `load` to `last_load` within `left` slips, if it does.
/// At the level itself it holds; when the load outgrows the level, the net acceleration is exactly zero.
inline std::optional<Release> next_release(double load, double last_load, double rate, double left, double hold_forward,
                                           double hold_backward) noexcept {
  if (load > hold_forward) return Release{0, Direction::forward, load - hold_forward};
  if (load < -hold_backward) return Release{0, Direction::backward, -load - hold_backward};
  if (left > 0 && rate > 0 && last_load > hold_forward)
    return Release{left * ((hold_forward - load) / (last_load - load)), Direction::forward, 0};
  if (left > 0 && rate < 0 && last_load < -hold_backward)
    return Release{left * ((hold_backward + load) / (load - last_load)), Direction::backward, 0};
  return std::nullopt;
}

template <FrictionLaw Law, class Flows, MotionObserver Observer>
void advance(const Slider<Law>& slider, const Flows& flows, const Segment& segment, State& state, Observer& observer) {
  if (!(segment.duration > 0)) return;
  const Law& law = slider.law();
  const double rate = (segment.start - segment.end) / segment.duration;  // of the load -n
  const auto ground_load = [&](double t) { return t == segment.duration ? -segment.end : rate * t - segment.start; };
  double t = 0;
  double load = -segment.start - slider.stiffness() * state.displacement;  // all but friction
  double acceleration = 0;                                                 // net, in the direction of sliding
  if (state.mode != Mode::stuck) {
    const Direction direction = direction_of(state.mode);
    acceleration = sign(direction) * load - law.level(state.displacement, direction);
  }
  Mode stopped = Mode::stuck;  // the mode of a slip that stopped just now

  for (;;) {
    if (state.mode == Mode::stuck) {
      const double left = segment.duration - t;
      const double last_load = -segment.end - slider.stiffness() * state.displacement;
      const auto release = next_release(load, last_load, rate, left, law.level(state.displacement, Direction::forward),
                                        law.level(state.displacement, Direction::backward));
      const bool at_once = release && release->delay == 0;
      if (stopped != Mode::stuck && !at_once) observer.event(EventKind::arrest, t, state);
      if (!release) return;
      t += release->delay;
      state.mode = mode_of(release->direction);
      acceleration = release->acceleration;
      // A reversal is a stick of no length. If it goes on the way it came, it only grazed the zero of velocity.
      if (stopped == Mode::stuck || !at_once)
        observer.event(EventKind::breakaway, t, state);
      else if (stopped != state.mode)
        observer.event(EventKind::reversal, t, state);
      stopped = Mode::stuck;
    }

    const double left = segment.duration - t;
    if (left <= 0) return;
    const Direction direction = direction_of(state.mode);
    const double s = sign(direction);
    const auto flow =
        flows.flow(direction, state.displacement, Start{std::abs(state.velocity), acceleration, s * rate}, left);
    const double stop = flow.first_stop();
    const bool stops = stop <= flow.horizon();
    const double step = stops ? stop : flow.horizon();
    const Progress end = flow.at(step);
    t = step == left ? segment.duration : t + step;
    observer.slide(direction, state.displacement, end.distance, step,
                   s * ground_load(t) * end.distance - s * rate * end.area);
    state.displacement += s * end.distance;
    if (stops) {
      state.velocity = 0;
      stopped = std::exchange(state.mode, Mode::stuck);
      load = s * (law.level(state.displacement, direction) + end.acceleration);
    } else {
      state.velocity = s * end.speed;
      acceleration =
          s * (ground_load(t) - slider.stiffness() * state.displacement) - law.level(state.displacement, direction);
    }
  }
}

/// Calls `work` with the flows that fit the slider: closed forms where the level is constant, else Taylor series.
template <FrictionLaw Law, class Work>
void with_flows(const Slider<Law>& slider, double usual_duration, Work&& work) {
  if constexpr (ConstantLevelLaw<Law>) {
    if (slider.stiffness() == 0)
      work(Polynomial{});
    else
      work(Harmonic{slider.natural_frequency(), usual_duration});
  } else {
    work(Taylor<Law>{slider});
  }
}

}  // namespace detail

/// Moves a slider over one segment of ground motion:
///     x'' + level(x) sgn(x') + wn^2 x = -n(t),  n from segment.start to segment.end,     thesis (4.51) to (4.53),
///     (2.50)
/// with every breakaway, reversal and arrest within it. For codes that have a time loop of their own: nothing is
/// allocated, nothing is remembered but the state.
///
/// @param slider    the law and the spring
/// @param segment   finite, with a duration of at least 0; not checked
/// @param state     at the beginning; becomes the state at the end. `State::at(x, v)` makes one
/// @param observer  sees slips and events; optional
/// @throws ConvergenceError if a law has no finite power series where it is needed; never for Coulomb and Caster
/// Constant friction is exact to round-off, other laws to near round-off. Takes 10 to 20 ns without a spring.
template <FrictionLaw Law, MotionObserver Observer = const NoObserver>
void advance(const Slider<Law>& slider, const Segment& segment, State& state, Observer&& observer = {}) {
  detail::with_flows(slider, std::numeric_limits<double>::quiet_NaN(),
                     [&](const auto& flows) { detail::advance(slider, flows, segment, state, observer); });
}

}  // namespace stickslip
