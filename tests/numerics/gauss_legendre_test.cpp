// Gauss and Legendre's rules: the known ones, and that each integrates the polynomials it must.
#include "stickslip/numerics/gauss_legendre.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <type_traits>
#include <utility>

#include "support/catch.hpp"

using namespace stickslip::numerics;

namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

/// Largest error of the integral of x^k from 0 to 1, relative, k = 0 .. 2 points - 1.
template <std::size_t points>
double largest_error() {
  double largest = 0;
  for (int k = 0; k < static_cast<int>(2 * points); ++k)
    largest = std::max(largest,
                       std::abs(gauss_integral<points>(0, 1, [k](double x) { return std::pow(x, k); }) * (k + 1) - 1));
  return largest;
}

}  // namespace

TEST_CASE("rules of few points are the known ones", "[gauss_legendre]") {
  CHECK(gauss_legendre<1>.nodes[0] == 0.5);
  CHECK(gauss_legendre<1>.weights[0] == 1);
  CHECK(std::abs(gauss_legendre<2>.nodes[1] - (1 + std::sqrt(1.0 / 3)) / 2) <= epsilon);
  CHECK(std::abs(gauss_legendre<3>.nodes[0] - (1 - std::sqrt(0.6)) / 2) <= epsilon);
  CHECK(gauss_legendre<3>.nodes[1] == 0.5);
  CHECK(std::abs(gauss_legendre<3>.weights[1] - 4.0 / 9) <= epsilon);
  // Abramowitz and Stegun, table 25.4, n = 16: +-0.98940 09349 91649 932596, weight 0.02715 24594 11754 094852.
  CHECK(std::abs(gauss_legendre<16>.nodes[15] - (1 + 0.989400934991649932596) / 2) <= epsilon);
  CHECK(std::abs(gauss_legendre<16>.weights[15] - 0.027152459411754094852 / 2) <= epsilon / 32);
}

TEST_CASE("a rule of n points is exact to degree 2 n - 1 and not beyond", "[gauss_legendre]") {
  // Each term is rounded, x^k after an error of k epsilon / 2 in x at worst: largest for 20 points, k = 39.
  const auto check = []<std::size_t points>(std::integral_constant<std::size_t, points>) {
    CHECK(largest_error<points>() <= (points + 2) * epsilon);
  };
  [&]<std::size_t... n>(std::index_sequence<n...>) { (check(std::integral_constant<std::size_t, n + 1>()), ...); }
  (std::make_index_sequence<20>());
  // The error of x^6 by 3 points, from 0 to 1: (3!)^4 / (7 (6!)^3) 6! = 1 / 2800.
  CHECK(std::abs(1.0 / 7 - gauss_integral<3>(0, 1, [](double x) { return std::pow(x, 6); }) - 1.0 / 2800) <= epsilon);
}

TEST_CASE("a rule works between any limits, its points in order", "[gauss_legendre]") {
  // The pole at 0 lies on the ellipse of 1 and 4 whose semi-axes add up to 3 half lengths: the error falls as 3^-2n,
  // here 8e-20; the rest is the rounding of 20 terms.
  CHECK(std::abs(gauss_integral<20>(1, 4, [](double x) { return 1 / x; }) - std::log(4.0)) <= 4 * epsilon);
  CHECK(std::abs(gauss_integral<20>(4, 1, [](double x) { return 1 / x; }) + std::log(4.0)) <= 4 * epsilon);
  double last = 1;
  gauss_points<8>(1, 4, [&](double x, double) {
    CHECK(x > last);
    last = x;
  });
  CHECK(last < 4);
}
