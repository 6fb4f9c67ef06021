#include "friction/callable_law.hpp"

#include "friction/arguments.hpp"
#include "parts.hpp"

namespace stickslip::python {

void bind_callable_law(py::module_& m) {
  auto type = value_class<CallableLaw>(m, "Law", R"(A friction law of your own, from functions.

Parameters
----------
resist : function of (x, speed, direction)
    Level against sliding [m/s^2]: friction force per unit mass where the normal force is g. x is the displacement [m],
    speed is |x'| [m/s], and direction is +1.0 (forward) or -1.0 (backward). Finite, at least 0, and continuous in x and
    speed.
hold : function of (x, direction), optional
    Level at rest against sliding in a direction [m/s^2]; finite and at least that of `resist` at zero speed, which is the
    default.

Raises
------
TypeError
    Not a function; a compiled function of other types; a function that does not return a number.
ValueError
    During integration: a level that is negative or not finite. The message states it, and x and speed.

Notes
-----
The motion is computed by collocation in time, to 1e-10 of the scale. Each time step takes 30 to 60 calls of `resist`,
some 10 to 40 us with a Python function, which holds the interpreter lock. A compiled function, such as one from
`numba.cfunc("float64(float64, float64, float64)")`, takes 2 to 4 us and runs without the lock. An exception that a
function raises ends the integration and is raised again.

Laws compare by their functions. They can be pickled if their functions can: those of modules, not lambdas. Theories and
sensitivities do not cover them.

Examples
--------
>>> law = Law(resist=lambda x, speed, direction: 2.0 + 0.5 * speed)
>>> Slider(law).resist(speed=1.0)
2.5)");
  type.def(py::init<py::object, py::object>(), py::kw_only(), py::arg("hold") = py::none(), py::arg("resist"))
      .def_property_readonly("hold", &CallableLaw::hold_function, "The function of (x, direction), or None.")
      .def_property_readonly("resist", &CallableLaw::resist_function, "The function of (x, speed, direction).")
      .def("__repr__", [](const CallableLaw& law) {
    const auto name = [](const py::object& f) { return py::repr(f).cast<std::string>(); };
    return "<Law: " + (law.hold_function().is_none() ? "" : "hold " + name(law.hold_function()) + ", ") + "resist " +
           name(law.resist_function()) + ">";
      });
  explain_constructor(type, "Law: give resist=, a function of (x, speed, direction), and hold= of (x, direction)");
}

}  // namespace stickslip::python
