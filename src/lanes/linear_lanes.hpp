// Sliders whose motion is linear between events, in parallel, all under one ground motion.
#pragma once

#include <memory>
#include <span>

#include "lanes/level_lanes.hpp"
#include "stickslip/sliding/detail/linear_mover.hpp"
#include "stickslip/state/state.hpp"

namespace stickslip::detail {

/// A slider that starts from rest at 0, on level ground.
struct LinearLane {
  std::unique_ptr<LinearMover> mover;
  bool turned;  ///< under the flipped motion
  const LinearLevels* levels = mover->levels();
  State state{};        ///< at the end
  SweepWatch watch{};   ///< at the end
  bool failed = false;  ///< the event loop gave up
};

/// Moves all lanes through the motion, as `integrate` does each, to round-off.
///
/// The lanes are taken as many at a time as a vector holds. Each step takes a vector through one segment: lanes that
/// slide by a linear step, if that proves that the speed stays positive and nothing changes, lanes that are stuck if
/// their load is held. The other lanes take this segment through
/// its events: with constant levels, by the power series of their step, where no decision is close; else by their event
/// loop. A vector that is stuck in all lanes skips
/// to the next segment that moves one of them.
///
/// @param settle  go on without ground acceleration until they rest
/// @pre ground.usable() and not weighed; the movers are for ground.duration()
void slide_linear(const LevelGround& ground, std::span<LinearLane> lanes, bool settle);

}  // namespace stickslip::detail
