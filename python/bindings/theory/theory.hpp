// Shared by the bindings of all theories: excitations from Python, `covers` and `name`.
#pragma once

#include <pybind11/stl.h>

#include <string>
#include <utility>
#include <variant>

#include "bindings.hpp"
#include "structure/structure.hpp"

namespace stickslip::python {

/// White or other stationary noise; a number is the level S0.
using AnyNoise = std::variant<double, Spectrum, GaussianExcitation>;

inline theory::WhiteLevel white_level(const AnyNoise& noise) {
  return std::visit([](const auto& any) { return theory::WhiteLevel(any); }, noise);
}

/// Sources of shaped noise.
using AnyShapedNoise = std::variant<double, Spectrum, GaussianExcitation, PoissonPulses, theory::ShapingFilter>;

inline theory::ShapedNoise shaped_noise(const AnyShapedNoise& noise) {
  return std::visit([](const auto& any) { return theory::ShapedNoise(any); }, noise);
}

inline theory::StationaryNoise stationary_noise(const AnyNoise& noise) {
  return std::visit([](const auto& any) { return theory::StationaryNoise(any); }, noise);
}

/// The structure with a linear response that an object is, apart from its interface; nullopt for other objects.
inline std::optional<SlidingStructure> sliding_structure_of(const py::handle& object) {
  if (py::isinstance<IsolatedStructure>(object)) return object.cast<const IsolatedStructure&>();
  if (py::isinstance<EquipmentOnFloor>(object)) return object.cast<const EquipmentOnFloor&>();
  return std::nullopt;
}

/// A user-defined excitation.
struct OwnExcitation {};

/// Calls `use` with the excitation in its static type.
template <class Use>
auto with_excitation(const py::object& excitation, const Use& use) {
  if (py::isinstance<Spectrum>(excitation)) return use(excitation.cast<const Spectrum&>());
  if (py::isinstance<GaussianExcitation>(excitation)) return use(excitation.cast<const GaussianExcitation&>());
  if (py::isinstance<PoissonPulses>(excitation)) return use(excitation.cast<const PoissonPulses&>());
  if (py::isinstance<theory::ShapingFilter>(excitation)) return use(excitation.cast<const theory::ShapingFilter&>());
  if (py::isinstance<HarmonicMotion>(excitation)) return use(excitation.cast<const HarmonicMotion&>());
  py::detail::make_caster<double> number;
  if (number.load(excitation, true)) return use(py::detail::cast_op<double>(number));
  return use(OwnExcitation());
}

/// Binds `name` and `covers`.
template <class T>
void def_theory(py::class_<T>& theory) {
  theory
      .def_property_readonly(
          "name", [](const T& self) { return self.name(); }, "Name of the theory in a `Comparison`.")
      .def(
          "covers",
          [](const T& self, const py::object& slider, const py::object& excitation) -> theory::Coverage {
            if constexpr (requires(const SlidingStructure& system) { self.covers(system, 1.0); })
              if (const auto structure = sliding_structure_of(slider))
                return with_excitation(excitation, [&](const auto& e) { return self.covers(*structure, e); });
            py::detail::make_caster<AnySlider> any;
            const bool known = any.load(slider, true);
            const AnySlider friction = known ? py::detail::cast_op<const AnySlider&>(any) : Slider(Coulomb(1));
            theory::Coverage coverage = with_excitation(excitation, [&](const auto& e) {
              return std::visit([&](const auto& s) -> theory::Coverage { return self.covers(s, e); }, friction);
            });
            if (!known && coverage.excitation)
              coverage.reason = std::string(self.name()) + ": covers sliders with friction, got " +
                                py::type::of(slider).attr("__name__").template cast<std::string>();
            return coverage;
          },
          py::arg("slider"), py::arg("excitation"), R"(Whether the theory covers a slider under an excitation.

Takes microseconds; `predict` raises errors that only the computation finds.

Parameters
----------
slider : Slider, friction law or structure
    For other objects, and structures where only sliders are covered, the result is False.
excitation : float, Spectrum, ShapingFilter, GaussianExcitation, PoissonPulses or HarmonicMotion
    A number is the level S0 of white noise [m^2/s^3]. For other objects the result is False.

Returns
-------
Coverage
    True or False as a bool, with the reason.)");
}

}  // namespace stickslip::python
