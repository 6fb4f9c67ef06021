// The probability that a slender block overturns under noise, by the transport operator.
#pragma once

#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "stickslip/rocking/slender_block.hpp"
#include "stickslip/statistics/tally.hpp"
#include "stickslip/theory/transport.hpp"

namespace stickslip::theory {

struct OverturningOptions {
  /// Relative error at which the refinement ends, from 0.005 to 0.3; a probability below 1e-5 only needs that of 1e-5.
  double tolerance = 0.03;
  /// |theta| over the alpha of its side at which a block counts as overturned before, positive; infinite: where it is
  /// certain not to come back.
  double ratio = std::numeric_limits<double>::infinity();
  std::function<void()> progress{};  ///< called regularly; may throw to stop the work; optional
};

/// The probability that a slender block that starts at rest has overturned by the given times, under stationary noise.
///
/// A function of the state is carried backward: f = 1 where the block is lost, and after k steps f(y, v, z) is the
/// probability to be lost within k steps from rotation y = theta / alpha, rate v and noise z on,
///     f_(k+1)(y, v, z) = E f_k(S(y, v; n(z)), z').
/// S is the exact motion with all impacts under the load held at its value in the middle of the step; under white noise
/// it is a push, and the free motion. By symmetry a block with equal sides is a ball that bounces on a half line, where
/// each bounce changes the sign of the noise. Lost is a block whose v + y - 1, without units, is 5.5 times the deviation of
/// the noise that could bring it back, which it does with a probability below 4e-8. Once the probability a step is
/// constant, the rest is continued.
///
/// The error of each value is numerical: the last change by the extrapolation of steps and grids, which are refined
/// together, and at least 0.4 %, by which grids of these sizes differ. Simulation confirms it at restitutions of 0.4 to
/// 0.95 and deviations of 0.12 to 0.9, under white and held noise (docs/rocking.md).
///
/// @param block  restitution from 0.2 on: below, a block under white noise comes to rest by infinitely many impacts at
///               once; the ratio of both alphas at most 2
/// @param noise  white, also held; or filtered with a damping ratio from 0.1 to 1.5 and 0.5 p to 50 p of frequency. The
///               deviation of v by the noise (white: sqrt(pi p S0)/(alpha g)) from 0.04 to 1
/// @param times  [s], finite, at least 0, increasing
/// @return       a value and its error for each time
/// @throws std::invalid_argument  naming the value
/// @throws ConvergenceError       the tolerance is not reached with the largest grid; names the best value and its error
/// Takes 1 to 20 s under white noise, 20 s to some minutes under filtered noise.
std::vector<Estimate> overturning_probability(const SlenderBlock& block, const TwoStateNoise& noise,
                                              std::span<const double> times, const OverturningOptions& options = {});

}  // namespace stickslip::theory
