// Suites, which are a class of the Python package.
#pragma once

#include "bindings.hpp"

namespace stickslip::python {

/// Whether an object is a `stickslip.Suite`. Imports nothing for a GroundMotion.
inline bool is_suite(const py::object& object) {
  return !py::isinstance<GroundMotion>(object) &&
         py::isinstance(object, py::module_::import("stickslip.motions.suite").attr("Suite"));
}

}  // namespace stickslip::python
