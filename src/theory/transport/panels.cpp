#include "theory/transport/panels.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "stickslip/base/equal.hpp"

namespace stickslip::detail {

Panels::Panels(std::vector<double> edges, std::size_t degree, const std::vector<double>& jumps)
    : edges_(std::move(edges)), degree_(degree) {
  std::array<double, max_degree + 1> reference{};  // Chebyshev points on [-1, 1]
  for (std::size_t k = 0; k <= degree; ++k) {
    // an odd function of the distance from the middle, so that points mirror each other
    const double turn = (2 * static_cast<double>(k) - static_cast<double>(degree)) / (2 * static_cast<double>(degree));
    reference[k] = std::sin(std::numbers::pi * turn);
    barycentric_[k] = (k % 2 == 0 ? 1.0 : -1.0) * (k == 0 || k == degree ? 0.5 : 1.0);
  }
  nodes_.clear();
  first_.clear();
  const auto jump = [&](double edge) { return std::ranges::any_of(jumps, [&](double at) { return equal(at, edge); }); };
  for (std::size_t i = 0; i + 1 < edges_.size(); ++i) {
    const double low = edges_[i], high = edges_[i + 1], middle = (high + low) / 2, half = (high - low) / 2;
    constexpr double inside = 1e-12;
    const bool apart = jump(low);
    if (i == 0 || apart) nodes_.push_back(apart ? low + inside * (high - low) : low);
    first_.push_back(nodes_.size() - 1);
    for (std::size_t k = 1; k < degree; ++k) nodes_.push_back(middle + half * reference[k]);
    nodes_.push_back(jump(high) ? high - inside * (high - low) : high);
  }
}

Panels::Stencil Panels::at(double x) const {
  Stencil stencil;
  if (degree_ == 0) {
    stencil.weights[0] = 1;
    return stencil;
  }
  const double inside = std::clamp(x, edges_.front(), edges_.back());
  const auto next = std::upper_bound(edges_.begin() + 1, edges_.end() - 1, inside);
  stencil.first = first_[static_cast<std::size_t>(next - edges_.begin() - 1)];
  double sum = 0;
  for (std::size_t k = 0; k <= degree_; ++k) {
    const double apart = inside - nodes_[stencil.first + k];
    if (equal(apart, 0)) {
      stencil.weights = {};
      stencil.weights[k] = 1;
      return stencil;
    }
    sum += stencil.weights[k] = barycentric_[k] / apart;
  }
  for (std::size_t k = 0; k <= degree_; ++k) stencil.weights[k] /= sum;
  return stencil;
}

std::size_t Panels::node_at(double x) const {
  return static_cast<std::size_t>(std::ranges::lower_bound(nodes_, x) - nodes_.begin());
}

}  // namespace stickslip::detail
