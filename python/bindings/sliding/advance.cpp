#include "stickslip/sliding/advance.hpp"

#include <cmath>
#include <limits>
#include <optional>

#include "parts.hpp"

namespace stickslip::python {
namespace {

State advanced(const py::object& what, State state, double dt, double start, std::optional<double> end,
               double vertical_start, std::optional<double> vertical_end, const std::string& contact) {
  const auto slider = slider_of(what);
  if (!slider)
    throw py::type_error("advance: slider must be a Slider or a friction law, got " +
                         py::type::of(what).attr("__name__").cast<std::string>());
  detail::require(std::isfinite(dt) && dt >= 0, "advance: dt must be finite and at least 0", dt, "s");
  const Segment horizontal{dt, start, end.value_or(start)};
  const double up = vertical_end.value_or(vertical_start);
  const Contact lost = contact_of(contact, "advance");
  if (vertical_start == 0 && up == 0)
    advance(*slider, horizontal, state, lost, check_for_interrupt);
  else
    advance(*slider, detail::load_segment(horizontal, mounting_of(*slider).slope(), vertical_start, up), state, lost,
            check_for_interrupt);
  return state;
}

}  // namespace

void bind_advance(py::module_& m) {
  value_class<State>(m, "State", R"(State of a slider, which determines its future motion.

Parameters
----------
displacement : float, optional
    x relative to the ground [m].
velocity : float, optional
    x' relative to the ground [m/s]; 0 means at rest.
sliding_distance : float, optional
    Sliding distance so far, forward and backward alike [m], at least 0; for laws that depend on it, such as
    `Degrading`.
heat : SurfaceHeat, optional
    Heat left in the sliding surface, for laws that depend on its temperature: `KumarFriction`. Without it the surface
    is cold.)")
      .def(py::init([](double displacement, double velocity, double sliding_distance,
                       const std::optional<SurfaceHeat>& heat) {
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
        return "<State: x " + detail::shortest(state.displacement) + " m, x' " + detail::shortest(state.velocity) +
               " m/s, " +
               (state.in_flight               ? "in flight, gap " + detail::shortest(state.gap) + " m"
                : state.mode == Mode::stuck   ? std::string("stuck")
                : state.mode == Mode::forward ? std::string("sliding forward")
                                              : std::string("sliding backward")) +
               (state.sliding_distance > 0 ? ", slid " + detail::shortest(state.sliding_distance) + " m" : "") + ">";
      });
  m.def("advance", &advanced, py::arg("slider"), py::arg("state"), py::arg("dt"), py::arg("start"),
        py::arg("end") = py::none(), py::kw_only(), py::arg("vertical_start") = 0.0,
        py::arg("vertical_end") = py::none(), py::arg("contact") = "flight",
        R"(Advance a slider by one time step, for your own time loop.

x'' + resist N+/g sgn(x') + c x' + wn^2 x = p(t), see `Slider`, with all events within the step.

Parameters
----------
slider : Slider or friction law
state : State
    The state at the beginning of the step.
dt : float
    The time step [s], finite and at least 0.
start, end : float
    Horizontal ground acceleration n at the beginning and end of the step [m/s^2], linear in between; constant without
    `end`.
vertical_start, vertical_end : float, optional
    Upward ground acceleration [m/s^2], likewise.
contact : 'flight' or 'clipped', optional
    See `integrate`.

Returns
-------
State
    The state at the end of the step.

Raises
------
ValueError
    A number that is not finite; a state beyond a stop; a velocity that points where the slip level is infinite.
OverflowError
    The motion leaves the range of doubles.
ConvergenceError
    More than a million steps in closed form, or three million of a power series, within a hundredth of the step: the
    spring, damper, acceleration or slip level is too large for a step this long.

Notes
-----
As accurate as `integrate`; takes about 1 us per call.)");
}

}  // namespace stickslip::python
