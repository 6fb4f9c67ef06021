// Power series in time, order by order: what a friction law becomes along a motion.
//
// Call a law's `level` on a `Variable` and it returns an expression whose type is the formula. Each node of it holds
// its own coefficients; `update(k)` computes the k-th from those of its operands up to k, by the recurrences of
// automatic differentiation (Griewank & Walther, Evaluating Derivatives, 2nd ed. 2008, ch. 13). All orders up to n cost
// O(n^2) for each product or function, nothing is allocated, and the compiler sees the whole formula.
//
// At hand: + - * / with series and numbers, exp, log, sqrt, pow (constant exponent), sin, cos, sinh, cosh, tanh, sech.
#pragma once

#include <array>
#include <cmath>
#include <concepts>
#include <utility>

#include "stickslip/detail/requirements.hpp"

namespace stickslip {

/// 1 / cosh(x), without overflow.
inline double sech(double x) noexcept {
  const double e = std::exp(-std::abs(x));
  return 2 * e / (1 + e * e);
}

namespace series {

inline constexpr int highest_order = 30;

/// 1/k, for k = 1 to highest_order + 1: the recurrences divide by orders all the time.
inline constexpr auto reciprocal = [] {
  std::array<double, highest_order + 2> table{};
  for (int k = 1; k <= highest_order + 1; ++k) table[k] = 1.0 / k;
  return table;
}();

/// Coefficients 0 to highest_order. Unset when made, and not copied with an expression: they belong to the place where
/// they are computed.
class Coefficients {
 public:
  Coefficients() noexcept {}
  Coefficients(const Coefficients&) noexcept {}
  Coefficients& operator=(const Coefficients&) = delete;
  double operator[](int k) const noexcept { return c_[k]; }
  double& operator[](int k) noexcept { return c_[k]; }

