#include "stickslip/slider/viscous.hpp"

#include "bindings.hpp"

namespace stickslip::python {

void bind_viscous(py::module_& m) {
  m.def(
      "ViscousSlider",
      [](double damping, double natural_frequency) {
        AnySlider made = Slider<Coulomb>(ViscousSlider(damping, natural_frequency));
        check_unit("damper", "ViscousSlider", "damping", damping);
        check_unit("angular frequency", "ViscousSlider", "natural_frequency", natural_frequency);
        return made;
      },
      py::arg("damping"), py::arg("natural_frequency") = 0.0,
      R"(A slider with a damper and no friction: the linear system that approximates a slider with friction.

x'' + c x' + wn^2 x = -n(t), thesis (4.2), (5.2), which writes zeta for c: x is the displacement relative to the ground
[m], n the ground acceleration [m/s^2]. The slider is stuck only while at rest under zero load, and never comes to rest.

Parameters
----------
damping : float
    c [1/s], finite and at least 0; 2 wn times the damping ratio.
natural_frequency : float, optional
    wn [rad/s], finite and at least 0; 0 means no spring.

Returns
-------
Slider
    Slider(Coulomb(slip_level=0), natural_frequency, damping).

Raises
------
ValueError
    A value out of range.

Warns
-----
PlausibilityWarning
    A damping or natural_frequency of 10,000 or more.)");
}

}  // namespace stickslip::python
