// The maximum displacement of a sum of slips.
#pragma once

#include <functional>

#include "stickslip/theory/displacement_distribution.hpp"

namespace stickslip::detail {

/// The L such that the sum of slips, one by one in any order and with a Poisson-distributed number, stays within -L to
/// L with a given probability.
/// @param slips      independent, with their expected number
/// @param farthest   from the length of a slip, how far the slider is on the way out from where it lay; of its sign,
///                   and not less [m]
/// @param probability  in (0, 1)
double slip_walk_peak(const Slips& slips, const std::function<double(double)>& farthest, double probability);

}  // namespace stickslip::detail
