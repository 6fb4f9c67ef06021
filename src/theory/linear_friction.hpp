// Gaussian expectations of a friction law, which make it linear.
#pragma once

#include <functional>

#include "stickslip/theory/equivalent_linearization.hpp"

namespace stickslip::detail {

/// What stands for friction at one time, both of the size of the slip level [m/s^2]:
struct Friction {
  double level;  ///< E[level(x) | x' = 0]: a22 = -sqrt(2 / pi) level / rms of x'
  double pull;   ///< a21 times the rms of x
};

/// By the rms displacement [m], the correlation c of x and x', and s = sqrt(1 - c^2).
using Expectation = std::function<Friction(double displacement, double c, double s)>;

/// @param farthest  the law is looked at from zero to this distance [m], to check it and to find its scale
/// @throws std::invalid_argument where the law is not the same both ways, is negative or not finite, or where the
/// force does not cover it
Expectation expectation(const LinearizedLaw& law, theory::EquivalentLinearization::Force force, double farthest);

/// z exp(z^2) erfc(z) for z >= 0, from 0 to 1 / sqrt(pi).
double scaled_erfc(double z);

}  // namespace stickslip::detail
