// Random ground motion with a given spectrum, by inverse Fourier transform.
#pragma once

#include <complex>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "stickslip/detail/equal.hpp"
#include "stickslip/excitation/envelope.hpp"
#include "stickslip/excitation/spectrum.hpp"
#include "stickslip/ground/ground_motion.hpp"

namespace stickslip {

/// How a `GaussianExcitation` makes its motions.
struct GaussianOptions {
  /// What the ground does between samples.
  Interpolation interpolation = Interpolation::linear;

  /// Samples joined by lines have less of the high frequencies than the sum of cosines they were taken from: the lines
  /// multiply the Fourier amplitude at omega by sinc^2(u), u = omega dt / 2, values held by sinc(u). With the
  /// correction the samples get the reciprocal, so that the motion that acts has the spectrum that was asked for,
  /// exactly at every line. (That is 1/sinc^4 for the density; thesis (4.57), (4.58) as corrected in the errata.)
  bool correct_interpolation = true;

  /// Rayleigh amplitudes: each motion is then truly Gaussian, whatever the number of lines, but its own variance
  /// differs from member to member. Otherwise the amplitudes are fixed, as in the thesis, and only phases are random.
  bool random_amplitudes = false;

  /// The line at zero frequency too, with variance S(0) domega: a random constant for each member. Without it a motion
  /// of one whole period has no mean: its ground velocity comes back to where it began, and a spectrum that reaches
  /// down to zero loses the band |omega| < domega / 2.
  bool zero_frequency = false;

  /// Samples after which the motion would repeat itself; 0 for as many as there are, at least as many. A longer period
  /// puts the lines closer together, the end of a motion no longer joins its beginning, and a motion may have a mean:
  /// the remedy for periodicity, and for bands that reach zero or are narrow. Cost grows with the period.
  std::size_t period = 0;

  /// Multiplies the samples: the motion is then no longer stationary.
  std::optional<Envelope> envelope{};

  friend bool operator==(const GaussianOptions&, const GaussianOptions&) = default;
};

/// A stationary Gaussian ground acceleration with a given spectrum, as a sum of cosines with random phases:
///
///     n(m dt) = sum_k 2 sqrt(S(k domega) domega) cos(k domega m dt + phi_k),   k = 1 .. period / 2,      thesis (4.49)
///     domega = 2 pi / (period dt)
///
/// by one inverse FFT a motion. At the Nyquist frequency pi / dt two lines of the whole line, +-k, are one cosine,
/// which is a line of variance S domega and not 2 S domega: with all lines, zero included, the samples of white noise
/// have variance 2 pi S0 / dt. (A line at an edge of the band counts in full.)
///
/// With fixed amplitudes the kurtosis of the motion is 3 - 1.5 / effective_lines(): what has to be large for a motion
/// to be Gaussian is the number of lines in the band, not that of samples.
///
/// Motions of one whole period have no mean (see `GaussianOptions::zero_frequency` and `period`).
///
/// Immutable; motions may be made on any number of threads at once. The same (seed, member) always names the same
/// motion: phases are rows of random numbers (random.hpp), one number a line. Bits are the same on machines of the same
/// instruction set with the same FFTW; elsewhere the motions agree to round-off.
///
/// Reference: M. Shinozuka, C.-M. Jan, Digital simulation of random processes and its applications, J. Sound Vib. 25
/// (1972), 111-128; thesis 4.4.
class GaussianExcitation {
 public:
  using Options = GaussianOptions;

  /// Purposes of the rows of random numbers (`RandomStream`): phasors, and exponential numbers for Rayleigh amplitudes.
  /// Number i is that of the i-th line from the first that has an amplitude.
  static constexpr std::uint32_t phase_purpose = 0x70686173, amplitude_purpose = 0x7261796c;

  /// Memory that `sample` works in, to be used again and again, by one thread at a time.
  class Workspace {
   public:
    Workspace() = default;

   private:
    friend class GaussianExcitation;
    struct Free {
      void operator()(void* memory) const noexcept;
    };
    void grow(std::size_t lines, std::size_t samples, std::size_t amplitudes);

    std::unique_ptr<std::complex<double>[], Free> lines_;
    std::unique_ptr<double[], Free> samples_;
    std::vector<double> amplitudes_;
    std::size_t room_for_lines_ = 0, room_for_samples_ = 0;
  };

