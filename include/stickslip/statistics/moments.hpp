// Means and covariances of displacement and velocity by time: predicted by theories and measured by ensembles.
#pragma once

#include <string>
#include <vector>

#include "stickslip/statistics/tally.hpp"

namespace stickslip {

/// The first and second moments of displacement and velocity by time. Theories and ensembles both return this.
///
/// The errors are the standard errors of an ensemble. Those of a theory are zero, because it has no scatter; its error
/// comes from its assumptions.
struct Moments {
  std::vector<double> time;         ///< [s]
  Estimates displacement_mean;      ///< of x [m]
  Estimates displacement_variance;  ///< of x [m^2]
  Estimates covariance;             ///< of x and x' [m^2/s]
  Estimates velocity_mean;          ///< of x' [m/s]
  Estimates velocity_variance;      ///< of x' [m^2/s^2]
  Estimate growth_rate;             ///< of the displacement variance once the velocity is stationary [m^2/s]; NaN if it
                                    ///< never is, or if unknown
  std::string remark;               ///< limits on the reliability of the values; empty if none
};

}  // namespace stickslip
