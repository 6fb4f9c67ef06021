// The strong motion of a record: duration, intensity and frequency.
#pragma once

#include "stickslip/ground/ground_motion.hpp"

namespace stickslip {

/// Intensity measures of a record, and the parameters of a random process fitted to it: see `strong_motion`. Spectral
/// accelerations are available from `response_spectrum`.
struct StrongMotion {
  double peak_acceleration;             ///< of the whole record [m/s^2], the PGA
  double peak_velocity;                 ///< of the whole record [m/s], the PGV; from rest, baseline uncorrected
  double peak_displacement;             ///< of the whole record [m], the PGD; as for the PGV
  double cumulative_absolute_velocity;  ///< of the whole record [m/s], the CAV: int |n| dt
  double mean_period;                   ///< of the whole record [s], T_m; NaN as for `stickslip::mean_period`
  double arias_intensity;               ///< of the whole record [m/s]: pi / 2g int n^2 dt
  double begin, end;                    ///< when the Arias intensity reaches 5 % and 95 % of its total [s]
  double duration;                      ///< from `begin` to `end` [s], the significant duration D5-95
  double duration_5_75;                 ///< from `begin` to when it reaches 75 % [s], the significant duration D5-75
  double rms_acceleration;              ///< from `begin` to `end` [m/s^2]
  double rms_velocity;                  ///< of the ground from `begin` to `end`, about a straight line [m/s]
  double center_frequency_hz;           ///< f_c of the pulses with these rms values [Hz]
};

/// Compute the intensity measures of a record, and estimate its strong-motion duration, rms acceleration and center
/// frequency for the pulse process of thesis 5.6:
///
///     const StrongMotion s = strong_motion(record);
///     PoissonPulses::from_earthquake(s.rms_acceleration, s.center_frequency_hz, s.duration);
///
/// The strong part lies between 5 % and 95 % of the Arias intensity. The center frequency is that of the pulse process
/// with the same ratio of rms acceleration to rms velocity as the record: by (5.46), (5.61) and (5.60)
///
///     sigma_n / sigma_v = sqrt(3) / Dt,   f_c = 1 / (2 Dt) = sigma_n / (2 sqrt(3) sigma_v).
///
/// (Zero crossings are not suitable: the spectrum of the pulses (5.6) falls off so slowly that it has no second moment.
/// Its peak, at 0.742 f_c, is too broad to be located in one record.) The ground velocity is measured within the strong
/// part about its least-squares straight line, so that neither a constant error of the acceleration nor the unknown
/// initial velocity matters. For pulses, the line removes the fraction 3 Dt / T of the variance of the velocity, where
/// T is the duration. To compensate, f_c is divided by sqrt(1 + 3 / (2 f_c T)).
///
/// @param motion  a record, with either interpolation; integrals are exact
/// @throws std::invalid_argument  a motion without acceleration; a velocity that is a straight line over the whole
///                                strong part
/// Slow drifts that curve within the strong part count as velocity and lower f_c: first correct the baseline, or remove
/// periods longer than about ten seconds. The standard error of f_c from one motion of 60 pulses is about 7 %. Cost: a
/// few passes and one FFT.
/// Reference: A. Arias, A measure of earthquake intensity, in Seismic Design for Nuclear Power Plants (1970); M. D.
/// Trifunac, A. G. Brady, Bull. Seism. Soc. Am. 65 (1975), 581-626; thesis 5.6.
StrongMotion strong_motion(const GroundMotion& motion);

}  // namespace stickslip
