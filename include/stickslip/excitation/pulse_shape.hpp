// The shape of the pulses of a random ground motion.
#pragma once

#include <span>
#include <vector>

#include "stickslip/base/requirements.hpp"
#include "stickslip/excitation/spectrum.hpp"

namespace stickslip {

/// The shape w of a pulse: piecewise constant, zero before it starts and after it ends.
///
/// Times are in units of the half width, so that a shape applies to pulses of any length. With a half width of 1 s they
/// are in seconds.
class PulseShape {
 public:
  /// The symmetric rectangular pulse, thesis (5.29): +1 from 0 to 1, -1 from 1 to 2.
  PulseShape() = default;

  /// @param times   limits of the pieces, finite and increasing; the first is 0
  /// @param values  of the pieces, one fewer than times, finite, not all zero
  /// @throws std::invalid_argument naming the rejected value and its index
  PulseShape(std::vector<double> times, std::vector<double> values);

  /// The shape of pulses with a given spectrum (5.20), up to a factor: its largest |value| is 1.
  ///
  /// The spectrum determines the amplitude of the Fourier transform of the pulse. Because the pulse is zero before its
  /// start, the phase is the Hilbert transform of the logarithm of the amplitude (thesis 5.3). Of all causal pulses
  /// with this amplitude, this is the minimum-phase pulse, whose energy arrives earliest. It is computed by FFT from
  /// the cepstrum, in pieces of length dt, with the amplitude corrected for the steps. For a spectrum that is zero at
  /// omega = 0 the shape leaves no velocity, up to rounding; for one that decreases as omega^4 it also leaves no
  /// displacement.
  /// @param spectrum   positive from 0 to pi / dt, except at single frequencies, where it may be zero: for other
  ///                   spectra no causal pulse exists (Paley and Wiener). Add a floor to the spectrum of a record or a
  ///                   band
  /// @param dt         length of a piece, in units of the half width (seconds for a half width of 1 s); finite and
  ///                   positive. The pulses have the spectrum below pi / dt; the steps cause an image of it above
  /// @param tolerance  the integral of |S of the pulses - S| over that of S, from 0 to pi / dt; from 1e-6 to 0.1. The
  ///                   shape ends where this tolerance permits: a smaller tolerance needs more pieces
  /// @throws std::invalid_argument naming the rejected value, or the frequency at which the spectrum is zero; also if
  ///         half a million pieces do not suffice for the pulse
  /// Cost: about ten FFTs of 4,096 to a million points.
  /// Reference: thesis 5.3; A. V. Oppenheim, R. W. Schafer, Discrete-Time Signal Processing (1989), 12.
  static PulseShape from_spectrum(const Spectrum& spectrum, double dt, double tolerance = 1e-3);

  std::span<const double> times() const noexcept { return times_; }
  std::span<const double> values() const noexcept { return values_; }
  double length() const noexcept { return times_.back(); }

  friend bool operator==(const PulseShape&, const PulseShape&) = default;

 private:
  std::vector<double> times_ = {0, 1, 2};
  std::vector<double> values_ = {1, -1};
};

}  // namespace stickslip
