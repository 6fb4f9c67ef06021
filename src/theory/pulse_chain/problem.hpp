// A slider under Poisson pulses in the units of the synchronized-arrival chain.
#pragma once

#include "stickslip/excitation/poisson.hpp"
#include "stickslip/friction/coulomb.hpp"
#include "stickslip/slider/slider.hpp"
#include "theory/pulse_chain/lattice.hpp"

namespace stickslip::detail::pulse_chain {

/// Above this sigma / a, the results are those without friction minus a part that falls as a / sigma: growth is
/// accurate to 3 % if at most one pulse arrives per step, or if friction is negligible.
constexpr double strongest = 256;
constexpr double weakest = 0.05, min_refined_sigma = 0.12;

/// @throws std::invalid_argument if the chain does not cover the shape
Steps steps_of(const PulseShape& shape, int slots);

/// A slider under pulses, in the units of the chain.
struct Problem {
  double step;   ///< of the pulse [s]
  double push;   ///< rms of the largest acceleration of a pulse [m/s^2]
  double sigma;  ///< the same in slip levels; the chain's own, in `arrivals`, is at most `strongest`
  Slider<Coulomb> block;
  Arrivals arrivals;
  double chance;  ///< upper bound of the probability that anything slips; 1 where sigma is not below `weakest`
  const PulseShape& shape;

  /// @throws std::invalid_argument if the chain does not cover the arguments
  Problem(const Slider<Coulomb>& slider, const PoissonPulses& pulses);

  bool drifting() const { return strength_of(arrivals) > 3; }
  double acceleration() const { return push / arrivals.sigma; }  ///< the slip level, unless it is too small
};

}  // namespace stickslip::detail::pulse_chain
