#include "stickslip/theory/pulse_response.hpp"

#include <pybind11/stl.h>

#include "parts.hpp"

namespace stickslip::python {
namespace {

using theory::PulseResponse;

template <std::vector<double> PulseResponse::*figure>
py::array_t<double> array(const py::object& self) {
  return view(self.cast<const PulseResponse&>().*figure, self);
}

std::vector<double> times_of(const py::object& times, const char* who) {
  return times.is_none() ? std::vector<double>() : to_vector(times, std::string(who) + ": times", "s");
}

PulseResponse respond(const AnySlider& slider, double b, double dt,
                      const std::optional<std::pair<py::object, py::object>>& shape, double position,
                      const py::object& times) {
  PulseShape steps;
  if (shape)
    steps =
        PulseShape(to_vector(shape->first, "PulseShape: times", "s"), to_vector(shape->second, "PulseShape: values"));
  const std::vector<double> at = times_of(times, "pulse_response");
  const py::gil_scoped_release released;
  return with_position_law(slider, "pulse_response",
                           [&](const auto& s) { return theory::pulse_response(s, b, dt, steps, position, at); });
}

}  // namespace

void bind_pulse_response(py::module_& m) {
  value_class<PulseResponse>(m, "PulseResponse", R"(The response to one pulse of ground acceleration.

Arrays have shape (T,) and are read-only.)")
      .def_property_readonly("time", &array<&PulseResponse::time>, "Time since the arrival of the pulse [s].")
      .def_property_readonly("displacement", &array<&PulseResponse::displacement>,
                             "x relative to the initial position [m].")
      .def_property_readonly("velocity", &array<&PulseResponse::velocity>, "x' [m/s].")
      .def_readonly("offset", &PulseResponse::offset,
                    "Final displacement [m], thesis (5.8); infinite if the slider never stops.")
      .def_readonly("peak", &PulseResponse::peak, "Largest |displacement| over all time [m].")
      .def_readonly("stop", &PulseResponse::stop,
                    "Time at which the slider comes to rest finally [s]; 0 if it never moves.")
      .def_readonly("velocity_square", &PulseResponse::velocity_square,
                    "Integral of x'^2 over all time [m^2/s], thesis (5.32).")
      .def("__repr__", [](const PulseResponse& r) {
        return "<PulseResponse: offset " + digits(r.offset) + " m, peak " + digits(r.peak) + " m, stop " +
               digits(r.stop) + " s>";
      });

  m.def("pulse_response", &respond, py::arg("slider"), py::arg("b"), py::arg("dt"), py::kw_only(),
        py::arg("shape") = py::none(), py::arg("position") = 0.0, py::arg("times") = py::none(),
        R"(Compute the response of a slider at rest to one pulse.

x'' + level sgn x' = -b w(t / dt), thesis (5.7), (5.8), (5.32). Coulomb friction is solved in closed form, other
laws by the event loop, because a pulse consists of a few constant loads.

Parameters
----------
slider : Slider, Coulomb or Caster
    Without a spring.
b : float
    Amplitude [m/s^2], finite.
dt : float
    Half width [s], positive and finite; the unit of the times of `shape`.
shape : (array_like, array_like), optional
    The pulse w, as for PoissonPulses; the default is +1 for dt, then -1 for dt.
position : float, optional
    Initial position [m], finite; matters if the slip level depends on position.
times : array_like, optional
    Times of the result [s], shape (T,), ascending, finite, at least 0. Default: edges of the pulse, stops and
    reversals, between which the velocity of a Coulomb slider is linear.

Returns
-------
PulseResponse

Raises
------
ValueError
    A value out of range; a slider with a spring.

Notes
-----
Accurate to round-off for Coulomb friction, to about 1e-10 for other laws.)");

  m.def(
      "viscous_pulse_response",
      [](double damping, double b, double dt, const py::object& times) {
        return theory::viscous_pulse_response(damping, b, dt, times_of(times, "viscous_pulse_response"));
      },
      py::arg("damping"), py::arg("b"), py::arg("dt"), py::kw_only(), py::arg("times") = py::none(),
      R"(Compute the response of a mass with a viscous damper to the symmetric rectangular pulse.

x'' + damping x' = -n(t), thesis (5.2), (5.14), corrected (5.15); in a form without cancellation, down to zero
damping. The pulse leaves no offset for any damping above 0.

Parameters
----------
damping : float
    zeta [1/s], finite and at least 0.
b : float
    Amplitude [m/s^2], finite.
dt : float
    Half width [s], positive and finite.
times : array_like, optional
    Times of the result [s], shape (T,), ascending, finite, at least 0. Default: 0, dt and 2 dt.

Returns
-------
PulseResponse
    `stop` is infinite (0 if b = 0).

Raises
------
ValueError
    A value out of range.)");

  m.def("viscous_damping_for", &theory::viscous_damping_for, py::arg("velocity_square"), py::arg("b"), py::arg("dt"),
        py::kw_only(), py::arg("window") = std::numeric_limits<double>::infinity(),
        R"(Find the viscous damping whose response to a pulse has a given integral of x'^2.

Used in thesis figure 5.3, where both responses have the same rms velocity.

Parameters
----------
velocity_square : float
    The integral [m^2/s], `PulseResponse.velocity_square`; positive, below 2 b^2 dt^3 / 3, the value without damping
    (5.43).
b : float
    Amplitude [m/s^2], finite, not 0.
dt : float
    Half width [s], positive and finite.
window : float, optional
    Duration of the integral from the arrival of the pulse [s], above 0.

Returns
-------
float
    zeta [1/s], to round-off.

Raises
------
ValueError
    A value out of range.)");
}

}  // namespace stickslip::python
