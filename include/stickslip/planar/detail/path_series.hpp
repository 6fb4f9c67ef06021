// The power series of a slip in the plane.
#pragma once

#include <cmath>
#include <limits>

#include "stickslip/base/min_max.hpp"
#include "stickslip/base/vector2.hpp"
#include "stickslip/planar/detail/held_slip.hpp"

namespace stickslip::detail {

/// Power series of a slip in the plane in a parameter, which is time or regularized time. Those of time, place, velocity
/// and path length have one more coefficient than `order`, which is zero.
struct PathSeries {
  static constexpr int highest_order = 28;
  static constexpr double round_off = std::numeric_limits<double>::epsilon() / 4;
  using Array = double[highest_order + 2];

  Array t;       ///< time since the start [s]
  Array u;       ///< speed [m/s]
  Array x, y;    ///< displacement since the start [m]
  Array vx, vy;  ///< velocity [m/s]
  Array s;       ///< path length since the start [m]
  Array l;       ///< level times weight [m/s^2], of order 0 to `order` - 1
  int order = 0;

  void end(int last) noexcept {
    order = last;
    for (double* c : {t, x, y, s, u, vx, vy}) c[order + 1] = 0;
  }

  /// Sum of c_k z^k from k = 1.
  double value(const double* c, double z) const noexcept {
    double odd = 0, even = 0;
    const double square = z * z;
    for (int k = order | 1; k >= 1; k -= 2) odd = odd * square + c[k];
    for (int k = order & ~1; k >= 2; k -= 2) even = even * square + c[k];
    return z * odd + square * even;
  }
  /// Its derivative.
  double slope(const double* c, double z) const noexcept {
    double sum = 0;
    for (int k = order; k >= 1; --k) sum = sum * z + k * c[k];
    return sum;
  }
  double level(double z) const noexcept {
    double sum = 0;
    for (int k = order - 1; k >= 0; --k) sum = sum * z + l[k];
    return sum;
  }

  PlanarProgress at(double z) const noexcept {
    return {value(t, z), {value(x, z), value(y, z)}, {vx[0] + value(vx, z), vy[0] + value(vy, z)}, value(s, z)};
  }

  /// The parameter at a time before that at the parameter `last`.
  /// @param whole  the time at `last` [s]
  double parameter(double time, double last, double whole) const noexcept {
    double low = 0, high = last, z = last * (time / whole);
    for (int steps = 0; steps < 64; ++steps) {
      double sum = 0, slope = 0;
      for (int k = order; k >= 1; --k) slope = slope * z + sum, sum = sum * z + t[k];
      slope = slope * z + sum;
      sum = sum * z - time;
      (sum < 0 ? low : high) = z;
      double next = z - sum / slope;
      if (std::abs(next - z) <= 0x1p-52 * z) return next;
      if (!(next > low && next < high)) next = low + (high - low) / 2;
      if (next <= low || next >= high) return z;
      z = next;
    }
    return z;
  }

  /// |r|^2 less its value at the start is a polynomial of twice the order, whose terms beyond the longest series are
  /// round-off. Its degree, and its coefficient k; `terms` receives the sum of the magnitudes of what it consists of.
  int square_degree() const noexcept { return std::min(2 * order, highest_order); }
  double square_of_distance(Vector2 place, int k, double& terms) const noexcept {
    double square = 0;
    const auto add = [&](double part) { square += part, terms += std::abs(part); };
    if (k <= order) add(2 * place.axis * x[k]), add(2 * place.transverse * y[k]);
    for (int i = std::max(1, k - order); i < k && i <= order; ++i) add(x[i] * x[k - i]), add(y[i] * y[k - i]);
    return square;
  }
};

}  // namespace stickslip::detail
