// Ordinary differential equations, by SUNDIALS: CVODE and ARKODE.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "stickslip/base/error.hpp"

namespace stickslip::detail {

/// Writes dy/dt into `slope`, which has the size of `y`.
using OdeRightSide = std::function<void(double t, std::span<const double> y, std::span<double> slope)>;

enum class OdeMethod {
  /// Adams' formulas of orders up to 12 with fixed-point iteration: one or two slopes per step. For slopes that cost
  /// more than the overhead, some 0.5 us, and for tight tolerances.
  adams,
  /// Backward differentiation and Newton iteration on a dense finite-difference Jacobian, for components that decay far
  /// faster than the spacing of the output times.
  bdf,
  /// Dormand and Prince's explicit pair of orders 5 and 4: six slopes per step, but half the time for slopes that cost
  /// less than that and for tolerances of 1e-10 and above. Where stability limits the steps, they are three times as
  /// long as those of Adams' formulas. A slope that is not finite ends the integration.
  runge_kutta
};

struct OdeOptions {
  double relative_tolerance = 1e-10;
  /// One per component, or one for all. Zero is allowed for components that are never zero.
  std::vector<double> absolute_tolerance = {0};
  OdeMethod method = OdeMethod::adams;
  long max_steps = 1'000'000;
  std::function<void()> progress{};  ///< called every thousand steps; may throw to stop the work; optional
};

/// The solver failed; for callers whose `t` is not the time that users see.
struct OdeFailure : ConvergenceError {
  OdeFailure(double at, double last, const std::string& reason)
      : ConvergenceError("solve_ode: reached t = " + shortest(at) + " of " + shortest(last) + ": " + reason),
        reached(at),
        why(reason) {}

  double reached;
  std::string why;
};

struct OdeSolution {
  std::size_t dimension;
  std::vector<double> states;  ///< time by time
  long steps = 0, evaluations = 0;

  std::span<const double> at(std::size_t time) const { return std::span(states).subspan(time * dimension, dimension); }
};

/// Computes y(t) at `times`, from y(t0) = `y0`. Local errors are kept within the tolerances; the error at a time is
/// some ten times that. Exceptions from `right_side` or the progress callback propagate; where a slope is not finite, a
/// shorter step is tried.
/// @param times  increasing, from t0 on
/// @throws std::invalid_argument if times, sizes or tolerances are invalid
/// @throws OdeFailure, a ConvergenceError with the time reached, if the solver fails
OdeSolution solve_ode(const OdeRightSide& right_side, double t0, std::span<const double> y0,
                      std::span<const double> times, const OdeOptions& options = {});

}  // namespace stickslip::detail
