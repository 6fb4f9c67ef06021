#include <pybind11/stl.h>

#include "friction/arguments.hpp"
#include "parts.hpp"

namespace stickslip::python {

template <>
void bind_law<VelocityDependent>(py::module_& m) {
  auto type = value_class<VelocityDependent>(
      m, "VelocityDependent",
      R"(Friction that depends on the speed, such as that of PTFE and other liners of sliding isolators.

a(|x'|) = a_fast - (a_fast - a_slow) exp(-rate |x'|), a_slow = mu_slow g, a_fast = mu_fast g: friction force per unit
mass. A slider at rest withstands loads up to a_slow. A liner has mu_slow < mu_fast; with mu_slow > mu_fast friction
weakens with speed.

Parameters
----------
mu_slow, mu_fast : float, optional
    Coefficients of friction at rest and at high speed, finite and at least 0. Give both, or slow and fast.
slow, fast : float, optional
    a_slow and a_fast [m/s^2], finite and at least 0.
rate : float
    [s/m], finite and at least 0. At the speed 1 / rate 63 % of the change is complete; with 0 the level is always slow.

Raises
------
ValueError
    A value out of range; both or neither of a coefficient and its level.

Warns
-----
PlausibilityWarning
    A coefficient from 3 to 100, which may be in percent; a rate below 2 s/m, which may be in s/cm.

Notes
-----
The motion is integrated by Taylor series in time, nearly to round-off. With a spring, a sample of the Kobe record
(dt = 0.01 s) takes 0.25 us; one of random accelerations 0.1 s apart, twice the fast level, takes 2.8 us with or without
a spring.

References
----------
M. C. Constantinou, A. Mokha, A. Reinhorn, Teflon bearings in base isolation II: Modeling, Journal of Structural
Engineering 116 (1990), 455-474.)");
  type.def(py::init([](std::optional<double> mu_slow, std::optional<double> mu_fast, std::optional<double> slow,
                       std::optional<double> fast, double rate) {
             check_unit("rate", "VelocityDependent", "rate", rate);
             return VelocityDependent(slip_level_of(mu_slow, slow, "VelocityDependent", "mu_slow", "slow"),
                                      slip_level_of(mu_fast, fast, "VelocityDependent", "mu_fast", "fast"), rate);
           }),
           py::kw_only(), py::arg("mu_slow") = py::none(), py::arg("mu_fast") = py::none(),
           py::arg("slow") = py::none(), py::arg("fast") = py::none(), py::arg("rate"))
      .def_property_readonly("slow", &VelocityDependent::slow, "Level at rest [m/s^2].")
      .def_property_readonly("fast", &VelocityDependent::fast, "Level at high speed [m/s^2].")
      .def_property_readonly(
          "mu_slow", [](const VelocityDependent& law) { return mu_of(law.slow()); },
          "Coefficient of friction at rest, slow / g.")
      .def_property_readonly(
          "mu_fast", [](const VelocityDependent& law) { return mu_of(law.fast()); },
          "Coefficient of friction at high speed, fast / g.")
      .def_property_readonly("rate", &VelocityDependent::rate, "Rate at which the level changes with the speed [s/m].")
      .def("__repr__", &repr_of<VelocityDependent>);
  explain_constructor(type,
                      "VelocityDependent: give mu_slow= and mu_fast=, or slow= and fast= [m/s^2], and rate= [s/m]");
}

}  // namespace stickslip::python
