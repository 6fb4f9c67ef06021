// Gauss-Legendre quadrature.
#pragma once

#include <array>
#include <cstddef>

#include "stickslip/base/requirements.hpp"

namespace stickslip::numerics {

/// Nodes, in ascending order, and weights of the Gauss-Legendre rule on [0, 1], which is exact for polynomials up to
/// degree 2 points - 1. They are computed at compile time and are accurate to the last bit if `long double` has more
/// digits than `double`.
template <std::size_t points>
struct GaussLegendre {
  std::array<double, points> nodes{}, weights{};

  // Newton's method on the Legendre polynomial divided by the factors of the zeros already found decreases
  // monotonically to the next zero. One more Newton step uses the polynomial itself.
  constexpr GaussLegendre() {
    std::array<long double, points> zeros{};
    for (std::size_t i = 0; i < points; ++i) {
      long double x = 1, value = 0, slope = 0;
      const auto evaluate = [&] {
        long double before = 0;
        value = 1, slope = 0;
        for (std::size_t k = 1; k <= points; ++k) {
          const auto n = static_cast<long double>(k);
          const long double next = ((2 * n - 1) * x * value - (n - 1) * before) / n;
          slope = x * slope + n * value;
          before = value;
          value = next;
        }
      };
      for (int step = 0; step < 200; ++step) {
        evaluate();
        long double others = 0;
        for (std::size_t j = 0; j < i; ++j) others += 1 / (x - zeros[j]);
        const long double next = x - value / (slope - value * others);
        if (!(next < x)) break;
        x = next;
      }
      evaluate();
      x -= value / slope;
      evaluate();
      zeros[i] = x;
      nodes[points - 1 - i] = static_cast<double>((1 + x) / 2);
      weights[points - 1 - i] = static_cast<double>(1 / ((1 - x) * (1 + x) * slope * slope));
    }
  }
};

template <std::size_t points>
inline constexpr GaussLegendre<points> gauss_legendre{};

/// Calls use(x, weight) for each node of the rule on [from, to], in order from `from` to `to`.
template <std::size_t points, class Use>
constexpr void gauss_points(double from, double to, Use&& use) {
  const double length = to - from;
  for (std::size_t i = 0; i < points; ++i)
    use(from + length * gauss_legendre<points>.nodes[i], length * gauss_legendre<points>.weights[i]);
}

/// The integral of f from `from` to `to`.
template <std::size_t points, class F>
constexpr double gauss_integral(double from, double to, F&& f) {
  double sum = 0;
  gauss_points<points>(from, to, [&](double x, double weight) { sum += weight * f(x); });
  return sum;
}

}  // namespace stickslip::numerics
