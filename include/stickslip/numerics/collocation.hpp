// Polynomials through values at Chebyshev points.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "stickslip/base/min_max.hpp"
#include "stickslip/numerics/gauss_legendre.hpp"

namespace stickslip::numerics {

/// Polynomials on [0, 1] of the given degree, each represented by its values at the extrema of the Chebyshev
/// polynomial, which include both ends.
template <int degree>
class Collocation {
 public:
  static constexpr std::size_t points = degree + 1;
  using Values = std::array<double, points>;
  using Matrix = std::array<Values, points>;

  Values nodes{};            ///< t_i, ascending from 0 to 1
  Matrix integral{};         ///< [i][k]: integral of the k-th basis polynomial from 0 to t_i
  Matrix double_integral{};  ///< integral of (t_i - t) times that polynomial from 0 to t_i
  Matrix half_integral{};    ///< integral of that polynomial divided by sqrt(t_i - t) from 0 to t_i

  static const Collocation& get() noexcept {
    static const Collocation made;
    return made;
  }

  /// The values of f(t) at the nodes.
  template <class F>
  Values at_nodes(F&& f) const {
    Values values;
    for (std::size_t i = 0; i < points; ++i) values[i] = f(nodes[i]);
    return values;
  }

  /// Coefficients in the Chebyshev polynomials of 2 t - 1.
  Values chebyshev(const Values& values) const noexcept {
    Values c{};
    for (int j = 0; j <= degree; ++j)
      for (int i = 0; i <= degree; ++i) c[at(j)] += transform_[at(j)][at(i)] * values[at(i)];
    return c;
  }

  /// Coefficients of powers of t from those of Chebyshev polynomials. The last coefficients are dropped as long as the
  /// sum of their magnitudes is at most `noise`, because the conversion to powers would amplify them.
  /// @return the degree of the result
  static int powers(const Values& chebyshev, double noise, Values& result) noexcept {
    int last = degree;
    for (double dropped = 0; last > 0; --last) {
      dropped += std::abs(chebyshev[at(last)]);
      if (dropped > noise) break;
    }
    result = {};
    const Matrix& powers = get().powers_;
    for (int j = 0; j <= last; ++j)
      for (int k = 0; k <= j; ++k) result[at(k)] += chebyshev[at(j)] * powers[at(j)][at(k)];
    return last;
  }

 private:
  static constexpr std::size_t at(int i) noexcept { return static_cast<std::size_t>(i); }

  Collocation() noexcept {
    for (int i = 0; i <= degree; ++i) {
      const double s = std::sin(std::numbers::pi * i / (2 * degree));
      nodes[at(i)] = s * s;
    }
    for (int j = 0; j <= degree; ++j)
      for (int i = 0; i <= degree; ++i) {
        const double ends = (i == 0 || i == degree ? 2 : 1) * (j == 0 || j == degree ? 2 : 1);
        transform_[at(j)][at(i)] =
            2 / (ends * degree) * std::cos(std::numbers::pi * ((j * (degree - i)) % (2 * degree)) / degree);
      }
    powers_[0][0] = 1;
    for (int j = 0; j < degree; ++j)
      for (int k = 0; k <= j + 1; ++k) {
        const double here = (k > 0 ? 2 * powers_[at(j)][at(k - 1)] : 0) - powers_[at(j)][at(k)];
        powers_[at(j + 1)][at(k)] = j == 0 ? here : 2 * here - powers_[at(j - 1)][at(k)];
      }
    const auto basis = [&](int k, double t) {
      double product = 1;
      for (int m = 0; m <= degree; ++m)
        if (m != k) product *= (t - nodes[at(m)]) / (nodes[at(k)] - nodes[at(m)]);
      return product;
    };
    for (int i = 0; i <= degree; ++i)
      for (int k = 0; k <= degree; ++k) {
        const double end = nodes[at(i)], root = std::sqrt(end);
        constexpr std::size_t rule = degree + 1;
        integral[at(i)][at(k)] = gauss_integral<rule>(0, end, [&](double t) { return basis(k, t); });
        double_integral[at(i)][at(k)] = gauss_integral<rule>(0, end, [&](double t) { return (end - t) * basis(k, t); });
        half_integral[at(i)][at(k)] =
            gauss_integral<rule>(0, root, [&](double r) { return 2 * basis(k, end - r * r); });
      }
  }

  Matrix transform_{};
  Matrix powers_{};  // [j][k]: coefficient of t^k in the j-th Chebyshev polynomial of 2 t - 1
};

}  // namespace stickslip::numerics
