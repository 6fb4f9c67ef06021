// What structures show, as Eigen sees it.
//
// The library calls the namespace of Eigen `stickslip_eigen` (CMakeLists.txt). Otherwise the linker would take some of
// Eigen's functions from a user's code, where they may be compiled for other instructions and allocate differently.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "stickslip/structure/matrix.hpp"

namespace stickslip::detail {

inline Eigen::Map<const Eigen::VectorXd> view(const std::vector<double>& of) {
  return {of.data(), static_cast<Eigen::Index>(of.size())};
}
inline Eigen::Map<Eigen::VectorXd> view(std::vector<double>& of) {
  return {of.data(), static_cast<Eigen::Index>(of.size())};
}
inline Eigen::Map<const Eigen::MatrixXd> view(const RealMatrix& of) { return {of.data(), of.rows(), of.cols()}; }

/// The values of a vector or of an expression.
template <class Vector>
std::vector<double> values(const Eigen::DenseBase<Vector>& of) {
  std::vector<double> result(static_cast<std::size_t>(of.size()));
  view(result) = of;
  return result;
}

}  // namespace stickslip::detail
