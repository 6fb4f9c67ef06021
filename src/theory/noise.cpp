#include "stickslip/theory/noise.hpp"

#include <cmath>
#include <stdexcept>
#include <variant>

#include "stickslip/error.hpp"

namespace stickslip::theory {
namespace {

/// The level of a white spectrum; null for another.
const Spectrum::White* white(const Spectrum& spectrum) { return std::get_if<Spectrum::White>(&spectrum.form()); }

/// The spectrum of an excitation that is stationary.
const Spectrum& stationary(const GaussianExcitation& excitation) {
  if (excitation.options().envelope)
    throw std::invalid_argument("no theory covers Gaussian excitation with an envelope, envelope must be None");
  if (white(excitation.spectrum()) != nullptr && !excitation.options().zero_frequency)
    throw std::invalid_argument(
        "white noise has a line at zero frequency, without which the ground comes back to where it was; "
        "zero_frequency must be True");
  return excitation.spectrum();
}

}  // namespace

WhiteLevel::WhiteLevel(double s0) : s0_(s0) {
  detail::require(std::isfinite(s0) && s0 > 0, "WhiteNoise: s0 must be positive and finite", s0, "m^2/s^3");
}

WhiteLevel::WhiteLevel(const Spectrum& spectrum) : s0_(0) {
  const auto* const found = white(spectrum);
  if (found == nullptr)
    throw std::invalid_argument("WhiteNoise: covers white noise only, got the spectrum " + spectrum.configuration());
  s0_ = found->s0;
}

WhiteLevel::WhiteLevel(const GaussianExcitation& excitation) : WhiteLevel(stationary(excitation)) {}

StationaryNoise::StationaryNoise(const GaussianExcitation& excitation) : spectrum_(stationary(excitation)) {}

}  // namespace stickslip::theory
