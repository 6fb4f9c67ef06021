// A segment of a ground motion, and of the load and normal force that it causes on a slope.
#pragma once

#include <cmath>

#include "stickslip/base/requirements.hpp"
#include "stickslip/base/units.hpp"
#include "stickslip/base/vector2.hpp"

namespace stickslip {

/// Ground acceleration n(t), linear from `start` to `end` within `duration`.
/// The load on a slider is p(t) = -n(t), the inertia force per unit mass.
struct Segment {
  double duration;  ///< [s], finite, at least 0
  double start;     ///< ground acceleration at its beginning [m/s^2], finite
  double end;       ///< ground acceleration at its end [m/s^2], finite; equal to `start` if the value is held
};

/// Horizontal ground acceleration in both directions, linear from `start` to `end` within `duration`.
struct PlanarSegment {
  double duration;  ///< [s], finite, at least 0
  Vector2 start;    ///< at its beginning [m/s^2], finite
  Vector2 end;      ///< at its end [m/s^2], finite; equal to `start` if the value is held
};

/// The load p on a slider and the normal force N under it, both per unit mass and linear within `duration`:
///     p = (g + a_z) sin(slope) - n cos(slope),    N = (g + a_z) cos(slope) + n sin(slope)
/// where n is the horizontal ground acceleration, positive toward the downhill side, and a_z the upward one [m/s^2].
/// Friction is the level of the law times N+ / g, N+ = max(N, 0).
struct LoadSegment {
  double duration;      ///< [s], finite, at least 0
  double load_start;    ///< p at its beginning [m/s^2], finite
  double load_end;      ///< p at its end [m/s^2], finite
  double normal_start;  ///< N at its beginning [m/s^2], finite
  double normal_end;    ///< N at its end [m/s^2], finite

  /// p and N at a time within it [m/s^2].
  double load(double time) const noexcept { return load_start + (load_end - load_start) * (time / duration); }
  double normal(double time) const noexcept { return normal_start + (normal_end - normal_start) * (time / duration); }
};

namespace detail {

/// The angle of the ground to the horizontal.
struct Slope {
  double sine, cosine;

  Slope(double angle) noexcept : sine(std::sin(angle)), cosine(std::cos(angle)) {}  // [rad]
};

/// The load and the normal force that a segment of ground motion causes on a slope.
/// @param n, up   horizontal and upward ground acceleration at both ends [m/s^2]
inline LoadSegment load_segment(const Segment& n, const Slope& slope, double up_start = 0, double up_end = 0) noexcept {
  const double heavy_start = standard_gravity + up_start, heavy_end = standard_gravity + up_end;
  const auto [s, c] = slope;
  return {n.duration, heavy_start * s - n.start * c, heavy_end * s - n.end * c, heavy_start * c + n.start * s,
          heavy_end * c + n.end * s};
}

}  // namespace detail

/// Ground acceleration n(t) = -amplitude cos(phase + omega t), thesis (2.28), within `duration`.
struct HarmonicSegment {
  double duration;   ///< [s], finite, at least 0
  double amplitude;  ///< B [m/s^2], positive and finite
  double omega;      ///< [rad/s], positive, with a finite square
  double phase;      ///< at its beginning [rad], at most a few periods
};

}  // namespace stickslip
