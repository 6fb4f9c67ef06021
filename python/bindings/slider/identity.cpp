#include "stickslip/slider/identity.hpp"

#include "bindings.hpp"
#include "carts/carts.hpp"
#include "stickslip/planar/any_planar_slider.hpp"
#include "stickslip/planar/identity.hpp"
#include "stickslip/structure/equipment_on_floor.hpp"
#include "stickslip/structure/flexible_slope.hpp"
#include "stickslip/structure/isolated_structure.hpp"

namespace stickslip::python {
namespace {

/// All numbers of a structure.
std::string text_of(const Structure& structure) {
  return py::repr(py::cast(structure).attr("__getstate__")()).cast<std::string>();
}

}  // namespace

void bind_identity(py::module_& m) {
  m.def(
      "identity", [](const AnySlider& slider) { return identity(slider); }, py::arg("of"), py::pos_only(),
      R"(Everything that the motion of a slider depends on, as JSON; for checkpoints.

The name and the parameters of the law, and the mounting. A law from functions is known by a few of its levels.)");
  m.def(
      "identity", [](const AnyPlanarSlider& slider) { return identity(slider); }, py::arg("of"), py::pos_only());
  m.def(
      "identity",
      [](const IsolatedStructure& one) {
        return identity(one.slider()) + " under " + text_of(one.structure()) + " on " +
               detail::shortest(one.base_mass());
      },
      py::arg("of"), py::pos_only());
  m.def(
      "identity",
      [](const EquipmentOnFloor& one) {
        return identity(one.slider()) + " of " + detail::shortest(one.mass()) + " on floor " +
               std::to_string(one.floor()) + " of " + text_of(one.structure());
      },
      py::arg("of"), py::pos_only());
  m.def(
      "identity", [](const FlexibleSlope& one) { return py::repr(py::cast(one)).cast<std::string>(); }, py::arg("of"),
      py::pos_only());
  m.def(
      "identity", [](const CartAsGiven& one) { return py::repr(py::cast(one)).cast<std::string>(); }, py::arg("of"),
      py::pos_only());
  m.def(
      "identity", [](const GroundMotion& motion) { return identity(std::span(&motion, 1)); }, py::arg("of"),
      py::pos_only(),
      R"(A digest of the samples of all components of a ground motion, their times and interpolation.

Names and orientations do not count.)");
}

}  // namespace stickslip::python
