// Integrate one slider under one ground motion.
#pragma once

#include <cmath>
#include <concepts>
#include <cstddef>
#include <stdexcept>
#include <utility>

#include "stickslip/base/function.hpp"
#include "stickslip/base/min_max.hpp"
#include "stickslip/error.hpp"
#include "stickslip/ground/motion.hpp"
#include "stickslip/slider.hpp"
#include "stickslip/sliding/advance.hpp"
#include "stickslip/sliding/detail/engine.hpp"
#include "stickslip/sliding/detail/engine_of.hpp"
#include "stickslip/sliding/detail/recorder.hpp"
#include "stickslip/sliding/detail/run.hpp"
#include "stickslip/sliding/response.hpp"

namespace stickslip {

struct IntegrateOptions {
  double displacement = 0;  ///< x at the start [m], finite
  double velocity = 0;      ///< x' at the start [m/s], finite
  bool settle = false;      ///< continue under zero ground acceleration after the last sample until the slider rests
  Contact contact = Contact::flight;  ///< what the slider does while the ground falls away from under it
  std::function<void()> progress{};   ///< called about once per second or more often; may throw to stop the work
  double sliding_distance = 0;     ///< sliding distance before the start [m], finite and at least 0; used by laws that
                                   ///< depend on it
  SurfaceHeat heat{};              ///< of the sliding surface at the start; used by laws that depend on its temperature
  bool may_end_in_flight = false;  ///< whether a response without `settle` may end before the slider has landed
};

namespace detail {

/// Continue without ground acceleration until the slider comes to rest; `go(duration)` integrates its motion. Where
/// friction grows with the speed, a slider may creep: its speed decays exponentially and never reaches zero, on a
/// spring or where friction vanishes at rest. It is at rest when x no longer changes, but by round-off, and its speed
/// is negligible beside the spring or, without one, has at least halved meanwhile.
/// @return whether it crept to rest, without an event
/// @throws ConvergenceError  the slider keeps moving, or loses too little energy to rest before the longest duration
template <class Go>
bool settle(const Engine& engine, State& state, Go&& go) {
  double longest = 0x1p40;  // [s], about 35,000 years
  if (engine.law().constant) {
    const auto holds = [&](Direction direction) { return engine.hold(state, 1, direction) > 0; };
    if (!holds(Direction::forward) && !holds(Direction::backward) && state.mode != Mode::stuck) longest = 0;
  }
  const double wn = engine.mounting().natural_frequency;
  double scale = wn > 0 ? std::abs(state.velocity) / wn : 0;  // of the displacement [m]
  // Above that at rest without friction: where the spring holds the weight, or at the stop downhill.
  const double weight = standard_gravity * std::sin(engine.mounting().slope());
  const double stiffness = engine.mounting().stiffness(), lowest = engine.mounting().stops.forward();
  const auto energy = [&] {
    const double x = state.displacement, stretched = x - (stiffness > 0 ? weight / stiffness : 0);
    return state.velocity * state.velocity / 2 + engine.elastic(state) + stiffness * stretched * stretched / 2 +
           (weight > 0 && !(stiffness > 0) ? weight * (lowest - x) : 0);
  };
  for (double duration = 1; duration <= longest; duration *= 2) {
    const double from = state.displacement, speed = std::abs(state.velocity), before = energy();
    go(duration);
    if (state.in_flight) continue;
    if (state.mode == Mode::stuck) return false;
    if (rings_on(before, energy(), duration, longest)) break;
    if (engine.law().position) continue;
    scale = std::max(scale, std::max(std::abs(from), std::abs(state.displacement)));
    const bool rests = std::abs(state.velocity) <= (wn > 0 ? 0x1p-40 * wn * scale : speed / 2);
    if (rests && std::abs(state.displacement - from) <= 0x1p-50 * scale) {
      state.velocity = 0;
      state.mode = Mode::stuck;
      return true;
    }
  }
  throw ConvergenceError(
      "without ground motion the slider does not come to rest: at x = " + shortest(state.displacement) +
      " m it still moves at " + shortest(state.velocity) + " m/s, with a slip level of " +
      shortest(engine.resist(state, 1, direction_of(state.mode))) + " m/s^2 there; use settle = false");
}

/// Append samples from the end of a motion up to the first at or after the final rest, but at most nine times as many
/// as the motion has.
/// @param move  `move(segment, state)` integrates the motion over a segment
/// @param from  the state at the end of the motion
/// @param rest  time of the final rest [s], at `residual` [m]
/// @return whether the samples reach the final rest
template <Motion M, class Move>
bool add_samples(const Engine& engine, const M& motion, Move&& move, State from, double rest, double residual,
                 Response& response) {
  const Segment step{motion.last_step(), 0, 0};
  for (std::size_t i = motion.segments(); motion.time(i) < rest; ++i) {
    if (i + 1 >= 10 * motion.samples()) return false;
    move(step, from);
    if (!(motion.time(i + 1) < rest)) {
      from.displacement = residual;
      from.velocity = 0;
      from.mode = Mode::stuck;
    }
    response.displacement.push_back(from.displacement);
    response.velocity.push_back(from.velocity);
    if (!response.gap.empty()) response.gap.push_back(from.gap);
    if (engine.law().heated) response.temperature.push_back(engine.temperature(from));
  }
  return true;
}

/// `integrate` of a slider of any law.
/// @param in_order  segment by segment, as the header-only core does
template <Motion M>
Response integrate(const Engine& engine, const M& motion, const IntegrateOptions& options, Response storage,
                   bool in_order) {
  const Mounting& mounting = engine.mounting();
  bool loaded = false;
  storage.gap.clear();
  if constexpr (std::same_as<M, GroundMotion>) {
    loaded = engine.loaded(motion);
    if (loaded) {
      check_start(mounting, State::at(options.displacement, options.velocity), "integrate");
      if (options.contact == Contact::flight && !options.settle && !options.may_end_in_flight)
        check_landing(motion, mounting.slope());
      if (may_fly(motion, mounting.slope()) && options.contact == Contact::flight)
        storage.gap.assign(motion.samples(), 0);
    }
  } else {
    require_plain_mounting(mounting, "integrate under a HarmonicMotion");
  }
  require(std::isfinite(options.displacement), "integrate: displacement must be finite", options.displacement, "m");
  require(std::isfinite(options.velocity), "integrate: velocity must be finite", options.velocity, "m/s");
  require(std::isfinite(options.sliding_distance) && options.sliding_distance >= 0,
          "integrate: sliding_distance must be finite and at least 0", options.sliding_distance, "m");
  State state = State::at(options.displacement, options.velocity);
  state.sliding_distance = options.sliding_distance;
  state.heat = options.heat;
  state = engine.started(state);
  if (state.mode != Mode::stuck)
    require(std::isfinite(engine.resist(state, 1, direction_of(state.mode))),
            "integrate: velocity must not point where the slip level is infinite", options.velocity, "m/s");

  Response response = std::move(storage);
  response.displacement.resize(motion.samples());
  response.velocity.resize(motion.samples());
  const auto kinetic = [&] { return state.velocity * state.velocity / 2; };
  const auto elastic = [&] {
    return mounting.stiffness() * state.displacement * state.displacement / 2 + engine.elastic(state);
  };

  response.temperature.clear();
  if (engine.law().heated) response.temperature.resize(motion.samples(), engine.temperature(state));
  response.displacement[0] = state.displacement;
  response.velocity[0] = state.velocity;
  const double initial = kinetic() + elastic();
  Recorder recorder(engine, loaded, state.displacement, max_events(pieces(motion)), options.progress,
                    std::move(response.events));
  recorder.begin_segment(motion.time(0), motion.time(0));
  if (state.mode != Mode::stuck) recorder.event(EventKind::breakaway, 0, state);
  double end = motion.time(motion.segments());
  const HistorySpans histories{response.displacement, response.velocity, response.gap, response.temperature};
  if constexpr (std::same_as<M, GroundMotion>) {
    if (loaded)
      run_loaded(engine, motion, options.contact, state, recorder, histories);
    else
      run(engine, motion, in_order, state, recorder, histories);
  } else {
    HarmonicSegments segments(motion, engine, recorder, histories);
    engine.move(segments, motion.omega(), motion.dt(), state, recorder);
  }
  response.truncated = false;
  response.contact = options.contact;
  response.components = name_of(Component::axis);  // a transverse component never acts
  if constexpr (std::same_as<M, GroundMotion>)
    if (motion.has_vertical()) response.components += std::string(" + ") + name_of(Component::vertical);
  if (options.settle) {
    const auto move = [&](const Segment& segment, State& moving, Sink& sink) {
      advance(engine, segment, loaded, options.contact, moving, sink);
    };
    const State at_end = state;
    double time = end;
    const bool crept = settle(engine, state, [&](double duration) {
      recorder.begin_segment(time, time + duration);
      move(Segment{duration, 0, 0}, state, recorder);
      time += duration;
    });
    if (crept) {
      recorder.begin_segment(time, time);
      recorder.event(EventKind::arrest, 0, state);
    }
    end = std::max(end, recorder.last_event());
    NoSink none;
    const auto step = [&](const Segment& segment, State& from) { move(segment, from, none); };
    response.truncated = !add_samples(engine, motion, step, at_end, end, state.displacement, response);
  }
  recorder.finish(end, state, response);

  response.residual = state.displacement;
  response.energy.initial = initial;
  response.energy.kinetic = kinetic();
  response.energy.elastic = elastic();
  response.state = state;
  if (!std::isfinite(response.energy.imbalance()) || !std::isfinite(response.peak))
    throw std::overflow_error("integrate: the motion leaves the range of doubles, in displacement (peak " +
                              shortest(response.peak) + " m), velocity or energy");
  return response;
}

/// `integrate` by the event loop, segment by segment, as the header-only core does.
template <FrictionLaw Law, Motion M>
Response integrate_in_order(const Slider<Law>& slider, const M& motion, const IntegrateOptions& options = {},
                            Response storage = {}) {
  return integrate(EngineOf<Law>(slider), motion, options, std::move(storage), true);
}

}  // namespace detail

/// Integrate the motion of a slider under a ground motion:
///     x'' + resist sgn(x') + c x' + wn^2 x = -n(t),     thesis (4.51) to (4.53), (2.44), (2.50), (4.2); (2.27), (2.28)
/// with all breakaways, reversals and arrests, up to two reversals within one straight segment of n(t).
///
/// @param slider   a law with an optional spring and an optional damper; a law alone is a slider without them
/// @param motion   the ground acceleration: a GroundMotion or a HarmonicMotion. A transverse component does not act
/// @param options  state at the start, and whether to continue until the slider rests
/// @param storage  a discarded response whose buffers are reused (allocation can cost as much as the integration)
/// @return the response at the samples, with its events, peak and energy. With `settle`, the samples continue up to
///         the first at or after the final rest (see Response::displacement), and the last event (`end`) and the
///         residual are those of the final rest
/// @throws std::invalid_argument  a start that is not finite, that is beyond a stop, or whose velocity points against
///                                an infinite slip level or backward on a one-way slider; a vertical motion that ends
///                                in free fall, so that the slider need not land (without `settle`, unless
///                                `may_end_in_flight`); under a HarmonicMotion a slope, stops or a pendulum
/// @throws std::overflow_error    a displacement, velocity or energy beyond the range of doubles
/// @throws ConvergenceError       with `settle`, the slider does not come to rest (no friction; a caster that has
///                                escaped); more events than 1,000,000 plus eight per segment, or per period of a
///                                harmonic motion (a spring that oscillates that often within a segment)
/// Constant friction: exact to round-off, 1e-13 of the scale of x; 20 to 42 ns per sample, 30 to 61 ns with a spring;
/// with a damper, exact to 1e-12, about 0.3 us per sample. The compiled library splits a record with a constant time
/// step and at least 8192 samples into pieces, and integrates a block without spring and damper over them in parallel
/// SIMD lanes (AVX-512, AVX2, SSE4 or NEON, whichever the processor has): 12 to 30 ns per sample, and up to 7 MB of
/// memory. The last bits may differ from those of the header-only core; whether a velocity that only touches zero
/// counts as a stop may therefore also differ. Friction that is linear in the distance slid (Degrading) has a closed
/// form under horizontal motion, exact to 1e-12 of the scale; 0.13 us per sample. Other laws use Taylor series, exact
/// to near round-off; 200 to 850 ns per sample. Under a harmonic motion, constant friction without spring and damper
/// has a closed form; all else uses power series: 1.5 us per cycle with Coulomb friction, 6 us with a spring, 50 us for
/// other laws; each sample adds 0.1 to 0.2 us. With a damper c, a power series takes steps of about 3 / c.
template <FrictionLaw Law, Motion M>
Response integrate(const Slider<Law>& slider, const M& motion, const IntegrateOptions& options = {},
                   Response storage = {}) {
  return detail::integrate(detail::EngineOf<Law>(slider), motion, options, std::move(storage), false);
}

template <FrictionLaw Law, Motion M>
Response integrate(const Law& law, const M& motion, const IntegrateOptions& options = {}, Response storage = {}) {
  return integrate(Slider<Law>(law), motion, options, std::move(storage));
}

}  // namespace stickslip

#ifdef STICKSLIP_LIBRARY  // the linked library contains these
namespace stickslip::detail {
extern template Response integrate(const Engine&, const GroundMotion&, const IntegrateOptions&, Response, bool);
extern template Response integrate(const Engine&, const HarmonicMotion&, const IntegrateOptions&, Response, bool);
}  // namespace stickslip::detail
#endif