 private:
  double c_[highest_order + 1];
};

/// Anything with coefficients that are computed in order.
template <class S>
concept Series = requires(S s, const S& c, int k) {
  s.update(k);
  { c[k] } -> std::convertible_to<double>;
};

/// Sum of a_i b_(k-i) over i = first..k, k >= first. The coefficients found last, which are at both ends, come last,
/// and the others go in two parts: an addition must wait for what it adds.
template <class A, class B>
double convolve(const A& a, const B& b, int first, int k) noexcept {
  if (k == first) return a[k] * b[0];
  double even = 0, odd = 0;
  int i = first + 1;
  for (; i + 1 < k; i += 2) {
    even += a[i] * b[k - i];
    odd += a[i + 1] * b[k - i - 1];
  }
  if (i < k) even += a[i] * b[k - i];
  return (even + odd + a[k] * b[0]) + a[first] * b[k - first];
}

/// The independent function of time: its coefficients are set from outside.
struct Variable {
  const Coefficients* values;
  void update(int) const noexcept {}
  double operator[](int k) const noexcept { return (*values)[k]; }
};

struct Constant {
  double value;
  void update(int) const noexcept {}
  double operator[](int k) const noexcept { return k == 0 ? value : 0.0; }
};

/// factor * a + offset.
template <Series A>
struct Affine {
  A a;
  double factor, offset;
  void update(int k) noexcept { a.update(k); }
  double operator[](int k) const noexcept { return k == 0 ? factor * a[0] + offset : factor * a[k]; }
};

/// a + factor * b.
template <Series A, Series B>
struct Sum {
  A a;
  B b;
  double factor;
  void update(int k) noexcept {
    a.update(k);
    b.update(k);
  }
  double operator[](int k) const noexcept { return a[k] + factor * b[k]; }
};

template <Series A, Series B>
struct Product {
  A a;
  B b;
  Coefficients c{};
  void update(int k) noexcept {
    a.update(k);
    b.update(k);
    c[k] = convolve(a, b, 0, k);
  }
  double operator[](int k) const noexcept { return c[k]; }
};

template <Series A, Series B>
struct Quotient {
  A a;
  B b;
  Coefficients c{};
  void update(int k) noexcept {
    a.update(k);
    b.update(k);
    c[k] = (k == 0 ? a[0] : a[k] - convolve(b, c, 1, k)) / b[0];
  }
  double operator[](int k) const noexcept { return c[k]; }
};

/// The derivative of a series, (k + 1) a_(k+1), as far as `a` is known.
template <Series A>
struct Derivative {
  const A& a;
  double operator[](int k) const noexcept { return (k + 1) * a[k + 1]; }
};

/// exp: e' = a' e.
template <Series A>
struct Exp {
  A a;
  Coefficients e{};
  void update(int k) noexcept {
    a.update(k);
    e[k] = k == 0 ? std::exp(a[0]) : convolve(e, Derivative<A>{a}, 0, k - 1) * reciprocal[k];
  }
  double operator[](int k) const noexcept { return e[k]; }
};

/// log: a l' = a'.
template <Series A>
struct Log {
  A a;
  Coefficients l{};
  void update(int k) noexcept {
    a.update(k);
    if (k == 0) {
      l[0] = std::log(a[0]);
      return;
    }
    double sum = k * a[k];
    for (int i = 1; i < k; ++i) sum -= a[i] * ((k - i) * l[k - i]);
    l[k] = sum / (k * a[0]);
  }
  double operator[](int k) const noexcept { return l[k]; }
};

/// a^exponent: a p' = exponent a' p; a must not be 0.
template <Series A>
struct Power {
  A a;
  double exponent;
  Coefficients p{};
  void update(int k) noexcept {
    a.update(k);
    if (k == 0) {
      p[0] = std::pow(a[0], exponent);
      return;
    }
    double sum = 0;
    for (int i = 1; i <= k; ++i) sum += (exponent * i - (k - i)) * a[i] * p[k - i];
    p[k] = sum / (k * a[0]);
  }
  double operator[](int k) const noexcept { return p[k]; }
};

/// Two functions that are each other's derivative, f' = g a' and g' = sign f a': sin and cos (-1), sinh and cosh (+1).
template <Series A, int sign>
struct Pair {
  A a;
  Coefficients f{}, g{};
  void update(int k) noexcept {
    a.update(k);
    if (k == 0) {
      f[0] = sign < 0 ? std::sin(a[0]) : std::sinh(a[0]);
      g[0] = sign < 0 ? std::cos(a[0]) : std::cosh(a[0]);
      return;
    }
    f[k] = convolve(g, Derivative<A>{a}, 0, k - 1) * reciprocal[k];
    g[k] = sign * convolve(f, Derivative<A>{a}, 0, k - 1) * reciprocal[k];
  }
};

template <Series A, int sign>
struct First : Pair<A, sign> {
  double operator[](int k) const noexcept { return this->f[k]; }
};

template <Series A, int sign>
struct Second : Pair<A, sign> {
  double operator[](int k) const noexcept { return this->g[k]; }
};

/// sech and tanh by the angle whose sine is sech, w = sech(a) a': sech' = -tanh w, tanh' = sech w. Bounded everywhere.
template <Series A>
struct Hyperbolic {
  A a;
  Coefficients secant{}, tangent{}, w{}, slope{};  // slope: (k + 1) a_(k+1)
  void update(int k) noexcept {
    a.update(k);
    if (k == 0) {
      const double y = std::abs(a[0]);
      const double e1 = y < 0.5 ? std::expm1(-y) : std::exp(-y) - 1;  // either form is exact where it is used
      const double e = y < 0.5 ? 1 + e1 : std::exp(-y);
      secant[0] = 2 * e / (1 + e * e);
      tangent[0] = std::copysign(-e1 * (1 + e) / (1 + e * e), a[0]);
      return;
    }
    slope[k - 1] = k * a[k];
    w[k - 1] = convolve(secant, slope, 0, k - 1);
    secant[k] = -convolve(tangent, w, 0, k - 1) * reciprocal[k];
    tangent[k] = convolve(secant, w, 0, k - 1) * reciprocal[k];
  }
};

template <Series A>
struct Sech : Hyperbolic<A> {
  double operator[](int k) const noexcept { return this->secant[k]; }
};

template <Series A>
struct Tanh : Hyperbolic<A> {
  double operator[](int k) const noexcept { return this->tangent[k]; }
};

// The operators and functions a law is written with, found by argument-dependent lookup.
// clang-format off
template <Series A>           Affine<A>     operator-(A a)           { return {a, -1, 0}; }
template <Series A>           Affine<A>     operator+(A a, double b) { return {a, 1, b}; }
template <Series A>           Affine<A>     operator+(double a, A b) { return {b, 1, a}; }
template <Series A>           Affine<A>     operator-(A a, double b) { return {a, 1, -b}; }
template <Series A>           Affine<A>     operator-(double a, A b) { return {b, -1, a}; }
template <Series A>           Affine<A>     operator*(A a, double b) { return {a, b, 0}; }
template <Series A>           Affine<A>     operator*(double a, A b) { return {b, a, 0}; }
template <Series A>           Affine<A>     operator/(A a, double b) { return {a, 1 / b, 0}; }
template <Series A>           Quotient<Constant, A> operator/(double a, A b) { return {{a}, b}; }
template <Series A, Series B> Sum<A, B>      operator+(A a, B b) { return {a, b, 1}; }
template <Series A, Series B> Sum<A, B>      operator-(A a, B b) { return {a, b, -1}; }
template <Series A, Series B> Product<A, B>  operator*(A a, B b) { return {a, b}; }
template <Series A, Series B> Quotient<A, B> operator/(A a, B b) { return {a, b}; }
template <Series A> Exp<A>        exp(A a)  { return {a}; }
template <Series A> Log<A>        log(A a)  { return {a}; }
template <Series A> Power<A>      pow(A a, double exponent) { return {a, exponent}; }
template <Series A> Power<A>      sqrt(A a) { return {a, 0.5}; }
template <Series A> First<A, -1>  sin(A a)  { return {{a}}; }
template <Series A> Second<A, -1> cos(A a)  { return {{a}}; }
template <Series A> First<A, +1>  sinh(A a) { return {{a}}; }
template <Series A> Second<A, +1> cosh(A a) { return {{a}}; }
template <Series A> Sech<A>       sech(A a) { return {{a}}; }
template <Series A> Tanh<A>       tanh(A a) { return {{a}}; }
// clang-format on

}  // namespace series
}  // namespace stickslip
