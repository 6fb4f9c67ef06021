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

#include "stickslip/base/equal.hpp"
#include "stickslip/excitation/envelope.hpp"
#include "stickslip/excitation/spectrum.hpp"
#include "stickslip/ground/ground_motion.hpp"

namespace stickslip {

/// Options of `GaussianExcitation`.
struct GaussianOptions {
  /// Interpolation between samples.
  Interpolation interpolation = Interpolation::linear;

  /// Whether to correct for the interpolation. Straight lines between samples reduce the high frequencies of the sum of
  /// cosines: the Fourier amplitude at omega is multiplied by sinc^2(u), u = omega dt / 2, and by sinc(u) for held
  /// values. The correction multiplies the samples by the reciprocal, so that the motion that acts has exactly the
  /// specified spectrum at every line. (For the density the factor is 1/sinc^4; thesis (4.57), (4.58) as corrected in
  /// the errata.)
  bool correct_interpolation = true;

  /// Whether amplitudes are random (Rayleigh distributed). The process is then Gaussian for any number of lines, but
  /// the variance of a single motion differs from member to member. Otherwise amplitudes are fixed, as in the thesis,
  /// and only phases are random.
  bool random_amplitudes = false;

  /// Whether to include the line at zero frequency, with variance S(0) domega: a random constant for each member.
  /// Without it a motion of one whole period has a mean of zero, so that its ground velocity returns to the initial
  /// value, and a spectrum that extends to zero loses the band |omega| < domega / 2.
  bool zero_frequency = false;

  /// Number of samples after which the motion would repeat itself, at least `samples`; 0 means `samples`. A longer
  /// period reduces the distance between lines, removes the periodicity within a motion, and allows a motion a nonzero
  /// mean. Use it for narrow bands and for bands that extend to zero. The cost grows with the period.
  std::size_t period = 0;

  /// Factor on the samples by time; the motion is then not stationary.
  std::optional<Envelope> envelope{};

  friend bool operator==(const GaussianOptions&, const GaussianOptions&) = default;
};

/// A stationary Gaussian ground acceleration with a given spectrum, as a sum of cosines with random phases:
///
///     n(m dt) = sum_k 2 sqrt(S(k domega) domega) cos(k domega m dt + phi_k),   k = 1 .. period / 2,      thesis (4.49)
///     domega = 2 pi / (period dt)
///
/// by one inverse FFT per motion. At the Nyquist frequency pi / dt the two lines +-k are a single cosine, with variance
/// S domega instead of 2 S domega. With all lines, including zero, the samples of white noise therefore have the
/// variance 2 pi S0 / dt. (A line at an edge of the band counts in full.)
///
/// With fixed amplitudes the kurtosis of the motion is 3 - 1.5 / effective_lines(): a motion is Gaussian if the number
/// of lines in the band is large, not the number of samples.
///
/// Motions of one whole period have a mean of zero (see `GaussianOptions::zero_frequency` and `period`).
///
/// Immutable; motions may be made on any number of threads at once. The same (seed, member) always gives the same
/// motion: phases are from streams of random numbers (random.hpp), one number per line. The bits are the same on
/// machines with the same instruction set and the same FFTW; elsewhere the motions agree to round-off.
///
/// Reference: M. Shinozuka, C.-M. Jan, Digital simulation of random processes and its applications, J. Sound Vib. 25
/// (1972), 111-128; thesis 4.4.
class GaussianExcitation {
 public:
  using Options = GaussianOptions;

  /// Purposes of the streams of random numbers (`RandomStream`): phasors, and exponential numbers for Rayleigh
  /// amplitudes. Number i belongs to the i-th line, counted from the first with a nonzero amplitude.
  static constexpr std::uint32_t phase_purpose = 0x70686173, amplitude_purpose = 0x7261796c;

