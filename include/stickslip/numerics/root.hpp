// Where a function is zero, or a condition begins to hold, within a bracket.
#pragma once

#include <cmath>
#include <concepts>
#include <limits>
#include <utility>

#include "stickslip/detail/equal.hpp"
#include "stickslip/detail/min_max.hpp"

namespace stickslip::numerics {

/// The first number at which a condition holds that does not hold at `low`, and holds at `high` and wherever it held
/// before: by bisection, to the last bit.
/// Cost: as many calls as a double has bits, more where `low` is 0 and the number is tiny.
template <std::predicate<double> Condition>
double first_where(double low, double high, Condition&& holds) {
  for (;;) {
    const double middle = low + (high - low) / 2;
    if (!(low < middle && middle < high)) return high;
    (holds(middle) ? high : low) = middle;
  }
}

/// The zero between `a` and `b` of a continuous function f, fa = f(a) and fb = f(b) of opposite signs: by inverse
/// quadratic interpolation where that converges, else by bisection.
/// @param tolerance  absolute, at least 0, on top of two roundings of the zero
/// Cost: some 5 to 10 calls where f is smooth.
/// Reference: T. R. Chandrupatla, Advances in Engineering Software 28 (1997), 145-149.
template <class F>
double root(F&& f, double a, double fa, double b, double fb, double tolerance = std::numeric_limits<double>::min()) {
  constexpr double round_off = std::numeric_limits<double>::epsilon();
  std::swap(a, b);
  std::swap(fa, fb);
  for (double part = 0.5;;) {
    const double x = a + part * (b - a), fx = f(x);
    double c = a, fc = fa;
    if ((fx > 0) != (fa > 0)) {
      c = std::exchange(b, a);
      fc = std::exchange(fb, fa);
    }
    a = x;
    fa = fx;
    const double best = std::abs(fa) < std::abs(fb) ? a : b;
    const double least = (2 * round_off * std::abs(best) + tolerance) / std::abs(b - a);
    if (least > 0.5 || detail::equal(fa, 0)) return best;
    const double xi = (a - b) / (c - b), phi = (fa - fb) / (fc - fb);
    part = 0.5;
    if (phi * phi < xi && (1 - phi) * (1 - phi) < 1 - xi)
      part = fa / (fb - fa) * (fc / (fb - fc)) + (c - a) / (b - a) * (fa / (fc - fa)) * (fb / (fc - fb));
    part = std::max(least, std::min(part, 1 - least));
  }
}

}  // namespace stickslip::numerics
