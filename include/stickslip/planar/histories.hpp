// The motion in the plane at the samples only: faster than a full response.
#pragma once

#include <functional>

#include "stickslip/base/vector2.hpp"
#include "stickslip/ground/ground_motion.hpp"
#include "stickslip/planar/integrate.hpp"
#include "stickslip/planar/response.hpp"
#include "stickslip/planar/slider.hpp"
#include "stickslip/planar/state.hpp"
#include "stickslip/run/detail/run.hpp"

namespace stickslip {

namespace detail {

inline PlanarHistories histories(const PlanarEngine& engine, const GroundMotion& motion,
                                 const std::function<void()>& progress) {
  const PlanarPieces pieces(motion, engine.mounting().slope());
  check_landing(motion, engine.mounting().slope());
  PlanarState state;
  NoPlanarRecorder none(max_events(motion.segments()), progress);
  return histories_by<Vector2>(motion.samples(), [&](const HistorySpansOf<Vector2>& histories) {
    walk_plane(engine, motion, pieces, Contact::flight, state, none, histories);
  });
}

}  // namespace detail

/// Integrate the motion in the plane from rest at r = 0 and return only displacement and velocity at the samples,
/// without the events, peak and energy that `integrate` returns; see PlanarSlider for the equation.
/// @param slider    any law for the plane, with or without a spring, a damper, a slope and a stop
/// @param motion    the ground acceleration, with a transverse component; a vertical one acts, too
/// @param progress  called about once per second or more often; may throw to stop the work; optional
/// @throws std::invalid_argument  a motion without a transverse component; a vertical motion under which the slider
///                                never lands
/// @throws std::overflow_error    a displacement or velocity beyond the range of doubles
/// @throws ConvergenceError       as `integrate`
/// The same bits as `integrate`. Cost: 2 to 10 ns a sample at rest; while it slides, about half of that of `integrate`.
template <IsotropicLaw Law>
PlanarHistories histories(const PlanarSlider<Law>& slider, const GroundMotion& motion,
                          const std::function<void()>& progress = {}) {
  return detail::histories(detail::PlanarEngineOf(slider), motion, progress);
}

}  // namespace stickslip
