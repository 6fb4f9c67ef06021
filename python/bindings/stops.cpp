#include "stickslip/stops.hpp"

#include <pybind11/stl.h>

#include <optional>

#include "parts.hpp"

namespace stickslip::python {

void bind_stops(py::module_& m) {
  value_class<Stops>(m, "Stops", R"(Stops that end the way of a slider, at x = gap and x = -backward.

A slider that comes to a stop at speed v leaves it at speed restitution * v. A load toward a stop is held, however large.
Infinitely many bounces in a finite time are followed to their end.

Parameters
----------
gap : float
    Distance from x = 0 to the stop ahead [m], and to that behind unless `backward` is given; positive, inf for none.
restitution : float
    Of the speed, from 0 (it stays) to 1 (nothing is lost).
backward : float, optional
    Distance from x = 0 to the stop behind [m]; positive, inf for none.

Raises
------
ValueError
    A value out of its range.)")
      .def(py::init([](double gap, double restitution, std::optional<double> backward) {
             return Stops(gap, backward.value_or(gap), restitution);
           }),
           py::kw_only(), py::arg("gap"), py::arg("restitution"), py::arg("backward") = py::none())
      .def_property_readonly("gap", &Stops::forward, "Distance from x = 0 to the stop ahead [m].")
      .def_property_readonly("backward", &Stops::backward, "Distance from x = 0 to the stop behind [m].")
      .def_property_readonly("restitution", &Stops::restitution, "Speed after an impact over that before.")
      .def("__repr__", [](const Stops& stops) {
        const auto text = [](double value) { return std::isinf(value) ? "float('inf')" : detail::shortest(value); };
        return "Stops(gap=" + text(stops.forward()) + ", restitution=" + text(stops.restitution()) +
               (stops.backward() != stops.forward() ? ", backward=" + text(stops.backward()) : "") + ")";
      });
}

}  // namespace stickslip::python
