// Expectations of a friction law, which make it linear.
#pragma once

#include <cmath>
#include <functional>
#include <numbers>
#include <optional>

#include "stickslip/theory/equivalent_linearization.hpp"

namespace stickslip::detail {

/// The linear equivalent of friction at one time, both values scaled like the slip level [m/s^2]:
struct Friction {
  double level;  ///< E[level(x) | x' = 0]: a22 = -sqrt(2 / pi) level / rms of x'
  double pull;   ///< a21 times the rms of x
};

/// As a function of the rms displacement [m], the correlation c of x and x', and s = sqrt(1 - c^2).
using Expectation = std::function<Friction(double displacement, double c, double s)>;

/// @param farthest  the law is evaluated from zero to this distance [m], to check it and to find its scale
/// @throws std::invalid_argument if the law is not symmetric in direction, is negative or not finite, or if the force
/// does not cover it
Expectation expectation(const LinearizedLaw& law, theory::EquivalentLinearization::Force force, double farthest);

/// The level far from x = 0 [m/s^2], if it is constant there: rolling resistance for a caster, for a law given as a
/// function the value at 5 and 10 times a distance.
/// @param distance  that the slider exceeds hardly ever [m]
std::optional<double> far_level(const LinearizedLaw& law, double distance);

/// Friction F = level(x) sgn(x') about the means of x and x': F = mean - a21 (x - E x) - a22 (x' - E x').
struct MeanFriction {
  double mean;  ///< E F [m/s^2]
  double a21;   ///< [1/s^2]
  double a22;   ///< [1/s]
};

/// A law's expectations with means, for any state of the covariance.
class AverageFriction {
 public:
  /// As `expectation`; Coulomb friction may have unequal levels.
  AverageFriction(const LinearizedLaw& law, theory::EquivalentLinearization::Force force, double farthest);

  /// Whether there is no friction.
  bool none() const noexcept { return none_; }

  /// Whether the levels differ, so that the slider drifts.
  bool drifts() const noexcept { return forward_ != backward_; }

  /// The level at x = 0, the mean of both ways [m/s^2].
  double level() const noexcept { return (forward_ + backward_) / 2; }

  /// The maximum of friction times the rms velocity, -a22 sqrt(q22), for equal levels at x = 0, relative to the level.
  double strength() const noexcept { return laplace_ ? std::numbers::sqrt2 / 2 : std::sqrt(2 / std::numbers::pi); }

  /// The rms of the other forces below which linearized friction holds the slider at x = 0 [m/s^2]. Without a spring a
  /// slider of unequal levels moves with the mean velocity at which the mean friction vanishes.
  double threshold(bool spring) const;

  /// @param velocity  mean of x' [m/s]; the mean of x does not matter, because only constant levels may differ
  /// @param q22       positive; q11 >= 0
  MeanFriction operator()(double velocity, double q11, double q12, double q22) const;

 private:
  Expectation expectation_;  // of a law of position
  double forward_, backward_;
  bool none_, laplace_;
};

/// z exp(z^2) erfc(z) for z >= 0, from 0 to 1 / sqrt(pi).
double scaled_erfc(double z);

}  // namespace stickslip::detail
