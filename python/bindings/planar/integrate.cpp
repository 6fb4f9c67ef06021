#include <optional>
#include <string>
#include <utility>

#include "bindings.hpp"
#include "planar/response.hpp"

namespace stickslip::python {
namespace {

PlanarResponseWithInputs integrate_planar(const AnyPlanarSlider& slider, const py::object& motion,
                                          const py::object& displacement, const py::object& velocity, bool settle,
                                          const std::string& contact, double sliding_distance,
                                          const std::optional<SurfaceHeat>& heat) {
  const GroundMotion& ground = both_components(motion, "integrate");
  const PlanarIntegrateOptions options{to_vector2(displacement, "integrate: displacement", "m"),
                                       to_vector2(velocity, "integrate: velocity", "m/s"),
                                       settle,
                                       contact_of(contact, "integrate"),
                                       check_for_interrupt,
                                       sliding_distance,
                                       heat.value_or(SurfaceHeat())};
  PlanarResponse response = naming_cause(py::cast(slider), detail::description(options.velocity), [&] {
    const py::gil_scoped_release released;
    return integrate(slider, ground, options);
  });
  return {std::move(response), py::cast(slider), motion};
}

}  // namespace

void bind_planar_integrate(py::module_& m) {
  m.def(
      "integrate", &integrate_planar, py::arg("slider"), py::arg("motion"), py::kw_only(),
      py::arg("displacement") = py::make_tuple(0.0, 0.0), py::arg("velocity") = py::make_tuple(0.0, 0.0),
      py::arg("settle") = false, py::arg("contact") = "flight", py::arg("sliding_distance") = 0.0,
      py::arg("heat") = py::none(),
      R"(With a `PlanarSlider`, both horizontal components of the ground motion act, and a vertical one. The motion must have
a transverse component. `displacement` and `velocity` are vectors of shape (2,), along the axis and along the transverse
direction, which is 90 degrees clockwise from the axis. Returns a `PlanarResponse`.

Accurate to 1e-12 of the scale of r, and to 1e-10 s in the times at which the slider stops; about 2 us per sample while
it slides. ValueError also for a motion without a transverse component.)");
}

}  // namespace stickslip::python
