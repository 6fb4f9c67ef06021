// The noise that theories take: white by its level, stationary by its spectrum.
#pragma once

#include <utility>

#include "stickslip/excitation/gaussian.hpp"
#include "stickslip/excitation/spectrum.hpp"

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

}  // namespace stickslip::theory
