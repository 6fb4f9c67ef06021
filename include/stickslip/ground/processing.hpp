// Processing of ground motions: scaling, resampling, cutting, rotating, removing a trend, and integrating.
//
// Functions that return a motion process all its components; scaling targets and integrals refer to the axis.
#pragma once

#include <optional>
#include <vector>

#include "stickslip/ground/ground_motion.hpp"

namespace stickslip {

/// Ground velocity and displacement at the samples, from rest at the first one.
struct GroundHistory {
  std::vector<double> velocity;      ///< [m/s]
  std::vector<double> displacement;  ///< [m]
};

/// Integrate the acceleration along the axis; exact to round-off for both interpolations.
GroundHistory ground_history(const GroundMotion& motion);

/// The target of `scaled_to`: exactly one value, positive and finite.
struct ScaleTarget {
  std::optional<double> peak_acceleration;  ///< PGA [m/s^2]
  std::optional<double> arias_intensity;    ///< [m/s]
  std::optional<double> peak_velocity;      ///< PGV [m/s], from rest, without baseline correction
};

/// All components of the motion multiplied by the positive factor that gives the axis this PGA, Arias intensity or PGV.
/// @throws std::invalid_argument  no target or several; a target that is not positive and finite; a motion of zeros
GroundMotion scaled_to(const GroundMotion& motion, const ScaleTarget& target);

/// The motion at 0, dt, 2 dt, ... after its first sample, evaluated with its own interpolation. No filter is applied: a
/// shorter step adds no content, and a longer step aliases higher frequencies. If the duration is not a multiple of dt,
/// the remainder at the end is dropped. Times begin at 0.
/// @param dt  [s], positive, at most the duration
/// @throws std::invalid_argument  dt out of range; more than 10^9 samples
GroundMotion resampled(const GroundMotion& motion, double dt);

/// The part of the motion from `begin` to `end`, interpolated at both ends where there is no sample. Times begin at 0.
/// A constant time step is kept if both ends coincide with samples (within 1e-6 steps).
/// @param begin, end  [s], times of the motion, begin < end
/// @throws std::invalid_argument  times outside the motion, or not in order
GroundMotion cut(const GroundMotion& motion, double begin, double end);

/// The motion in rotated horizontal axes: the new axis is `degrees` from the old one toward the transverse one,
///
///     n'(t) = n cos a + t sin a,   t'(t) = t cos a - n sin a,
///
/// with n along the axis, t perpendicular to it and a the angle. The vertical component is unchanged. Rotations by
/// multiples of 90 degrees are exact. An orientation with an azimuth is rotated too; any other is dropped.
/// @param degrees  finite
/// @throws std::invalid_argument  a motion without a transverse component; an angle that is not finite
GroundMotion rotated(const GroundMotion& motion, double degrees);

/// The motion minus its least-squares polynomial trend over time: order 0 removes the mean, so that the ground velocity
/// ends at zero; order 1 removes a straight line. The fit is exact for both interpolations. A trend of order 2 or
/// higher is subtracted at the samples; from values that are held, its mean over each step is subtracted.
/// @param order  from 0 to 10
/// @throws std::invalid_argument  the order is out of range
GroundMotion detrended(const GroundMotion& motion, int order = 0);

}  // namespace stickslip
