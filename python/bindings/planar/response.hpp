// A response in the plane together with its slider and ground motion.
#pragma once

#include <optional>
#include <utility>

#include "bindings.hpp"

namespace stickslip::python {

struct PlanarResponseWithInputs {
  PlanarResponse response;
  py::object slider;
  py::object motion;
  py::object time{}, events{};           // arrays, made on first access
  std::optional<PlanarForces> forces{};  // likewise

  PlanarResponseWithInputs(PlanarResponse&& answer, py::object what, py::object under)
      : response(std::move(answer)), slider(std::move(what)), motion(std::move(under)) {}
};

}  // namespace stickslip::python
