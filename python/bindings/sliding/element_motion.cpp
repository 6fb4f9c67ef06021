#include "stickslip/sliding/element_motion.hpp"

#include <cstdint>
#include <string>
#include <vector>

#include "parts.hpp"

namespace stickslip::python {
namespace {

template <auto member>
auto of() {
  return [](const ElementMotion& motion) { return array_of_rows(motion.*member); };
}
template <auto member>
auto each() {
  return [](const ElementMotion& motion) {
    return array_of(std::vector<double>((motion.*member).begin(), (motion.*member).end()));
  };
}
template <auto member>
auto counts() {
  return [](const ElementMotion& motion) {
    return array_of(std::vector<std::int64_t>((motion.*member).begin(), (motion.*member).end()));
  };
}

}  // namespace

void bind_element_motion(py::module_& m) {
  value_class<ElementMotion>(m, "ElementMotion", R"(The motion of the elements of a `MultiPendulum` during a response.

In the order of the series; of nested surfaces: lower and upper inner, then outward.)")
      .def_property_readonly("displacement", of<&ElementMotion::displacement>(),
                             "u_k at the samples of the response [m], shape (elements, samples).")
      .def_property_readonly("peak", each<&ElementMotion::peak>(), "Largest |u_k| over all time [m].")
      .def_property_readonly("dissipated", each<&ElementMotion::dissipated>(),
                             "Work against friction per unit mass [m^2/s^2]; the sum is `Response.energy.dissipated`.")
      .def_property_readonly("sliding_distance", each<&ElementMotion::sliding_distance>(), "Path length [m].")
      .def_property_readonly("slides", counts<&ElementMotion::slides>(),
                             "How many times the element began to move in one direction.")
      .def_property_readonly("stops", counts<&ElementMotion::stops>(), "How many times it came to its stop.")
      .def("__repr__", [](const ElementMotion& motion) {
        return "<ElementMotion: " + std::to_string(motion.peak.size()) + " elements>";
      });
  value_class<SurfaceMotion>(m, "SurfaceMotion", R"(The motion of the surfaces of a `MultiPendulum` during a response.

From bottom to top; the innermost surface of nested ones occurs twice.)")
      .def_property_readonly(
          "displacement", [](const SurfaceMotion& s) { return array_of_rows(s.motion.surfaces); },
          "At the samples of the response [m], shape (surfaces, samples).")
      .def_property_readonly(
          "peak", [](const SurfaceMotion& s) { return array_of(std::vector<double>(s.motion.surface_peak)); },
          "Largest displacement in magnitude over all time [m].")
      .def_property_readonly(
          "stops",
          [](const SurfaceMotion& s) {
            return array_of(std::vector<std::int64_t>(s.motion.surface_stops.begin(), s.motion.surface_stops.end()));
          },
          "How many times the surface came to its stop.")
      .def("__repr__", [](const SurfaceMotion& s) {
        return "<SurfaceMotion: " + std::to_string(s.motion.surface_peak.size()) + " surfaces>";
      });
}

}  // namespace stickslip::python
