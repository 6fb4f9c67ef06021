#include "stickslip/planar/advance.hpp"

#include <cmath>
#include <optional>
#include <string>

#include "parts.hpp"

namespace stickslip::python {
namespace {

PlanarState advanced(const AnyPlanarSlider& slider, PlanarState state, double dt, const py::object& start,
                     const py::object& end, double vertical_start, std::optional<double> vertical_end,
                     const std::string& contact) {
  detail::require(std::isfinite(dt) && dt >= 0, "advance: dt must be finite and at least 0", dt, "s");
  const Vector2 first = to_vector2(start, "advance: start", "m/s^2");
  const PlanarSegment horizontal{dt, first, end.is_none() ? first : to_vector2(end, "advance: end", "m/s^2")};
  advance(slider,
          detail::load_segment(horizontal, mounting_of(slider).slope(), vertical_start,
                               vertical_end.value_or(vertical_start)),
          state, contact_of(contact, "advance"), check_for_interrupt);
  return state;
}

Vector2 finite_vector(const py::object& value, const std::string& name, const char* unit) {
  const Vector2 v = to_vector2(value, name, unit);
  detail::require(std::isfinite(v.axis), name + "[0] must be finite", v.axis, unit);
  detail::require(std::isfinite(v.transverse), name + "[1] must be finite", v.transverse, unit);
  return v;
}

template <auto member>
auto vector_of() {
  return [](const PlanarState& state) { return array_of(state.*member); };
}

}  // namespace

void bind_planar_advance(py::module_& m) {
  value_class<PlanarState>(m, "PlanarState", R"(State of a slider in the plane, which determines its future motion.

Parameters
----------
displacement : array_like, shape (2,), optional
    r relative to the ground, along the axis and along the transverse direction [m].
velocity : array_like, shape (2,), optional
    r' relative to the ground [m/s]; (0, 0) means at rest.
sliding_distance : float, optional
    Path length so far [m], at least 0; for laws that depend on it.
heat : SurfaceHeat, optional
    Heat left in the sliding surface, for laws that depend on its temperature. Without it the surface is cold.

Raises
------
ValueError
    Naming an entry that is not finite, or a negative distance.)")
      .def(py::init([](const py::object& displacement, const py::object& velocity, double sliding_distance,
                       const std::optional<SurfaceHeat>& heat) {
             PlanarState state = PlanarState::at(finite_vector(displacement, "PlanarState: displacement", "m"),
                                                 finite_vector(velocity, "PlanarState: velocity", "m/s"));
             detail::require(std::isfinite(sliding_distance) && sliding_distance >= 0,
                             "PlanarState: sliding_distance must be finite and at least 0", sliding_distance, "m");
             state.sliding_distance = sliding_distance;
             if (heat) state.heat = *heat;
             return state;
           }),
           py::arg("displacement") = py::make_tuple(0.0, 0.0), py::arg("velocity") = py::make_tuple(0.0, 0.0),
           py::arg("sliding_distance") = 0.0, py::arg("heat") = py::none())
      .def_property_readonly("displacement", vector_of<&PlanarState::displacement>(), "r [m], shape (2,).")
      .def_property_readonly("velocity", vector_of<&PlanarState::velocity>(), "r' [m/s], shape (2,).")
      .def_property_readonly(
          "stuck", [](const PlanarState& state) { return state.mode == PlanarMode::stuck; },
          "Whether the slider sticks.")
      .def_property_readonly(
          "along_stop", [](const PlanarState& state) { return state.mode == PlanarMode::along_stop; },
          "Whether the slider slides along a circular stop, pressed against it.")
      .def_readonly("in_flight", &PlanarState::in_flight, "Whether the slider has left the ground.")
      .def_readonly("gap", &PlanarState::gap, "Gap between slider and ground, in flight [m].")
      .def_readonly("gap_velocity", &PlanarState::gap_velocity, "Rate of change of the gap, in flight [m/s].")
      .def_readonly("sliding_distance", &PlanarState::sliding_distance, "Path length so far [m].")
      .def_readonly("heat", &PlanarState::heat, "Heat left in the sliding surface; updated if the law depends on it.")
      .def("__repr__", [](const PlanarState& state) {
        return "<PlanarState: r " + digits(state.displacement) + " m, r' " + digits(state.velocity) + " m/s, " +
               (state.in_flight                        ? "in flight, gap " + digits(state.gap) + " m"
                : state.mode == PlanarMode::stuck      ? std::string("stuck")
                : state.mode == PlanarMode::along_stop ? std::string("sliding along the stop")
                                                       : std::string("sliding")) +
               (state.sliding_distance > 0 ? ", slid " + digits(state.sliding_distance) + " m" : "") + ">";
      });
  m.def("advance", &advanced, py::arg("slider"), py::arg("state"), py::arg("dt"), py::arg("start"),
        py::arg("end") = py::none(), py::kw_only(), py::arg("vertical_start") = 0.0,
        py::arg("vertical_end") = py::none(), py::arg("contact") = "flight",
        R"(With a `PlanarSlider` and a `PlanarState`, `start` and `end` are the two horizontal components of the ground
acceleration, along the axis and along the transverse direction, of shape (2,). Returns a `PlanarState`. As accurate as
`integrate`; takes 1 to 2 us per call.)");
}

}  // namespace stickslip::python
