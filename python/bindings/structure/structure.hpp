// Linear structures with one sliding interface.
#pragma once

#include "bindings.hpp"

namespace stickslip::python {

void bind_structure(py::module_& m);
void bind_structure_response(py::module_& m);

}  // namespace stickslip::python
