// Moments of a chain: by time from rest, and stationary.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "theory/transport/chain.hpp"

namespace stickslip::detail {

/// Means and central moments of displacement and velocity.
struct MotionMoments {
  double x = 0, xx = 0, xv = 0, v = 0, vv = 0;
};

/// Central moments at the ends of steps, from rest: the first at time 0. Once they grow evenly the rest is continued.
std::vector<MotionMoments> history_from_rest(const Chain& chain, std::size_t steps,
                                             const std::function<void()>& progress);

/// The weights after some steps from rest. Their sum is the probability that no wall has been reached.
Chain::Vector weights_from_rest(const Chain& chain, std::size_t steps, const std::function<void()>& progress);

/// The probability that the loads of some steps from the start on lie between two values: at which functions of
/// filtered noise may jump, and on none of which lies a node of the lattice of pulses.
double chance_of_loads(const LoadGrid& load, double least, double most, std::size_t steps);

/// The stationary motion; if x is not part of the state, `xx` is the growth rate of the variance of x.
struct StationaryMotion {
  MotionMoments moments;
  double rest = 0;  ///< probability of rest
};

/// @param guess  weights to begin with, such as those of `weights_from_rest`
StationaryMotion stationary_motion(const Chain& chain, bool with_rest, const Chain::Vector& guess,
                                   const std::function<void()>& progress);

/// E[x'^2] of the stationary motion.
double stationary_velocity(const Chain& chain, const std::function<void()>& progress);

/// The value at `place` (in steps) between values at whole numbers of steps, by a polynomial through six of them.
double between(const std::vector<MotionMoments>& moments, double MotionMoments::*figure, double place);

}  // namespace stickslip::detail
