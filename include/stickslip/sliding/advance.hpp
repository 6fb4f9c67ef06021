// Integrate one slider over one segment of ground motion, for codes with their own time loop.
#pragma once

#include <cmath>
#include <concepts>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "stickslip/base/equal.hpp"
#include "stickslip/base/error.hpp"
#include "stickslip/base/min_max.hpp"
#include "stickslip/flow/detail/block.hpp"
#include "stickslip/flow/polynomial.hpp"
#include "stickslip/friction/coulomb.hpp"
#include "stickslip/friction/law.hpp"
#include "stickslip/ground/segment.hpp"
#include "stickslip/slider/slider.hpp"
#include "stickslip/sliding/detail/axis.hpp"
#include "stickslip/sliding/detail/engine.hpp"
#include "stickslip/sliding/detail/engine_of.hpp"
#include "stickslip/sliding/detail/sink.hpp"
#include "stickslip/sliding/observer.hpp"
#include "stickslip/state/state.hpp"

namespace stickslip {
namespace detail {

/// Whether all numbers are finite, judged by their sum: numbers near the largest double count as infinite.
template <class... Numbers>
bool finite(Numbers... numbers) noexcept {
  return (std::abs(numbers) + ...) <= std::numeric_limits<double>::max();
}
inline bool finite(const Segment& s, const State& state) noexcept {
  return finite(s.duration, s.start, s.end, state.displacement, state.velocity);
}
inline bool finite(const LoadSegment& s, const State& state) noexcept {
  return finite(s.duration, s.load_start, s.load_end, s.normal_start, s.normal_end, state.displacement, state.velocity,
                state.gap, state.gap_velocity);
}
inline bool finite(const HarmonicSegment& s, const State& state) noexcept {
  return finite(s.duration, s.amplitude, s.omega, s.phase, state.displacement, state.velocity);
}

inline std::string description(const Segment& s) {
  return "a duration of " + shortest(s.duration) + " s, start " + shortest(s.start) + " m/s^2, end " + shortest(s.end) +
         " m/s^2";
}
inline std::string description(const LoadSegment& s) {
  return "a duration of " + shortest(s.duration) + " s, load " + shortest(s.load_start) + " to " +
         shortest(s.load_end) + " m/s^2, normal force " + shortest(s.normal_start) + " to " + shortest(s.normal_end) +
         " m/s^2";
}
inline std::string description(const HarmonicSegment& s) {
  return "a duration of " + shortest(s.duration) + " s, amplitude " + shortest(s.amplitude) + " m/s^2, omega " +
         shortest(s.omega) + " rad/s, phase " + shortest(s.phase) + " rad";
}
inline std::string description(const State& state) {
  return "x = " + shortest(state.displacement) + " m, x' = " + shortest(state.velocity) + " m/s";
}

// Takes its arguments by value: with a reference to the state, the event loop would keep the state in memory.
template <class Piece>
[[noreturn, gnu::noinline]] void refuse(Piece segment, State state) {
  throw std::invalid_argument("advance: segment and state must be finite, got " + description(segment) + ", " +
                              description(state));
}
/// @param state  at the start
[[noreturn, gnu::noinline]] inline void refuse_overflow(const Engine& engine, State state) {
  if (state.mode != Mode::stuck && !std::isfinite(engine.resist(state, 1, direction_of(state.mode))))
    refuse("advance: velocity must not point where the slip level is infinite", state.velocity, "m/s");
  throw std::overflow_error("advance: the motion leaves the range of doubles, from " + description(state));
}

/// Throw if the slider starts beyond a stop, or moves backward although it is one-way.
inline void check_start(const Mounting& mounting, const State& state, const char* function) {
  const double first = -mounting.stops.backward(), last = mounting.stops.forward();
  if (state.displacement < first || state.displacement > last)
    refuse(std::string(function) + ": displacement must be between the stops, from " + shortest(first) + " to " +
               shortest(last) + " m",
           state.displacement, "m");
  if (mounting.one_way && state.velocity < 0)
    refuse(std::string(function) + ": velocity must not point backward on a one-way slider", state.velocity, "m/s");
}

/// `advance` of a slider of any law, where `move(segments, state)` moves it. An engine that throws leaves the state as
/// it was.
template <class Piece, class Move>
void advance_by(const Engine& engine, const Piece& segment, State& state, Move&& move) {
  OneSegment one(segment);
  if (!engine.law().memory) {
    const BareState before(state);
    move(one, state);
    if (finite(state.displacement, state.velocity)) [[likely]]
      return;
    before.store(state);
    refuse_overflow(engine, state);
  }
  require(std::isfinite(state.sliding_distance) && state.sliding_distance >= 0,
          "advance: sliding_distance must be finite and at least 0", state.sliding_distance, "m");
  State moved = engine.started(state);
  move(one, moved);
  if (!finite(moved.displacement, moved.velocity)) [[unlikely]]
    refuse_overflow(engine, state);
  state = moved;
}
inline constexpr double unusual = std::numeric_limits<double>::quiet_NaN();  // duration of a single segment

inline void advance(const Engine& engine, const Segment& segment, State& state, Sink& sink) {
  if (!finite(segment, state)) [[unlikely]]
    refuse(segment, state);
  advance_by(engine, segment, state, [&](auto& one, State& moved) { engine.move(one, unusual, moved, sink); });
}
inline void advance(const Engine& engine, const LoadSegment& segment, Contact contact, State& state, Sink& sink) {
  if (!finite(segment, state)) [[unlikely]]
    refuse(segment, state);
  const double largest = std::max(std::max(std::abs(segment.load_start), std::abs(segment.load_end)),
                                  std::max(std::abs(segment.normal_start), std::abs(segment.normal_end)));
  require(largest <= 1e100, "advance: load and normal force must be at most 1e100 m/s^2 in magnitude", largest,
          "m/s^2");
  check_start(engine.mounting(), state, "advance");
  advance_by(engine, segment, state, [&](auto& one, State& moved) { engine.move(one, unusual, contact, moved, sink); });
}
inline void advance(const Engine& engine, const HarmonicSegment& segment, State& state, Sink& sink) {
  if (!finite(segment, state)) [[unlikely]]
    refuse(segment, state);
  advance_by(engine, segment, state,
             [&](auto& one, State& moved) { engine.move(one, segment.omega, unusual, moved, sink); });
}
/// The same, as the mounting needs it.
inline void advance(const Engine& engine, const Segment& segment, bool loaded, Contact contact, State& state,
                    Sink& sink) {
  if (loaded)
    advance(engine, load_segment(segment, engine.mounting().slope()), contact, state, sink);
  else
    advance(engine, segment, state, sink);
}

template <FlowMaker Flows, MotionObserver Observer>
[[gnu::always_inline]] inline void move_block(const Flows& flows, const Segment& segment, BareState& state,
                                              Observer& observer) {
  advance(flows, segment, state, observer);
}
/// The same with a damper. It is out of line to keep the common case small, and takes everything by value, so that the
/// values can stay in registers.
template <FrictionLaw Law, MotionObserver Observer>
[[gnu::noinline]] BareState moved(BlockFlows<Law, Damped> flows, Segment segment, BareState state, Observer& observer) {
  advance(flows, segment, state, observer);
  return state;
}
template <FrictionLaw Law, MotionObserver Observer>
void move_block(const BlockFlows<Law, Damped>& flows, const Segment& segment, BareState& state, Observer& observer) {
  state = moved(flows, segment, state, observer);
}

/// Coulomb friction on level ground, where a few nanoseconds matter: the observer is inlined into the event loop.
template <MotionObserver Observer>
void advance_block(const Slider<Coulomb>& slider, const Segment& segment, State& state, Observer& observer) {
  if (!finite(segment, state)) [[unlikely]]
    refuse(segment, state);
  BareState moved(state);
  with_block_flows(slider, unusual, [&](const auto& flows) { move_block(flows, segment, moved, observer); });
  if (!finite(moved.displacement, moved.velocity)) [[unlikely]]
    refuse_overflow(EngineOf<Coulomb>(slider), state);
  moved.store(state);
}

}  // namespace detail

/// Integrate the motion of a slider over one segment of load and normal force,
///     x'' + resist N+/g sgn(x') + c x' + wn^2 x = p(t),
/// with all events, including impacts on stops and loss of contact.
///
/// @param slider    any; its slope is already contained in the load and the normal force
/// @param segment   finite, with forces of at most 1e100 m/s^2 in magnitude, as in a GroundMotion; the state is
///                  unchanged if its duration is not positive
/// @param state     as below; it also holds the gap while the slider is in flight
/// @param observer  receives slips and events; optional
/// @param contact   what happens where N < 0
/// @throws as below; also std::invalid_argument for a state beyond a stop
/// Exact to round-off with constant friction and without a pendulum, else to near round-off.
template <FrictionLaw Law, std::same_as<LoadSegment> Piece, MotionObserver Observer = const NoObserver>
void advance(const Slider<Law>& slider, const Piece& segment, State& state, Observer&& observer = {},
             Contact contact = Contact::flight) {
  detail::ObserverSink sink(observer);
  detail::advance(detail::EngineOf<Law>(slider), segment, contact, state, sink);
  sink.show_energy();
}

/// Integrate the motion of a slider over one segment of ground motion:
///     x'' + resist sgn(x') + c x' + wn^2 x = -n(t),  n from segment.start to segment.end,
/// thesis (4.51) to (4.53), (2.50), (4.2),
/// with every breakaway, reversal and arrest within it. For codes with their own time loop: the function allocates
/// nothing and keeps no state except `state`.
///
/// @param slider    the law, spring and damper
/// @param segment   finite; the state is unchanged if its duration is not positive
/// @param state     state at the start, finite; replaced by the state at the end. `State::at(x, v)` makes one
/// @param observer  receives slips and events; optional
/// @throws std::invalid_argument a number of the segment or the state is not finite; the message lists all of them. A
///         velocity that points where the slip level is infinite
/// @throws std::overflow_error   the motion leaves the range of doubles
/// @throws ConvergenceError      more than a million steps in closed form, or three million of a series, within a
///         hundredth of the segment: events follow each other faster than the time can be resolved, or the spring, the
///         damper or the slip level is too large for a segment this long; a law has no finite power series where one is
///         needed (for Caster only under extreme accelerations or stiffness)
/// On any error `state` is unchanged. Constant friction is exact to round-off (with a damper, or linear in the distance
/// slid, to 1e-12 of the scale), other laws to near round-off. Cost: 12 to 30 ns without spring and damper, about
/// 0.2 us with a damper.
template <FrictionLaw Law, MotionObserver Observer = const NoObserver>
void advance(const Slider<Law>& slider, const Segment& segment, State& state, Observer&& observer = {},
             Contact contact = Contact::flight) {
  if (!slider.plain() || state.in_flight) [[unlikely]]
    return advance(slider, detail::load_segment(segment, slider.slope()), state, observer, contact);
  if constexpr (std::same_as<Law, Coulomb>) return detail::advance_block(slider, segment, state, observer);
  detail::ObserverSink sink(observer);
  detail::advance(detail::EngineOf<Law>(slider), segment, state, sink);
}

/// The same over a segment of a harmonic motion, -n(t) = B cos(omega t + phase), thesis (2.28). (A template, so that a
/// braced initializer list is a Segment.)
template <FrictionLaw Law, std::same_as<HarmonicSegment> Piece, MotionObserver Observer = const NoObserver>
void advance(const Slider<Law>& slider, const Piece& segment, State& state, Observer&& observer = {}) {
  detail::require_plain_mounting(slider.mounting(), "advance over a HarmonicSegment");
  detail::ObserverSink sink(observer);
  detail::advance(detail::EngineOf<Law>(slider), segment, state, sink);
}

}  // namespace stickslip
