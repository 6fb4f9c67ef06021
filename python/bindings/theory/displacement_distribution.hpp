// A distribution of the displacement that knows what it was predicted from.
#pragma once

#include <utility>
#include <variant>

#include "bindings.hpp"

namespace stickslip::python {

struct DisplacementDistribution : theory::DisplacementDistribution {
  DisplacementDistribution(theory::PulseSuperposition by, AnySlider any, PoissonPulses excitation, double at)
      : theory::DisplacementDistribution(with_position_law(
            any, "PulseSuperposition", [&](const auto& s) { return by.distribution(s, excitation, at); })),
        theory(by),
        slider(std::move(any)),
        pulses(std::move(excitation)),
        time(at) {}

  theory::PulseSuperposition theory;
  AnySlider slider;
  PoissonPulses pulses;
  double time;  // [s]
};

}  // namespace stickslip::python
