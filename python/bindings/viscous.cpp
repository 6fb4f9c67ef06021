#include "stickslip/viscous.hpp"

#include "parts.hpp"

namespace stickslip::python {

void bind_viscous(py::module_& m) {
  value_class<ViscousSlider>(m, "ViscousSlider",
                             R"(A mass on a viscous damper: the linear system that stands in for a slider on friction.

x'' + zeta x' + wn^2 x = -n(t), thesis (4.2), (5.2): x the displacement relative to the ground [m], n the ground
acceleration [m/s^2]. It never sticks, and never comes to rest. `integrate` and `run_ensemble` take it as they take a
slider on friction.

Parameters
----------
damping : float
    zeta [1/s], finite and at least 0; 2 wn times the share of critical.
natural_frequency : float, optional
    wn [rad/s], finite and at least 0; 0 is no spring.

Raises
------
ValueError
    A value out of its range.

Notes
-----
Solved in closed form over each straight piece of the ground motion: exact to round-off, for any damping and step.)")
      .def(py::init<double, double>(), py::arg("damping"), py::arg("natural_frequency") = 0.0)
      .def_property_readonly("damping", &ViscousSlider::damping, "zeta [1/s].")
      .def_property_readonly("natural_frequency", &ViscousSlider::natural_frequency, "wn [rad/s]; 0 without a spring.")
      .def("__repr__", [](const ViscousSlider& s) {
        return "ViscousSlider(damping=" + detail::shortest(s.damping()) +
               (s.natural_frequency() > 0 ? ", natural_frequency=" + detail::shortest(s.natural_frequency()) : "") +
               ")";
      });
}

}  // namespace stickslip::python
