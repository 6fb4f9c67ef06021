// The response of a slider in the plane to a ground motion.
#pragma once

#include "stickslip/base/vector2.hpp"
#include "stickslip/planar/state.hpp"
#include "stickslip/run/response.hpp"
#include "stickslip/state/surface_heat.hpp"

namespace stickslip {

/// A `reversal` is a stop of no duration; generic motion in the plane has none, because its velocity turns without
/// vanishing.
using PlanarEvent = EventAt<Vector2>;

/// The motion of a slider in the plane under one ground motion. The energy balance is that along the path, of the
/// integrals of p.r', resist N+/g |r'| and c |r'|^2.
struct PlanarResponse : ResponseOf<Vector2, PlanarState> {
  double peak_time = 0;         ///< time of the largest |r| [s]
  Vector2 peak_displacement{};  ///< r at that time [m]
  SurfaceHeat heat{};           ///< of the sliding surface at the start
};

/// Its motion at the samples of the ground motion.
using PlanarHistories = HistoriesOf<Vector2>;

}  // namespace stickslip
