// Harmonic ground motion.
#pragma once

#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

#include "stickslip/base/error.hpp"
#include "stickslip/base/min_max.hpp"
#include "stickslip/ground/ground_motion.hpp"

namespace stickslip {

/// A harmonic ground acceleration, thesis (2.28): -n(t) = B cos(omega t), from t = 0 on.
///
/// The ground motion is not sampled: the slider is integrated under the exact cosine. Samples only define the times at
/// which the response is returned: 0, dt, 2 dt, ... and the end.
class HarmonicMotion {
 public:
  /// @param amplitude  B [m/s^2], positive and at most 1e100
  /// @param omega      angular frequency [rad/s], positive, with a finite square
  /// @param duration   [s], positive and finite, at most 2^45 periods (at that time the round-off of a double is a
  ///                   phase of 0.05 rad)
  /// @param dt         time between samples of the response [s], positive and finite; if it exceeds the duration, only
  ///                   the start and the end are samples; at most 2^40 samples
  /// @throws std::invalid_argument names the value
  HarmonicMotion(double amplitude, double omega, double duration, double dt)
      : amplitude_(amplitude), omega_(omega), duration_(duration), dt_(dt) {
    check();
    detail::require(std::isfinite(dt) && dt > 0, "HarmonicMotion: dt must be positive and finite", dt, "s");
    detail::require(duration / dt <= max_samples,
                    "HarmonicMotion: dt must leave at most 2^40 samples of " + detail::shortest(duration) + " s", dt,
                    "s");
    // No short last step if the duration is a multiple of dt up to round-off.
    segments_ = static_cast<std::size_t>(std::max(std::ceil(duration / dt * (1 - 0x1p-50)), 1.0));
  }

  /// The response is sampled 64 times per period.
  HarmonicMotion(double amplitude, double omega, double duration)
      : HarmonicMotion(amplitude, omega, duration, usual_dt(amplitude, omega, duration)) {}

  double amplitude() const noexcept { return amplitude_; }
  double omega() const noexcept { return omega_; }
  double period() const noexcept { return 2 * std::numbers::pi / omega_; }
  double duration() const noexcept { return duration_; }

  /// Time between samples [s]; the last step may be shorter.
  double dt() const noexcept { return dt_; }

  std::size_t samples() const noexcept { return segments_ + 1; }
  std::size_t segments() const noexcept { return segments_; }

  /// Time of sample i [s]; after the last sample, times continue with `last_step`.
  double time(std::size_t i) const noexcept {
    return i < segments_ ? static_cast<double>(i) * dt_ : duration_ + static_cast<double>(i - segments_) * dt_;
  }

  /// The step after the end of the motion [s].
  double last_step() const noexcept { return dt_; }

  /// Ground acceleration n at a time [m/s^2].
  double acceleration(double time) const noexcept { return -amplitude_ * std::cos(phase(time)); }

  /// omega t minus its whole cycles [rad], exact to round-off for any number of cycles.
  /// @param rounding  rounding error of the time, which is added to it [s]
  double phase(double time, double rounding = 0) const noexcept {
    // The fused multiply-add gives the rounding error of the product; 2 pi has 150 bits.
    constexpr double high = 2 * std::numbers::pi, middle = 0x1.1a62633145c07p-52, low = -0x1.f1976b7ed8fbcp-108;
    const double angle = omega_ * time, rest = std::fma(omega_, time, -angle) + omega_ * rounding;
    const double cycles = std::nearbyint(angle / high);
    return std::fma(-cycles, high, angle) + (rest - cycles * middle - cycles * low);
  }

  /// The same motion as a GroundMotion, with straight lines between samples.
  /// @param step  time between samples [s], positive; the last sample may be after the end
  /// @throws std::invalid_argument  as for GroundMotion
  GroundMotion sampled(double step) const {
    detail::require(std::isfinite(step) && step > 0 && duration_ / step <= max_samples,
                    "HarmonicMotion: step must be positive and leave at most 2^40 samples", step, "s");
    std::vector<double> n(static_cast<std::size_t>(std::max(std::ceil(duration_ / step * (1 - 0x1p-50)), 1.0)) + 1);
    for (std::size_t i = 0; i < n.size(); ++i) n[i] = acceleration(static_cast<double>(i) * step);
    return {std::move(n), step};
  }

 private:
  static constexpr double max_samples = 0x1p40, max_periods = 0x1p45;

  void check() const {
    detail::require(amplitude_ > 0 && amplitude_ <= GroundMotion::max_acceleration,
                    "HarmonicMotion: amplitude must be positive and at most 1e100 m/s^2", amplitude_, "m/s^2");
    detail::require(omega_ > 0 && std::isfinite(omega_ * omega_) && std::isfinite(period()),
                    "HarmonicMotion: omega must be positive, its square and its period finite", omega_, "rad/s");
    detail::require(duration_ > 0 && std::isfinite(duration_), "HarmonicMotion: duration must be positive and finite",
                    duration_, "s");
    detail::require(duration_ / period() <= max_periods, "HarmonicMotion: duration must be at most 2^45 periods",
                    duration_, "s");
  }

  static double usual_dt(double amplitude, double omega, double duration) {
    return HarmonicMotion(amplitude, omega, duration, duration).period() / 64;
  }

  double amplitude_, omega_, duration_, dt_;
  std::size_t segments_ = 0;
};

}  // namespace stickslip
