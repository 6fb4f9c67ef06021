// The impacts of a slider on its stops.
#pragma once

#include <cmath>
#include <cstdint>
#include <span>

#include "stickslip/base/min_max.hpp"
#include "stickslip/sliding/response.hpp"

namespace stickslip {

/// The impacts on the stop of one side.
struct SideImpacts {
  std::uint64_t count = 0;  ///< bounces included
  double speed = 0;         ///< the largest |x'| just before an impact [m/s]; 0 without impacts

  friend bool operator==(const SideImpacts&, const SideImpacts&) = default;
};

/// The impacts of a slider during a motion.
struct Impacts {
  SideImpacts forward, backward;

  /// Add an impact at x with velocity x'.
  void add(double displacement, double velocity) noexcept {
    SideImpacts& side = displacement > 0 ? forward : backward;
    ++side.count;
    side.speed = std::max(side.speed, std::abs(velocity));
  }
  bool any() const noexcept { return forward.count + backward.count > 0; }

  friend bool operator==(const Impacts&, const Impacts&) = default;
};

/// The impacts among the events of a response.
inline Impacts impacts(std::span<const Event> events) noexcept {
  Impacts result;
  for (const Event& event : events)
    if (event.kind == EventKind::impact) result.add(event.displacement, event.velocity);
  return result;
}

}  // namespace stickslip
