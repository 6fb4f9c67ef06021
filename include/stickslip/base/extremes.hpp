// The smallest and the largest of some numbers.
#pragma once

#include <cstddef>

#include "stickslip/base/requirements.hpp"

namespace stickslip::detail {

struct Extremes {
  double least, most;
};

/// @param values  `count` of them, at least 1, none NaN
/// Four at a time, so that no comparison waits for the one before.
inline Extremes extremes(const double* values, std::size_t count) noexcept {
  double least[4], most[4];
  for (int k = 0; k < 4; ++k) least[k] = most[k] = values[0];
  const auto take = [&](int k, double value) {
    least[k] = value < least[k] ? value : least[k];
    most[k] = value > most[k] ? value : most[k];
  };
  std::size_t i = 0;
  for (; i + 4 <= count; i += 4)
    for (int k = 0; k < 4; ++k) take(k, values[i + static_cast<std::size_t>(k)]);
  for (; i < count; ++i) take(0, values[i]);
  for (int k = 1; k < 4; ++k) {
    take(0, least[k]);
    take(0, most[k]);
  }
  return {least[0], most[0]};
}

}  // namespace stickslip::detail
