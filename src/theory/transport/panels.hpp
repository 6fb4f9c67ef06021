// Piecewise polynomials on an interval.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace stickslip::detail {

/// Functions on an interval that are a polynomial on each of its panels, by their values at nodes: the Chebyshev points
/// of each panel. Adjacent panels share the one at their edge, so that functions are continuous there. Where they may
/// jump each panel has one of its own, inside by a tiny part of its width. Beyond the ends a function has the
/// value at the end.
class Panels {
 public:
  static constexpr std::size_t max_degree = 10;

  /// The value of a function at a point is the sum of `weights[i]` times the value at node `first + i`, i up to the
  /// degree.
  struct Stencil {
    std::size_t first = 0;
    std::array<double, max_degree + 1> weights{};
  };

  /// Constant functions, by their value at 0.
  Panels() = default;

  /// @param edges   ascending, at least two. Intervals whose edges mirror each other have nodes that do, exactly
  /// @param degree  from 1 to `max_degree`
  /// @param jumps   edges where functions may jump
  Panels(std::vector<double> edges, std::size_t degree, const std::vector<double>& jumps = {});

  std::size_t size() const noexcept { return nodes_.size(); }
  std::size_t degree() const noexcept { return degree_; }
  double node(std::size_t i) const noexcept { return nodes_[i]; }
  const std::vector<double>& edges() const noexcept { return edges_; }

  /// Accurate to round-off, also at and near nodes.
  Stencil at(double x) const;

  /// The node at `x`, which must be an edge without a jump.
  std::size_t node_at(double x) const;

 private:
  std::vector<double> edges_{0}, nodes_{0};
  std::size_t degree_ = 0;
  std::vector<std::size_t> first_{0};  // node of each panel
  std::array<double, max_degree + 1> barycentric_{1};
};

}  // namespace stickslip::detail
