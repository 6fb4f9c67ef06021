// Piecewise linear tables: checks and interpolation.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <stdexcept>
#include <string>

#include "stickslip/base/error.hpp"

namespace stickslip::detail {

/// The name of a column and the unit of its values.
struct Column {
  std::string name, unit;
};

/// Rejects a table with fewer than two points, with x that do not increase, or with negative y.
inline void require_table(const std::string& owner, std::span<const double> x, const Column& x_is,
                          std::span<const double> y, const Column& y_is) {
  if (x.size() != y.size())
    throw std::invalid_argument(owner + ": needs as many " + y_is.name + " as " + x_is.name + " values, got " +
                                std::to_string(y.size()) + " for " + std::to_string(x.size()));
  if (x.size() < 2)
    throw std::invalid_argument(owner + ": a table needs at least two points, got " + std::to_string(x.size()));
  const auto element = [&](const Column& is, std::size_t i) {
    return owner + ": " + is.name + "[" + std::to_string(i) + "]";
  };
  for (std::size_t i = 0; i < x.size(); ++i) {
    require(std::isfinite(x[i]), element(x_is, i) + " must be finite", x[i], x_is.unit);
    require(i == 0 || x[i] > x[i - 1],
            element(x_is, i) + " must come after " + shortest(x[i == 0 ? 0 : i - 1]) + " " + x_is.unit, x[i],
            x_is.unit);
    require(std::isfinite(y[i]) && y[i] >= 0, element(y_is, i) + " must be finite and at least 0", y[i], y_is.unit);
  }
}

/// The value of the table at `at`: linear between its points, zero outside.
inline double interpolated(std::span<const double> x, std::span<const double> y, double at) noexcept {
  if (!(at >= x.front() && at <= x.back())) return std::isnan(at) ? at : 0;
  const auto right = static_cast<std::size_t>(std::ranges::upper_bound(x, at) - x.begin());
  if (right == x.size()) return y.back();
  const double share = (at - x[right - 1]) / (x[right] - x[right - 1]);
  return y[right - 1] + share * (y[right] - y[right - 1]);
}

}  // namespace stickslip::detail
