// A whole motion under one ground motion, of any sliding system.
#pragma once

#include <cmath>
#include <concepts>
#include <cstddef>
#include <limits>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "stickslip/base/error.hpp"
#include "stickslip/base/min_max.hpp"
#include "stickslip/base/vector2.hpp"
#include "stickslip/run/detail/event_log.hpp"
#include "stickslip/run/response.hpp"

namespace stickslip::detail {

/// Where the motion at the samples is written.
template <class Place>
struct HistorySpansOf {
  std::span<Place> displacement, velocity;
  std::span<double> gap{};          // empty if the slider cannot leave the ground
  std::span<double> temperature{};  // empty if friction does not depend on it
};

/// A system under one ground motion, from its start to its end. A new system answers the questions of the event loop
/// (SlidingSystem) and these:
///
///     State, Response
///     Recorder                     // `begin_segment(begin, end)`; `event(kind, time, state)`; `last_event()`;
///                                  // `finish(response)`, which hands over events, peak and sums
///     motion(), options()
///     start()                      // the state at the start; throws if no motion starts so
///     recorder(state, response)    // response: its histories get the length of the motion, and the first sample
///     walk(state, recorder, response)    // through the ground motion, keeping the motion at the samples
///     settle(state, recorder, response)  // to its rest, with the samples up to then. Returns when that is [s]
///     kinetic(state), elastic(state)     // energies per unit mass [m^2/s^2]
///     finish(state, response)            // hands over the state at the end, and where it is
///
/// `integrate_run` makes a response of it. `settle_freely` is the usual `settle`: it asks for `calm(duration, state,
/// sink)`, a motion without ground acceleration, `NoSink`, `temperature(state)`, and `slider()` of `settle`.
template <class Run>
concept RunOfSystem = requires(const Run& run, typename Run::State& state, typename Run::Response& response,
                               typename Run::Recorder& recorder) {
  { run.start() } -> std::same_as<typename Run::State>;
  { run.recorder(state, response) } -> std::same_as<typename Run::Recorder>;
  run.walk(state, recorder, response);
  { run.settle(state, recorder, response) } -> std::convertible_to<double>;
  { run.kinetic(state) } -> std::convertible_to<double>;
  { run.elastic(state) } -> std::convertible_to<double>;
  recorder.event(EventKind::end, 0.0, state);
  recorder.finish(response);
  run.finish(std::move(state), response);
};

/// Whether a system rests in a state: the first mode of every system.
template <class State>
bool is_stuck(const State& state) noexcept {
  return state.mode == decltype(state.mode){};
}
template <class State>
void stop_at(State& state, decltype(state.displacement) displacement) noexcept {
  state.displacement = displacement;
  state.velocity = {};
  state.mode = {};
}

[[noreturn, gnu::noinline]] inline void refuse_overflow(double peak) {
  throw std::overflow_error("integrate: the motion leaves the range of doubles, in displacement (peak " +
                            shortest(peak) + " m), velocity or energy");
}

/// The whole motion.
/// @param storage  a discarded response whose buffers are reused
template <RunOfSystem Run>
typename Run::Response integrate_run(const Run& run, typename Run::Response storage) {
  auto state = run.start();
  auto response = std::move(storage);
  response.truncated = false;
  const double initial = run.kinetic(state) + run.elastic(state), begin = run.motion().time(0);
  auto recorder = run.recorder(state, response);
  recorder.begin_segment(begin, begin);
  if (!is_stuck(state)) recorder.event(EventKind::breakaway, 0, state);
  run.walk(state, recorder, response);
  double end = run.motion().time(run.motion().segments());
  if (run.options().settle) end = run.settle(state, recorder, response);
  recorder.begin_segment(end, end);
  recorder.event(EventKind::end, 0, state);
  recorder.finish(response);
  response.energy.initial = initial;
  response.energy.kinetic = run.kinetic(state);
  response.energy.elastic = run.elastic(state);
  if (!std::isfinite(response.energy.imbalance()) || !std::isfinite(response.peak)) refuse_overflow(response.peak);
  run.finish(std::move(state), response);
  return response;
}

/// What can keep a slider from rest without ground motion.
struct Unrest {
  double natural_frequency = 0;  ///< of its spring [rad/s]
  bool endless = false;          ///< nothing slows it down
  bool creeps = false;           ///< its speed may decay exponentially and never reach zero
  double downhill = 0;           ///< g sin(slope), along the axis [m/s^2]
  double lowest = 0;             ///< the stop downhill [m], on a slope without a spring
};

/// Distance of a place from the origin, and size of a velocity.
inline double norm(double x) noexcept { return std::abs(x); }
inline double along_axis(double x) noexcept { return x; }
inline double along_axis(Vector2 r) noexcept { return r.axis; }

/// A place in messages.
inline std::string name_of(double x) { return "x = " + shortest(x); }
inline std::string name_of(Vector2 r) { return "|r| = " + shortest(norm(r)); }

/// Continue without ground acceleration until a slider comes to rest; `go(duration)` integrates its motion. Where
/// friction grows with the speed, a slider may creep: on a spring, or where friction vanishes at rest. It is at rest
/// when its place no longer changes, but by round-off, and its speed is negligible beside the spring or, without one,
/// has at least halved meanwhile.
/// @param slider  answers `unrest(state)`; `elastic(state)`, the energy of springs in its law; and, for the message,
///                `level(state)`, the slip level [m/s^2]
/// @return whether it crept to rest, without an event
/// @throws ConvergenceError  the slider keeps moving, or loses too little energy to rest before the longest duration
template <class Slider, class State, class Go>
bool settle(const Slider& slider, State& state, Go&& go) {
  const Unrest unrest = slider.unrest(state);
  const double longest = unrest.endless ? 0 : 0x1p40;  // [s], about 35,000 years
  const double wn = unrest.natural_frequency;
  // After many cycles what is left of the energy is that of the motion, and not of where it will rest [s].
  const double many_cycles = wn > 0 ? std::max(8192.0, 400 / wn) : 8192;
  double scale = wn > 0 ? norm(state.velocity) / wn : 0;  // of the displacement [m]
  // Above that at rest without friction: where the spring holds the weight, or at the stop downhill.
  const auto energy = [&] {
    const double speed = norm(state.velocity), far = norm(state.displacement), x = along_axis(state.displacement);
    double sum = speed * speed / 2 + slider.elastic(state);
    if (wn > 0) {
      const double stretched = unrest.downhill / wn;
      sum += (wn * far * (wn * far) - 2 * unrest.downhill * x + stretched * stretched) / 2;
    } else if (unrest.downhill > 0) {
      sum += unrest.downhill * (unrest.lowest - x);
    }
    return sum;
  };
  for (double duration = 1; duration <= longest; duration *= 2) {
    const auto from = state.displacement;
    const double speed = norm(state.velocity), before = energy();
    go(duration);
    if (state.in_flight) continue;
    if (is_stuck(state)) return false;
    if (unrest.creeps) {
      scale = std::max(scale, std::max(norm(from), norm(state.displacement)));
      const bool rests = norm(state.velocity) <= (wn > 0 ? 0x1p-40 * wn * scale : speed / 2);
      if (rests && norm(state.displacement - from) <= 0x1p-50 * scale) {
        stop_at(state, state.displacement);
        return true;
      }
    }
    if (duration >= many_cycles && before - energy() < before * (duration / longest)) break;
  }
  throw ConvergenceError("without ground motion the slider does not come to rest: at " + name_of(state.displacement) +
                         " m it still moves at " + shortest(norm(state.velocity)) + " m/s, with a slip level of " +
                         shortest(slider.level(state)) + " m/s^2 there; use settle = false");
}

/// The usual `settle` of a run. The samples go on up to the first at or after the final rest, but to at most ten times
/// as many as the motion has.
template <class Run>
double settle_freely(const Run& run, typename Run::State& state, typename Run::Recorder& recorder,
                     typename Run::Response& response) {
  const auto& motion = run.motion();
  typename Run::State sampled = state;
  double end = motion.time(motion.segments()), time = end;
  const bool crept = settle(run.slider(), state, [&](double duration) {
    recorder.begin_segment(time, time + duration);
    run.calm(duration, state, recorder);
    time += duration;
  });
  recorder.begin_segment(time, time);
  if (crept) recorder.event(EventKind::arrest, 0, state);
  end = std::max(end, recorder.last_event());

  typename Run::NoSink none;
  for (std::size_t i = motion.segments(); motion.time(i) < end; ++i) {
    if (i + 1 >= 10 * motion.samples()) {
      response.truncated = true;
      break;
    }
    run.calm(motion.last_step(), sampled, none);
    if (!(motion.time(i + 1) < end)) stop_at(sampled, state.displacement);
    response.displacement.push_back(sampled.displacement);
    response.velocity.push_back(sampled.velocity);
    if (!response.gap.empty()) response.gap.push_back(sampled.gap);
    if (!response.temperature.empty()) response.temperature.push_back(run.temperature(sampled));
  }
  return end;
}

inline bool is_finite(double value) noexcept { return std::abs(value) <= std::numeric_limits<double>::max(); }
inline bool is_finite(Vector2 value) noexcept { return is_finite(value.axis) && is_finite(value.transverse); }

/// The motion at the samples only, from rest.
/// @param walk    `walk(spans)` moves the system through the ground motion
/// @param result  discarded histories whose buffers are reused
template <class Place, class Walk>
HistoriesOf<Place> histories_by(std::size_t samples, Walk&& walk, HistoriesOf<Place> result = {}) {
  for (auto* values : {&result.displacement, &result.velocity}) {
    values->resize(samples);
    values->front() = Place{};
  }
  walk(HistorySpansOf<Place>{result.displacement, result.velocity});
  bool finite = true;
  for (const auto* values : {&result.displacement, &result.velocity})
    for (const Place& value : *values) finite &= is_finite(value);
  if (!finite) throw std::overflow_error("histories: the motion leaves the range of doubles");
  return result;
}

}  // namespace stickslip::detail
