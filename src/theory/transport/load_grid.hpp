// The ground acceleration of the transport operator, held over each step: filtered noise on a grid, white noise, or
// pulses on a lattice.
#pragma once

#include <Eigen/Dense>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "stickslip/theory/shaping_filter.hpp"
#include "theory/pulse_chain/lattice.hpp"
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

/// The loads of a step, and the states of the ground between steps, by which functions have values. The nodes of an
/// interval of states, the `Share` of a load, receive the weights that a step under it carries on.
///
/// Filtered noise: its state at the middle of a step, at `load` times Gauss-Hermite nodes of the hidden state m, in
/// which functions are polynomials. White noise: none.
///
/// Pulses: the last batches of pulses, each either empty or on a lattice of amplitudes. Of m slots to a half width, the
/// load is s_0 + ... + s_(m-1) - s_m - ... - s_(2m-1), with s_0 the batch that begins with the step;
/// docs/pulse_chain.md. The load has a density, which is smooth, unless all batches are empty.
class LoadGrid {
 public:
  /// Filtered noise.
  /// @param load    panels in the ground acceleration n [m/s^2]; functions are constant beyond the ends
  /// @param hidden  number of nodes of the hidden state
  /// @param step    [s]
  LoadGrid(const FilterStates& noise, Panels load, std::size_t hidden, double step);

  /// White noise: independent in each step, with rms `deviation` [m/s^2].
  explicit LoadGrid(double deviation);

  /// Pulses of two equal steps, up and down.
  /// @param batch  weights of the sums of the amplitudes that begin with a step, if any do [m/s^2]
  /// @param none   probability that none does
  /// @param slots  steps to a half width
  /// @param past   as `batch`, of those that began before the start; none did if it is empty
  LoadGrid(const pulse_chain::Weights& batch, double none, std::size_t slots,
           const std::optional<pulse_chain::Weights>& past);

  bool white() const noexcept { return deviation_ > 0; }
  bool pulses() const noexcept { return spacing_ > 0; }

  std::size_t loads() const noexcept { return loads_.size(); }
  double load(std::size_t i) const noexcept { return loads_[i].value; }

  /// How far the loads are for which this one stands.
  double reach(std::size_t i) const noexcept;

  /// Calls `use(load, weight)` so that the weighted sum of a function is its mean over the loads for which this one
  /// stands: white noise, or on the lattice of pulses those under the function of the node in Lagrange's interpolation
  /// of the density.
  /// @param corners  of the function, within the reach
  void average(std::size_t i, const std::vector<double>& corners, const std::function<void(double, double)>& use) const;

  /// Number of states.
  std::size_t size() const noexcept { return static_cast<std::size_t>(start_.size()); }

  struct Share {
    std::size_t first, count;
  };
  Share share(std::size_t i) const noexcept { return loads_[i].share; }
  std::size_t largest_share() const noexcept;

  /// The opposite of a load, and in its share the mirror image of a state of the share, by the place in it.
  std::size_t mirrored(std::size_t i) const noexcept { return loads_[i].mirrored; }
  std::size_t mirror(std::size_t i, std::size_t place) const noexcept {
    return mirror_[share(i).first + place] - share(mirrored(i)).first;
  }

  /// The weights of the states of the share of a load, from those of all states.
  void give(std::size_t i, const double* weights, double* given) const noexcept;

  /// Their sum.
  double weight(std::size_t i, const double* weights) const noexcept;

  /// Z' of filtered noise, which carries weights of states over a step after S; (Z f)(node) = sum of
  /// adjoint_step()(other, node) f(other) is the mean of a function a step later.
  const std::optional<Eigen::MatrixXd>& adjoint_step() const noexcept { return adjoint_step_; }

  /// The weights of the states at the start.
  const Eigen::VectorXd& start() const noexcept { return start_; }

  /// Of noise: P(n <= load) a step after a state of the share of load i, which `probabilities` receives for all.
  void below(double load, std::size_t i, std::vector<double>& probabilities) const;

 private:
  struct Load {
    double value;
    Share share;
    std::size_t mirrored;
    bool spread = false;  // whether it stands for loads around it
  };
  struct Move {
    std::uint32_t from, to;  // states; the place in the share
    double chance;
  };

  std::vector<Load> loads_{{0, {0, 1}, 0}};
  std::vector<std::size_t> mirror_{0};  // of each state
  Eigen::VectorXd start_ = Eigen::VectorXd::Ones(1);
  double deviation_ = 0, rms_ = 0, spacing_ = 0;
  Eigen::Matrix2d transition_ = Eigen::Matrix2d::Zero();
  std::vector<double> hidden_{0};  // the nodes of m
  std::optional<Eigen::MatrixXd> adjoint_step_{};
  std::vector<std::vector<Move>> moves_{};  // of pulses, to the share of each load
};

}  // namespace stickslip::detail
