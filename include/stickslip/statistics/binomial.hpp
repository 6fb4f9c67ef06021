// Confidence bounds of a probability, from a count.
#pragma once

#include <cstdint>

#include "stickslip/statistics/tally.hpp"

namespace stickslip {

/// The fraction of trials that succeed, with the bounds of Clopper and Pearson (1934).
/// @param count       successes, at most `trials`
/// @param trials      at least 1
/// @param confidence  of the bounds, in (0, 1)
Interval binomial_interval(std::uint64_t count, std::uint64_t trials, double confidence = 0.95);

}  // namespace stickslip
