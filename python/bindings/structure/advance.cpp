#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <type_traits>

#include "parts.hpp"
#include "structure/from_inputs.hpp"
#include "structure/structure.hpp"

namespace stickslip::python {
namespace {

StructureState state_from(const py::object& modal_displacement, const py::object& modal_velocity, double displacement,
                          double velocity, double sliding_distance, const std::optional<SurfaceHeat>& heat) {
  using detail::require;
  require(std::isfinite(displacement), "StructureState: displacement must be finite", displacement, "m");
  require(std::isfinite(velocity), "StructureState: velocity must be finite", velocity, "m/s");
  require(std::isfinite(sliding_distance) && sliding_distance >= 0,
          "StructureState: sliding_distance must be finite and at least 0", sliding_distance, "m");
  StructureState state{.displacement = displacement,
                       .velocity = velocity,
                       .mode = State::at(0, velocity).mode,
                       .sliding_distance = sliding_distance,
                       .modal_displacement = to_vector(modal_displacement, "StructureState: modal_displacement"),
                       .modal_velocity = to_vector(modal_velocity, "StructureState: modal_velocity"),
                       .heat = heat.value_or(SurfaceHeat())};
  const auto check_finite = [](const std::vector<double>& values, const std::string& name) {
    for (const double value : values)
      require(std::isfinite(value), "StructureState: " + name + " must be finite", value);
  };
  check_finite(state.modal_displacement, "modal_displacement");
  check_finite(state.modal_velocity, "modal_velocity");
  if (state.modal_displacement.size() != state.modal_velocity.size())
    throw std::invalid_argument(
        "StructureState: modal_displacement and modal_velocity must have one value per mode, got " +
        std::to_string(state.modal_displacement.size()) + " and " + std::to_string(state.modal_velocity.size()));
  return state;
}

// Hashable.
py::tuple in_numbers(const PendulumMemory& memory) {
  py::list values;
  for (const double place : memory.place) values.append(place);
  values.append(memory.force);
  for (const int one : {int{memory.direction}, int{memory.moving}, int{memory.at_forward}, int{memory.at_backward}})
    values.append(one);
  return py::tuple(values);
}

template <class System>
StructureState advanced(const System& system, StructureState state, double dt, double start, std::optional<double> end,
                        double vertical_start, std::optional<double> vertical_end) {
  detail::require(std::isfinite(dt) && dt >= 0, "advance: dt must be finite and at least 0", dt, "s");
  const Segment horizontal{dt, start, end.value_or(start)};
  const py::gil_scoped_release released;
  advance(system, detail::load_segment(horizontal, 0, vertical_start, vertical_end.value_or(vertical_start)), state);
  return state;
}

}  // namespace

void bind_structure_advance(py::module_& m) {
  made_from_inputs<StructureState>(
      m, "StructureState",
      R"(State of a structure with one sliding interface, which determines its future motion.

Parameters
----------
modal_displacement, modal_velocity : array_like, shape (n,)
    Of the modes of `Structure.modes` [m kg^(1/2); with from_modes m], and their rates. `rest` of the system gives those
    at rest.
displacement : float, optional
    x of the sliding interface [m], finite.
velocity : float, optional
    x' [m/s], finite; 0 means that it sticks.
sliding_distance : float, optional
    Path length so far [m], at least 0; for laws that depend on it.
heat : SurfaceHeat, optional
    Heat left in the sliding surface, for laws that depend on its temperature. Without it the surface is cold.)",
      [](const StructureState& s) {
        return py::make_tuple(plain(s.modal_displacement), plain(s.modal_velocity), s.displacement, s.velocity,
                              static_cast<int>(s.mode), s.sliding_distance, s.heat, in_numbers(s.pendulum));
      },
      [](const py::tuple& inputs) {
        StructureState state = state_from(inputs[0], inputs[1], inputs[2].cast<double>(), inputs[3].cast<double>(),
                                          inputs[5].cast<double>(), inputs[6].cast<SurfaceHeat>());
        state.mode = static_cast<Mode>(inputs[4].cast<int>());
        const py::tuple elements = inputs[7];
        for (std::size_t k = 0; k < state.pendulum.place.size(); ++k)
          state.pendulum.place[k] = elements[k].cast<double>();
        const auto rest = [&](std::size_t k) { return elements[state.pendulum.place.size() + k]; };
        state.pendulum.force = rest(0).cast<double>();
        state.pendulum.direction = rest(1).cast<std::int8_t>();
        state.pendulum.moving = rest(2).cast<std::uint8_t>();
        state.pendulum.at_forward = rest(3).cast<std::uint8_t>();
        state.pendulum.at_backward = rest(4).cast<std::uint8_t>();
        return state;
      })
      .def(py::init(&state_from), py::arg("modal_displacement"), py::arg("modal_velocity"), py::kw_only(),
           py::arg("displacement") = 0.0, py::arg("velocity") = 0.0, py::arg("sliding_distance") = 0.0,
           py::arg("heat") = py::none())
      .def_property_readonly(
          "modal_displacement", [](const StructureState& s) { return array_from(s.modal_displacement); },
          "Of the modes [m kg^(1/2); with from_modes m], shape (n,).")
      .def_property_readonly(
          "modal_velocity", [](const StructureState& s) { return array_from(s.modal_velocity); },
          "Rates of the modes, shape (n,).")
      .def_readonly("displacement", &StructureState::displacement, "x of the sliding interface [m].")
      .def_readonly("velocity", &StructureState::velocity, "x' [m/s].")
      .def_property_readonly(
          "stuck", [](const StructureState& s) { return s.mode == Mode::stuck; },
          "Whether the interface sticks; the structure may move.")
      .def_readonly("sliding_distance", &StructureState::sliding_distance,
                    "Path length so far [m]; updated if the law depends on it, otherwise the value given.")
      .def_readonly("heat", &StructureState::heat,
                    "Heat left in the sliding surface; updated if the law depends on it.")
      .def("__repr__", [](const StructureState& s) {
        return "<StructureState: x " + digits(s.displacement) + " m, x' " + digits(s.velocity) + " m/s, " +
               (s.mode == Mode::stuck     ? "stuck"
                : s.mode == Mode::forward ? "sliding forward"
                                          : "sliding backward") +
               (s.sliding_distance > 0 ? ", slid " + digits(s.sliding_distance) + " m" : "") + ">";
      });

  const auto bind = [&](auto* type, const char* doc) {
    m.def("advance", &advanced<std::remove_pointer_t<decltype(type)>>, py::arg("slider"), py::arg("state"),
          py::arg("dt"), py::arg("start"), py::arg("end") = py::none(), py::kw_only(), py::arg("vertical_start") = 0.0,
          py::arg("vertical_end") = py::none(), doc);
  };
  bind(
      static_cast<IsolatedStructure*>(nullptr),
      R"(With an `IsolatedStructure` or an `EquipmentOnFloor`, and a `StructureState`, the structure moves, too. Begin with
`rest()` of the structure, or with `StructureResponse.state`. Returns a `StructureState`. Where N < 0 the interface slides
without friction, as with contact='clipped'. As accurate as `integrate`.)");
  bind(static_cast<EquipmentOnFloor*>(nullptr), "");
}

}  // namespace stickslip::python
