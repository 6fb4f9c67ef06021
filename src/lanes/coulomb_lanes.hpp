// Many Coulomb blocks in parallel, each over its own segment of a ground motion.
#pragma once

#include <cstddef>
#include <cstdint>

#include "stickslip/lanes/row.hpp"
#include "stickslip/sliding/response.hpp"

namespace stickslip::detail {

/// Coulomb friction without a spring, and the length of a segment. `SeriesLanes` do the same for any law; closed forms
/// take a tenth of their time.
struct CoulombLanes {
  double forward;   ///< slip level against forward sliding [m/s^2], finite
  double backward;  ///< against backward sliding [m/s^2], may be infinite
  double duration;  ///< of each segment [s]
};

/// An event of one of the blocks; its velocity is 0.
struct LaneEvent {
  double time;            ///< since the segment began [s]
  double displacement;    ///< x [m]
  std::uint32_t segment;  ///< as the account counts them
  EventKind kind;
};

/// The data of a complete response, apart from the states.
struct LaneAccount {
  static constexpr std::size_t max_events = 4;  ///< of a block in a segment

  std::uint32_t segment;      ///< the current one
  LaneEvent** next;           ///< where each block's next event goes, moved on; there is room for `max_events`
  const double* work_before;  ///< of the ground on each block, before the segment [m^2/s^2]
  double* work_after;         ///< and after it, set
  std::uint64_t indistinct;   ///< the bit of a block is set where two events coincide, or one and the end of its
                              ///< segment, or where squares leave the range of doubles: `advance` knows what is right
};

/// Moves each block over its segment of ground acceleration, from start[i] to end[i] [m/s^2]: thesis (4.51) to (4.53),
/// in closed form, with up to two stops and breakaways. The formulas are those of flow/polynomial.hpp and advance.hpp,
/// for many at a time: those blocks which may have an event are set apart by a test that errs on the safe side, and
/// done together.
/// @param members  at most `max_lanes`
void advance_lanes(const CoulombLanes& slider, std::size_t members, const double* start, const double* end,
                   const LaneStates& states);

/// The same for rows of `max_lanes`, from the states of one row to those of the next; the peaks are not used.
/// @param account  or null
void advance_lanes(const CoulombLanes& slider, const double* start, const double* end, const LaneStates& row,
                   const LaneStates& next_row, LaneAccount* account);

}  // namespace stickslip::detail
