#include "theory/transport/load_grid.hpp"

#include <gsl/gsl_integration.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <new>
#include <numbers>
#include <numeric>
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

LoadGrid::LoadGrid(const pulse_chain::Weights& batch, double none, std::size_t slots,
                   const std::optional<pulse_chain::Weights>& past_batch)
    : spacing_(batch.spacing) {
  // A state is a number whose digits are the last batches, newest first: amplitudes from the least on, or `empty`.
  // After a step under the load n the amplitude of the batch that has gone is `sum - n`, where `sum` is the load
  // without it: sorted by it, the states after a step under n are an interval.
  const int reach = batch.reach, empty = 2 * reach + 1, past = 2 * static_cast<int>(slots) - 1;
  const auto base = static_cast<std::size_t>(empty + 1);
  const auto amplitude = [&](int batch_is) { return batch_is == empty ? 0 : batch_is - reach; };
  const auto chance = [&](int batch_is) { return batch_is == empty ? none : batch[batch_is - reach]; };
  std::size_t count = 1;
  for (int i = 0; i < past; ++i) count *= base;
  std::vector<int> sums(count), newest(count);
  std::vector<std::size_t> opposite(count);
  std::vector<double> chances(count, 1);  // of the start
  for (std::size_t code = 0; code < count; ++code) {
    std::size_t left = code, digit = 1;
    for (int i = past - 1; i >= 0; --i, left /= base, digit *= base) {
      const int is = static_cast<int>(left % base);
      sums[code] += i < static_cast<int>(slots) ? amplitude(is) : -amplitude(is);
      if (past_batch) chances[code] *= is == empty ? none : (*past_batch)[is - reach];
      newest[code] = is;
      opposite[code] += digit * static_cast<std::size_t>(is == empty ? empty : 2 * reach - is);
    }
  }
  std::vector<std::size_t> order(count), rank(count);
  std::iota(order.begin(), order.end(), 0U);
  std::ranges::stable_sort(order, {}, [&](std::size_t code) { return sums[code]; });
  for (std::size_t k = 0; k < count; ++k) rank[order[k]] = k;
  mirror_.resize(count);
  for (std::size_t code = 0; code < count; ++code) mirror_[rank[code]] = rank[opposite[code]];

  const std::size_t calm = count - 1;  // all batches are empty
  const int most = 2 * static_cast<int>(slots) * reach;
  loads_.clear();
  for (int n = -most; n <= most; ++n) {
    const auto sum = [&](std::size_t code) { return sums[code]; };
    const auto first = std::ranges::lower_bound(order, n - reach, {}, sum);
    const auto last = std::ranges::upper_bound(order, n + reach, {}, sum);
    loads_.push_back({n * spacing_,
                      {static_cast<std::size_t>(first - order.begin()), static_cast<std::size_t>(last - first)},
                      static_cast<std::size_t>(most - n),
                      true});
    std::vector<Move>& moves = moves_.emplace_back();
    for (auto at = first; at != last; ++at) {
      const auto from = [&](int gone) {
        const std::size_t before = *at % (count / base) * base + static_cast<std::size_t>(gone);
        moves.push_back(
            {static_cast<std::uint32_t>(rank[before]), static_cast<std::uint32_t>(at - first), chance(newest[*at])});
      };
      from(sums[*at] - n + reach);
      if (sums[*at] == n && *at != calm) from(empty);
    }
  }
  loads_.push_back({0, {rank[calm], 1}, loads_.size()});
  moves_.push_back({{static_cast<std::uint32_t>(rank[calm]), 0, none}});
  start_ = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(count));
  if (!past_batch)
    start_[static_cast<Eigen::Index>(rank[calm])] = 1;
  else
    for (std::size_t code = 0; code < count; ++code) start_[static_cast<Eigen::Index>(rank[code])] = chances[code];
}

namespace {

/// Nodes on each side of a point, from which Lagrange's polynomial interpolates there.
constexpr int lagrange_side = 3;

/// The weight of the node at 0 in the interpolation at u, with nodes at the integers.
double cardinal(double u) {
  const int cell = static_cast<int>(std::floor(std::abs(u)));
  if (cell >= lagrange_side) return 0;
  double value = 1;
  for (int k = cell + 1 - lagrange_side; k <= cell + lagrange_side; ++k)
    if (k != 0) value *= (k - std::abs(u)) / k;
  return value;
}

}  // namespace

double LoadGrid::reach(std::size_t i) const noexcept {
  return white() ? gaussian_reach * deviation_ : loads_[i].spread ? lagrange_side * spacing_ : 0;
}

void LoadGrid::average(std::size_t i, const std::vector<double>& corners,
                       const std::function<void(double, double)>& use) const {
  const double load = loads_[i].value;
  if (white()) {
    std::vector<std::array<double, 2>> points;
    double sum = 0;
    gaussian_points(0, deviation_, corners, [&](double n, double weight) {
      points.push_back({n, weight});
      sum += weight;
    });
    for (const auto& [n, weight] : points) use(n, weight / sum);
  } else if (!loads_[i].spread || corners.empty()) {
    use(load, 1);
  } else {
    std::vector<double> edges(corners);
    for (int k = -lagrange_side; k <= lagrange_side; ++k) edges.push_back(load + k * spacing_);
    std::ranges::sort(edges);
    for (std::size_t k = 1; k < edges.size(); ++k)
      numerics::gauss_points<5>(edges[k - 1], edges[k], [&](double n, double width) {
        if (width > 0) use(n, width / spacing_ * cardinal((n - load) / spacing_));
      });
  }
}

