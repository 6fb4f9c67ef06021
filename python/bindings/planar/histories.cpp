#include "stickslip/planar/histories.hpp"

#include <utility>

#include "bindings.hpp"
#include "planar/response.hpp"

namespace stickslip::python {
namespace {

py::tuple histories_planar(const AnyPlanarSlider& slider, const py::object& motion) {
  const GroundMotion& ground = both_components(motion, "histories");
  PlanarHistories result = [&] {
    const py::gil_scoped_release released;
    return histories(slider, ground, check_for_interrupt);
  }();
  return py::make_tuple(array_of(std::move(result.displacement)), array_of(std::move(result.velocity)));
}

}  // namespace

void bind_planar_histories(py::module_& m) {
  m.def(
      "histories", &histories_planar, py::arg("slider"), py::arg("motion"),
      R"(With a `PlanarSlider`, both horizontal components of the ground motion act, and a vertical one. The motion must have
a transverse component. The arrays have the shape (samples, 2): along the axis, and along the transverse direction, 90
degrees clockwise from it. The same bits as `integrate`.)");
}

}  // namespace stickslip::python
