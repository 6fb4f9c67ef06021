// A periodic motion under a harmonic ground.
#pragma once

#include <array>
#include <complex>
#include <numbers>
#include <vector>

#include "stickslip/detail/equal.hpp"
#include "stickslip/sliding/response.hpp"
#include "stickslip/state.hpp"

namespace stickslip {

/// A periodic motion under -n(t) = B cos(omega t), thesis (2.28), symmetric about a center c:
/// x(t + T/2) - c = c - x(t), T = 2 pi / omega.
struct Orbit {
  double load;       ///< B, amplitude of the load [m/s^2]
  double omega;      ///< [rad/s]
  double amplitude;  ///< half the peak-to-peak displacement [m]; 0 for the rest at the center
  double phase;  ///< of x - center = amplitude cos(omega t + phase): -omega times the time at which x first comes to
                 ///< its highest value, in (-pi, pi] [rad]; NaN at rest. Thesis (2.2), (2.17) as corrected

  int stops_per_cycle;      ///< arrests: times it sticks
  int reversals_per_cycle;  ///< turns without a stop

  /// Floquet multipliers of the half-period map (x - c, x') -> -(x - c, x')(T/2 later), the larger one first: what it
  /// makes of a small change of the state. One is 0 where the slider stops. Those of the whole period are their
  /// squares.
  std::array<std::complex<double>, 2> half_period_multipliers;
  std::array<std::complex<double>, 2> multipliers;

  /// Whether no small change grows: no multiplier beyond the unit circle, by more than 1e-10. One on it is neutral:
  /// Coulomb friction without a spring cares for no mean position, and a rest stays where it is put.
  bool stable;

  /// Whether the mean position is arbitrary (Coulomb friction without a spring); what is given is the orbit around 0.
  bool mean_arbitrary;

  /// c [m]: (backward - forward) / (2 wn^2) for Coulomb friction of unequal levels on a spring, else 0.
  double center;

  State state;                ///< at t = 0; `integrate` started from it stays on the orbit
  std::vector<Event> events;  ///< of one period from t = 0, without an end
  double dissipated;          ///< work against friction in a period, as much as the ground's input [m^2/s^2]

  double period() const noexcept { return 2 * std::numbers::pi / omega; }
  bool at_rest() const noexcept { return detail::equal(amplitude, 0); }
};

}  // namespace stickslip
