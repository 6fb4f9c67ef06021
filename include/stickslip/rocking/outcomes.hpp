// Many blocks under many ground motions: what each did, without its history.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "stickslip/ground/ground_motion.hpp"
#include "stickslip/rocking/rocking_block.hpp"
#include "stickslip/rocking/slender_block.hpp"

namespace stickslip {

/// What a block did under a ground motion; the names are those of RockingResponse.
struct RockingOutcome {
  double peak = 0;        ///< [rad]; pi/2 if it overturned
  double peak_ratio = 0;  ///< infinite if it overturned
  int overturned = 0;
  double overturned_at = std::numeric_limits<double>::quiet_NaN();  ///< [s]; NaN if it stands
  std::size_t impacts = 0;
  double margin = std::numeric_limits<double>::infinity();
  double condition = 0;
  double residual = 0;          ///< of the base [m]; 0 of a SlenderBlock
  double sliding_distance = 0;  ///< [m]
  std::size_t liftoffs = 0;
  std::string failure{};  ///< why there is no outcome; peaks are then NaN

  /// The outcome under the mirrored motion, of a block with equal sides.
  RockingOutcome mirrored() const {
    RockingOutcome other = *this;
    other.overturned = -overturned;
    other.residual = -residual;
    return other;
  }
};

struct RockingRunOptions {
  bool settle = true;                                                 ///< as RockingOptions::settle
  unsigned threads = 0;                                               ///< maximum number; 0: all cores
  std::function<void(std::size_t done, std::size_t all)> progress{};  ///< called ten times a second; may throw
};

/// The outcomes of runs.
/// @param motion_of  `motion_of(i, use)` calls `use(motion)` with the motion of run i; several threads call it
/// @param block_of   the block of run i
/// A run that fails (a vertical motion with G <= 0, a restitution of 1 that never settles) is entered with the reason.
std::vector<RockingOutcome> rocking_outcomes(
    std::size_t runs, const std::function<const SlenderBlock&(std::size_t)>& block_of,
    const std::function<void(std::size_t, const std::function<void(const GroundMotion&)>&)>& motion_of,
    const RockingRunOptions& options = {});
std::vector<RockingOutcome> rocking_outcomes(
    std::size_t runs, const std::function<const RockingBlock&(std::size_t)>& block_of,
    const std::function<void(std::size_t, const std::function<void(const GroundMotion&)>&)>& motion_of,
    const RockingRunOptions& options = {});

/// A range of scales of a ground motion, from `begin` to `end`.
struct ScaleRange {
  double begin, end;
};

/// The scales of a ground motion at which a block overturns: a set of ranges, because it may stand at a larger scale than one
/// at which it overturns. The lowest critical scale is the begin of the first.
/// @param up_to   largest scale, positive; a range that reaches it ends there
/// @param steps   scales at which the outcome is computed, spaced evenly up to `up_to`; at least 1. Between two with unequal
///                outcomes the bound is found by bisection, to 1e-12 of `up_to`. A range or a gap narrower than up_to/steps
///                may be missed
/// @param progress  as RockingOptions::progress
/// @throws std::invalid_argument  as `integrate` with `settle`
/// @throws ConvergenceError       as `integrate` with `settle`
std::vector<ScaleRange> critical_scales(const SlenderBlock& block, const GroundMotion& motion, double up_to,
                                        std::size_t steps = 400, const std::function<void()>& progress = {});
std::vector<ScaleRange> critical_scales(const RockingBlock& block, const GroundMotion& motion, double up_to,
                                        std::size_t steps = 400, const std::function<void()>& progress = {});

}  // namespace stickslip
