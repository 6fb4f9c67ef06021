// The noise that theories take: white by its level, stationary by its spectrum, or shaped by a filter and an envelope.
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

/// White ground acceleration by its level S0, two-sided, R(t) = 2 pi S0 delta(t): a number, a white spectrum, or an
/// excitation that has one.
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

/// Stationary Gaussian ground acceleration by its spectrum. A number is the level of white noise.
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

/// Ground acceleration that is white noise through a filter, with an envelope: all that second moments know of an
/// excitation. A number is the level of white noise.
class ShapedNoise {
 public:
  ShapedNoise(WhiteLevel level) : source_(Spectrum::white(level.s0())) {}

  /// @param s0  [m^2/s^3], positive and finite
  /// @throws std::invalid_argument naming the value
  ShapedNoise(double s0) : ShapedNoise(WhiteLevel(s0)) {}

  ShapedNoise(Spectrum spectrum) : source_(std::move(spectrum)) {}
  ShapedNoise(ShapingFilter filter) : source_(std::move(filter)) {}

  /// The spectrum, from time zero on, times the envelope.
  /// @throws std::invalid_argument for white noise without a line at zero frequency
  ShapedNoise(const GaussianExcitation& excitation);

  /// Pulses have the second moments of white noise through a filter that answers an impulse with the pulse; the
  /// envelope multiplies that white noise.
  /// @throws std::invalid_argument for amplitudes whose mean is not 0
  ShapedNoise(const PoissonPulses& pulses);

  /// @throws std::invalid_argument  where no filter fits, see `ShapingFilter::of`
  ShapingFilter filter(const ShapingFilter::Fit& fit) const;

  /// The level of white noise that is stationary from time zero on; none for other noise.
  std::optional<double> white() const;

  const std::optional<Envelope>& envelope() const noexcept { return envelope_; }

  /// Whether the envelope multiplies the white noise that enters the filter, not the acceleration that leaves it.
  bool envelope_at_source() const noexcept { return envelope_at_source_; }

  /// Whether the acceleration has its stationary variance at time zero; otherwise the filter starts from rest.
  bool stationary_start() const noexcept { return stationary_start_; }

  /// Whether each member's ground velocity returns to where it began although the spectrum does not vanish at zero
  /// frequency: Gaussian excitation of one whole period, without its line there.
  bool returns() const noexcept { return returns_; }

 private:
  std::variant<Spectrum, ShapingFilter, PoissonPulses> source_;
  std::optional<Envelope> envelope_{};
  bool envelope_at_source_ = false, stationary_start_ = true, returns_ = false;
};

}  // namespace stickslip::theory
