// The measured accuracy of the pulse theories, in words: one source for remarks, docstrings and pages.
#pragma once

#include "stickslip/base/requirements.hpp"

namespace stickslip::detail {

/// Sentences with the ranges in which the pulse theories were compared with simulations, and the errors found there.
/// Remarks and docstrings quote them, and so do docs/pulse_chain.md and docs/pulse_superposition.md, which have the
/// tables behind them.
struct PulseAccuracy {
  const char* weak;          ///< moments by the plain chain where sigma / a is below 0.3
  const char* near_levels;   ///< drift by the refined chain where the levels are nearly equal
  const char* distribution;  ///< `PulseChain::distribution`, within its range
  const char* weakest;       ///< the same below that range
  const char* peak;          ///< `PulseChain::peak`
  const char* rare;          ///< `PulseSuperposition::distribution`
};

const PulseAccuracy& pulse_accuracy();

/// Of estimates to simulated values.
struct RatioRange {
  double smallest, largest;
};

/// The ratios found for `PulseChain::peak`, within the range that `pulse_accuracy().peak` states.
/// @param slips  expected number of slips; (0, infinity) where nothing was measured
RatioRange peak_ratio(double slips);

}  // namespace stickslip::detail
