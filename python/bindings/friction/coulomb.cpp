#include <pybind11/stl.h>

#include "friction/arguments.hpp"
#include "parts.hpp"

namespace stickslip::python {

template <>
void bind_law<Coulomb>(py::module_& m) {
  auto type = value_class<Coulomb>(m, "Coulomb", R"(Coulomb friction: a constant slip level, thesis (2.20).

f = a sgn(x'), where a = mu g is the slip level: the friction force per unit mass if the normal force is g. The levels
of the two directions may differ; with an infinite level in one direction the block is Newmark's, which slides only in
the other. (A slope belongs to the slider: `Slider(Coulomb(mu=0.5), slope_degrees=20)`.)

Parameters
----------
mu : float, optional
    Coefficient of friction, finite and at least 0: slip_level = mu * STANDARD_GRAVITY. Give mu or slip_level.
slip_level : float, optional
    a against forward sliding (x' > 0), and also against backward sliding unless `backward` is given [m/s^2]; finite and
    at least 0.
backward : float, optional
    Level against backward sliding (x' < 0) [m/s^2]; at least 0, may be inf.
mu_backward : float, optional
    Coefficient of friction against backward sliding, instead of `backward`; finite and at least 0.

Raises
------
ValueError
    A value out of range; both or neither of mu and slip_level; both backward and mu_backward.

Warns
-----
PlausibilityWarning
    A coefficient from 3 to 100, which may be in percent; a level from 50 to 985 m/s^2, which may be in cm/s^2.

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
      .def_property_readonly("slip_level", &Coulomb::forward, "Level against forward sliding [m/s^2].")
      .def_property_readonly("backward", &Coulomb::backward, "Level against backward sliding [m/s^2].")
      .def_property_readonly(
          "mu", [](const Coulomb& law) { return mu_of(law.forward()); },
          "Coefficient of friction against forward sliding, slip_level / g.")
      .def_property_readonly(
          "mu_backward", [](const Coulomb& law) { return mu_of(law.backward()); },
          "Coefficient of friction against backward sliding, backward / g.")
      .def("__repr__", [](const Coulomb& law) {
        return "Coulomb(" + level_argument(law.forward()) +
               (law.backward() != law.forward() ? ", " + level_argument(law.backward(), "mu_backward", "backward")
                                                : "") +
               ")";
      });
  explain_constructor(type, "Coulomb: give mu= or slip_level= [m/s^2]");
}

}  // namespace stickslip::python
