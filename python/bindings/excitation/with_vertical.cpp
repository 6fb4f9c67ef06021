#include "excitation/with_vertical.hpp"

#include "parts.hpp"

namespace stickslip::python {

template <>
inline constexpr auto parts<HeldWithVertical> = std::tuple(&HeldWithVertical::horizontal, &HeldWithVertical::vertical,
                                                           &HeldWithVertical::ratio);

namespace {

ExcitationReference reference_to(const py::object& object, const std::string& name) {
  if (py::isinstance<GaussianExcitation>(object)) return {&object.cast<const GaussianExcitation&>()};
  if (py::isinstance<PoissonPulses>(object)) return {&object.cast<const PoissonPulses&>()};
  throw py::type_error("WithVertical: " + name + " must be a GaussianExcitation or PoissonPulses, got " +
                       py::type::of(object).attr("__name__").cast<std::string>() +
                       "; a user-defined excitation gives its motions a vertical component itself, "
                       "GroundMotion(..., vertical=...)");
}

}  // namespace

WithVertical<ExcitationReference> HeldWithVertical::excitation() const {
  return {reference_to(horizontal, "horizontal"), reference_to(vertical, "vertical"), ratio};
}

void bind_with_vertical(py::module_& m) {
  value_class<HeldWithVertical>(m, "WithVertical",
                                R"(An excitation whose motions also have a vertical component.

The vertical component is drawn independently of the horizontal one. The slider moves under n(t) and a_z(t), and
friction is proportional to the normal force, on level ground N = g + a_z; see `integrate`. (seed, member) determines
both components. The horizontal one has the same bits as without a vertical one, so an ensemble with the vertical
component can be compared member by member with one without.

Parameters
----------
horizontal : GaussianExcitation or PoissonPulses
    Excitation of the horizontal component.
vertical : GaussianExcitation or PoissonPulses, optional
    Excitation of the vertical component, positive upward, with the same duration and interpolation. Its step may
    differ: the motion then has the times of both. Default: `horizontal`, drawn independently.
ratio : float, optional
    Factor on the vertical component, finite and at least 0; default 1. With the default of `vertical` it is the ratio
    V/H of the rms accelerations, in earthquakes often near 2/3.

Raises
------
ValueError
    A ratio out of range; durations or interpolations that differ.
TypeError
    Another excitation. A user-defined excitation gives its motions a vertical component itself.

Notes
-----
The components of an earthquake are not independent, and the vertical one has more of high frequencies. This model
leaves the dependence out; the frequencies are those of `vertical`. A member of an ensemble that is in flight at the end
of its motion counts with its state there (`Ensemble.airborne`); with `settle` it lands.

Theories and `compare` do not cover vertical motion.)")
      .def(py::init([](const py::object& horizontal, const py::object& vertical, double ratio) {
             HeldWithVertical held{horizontal, vertical.is_none() ? horizontal : vertical, ratio};
             const auto excitation = held.excitation();  // checks the ratio and the durations
             if (excitation.horizontal().interpolation() != excitation.vertical().interpolation())
               throw std::invalid_argument(
                   "WithVertical: both components must be lines between samples or both held values, got "
                   "interpolation='" +
                   std::string(name_of(excitation.horizontal().interpolation())) + "' and '" +
                   name_of(excitation.vertical().interpolation()) + "' (pulses are held values)");
             return held;
           }),
           py::arg("horizontal"), py::arg("vertical") = py::none(), py::kw_only(), py::arg("ratio") = 1.0)
      .def(
          "sample",
          [](const HeldWithVertical& self, std::uint64_t seed, std::uint64_t member) {
            const auto excitation = self.excitation();
            const py::gil_scoped_release released;
            return excitation.sample(seed, member);
          },
          py::kw_only(), py::arg("seed"), py::arg("member"),
          R"(Generate the motion of a member, with its vertical component.

Parameters
----------
seed, member : int
    From 0 to 2^64 - 1.

Returns
-------
GroundMotion)")
      .def_property_readonly(
          "horizontal", [](const HeldWithVertical& self) { return self.horizontal; },
          "Excitation of the horizontal component.")
      .def_property_readonly(
          "vertical", [](const HeldWithVertical& self) { return self.vertical; },
          "Excitation of the vertical component, before it is multiplied by the ratio.")
      .def_property_readonly(
          "ratio", [](const HeldWithVertical& self) { return self.ratio; }, "Factor on the vertical component.")
      .def_property_readonly(
          "duration", [](const HeldWithVertical& self) { return self.excitation().duration(); },
          "Duration of a motion [s].")
      .def_property_readonly(
          "configuration", [](const HeldWithVertical& self) { return self.excitation().configuration(); },
          "Everything that determines the motions, as a JSON object.")
      .def("__repr__", [](const HeldWithVertical& self) {
        const auto text_of = [](const py::object& object) { return py::repr(object).cast<std::string>(); };
        return "WithVertical(" + text_of(self.horizontal) +
               (self.vertical.is(self.horizontal) ? "" : ", " + text_of(self.vertical)) +
               ", ratio=" + detail::shortest(self.ratio) + ")";
      });
}

}  // namespace stickslip::python
