// The strong motion of a record: how long, how strong, how fast.
#pragma once

#include "stickslip/ground/ground_motion.hpp"

namespace stickslip {

/// What a record's strong motion is like, for engineers and for a random process to be made like it: see
/// `strong_motion`. Spectral accelerations come from `response_spectrum`.
struct StrongMotion {
  double peak_acceleration;             ///< of the whole record [m/s^2], the PGA
  double peak_velocity;                 ///< of the whole record [m/s], the PGV; from rest, the baseline as it is
  double peak_displacement;             ///< of the whole record [m], the PGD; the same
  double cumulative_absolute_velocity;  ///< of the whole record [m/s], the CAV: int |n| dt
  double mean_period;                   ///< of the whole record [s], T_m; NaN where `stickslip::mean_period` has none
  double arias_intensity;               ///< of the whole record [m/s]: pi / 2g int n^2 dt
  double begin, end;                    ///< when 5 % and 95 % of it have come [s]
  double duration;                      ///< from `begin` to `end` [s], the significant duration D5-95
  double duration_5_75;        ///< from `begin` to when 75 % of it have come [s], the significant duration D5-75
  double rms_acceleration;     ///< within it [m/s^2]
  double rms_velocity;         ///< of the ground within it, about a straight line [m/s]
  double center_frequency_hz;  ///< f_c [Hz], of the pulses with these rms values
};

/// Computes the intensity measures of a record and estimates strong-motion duration, rms acceleration and center
/// frequency from a record, for the pulse process of thesis 5.6:
///
///     const StrongMotion s = strong_motion(record);
///     PoissonPulses::from_earthquake(s.rms_acceleration, s.center_frequency_hz, s.duration);
///
/// The strong part is that between 5 % and 95 % of the Arias intensity. The center frequency is that of the pulses
/// whose ground moves as fast for its acceleration as the record's: by (5.46), (5.61) and (5.60)
///
///     sigma_n / sigma_v = sqrt(3) / Dt,   f_c = 1 / (2 Dt) = sigma_n / (2 sqrt(3) sigma_v).
///
/// (Zero crossings would not do: the pulses' spectrum (5.6) falls off so slowly that it has no second moment; and its
/// peak, at 0.742 f_c, is too broad to be found in one record.) The ground velocity is that of the strong part about
/// its straight line of least squares: neither a constant error of the acceleration nor the unknown velocity at its
/// beginning counts. Of pulses the line takes away 3 Dt / T of the variance of the velocity, T the duration, which is
/// given back: f_c is divided by sqrt(1 + 3 / (2 f_c T)).
///
/// @param motion  a record, lines or steps; integrals are exact
/// @throws std::invalid_argument  a motion without acceleration; one whose velocity is a straight line over all its
///                                strong part
/// Slow drifts of a record that bend within the strong part count as velocity and lower f_c: correct the baseline, or
/// take out what is slower than some ten seconds, first. One motion of 60 pulses has f_c within some 7 %, one standard
/// error. Cost: some passes and one FFT.
/// Reference: A. Arias, A measure of earthquake intensity, in Seismic Design for Nuclear Power Plants (1970); M. D.
/// Trifunac, A. G. Brady, Bull. Seism. Soc. Am. 65 (1975), 581-626; thesis 5.6.
StrongMotion strong_motion(const GroundMotion& motion);

}  // namespace stickslip
