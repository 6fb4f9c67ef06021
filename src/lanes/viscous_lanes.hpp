// Many viscous sliders in parallel, each over its own segment of a ground motion.
#pragma once

#include <cstddef>

#include "stickslip/flow/damped.hpp"
#include "stickslip/friction/coulomb.hpp"
#include "stickslip/lanes/row.hpp"
#include "stickslip/slider/slider.hpp"

namespace stickslip::detail {

struct ViscousLanes {
  Slider<Coulomb> slider;  ///< without friction
  DampedBasis step;        ///< of each segment

  /// In units of 1 / wn: the accelerations at both ends of a segment bound those between.
  static constexpr double longest = 1;
};

/// Moves each slider over its segment of ground acceleration, from start[i] to end[i] [m/s^2]: thesis (4.2), in closed
/// form; those whose displacement may turn beyond its peak so far are looked at one by one.
/// @param members  at most `max_lanes`
void advance_lanes(const ViscousLanes& lanes, std::size_t members, const double* start, const double* end,
                   const LaneStates& states);

}  // namespace stickslip::detail
