// Coulomb friction under white noise in d dimensions: transforms in time. Equation numbers are those of
// docs/planar_white_noise.md.
#pragma once

#include <complex>

namespace stickslip::detail {

/// Friction opposes the velocity vector: dv = -a v / |v| dt + sqrt(2 D) dW. The density of v times exp(a |v| / 2 D)
/// obeys the Schroedinger equation of a hydrogen atom in d dimensions, whose Sturmian functions make all transforms
/// series of rational terms.

/// Moments from rest, in the units in which D and the time are 1.
struct IsotropicFromRest {
  double velocity_square;        ///< E[v_i^2]
  double covariance;             ///< E[x_i v_i]
  double displacement_variance;  ///< E[x_i^2]
};

/// @param level       a sqrt(time / D), finite and at least 0
/// @param dimensions  at least 2
IsotropicFromRest isotropic_from_rest(double level, int dimensions);

/// E|v|^n from rest in the same units. (W.13)
double isotropic_moment(double level, int order, int dimensions);

/// E[v_i(t) v_i(0)] of the stationary velocity, in units of D / a.
/// @param time        in units of D / a^2, positive
/// @param dimensions  at least 1
double isotropic_autocovariance(double time, int dimensions);

/// The two-sided spectral density of the stationary v_i at omega in units of a^2 / D, itself in units of D^3 / a^4.
/// @param omega       at least 0
/// @param dimensions  at least 1
double isotropic_spectrum(double omega, int dimensions);

}  // namespace stickslip::detail
