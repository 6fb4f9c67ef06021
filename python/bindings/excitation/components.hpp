// Random ground motions of several components, of excitations given in Python.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>

#include "bindings.hpp"

namespace stickslip::python {

/// One of the random excitations of one component; refers to it.
struct ExcitationReference {
  std::variant<const GaussianExcitation*, const PoissonPulses*> excitation;

  GroundMotion sample(std::uint64_t seed, std::uint64_t member) const {
    return std::visit([&](const auto* one) { return one->sample(seed, member); }, excitation);
  }
  GroundMotion sample(std::uint64_t seed, std::uint64_t member, std::uint64_t amplitude_seed) const {
    return std::get<const PoissonPulses*>(excitation)->sample(seed, member, amplitude_seed);
  }
  bool made_of_pulses() const { return std::holds_alternative<const PoissonPulses*>(excitation); }
  double variance() const {
    return std::visit([](const auto* one) { return one->variance(); }, excitation);
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

using Pairs = WithTransverse<ExcitationReference>;

/// The components of an excitation in Python, in the order in which they are put together.
struct Components {
  struct Transverse {
    ExcitationReference excitation;
    double ratio, coherence;
    std::optional<Arrivals> arrivals;
  };
  struct Vertical {
    ExcitationReference excitation;
    double ratio;
  };
  ExcitationReference horizontal;
  std::optional<Transverse> transverse{};
  std::optional<Vertical> vertical{};

  Pairs pairs() const {
    return {horizontal, transverse->excitation, transverse->ratio, transverse->coherence, transverse->arrivals};
  }

  /// Calls `f` with the excitation in its static type. It is the same for either order of WithTransverse and
  /// WithVertical.
  /// @pre there is a transverse or a vertical component
  template <class F>
  auto visit(F&& f) const {
    if (!transverse) return f(WithVertical(horizontal, vertical->excitation, vertical->ratio));
    if (!vertical) return f(pairs());
    return f(WithVertical(pairs(), vertical->excitation, vertical->ratio));
  }

  GroundMotion sample(std::uint64_t seed, std::uint64_t member) const {
    return visit([&](const auto& excitation) { return excitation.sample(seed, member); });
  }
  double duration() const { return horizontal.duration(); }
  std::string configuration() const {
    return visit([](const auto& excitation) { return excitation.configuration(); });
  }
};

/// The Python class WithVertical.
struct HeldWithVertical {
  py::object horizontal, vertical;
  double ratio;
};

/// The Python class WithTransverse.
struct HeldWithTransverse {
  py::object horizontal, transverse;
  double ratio, coherence;
  std::string arrivals;
};

/// One of the excitations of one component; nullopt for other objects.
std::optional<ExcitationReference> excitation_of(const py::handle& object);

/// The components of a WithVertical or WithTransverse; nullopt for other objects. Refers to the excitations, which the
/// object keeps alive.
std::optional<Components> components_of(const py::object& object);

}  // namespace stickslip::python
