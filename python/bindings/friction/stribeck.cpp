#include <pybind11/stl.h>

#include <cmath>

#include "friction/arguments.hpp"
#include "parts.hpp"

namespace stickslip::python {

template <>
void bind_law<Stribeck>(py::module_& m) {
  auto type = value_class<Stribeck>(
      m, "Stribeck",
      R"(Friction that falls from a static to a kinetic level with increasing speed: the Stribeck law.

a(|x'|) = a_kinetic + (a_static - a_kinetic) exp(-(|x'| / velocity)^exponent), a = mu g: friction force per unit mass. A
slider at rest withstands loads up to a_static; the acceleration does not jump at breakaway.

Parameters
----------
mu_static, mu_kinetic : float, optional
    Coefficients of friction at rest and at high speed, finite, mu_static >= mu_kinetic >= 0. Give both, or static and
    kinetic.
static, kinetic : float, optional
    The levels [m/s^2].
velocity : float
    Speed at which 63 % of the decrease is complete [m/s], positive.
exponent : float
    A whole number from 1 to 31.

Raises
------
ValueError
    A value out of range; both or neither of a coefficient and its level.

Warns
-----
PlausibilityWarning
    As for `Coulomb`; a velocity of 10 m/s or more, which may be in cm/s or mm/s.

Notes
-----
The motion is integrated by Taylor series in time, nearly to round-off.

References
----------
B. Armstrong-Helouvry, P. Dupont, C. Canudas de Wit, A survey of models, analysis tools and compensation methods for the
control of machines with friction, Automatica 30 (1994), 1083-1138.)");
  type.def(py::init([](std::optional<double> mu_static, std::optional<double> mu_kinetic, std::optional<double> hold,
                       std::optional<double> kinetic, double velocity, double exponent) {
             detail::require(exponent >= 1 && exponent <= 31 && exponent == std::floor(exponent),
                             "Stribeck: exponent must be a whole number from 1 to 31", exponent);
             check_unit("sliding velocity", "Stribeck", "velocity", velocity);
             return Stribeck(slip_level_of(mu_static, hold, "Stribeck", "mu_static", "static"),
                             slip_level_of(mu_kinetic, kinetic, "Stribeck", "mu_kinetic", "kinetic"), velocity,
                             static_cast<int>(exponent));
           }),
           py::kw_only(), py::arg("mu_static") = py::none(), py::arg("mu_kinetic") = py::none(),
           py::arg("static") = py::none(), py::arg("kinetic") = py::none(), py::arg("velocity"), py::arg("exponent"))
      .def_property_readonly("static", &Stribeck::static_level, "Level at rest [m/s^2].")
      .def_property_readonly("kinetic", &Stribeck::kinetic_level, "Level at high speed [m/s^2].")
      .def_property_readonly(
          "mu_static", [](const Stribeck& law) { return mu_of(law.static_level()); },
          "Coefficient of friction at rest, static / g.")
      .def_property_readonly(
          "mu_kinetic", [](const Stribeck& law) { return mu_of(law.kinetic_level()); },
          "Coefficient of friction at high speed, kinetic / g.")
      .def_property_readonly("velocity", &Stribeck::velocity, "Speed at which 63 % of the decrease is complete [m/s].")
      .def_property_readonly("exponent", &Stribeck::exponent, "Exponent of the speed.")
      .def("__repr__", &repr_of<Stribeck>);
  explain_constructor(type,
                      "Stribeck: give mu_static= and mu_kinetic=, or static= and kinetic= [m/s^2], velocity= [m/s] and "
                      "exponent=");
}

}  // namespace stickslip::python
