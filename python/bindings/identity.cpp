#include "stickslip/identity.hpp"

#include "bindings.hpp"
#include "stickslip/planar/any_planar_slider.hpp"
#include "stickslip/planar/identity.hpp"

namespace stickslip::python {

void bind_identity(py::module_& m) {
  m.def(
      "identity", [](const AnySlider& slider) { return identity(slider); }, py::arg("of"), py::pos_only(),
      R"(Everything that the motion of a slider depends on, as JSON; for checkpoints.

The name and the parameters of the law, and the mounting. A law from functions is known by a few of its levels.)");
  m.def(
      "identity", [](const AnyPlanarSlider& slider) { return identity(slider); }, py::arg("of"), py::pos_only());
  m.def(
      "identity", [](const GroundMotion& motion) { return identity(std::span(&motion, 1)); }, py::arg("of"),
      py::pos_only(),
      R"(A digest of the samples of all components of a ground motion, their times and interpolation.

Names and orientations do not count.)");
}

}  // namespace stickslip::python
