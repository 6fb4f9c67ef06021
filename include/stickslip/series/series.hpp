// Power series in time, computed order by order: a friction law evaluated along a motion.
//
// A law's `resist`, called with a `Variable`, returns an expression whose type encodes the formula. Each node of the
// expression stores its own coefficients; `update(k)` computes the k-th from those of its operands up to k, by the
// recurrences of automatic differentiation (Griewank & Walther, Evaluating Derivatives, 2nd ed. 2008, ch. 13). All
// orders up to n cost O(n^2) for each product or function, nothing is allocated, and the compiler can optimize the
// whole formula.
//
// Coefficients can be of any scalar type that has arithmetic and these functions: double, or several doubles in SIMD
// lanes.
//
// Available: + - * / with series and numbers, exp, log, sqrt, pow (constant exponent; with an integer exponent also at
// 0), sin, cos, sinh, cosh, tanh, sech, decaying.
#pragma once

#include <array>
#include <cmath>
#include <concepts>
#include <type_traits>
#include <utility>

#include "stickslip/base/requirements.hpp"

namespace stickslip {

/// 1 / cosh(x), without overflow.
inline double sech(double x) noexcept {
  const double e = std::exp(-std::abs(x));
  return 2 * e / (1 + e * e);
}

/// last + (first - last) exp(x), x <= 0: `first` at 0 and `last` at minus infinity. Both levels are at least 0; there
/// is no cancellation where either vanishes.
inline double decaying(double x, double first, double last) noexcept {
  return first <= last && x > -0.5 ? first - (last - first) * std::expm1(x) : last + (first - last) * std::exp(x);
}

namespace detail {

/// sech and tanh of one number.
template <class Scalar>
struct SechTanh {
  Scalar sech, tanh;
};

inline SechTanh<double> sech_tanh(double x) noexcept {
  const double y = std::abs(x);
  const double e1 = y < 0.5 ? std::expm1(-y) : std::exp(-y) - 1;  // each form is accurate where it is used
  const double e = y < 0.5 ? 1 + e1 : std::exp(-y);
  return {2 * e / (1 + e * e), std::copysign(-e1 * (1 + e) / (1 + e * e), x)};
}

}  // namespace detail

namespace series {

inline constexpr int highest_order = 30;

/// 1/k, for k = 1 to highest_order + 1: the recurrences often divide by the order.
inline constexpr auto reciprocal = [] {
  struct {
    double of[highest_order + 2];
    constexpr double operator[](int k) const noexcept { return of[k]; }
  } table{};
  for (int k = 1; k <= highest_order + 1; ++k) table.of[k] = 1.0 / k;
  return table;
}();

/// Coefficients 0 to highest_order. They are uninitialized on construction and not copied with an expression: they
/// belong to the node that computes them.
template <class Scalar>
class CoefficientsOf {
 public:
  CoefficientsOf() noexcept {}
  CoefficientsOf(const CoefficientsOf&) noexcept {}
  CoefficientsOf& operator=(const CoefficientsOf&) = delete;
  const Scalar& operator[](int k) const noexcept { return c_[k]; }
  Scalar& operator[](int k) noexcept { return c_[k]; }

