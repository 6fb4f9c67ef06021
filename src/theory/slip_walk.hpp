// The maximum displacement of a sum of slips.
#pragma once

#include <functional>

#include "stickslip/theory/displacement_distribution.hpp"
#include "theory/slip_excursion.hpp"

namespace stickslip::detail {

/// The L such that the sum of slips, one by one in any order and with a Poisson-distributed number, stays within -L to
/// L with a given probability.
/// @param slips      independent, with their expected number
/// @param farthest   from a slip, the distances that it reaches on the way, each with the same probability, in its
///                   direction from where the slider lay; ascending, at least |slip| [m]
/// @param probability  in (0, 1)
double slip_walk_peak(const Slips& slips, const std::function<SlipExcursion::Parts(double)>& farthest,
                      double probability);

}  // namespace stickslip::detail
