// Vectors and matrices of structures.
#pragma once

#include "stickslip/base/requirements.hpp"  // before Eigen, whose absence would be told first

#include <Eigen/Core>

namespace stickslip {

/// Vectors and matrices of Eigen whose storage does not depend on how a file is compiled. Eigen allocates its own
/// `VectorXd` differently where the compiler may use AVX, so that one file could not free what another one allocated.
/// They convert from and to all vectors and matrices of Eigen.
using RealVector = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor | Eigen::DontAlign>;
using RealMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor | Eigen::DontAlign>;

}  // namespace stickslip
