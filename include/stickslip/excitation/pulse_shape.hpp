// The shape of the pulses that random ground motion is made of.
#pragma once

#include <span>
#include <vector>

#include "stickslip/detail/requirements.hpp"
#include "stickslip/excitation/spectrum.hpp"

namespace stickslip {

/// The shape w of a pulse: piecewise constant, zero before it starts and after it ends.
///
/// Times are multiples of the half width: one shape serves pulses of any length. With a half width of 1 s they are
/// seconds.
class PulseShape {
 public:
  /// The symmetric rectangular pulse, thesis (5.29): +1 from 0 to 1, -1 from 1 to 2.
  PulseShape() = default;

  /// @param times   where the pieces begin and end, finite and increasing; the first is 0
  /// @param values  of the pieces, one fewer than times, finite, not all zero
  /// @throws std::invalid_argument naming the value refused and its index
  PulseShape(std::vector<double> times, std::vector<double> values);

  /// The shape of pulses that have a given spectrum (5.20), to within a constant: its largest |value| is 1.
  ///
  /// The spectrum gives the amplitude of the pulse's Fourier transform. That it is zero before it begins gives the
  /// phase, the Hilbert transform of the amplitude's logarithm (thesis 5.3): of all causal pulses with this amplitude
  /// it is the one of minimum phase, which has its energy earliest. It is found by FFT on the cepstrum, in pieces of
  /// length dt, for whose steps the amplitude is corrected. A spectrum that is zero at omega = 0 gets a shape that
  /// leaves no velocity, exactly but for rounding, and one that falls as omega^4 no displacement either.
  /// @param spectrum   positive from 0 to pi / dt but for single frequencies, where it may be zero: of other spectra no
  ///                   pulse that begins at a time exists (Paley and Wiener). That of a record or a band can be given a
  ///                   floor.
  /// @param dt         length of a piece, in the unit of the shape's times: seconds for a half width of 1 s; finite
  ///                   and positive. The spectrum is had below pi / dt; beyond, steps leave an image of it.
  /// @param tolerance  the integral of |S of the pulses - S| over that of S, from 0 to pi / dt; from 1e-6 to 0.1. The
  ///                   shape is cut where that allows it: a tighter one takes more pieces.
  /// @throws std::invalid_argument naming the value refused, or the frequency at which the spectrum is zero; where
  ///         half a million pieces do not hold the pulse
  /// Cost: some ten FFTs of 4,096 to a million points.
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
