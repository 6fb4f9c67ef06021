// The ground acceleration of the transport operator: filtered noise on a grid, or white noise, held over each step.
#pragma once

#include <Eigen/Dense>
#include <cstddef>
#include <functional>
#include <vector>

#include "stickslip/theory/shaping_filter.hpp"
#include "theory/transport/panels.hpp"

namespace stickslip::detail {

/// How far from its mean a Gaussian variable is integrated over, in deviations: a probability below 1e-16 lies beyond.
inline constexpr double gaussian_reach = 8.3;

/// Calls `use(x, weight)` at the nodes of a Gauss-Legendre rule for the mean of a function of a Gaussian variable. The
/// function must be smooth between the `cuts`.
void gaussian_points(double mean, double deviation, std::vector<double> cuts,
                     const std::function<void(double, double)>& use);

/// Stationary noise from a filter of two states, n = b1 y' + b0 y, y'' + d1 y' + d0 y = white noise, in coordinates
/// of unit variance that are independent of each other at each time: u = n / rms and m, du = rate u dt + white noise.
struct FilterStates {
  double rms;            ///< of the ground acceleration [m/s^2]
  double frequency;      ///< sqrt(d0) [rad/s]
  double roughness;      ///< rms change of the ground acceleration over a short time, over its root [m/s^2.5]
  Eigen::Matrix2d rate;  ///< [1/s]

  /// @param filter  one section, with b2 = 0
  explicit FilterStates(const theory::ShapingFilter& filter);

  /// E: the mean of u after a step, from u at its beginning, is E u, and its covariance is 1 - E E^T.
  Eigen::Matrix2d transition(double step) const;
};

/// Functions of the state of the noise at the middle of a step, by their values at nodes; those of a filter are
/// `load` times Gauss-Hermite nodes of the hidden state m, in which functions are polynomials. Node (i, j) has the
/// index i hidden() + j.
class LoadGrid {
 public:
  static constexpr std::size_t max_hidden = 24;

  /// Filtered noise.
  /// @param load    panels in the ground acceleration n [m/s^2]; functions are constant beyond the ends
  /// @param hidden  number of nodes of the hidden state, at most `max_hidden`
  /// @param step    [s]
  LoadGrid(const FilterStates& noise, Panels load, std::size_t hidden, double step);

  /// White noise: independent in each step, with rms `deviation` [m/s^2]. It has no state.
  explicit LoadGrid(double deviation);

  bool white() const noexcept { return deviation_ > 0; }
  double deviation() const noexcept { return deviation_; }
  std::size_t loads() const noexcept { return load_.size(); }
  std::size_t hidden() const noexcept { return hidden_; }
  std::size_t size() const noexcept { return loads() * hidden(); }
  double load(std::size_t i) const noexcept { return load_.node(i); }

  /// Z', which carries weights of nodes over a step; (Z f)(node) = sum of adjoint_step()(other, node) f(other) is the
  /// mean of a function a step later.
  const Eigen::MatrixXd& adjoint_step() const noexcept { return adjoint_step_; }

  /// The mean of a function over the stationary noise is its product with these.
  const Eigen::VectorXd& stationary() const noexcept { return stationary_; }

  /// P(n <= load) a step after node (i, j), which `probabilities` receives for all j.
  void below(double load, std::size_t i, std::vector<double>& probabilities) const;

 private:
  Panels load_;
  std::size_t hidden_ = 1;
  double deviation_ = 0, rms_ = 0;
  Eigen::Matrix2d transition_ = Eigen::Matrix2d::Zero();
  std::vector<double> states_{0};  // the nodes of m
  Eigen::MatrixXd adjoint_step_ = Eigen::MatrixXd::Ones(1, 1);
  Eigen::VectorXd stationary_ = Eigen::VectorXd::Ones(1);
};

}  // namespace stickslip::detail
