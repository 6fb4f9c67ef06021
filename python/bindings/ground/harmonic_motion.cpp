#include <pybind11/stl.h>

#include <numbers>

#include "parts.hpp"

namespace stickslip::python {
namespace {

HarmonicMotion make_harmonic_motion(double amplitude, double omega, double duration, std::optional<double> dt) {
  check_unit("ground acceleration", "HarmonicMotion", "amplitude", amplitude);
  check_unit("angular frequency", "HarmonicMotion", "omega", omega);
  const HarmonicMotion made =
      dt ? HarmonicMotion(amplitude, omega, duration, *dt) : HarmonicMotion(amplitude, omega, duration);
  check_unit("pulses or cycles of a motion", "HarmonicMotion", "the number of cycles",
             omega * duration / (2 * std::numbers::pi));
  return made;
}

// An array of `value(time)` at the samples.
template <class Value>
py::array_t<double> over_samples(const HarmonicMotion& motion, Value&& value) {
  py::array_t<double> values(static_cast<py::ssize_t>(motion.samples()));
  double* v = values.mutable_data();
  for (std::size_t i = 0; i < motion.samples(); ++i) v[i] = value(motion.time(i));
  return values;
}

std::string arguments(const HarmonicMotion& m) {
  return "amplitude=" + detail::shortest(m.amplitude()) + ", omega=" + detail::shortest(m.omega()) +
         ", duration=" + detail::shortest(m.duration()) + ", dt=" + detail::shortest(m.dt());
}

}  // namespace

void bind_harmonic_motion(py::module_& m) {
  value_class<HarmonicMotion>(m, "HarmonicMotion", R"(Harmonic ground motion: -n(t) = B cos(omega t).

Thesis (2.28), from t = 0. The motion is not sampled: `integrate` solves the response to the cosine exactly. Samples
only determine where the response is output: at 0, dt, 2 dt, ... and at the end.

Parameters
----------
amplitude : float
    B [m/s^2], positive and at most 1e100.
omega : float
    Angular frequency [rad/s], positive, with a finite square.
duration : float
    Duration [s], positive and finite, at most 2^45 periods.
dt : float, optional
    Time between samples of the response [s], positive and finite; default: 1/64 of a period. The last step may be
    shorter; a dt longer than the duration leaves only its two ends. At most 2^40 samples.

Raises
------
ValueError
    An invalid value; the message names it.

Warns
-----
PlausibilityWarning
    An amplitude from 100 to 10,000 m/s^2, which may be in cm/s^2; more than 10,000 cycles: the duration may be in ms.

Notes
-----
omega t is reduced to one cycle with 150 bits of pi: the phase is accurate to round-off after any number of cycles.)")
      .def(py::init(&make_harmonic_motion), py::arg("amplitude"), py::arg("omega"), py::arg("duration"),
           py::arg("dt") = py::none())
      .def_property_readonly("amplitude", &HarmonicMotion::amplitude, "B [m/s^2].")
      .def_property_readonly("omega", &HarmonicMotion::omega, "Angular frequency [rad/s].")
      .def_property_readonly("period", &HarmonicMotion::period, "2 pi / omega [s].")
      .def_property_readonly("duration", &HarmonicMotion::duration, "Duration [s].")
      .def_property_readonly("dt", &HarmonicMotion::dt, "Time between samples [s]; the last step may be shorter.")
      .def_property_readonly(
          "time", [](const HarmonicMotion& h) { return over_samples(h, [](double t) { return t; }); },
          "Times of the samples [s], shape (N,).")
      .def_property_readonly(
          "acceleration",
          [](const HarmonicMotion& h) { return over_samples(h, [&](double t) { return h.acceleration(t); }); },
          "Ground acceleration n at the samples [m/s^2], shape (N,).")
      .def_property_readonly("peak_acceleration", &HarmonicMotion::amplitude,
                             "Largest magnitude of the ground acceleration [m/s^2]: B.")
      .def_property_readonly(
          "interpolation", [](const HarmonicMotion&) { return "linear"; },
          "'linear': for drawing the samples; the motion itself is the cosine.")
      .def_property_readonly(
          "name",
          [](const HarmonicMotion& h) {
            return detail::shortest(h.amplitude()) + " m/s^2 at " + detail::shortest(h.omega()) + " rad/s";
          },
          "A name for plots, with amplitude and frequency.")
      .def("sampled", &HarmonicMotion::sampled, py::arg("dt"),
           R"(Sample the motion, with straight lines between samples.

Parameters
----------
dt : float
    Time between samples [s], positive; the last sample may be after the end.

Returns
-------
GroundMotion)")
      .def("__len__", &HarmonicMotion::samples)
      .def("__repr__", [](const HarmonicMotion& h) { return "HarmonicMotion(" + arguments(h) + ")"; });
}

}  // namespace stickslip::python
