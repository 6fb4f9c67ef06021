// The event loop: one slider over one segment of ground motion.
#pragma once

#include <cmath>
#include <concepts>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "stickslip/detail/min_max.hpp"
#include "stickslip/error.hpp"
#include "stickslip/flow/damped.hpp"
#include "stickslip/flow/oscillator.hpp"
#include "stickslip/flow/polynomial.hpp"
#include "stickslip/flow/sinusoidal.hpp"
#include "stickslip/flow/taylor.hpp"
#include "stickslip/friction/law.hpp"
#include "stickslip/ground/segment.hpp"
#include "stickslip/slider.hpp"
#include "stickslip/sliding/response.hpp"
#include "stickslip/state.hpp"

namespace stickslip {

/// A slip or a part of one, in one direction and within one segment, as a watcher of the motion sees it.
struct Slip {
  Direction direction;
  double from;      ///< x where it began [m]
  double distance;  ///< way slid, at least 0 but for round-off [m]
  double duration;  ///< [s]
  double work;      ///< of the ground on it [m^2/s^2]

  double to() const noexcept { return from + sign(direction) * distance; }  ///< x where it ended [m]
};

/// Watches a motion while it is computed: each slip or part of one, and each event. Times count from the beginning of
/// the segment [s]. One that has `follow(flow, taken)` is also shown each flow and how long it lasts [s].
template <class Observer>
concept MotionObserver = requires(Observer& observer, const Slip& slip, double time, EventKind kind, State state) {
  observer.slide(slip);
  observer.event(kind, time, state);
};

/// Watches nothing.
struct NoObserver {
  void slide(const Slip&) const noexcept {}
  void event(EventKind, double, const State&) const noexcept {}
};

namespace detail {

/// Counts steps that take no time off what is left of a segment, and ends an event loop that makes no others.
class Standstill {
 public:
  template <class Flows>
  void count(const Flows&, double taken, double left, double duration) {
    if constexpr (!requires { Flows::stops_twice_at_most; })
      if (!(left - taken < left) && ++steps_ > most) refuse(duration);
  }

 private:
  static constexpr int most = 1'000'000;

  [[noreturn, gnu::noinline]] static void refuse(double duration) {
    throw ConvergenceError("advance: in a segment of " + shortest(duration) +
                           " s the motion changes faster than its time can be resolved: the spring is too stiff, or "
                           "the acceleration too large, for a segment this long");
  }

