#include "stickslip/state/state.hpp"

#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "parts.hpp"

namespace stickslip::python {

void bind_state(py::module_& m) {
  value_class<SurfaceHeat>(
      m, "SurfaceHeat",
      R"(Heat left in a sliding surface, `State.heat`: the memory of friction that depends on temperature.

Parameters
----------
modes : array_like, shape (42,), optional
    The modes [J/m^2]; a cold surface without them.

Raises
------
ValueError
    Another number of modes; one that is not finite.

Notes
-----
The surface of a half-space that was heated with q(t) [W/m^2] is warmer by sqrt(D) / (k sqrt(pi)) times the half-integral
H, the integral of q(t - tau) / sqrt(tau) over tau > 0. The kernel 1 / sqrt(tau) is a sum of 42 exponentials, each the
memory of one mode: H is within 6e-7 of its largest value, for heat that lasts from 1 us to 500 s.)")
      .def(py::init([](const py::object& modes) {
             if (modes.is_none()) return SurfaceHeat();
             const std::vector<double> values = to_vector(modes, "SurfaceHeat: modes", "J/m^2");
             std::array<double, SurfaceHeat::modes> all{};
             if (values.size() != all.size())
               throw std::invalid_argument("SurfaceHeat: modes must be " + std::to_string(all.size()) + ", got " +
                                           std::to_string(values.size()));
             std::copy(values.begin(), values.end(), all.begin());
             return SurfaceHeat(all);
           }),
           py::arg("modes") = py::none())
      .def_property_readonly(
          "modes",
          [](const SurfaceHeat& heat) {
            const auto values = heat.values();
            return to_array(std::vector<double>(values.begin(), values.end()));
          },
          "The modes [J/m^2], shape (42,).")
      .def_property_readonly("half_integral", &SurfaceHeat::half_integral, "H [W s^(1/2)/m^2].")
      .def("__repr__", [](const SurfaceHeat& heat) {
        return heat.half_integral() > 0
                   ? "<SurfaceHeat: half-integral " + digits(heat.half_integral()) + " W s^(1/2)/m^2>"
                   : std::string("<SurfaceHeat: cold>");
      });

  value_class<State>(m, "State", R"(State of a slider, which determines its future motion.

Parameters
----------
displacement : float, optional
    x relative to the ground [m].
velocity : float, optional
    x' relative to the ground [m/s]; 0 means at rest.
sliding_distance : float, optional
    Sliding distance so far, forward and backward alike [m], at least 0; for laws that depend on it.
heat : SurfaceHeat, optional
    Heat left in the sliding surface, for laws that depend on its temperature. Without it the surface is cold.)")
      .def(py::init([](double displacement, double velocity, double sliding_distance,
                       const std::optional<SurfaceHeat>& heat) {
             using detail::require;
             require(std::isfinite(displacement), "State: displacement must be finite", displacement, "m");
             require(std::isfinite(velocity), "State: velocity must be finite", velocity, "m/s");
             require(std::isfinite(sliding_distance) && sliding_distance >= 0,
                     "State: sliding_distance must be finite and at least 0", sliding_distance, "m");
             State state = State::at(displacement, velocity);
             state.sliding_distance = sliding_distance;
             if (heat) state.heat = *heat;
             return state;
           }),
           py::arg("displacement") = 0.0, py::arg("velocity") = 0.0, py::arg("sliding_distance") = 0.0,
           py::arg("heat") = py::none())
      .def_readonly("displacement", &State::displacement, "x [m].")
      .def_readonly("velocity", &State::velocity, "x' [m/s].")
      .def_property_readonly(
          "stuck", [](const State& state) { return state.mode == Mode::stuck; }, "Whether the slider sticks.")
      .def_readonly("in_flight", &State::in_flight, "Whether the slider has left the ground.")
      .def_readonly("gap", &State::gap, "Gap between slider and ground, in flight [m].")
      .def_readonly("gap_velocity", &State::gap_velocity, "Rate of change of the gap, in flight [m/s].")
      .def_readonly("sliding_distance", &State::sliding_distance,
                    "Sliding distance so far [m]; updated if the law depends on it, otherwise the value given.")
      .def_readonly("heat", &State::heat, "Heat left in the sliding surface; updated if the law depends on it.")
      .def("__repr__", [](const State& state) {
        return "<State: x " + digits(state.displacement) + " m, x' " + digits(state.velocity) + " m/s, " +
               (state.in_flight               ? "in flight, gap " + digits(state.gap) + " m"
                : state.mode == Mode::stuck   ? std::string("stuck")
                : state.mode == Mode::forward ? std::string("sliding forward")
                                              : std::string("sliding backward")) +
               (state.sliding_distance > 0 ? ", slid " + digits(state.sliding_distance) + " m" : "") + ">";
      });
}

}  // namespace stickslip::python
