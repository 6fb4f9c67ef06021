// The motion at the samples only: faster than a full response.
#pragma once

#include <functional>
#include <utility>

#include "stickslip/ground/ground_motion.hpp"
#include "stickslip/run/detail/run.hpp"
#include "stickslip/slider/slider.hpp"
#include "stickslip/sliding/detail/engine_of.hpp"
#include "stickslip/sliding/detail/recorder.hpp"
#include "stickslip/sliding/detail/run.hpp"
#include "stickslip/sliding/response.hpp"
#include "stickslip/state/state.hpp"

namespace stickslip {

/// Integrate the motion from rest at x = 0 and return only displacement and velocity at the samples, without the
/// events, peak and energy that `integrate` returns:
///     x'' + resist sgn(x') + c x' + wn^2 x = -n(t).
/// @param slider     any law, with or without a spring and a damper
/// @param motion     the ground acceleration
/// @param progress   called about once per second or more often; may throw to stop the work; optional
/// @param storage    discarded histories whose buffers are reused (allocation can cost as much as the integration)
/// @throws std::invalid_argument  a vertical motion under which the slider never lands
/// @throws std::overflow_error  a displacement or velocity beyond the range of doubles
/// @throws ConvergenceError     a law without power series; more events than `integrate` allows
/// Accuracy as `integrate`; the last bits may differ. Cost: Coulomb friction without a spring 9 to 14 ns per sample
/// with even steps, including the allocation, compared with 20 to 42 ns for `integrate` (AVX2).
template <FrictionLaw Law>
Histories histories(const Slider<Law>& slider, const GroundMotion& motion, const std::function<void()>& progress = {},
                    Histories storage = {}) {
  const detail::EngineOf<Law> engine(slider);
  State state;
  detail::NoRecorder none(detail::max_events(motion.segments()), progress);
  const auto walk = [&](const detail::HistorySpansOf<double>& all) {
    const detail::HistorySpans spans{all};
    if (engine.loaded(motion)) {
      detail::check_landing(motion, slider.slope());
      detail::run_loaded(engine, motion, Contact::flight, state, none, spans);
    } else {
      detail::run(engine, motion, false, state, none, spans);
    }
  };
  return detail::histories_by<double>(motion.samples(), walk, std::move(storage));
}

template <FrictionLaw Law>
Histories histories(const Law& law, const GroundMotion& motion, const std::function<void()>& progress = {},
                    Histories storage = {}) {
  return histories(Slider<Law>(law), motion, progress, std::move(storage));
}

}  // namespace stickslip
