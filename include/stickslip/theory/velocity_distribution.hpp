// The distribution of a velocity with an atom at rest.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "stickslip/base/requirements.hpp"

namespace stickslip::detail {

/// The distribution of a velocity at some of its values.
struct VelocityTable {
  std::vector<double> velocity{};  ///< ascending, 0 among them [m/s]; it lies beyond the ends with no probability
  std::vector<double> below{};     ///< the probability of less, without that of 0
  double atom = 0;                 ///< the probability of 0
};

}  // namespace stickslip::detail

namespace stickslip::theory {

/// The distribution of the velocity: an atom at 0, the probability of rest, and a density on either side. Between the
/// values of a table it is interpolated by monotone cubics (Steffen). Made by `TransportPrediction::velocity`.
///
/// Reference: M. Steffen, Astron. Astrophys. 239 (1990), 443-450.
class VelocityDistribution {
 public:
  /// @param error  of the probabilities, and of the atom
  VelocityDistribution(detail::VelocityTable table, double error, double atom_error, std::string remark = {});

  const std::string& remark() const noexcept { return remark_; }

  /// The probability of rest.
  double atom() const noexcept { return table_.atom; }

  /// Bounds on the numerical errors of the atom, and of probabilities away from rest.
  double atom_error() const noexcept { return atom_error_; }
  double error() const noexcept { return error_; }

  /// Velocities of the table, ascending [m/s].
  std::span<const double> velocity() const noexcept { return table_.velocity; }

  /// The probability that the velocity is at most v [m/s].
  /// @throws std::invalid_argument for NaN
  double cdf(double v) const;

  /// Density without the atom at v [s/m]; at 0 that of the positive side.
  /// @throws std::invalid_argument for NaN
  double density(double v) const;

  /// The smallest velocity that is not exceeded with the given probability [m/s]; exactly 0 within the atom.
  /// @param probability  above 0 and below 1
  /// @throws std::invalid_argument naming the value
  double quantile(double probability) const;

 private:
  struct Spline;

  detail::VelocityTable table_;
  double error_, atom_error_;
  std::string remark_;
  std::shared_ptr<const Spline> backward_, forward_;  // null without a velocity in that direction
};

}  // namespace stickslip::theory
