// Many Coulomb blocks side by side, each over a segment of a ground motion of its own.
#pragma once

#include <cstddef>

#include "lane_queue.hpp"

namespace stickslip::detail {

/// Coulomb friction without a spring, and the length of a segment.
struct CoulombLanes {
  double forward;   ///< slip level against forward sliding [m/s^2], finite
  double backward;  ///< against backward sliding [m/s^2], may be infinite
  double duration;  ///< of each segment [s]
};

/// Moves each block over its segment of ground acceleration, from start[i] to end[i] [m/s^2]: thesis (4.51) to (4.53),
/// in closed form, with up to two stops and breakaways. The formulas are those of flow/polynomial.hpp and advance.hpp,
/// for many at a time: those blocks which may have an event are set apart by a test that errs on the safe side, and
/// done together.
/// @param members  at most `most_lanes`
void advance_lanes(const CoulombLanes& slider, std::size_t members, const double* start, const double* end,
                   const LaneStates& states);

}  // namespace stickslip::detail
