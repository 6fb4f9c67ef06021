// The motion of a floor: of the mass of a slider, or of a cart, for the equipment on it.
#pragma once

#include <cstddef>
#include <vector>

#include "stickslip/base/direction.hpp"
#include "stickslip/base/vector2.hpp"
#include "stickslip/ground/response_spectrum.hpp"
#include "stickslip/ground/segment.hpp"

namespace stickslip {

/// The absolute acceleration of a floor in one direction: segments, and impulses at impacts. Its `response_spectrum` is
/// a floor spectrum.
struct FloorMotion {
  std::vector<Segment> segments;  ///< consecutive, accelerations [m/s^2]
  std::vector<Impulse> impulses;  ///< jumps of the velocity between them, in order
};

/// A jump of the velocity of a floor in the plane, between two segments of its acceleration.
struct PlanarImpulse {
  std::size_t before;  ///< index of the segment that follows
  Vector2 velocity;    ///< after minus before the jump [m/s]
};

/// The absolute acceleration of a floor in both horizontal directions: segments, and impulses at impacts.
struct PlanarFloorMotion {
  std::vector<PlanarSegment> segments;  ///< consecutive, accelerations [m/s^2]
  std::vector<PlanarImpulse> impulses;  ///< jumps of the velocity between them, in order

  /// The component in a direction.
  /// @param degrees  clockwise from the axis, finite; 90 is the transverse direction
  FloorMotion along(double degrees) const {
    const auto [c, s] = detail::cos_sin(degrees);
    const Vector2 direction{c, s};
    FloorMotion floor;
    for (const PlanarSegment& part : segments)
      floor.segments.push_back({part.duration, dot(part.start, direction), dot(part.end, direction)});
    for (const PlanarImpulse& impulse : impulses)
      floor.impulses.push_back({impulse.before, dot(impulse.velocity, direction)});
    return floor;
  }
};

}  // namespace stickslip