  int steps_ = 0;
};

/// The event loop, over a piece of any kind (segment.hpp); `flows` makes the flows of the law under its load.
template <FrictionLaw Law, class Flows, class Piece, MotionObserver Observer>
void advance(const Law& law, const Flows& flows, const Piece& segment, State& state, Observer& observer) {
  if (!(segment.duration > 0)) return;
  double left = segment.duration;
  Standstill standstill;
  double load = segment.first_load() - flows.pull(state.displacement);  // all but friction
  Mode stopped = Mode::stuck;                                           // the mode of a slip that stopped just now,
  bool instant = false;                                                 // and whether it took no time
  // Net, in the direction of sliding. From rest it is what the load is above what resists: nothing, to the last bit,
  // where that held it until the load grew to it.
  const auto acceleration = [&](Direction direction) {
    const double speed = std::abs(state.velocity);
    return sign(direction) * load - resist(law, state.displacement, direction, speed) - flows.drag(speed);
  };

  for (;;) {
    if (state.mode == Mode::stuck) {
      // It slips when the load outgrows what holds it: at once, or later in this segment. At the level itself it holds.
      const double forward = hold(law, state.displacement, Direction::forward);
      const double backward = hold(law, state.displacement, Direction::backward);
      double delay = 0;
      // A slip slows down as it stops: what its load is above the level then is round-off, unless the stop is a graze.
      if (stopped != Mode::stuck) {
        const double most = instant ? never : 0x1p-44 * (std::abs(load) + 2 * std::abs(flows.pull(state.displacement)));
        if (stopped == Mode::forward && load - forward <= most)
          load = std::min(load, forward);
        else if (stopped == Mode::backward && -load - backward <= most)
          load = std::max(load, -backward);
      }
      if (load > forward) {
        state.mode = Mode::forward;
      } else if (load < -backward) {
        state.mode = Mode::backward;
      } else if (left > 0) {
        const Departure next = segment.departure(load, flows.pull(state.displacement), forward, backward, left);
        if (next.mode != Mode::stuck) {
          state.mode = next.mode;
          delay = next.delay;
          load = next.mode == Mode::forward ? forward : -backward;
        }
      }

      // A reversal is a stick of no length. Where it goes on the way it came, it only grazed the zero of velocity.
      const bool sticks = state.mode == Mode::stuck || delay > 0;
      if (sticks && stopped != Mode::stuck)
        observer.event(EventKind::arrest, segment.duration - left, State{state.displacement, 0, Mode::stuck});
      if (state.mode == Mode::stuck) return;
      left -= delay;
      if (sticks || stopped == Mode::stuck)
        observer.event(EventKind::breakaway, segment.duration - left, state);
      else if (stopped != state.mode)
        observer.event(EventKind::reversal, segment.duration - left, state);
      stopped = Mode::stuck;
      if (left <= 0) return;
    }

    const Direction direction = direction_of(state.mode);
    const double s = sign(direction);
    const double ground_load = load + flows.pull(state.displacement);
    const auto start = segment.slip(s, std::abs(state.velocity), acceleration(direction), ground_load, left);
    const auto flow = flows.flow(direction, state.displacement, start, left);
    const double stop = flow.first_stop();
    if constexpr (requires { observer.follow(flow, stop); })
      observer.follow(flow, stop < never ? stop : flow.horizon());
    // Two accounts that differ in little: as one, the way that nearly every piece goes would be 5 to 10 % slower.
    if (stop == never) {
      const double taken = flow.horizon();
      const Progress end = flow.at_horizon();
      const bool whole = taken == left;
      const double gain = start.gain_within(taken, left);
      observer.slide(Slip{direction, state.displacement, end.distance, taken,
                          start.work(flow, s * ground_load, gain, taken, end)});
      state.displacement += s * end.distance;
      state.velocity = s * std::max(end.speed, 0.0);
      if (whole) return;
      standstill.count(flows, taken, left, segment.duration);
      left -= taken;
      load = ground_load + s * gain - flows.pull(state.displacement);
      // Where the loads balance to the last digit a slip too slow to move x would never end.
      if (std::abs(state.velocity) < std::numeric_limits<double>::min() && acceleration(direction) <= 0) {
        state.velocity = 0;
        stopped = std::exchange(state.mode, Mode::stuck);
        instant = false;
      }
    } else {
      const Progress end = flow.at(stop);
      const double gain = start.gain_within(stop, left);
      observer.slide(
          Slip{direction, state.displacement, end.distance, stop, start.work(flow, s * ground_load, gain, stop, end)});
      state.displacement += s * end.distance;
      state.velocity = 0;
      stopped = std::exchange(state.mode, Mode::stuck);
      instant = !(left - stop < left);
      standstill.count(flows, stop, left, segment.duration);
      left -= stop;
      load = ground_load + s * gain - flows.pull(state.displacement);
    }
  }
}

/// What `work` gives with the flows that fit the slider: closed forms where what resists is constant, else Taylor
/// series.
template <FrictionLaw Law, class Work>
auto with_flows(const Slider<Law>& slider, double usual_duration, Work&& work) {
  if constexpr (ConstantLevelLaw<Law>) {
    if (slider.damping() > 0) [[unlikely]]
      return work(Damped{slider.damping(), slider.natural_frequency(), usual_duration});
    if (slider.stiffness() > 0) return work(Harmonic{slider.natural_frequency(), usual_duration});
    return work(Polynomial{});
  } else {
    return work(Taylor<Law>{slider});
  }
}

/// The same under a load of one frequency.
template <FrictionLaw Law, class Work>
auto with_harmonic_flows(const Slider<Law>& slider, double omega, double usual_duration, Work&& work) {
  if constexpr (ConstantLevelLaw<Law>) {
    if (slider.stiffness() == 0 && slider.damping() == 0) return work(Sinusoidal{omega, usual_duration});
  }
  return work(Taylor<Law>{slider});
}

/// The state after a segment.
template <FrictionLaw Law, class Flows, class Piece, MotionObserver Observer>
State advanced(const Law& law, const Flows& flows, const Piece& segment, State state, Observer& observer) {
  advance(law, flows, segment, state, observer);
  return state;
}

/// The same with a damper, kept out of line so that what is more common stays small; all by value, which can then stay
/// in registers there.
template <FrictionLaw Law, class Piece, MotionObserver Observer>
[[gnu::noinline]] State advanced(Law law, Damped flows, Piece segment, State state, Observer& observer) {
  advance(law, flows, segment, state, observer);
  return state;
}

/// Whether all are finite, by their sum: numbers near the largest double count as infinite.
template <class... Numbers>
bool finite(Numbers... numbers) noexcept {
  return (std::abs(numbers) + ...) <= std::numeric_limits<double>::max();
}
inline bool finite(const Segment& s, const State& state) noexcept {
  return finite(s.duration, s.start, s.end, state.displacement, state.velocity);
}
inline bool finite(const HarmonicSegment& s, const State& state) noexcept {
  return finite(s.duration, s.amplitude, s.omega, s.phase, state.displacement, state.velocity);
}

inline std::string description(const Segment& s) {
  return "a duration of " + shortest(s.duration) + " s, start " + shortest(s.start) + " m/s^2, end " + shortest(s.end) +
         " m/s^2";
}
inline std::string description(const HarmonicSegment& s) {
  return "a duration of " + shortest(s.duration) + " s, amplitude " + shortest(s.amplitude) + " m/s^2, omega " +
         shortest(s.omega) + " rad/s, phase " + shortest(s.phase) + " rad";
}
inline std::string description(const State& state) {
  return "x = " + shortest(state.displacement) + " m, x' = " + shortest(state.velocity) + " m/s";
}

// By value: a state whose address is known here would be kept in memory by the event loop.
template <class Piece>
[[noreturn, gnu::noinline]] void refuse(Piece segment, State state) {
  throw std::invalid_argument("advance: segment and state must be finite, got " + description(segment) + ", " +
                              description(state));
}
[[noreturn, gnu::noinline]] inline void refuse_overflow(State state) {
  throw std::overflow_error("advance: the motion leaves the range of doubles, at " + description(state));
}

}  // namespace detail

/// Moves a slider over one segment of ground motion:
///     x'' + resist sgn(x') + c x' + wn^2 x = -n(t),  n from segment.start to segment.end,
/// thesis (4.51) to (4.53), (2.50), (4.2),
/// with every breakaway, reversal and arrest within it. For codes that have a time loop of their own: nothing is
/// allocated, nothing is remembered but the state.
///
/// @param slider    the law and the spring
/// @param segment   finite; where its duration is not positive nothing happens
/// @param state     at the beginning, finite; becomes the state at the end. `State::at(x, v)` makes one
/// @param observer  sees slips and events; optional
/// @throws std::invalid_argument a number of the segment or the state is not finite; says all of them, changes nothing
/// @throws std::overflow_error   the motion leaves the range of doubles; `state` stays as it was, as by all errors
/// @throws ConvergenceError      events follow each other faster than the time within the segment can be resolved (a
///         spring of far more than 1e15 cycles a segment); a law has no finite power series where it is needed (Caster
///         only under extreme accelerations or stiffness)
/// Constant friction is exact to round-off (with a damper to 1e-12 of the scale), other laws to near round-off. Takes
/// 12 to 30 ns without spring and damper, some 0.2 us with a damper.
template <FrictionLaw Law, MotionObserver Observer = const NoObserver>
void advance(const Slider<Law>& slider, const Segment& segment, State& state, Observer&& observer = {}) {
  if (!detail::finite(segment, state)) [[unlikely]]
    detail::refuse(segment, state);
  const State moved = detail::with_flows(slider, std::numeric_limits<double>::quiet_NaN(), [&](const auto& flows) {
    return detail::advanced(slider.law(), flows, segment, state, observer);
  });
  if (!detail::finite(moved.displacement, moved.velocity)) [[unlikely]]
    detail::refuse_overflow(moved);
  state = moved;
}

/// The same over a piece of a harmonic motion, -n(t) = B cos(omega t + phase), thesis (2.28). (A template, so that a
/// piece in bare braces is a Segment.)
template <FrictionLaw Law, std::same_as<HarmonicSegment> Piece, MotionObserver Observer = const NoObserver>
void advance(const Slider<Law>& slider, const Piece& segment, State& state, Observer&& observer = {}) {
  if (!detail::finite(segment, state)) [[unlikely]]
    detail::refuse(segment, state);
  const double unusual = std::numeric_limits<double>::quiet_NaN();
  const State moved = detail::with_harmonic_flows(slider, segment.omega, unusual, [&](const auto& flows) {
    return detail::advanced(slider.law(), flows, segment, state, observer);
  });
  if (!detail::finite(moved.displacement, moved.velocity)) [[unlikely]]
    detail::refuse_overflow(moved);
  state = moved;
}

}  // namespace stickslip
