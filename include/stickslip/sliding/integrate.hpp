// Integrate one slider under one ground motion.
#pragma once

#include <cmath>
#include <concepts>
#include <cstddef>
#include <string>
#include <utility>

#include "stickslip/base/error.hpp"
#include "stickslip/ground/motion.hpp"
#include "stickslip/run/detail/run.hpp"
#include "stickslip/run/options.hpp"
#include "stickslip/slider/slider.hpp"
#include "stickslip/sliding/advance.hpp"
#include "stickslip/sliding/detail/engine.hpp"
#include "stickslip/sliding/detail/engine_of.hpp"
#include "stickslip/sliding/detail/recorder.hpp"
#include "stickslip/sliding/detail/run.hpp"
#include "stickslip/sliding/response.hpp"

namespace stickslip {

using IntegrateOptions = RunOptions<double>;

namespace detail {

/// A slider of any law on one axis under a ground motion, as a run.
template <Motion M>
class AxisRun {
 public:
  using State = stickslip::State;
  using Response = stickslip::Response;
  using Recorder = detail::Recorder;
  using NoSink = detail::NoSink;

  /// All are held by reference.
  /// @param in_order  segment by segment, as the header-only core does
  AxisRun(const Engine& engine, const M& motion, const IntegrateOptions& options, bool in_order)
      : engine_(engine), motion_(motion), options_(options), in_order_(in_order) {
    if constexpr (std::same_as<M, GroundMotion>)
      loaded_ = engine.loaded(motion);
    else
      require_plain_mounting(engine.mounting(), "integrate under a HarmonicMotion");
  }

  const M& motion() const noexcept { return motion_; }
  const IntegrateOptions& options() const noexcept { return options_; }

  State start() const {
    if constexpr (std::same_as<M, GroundMotion>) {
      if (loaded_) {
        check_start(engine_.mounting(), State::at(options_.displacement, options_.velocity), "integrate");
        if (flies() && !options_.settle && !options_.may_end_in_flight)
          check_landing(motion_, engine_.mounting().slope());
      }
    }
    check_start(options_);
    State state = State::at(options_.displacement, options_.velocity);
    state.sliding_distance = options_.sliding_distance;
    state.heat = options_.heat;
    state = engine_.started(state);
    if (!is_stuck(state))
      require(std::isfinite(engine_.resist(state, 1, direction_of(state.mode))),
              "integrate: velocity must not point where the slip level is infinite", options_.velocity, "m/s");
    return state;
  }

  Recorder recorder(const State& state, Response& response) const {
    const std::size_t samples = motion_.samples();
    response.displacement.resize(samples);
    response.velocity.resize(samples);
    response.displacement[0] = state.displacement;
    response.velocity[0] = state.velocity;
    response.gap.clear();
    response.temperature.clear();
    if (engine_.law().heated) response.temperature.resize(samples, engine_.temperature(state));
    response.contact = options_.contact;
    response.components = name_of(Component::axis);  // a transverse component never acts
    if constexpr (std::same_as<M, GroundMotion>) {
      if (loaded_ && flies() && may_fly(motion_, engine_.mounting().slope())) response.gap.assign(samples, 0);
      if (motion_.has_vertical()) response.components += std::string(" + ") + name_of(Component::vertical);
    }
    return {engine_,
            loaded_,
            state.displacement,
            max_events(pieces(motion_)),
            options_.progress,
            std::move(response.events)};
  }

  void walk(State& state, Recorder& recorder, Response& response) const {
    const HistorySpans histories{{response.displacement, response.velocity, response.gap, response.temperature}};
    if constexpr (std::same_as<M, GroundMotion>) {
      if (loaded_)
        run_loaded(engine_, motion_, options_.contact, state, recorder, histories);
      else
        run(engine_, motion_, in_order_, state, recorder, histories);
    } else {
      HarmonicSegments segments(motion_, engine_, recorder, histories);
      engine_.move(segments, motion_.omega(), motion_.dt(), state, recorder);
    }
  }

  double settle(State& state, Recorder& recorder, Response& response) const {
    return settle_freely(*this, state, recorder, response);
  }
  const Engine& slider() const noexcept { return engine_; }
  void calm(double duration, State& state, Sink& sink) const {
    advance(engine_, Segment{duration, 0, 0}, loaded_, options_.contact, state, sink);
  }
  double temperature(const State& state) const { return engine_.temperature(state); }

  double kinetic(const State& state) const { return state.velocity * state.velocity / 2; }
  double elastic(const State& state) const {
    return engine_.mounting().stiffness() * state.displacement * state.displacement / 2 + engine_.elastic(state);
  }
  void finish(const State& state, Response& response) const {
    response.residual = state.displacement;
    response.state = state;
  }

 private:
  bool flies() const noexcept { return options_.contact == Contact::flight; }

  const Engine& engine_;
  const M& motion_;
  const IntegrateOptions& options_;
  bool in_order_, loaded_ = false;
};

/// `integrate` of a slider of any law.
template <Motion M>
Response integrate(const Engine& engine, const M& motion, const IntegrateOptions& options, Response storage,
                   bool in_order) {
  return integrate_run(AxisRun(engine, motion, options, in_order), std::move(storage));
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
/// with a damper, exact to 1e-12, about 0.3 us per sample; at rest 1 ns. The compiled library splits a record with a
/// constant time step and at least 8192 samples, in which the load exceeds the level in a third of the time or more, into
/// pieces, and integrates a block without spring and damper over them in parallel SIMD lanes (AVX-512, AVX2, SSE4 or
/// NEON, whichever the processor has): 12 to 30 ns per sample, and up to 7 MB of
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
