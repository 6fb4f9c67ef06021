// Random ground motion made of pulses that start at random times.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "stickslip/base/equal.hpp"
#include "stickslip/excitation/envelope.hpp"
#include "stickslip/excitation/pulse_shape.hpp"
#include "stickslip/excitation/spectrum.hpp"
#include "stickslip/ground/ground_motion.hpp"

namespace stickslip {

/// Options that go beyond the pulses of the thesis.
struct PoissonOptions {
  /// Whether pulses arrive from one pulse length before time zero on, so that the whole motion is stationary.
  /// Otherwise, as in thesis 5.4, no pulse begins before time zero, and the variance rises from 0 to its stationary
  /// value within one pulse length, 2 Dt. (The thesis starts the process at -10/lambda and drops all arrivals before
  /// zero. Because a Poisson process has no memory, this is equivalent to a start at zero.)
  bool stationary_start = false;

  PulseShape shape{};

  /// Distribution of the amplitudes: replaces each uniform number in (0, 1) of an array by its quantile.
  /// `PoissonPulses::each` creates it from a function of one number. Empty: Gaussian, (5.30).
  ///
  /// An amplitude is b = sigma * quantile(u). So that sigma stays the rms amplitude, on which the closed forms rest,
  /// the distribution must have a mean square of 1; the exact value is not checked, but an error of a quarter is
  /// rejected. (It should have mean 0 as well, or the ground's mean acceleration is lambda E[b] int w, thesis 5.18.)
  /// It is called concurrently if motions are generated on several threads.
  std::function<void(std::span<double>)> quantile{};

  /// Factor on the amplitude of each pulse, evaluated at its arrival (at time zero for earlier arrivals). It does not
  /// multiply the acceleration: each pulse keeps its shape and its zero net velocity, and the motion remains piecewise
  /// constant, hence exact.
  std::optional<Envelope> envelope{};
};

/// Ground acceleration as a sum of pulses of random amplitude at random times, thesis (5.16), (5.29), (5.30):
///
///     n(t) = sum_k b_k w(t - t_k)
///
/// The t_k arrive as a Poisson process of rate lambda; the b_k are independent, by default Gaussian with mean zero and
/// standard deviation sigma; w is +1 for the half width Dt, then -1 for Dt, so that a pulse displaces the ground by
/// b Dt^2 and leaves no velocity. A motion ends at its duration, even if pulses still act.
///
/// The closed forms (`variance` to `ground_displacement_variance`) apply to the stationary process without an envelope:
/// with the start of the thesis, from one pulse length, 2 Dt, on.
///
/// Immutable; motions may be generated on several threads at once.
///
/// Reference: thesis 5.3, 5.4, 5.6, corrected (5.6) of the errata; Y. K. Lin, Probabilistic Theory of Structural
/// Dynamics (1967), pp. 87-94.
class PoissonPulses {
 public:
  using Options = PoissonOptions;

  /// Motions with more steps than this on average (4.8 GB) are rejected.
  static constexpr double max_steps = 3e8;

  /// @param rate        lambda, pulses per second, positive and finite
  /// @param half_width  Dt [s], positive and finite; the unit of the shape's times
  /// @param sigma       rms amplitude of the pulses [m/s^2], positive and finite
  /// @param duration    of the motion [s], positive and finite
  /// @throws std::invalid_argument naming the rejected value; also for more than `max_steps` steps (rate x duration x
  ///         the times of the shape) and for an `Options::quantile` that is not finite or whose mean square is not 1
  PoissonPulses(double rate, double half_width, double sigma, double duration, Options options = {});

  /// Pulses like the strong motion of an earthquake, thesis 5.6:
  /// Dt = pi / omega_c = 1 / (2 f_c), (5.60); sigma = sigma_n / sqrt(2 lambda Dt), (5.61).
  /// @param rms_acceleration     sigma_n [m/s^2], positive and finite
  /// @param center_frequency_hz  f_c [Hz], positive and finite. It is a definition, not the peak of the spectrum, which
  ///                             is at 0.742 f_c (errata, 5.60)
  /// @param duration             of the strong motion [s], positive and finite
  /// @param overlap              lambda Dt, positive and finite; 0.5 leaves few gaps, and a peak of 3 to 4 sigma_n
  static PoissonPulses from_earthquake(double rms_acceleration, double center_frequency_hz, double duration,
                                       double overlap = 0.5, Options options = {});

  /// One of the four events of thesis, Table 5.1, with overlap 0.5.
  ///
  /// | name                       | sigma_n [m/s^2] | f_c [Hz] | duration [s] |
  /// |----------------------------|-----------------|----------|--------------|
  /// | great very near field      | 2.5             | 3        | 60           |
  /// | great near field           | 1               | 2.5      | 60           |
  /// | moderate very near field   | 2               | 4        | 15           |
  /// | moderate near field        | 0.5             | 3        | 15           |
  ///
  /// Very near field: within 20 km of the fault; near field: 20 to 50 km.
  /// @throws std::invalid_argument listing the names
  static PoissonPulses event(std::string_view name, Options options = {});

