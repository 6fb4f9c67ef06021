// Sweeps of systems that share a part of the work under each ground motion.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "stickslip/sweep/sweep.hpp"
#include "sweep/combinations.hpp"

namespace stickslip::detail {

using SweepOutcome = SweepOutcomeOf<double, Impacts>;

/// Sliders of a sweep that share a part of the work.
struct SweepGroup {
  using Check = std::function<void()>;  ///< to be called regularly; throws to stop the work
  using Each = std::function<SweepOutcome(std::size_t slider, bool reversed)>;

  std::vector<std::size_t> sliders;  ///< their positions in the sweep
  /// Do the shared work under a ground motion. @return a function that integrates the sliders, by their positions in
  /// the group; both throw as `integrate` does
  std::function<Each(const GroundMotion& motion, bool settle, const Check& check)> start;
};

/// As `sweep` of sliders. Those of the groups need no `integrate`.
SweepTable sweep(std::span<const SweepSlider> sliders, std::span<const SweepGroup> groups,
                 std::span<const GroundMotion* const> motions, const SweepOptions& options);

}  // namespace stickslip::detail
