// The response of a structure together with its inputs.
#pragma once

#include <optional>

#include "bindings.hpp"
#include "stickslip/structure/sliding_structure.hpp"
#include "stickslip/structure/trajectory.hpp"

namespace stickslip::python {

/// What `integrate` returns for a structure: it is made again from its inputs when it is unpickled.
struct StructureResponseWithInputs {
  StructureResponse response;
  py::object system, motion;
  StructureIntegrateOptions options;
  py::object time{}, events{};
  std::optional<InterfacePoint> peak_force{};  // found on first access

  py::tuple inputs() const {
    return py::make_tuple(system, motion, options.displacement, options.velocity, options.settle,
                          options.sliding_distance, options.heat);
  }
};

/// @param system  an IsolatedStructure, an EquipmentOnFloor or a FlexibleSlope
StructureResponseWithInputs integrate_structure(const py::object& system, const py::object& motion, double displacement,
                                                double velocity, bool settle, double sliding_distance,
                                                const std::optional<SurfaceHeat>& heat);

}  // namespace stickslip::python
