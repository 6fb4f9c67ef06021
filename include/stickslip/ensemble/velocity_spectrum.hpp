// The spectral density of the velocity of an ensemble.
#pragma once

#include <vector>

#include "stickslip/base/requirements.hpp"

namespace stickslip {

/// Spectral density of the velocity in the central half of the motion: Kaiser-Bessel window (4.62) with beta = 8 and a
/// mean square of one, density dt / (2 pi M) |DFT|^2 of the M windowed samples, two-sided.
struct VelocitySpectrum {
  std::vector<double> omega;    ///< [rad/s], from 0 to the Nyquist frequency
  std::vector<double> density;  ///< [m^2/s]: (m/s)^2 for each rad/s
  std::vector<double> error;    ///< its standard error
};

}  // namespace stickslip
