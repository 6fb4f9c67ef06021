// Averages of an ensemble over the central half of the motion.
#pragma once

#include <cstdint>
#include <string>

#include "stickslip/statistics/tally.hpp"

namespace stickslip {

/// Averages over the central half of the motion, from `begin` to `end` [s], thesis 4.4, with standard errors from the
/// scatter between members. They estimate stationary values only where the velocity is stationary from `begin` to
/// `end`: see `remark`.
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
  /// Trend of the velocity variance [m^2/s^2]: its average over the second half of begin to end, less that over the
  /// first. NaN with fewer than four times.
  Estimate velocity_trend;
  /// Why the averages are not shown to be stationary values; empty where nothing speaks against it. A trend speaks
  /// against it that is this many of its errors from 0, either way, as Student's t of members - 2 degrees of freedom
  /// exceeds with probability `false_alarm`: 3.29 of many members. Where the halves are independent that error is twice
  /// the one of velocity_variance: a linear drift stays unseen, half of the time, until its ends are 6.6 standard
  /// errors off the average. A variance that is the same in both halves and changes within them is not seen. Fewer than
  /// eight members or four times cannot tell, and the remark says so.
  std::string remark;

  static constexpr double false_alarm = 1e-3;         ///< probability of a remark on a stationary velocity
  static constexpr std::uint64_t fewest_members = 8;  ///< of which a trend can be judged

  bool is_stationary() const noexcept { return remark.empty(); }
};

}  // namespace stickslip
