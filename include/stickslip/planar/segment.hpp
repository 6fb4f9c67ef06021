// The load that a segment of a ground motion in two horizontal directions causes.
#pragma once

#include "stickslip/base/vector2.hpp"
#include "stickslip/ground/segment.hpp"

namespace stickslip {

/// The load p on a slider in the plane and the normal force N under it, both per unit mass and linear within
/// `duration`; see PlanarSlider.
struct PlanarLoadSegment {
  double duration;      ///< [s], finite, at least 0
  Vector2 load_start;   ///< p at its beginning [m/s^2], finite
  Vector2 load_end;     ///< p at its end [m/s^2], finite
  double normal_start;  ///< N at its beginning [m/s^2], finite
  double normal_end;    ///< N at its end [m/s^2], finite

  /// p and N at a time within it [m/s^2].
  Vector2 load(double time) const noexcept { return load_start + (time / duration) * (load_end - load_start); }
  double normal(double time) const noexcept { return normal_start + (normal_end - normal_start) * (time / duration); }
};

namespace detail {

/// The load and the normal force that a segment of ground motion causes on a slope.
/// @param up  upward ground acceleration at both ends [m/s^2]
inline PlanarLoadSegment load_segment(const PlanarSegment& s, const Slope& slope, double up_start = 0,
                                      double up_end = 0) noexcept {
  const LoadSegment axis = load_segment(Segment{s.duration, s.start.axis, s.end.axis}, slope, up_start, up_end);
  return {s.duration,
          {axis.load_start, -s.start.transverse},
          {axis.load_end, -s.end.transverse},
          axis.normal_start,
          axis.normal_end};
}

}  // namespace detail
}  // namespace stickslip
