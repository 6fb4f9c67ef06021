// Many Coulomb blocks side by side, each over a segment of a ground motion of its own.
#pragma once

#include <cstddef>

#include "row_moments.hpp"

namespace stickslip::detail {

/// Coulomb friction without a spring, and the length of a segment.
struct CoulombLanes {
  double forward;   ///< slip level against forward sliding [m/s^2], finite
  double backward;  ///< against backward sliding [m/s^2], may be infinite
  double duration;  ///< of each segment [s]
};

/// The blocks' states, padded to a multiple of `row_padding`. The velocity is exactly 0 where a block is stuck, and
/// only there: Coulomb friction has no other memory.
struct LaneStates {
  double* displacement;  ///< x [m]
  double* velocity;      ///< x' [m/s]
  double* peak;          ///< largest |x| so far [m]
};

/// Moves each block over its segment of ground acceleration, from start[i] to end[i] [m/s^2]: thesis (4.51) to (4.53),
/// in closed form, with up to two stops and breakaways. The formulas are those of flow/polynomial.hpp and advance.hpp,
/// for many at a time: those blocks which may have an event are set apart by a test that errs on the safe side, and
/// done together.
/// @param members  at most `most_lanes`
void advance_lanes(const CoulombLanes& slider, std::size_t members, const double* start, const double* end,
                   const LaneStates& states);

inline constexpr std::size_t most_lanes = 64;

}  // namespace stickslip::detail
