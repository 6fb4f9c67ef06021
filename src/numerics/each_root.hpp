// The roots of a polynomial on [0, 1], one after the other.
#pragma once

#include "stickslip/base/equal.hpp"
#include "stickslip/flow/closed_form.hpp"
#include "stickslip/flow/power_series.hpp"

namespace stickslip::detail {

/// Call `use(s)` where a polynomial vanishes within (0, 1], in order; not at 0, nor where it only touches zero.
/// @param w  coefficients of s^0 .. s^degree, which are changed
template <class Use>
void for_each_root(double* w, int degree, Use&& use) {
  double from = 0;
  for (int roots = 0; roots < 16; ++roots) {
    int leading = 0;
    while (leading <= degree && equal(w[leading], 0)) ++leading;
    if (leading >= degree) return;
    if (w[leading] < 0)
      for (int k = leading; k <= degree; ++k) w[k] = -w[k];
    const double part = FirstRoot(w + leading, degree - leading).find();
    if (!(from + part <= 1)) return;
    use(from + part);
    for (int i = 0; i < degree; ++i)  // about the root
      for (int k = degree - 1; k >= i; --k) w[k] += part * w[k + 1];
    w[0] = 0;
    from += part;
  }
}

}  // namespace stickslip::detail
