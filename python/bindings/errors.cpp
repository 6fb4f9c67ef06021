#include "bindings.hpp"

namespace stickslip::python {

void bind_errors(py::module_& m) {
  py::register_exception<ConvergenceError>(m, "ConvergenceError", PyExc_RuntimeError).doc() =
      "A computation did not converge; the message says how far it came and what to change.";
}

}  // namespace stickslip::python
