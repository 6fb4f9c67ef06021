#pragma once

#include <cmath>

#include "stickslip/ground/ground_motion.hpp"

namespace stickslip::detail {

/// What interpolation between samples multiplies the Fourier amplitude at omega by; u = omega dt / 2. Corrects thesis
/// (4.57), (4.58).
inline double interpolation_loss(Interpolation interpolation, double u) {
  const double sinc = u == 0 ? 1 : std::sin(u) / u;
  return interpolation == Interpolation::linear ? sinc * sinc : sinc;
}

}  // namespace stickslip::detail
