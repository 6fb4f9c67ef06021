// The zero of a function, or the threshold of a condition, within a bracket.
#pragma once

#include <cmath>
#include <concepts>
#include <limits>
#include <utility>

#include "stickslip/base/equal.hpp"
#include "stickslip/base/min_max.hpp"

namespace stickslip::numerics {

/// The smallest number at which a condition holds, by bisection to the last bit. The condition must be false at `low`,
/// true at `high`, and true above any number at which it is true.
/// Cost: about as many calls as a double has bits; more if `low` is 0 and the result is tiny.
template <std::predicate<double> Condition>
double first_where(double low, double high, Condition&& holds) {
  for (;;) {
    const double middle = low + (high - low) / 2;
    if (!(low < middle && middle < high)) return high;
    (holds(middle) ? high : low) = middle;
  }
}

/// The zero between `a` and `b` of a continuous function f, where fa = f(a) and fb = f(b) have opposite signs. Uses
/// inverse quadratic interpolation where it converges, otherwise bisection.
/// @param tolerance  absolute, at least 0, in addition to two roundings of the zero
/// Cost: about 5 to 10 calls if f is smooth.
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
    if (!(least <= 0.5) || detail::equal(fa, 0)) return best;  // also if f overflows
    const double xi = (a - b) / (c - b), phi = (fa - fb) / (fc - fb);
    part = 0.5;
    if (phi * phi < xi && (1 - phi) * (1 - phi) < 1 - xi)
      part = fa / (fb - fa) * (fc / (fb - fc)) + (c - a) / (b - a) * (fa / (fc - fa)) * (fb / (fc - fb));
    part = std::max(least, std::min(part, 1 - least));
  }
}

}  // namespace stickslip::numerics
