// A distribution of the displacement, with the theory and inputs that predicted it.
#pragma once

#include <stdexcept>
#include <utility>
#include <variant>

#include "bindings.hpp"

namespace stickslip::python {

/// Theories that predict distributions, and what excites the slider.
using DistributionTheory = std::variant<theory::PulseSuperposition, theory::PulseChain, theory::Transport>;
using DistributionSource = std::variant<double, Spectrum, theory::ShapingFilter, GaussianExcitation, PoissonPulses>;

inline const Slider<Coulomb>& coulomb_of(const AnySlider& slider) {
  if (const auto* block = std::get_if<Slider<Coulomb>>(&slider)) return *block;
  throw std::invalid_argument("PulseChain: covers Coulomb friction; PulseSuperposition covers other laws");
}

inline theory::DisplacementDistribution distribution_of(const theory::PulseSuperposition& by, const AnySlider& any,
                                                        const DistributionSource& pulses, double at) {
  return with_position_law(any, "PulseSuperposition",
                           [&](const auto& s) { return by.distribution(s, std::get<PoissonPulses>(pulses), at); });
}

inline theory::DisplacementDistribution distribution_of(const theory::PulseChain& by, const AnySlider& any,
                                                        const DistributionSource& pulses, double at) {
  return by.distribution(coulomb_of(any), std::get<PoissonPulses>(pulses), at, &check_for_interrupt);
}

/// What `Transport` covers.
inline theory::TransportExcitation transport_excitation(const DistributionSource& source) {
  return std::visit([](const auto& any) -> theory::TransportExcitation { return any; }, source);
}

inline theory::DisplacementDistribution distribution_of(const theory::Transport& by, const AnySlider& any,
                                                        const DistributionSource& source, double at) {
  return by.displacement(any, transport_excitation(source), at, &check_for_interrupt);
}

struct DisplacementDistribution : theory::DisplacementDistribution {
  DisplacementDistribution(DistributionTheory by, AnySlider any, DistributionSource excitation, double at)
      : theory::DisplacementDistribution(
            std::visit([&](const auto& t) { return distribution_of(t, any, excitation, at); }, by)),
        theory(by),
        slider(std::move(any)),
        source(std::move(excitation)),
        time(at) {}

  DistributionTheory theory;
  AnySlider slider;
  DistributionSource source;
  double time;  // [s]
};

}  // namespace stickslip::python
