// The formula of a friction law and its derivative with respect to x, both as power series. They determine the
// first-order response of a slip to a small change of its start.
//
// A law's `resist`, called with a `Dual` of the variable, returns a Dual: the series of the resistance and the series
// of its slope. The operators below apply the rules of differentiation; the functions of series.hpp compute the series
// of the resulting expressions.
#pragma once

#include <utility>

#include "stickslip/series/series.hpp"

namespace stickslip::series {

template <Series V, Series D>
struct Dual {
  V value;
  D slope;
};

/// x itself, as the argument of a law.
inline Dual<Variable, Constant> variable(const Coefficients& x) noexcept { return {Variable{&x}, Constant{1}}; }

template <Series V, Series D>
Dual<V, D> dual(V value, D slope) {
  return {std::move(value), std::move(slope)};
}

// clang-format off
template <class V, class D> auto operator-(Dual<V, D> a)           { return dual(-a.value, -a.slope); }
template <class V, class D> auto operator+(Dual<V, D> a, double b) { return dual(a.value + b, a.slope); }
template <class V, class D> auto operator+(double a, Dual<V, D> b) { return dual(a + b.value, b.slope); }
template <class V, class D> auto operator-(Dual<V, D> a, double b) { return dual(a.value - b, a.slope); }
template <class V, class D> auto operator-(double a, Dual<V, D> b) { return dual(a - b.value, -b.slope); }
template <class V, class D> auto operator*(Dual<V, D> a, double b) { return dual(a.value * b, a.slope * b); }
template <class V, class D> auto operator*(double a, Dual<V, D> b) { return dual(a * b.value, a * b.slope); }
template <class V, class D> auto operator/(Dual<V, D> a, double b) { return dual(a.value / b, a.slope / b); }
template <class V, class D> auto operator/(double a, Dual<V, D> b) { return dual(a / b.value, -a * b.slope / (b.value * b.value)); }
template <class V, class D, class W, class E> auto operator+(Dual<V, D> a, Dual<W, E> b) { return dual(a.value + b.value, a.slope + b.slope); }
template <class V, class D, class W, class E> auto operator-(Dual<V, D> a, Dual<W, E> b) { return dual(a.value - b.value, a.slope - b.slope); }
template <class V, class D, class W, class E> auto operator*(Dual<V, D> a, Dual<W, E> b) { return dual(a.value * b.value, a.slope * b.value + a.value * b.slope); }
template <class V, class D, class W, class E> auto operator/(Dual<V, D> a, Dual<W, E> b) { return dual(a.value / b.value, (a.slope - a.value / b.value * b.slope) / b.value); }
template <class V, class D> auto exp(Dual<V, D> a)  { return dual(exp(a.value), exp(a.value) * a.slope); }
template <class V, class D> auto decaying(Dual<V, D> a, double first, double last) { return dual(decaying(a.value, first, last), (first - last) * exp(a.value) * a.slope); }
template <class V, class D> auto log(Dual<V, D> a)  { return dual(log(a.value), a.slope / a.value); }
template <class V, class D> auto pow(Dual<V, D> a, double exponent) { return dual(pow(a.value, exponent), exponent * pow(a.value, exponent - 1) * a.slope); }
template <class V, class D> auto sqrt(Dual<V, D> a) { return pow(a, 0.5); }
template <class V, class D> auto sin(Dual<V, D> a)  { return dual(sin(a.value), cos(a.value) * a.slope); }
template <class V, class D> auto cos(Dual<V, D> a)  { return dual(cos(a.value), -(sin(a.value) * a.slope)); }
template <class V, class D> auto sinh(Dual<V, D> a) { return dual(sinh(a.value), cosh(a.value) * a.slope); }
template <class V, class D> auto cosh(Dual<V, D> a) { return dual(cosh(a.value), sinh(a.value) * a.slope); }
template <class V, class D> auto sech(Dual<V, D> a) { return dual(sech(a.value), -(sech(a.value) * tanh(a.value) * a.slope)); }
template <class V, class D> auto tanh(Dual<V, D> a) { return dual(tanh(a.value), sech(a.value) * sech(a.value) * a.slope); }
// clang-format on

/// The series of the slope of a value that a law returns; zero if the law returns a number.
inline Constant slope_of(double) noexcept { return {0}; }
template <class V, class D>
D slope_of(const Dual<V, D>& a) {
  return a.slope;
}

}  // namespace stickslip::series
