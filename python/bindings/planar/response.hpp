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
/// @param where  the function that asks, for messages, and `what` moves
inline const GroundMotion& both_components(const GroundMotion& motion, const std::string& where,
                                           const std::string& what) {
  if (!motion.has_transverse())
    throw std::invalid_argument(
        where + ": a " + what + " needs both horizontal components; '" + motion.name() +
        "' has no transverse component: give GroundMotion(..., transverse=...), or read both with read_station(file)");
  return motion;
}
inline const GroundMotion& both_components(const py::object& motion, const std::string& where,
                                           const std::string& what = "PlanarSlider") {
  if (!py::isinstance<GroundMotion>(motion))
    throw py::type_error(where + ": the motion of a " + what + " must be a GroundMotion, got " +
                         py::type::of(motion).attr("__name__").cast<std::string>());
  return both_components(motion.cast<const GroundMotion&>(), where, what);
}

}  // namespace stickslip::python
