// A pulse by its spectrum, with its size.
#pragma once

#include "stickslip/excitation/pulse_shape.hpp"

namespace stickslip::detail {

struct SpectralPulse {
  PulseShape shape;
  double peak;  ///< largest acceleration of the pulses, where one of them arrives a second [m/s^2]
};

/// As `PulseShape::from_spectrum`.
SpectralPulse spectral_pulse(const Spectrum& spectrum, double dt, double tolerance);

}  // namespace stickslip::detail
