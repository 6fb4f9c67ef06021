#include "theory/transport/load_grid.hpp"

#include <gsl/gsl_integration.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <new>
#include <numbers>
#include <utility>

#include "stickslip/base/equal.hpp"
#include "stickslip/numerics/gauss_legendre.hpp"

namespace stickslip::detail {
namespace {

using std::numbers::pi;

double normal_cdf(double x) { return std::erfc(-x / std::numbers::sqrt2) / 2; }

/// Nodes and weights for the mean of a function of a standard Gaussian variable, which mirror each other exactly.
struct HermiteRule {
  std::vector<double> nodes, weights;

  explicit HermiteRule(std::size_t points) : nodes(points), weights(points) {
    const std::unique_ptr<gsl_integration_fixed_workspace, decltype(&gsl_integration_fixed_free)> rule(
        gsl_integration_fixed_alloc(gsl_integration_fixed_hermite, points, 0, 0.5, 0, 0), &gsl_integration_fixed_free);
    if (!rule) throw std::bad_alloc();
    for (std::size_t i = 0; i < points; ++i) {
      const std::size_t mirror = points - 1 - i;
      nodes[i] = (rule->x[i] - rule->x[mirror]) / 2;
      weights[i] = (rule->weights[i] + rule->weights[mirror]) / 2 / std::sqrt(2 * pi);
    }
  }
};

/// The polynomial through values at given nodes, in barycentric form.
class Interpolation {
 public:
  explicit Interpolation(const std::vector<double>& nodes) : nodes_(nodes), barycentric_(nodes.size(), 1) {
    for (std::size_t i = 0; i < nodes.size(); ++i)
      for (std::size_t j = 0; j < nodes.size(); ++j)
        if (i != j) barycentric_[i] /= nodes[i] - nodes[j];
  }

  /// Adds `factor` times the weights of the values at the nodes for the value at x.
  void add(double x, double factor, double* weights) const {
    double sum = 0;
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      if (equal(x, nodes_[i])) {
        weights[i] += factor;
        return;
      }
      sum += barycentric_[i] / (x - nodes_[i]);
    }
    for (std::size_t i = 0; i < nodes_.size(); ++i) weights[i] += factor * (barycentric_[i] / (x - nodes_[i])) / sum;
  }

 private:
  const std::vector<double>& nodes_;
  std::vector<double> barycentric_;
};

}  // namespace

void gaussian_points(double mean, double deviation, std::vector<double> cuts,
                     const std::function<void(double, double)>& use) {
  constexpr double far = gaussian_reach;
  for (const double k : {-far, -5.5, -4.0, -2.5, -1.25, 0.0, 1.25, 2.5, 4.0, 5.5, far})
    cuts.push_back(mean + k * deviation);
  std::ranges::sort(cuts);
  const double low = mean - far * deviation, high = mean + far * deviation;
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
    const double from = std::max(cuts[i], low), to = std::min(cuts[i + 1], high);
    if (!(from < to)) continue;
    numerics::gauss_points<8>(from, to, [&](double x, double width) {
      const double y = (x - mean) / deviation;
      use(x, width * std::exp(-y * y / 2) / (deviation * std::sqrt(2 * pi)));
    });
  }
}

FilterStates::FilterStates(const theory::ShapingFilter& filter) {
  const theory::ShapingFilter::Section& s = filter.sections().front();
  const double rate_rms = std::sqrt(pi * filter.s0() / s.d1), state_rms = rate_rms / std::sqrt(s.d0);
  const double by_state = s.b0 * state_rms, by_rate = s.b1 * rate_rms;
  rms = std::hypot(by_state, by_rate);
  frequency = std::sqrt(s.d0);
  roughness = std::abs(s.b1) * std::sqrt(2 * pi * filter.s0());
  Eigen::Matrix2d turn, change;
  turn << by_state / rms, by_rate / rms, -by_rate / rms, by_state / rms;
  change << 0, frequency, -frequency, -s.d1;  // of y and y' over their rms
  rate = turn * change * turn.transpose();
}

