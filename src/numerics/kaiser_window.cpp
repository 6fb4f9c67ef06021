#include "numerics/kaiser_window.hpp"

#include <gsl/gsl_sf_bessel.h>

#include <cmath>

namespace stickslip::detail {

std::vector<double> kaiser_window(std::size_t samples, double beta) {
  std::vector<double> window(samples);
  const auto half = static_cast<double>(samples) / 2;
  double squares = 0;
  for (std::size_t i = 0; i < samples; ++i) {
    const double from_middle = samples == 1 ? 0 : (static_cast<double>(i) - half) / half;
    window[i] = gsl_sf_bessel_I0(beta * std::sqrt(1 - from_middle * from_middle));
    squares += window[i] * window[i];
  }
  for (double& w : window) w *= std::sqrt(static_cast<double>(samples) / squares);
  return window;
}

}  // namespace stickslip::detail
