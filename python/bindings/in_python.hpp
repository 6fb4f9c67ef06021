// Methods that are implemented in Python: tables and HTML. Their modules are imported on first use.
#pragma once

#include "bindings.hpp"

namespace stickslip::python {

/// A method or property that a function of a module of the package implements.
inline auto in_python(const char* module, const char* function) {
  return [=](const py::object& self) { return py::module_::import(module).attr(function)(self); };
}

/// A method that takes a path, which a function of a module of the package implements.
inline auto csv_in(const char* module, const char* function) {
  return [=](const py::object& self, const py::object& path) {
    return py::module_::import(module).attr(function)(self, path);
  };
}

}  // namespace stickslip::python
