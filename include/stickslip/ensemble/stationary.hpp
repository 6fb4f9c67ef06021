// Averages of an ensemble over the central half of the motion.
#pragma once

#include "stickslip/statistics/tally.hpp"

namespace stickslip {

/// Averages over the central half of the motion, from `begin` to `end` [s], thesis 4.4, with standard errors from the
/// scatter between members.
struct Stationary {
  double begin, end;
  Estimate velocity_mean;      ///< [m/s]
  Estimate velocity_variance;  ///< [m^2/s^2]
  /// Its error is too small where members are few and velocities have heavy tails.
  Estimate velocity_kurtosis;  ///< mean fourth power over the variance squared (Gaussian: 3, Laplace: 6); NaN at rest
  Estimate covariance;         ///< of x and x' [m^2/s]; half of the growth rate, thesis (5.59), with more scatter
  /// Growth of the displacement variance [m^2/s]: of D(t) = Var[x(begin + t) - x(begin)], (D(T) - D(T/2)) / (T/2), T
  /// from begin to end. The part of x that does not grow cancels.
  Estimate growth_rate;
};

}  // namespace stickslip