Eigen::Matrix2d FilterStates::transition(double step) const {
  const double half_trace = rate.trace() / 2;
  const Eigen::Matrix2d one = Eigen::Matrix2d::Identity(), turning = rate - half_trace * one;
  const double square = -turning.determinant() * step * step, root = std::sqrt(std::abs(square));  // turning^2 = -det
  const double even = square < 0 ? std::cos(root) : std::cosh(root);
  const double odd = root < 1e-4 ? 1 + square / 6 : (square < 0 ? std::sin(root) : std::sinh(root)) / root;
  return std::exp(half_trace * step) * (even * one + odd * step * turning);
}

LoadGrid::LoadGrid(double deviation) : deviation_(deviation) {}

LoadGrid::LoadGrid(const FilterStates& noise, Panels load, std::size_t hidden, double step)
    : load_(std::move(load)), hidden_(hidden), rms_(noise.rms), transition_(noise.transition(step)) {
  const HermiteRule rule(hidden), conditional((hidden + 2) / 2);
  states_ = rule.nodes;
  const Interpolation in_state(states_);
  std::vector<double> cuts = load_.edges();
  for (double& cut : cuts) cut /= rms_;
  const auto n = static_cast<Eigen::Index>(size());

  // The mean over u = n / rms by quadrature between the edges of its panels, that over m given u by Gauss-Hermite.
  const Eigen::Matrix2d covariance = Eigen::Matrix2d::Identity() - transition_ * transition_.transpose();
  const double deviation = std::sqrt(covariance(0, 0)), slope = covariance(0, 1) / covariance(0, 0);
  const double rest = std::sqrt(std::max(covariance(1, 1) - slope * covariance(0, 1), 0.0));
  adjoint_step_ = Eigen::MatrixXd::Zero(n, n);
  std::vector<double> weights(hidden);
  for (std::size_t i = 0; i < loads(); ++i)
    for (std::size_t j = 0; j < hidden; ++j) {
      const Eigen::Vector2d mean = transition_ * Eigen::Vector2d(load_.node(i) / rms_, states_[j]);
      const auto node = static_cast<Eigen::Index>(i * hidden + j);
      gaussian_points(mean[0], deviation, cuts, [&](double u, double weight) {
        std::ranges::fill(weights, 0.0);
        for (std::size_t q = 0; q < conditional.nodes.size(); ++q)
          in_state.add(mean[1] + slope * (u - mean[0]) + rest * conditional.nodes[q], conditional.weights[q],
                       weights.data());
        const Panels::Stencil at = load_.at(u * rms_);
        for (std::size_t k = 0; k <= load_.degree(); ++k)
          for (std::size_t l = 0; l < hidden; ++l)
            adjoint_step_(static_cast<Eigen::Index>((at.first + k) * hidden + l), node) +=
                weight * at.weights[k] * weights[l];
      });
    }
  for (Eigen::Index node = 0; node < n; ++node) adjoint_step_.col(node) /= adjoint_step_.col(node).sum();  // round-off

  stationary_ = Eigen::VectorXd::Zero(n);
  gaussian_points(0, 1, cuts, [&](double u, double weight) {
    const Panels::Stencil at = load_.at(u * rms_);
    for (std::size_t k = 0; k <= load_.degree(); ++k)
      for (std::size_t l = 0; l < hidden; ++l)
        stationary_[static_cast<Eigen::Index>((at.first + k) * hidden + l)] += weight * at.weights[k] * rule.weights[l];
  });
  stationary_ /= stationary_.sum();
}

void LoadGrid::below(double load, std::size_t i, std::vector<double>& probabilities) const {
  if (white()) {
    probabilities.assign(1, normal_cdf(load / deviation_));
    return;
  }
  probabilities.resize(hidden_);
  const double deviation = std::sqrt(1 - transition_.row(0).squaredNorm());
  for (std::size_t j = 0; j < hidden_; ++j) {
    const double mean = transition_.row(0).dot(Eigen::Vector2d(load_.node(i) / rms_, states_[j]));
    probabilities[j] = normal_cdf((load / rms_ - mean) / deviation);
  }
}

}  // namespace stickslip::detail
