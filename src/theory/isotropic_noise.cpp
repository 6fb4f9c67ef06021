#include "theory/isotropic_noise.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

#include "theory/laplace_inversion.hpp"

namespace stickslip::detail {
namespace {

using std::numbers::pi;
using Complex = std::complex<double>;

// For real z, z > 0, all of these are real: 2 k = 1 + Q, delta = 1 / Q lies in (0, 1), and so does rho = (k - 1) / k.

/// What the transforms contain at the variable z of time, in the units in which D and the time are 1: a = level.
struct At {
  At(Complex z, double level, int dimensions) {
    root = level > 1 ? level * std::sqrt(1.0 + 4.0 * (z / level) / level) : std::sqrt(level * level + 4.0 * z);
    k = (level + root) / 2.0;
    const Complex less = z / k;  // level (k - 1), without cancellation
    rho = less / k;
    half = less / root;
    delta = level / root;
    // (d - 1) (1 - delta) / 2, which is nearly 0 at late times
    alpha = static_cast<double>(dimensions - 1) * half;
  }

  Complex root;   ///< a Q
  Complex k;      ///< a k
  Complex rho;    ///< (k - 1) / k
  Complex half;   ///< (k - 1) / Q = (1 - delta) / 2
  Complex delta;  ///< 1 / Q
  Complex alpha;
};

/// Gauss's function of |x| up to about 0.6.
Complex gauss(Complex a, Complex b, Complex c, Complex x) {
  Complex term = 1, sum = 1;
  for (int n = 0; n < 500 && std::abs(term) > 1e-17 * std::abs(sum); ++n) {
    const double j = n;
    term *= (a + j) * (b + j) / ((c + j) * (j + 1)) * x;
    sum += term;
  }
  return sum;
}

/// Gamma(m + d + 1) / m!.
double norm(int m, int dimensions) {
  double product = 1;
  for (int j = 1; j <= dimensions; ++j) product *= m + j;
  return product;
}

/// E|v|^n.
Complex moment(const At& at, Complex z, int order, int dimensions) {
  const double d = dimensions, n = order;
  const Complex b = at.alpha + 2.0 - d;
  Complex factor = 1.0 / z;
  for (int j = 0; j < order; ++j) factor *= (d + j) * (j + 2) / ((at.alpha + 2.0 + double(j)) * at.k);
  return factor * gauss(at.alpha, b, at.alpha + 2.0 + n, at.half) / gauss(at.alpha, b, at.alpha + 2.0, at.half);
}

/// E[x v], the inner product. The sum over Sturmian functions, of (-rho)^m (m + d + 1)! / m! (G[m] - G[m + 1]),
/// converges slowly at early times, when rho is nearly 1. Euler's transformation makes it a series in (k - 1) / Q,
/// about 1/2 at most, whatever rho: the sum of z^j (j + d + 1)! / j! times differences of order j + 1.
Complex covariance(const At& at, int dimensions) {
  const double d = dimensions;
  const auto g = [&](double m) {
    const Complex q = m + 1.0 + at.alpha, product = (m + at.alpha) * q * q * (q + 1.0) * (q + 2.0);
    if (m == 0) return 2 * (d + 1) / product;  // q - 2 cancels
    return 2.0 * ((d - 3) * q - 2 * (d - 1) * at.delta) / ((m - 1.0 + at.alpha) * product);
  };
  constexpr int most = 100;
  std::array<Complex, most> difference;  // an antidiagonal of the table: (-1)^j times the j-th difference at its end
  difference[0] = g(0);
  Complex power = 3 * (d - 1) * d * (d + 1), sum = 0;
  for (int j = 1; j < most; ++j) {
    Complex next = g(j);
    for (int i = 0; i < j; ++i) next = std::exchange(difference[static_cast<std::size_t>(i)], next) - next;
    difference[static_cast<std::size_t>(j)] = next;
    const Complex term = power * next;
    sum += term;
    if (j > 4 && std::abs(term) < 1e-17 * std::abs(sum)) break;
    power *= at.half * (d + 1 + j) / double(j);
  }
  const Complex square = at.root * at.root;
  return sum / square / square / square;
}

// The stationary velocity, in the units D / a of velocity and D / a^2 of time.

/// The transform of the autocovariance is (d + 1) / s - 1 / s^2 + f / s^2, where f is that of the force of friction,
/// relative to its first value.
Complex friction_part(const At& at, int dimensions) {
  const Complex b = 1.0 + at.alpha, x = at.rho * at.rho;
  const double enough = 1e-17 * std::max(1.0, std::norm(at.k)), last = 1 / (1 - std::abs(x));
  Complex term = 1, sum = 1;
  for (double n = 0; n < 1e5; ++n) {
    term *= (b - double(dimensions) + n) / (b + 1.0 + n) * x;
    sum += term;
    if (n > dimensions && std::abs(term) * std::min(n, last) < enough) break;
  }
  return sum / (b * at.k * at.k);
}

/// The same transform as the sum of the squares of Sturmian coefficients, without cancellation for small s.
Complex sturmian_sum(const At& at, int dimensions) {
  const double d = dimensions;
  const Complex b = 1.0 + at.alpha, x = at.rho * at.rho;
  // The powers of rho in [(n + d + 1) rho^n + n rho^(n - 1)]^2 = rho^(2 n - 2) [n (1 + rho) + (d + 1) rho]^2
  Complex sum = norm(0, dimensions) * (d + 1) * (d + 1) / b, power = 1;
  for (int n = 1; n < 500; ++n) {
    const Complex root = double(n) * (1.0 + at.rho) + (d + 1) * at.rho;
    const Complex term = norm(n, dimensions) * power * root * root / (b + double(n));
    sum += term;
    if (n > 4 && std::abs(term) < 1e-17 * std::abs(sum)) break;
    power *= x;
  }
  Complex factor = 1.0 / norm(0, dimensions);
  for (int j = 0; j < dimensions; ++j) factor *= at.root / (at.k * at.k);
  const Complex square = at.k * at.k;
  return factor * sum / square / square;
}

constexpr double small_s = 1;

}  // namespace

IsotropicFromRest isotropic_from_rest(double level, int dimensions) {
  const auto f = inverted<3>([&](Complex z) {
    const At at(z, level, dimensions);
    const Complex product = covariance(at, dimensions);
    return std::array<Complex, 3>{moment(at, z, 2, dimensions), product, 2.0 * product / z};
  });
  const double d = dimensions;
  return {f[0] / d, f[1] / d, f[2] / d};
}

double isotropic_moment(double level, int order, int dimensions) {
  return inverted<1>(
      [&](Complex z) { return std::array<Complex, 1>{moment(At(z, level, dimensions), z, order, dimensions)}; })[0];
}

double isotropic_autocovariance(double time, int dimensions) {
  const double d = dimensions;
  const bool early = time < 1;  // the first terms are then known without inversion
  const double rest = inverted<1>([&](Complex z) {
    const Complex s = z / time;
    const At at(s, 1, dimensions);
    if (early) return std::array<Complex, 1>{friction_part(at, dimensions) / (s * z)};
    const Complex whole = std::abs(s) < small_s ? sturmian_sum(at, dimensions)
                                                : ((d + 1) + (friction_part(at, dimensions) - 1.0) / s) / s;
    return std::array<Complex, 1>{whole / time};
  })[0];
  return early ? d + 1 - time + rest : rest;
}

double isotropic_spectrum(double omega, int dimensions) {
  const At at(Complex(0, omega), 1, dimensions);
  if (omega < small_s) return sturmian_sum(at, dimensions).real() / pi;
  return (1 - friction_part(at, dimensions).real()) / omega / omega / pi;
}

}  // namespace stickslip::detail
