// Ground motions made from a ground motion: scaled, resampled, cut, rotated, without a trend; and its integrals.
//
// What makes a motion does the same to all its components; targets and integrals are those of the axis.
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

/// Integrates the acceleration along the axis: exact for lines and steps, but for round-off.
GroundHistory ground_history(const GroundMotion& motion);

/// What `scaled_to` aims at: exactly one of them, positive and finite.
struct ScaleTarget {
  std::optional<double> peak_acceleration;  ///< PGA [m/s^2]
  std::optional<double> arias_intensity;    ///< [m/s]
  std::optional<double> peak_velocity;      ///< PGV [m/s], from rest, with the baseline as it is
};

/// The motion, with all its components, times the positive factor that gives its axis this PGA, Arias intensity or PGV.
/// @throws std::invalid_argument  none or several targets; one that is not positive and finite; a motion of zeros
GroundMotion scaled_to(const GroundMotion& motion, const ScaleTarget& target);

/// The motion read off at 0, dt, 2 dt, ... after its first sample: on its straight lines, or the value that is held.
/// Nothing is filtered: below the old step nothing is added, and a longer step folds higher frequencies back. Where the
/// duration is no multiple of dt, the rest at the end is left out. Times begin at 0.
/// @param dt  [s], positive, at most the duration
/// @throws std::invalid_argument  dt out of range; more than 10^9 samples
GroundMotion resampled(const GroundMotion& motion, double dt);

/// The part of the motion from `begin` to `end`, at whose ends it is read off where there is no sample. Times begin at
/// 0; even times stay even where both ends are samples (within 1e-6 steps).
/// @param begin, end  [s], times of the motion, begin < end
/// @throws std::invalid_argument  times outside the motion, or not in order
GroundMotion cut(const GroundMotion& motion, double begin, double end);

/// The motion with its horizontal axes turned: the new axis is `degrees` from the old one toward the transverse one,
///
///     n'(t) = n cos a + t sin a,   t'(t) = t cos a - n sin a,
///
/// with n along the axis, t across it and a the angle. The vertical component stays as it is. Turns by multiples of 90
/// degrees are exact. An orientation with an azimuth becomes the new one; another is dropped.
/// @param degrees  finite
/// @throws std::invalid_argument  a motion without a transverse component; an angle that is not finite
GroundMotion rotated(const GroundMotion& motion, double degrees);

/// The motion without its polynomial trend of least squares over time: order 0 takes away the mean, after which the
/// ground velocity ends at zero; 1 a straight line. The fit is exact for lines and steps. A trend of order 2 and more
/// is taken away at the samples, and its mean over each step from a value that is held.
/// @param order  from 0 to 10
/// @throws std::invalid_argument  another order
GroundMotion detrended(const GroundMotion& motion, int order = 0);

}  // namespace stickslip
