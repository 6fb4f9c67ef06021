// Random ground motions with a vertical component, of excitations given in Python.
#pragma once

#include <cstdint>
#include <string>
#include <variant>

#include "bindings.hpp"

namespace stickslip::python {

/// One of the random excitations; refers to it.
struct ExcitationReference {
  std::variant<const GaussianExcitation*, const PoissonPulses*> excitation;

  GroundMotion sample(std::uint64_t seed, std::uint64_t member) const {
    return std::visit([&](const auto* one) { return one->sample(seed, member); }, excitation);
  }
  double duration() const {
    return std::visit([](const auto* one) { return one->duration(); }, excitation);
  }
  double dt() const {
    const auto* const gaussian = std::get_if<const GaussianExcitation*>(&excitation);
    return gaussian ? (*gaussian)->dt() : 0;
  }
  Interpolation interpolation() const {
    const auto* const gaussian = std::get_if<const GaussianExcitation*>(&excitation);
    return gaussian ? (*gaussian)->interpolation() : Interpolation::constant;
  }
  std::string configuration() const {
    return std::visit([](const auto* one) { return one->configuration(); }, excitation);
  }
};

/// The Python class WithVertical.
struct HeldWithVertical {
  py::object horizontal, vertical;
  double ratio;

  /// Refers to the excitations, which the object keeps alive.
  WithVertical<ExcitationReference> excitation() const;
};

}  // namespace stickslip::python
