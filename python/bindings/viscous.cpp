#include "stickslip/viscous.hpp"

#include "bindings.hpp"

namespace stickslip::python {

void bind_viscous(py::module_& m) {
  m.def(
      "ViscousSlider",
      [](double damping, double natural_frequency) {
        return AnySlider(Slider<Coulomb>(ViscousSlider(damping, natural_frequency)));
      },
      py::arg("damping"), py::arg("natural_frequency") = 0.0,
      R"(A slider on a damper without friction: the linear system that stands in for a slider on friction.

x'' + c x' + wn^2 x = -n(t), thesis (4.2), (5.2), which writes zeta for c: x the displacement relative to the ground [m],
n the ground acceleration [m/s^2]. It is stuck only at rest under zero load,
and never comes to rest.

Parameters
----------
damping : float
    c [1/s], finite and at least 0; 2 wn times the damping ratio.
natural_frequency : float, optional
    wn [rad/s], finite and at least 0; 0 is no spring.

Returns
-------
Slider
    Slider(Coulomb(slip_level=0), natural_frequency, damping).

Raises
------
ValueError
    A value out of its range.)");
}

}  // namespace stickslip::python