  /// Reusable working memory of `sample`, for one thread at a time.
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
  ///                  pi / dt; others are truncated there, see `lost_variance`
  /// @param dt        between samples [s], positive and finite
  /// @param samples   of one motion, at least 2
  /// @throws std::invalid_argument for a value out of range; for a band beyond the Nyquist frequency (stating a
  ///         suitable dt); for a band without a line (stating a suitable period); for a period of more than 2147483647
  ///         samples
  GaussianExcitation(Spectrum spectrum, double dt, std::size_t samples, Options options = {});

  /// One motion, from time 0 to `duration()`.
  /// Cost: a Philox block of 10 rounds for four lines and an FFT of the period.
  GroundMotion sample(std::uint64_t seed, std::uint64_t member) const;

  /// Writes the same accelerations [m/s^2] to `acceleration`, which holds `samples()` values. Allocates nothing if
  /// `workspace` was used before.
  void sample(std::uint64_t seed, std::uint64_t member, std::span<double> acceleration, Workspace& workspace) const;

  /// The same motions sampled `factor` times finer: the same lines with the same phases and amplitudes, the same
  /// duration. Lines or steps between finer samples are closer to the sum of cosines: use it to check that the
  /// error of the interpolation decreases as dt^2 (linear) or dt (constant). Without correction every `factor`-th
  /// sample equals the coarse one, to round-off.
  /// @param factor  at least 1
  /// @throws std::invalid_argument for 0, and for more than 2147483647 samples in a period
  GaussianExcitation refined(std::size_t factor) const;

  const Spectrum& spectrum() const noexcept { return spectrum_; }
  double dt() const noexcept { return dt_; }
  std::size_t samples() const noexcept { return samples_; }

  /// From the first sample to the last [s]: (samples - 1) dt.
  double duration() const noexcept { return static_cast<double>(samples_ - 1) * dt_; }

  Interpolation interpolation() const noexcept { return options_.interpolation; }

  /// The options, with `period` replaced by the number of samples in use.
  const Options& options() const noexcept { return options_; }

  /// The refinement factor, and the time between samples before the refinement [s].
  std::size_t refinement() const noexcept { return refinement_; }
  double coarse_dt() const noexcept { return coarse_dt_; }

  /// Distance between lines [rad/s]: 2 pi / (period dt).
  double line_spacing() const noexcept { return line_spacing_; }

  /// Expected variance of the samples [m^2/s^4], the correction of the interpolation included, without the envelope.
  double variance() const noexcept;

  /// Number of lines with an amplitude.
  std::size_t lines() const noexcept;

  /// The number of lines of equal strength with the same kurtosis: (sum p)^2 / sum p^2 over the variances p of the
  /// lines.
  double effective_lines() const noexcept;

  /// A period [samples], a power of two (times the refinement), that gives at least `lines` effective lines. Cost: that
  /// of constructing such an excitation.
  /// @throws std::invalid_argument if it would exceed 2147483647
  std::size_t period_for(double effective_lines) const;

  /// Fraction of the variance of the spectrum beyond the Nyquist frequency, from 0 to 1; 1 for white noise, whose
  /// variance is infinite.
  double lost_variance() const;

  /// Everything that the motions depend on, as one JSON object, with numbers in the shortest form that reads back
  /// exactly.
  std::string configuration() const;

  /// Equal excitations give the same motions.
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
  double coarse_dt_;            // before the refinement: its Nyquist frequency is the upper limit of the band
  std::size_t refinement_ = 1;  // dt_ is coarse_dt_ / refinement_
  double line_spacing_;
  std::size_t first_line_ = 0;
  std::vector<double> target_;     // variance of the lines from first_line_ on, of the motion that acts [m^2/s^4]
  std::vector<double> amplitude_;  // their Fourier coefficients: half a cosine's amplitude, corrected [m/s^2]
  std::vector<double> envelope_;   // values at the samples; empty if there is no envelope
  std::shared_ptr<const Transform> transform_;
};

}  // namespace stickslip
