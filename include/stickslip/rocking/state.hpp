// The state of a block that rocks.
#pragma once

#include <cstdint>

#include "stickslip/base/requirements.hpp"

namespace stickslip {

/// What a block stands on: its base, at rest or not, one corner, or nothing.
enum class RockingMode : std::int8_t { left = -1, rest = 0, right = 1, slide = 2, flight = 3 };

/// Everything on which the future motion of a block depends. A SlenderBlock neither slides nor flies.
struct RockingState {
  double rotation = 0;  ///< theta [rad]; 0 at rest
  double rate = 0;      ///< theta' [rad/s]; 0 at rest
  RockingMode mode = RockingMode::rest;
  /// The side to which it has overturned, +1 right or -1 left; 0 if it has not.
  std::int8_t overturned = 0;
  /// The direction in which its base or its corner slips, +1 or -1; 0 if it sticks, and in flight.
  std::int8_t slip = 0;
  double displacement = 0;  ///< of the base or the corner on the ground, in flight of the center of mass [m]
  double velocity = 0;      ///< of the same [m/s]
  double rise = 0;          ///< of the center of mass in flight, above its height at rest [m]; 0 on the ground
  double climb = 0;         ///< its rate [m/s]

  /// A block that stands on its base, or tilts about a corner. A tilt of zero with a rate is that of an impact.
  static RockingState at(double rotation, double rate) noexcept {
    const double way = rotation > 0 || rotation < 0 ? rotation : rate;
    return {rotation, rate, way > 0 ? RockingMode::right : way < 0 ? RockingMode::left : RockingMode::rest};
  }
};

}  // namespace stickslip
