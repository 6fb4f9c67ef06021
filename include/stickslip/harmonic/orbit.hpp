// A periodic motion under a harmonic ground motion.
#pragma once

#include <array>
#include <complex>
#include <numbers>
#include <vector>

#include "stickslip/base/equal.hpp"
#include "stickslip/sliding/response.hpp"
#include "stickslip/state/state.hpp"

namespace stickslip {

/// A periodic motion under -n(t) = B cos(omega t), thesis (2.28), symmetric about a center c:
/// x(t + T/2) - c = c - x(t), T = 2 pi / omega.
struct Orbit {
  double load;       ///< B, amplitude of the load [m/s^2]
  double omega;      ///< [rad/s]
  double amplitude;  ///< half the peak-to-peak displacement [m]; 0 at rest at the center
  double phase;      ///< of x - center = amplitude cos(omega t + phase): -omega times the time at which x first reaches
                     ///< its maximum, in (-pi, pi] [rad]; NaN at rest. Thesis (2.2), (2.17) as corrected

  int stops_per_cycle;      ///< arrests: number of times the slider sticks
  int reversals_per_cycle;  ///< reversals without sticking

  /// Floquet multipliers of the half-period map (x - c, x') -> -(x - c, x')(T/2 later), the larger one first: the
  /// factors by which the map multiplies a small change of the state. One of them is 0 if the slider stops.
  std::array<std::complex<double>, 2> half_period_multipliers;
  /// Floquet multipliers of the whole period: the squares of `half_period_multipliers`.
  std::array<std::complex<double>, 2> multipliers;

  /// Whether no small change grows: no half-period multiplier exceeds 1 in magnitude by more than 1e-10. A multiplier
  /// on the unit circle is neutral: the mean position under Coulomb friction without a spring is arbitrary, and a
  /// slider at rest stays where it is placed.
  bool stable;

  /// Whether the mean position is arbitrary (Coulomb friction without a spring). If so, this is the orbit around 0.
  bool mean_arbitrary;

  /// c [m]: (backward - forward) / (2 wn^2) for Coulomb friction with unequal levels on a spring, otherwise 0.
  double center;

  State state;                ///< state at t = 0; an integration from this state stays on the orbit
  std::vector<Event> events;  ///< events of one period from t = 0, without EventKind::end
  double dissipated;          ///< work against friction per period, equal to the input of the ground [m^2/s^2]

  double period() const noexcept { return 2 * std::numbers::pi / omega; }
  bool at_rest() const noexcept { return detail::equal(amplitude, 0); }
};

}  // namespace stickslip
