// Scalar measures of the intensity of a ground motion.
#pragma once

#include "stickslip/ground/ground_motion.hpp"

namespace stickslip {

// All measures use the component along the axis; `component` returns the others. Ground velocity and displacement are
// integrals of the uncorrected acceleration, from rest at the first sample: a baseline error affects both. Integrals
// and maxima are exact to round-off for both interpolations, and the maxima are in continuous time. Cost: one pass,
// about 5 ns per sample.

/// Largest magnitude of the ground velocity [m/s], the PGV.
double peak_velocity(const GroundMotion& motion);

/// Largest magnitude of the ground displacement [m], the PGD.
double peak_displacement(const GroundMotion& motion);

/// int |n| dt [m/s], the CAV.
double cumulative_absolute_velocity(const GroundMotion& motion);

/// pi / 2g int n^2 dt [m/s].
/// Reference: A. Arias, A measure of earthquake intensity, in Seismic Design for Nuclear Power Plants (1970).
double arias_intensity(const GroundMotion& motion);

/// Mean period T_m [s]: sum C_i^2 / f_i over sum C_i^2, C_i the Fourier amplitudes of the samples at the frequencies
/// f_i from 0.25 to 20 Hz. A shorter motion is padded with zeros to 20 s, so that the frequencies are at most 0.05 Hz
/// apart. A motion with uneven times is first resampled at the same number of even times.
///
/// NaN if the denominator is zero (samples 2 s apart or more, no acceleration) or if there would be more than 2^24
/// samples. Accuracy: that of the sum as an approximation of an integral over frequency. Cost: one FFT.
/// Reference: E. M. Rathje, N. A. Abrahamson, J. D. Bray, J. Geotech. Geoenviron. Eng. 124 (1998), 150-159.
double mean_period(const GroundMotion& motion);

}  // namespace stickslip
