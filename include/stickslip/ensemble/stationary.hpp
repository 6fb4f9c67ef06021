// Averages of an ensemble over the central half of the motion.
#pragma once

#include <cstdint>
#include <string>

#include "stickslip/statistics/tally.hpp"

namespace stickslip {

/// Averages over the central half of the motion, from `begin` to `end` [s], thesis 4.4, with standard errors from the
/// scatter between members. They estimate stationary values only if the velocity is stationary from `begin` to
/// `end`: see `remark`.
struct Stationary {
  double begin, end;
  Estimate velocity_mean;      ///< [m/s]
  Estimate velocity_variance;  ///< [m^2/s^2]
  /// Its error is too small for few members and velocities with heavy tails.
  Estimate velocity_kurtosis;  ///< mean fourth power over the variance squared (Gaussian: 3, Laplace: 6); NaN at rest
  Estimate covariance;         ///< of x and x' [m^2/s]; half of the growth rate, thesis (5.59), with more scatter
  /// Growth of the displacement variance [m^2/s]: of D(t) = Var[x(begin + t) - x(begin)], (D(T) - D(T/2)) / (T/2), T
  /// from begin to end. The part of x that does not grow cancels.
  Estimate growth_rate;
  /// Trend of the velocity variance [m^2/s^2]: its average over the second half of begin to end, minus that over the
  /// first. NaN with fewer than four times.
  Estimate velocity_trend;
  /// The reason why the averages may not be stationary values; empty if the test finds none. It tests the trend: the
  /// limit is the multiple of its error that Student's t with members - 2 degrees of freedom exceeds with the
  /// probability `false_alarm` (two-sided), 3.29 for many members. If the halves are independent, this error is twice
  /// that of velocity_variance: half of the linear drifts whose ends differ from the average by 6.6 standard errors
  /// remain undetected. The test does not detect a variance that changes within the halves but has equal averages in
  /// both. With fewer than eight members or four times there is no test, and the remark states it.
  std::string remark;

  static constexpr double false_alarm = 1e-3;         ///< probability of a remark on a stationary velocity
  static constexpr std::uint64_t fewest_members = 8;  ///< for the test of a trend

  bool is_stationary() const noexcept { return remark.empty(); }
};

}  // namespace stickslip
