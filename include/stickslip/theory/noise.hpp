// Descriptions of noise for the theories: white noise, stationary noise with a spectrum, filtered noise with an
// envelope.
#pragma once

#include <optional>
#include <utility>
#include <variant>

#include "stickslip/excitation/envelope.hpp"
#include "stickslip/excitation/gaussian.hpp"
#include "stickslip/excitation/poisson.hpp"
#include "stickslip/excitation/spectrum.hpp"
#include "stickslip/theory/shaping_filter.hpp"

namespace stickslip::theory {

/// White ground acceleration, given by its two-sided level S0, R(t) = 2 pi S0 delta(t): a number, a white spectrum, or
/// an excitation that has one.
class WhiteLevel {
 public:
  /// @param s0  [m^2/s^3], positive and finite
  /// @throws std::invalid_argument naming the value
  WhiteLevel(double s0);

  /// @throws std::invalid_argument unless the spectrum is white
  WhiteLevel(const Spectrum& spectrum);

  /// @throws std::invalid_argument unless the spectrum is white and has a line at zero frequency, or with an envelope
  WhiteLevel(const GaussianExcitation& excitation);

  double s0() const noexcept { return s0_; }

 private:
  double s0_;
};

/// Stationary Gaussian ground acceleration, given by its spectrum. A number is the level of white noise.
class StationaryNoise {
 public:
  StationaryNoise(Spectrum spectrum) : spectrum_(std::move(spectrum)) {}
  StationaryNoise(WhiteLevel level) : spectrum_(Spectrum::white(level.s0())) {}

  /// @param s0  [m^2/s^3], positive and finite
  /// @throws std::invalid_argument naming the value
  StationaryNoise(double s0) : StationaryNoise(WhiteLevel(s0)) {}

  /// @throws std::invalid_argument with an envelope; for white noise without a line at zero frequency
  StationaryNoise(const GaussianExcitation& excitation);

  const Spectrum& spectrum() const noexcept { return spectrum_; }

 private:
  Spectrum spectrum_;
};

/// Ground acceleration that is filtered white noise with an envelope. This determines the second moments of an
/// excitation. A number is the level of white noise.
class ShapedNoise {
 public:
  ShapedNoise(WhiteLevel level) : source_(Spectrum::white(level.s0())) {}

  /// @param s0  [m^2/s^3], positive and finite
  /// @throws std::invalid_argument naming the value
  ShapedNoise(double s0) : ShapedNoise(WhiteLevel(s0)) {}

  ShapedNoise(Spectrum spectrum) : source_(std::move(spectrum)) {}
  ShapedNoise(ShapingFilter filter) : source_(std::move(filter)) {}

  /// The stationary motion, from time zero on, times the envelope.
  /// @throws std::invalid_argument for white noise without a line at zero frequency
  ShapedNoise(const GaussianExcitation& excitation);

  /// Pulses have the second moments of white noise through a filter whose impulse response is the pulse; the envelope
  /// multiplies the white noise.
  /// @throws std::invalid_argument for amplitudes whose mean is not 0
  ShapedNoise(const PoissonPulses& pulses);

  /// @throws std::invalid_argument  if no filter fits, see `ShapingFilter::of`
  ShapingFilter filter(const ShapingFilter::Fit& fit) const;

  /// The level if the noise is white and stationary from time zero on; otherwise none.
  std::optional<double> white() const;

  const std::optional<Envelope>& envelope() const noexcept { return envelope_; }

  /// Whether the envelope multiplies the white noise that enters the filter, not the acceleration that leaves it.
  bool envelope_at_source() const noexcept { return envelope_at_source_; }

  /// Whether the acceleration has its stationary variance at time zero; otherwise the filter starts from rest.
  bool stationary_start() const noexcept { return stationary_start_; }

  /// Whether the ground velocity of each member returns to its initial value although the spectrum does not vanish at
  /// zero frequency: Gaussian excitation over one whole period, without the line at zero frequency.
  bool returns() const noexcept { return returns_; }

 private:
  std::variant<Spectrum, ShapingFilter, PoissonPulses> source_;
  std::optional<Envelope> envelope_{};
  bool envelope_at_source_ = false, stationary_start_ = true, returns_ = false;
};

}  // namespace stickslip::theory
