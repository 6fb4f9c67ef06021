// A response in the plane together with its slider and ground motion.
#pragma once

#include <optional>
#include <stdexcept>
#include <string>
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

/// The ground motion, which needs both horizontal components.
/// @param function  that asks, for messages
inline const GroundMotion& both_components(const py::object& motion, const char* function) {
  if (!py::isinstance<GroundMotion>(motion))
    throw py::type_error(std::string(function) + ": the motion of a PlanarSlider must be a GroundMotion, got " +
                         py::type::of(motion).attr("__name__").cast<std::string>());
  const auto& ground = motion.cast<const GroundMotion&>();
  if (!ground.has_transverse())
    throw std::invalid_argument(
        std::string(function) + ": a PlanarSlider needs both horizontal components; '" + ground.name() +
        "' has no transverse component: give GroundMotion(..., transverse=...), or read both with read_station(file)");
  return ground;
}

}  // namespace stickslip::python
