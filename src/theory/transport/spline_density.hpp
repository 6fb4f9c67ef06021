// A density from the means of functions on panels.
#pragma once

#include <Eigen/Dense>
#include <cstddef>
#include <span>
#include <vector>

#include "theory/transport/panels.hpp"

namespace stickslip::detail {

/// The law of a variable as a point mass at an edge of panels and a density that is a cubic spline on all edges. It has
/// the means that the weights of nodes give of all such splines, and of the function of the node of the point mass. (The
/// means of functions on panels that are not as smooth are less accurate.)
class SplineDensity {
 public:
  /// @param panels  of degree 3 and higher
  /// @param means   of the functions of the nodes of the panels
  /// @param mass_at  the edge of the point mass, at which the density need not be smooth
  SplineDensity(const Panels& panels, const Eigen::VectorXd& means, double mass_at);

  /// The probability of at most x, for each of some x.
  std::vector<double> below(std::span<const double> points) const;

 private:
  class Basis;
  double from_edge(const Basis& basis, std::size_t panel, double x) const;

  std::vector<double> edges_, knots_, whole_{0};  // whole_: the integral up to each edge
  Eigen::VectorXd heights_;
  double mass_at_, mass_ = 0;
};

}  // namespace stickslip::detail
