// The largest value of a function of time.
#pragma once

#include <algorithm>
#include <cmath>

#include "stickslip/base/requirements.hpp"

namespace stickslip::detail {

/// Looks for the largest value of a function between two places, between which it has one maximum. The function keeps
/// what it is asked.
template <class Function>
void look_between(double low, double high, Function&& function) {
  constexpr double golden = 0.6180339887498949;
  double left = high - golden * (high - low), right = low + golden * (high - low);
  double at_left = function(left), at_right = function(right);
  for (int k = 0; k < 40; ++k) {
    if (at_left < at_right) {
      low = left, left = right, at_left = at_right;
      right = low + golden * (high - low), at_right = function(right);
    } else {
      high = right, right = left, at_right = at_left;
      left = high - golden * (high - low), at_left = function(left);
    }
  }
}

/// Looks for the largest value of a smooth function on [0, end].
/// @param parts  at least 2; within two of them the function is close to a parabola: the values between three neighbors
///               exceed them by less than twice their second difference
/// @param peak   the largest value so far, which the function keeps
template <class Function>
void look_for_largest(double end, int parts, const double& peak, Function&& function) {
  const double width = end / parts;
  double first = function(0.0), middle = function(width);
  for (int i = 2; i <= parts; ++i) {
    const double last = function(i < parts ? i * width : end), excess = 2 * std::abs(first - 2 * middle + last);
    const auto may_rise = [&](double here) { return here + excess > peak && excess > 1e-10 * here; };
    if (middle >= first && middle >= last) {
      if (may_rise(middle)) look_between((i - 2) * width, i * width, function);
    } else if (i == 2 && first >= middle && first - middle < excess) {
      if (may_rise(first)) look_between(0, width, function);
    } else if (i == parts && last >= middle && last - middle < excess) {
      if (may_rise(last)) look_between(end - width, end, function);
    }
    first = middle;
    middle = last;
  }
}

}  // namespace stickslip::detail
