#include "stickslip/rocking/outcomes.hpp"

#include <cmath>

#include "base/attempt.hpp"
#include "base/outcomes.hpp"
#include "rocking/run.hpp"
#include "stickslip/base/error.hpp"
#include "stickslip/rocking/integrate.hpp"

namespace stickslip {
namespace {

template <class Block>
RockingOutcome outcome(const Block& block, const GroundMotion& motion, const RockingOptions& options) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  RockingOutcome found;
  detail::attempt(
      [&] {
        const RockingResponse r = detail::integrate_without_samples(block, motion, options);
        found = {r.peak,   r.peak_ratio, r.overturned, r.overturned_at,    r.impacts,
                 r.margin, r.condition,  r.residual,   r.sliding_distance, r.liftoffs};
      },
      [&](const char* message) { found = {.peak = nan, .peak_ratio = nan, .failure = message}; });
  return found;
}

using MotionOf = std::function<void(std::size_t, const std::function<void(const GroundMotion&)>&)>;

template <class Block>
std::vector<RockingOutcome> outcomes_of(std::size_t runs, const std::function<const Block&(std::size_t)>& block_of,
                                        const MotionOf& motion_of, const RockingRunOptions& options) {
  return detail::outcomes_of<RockingOutcome>(runs, options, [&](std::size_t i, const std::function<void()>& progress) {
    RockingOptions how;
    how.settle = options.settle;
    how.progress = progress;
    RockingOutcome found;
    motion_of(i, [&](const GroundMotion& motion) { found = outcome(block_of(i), motion, how); });
    return found;
  });
}

template <class Block>
std::vector<ScaleRange> scales_of(const Block& block, const GroundMotion& motion, double up_to, std::size_t steps,
                                  const std::function<void()>& progress) {
  detail::require(std::isfinite(up_to) && up_to > 0, "critical_scales: up_to must be positive and finite", up_to);
  detail::require(steps >= 1, "critical_scales: steps must be at least 1", static_cast<double>(steps));
  RockingOptions how;
  how.settle = true;
  how.progress = progress;
  const auto overturns = [&](double scale) {
    if (progress) progress();
    return detail::integrate_without_samples(block, motion.scaled(scale), how).overturned != 0;
  };
  // Where the outcome changes between two scales.
  const auto bound = [&](double low, double high, bool at_high) {
    while (high - low > 1e-12 * up_to) {
      const double middle = low + (high - low) / 2;
      (overturns(middle) == at_high ? high : low) = middle;
    }
    return high;
  };
  std::vector<ScaleRange> ranges;
  bool before = false;
  double last = 0;
  for (std::size_t k = 1; k <= steps; ++k) {
    const double scale = up_to * (static_cast<double>(k) / static_cast<double>(steps));
    const bool now = overturns(scale);
    if (now != before) {
      const double at = bound(last, scale, now);
      if (now)
        ranges.push_back({at, up_to});
      else
        ranges.back().end = at;
    }
    before = now;
    last = scale;
  }
  return ranges;
}

}  // namespace

std::vector<RockingOutcome> rocking_outcomes(std::size_t runs,
                                             const std::function<const SlenderBlock&(std::size_t)>& block_of,
                                             const MotionOf& motion_of, const RockingRunOptions& options) {
  return outcomes_of(runs, block_of, motion_of, options);
}
std::vector<RockingOutcome> rocking_outcomes(std::size_t runs,
                                             const std::function<const RockingBlock&(std::size_t)>& block_of,
                                             const MotionOf& motion_of, const RockingRunOptions& options) {
  return outcomes_of(runs, block_of, motion_of, options);
}

std::vector<ScaleRange> critical_scales(const SlenderBlock& block, const GroundMotion& motion, double up_to,
                                        std::size_t steps, const std::function<void()>& progress) {
  return scales_of(block, motion, up_to, steps, progress);
}
std::vector<ScaleRange> critical_scales(const RockingBlock& block, const GroundMotion& motion, double up_to,
                                        std::size_t steps, const std::function<void()>& progress) {
  return scales_of(block, motion, up_to, steps, progress);
}

}  // namespace stickslip
