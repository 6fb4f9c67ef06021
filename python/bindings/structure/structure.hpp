// Linear structures with one sliding interface.
#pragma once

#include <optional>
#include <string>
#include <variant>

#include "bindings.hpp"
#include "stickslip/structure/equipment_on_floor.hpp"
#include "stickslip/structure/flexible_slope.hpp"
#include "stickslip/structure/isolated_structure.hpp"

namespace stickslip::python {

/// A structure with one sliding interface.
using AnyStructure = std::variant<IsolatedStructure, EquipmentOnFloor, FlexibleSlope>;

/// The structure that an object is; nullopt for other objects.
inline std::optional<AnyStructure> structure_of(const py::handle& object) {
  if (py::isinstance<IsolatedStructure>(object)) return object.cast<const IsolatedStructure&>();
  if (py::isinstance<EquipmentOnFloor>(object)) return object.cast<const EquipmentOnFloor&>();
  if (py::isinstance<FlexibleSlope>(object)) return object.cast<const FlexibleSlope&>();
  return std::nullopt;
}

/// The text of a structure, also in that of what contains it.
std::string description(const Structure& structure);

void bind_structure(py::module_& m);
void bind_isolated_structure(py::module_& m);
void bind_equipment_on_floor(py::module_& m);
void bind_flexible_slope(py::module_& m);
void bind_structure_advance(py::module_& m);
void bind_structure_response(py::module_& m);

}  // namespace stickslip::python
