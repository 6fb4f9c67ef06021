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
  value_class<PulseResponse>(m, "PulseResponse", R"(The motion that one pulse of ground acceleration causes.

Arrays are of shape (T,) and read-only.)")
      .def_property_readonly("time", &array<&PulseResponse::time>, "From the arrival of the pulse on [s].")
      .def_property_readonly("displacement", &array<&PulseResponse::displacement>, "x, less where it lay before [m].")
      .def_property_readonly("velocity", &array<&PulseResponse::velocity>, "x' [m/s].")
      .def_readonly("offset", &PulseResponse::offset,
                    "The last displacement [m], thesis (5.8); infinite where it never stops.")
      .def_readonly("peak", &PulseResponse::peak, "Largest |displacement| over all time [m].")
      .def_readonly("stop", &PulseResponse::stop, "When it has come to rest for good [s]; 0 if it never moves.")
      .def_readonly("velocity_square", &PulseResponse::velocity_square,
                    "Integral of x'^2 over all time [m^2/s], thesis (5.32).")
      .def("__repr__", [](const PulseResponse& r) {
        return "<PulseResponse: offset " + detail::shortest(r.offset) + " m, peak " + detail::shortest(r.peak) +
               " m, stop " + detail::shortest(r.stop) + " s>";
      });

  m.def("pulse_response", &respond, py::arg("slider"), py::arg("b"), py::arg("dt"), py::kw_only(),
        py::arg("shape") = py::none(), py::arg("position") = 0.0, py::arg("times") = py::none(),
        R"(What one pulse does to a slider at rest.

x'' + level sgn x' = -b w(t / dt), thesis (5.7), (5.8), (5.32). Coulomb friction in closed form, any other law by the
event loop: a pulse is a few held loads, and what it does is not random.

Parameters
----------
slider : Slider, Coulomb or Caster
    Without a spring.
b : float
    Amplitude [m/s^2], finite.
dt : float
    Half width [s], positive and finite; the unit of the times of `shape`.
shape : (array_like, array_like), optional
    The pulse w, as PoissonPulses takes it; the default is +1 for dt, then -1 for dt.
position : float, optional
    Where it lies before [m], finite: matters where the slip level depends on it.
times : array_like, optional
    Where to answer [s], shape (T,), ascending, finite, at least 0. Without: at the edges of the pulse, stops and turns,
    between which a Coulomb slider's velocity is straight.

Returns
-------
PulseResponse

Raises
------
ValueError
    A value out of range; a slider with a spring.

Notes
-----
Coulomb to round-off, others to about 1e-10.)");

  m.def(
      "viscous_pulse_response",
      [](double damping, double b, double dt, const py::object& times) {
        return theory::viscous_pulse_response(damping, b, dt, times_of(times, "viscous_pulse_response"));
      },
      py::arg("damping"), py::arg("b"), py::arg("dt"), py::kw_only(), py::arg("times") = py::none(),
      R"(What the symmetric rectangular pulse does to a mass on a viscous damper.

x'' + damping x' = -n(t), thesis (5.2), (5.14), corrected (5.15); in a form that does not cancel, down to no damping at
all. It leaves no offset, whatever the damping above 0.

Parameters
----------
damping : float
    zeta [1/s], finite and at least 0.
b : float
    Amplitude [m/s^2], finite.
dt : float
    Half width [s], positive and finite.
times : array_like, optional
    Where to answer [s], shape (T,), ascending, finite, at least 0. Without: 0, dt and 2 dt.

Returns
-------
PulseResponse
    `stop` is infinite (0 where b = 0).

Raises
------
ValueError
    A value out of range.)");

  m.def("viscous_damping_for", &theory::viscous_damping_for, py::arg("velocity_square"), py::arg("b"), py::arg("dt"),
        py::kw_only(), py::arg("window") = std::numeric_limits<double>::infinity(),
        R"(The viscous damping whose response to a pulse has the integral of x'^2 that is given.

Thesis figure 5.3, where both have the same rms velocity.

Parameters
----------
velocity_square : float
    The integral [m^2/s], `PulseResponse.velocity_square`; positive, below the 2 b^2 dt^3 / 3 of no damping (5.43).
b : float
    Amplitude [m/s^2], finite, not 0.
dt : float
    Half width [s], positive and finite.
window : float, optional
    From the arrival to when it is integrated [s], above 0.

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
