#include "theory/transport/spline_density.hpp"

#include <gsl/gsl_bspline.h>

#include <algorithm>
#include <array>
#include <memory>
#include <new>

#include "stickslip/base/equal.hpp"
#include "stickslip/numerics/gauss_legendre.hpp"

namespace stickslip::detail {
namespace {

constexpr std::size_t order = 4;

Eigen::Index index(std::size_t i) { return static_cast<Eigen::Index>(i); }

}  // namespace

/// Cubic B-splines.
class SplineDensity::Basis {
 public:
  explicit Basis(const std::vector<double>& knots) : space_(gsl_bspline_alloc(order, knots.size()), &gsl_bspline_free) {
    if (!space_) throw std::bad_alloc();
    const gsl_vector_const_view view = gsl_vector_const_view_array(knots.data(), knots.size());
    gsl_bspline_knots(&view.vector, space_.get());
  }

  std::size_t size() const { return gsl_bspline_ncoeffs(space_.get()); }

  /// Calls `use(function, value)` for those that do not vanish at x.
  template <class Use>
  void at(double x, const Use& use) const {
    std::array<double, order> values{};
    gsl_vector_view view = gsl_vector_view_array(values.data(), order);
    std::size_t first = 0, last = 0;
    gsl_bspline_eval_nonzero(x, &view.vector, &first, &last, space_.get());
    for (std::size_t i = first; i <= last; ++i) use(index(i), values[i - first]);
  }

 private:
  std::unique_ptr<gsl_bspline_workspace, decltype(&gsl_bspline_free)> space_;
};

SplineDensity::SplineDensity(const Panels& panels, const Eigen::VectorXd& means, double mass_at)
    : edges_(panels.edges()), knots_(edges_), mass_at_(mass_at) {
  // Two more knots at an edge leave the spline continuous there.
  const auto at = std::ranges::lower_bound(knots_, mass_at);
  if (at != knots_.begin() && at != knots_.end() && at + 1 != knots_.end()) knots_.insert(at, 2, *at);
  const Basis basis(knots_);
  Eigen::VectorXd of_splines = Eigen::VectorXd::Zero(index(basis.size()));
  for (std::size_t node = 0; node < panels.size(); ++node)
    basis.at(panels.node(node), [&](Eigen::Index i, double value) { of_splines[i] += value * means[index(node)]; });
  Eigen::MatrixXd products = Eigen::MatrixXd::Zero(of_splines.size(), of_splines.size());
  for (std::size_t panel = 0; panel + 1 < edges_.size(); ++panel)
    numerics::gauss_points<order>(edges_[panel], edges_[panel + 1], [&](double x, double weight) {
      basis.at(x, [&](Eigen::Index i, double one) {
        basis.at(x, [&](Eigen::Index j, double other) { products(i, j) += weight * one * other; });
      });
    });
  // The point mass: the mean of the function of its node is that of the density and 1 times the mass.
  const std::size_t node = panels.node_at(mass_at);
  Eigen::VectorXd here = Eigen::VectorXd::Zero(of_splines.size()), of_node = here;
  basis.at(mass_at, [&](Eigen::Index i, double value) { here[i] = value; });
  for (std::size_t panel = 0; panel + 1 < edges_.size(); ++panel)
    if (edges_[panel] <= mass_at && mass_at <= edges_[panel + 1])
      numerics::gauss_points<8>(edges_[panel], edges_[panel + 1], [&](double x, double weight) {
        const Panels::Stencil stencil = panels.at(x);
        basis.at(x, [&](Eigen::Index i, double value) {
          of_node[i] += weight * value * stencil.weights[node - stencil.first];
        });
      });
  // Panels may be much narrower than others.
  const Eigen::VectorXd scale = products.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd scaled = scale.asDiagonal() * (products - here * of_node.transpose()) * scale.asDiagonal();
  heights_ =
      scale.cwiseProduct(scaled.partialPivLu().solve(scale.cwiseProduct(of_splines - here * means[index(node)])));
  mass_ = means[index(node)] - of_node.dot(heights_);
  for (std::size_t panel = 0; panel + 1 < edges_.size(); ++panel)
    whole_.push_back(whole_.back() + from_edge(basis, panel, edges_[panel + 1]));
}

double SplineDensity::from_edge(const Basis& basis, std::size_t panel, double x) const {
  double sum = 0;
  numerics::gauss_points<order>(edges_[panel], x, [&](double at, double weight) {
    basis.at(at, [&](Eigen::Index i, double value) { sum += weight * heights_[i] * value; });
  });
  return sum;
}

std::vector<double> SplineDensity::below(std::span<const double> points) const {
  const Basis basis(knots_);
  std::vector<double> found;
  for (const double x : points) {
    const double inside = std::clamp(x, edges_.front(), edges_.back());
    const auto panel =
        static_cast<std::size_t>(std::upper_bound(edges_.begin() + 1, edges_.end() - 1, inside) - edges_.begin() - 1);
    found.push_back(whole_[panel] + from_edge(basis, panel, inside) + (x >= mass_at_ ? mass_ : 0));
  }
  return found;
}

}  // namespace stickslip::detail
