// The smallest distances to stops among sliders.
#pragma once

#include <algorithm>
#include <limits>

#include "stickslip/slider/stops.hpp"

namespace stickslip {

/// The smallest distance of a stop from x = 0 on each side, among the members of an ensemble [m]; infinite where no
/// member has a stop.
struct SmallestGaps {
  double forward = std::numeric_limits<double>::infinity();
  double backward = std::numeric_limits<double>::infinity();

  double smallest() const noexcept { return std::min(forward, backward); }
  void include(const SmallestGaps& other) noexcept {
    forward = std::min(forward, other.forward);
    backward = std::min(backward, other.backward);
  }

  friend bool operator==(const SmallestGaps&, const SmallestGaps&) = default;
};

inline SmallestGaps gaps_of(const Stops& stops) noexcept { return {stops.forward(), stops.backward()}; }

}  // namespace stickslip
