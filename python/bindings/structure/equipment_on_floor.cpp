#include "stickslip/structure/equipment_on_floor.hpp"

#include <pybind11/stl.h>

#include <cstddef>
#include <string>

#include "structure/from_inputs.hpp"
#include "structure/structure.hpp"

namespace stickslip::python {

void bind_equipment_on_floor(py::module_& m) {
  const auto inputs_of_equipment = [](const EquipmentOnFloor& s) {
    return py::make_tuple(s.slider(), s.structure(), s.floor(), s.mass());
  };
  made_from_inputs<EquipmentOnFloor>(m, "EquipmentOnFloor",
                                     R"(A slider on a floor of a structure that stands on the ground.

x is relative to the floor. With a mass, the structure feels the friction of the slider; while the slider sticks, its
mass is part of the floor. With mass=0 the floor moves as if there was no slider, and energies are those of the slider
per unit mass. Levels, spring, damper and energies are per unit mass of the slider.

Parameters
----------
slider : Slider or friction law
    As for `IsolatedStructure`.
structure : Structure
    With floors: if made by `from_modes`, with shapes.
floor : int
    Counted from 1, the lowest.
mass : float, optional
    Mass of the slider [kg], finite and at least 0; with `from_modes`, as a fraction of the mass of the structure.

Raises
------
ValueError
    A floor that does not exist; a negative mass; a slope; a law that is not covered.)",
                                     inputs_of_equipment,
                                     [](const py::tuple& inputs) {
                                       return EquipmentOnFloor(
                                           inputs[0].cast<const AnySlider&>(), inputs[1].cast<const Structure&>(),
                                           inputs[2].cast<std::ptrdiff_t>(), inputs[3].cast<double>());
                                     })
      .def(py::init<AnySlider, Structure, std::ptrdiff_t, double>(), py::arg("slider"), py::arg("structure"),
           py::kw_only(), py::arg("floor"), py::arg("mass") = 0.0)
      .def("rest", &EquipmentOnFloor::rest, "The `StructureState` at rest at x = 0, for `advance`.")
      .def_property_readonly("slider", &EquipmentOnFloor::slider, "The `Slider` on the floor.")
      .def_property_readonly("structure", &EquipmentOnFloor::structure, "The `Structure`.")
      .def_property_readonly("floor", &EquipmentOnFloor::floor, "The floor, counted from 1.")
      .def_property_readonly("mass", &EquipmentOnFloor::mass, "Mass of the slider [kg].")
      .def("__repr__", [inputs_of_equipment](const EquipmentOnFloor& s) {
        return "EquipmentOnFloor(" + py::repr(inputs_of_equipment(s)[0]).cast<std::string>() + ", " +
               description(s.structure()) + ", floor=" + std::to_string(s.floor()) +
               ", mass=" + detail::shortest(s.mass()) + ")";
      });
}

}  // namespace stickslip::python