  /// Pulses of minimum phase whose spectral density (5.20) is a given one: `PulseShape::from_spectrum`, with a half
  /// width of 1 s, so that the shape's times are seconds. Below pi / dt `density` equals the spectrum, within the
  /// tolerance; above it, the constant pieces cause an image of the spectrum. The spectrum determines only the product
  /// lambda sigma^2; sigma is the rms of the largest acceleration of a pulse. If many pulses overlap (a large rate
  /// times the length of the pulse), the process is nearly Gaussian.
  /// @param spectrum  of the ground acceleration
  /// @param rate      lambda, pulses per second, positive and finite
  /// @param duration  of the motion [s], positive and finite
  /// @param dt, tolerance  as of `PulseShape::from_spectrum`
  /// @param options   all but the shape
  /// @throws std::invalid_argument naming the rejected value, and if `options` has another shape
  static PoissonPulses from_spectrum(const Spectrum& spectrum, double rate, double duration, double dt,
                                     double tolerance = 1e-3, Options options = {});

  /// The names of the events of `event`.
  static std::span<const std::string_view> events() noexcept;

  /// Converts a quantile function of one number for `Options::quantile`.
  template <std::regular_invocable<double> Function>
  static auto each(Function function) {
    return [function = std::move(function)](std::span<double> numbers) {
      for (double& u : numbers) u = function(u);
    };
  }

  double rate() const noexcept { return rate_; }
  double half_width() const noexcept { return half_width_; }
  double sigma() const noexcept { return sigma_; }
  double duration() const noexcept { return duration_; }
  const Options& options() const noexcept { return options_; }

  /// One motion, from 0 to `duration()`: values held between uneven times, exact. The same (seed, member) always
  /// gives the same motion.
  ///
  /// The acceleration is exactly zero where no pulse acts, and elsewhere the sum of the acting pulses to about one
  /// rounding: the running sum includes the rounding errors of its additions, and is set to zero when the last pulse
  /// ends.
  ///
  /// Cost: linear in the number of steps, three for each pulse; a shape of K times makes K, with a factor log K.
  GroundMotion sample(std::uint64_t seed, std::uint64_t member) const;

  /// The motion whose pulses arrive at the times of (seed, member) and have the amplitudes of (amplitude_seed, member):
  /// the other component of ground motion from the same source. It has the times of the motion of (seed, member).
  GroundMotion sample(std::uint64_t seed, std::uint64_t member, std::uint64_t amplitude_seed) const;

  /// The pulses of one member: arrival times [s], ascending, below `duration()`, and amplitudes [m/s^2]. The memory of
  /// the vectors is reused. Pulse i uses number i of the member's streams of exponential and normal (or uniform)
  /// numbers.
  void pulses(std::uint64_t seed, std::uint64_t member, std::vector<double>& arrivals,
              std::vector<double>& amplitudes) const {
    pulses(seed, member, seed, arrivals, amplitudes);
  }

  /// Variance of the acceleration [m^2/s^4]: lambda sigma^2 int w^2, thesis (5.19); 2 lambda Dt sigma^2, (5.61).
  double variance() const noexcept;

  /// Two-sided spectral density of the acceleration [m^2/s^3] at `omega` [rad/s]; its integral over the whole line is
  /// `variance()`. 2 pi lambda sigma^2 |w_hat|^2, thesis (5.20); for the symmetric pulse
  /// 8 lambda sigma^2 sin^4(omega Dt / 2) / (pi omega^2), four times that of the misprinted (5.6).
  double density(double omega) const noexcept;

  /// Stationary variance of the ground velocity [m^2/s^2], exact: lambda sigma^2 int (int w)^2; thesis (5.44), (5.46):
  /// 2 lambda Dt^3 sigma^2 / 3. Infinite for a shape that leaves a net velocity: there is no stationary one.
  double ground_velocity_variance() const noexcept;

  /// Variance of the ground displacement [m^2] at large times: lambda sigma^2 (int int w)^2 t; thesis (5.47), (5.49):
  /// lambda Dt^4 sigma^2 t. With the start of the thesis, the exact value beyond 2 Dt has t - 37/30 Dt instead of t.
  /// Infinite for a shape that leaves a net velocity: the variance then grows faster than linearly.
  /// @param t  [s], finite and at least 0
  double ground_displacement_variance(double t) const;

  /// Everything that the motions depend on, as one JSON object. A distribution of amplitudes is identified by its
  /// values: the hash of 1024 of its quantiles, each as a float.
  std::string configuration() const;

  /// Equal excitations give the same motions; distributions of amplitudes are compared by this hash.
  friend bool operator==(const PoissonPulses& a, const PoissonPulses& b) noexcept {
    return detail::equal(a.rate_, b.rate_) && detail::equal(a.half_width_, b.half_width_) &&
           detail::equal(a.sigma_, b.sigma_) && detail::equal(a.duration_, b.duration_) &&
           a.options_.stationary_start == b.options_.stationary_start && a.options_.shape == b.options_.shape &&
           a.quantile_hash_ == b.quantile_hash_ && a.options_.envelope == b.options_.envelope;
  }

 private:
  void pulses(std::uint64_t seed, std::uint64_t member, std::uint64_t amplitude_seed, std::vector<double>& arrivals,
              std::vector<double>& amplitudes) const;

  double rate_;
  double half_width_;
  double sigma_;
  double duration_;
  Options options_;
  std::vector<double> edges_;        // times of the shape [s]
  std::uint64_t quantile_hash_ = 0;  // 0 if there is none
};

}  // namespace stickslip
