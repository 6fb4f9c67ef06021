#include "stickslip/slider/stops.hpp"

#include <pybind11/stl.h>

#include <optional>

#include "parts.hpp"

namespace stickslip::python {

void bind_stops(py::module_& m) {
  value_class<Stops>(m, "Stops", R"(Stops that limit the displacement of a slider, at x = gap and x = -backward.

A slider that hits a stop at speed v leaves it at speed restitution * v. A slider at a stop withstands any load toward
it. An infinite sequence of bounces in a finite time is followed to its end.

Parameters
----------
gap : float
    Distance from x = 0 to the forward stop [m], and to the backward one unless `backward` is given; positive, inf for
    none.
restitution : float
    Coefficient of restitution, from 0 (the slider stays at the stop) to 1 (no loss of speed).
backward : float, optional
    Distance from x = 0 to the backward stop [m]; positive, inf for none.

Raises
------
ValueError
    A value out of range.

Warns
-----
PlausibilityWarning
    A distance of 3 m or more, which may be in mm, cm or inches.)")
      .def(py::init([](double gap, double restitution, std::optional<double> backward) {
             check_unit("length", "Stops", "gap", gap);
             check_unit("length", "Stops", "backward", backward);
             return Stops(gap, backward.value_or(gap), restitution);
           }),
           py::kw_only(), py::arg("gap"), py::arg("restitution"), py::arg("backward") = py::none())
      .def_property_readonly("gap", &Stops::forward, "Distance from x = 0 to the forward stop [m].")
      .def_property_readonly("backward", &Stops::backward, "Distance from x = 0 to the backward stop [m].")
      .def_property_readonly("restitution", &Stops::restitution, "Speed after an impact divided by that before.")
      .def("__repr__", [](const Stops& stops) {
        return "Stops(gap=" + literal(stops.forward()) + ", restitution=" + literal(stops.restitution()) +
               (stops.backward() != stops.forward() ? ", backward=" + literal(stops.backward()) : "") + ")";
      });
}

}  // namespace stickslip::python