 private:
  Scalar c_[highest_order + 1];
};
using Coefficients = CoefficientsOf<double>;

/// A type with coefficients that are computed in order.
template <class S>
concept Series = requires(S s, const S& c, int k) {
  s.update(k);
  { c[k] } -> std::convertible_to<typename S::Scalar>;
};

/// a b + c. SIMD lanes define their own overload.
inline double multiply_add(double a, double b, double c) noexcept { return a * b + c; }

/// Sum of a_i b_(k-i) over i = first..k, k >= first. The first and the last term contain the most recently computed
/// coefficients and are added last. The other terms form two independent sums, because each addition must wait for the
/// result of the previous one.
template <class A, class B>
auto convolve(const A& a, const B& b, int first, int k) noexcept {
  using Scalar = std::remove_cvref_t<decltype(a[k])>;
  if (k == first) return Scalar(a[k] * b[0]);
  Scalar even = 0, odd = 0;
  int i = first + 1;
  for (; i + 1 < k; i += 2) {
    even = multiply_add(a[i], b[k - i], even);
    odd = multiply_add(a[i + 1], b[k - i - 1], odd);
  }
  if (i < k) even = multiply_add(a[i], b[k - i], even);
  return Scalar((even + odd + a[k] * b[0]) + a[first] * b[k - first]);
}

/// The argument of a formula, a function of time whose coefficients are set from outside.
template <class S>
struct VariableOf {
  using Scalar = S;
  const CoefficientsOf<S>* values;
  void update(int) const noexcept {}
  S operator[](int k) const noexcept { return (*values)[k]; }
};
using Variable = VariableOf<double>;

template <class S>
struct ConstantOf {
  using Scalar = S;
  S value;
  void update(int) const noexcept {}
  S operator[](int k) const noexcept { return k == 0 ? value : S(0.0); }
};
using Constant = ConstantOf<double>;

// Functions of doubles. Argument-dependent lookup finds those of other scalars.
using detail::sech_tanh;
using std::cos;
using std::cosh;
using std::exp;
using std::log;
using std::pow;
using std::sin;
using std::sinh;
using stickslip::decaying;

/// The return value of a law as a series: the series itself, or a constant if the law returned a number.
template <class Scalar, Series S>
S series_of(const S& level) noexcept {
  return level;
}
template <class Scalar>
ConstantOf<Scalar> series_of(double level) noexcept {
  return {level};
}

/// factor * a + offset.
template <Series A>
struct Affine {
  using Scalar = typename A::Scalar;
  A a;
  double factor, offset;
  void update(int k) noexcept { a.update(k); }
  Scalar operator[](int k) const noexcept { return k == 0 ? factor * a[0] + offset : factor * a[k]; }
};

/// a + factor * b.
template <Series A, Series B>
struct Sum {
  using Scalar = typename A::Scalar;
  A a;
  B b;
  double factor;
  void update(int k) noexcept {
    a.update(k);
    b.update(k);
  }
  Scalar operator[](int k) const noexcept { return a[k] + factor * b[k]; }
};

template <Series A, Series B>
struct Product {
  using Scalar = typename A::Scalar;
  A a;
  B b;
  CoefficientsOf<Scalar> c{};
  void update(int k) noexcept {
    a.update(k);
    b.update(k);
    c[k] = convolve(a, b, 0, k);
  }
  Scalar operator[](int k) const noexcept { return c[k]; }
};

template <Series A, Series B>
struct Quotient {
  using Scalar = typename A::Scalar;
  A a;
  B b;
  CoefficientsOf<Scalar> c{};
  void update(int k) noexcept {
    a.update(k);
    b.update(k);
    c[k] = (k == 0 ? a[0] : a[k] - convolve(b, c, 1, k)) / b[0];
  }
  Scalar operator[](int k) const noexcept { return c[k]; }
};

/// The derivative of a series, (k + 1) a_(k+1), up to the known order of `a`.
template <Series A>
struct Derivative {
  const A& a;
  auto operator[](int k) const noexcept { return (k + 1) * a[k + 1]; }
};

/// exp: e' = a' e.
template <Series A>
struct Exp {
  using Scalar = typename A::Scalar;
  A a;
  CoefficientsOf<Scalar> e{};
  void update(int k) noexcept {
    a.update(k);
    e[k] = k == 0 ? exp(a[0]) : convolve(e, Derivative<A>{a}, 0, k - 1) * reciprocal[k];
  }
  Scalar operator[](int k) const noexcept { return e[k]; }
};

/// last + (first - last) exp(a).
template <Series A>
struct Decaying {
  using Scalar = typename A::Scalar;
  Exp<A> e;
  double first, last;
  Scalar at_start{};
  void update(int k) noexcept {
    e.update(k);
    if (k == 0) at_start = decaying(e.a[0], first, last);
  }
  Scalar operator[](int k) const noexcept { return k == 0 ? at_start : (first - last) * e[k]; }
};

/// log: a l' = a'.
template <Series A>
struct Log {
  using Scalar = typename A::Scalar;
  A a;
  CoefficientsOf<Scalar> l{};
  void update(int k) noexcept {
    a.update(k);
    if (k == 0) {
      l[0] = log(a[0]);
      return;
    }
    Scalar sum = k * a[k];
    for (int i = 1; i < k; ++i) sum -= a[i] * ((k - i) * l[k - i]);
    l[k] = sum / (k * a[0]);
  }
  Scalar operator[](int k) const noexcept { return l[k]; }
};

/// a^exponent: a p' = exponent a' p; a must not be 0.
template <Series A>
struct Power {
  using Scalar = typename A::Scalar;
  A a;
  double exponent;
  CoefficientsOf<Scalar> p{};
  void update(int k) noexcept {
    a.update(k);
    if (k == 0) {
      p[0] = pow(a[0], exponent);
      return;
    }
    Scalar sum = 0;
    for (int i = 1; i <= k; ++i) sum += (exponent * i - (k - i)) * a[i] * p[k - i];
    p[k] = sum / (k * a[0]);
  }
  Scalar operator[](int k) const noexcept { return p[k]; }
};

/// a^exponent for an integer exponent from 1 to 31, by products: a may be 0.
template <Series A>
struct WholePower {
  using Scalar = typename A::Scalar;
  A a;
  int exponent;
  std::array<CoefficientsOf<Scalar>, 5> squares{};   // a, a^2, a^4, ...
  std::array<CoefficientsOf<Scalar>, 5> products{};  // of the squares that the exponent contains, up to each bit
  void update(int k) noexcept {
    a.update(k);
    squares[0][k] = a[k];
    std::size_t last = 0;
    bool any = false;
    for (std::size_t bit = 0; exponent >> bit; ++bit) {
      if (bit > 0) squares[bit][k] = convolve(squares[bit - 1], squares[bit - 1], 0, k);
      if (!(exponent >> bit & 1)) continue;
      products[bit][k] = any ? convolve(products[last], squares[bit], 0, k) : squares[bit][k];
      last = bit;
      any = true;
    }
  }
  Scalar operator[](int k) const noexcept {
    std::size_t last = 0;
    while (exponent >> (last + 1)) ++last;
    return products[last][k];
  }
};

/// Two functions that satisfy f' = g a' and g' = sign f a': sin and cos (sign = -1), sinh and cosh (sign = +1).
template <Series A, int sign>
struct Pair {
  using Scalar = typename A::Scalar;
  A a;
  CoefficientsOf<Scalar> f{}, g{};
  void update(int k) noexcept {
    a.update(k);
    if (k == 0) {
      f[0] = sign < 0 ? sin(a[0]) : sinh(a[0]);
      g[0] = sign < 0 ? cos(a[0]) : cosh(a[0]);
      return;
    }
    f[k] = convolve(g, Derivative<A>{a}, 0, k - 1) * reciprocal[k];
    g[k] = sign * convolve(f, Derivative<A>{a}, 0, k - 1) * reciprocal[k];
  }
};

template <Series A, int sign>
struct First : Pair<A, sign> {
  auto operator[](int k) const noexcept { return this->f[k]; }
};

template <Series A, int sign>
struct Second : Pair<A, sign> {
  auto operator[](int k) const noexcept { return this->g[k]; }
};

/// sech and tanh as the sine and cosine of an angle whose derivative is -w, w = sech(a) a': sech' = -tanh w and tanh' =
/// sech w. Both are bounded everywhere.
template <Series A>
struct Hyperbolic {
  using Scalar = typename A::Scalar;
  A a;
  CoefficientsOf<Scalar> secant{}, tangent{}, w{}, slope{};  // slope: (k + 1) a_(k+1)
  void update(int k) noexcept {
    a.update(k);
    if (k == 0) {
      const auto [sech, tanh] = sech_tanh(a[0]);
      secant[0] = sech;
      tangent[0] = tanh;
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
  auto operator[](int k) const noexcept { return this->secant[k]; }
};

template <Series A>
struct Tanh : Hyperbolic<A> {
  auto operator[](int k) const noexcept { return this->tangent[k]; }
};

// The operators and functions available to laws, found by argument-dependent lookup.
// clang-format off
template <Series A>           Affine<A>     operator-(A a)           { return {a, -1, 0}; }
template <Series A>           Affine<A>     operator+(A a, double b) { return {a, 1, b}; }
template <Series A>           Affine<A>     operator+(double a, A b) { return {b, 1, a}; }
template <Series A>           Affine<A>     operator-(A a, double b) { return {a, 1, -b}; }
template <Series A>           Affine<A>     operator-(double a, A b) { return {b, -1, a}; }
template <Series A>           Affine<A>     operator*(A a, double b) { return {a, b, 0}; }
template <Series A>           Affine<A>     operator*(double a, A b) { return {b, a, 0}; }
template <Series A>           Affine<A>     operator/(A a, double b) { return {a, 1 / b, 0}; }
template <Series A>           Quotient<ConstantOf<typename A::Scalar>, A> operator/(double a, A b) { return {{a}, b}; }
template <Series A, Series B> Sum<A, B>      operator+(A a, B b) { return {a, b, 1}; }
template <Series A, Series B> Sum<A, B>      operator-(A a, B b) { return {a, b, -1}; }
template <Series A, Series B> Product<A, B>  operator*(A a, B b) { return {a, b}; }
template <Series A, Series B> Quotient<A, B> operator/(A a, B b) { return {a, b}; }
template <Series A> Exp<A>        exp(A a)  { return {a}; }
template <Series A> Decaying<A>   decaying(A a, double first, double last) { return {{a}, first, last}; }
template <Series A> Log<A>        log(A a)  { return {a}; }
template <Series A> Power<A>      pow(A a, double exponent) { return {a, exponent}; }
template <Series A> WholePower<A> pow(A a, int exponent) { return {a, exponent}; }
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
