// Pulses fitted to a spectrum.
#pragma once

#include "stickslip/base/requirements.hpp"
#include "stickslip/excitation/spectrum.hpp"
#include "stickslip/ground/ground_motion.hpp"

namespace stickslip {

/// Symmetric rectangular pulses fitted to a spectrum: the result of `fit_pulses`.
///
///     PoissonPulses::from_earthquake(fit.rms_acceleration, fit.center_frequency_hz, duration);
struct PulseFit {
  double half_width;           ///< Dt [s]
  double half_width_error;     ///< standard error of Dt [s]; 0 for a fit to a known spectrum
  double intensity;            ///< lambda sigma^2 [m^2/s^5]; the spectrum does not determine its two factors
  double rms_acceleration;     ///< sigma_n of the pulses [m/s^2], (5.61)
  double center_frequency_hz;  ///< f_c = 1 / (2 Dt) [Hz], (5.60)
  double misfit;               ///< the integral of |S - S of the pulses| over that of S, below 1
};

/// The power spectrum of the strong motion of a record, treated as a part of a stationary process: the periodogram of
/// the part between 5 % and 95 % of the Arias intensity, without its mean, averaged over a band around each frequency
/// (Daniell). The result is a table that extends at least to twice the sampling rate of the record.
/// @param motion     a record, lines or steps, with its values between samples
/// @param bandwidth  of the average [Hz], positive and finite, at least 1 / duration of the strong part; the relative
///                   standard error of a value is 1 / sqrt(bandwidth x duration)
/// @throws std::invalid_argument  a bandwidth out of range; a motion without acceleration, see `strong_motion`
/// Reference: M. B. Priestley, Spectral Analysis and Time Series (1981), 6.2.
Spectrum estimate_spectrum(const GroundMotion& motion, double bandwidth);

/// Fits the spectrum of symmetric rectangular pulses, corrected (5.6),
///
///     S(omega) = 8 lambda sigma^2 sin^4(omega Dt / 2) / (pi omega^2)
///
/// to that of the strong motion of a record, thesis 5.6, by least squares over all frequencies, for Dt and lambda
/// sigma^2. The fit uses the periodogram without smoothing, with values 1 / (2 duration) apart. The misfit and the
/// standard error, which is also valid for records that do not consist of pulses, use its average over a third of f_c.
/// For a record that consists of pulses, the scatter of this average alone causes a misfit of about
/// 1.4 / sqrt(f_c x duration).
///
/// The standard error is that of a long stationary process, Gaussian or of pulses. Where few pulses make up the strong
/// part, its ends cut some of them, and the estimates scatter more: docs/earthquakes.md has the ratio by lambda Dt.
///
/// Such a fit depends mainly on frequencies with a high density. Low frequencies, which move a slider most, have no
/// additional weight; `strong_motion` uses the ground velocity instead. If the two frequencies differ much, the
/// spectrum of the record differs in shape from that of the pulses.
/// @param motion  a record, lines or steps
/// @throws std::invalid_argument  if there is no fit: the best pulses are longer than an eighth of the strong part, or
///                                shorter than eight of its time steps, or the misfit is 1 or more, the value without
///                                pulses, as may happen if the strong part has few pulses; a motion without
///                                acceleration
/// Cost: one FFT and about 150 sums over it, 10 to 100 ms.
PulseFit fit_pulses(const GroundMotion& motion);

/// The same fit to a known spectrum.
/// @param spectrum  of finite variance
/// @throws std::invalid_argument  an infinite variance; no fit
PulseFit fit_pulses(const Spectrum& spectrum);

}  // namespace stickslip
