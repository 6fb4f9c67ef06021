// Distributions of random parameters.
#pragma once

#include <limits>
#include <string>
#include <variant>

#include "stickslip/base/requirements.hpp"

namespace stickslip {

/// Lognormal distribution: median * exp(beta Z) with a standard normal Z.
class Lognormal {
 public:
  /// @param median  positive and finite
  /// @param beta    standard deviation of the logarithm, finite and at least 0
  /// @throws std::invalid_argument naming the value
  Lognormal(double median, double beta);

  double median() const noexcept { return median_; }
  double beta() const noexcept { return beta_; }

  /// The quantile of a probability in (0, 1).
  double quantile(double probability) const;

 private:
  double median_, beta_;
};

/// A normal distribution truncated at bounds.
class Normal {
 public:
  /// @param mean, std  of the distribution without bounds; finite, std at least 0
  /// @param low, high  bounds, low < high; they must leave some probability
  /// @throws std::invalid_argument naming the value
  Normal(double mean, double std, double low = -std::numeric_limits<double>::infinity(),
         double high = std::numeric_limits<double>::infinity());

  double mean() const noexcept { return mean_; }
  double std() const noexcept { return std_; }
  double low() const noexcept { return low_; }
  double high() const noexcept { return high_; }

  /// The quantile of a probability in (0, 1).
  double quantile(double probability) const;

 private:
  double mean_, std_, low_, high_;
};

/// Uniform distribution between two bounds.
class Uniform {
 public:
  /// @param low, high  finite, low <= high
  /// @throws std::invalid_argument naming the value
  Uniform(double low, double high);

  double low() const noexcept { return low_; }
  double high() const noexcept { return high_; }

  /// The quantile of a probability in (0, 1).
  double quantile(double probability) const;

 private:
  double low_, high_;
};

/// The distribution of a parameter; a number is a constant.
using Distribution = std::variant<double, Lognormal, Normal, Uniform>;

/// The quantile of a probability.
/// @param probability  in (0, 1)
/// @throws std::invalid_argument naming the value
double quantile(const Distribution& distribution, double probability);

namespace detail {
/// As JSON.
std::string describe(const Distribution& distribution);
}  // namespace detail

}  // namespace stickslip
