#include <optional>
#include <stdexcept>
#include <string>

#include <pybind11/stl.h>

#include "parts.hpp"

namespace stickslip::python {
namespace {

py::object on_axis(const AnyPlanarSlider& slider) { return py::cast(along_axis(slider)); }

AnyPlanarSlider planar_slider_from(const py::object& law, std::optional<double> natural_frequency,
                                   std::optional<double> damping, std::optional<double> period,
                                   std::optional<double> damping_ratio, const py::object& slope, const Stops* stops,
                                   bool pendulum) {
  if (!py::isinstance<AnySlider>(law))
    return planar(slider_from(law, natural_frequency, damping, period, damping_ratio, slope, false, stops, pendulum));
  if (natural_frequency || damping || period || damping_ratio || stops || pendulum || !slope.equal(py::float_(0.0)))
    throw std::invalid_argument(
        "PlanarSlider: a Slider has its own spring, damper, slope and stops; give it alone, or give a friction law "
        "with them");
  return planar(law.cast<const AnySlider&>());
}

State slid_at(double sliding_distance) {
  detail::require(std::isfinite(sliding_distance) && sliding_distance >= 0,
                  "PlanarSlider: sliding_distance must be finite and at least 0", sliding_distance, "m");
  return State{.sliding_distance = sliding_distance};
}

}  // namespace

void bind_planar_slider(py::module_& m) {
  py::class_<AnyPlanarSlider> slider(
      m, "PlanarSlider",
      R"(A mass that slides in two horizontal directions: a friction law, and optionally a spring, a damper, a slope and a stop.

r'' + resist N+/g r'/|r'| + c r' + wn^2 r = p: r is the displacement relative to the ground [m], a vector with its
components along the axis of the ground motion and along its transverse direction, which is 90 degrees clockwise from
the axis as seen from above. Friction opposes the velocity vector. p = ((g + a_z) sin(slope) - n cos(slope), -t),
N = (g + a_z) cos(slope) + n sin(slope) and N+ = max(N, 0), where n, t and a_z are the ground acceleration along the
axis, along the transverse direction and upward [m/s^2]; on a slope the axis points downhill. A slider at rest stays at
rest while |p - wn^2 r| <= hold N+/g.

Parameters
----------
law : FrictionLaw or Slider
    The friction, which must be the same in all directions; or a `Slider`, whose law and mounting are used.
natural_frequency : float, optional
    wn of the mass on its spring, without friction [rad/s]; finite and at least 0; 0 means no spring.
damping : float, optional
    c of the damper per unit mass [1/s]; finite and at least 0; 0 means no damper.
period : float, optional
    2 pi / wn [s], instead of natural_frequency; positive and finite.
damping_ratio : float, optional
    c / (2 wn), the fraction of critical damping, instead of damping; finite and at least 0. Needs a spring.
slope_degrees : float, optional
    Slope of the ground [degrees], at least 0 and less than 90; the axis points downhill.
stops : Stops, optional
    A circular stop at |r| = gap: both gaps must be equal. It reflects the radial velocity, times its restitution. While
    the slider is pressed against the stop it slides along it; the stop itself has no friction.
pendulum : bool, optional
    The spring is that of a friction pendulum, with the force wn^2 r N+/g; see `FrictionPendulum`.

Raises
------
ValueError
    As for `Slider`. A law that is not the same in all directions: `Caster`, a `Law`, different levels forward and
    backward. A `Slider` with `one_way`, or with stops of unequal gaps.

Warns
-----
PlausibilityWarning
    As for `Slider`.

Examples
--------
>>> import stickslip as ss
>>> ss.PlanarSlider(ss.FrictionPendulum(radius=2.2, mu=0.05)).radius
2.2)");
  slider
      .def(py::init(&planar_slider_from), py::arg("law"), py::arg("natural_frequency") = py::none(),
           py::arg("damping") = py::none(), py::kw_only(), py::arg("period") = py::none(),
           py::arg("damping_ratio") = py::none(), py::arg("slope_degrees") = 0.0, py::arg("stops") = py::none(),
           py::arg("pendulum") = false)
      .def_property_readonly("along_axis", &on_axis, "The `Slider` with the same law and mounting, on one axis.")
      .def(
          "hold",
          [](const AnyPlanarSlider& self, double sliding_distance) {
            const State state = slid_at(sliding_distance);
            return std::visit([&](const auto& s) { return hold(law_at(s.law(), state), 0.0, Direction::forward); },
                              self);
          },
          py::kw_only(), py::arg("sliding_distance") = 0.0,
          R"(Largest load that friction resists at rest, in any direction.

Parameters
----------
sliding_distance : float, optional
    Slid so far [m], where the law depends on it; at least 0.

Returns
-------
float
    Friction force per unit mass [m/s^2].)")
      .def(
          "resist",
          [](const AnyPlanarSlider& self, double speed, double sliding_distance) {
            const State state = slid_at(sliding_distance);
            return std::visit(
                [&](const auto& s) -> double { return resist(law_at(s.law(), state), 0.0, speed, Direction::forward); },
                self);
          },
          py::arg("speed") = 0.0, py::kw_only(), py::arg("sliding_distance") = 0.0,
          R"(Friction while sliding, against the velocity.

Parameters
----------
speed : float, optional
    |r'| [m/s].
sliding_distance : float, optional
    Slid so far [m], where the law depends on it; at least 0.

Returns
-------
float
    Friction force per unit mass [m/s^2].)")
      .def("__repr__",
           [](const AnyPlanarSlider& self) {
             const auto text = py::repr(on_axis(self)).cast<std::string>();
             return text.starts_with("Slider(") ? "Planar" + text : "PlanarSlider(" + text + ")";
           })
      .def(
          "__eq__",
          [](const AnyPlanarSlider& a, const py::object& other) {
            return py::isinstance<AnyPlanarSlider>(other) &&
                   on_axis(a).equal(on_axis(other.cast<const AnyPlanarSlider&>()));
          },
          py::is_operator())
      .def("__hash__", [](const AnyPlanarSlider& s) { return py::hash(py::make_tuple("plane", on_axis(s))); })
      .def(py::pickle([](const AnyPlanarSlider& self) { return py::make_tuple(on_axis(self)); },
                      [](const py::tuple& state) {
                        if (state.size() != 1)
                          throw std::invalid_argument("unpickling: expected 1 value, got " +
                                                      std::to_string(state.size()));
                        return planar(state[0].cast<const AnySlider&>());
                      }));
  // The mounting is that on the axis.
  const py::object one_axis = m.attr("Slider");
  for (const char* name : {"law", "natural_frequency", "damping", "slope_degrees", "stops", "pendulum", "radius",
                           "period", "damping_ratio"})
    slider.def_property_readonly(
        name, [name](const AnyPlanarSlider& self) -> py::object { return on_axis(self).attr(name); },
        py::str(one_axis.attr(name).attr("__doc__")).cast<std::string>().c_str());
}

}  // namespace stickslip::python
