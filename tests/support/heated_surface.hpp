// The temperature of a surface by a sum over all its history.
#pragma once

#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "stickslip/friction/kumar.hpp"

namespace test {

using namespace stickslip;

/// Temperature of a surface that was heated with q at even steps h [s], straight between them [W/m^2]: the
/// half-integral is exact for that.
inline double celsius(const KumarFriction::Parameters& p, const std::vector<double>& q, double h) {
  double sum = 0;
  const std::size_t last = q.size() - 1;
  for (std::size_t i = 0; i < last; ++i) {
    const double from = h * static_cast<double>(last - i), to = h * static_cast<double>(last - i - 1);  // ages
    const double ones = 2 * (std::sqrt(from) - std::sqrt(to));
    const double ages = 2.0 / 3 * (from * std::sqrt(from) - to * std::sqrt(to));
    sum += q[i + 1] * ones + (q[i] - q[i + 1]) * (ages - to * ones) / h;
  }
  return p.temperature + std::sqrt(p.diffusivity) / (p.conductivity * std::sqrt(std::numbers::pi)) * sum;
}

/// mu at a speed and a temperature, under the pressure of N = g.
inline double coefficient(const KumarFriction::Parameters& p, double speed, double t) {
  return p.mu_ref * std::pow(0.7, 0.02e-6 * (p.static_pressure - p.reference_pressure)) *
         (1 - 0.5 * std::exp(-p.rate * speed)) * 0.79 * (std::pow(0.7, 0.02 * t) + 0.4);
}

}  // namespace test