  /// @param spectrum  two-sided, of the motion. One with an upper edge must have it at or below the Nyquist frequency
  ///                  pi / dt; one without is cut there, see `lost_variance`
  /// @param dt        between samples [s], positive and finite
  /// @param samples   of one motion, at least 2
  /// @throws std::invalid_argument for a value out of its range; for a band beyond the Nyquist frequency (saying
  ///         which dt would do); for a band in which no line lies (saying which period would do); for a period of
  ///         more than 2147483647 samples
  GaussianExcitation(Spectrum spectrum, double dt, std::size_t samples, Options options = {});

  /// One motion, from time 0 to `duration()`.
  /// Cost: a Philox block of 10 rounds for four lines and an FFT of the period.
  GroundMotion sample(std::uint64_t seed, std::uint64_t member) const;

  /// The same accelerations [m/s^2] into `acceleration`, `samples()` of them; nothing is allocated once `workspace` has
  /// grown.
  void sample(std::uint64_t seed, std::uint64_t member, std::span<double> acceleration, Workspace& workspace) const;

  /// The same motions sampled `factor` times finer: the same lines with the same phases and amplitudes, the same
  /// duration. Lines or steps between finer samples are nearer to the sum of cosines, so that the error of the
  /// interpolation, which falls as dt^2 (linear) or dt (constant), can be seen to vanish. Without correction every
  /// `factor`-th sample is the coarse one, to round-off.
  /// @param factor  at least 1
  /// @throws std::invalid_argument for 0, and for more than 2147483647 samples in a period
  GaussianExcitation refined(std::size_t factor) const;

  const Spectrum& spectrum() const noexcept { return spectrum_; }
  double dt() const noexcept { return dt_; }
  std::size_t samples() const noexcept { return samples_; }

  /// From the first sample to the last [s]: (samples - 1) dt.
  double duration() const noexcept { return static_cast<double>(samples_ - 1) * dt_; }

  Interpolation interpolation() const noexcept { return options_.interpolation; }

  /// With `period` the number of samples that is used.
  const Options& options() const noexcept { return options_; }

  /// How many times finer than it was made, and the time between samples then [s].
  std::size_t refinement() const noexcept { return refinement_; }
  double coarse_dt() const noexcept { return coarse_dt_; }

  /// Distance between lines [rad/s]: 2 pi / (period dt).
  double line_spacing() const noexcept { return line_spacing_; }

  /// Expected variance of the samples [m^2/s^4], the correction of the interpolation included, without the envelope.
  double variance() const noexcept;

  /// Number of lines with an amplitude.
  std::size_t lines() const noexcept;

  /// (sum p)^2 / sum p^2 over the variances p that the lines give the samples: how many lines of equal strength would
  /// be as Gaussian.
  double effective_lines() const noexcept;

  /// A period, a power of two (times the refinement), with which there are at least that many effective lines
  /// [samples]. Cost: that of making such an excitation.
  /// @throws std::invalid_argument where it would be beyond 2147483647
  std::size_t period_for(double effective_lines) const;

  /// Share of the spectrum's variance beyond the Nyquist frequency, from 0 to 1; 1 for white noise, whose variance is
  /// infinite.
  double lost_variance() const;

  /// All that the motions depend on, as one JSON object, numbers in the shortest form that reads back the same.
  std::string configuration() const;

  /// Equal excitations make the same motions.
  friend bool operator==(const GaussianExcitation& a, const GaussianExcitation& b) {
    return a.spectrum_ == b.spectrum_ && detail::equal(a.coarse_dt_, b.coarse_dt_) && a.refinement_ == b.refinement_ &&
           a.samples_ == b.samples_ && a.options_ == b.options_;
  }

 private:
  struct Transform;

  void prepare();
  bool alone(std::size_t k) const noexcept;
  double line_variance(std::size_t i) const noexcept;

  Spectrum spectrum_;
  Options options_;
  double dt_;
  std::size_t samples_;
  double coarse_dt_;            // before it was refined: its Nyquist frequency ends the band
  std::size_t refinement_ = 1;  // dt_ is coarse_dt_ / refinement_
  double line_spacing_;
  std::size_t first_line_ = 0;
  std::vector<double> target_;     // variance of the lines from first_line_ on, of the motion that acts [m^2/s^4]
  std::vector<double> amplitude_;  // their Fourier coefficients: half a cosine's amplitude, corrected [m/s^2]
  std::vector<double> envelope_;   // its values at the samples; empty where there is none
  std::shared_ptr<const Transform> transform_;
};

}  // namespace stickslip
