#include "stickslip/theory/noise.hpp"

#include <cmath>
#include <cstddef>
#include <numeric>
#include <stdexcept>
#include <variant>
#include <vector>

#include "stickslip/base/error.hpp"

namespace stickslip::theory {
namespace {

/// The level of a white spectrum; null for any other.
const Spectrum::White* white(const Spectrum& spectrum) { return std::get_if<Spectrum::White>(&spectrum.form()); }

/// The spectrum of each motion of an excitation.
const Spectrum& spectrum_of(const GaussianExcitation& excitation) {
  if (white(excitation.spectrum()) != nullptr && !excitation.options().zero_frequency)
    throw std::invalid_argument(
        "white noise has a line at zero frequency, without which the ground comes back to where it was; "
        "zero_frequency must be True");
  return excitation.spectrum();
}

/// The same for an excitation that must be stationary.
const Spectrum& stationary(const GaussianExcitation& excitation) {
  if (excitation.options().envelope)
    throw std::invalid_argument("a Gaussian excitation with an envelope is not stationary, envelope must be None");
  return spectrum_of(excitation);
}

/// Of the amplitudes of pulses, in units of their rms.
double mean_amplitude(const PoissonPulses& pulses) {
  if (!pulses.options().quantile) return 0;
  std::vector<double> u(4096);
  for (std::size_t i = 0; i < u.size(); ++i) u[i] = (static_cast<double>(i) + 0.5) / static_cast<double>(u.size());
  pulses.options().quantile(u);
  return std::accumulate(u.begin(), u.end(), 0.0) / static_cast<double>(u.size());
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

ShapedNoise::ShapedNoise(const GaussianExcitation& excitation)
    : source_(spectrum_of(excitation)),
      envelope_(excitation.options().envelope),
      returns_(!envelope_ && !excitation.options().zero_frequency &&
               excitation.options().period <= excitation.samples() && excitation.spectrum()(0) > 0) {}

ShapedNoise::ShapedNoise(const PoissonPulses& pulses)
    : source_(pulses),
      envelope_(pulses.options().envelope),
      envelope_at_source_(true),
      stationary_start_(pulses.options().stationary_start) {
  const double mean = mean_amplitude(pulses);
  detail::require(std::abs(mean) < 1e-2, "pulses must have amplitudes of mean 0; their mean over their rms", mean);
}

ShapingFilter ShapedNoise::filter(const ShapingFilter::Fit& fit) const {
  return std::visit(
      [&]<class Source>(const Source& source) {
        if constexpr (std::same_as<Source, ShapingFilter>)
          return source;
        else
          return ShapingFilter::of(source, fit);
      },
      source_);
}

std::optional<double> ShapedNoise::white() const {
  if (envelope_ || !stationary_start_) return {};
  if (const auto* spectrum = std::get_if<Spectrum>(&source_))
    if (const auto* found = theory::white(*spectrum)) return found->s0;
  if (const auto* filter = std::get_if<ShapingFilter>(&source_); filter != nullptr && filter->sections().empty())
    return filter->s0();
  return {};
}

}  // namespace stickslip::theory