std::size_t LoadGrid::largest_share() const noexcept {
  std::size_t most = 0;
  for (const Load& load : loads_) most = std::max(most, load.share.count);
  return most;
}

void LoadGrid::give(std::size_t i, const double* weights, double* given) const noexcept {
  const auto [first, count] = share(i);
  if (!pulses()) {
    std::copy_n(weights + first, count, given);
    return;
  }
  std::fill_n(given, count, 0.0);
  for (const auto& [from, to, chance] : moves_[i]) given[to] += chance * weights[from];
}

double LoadGrid::weight(std::size_t i, const double* weights) const noexcept {
  const auto [first, count] = share(i);
  double sum = 0;
  if (!pulses())
    for (std::size_t k = 0; k < count; ++k) sum += weights[first + k];
  else
    for (const auto& [from, to, chance] : moves_[i]) sum += chance * weights[from];
  return sum;
}

LoadGrid::LoadGrid(const FilterStates& noise, Panels load, std::size_t hidden, double step)
    : rms_(noise.rms), transition_(noise.transition(step)) {
  const HermiteRule rule(hidden), conditional((hidden + 2) / 2);
  hidden_ = rule.nodes;
  const Interpolation in_state(hidden_);
  std::vector<double> cuts = load.edges();
  for (double& cut : cuts) cut /= rms_;
  loads_.clear(), mirror_.clear();
  for (std::size_t i = 0; i < load.size(); ++i)
    loads_.push_back({load.node(i), {i * hidden, hidden}, load.size() - 1 - i});
  for (std::size_t k = load.size() * hidden; k > 0; --k) mirror_.push_back(k - 1);
  const auto n = static_cast<Eigen::Index>(load.size() * hidden);

  // The mean over u = n / rms by quadrature between the edges of its panels, that over m given u by Gauss-Hermite.
  const Eigen::Matrix2d covariance = Eigen::Matrix2d::Identity() - transition_ * transition_.transpose();
  const double deviation = std::sqrt(covariance(0, 0)), slope = covariance(0, 1) / covariance(0, 0);
  const double rest = std::sqrt(std::max(covariance(1, 1) - slope * covariance(0, 1), 0.0));
  Eigen::MatrixXd& adjoint_step = adjoint_step_.emplace(Eigen::MatrixXd::Zero(n, n));
  std::vector<double> weights(hidden);
  for (std::size_t i = 0; i < load.size(); ++i)
    for (std::size_t j = 0; j < hidden; ++j) {
      const Eigen::Vector2d mean = transition_ * Eigen::Vector2d(load.node(i) / rms_, hidden_[j]);
      const auto node = static_cast<Eigen::Index>(i * hidden + j);
      gaussian_points(mean[0], deviation, cuts, [&](double u, double weight) {
        std::ranges::fill(weights, 0.0);
        for (std::size_t q = 0; q < conditional.nodes.size(); ++q)
          in_state.add(mean[1] + slope * (u - mean[0]) + rest * conditional.nodes[q], conditional.weights[q],
                       weights.data());
        const Panels::Stencil at = load.at(u * rms_);
        for (std::size_t k = 0; k <= load.degree(); ++k)
          for (std::size_t l = 0; l < hidden; ++l)
            adjoint_step(static_cast<Eigen::Index>((at.first + k) * hidden + l), node) +=
                weight * at.weights[k] * weights[l];
      });
    }
  for (Eigen::Index node = 0; node < n; ++node) adjoint_step.col(node) /= adjoint_step.col(node).sum();  // round-off

  start_ = Eigen::VectorXd::Zero(n);
  gaussian_points(0, 1, cuts, [&](double u, double weight) {
    const Panels::Stencil at = load.at(u * rms_);
    for (std::size_t k = 0; k <= load.degree(); ++k)
      for (std::size_t l = 0; l < hidden; ++l)
        start_[static_cast<Eigen::Index>((at.first + k) * hidden + l)] += weight * at.weights[k] * rule.weights[l];
  });
  start_ /= start_.sum();
}

void LoadGrid::below(double load, std::size_t i, std::vector<double>& probabilities) const {
  if (white()) {
    probabilities.assign(1, normal_cdf(load / deviation_));
    return;
  }
  probabilities.resize(hidden_.size());
  const double deviation = std::sqrt(1 - transition_.row(0).squaredNorm());
  for (std::size_t j = 0; j < hidden_.size(); ++j) {
    const double mean = transition_.row(0).dot(Eigen::Vector2d(loads_[i].value / rms_, hidden_[j]));
    probabilities[j] = normal_cdf((load / rms_ - mean) / deviation);
  }
}

}  // namespace stickslip::detail
