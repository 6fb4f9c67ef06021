// Single numbers for the strength of a ground motion.
#pragma once

#include "stickslip/ground/ground_motion.hpp"

namespace stickslip {

// Of the component along the axis: `component` gives the others. Velocity and displacement of the ground are integrals
// from rest at the first sample, of the acceleration as it is: an error of the baseline goes into both. Integrals and
// maxima are exact for lines and steps, but for round-off, and the maxima are in continuous time. Cost: one pass, some
// 5 ns a sample.

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
/// f_i from 0.25 to 20 Hz. Zeros are added up to 20 s, so that the frequencies are 0.05 Hz apart at most. Samples at
/// uneven times are first read off the motion at the same number of even times.
///
/// NaN where nothing is left to divide by: samples 2 s apart or more, no acceleration; and where the samples would be
/// more than 2^24. Accuracy: that of the sum, which stands for an integral over frequency. Cost: one FFT.
/// Reference: E. M. Rathje, N. A. Abrahamson, J. D. Bray, J. Geotech. Geoenviron. Eng. 124 (1998), 150-159.
double mean_period(const GroundMotion& motion);

}  // namespace stickslip
