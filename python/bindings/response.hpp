// A response together with what it came from.
#pragma once

#include "bindings.hpp"

namespace stickslip::python {

struct Recording {
  Response response;
  py::object slider;
  py::object motion;
  py::object time, events;  // arrays, made when first asked for
};

}  // namespace stickslip::python
