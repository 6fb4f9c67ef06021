// The covariance of a linearized slider and its shaping filter, n states: in time and stationary.
#pragma once

#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "stickslip/theory/equivalent_linearization.hpp"

namespace stickslip::detail {

/// Moments of x and x'.
struct ShapedState {
  double displacement_mean = 0, velocity_mean = 0, q11 = 0, q12 = 0, q22 = 0;
  /// Rms acceleration of the ground, or demand on the interface of a structure without its spring, over that below
  /// which linearized friction holds the slider; infinite at rest at time 0, under white noise and without friction.
  double motion_ratio = std::numeric_limits<double>::infinity();
};

struct ShapedSolution {
  std::vector<ShapedState> state;  ///< by time
  long steps = 0, evaluations = 0;
};

/// The stationary solution.
struct StationaryState {
  ShapedState state;       ///< q11 infinite, or NaN, without a spring
  double growth_rate = 0;  ///< of q11 [m^2/s]
};

struct ModalInterface;

struct ShapedProblem {
  const LinearizedLaw& law;
  double natural_frequency, damping;
  const theory::ShapedNoise& noise;
  const theory::ShapingFilter& filter;
  const theory::EquivalentLinearization::Options& options;
  /// The structure whose interface slides, with spring and damper as above; null for a slider.
  const ModalInterface* structure = nullptr;

  /// Largest number of modes of a structure: the covariances of all states are integrated together.
  static constexpr int most_modes = 12;
};

/// @throws ConvergenceError with the time reached
ShapedSolution solve_shaped(const ShapedProblem& problem, std::span<const double> times,
                            const std::function<void()>& progress = {});

/// @throws std::invalid_argument where the velocity has no stationary solution, with the reason
StationaryState solve_stationary(const ShapedProblem& problem);

/// The growth rate of q11 [m^2/s] that a slider from rest approaches, NaN if it is not known: that of
/// `solve_stationary`, or without a spring that of the level far away, once the slider is there.
/// @param last  up to which time it is known how far the slider moves [s]
/// @throws as solve_stationary
double late_growth(const ShapedProblem& problem, double last);

/// Ratio of the rms ground acceleration, or of the demand on a stuck interface of a structure, at the maximum of the
/// envelope, to that below which equivalent linearization predicts no motion; infinite for white noise and without
/// friction.
double motion_ratio(const ShapedProblem& problem);

}  // namespace stickslip::detail
