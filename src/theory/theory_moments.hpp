// Helpers for theories of moments: checks of times and of results, moments without scatter.
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <string>

#include "stickslip/base/error.hpp"
#include "stickslip/statistics/moments.hpp"

namespace stickslip::detail {

/// Rejects times that are not finite, are negative, or do not increase.
inline void check_times(const std::string& noun, std::span<const double> times) {
  for (std::size_t i = 0; i < times.size(); ++i) {
    require(std::isfinite(times[i]) && times[i] >= 0, noun + ": times must be finite and at least 0", times[i], "s");
    if (i > 0)
      require(times[i] > times[i - 1], noun + ": times must increase; after " + shortest(times[i - 1]) + " s", times[i],
              "s");
  }
}

/// Zeros at `times`, the growth rate unknown.
inline Moments moments_at(std::span<const double> times) {
  const std::vector<double> zero(times.size());
  const Estimates none{zero, zero};
  return {
      {times.begin(), times.end()}, none, none, none, none, none, {std::numeric_limits<double>::quiet_NaN(), 0}, {}};
}

/// Rejects moments beyond the range of doubles.
inline void check_range(const std::string& noun, double time, double figure) {
  if (!std::isfinite(figure))
    throw std::invalid_argument(noun + ": the moments at " + shortest(time) + " s exceed the range of doubles");
}

}  // namespace stickslip::detail
