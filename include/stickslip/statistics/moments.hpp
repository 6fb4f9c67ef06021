// Means and covariances of displacement and velocity by time: what theories predict and ensembles measure.
#pragma once

#include <string>
#include <vector>

#include "stickslip/statistics/tally.hpp"

namespace stickslip {

/// The first and second moments of displacement and velocity by time. A theory and an ensemble both answer with this.
///
/// The errors are standard errors of an ensemble; those of a theory are zero: it has no scatter, and is wrong by what
/// it neglects.
struct Moments {
  std::vector<double> time;         ///< [s]
  Estimates displacement_mean;      ///< of x [m]
  Estimates displacement_variance;  ///< of x [m^2]
  Estimates covariance;             ///< of x and x' [m^2/s]
  Estimates velocity_mean;          ///< of x' [m/s]
  Estimates velocity_variance;      ///< of x' [m^2/s^2]
  Estimate growth_rate;  ///< of the displacement variance once the velocity is stationary [m^2/s]; NaN where it
                         ///< never is, or is not known
  std::string remark;    ///< what to know before trusting the figures; empty where there is nothing
};

}  // namespace stickslip
