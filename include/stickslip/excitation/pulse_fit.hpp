// Pulses fitted to a spectrum.
#pragma once

#include "stickslip/detail/requirements.hpp"
#include "stickslip/excitation/spectrum.hpp"
#include "stickslip/ground/ground_motion.hpp"

namespace stickslip {

/// Symmetric rectangular pulses whose spectrum is the nearest to one that is given: what `fit_pulses` returns.
///
///     PoissonPulses::from_earthquake(fit.rms_acceleration, fit.center_frequency_hz, duration);
struct PulseFit {
  double half_width;           ///< Dt [s]
  double half_width_error;     ///< its standard error [s]; 0 where a spectrum was given, which is not estimated
  double intensity;            ///< lambda sigma^2 [m^2/s^5], which alone counts: a spectrum does not tell the two apart
  double rms_acceleration;     ///< sigma_n of the pulses [m/s^2], (5.61)
  double center_frequency_hz;  ///< f_c = 1 / (2 Dt) [Hz], (5.60)
  double misfit;               ///< the integral of |S - S of the pulses| over that of S, below 1
};

/// The power spectrum of a record's strong motion, as if that were a portion of a stationary process: the periodogram
/// of the part between 5 % and 95 % of the Arias intensity without its mean, averaged over a band about each frequency
/// (Daniell). A table, up to twice the sampling rate of the record or more.
/// @param motion     a record, lines or steps, which count as they are between samples too
/// @param bandwidth  of the average [Hz], positive and finite, at least 1 / duration of the strong part; a value's
///                   standard error is 1 / sqrt(bandwidth x duration) of it
/// @throws std::invalid_argument  a bandwidth out of its range; a motion without acceleration, see `strong_motion`
/// Reference: M. B. Priestley, Spectral Analysis and Time Series (1981), 6.2.
Spectrum estimate_spectrum(const GroundMotion& motion, double bandwidth);

/// Fits the spectrum of symmetric rectangular pulses, corrected (5.6),
///
///     S(omega) = 8 lambda sigma^2 sin^4(omega Dt / 2) / (pi omega^2)
///
/// to that of a record's strong motion, thesis 5.6: by least squares over all frequencies, in Dt and lambda sigma^2.
/// Least squares need no smoothing: the periodogram itself is fitted. For the misfit, and for the standard error, which
/// holds for records that are not made of pulses too, its average over a third of f_c is taken; of a record that is
/// made of pulses the scatter of that alone leaves a misfit of some 1.4 / sqrt(f_c x duration).
///
/// Strong frequencies count for most in a fit of this kind, and low ones, which move a slider most, not for more than
/// others: `strong_motion` goes by the ground velocity instead. Where the two frequencies differ much the record's
/// spectrum has another form than the pulses'.
/// @param motion  a record, lines or steps
/// @throws std::invalid_argument  where nothing fits: the nearest pulses are longer than an eighth of the strong part,
///                                or shorter than eight of its time steps, or the misfit is 1 or more, as much as
///                                without any pulses; a motion without acceleration
/// Cost: one FFT and some 150 sums over it, 5 to 50 ms.
PulseFit fit_pulses(const GroundMotion& motion);

/// The same, to a spectrum that is known.
/// @param spectrum  of finite variance
/// @throws std::invalid_argument  an infinite variance; where nothing fits
PulseFit fit_pulses(const Spectrum& spectrum);

}  // namespace stickslip
