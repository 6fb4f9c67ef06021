#include <pybind11/stl.h>

#include "friction/arguments.hpp"
#include "parts.hpp"

namespace stickslip::python {

void bind_coulomb(py::module_& m) {
  auto type = value_class<Coulomb>(m, "Coulomb", R"(Coulomb friction: the same slip level everywhere, thesis (2.20).

f = a sgn(x'), a = mu g the slip level: friction force per unit mass. The two directions may differ: on an inclined
plane they do, and with an infinite level one way the block is Newmark's, which slides the other way only.

Parameters
----------
mu : float, optional
    Coefficient of friction, finite and at least 0: slip_level = mu * STANDARD_GRAVITY. Give mu or slip_level.
slip_level : float, optional
    a against forward sliding (x' > 0), and against backward sliding too unless `backward` is given [m/s^2]; finite and
    at least 0.
backward : float, optional
    Level against backward sliding (x' < 0) [m/s^2]; at least 0, may be inf.
mu_backward : float, optional
    Coefficient of friction against backward sliding, instead of `backward`; finite and at least 0.

Raises
------
ValueError
    A value out of its range; both or neither of mu and slip_level; both of backward and mu_backward.

References
----------
N. M. Newmark, Effects of earthquakes on dams and embankments, Geotechnique 15 (1965), 139-160 (one-way sliding).)");
  type.def(py::init([](std::optional<double> mu, std::optional<double> slip_level, std::optional<double> backward,
                       std::optional<double> mu_backward) {
             const double forward = slip_level_of(mu, slip_level, "Coulomb");
             if (!backward && !mu_backward) return Coulomb(forward);
             return Coulomb(forward, slip_level_of(mu_backward, backward, "Coulomb", "mu_backward", "backward"));
           }),
           py::kw_only(), py::arg("mu") = py::none(), py::arg("slip_level") = py::none(),
           py::arg("backward") = py::none(), py::arg("mu_backward") = py::none())
      .def_static(
          "on_slope",
          [](double mu, const py::object& degrees) {  // a quantity in degrees counts as a number of radians
            return Coulomb::on_slope(mu, to_number(degrees, "Coulomb: degrees", "degree"));
          },
          py::kw_only(), py::arg("mu"), py::arg("degrees"),
          R"(A block on an inclined plane; downhill is forward.

The displacement and the ground acceleration are measured along the slope, and the normal load is taken as constant,
m g cos(slope): no acceleration across the slope. Levels g (mu cos(slope) - sin(slope)) forward and
g (mu cos(slope) + sin(slope)) backward.

Parameters
----------
mu : float
    Coefficient of friction, at least tan(slope).
degrees : float
    The slope [degrees], from 0 to less than 90.

Raises
------
ValueError
    A value out of its range, or a block that would slide under its own weight.)")
      .def_property_readonly("slip_level", &Coulomb::forward, "Level against forward sliding [m/s^2].")
      .def_property_readonly("backward", &Coulomb::backward, "Level against backward sliding [m/s^2].")
      .def("__repr__", [](const Coulomb& law) {
        return "Coulomb(" + level_argument(law.forward()) +
               (law.backward() != law.forward() ? ", " + level_argument(law.backward(), "mu_backward", "backward")
                                                : "") +
               ")";
      });
  explain_constructor(type, "Coulomb: give mu= or slip_level= [m/s^2]");
}

}  // namespace stickslip::python
