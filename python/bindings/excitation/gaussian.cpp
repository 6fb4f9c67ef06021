#include <pybind11/stl.h>

#include <cstdio>

#include "bindings.hpp"

namespace stickslip::python {
namespace {

constexpr double enough_lines = 30;

std::string rounded(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

/// ERRATA (4.47): what counts is the number of lines that carry the band, not that of samples.
void warn_of_few_lines(const GaussianExcitation& excitation) {
  const double effective = excitation.effective_lines();
  if (effective >= enough_lines) return;
  std::string text = "GaussianExcitation: the spectrum is carried by " + std::to_string(excitation.lines()) +
                     " lines, " + rounded(effective) + " in effect";
  if (!excitation.options().random_amplitudes)
    text += "; the kurtosis of the motions is " + rounded(3 - 1.5 / effective) + " instead of 3";
  try {
    const std::size_t period = excitation.period_for(enough_lines);
    text += "; period=" + std::to_string(period) + " would give at least " + rounded(enough_lines);
  } catch (const std::invalid_argument&) {
    text += "; no period is long enough for " + rounded(enough_lines);
  }
  if (PyErr_WarnEx(PyExc_UserWarning, text.c_str(), 1) != 0) throw py::error_already_set();
}

GaussianOptions options_of(const std::string& interpolation, bool correct_interpolation, bool random_amplitudes,
                           bool zero_frequency, std::optional<std::size_t> period, std::optional<Envelope> envelope) {
  if (period == 0) throw std::invalid_argument("GaussianExcitation: period must be positive, got 0");
  GaussianOptions options;
  options.interpolation = interpolation_of(interpolation, "GaussianExcitation");
  options.correct_interpolation = correct_interpolation;
  options.random_amplitudes = random_amplitudes;
  options.zero_frequency = zero_frequency;
  options.period = period.value_or(0);
  options.envelope = std::move(envelope);
  return options;
}

/// What makes it again: as it was before it was refined, and how often that was.
py::tuple state(const GaussianExcitation& e) {
  const GaussianOptions& o = e.options();
  return py::make_tuple(e.spectrum(), e.coarse_dt(), (e.samples() - 1) / e.refinement() + 1, name_of(o.interpolation),
                        o.correct_interpolation, o.random_amplitudes, o.zero_frequency, o.period / e.refinement(),
                        o.envelope, e.refinement());
}

GaussianExcitation restored(const py::tuple& t) {
  const GaussianExcitation coarse(
      t[0].cast<Spectrum>(), t[1].cast<double>(), t[2].cast<std::size_t>(),
      options_of(t[3].cast<std::string>(), t[4].cast<bool>(), t[5].cast<bool>(), t[6].cast<bool>(),
                 t[7].cast<std::size_t>(), t[8].cast<std::optional<Envelope>>()));
  return coarse.refined(t[9].cast<std::size_t>());
}

std::string repr_of_gaussian(const GaussianExcitation& e) {
  const GaussianOptions& o = e.options();
  const std::size_t samples = (e.samples() - 1) / e.refinement() + 1, period = o.period / e.refinement();
  const auto text_of = [](const auto& object) { return py::repr(py::cast(object)).template cast<std::string>(); };
  std::string text = "GaussianExcitation(" + text_of(e.spectrum()) + ", dt=" + detail::shortest(e.coarse_dt()) +
                     ", samples=" + std::to_string(samples);
  if (o.interpolation == Interpolation::constant) text += ", interpolation='constant'";
  if (!o.correct_interpolation) text += ", correct_interpolation=False";
  if (o.random_amplitudes) text += ", random_amplitudes=True";
  if (o.zero_frequency) text += ", zero_frequency=True";
  if (period != samples) text += ", period=" + std::to_string(period);
  if (o.envelope) text += ", envelope=" + text_of(*o.envelope);
  text += ")";
  return e.refinement() == 1 ? text : text + ".refined(" + std::to_string(e.refinement()) + ")";
}

}  // namespace

void bind_gaussian(py::module_& m) {
  py::class_<GaussianExcitation>(m, "GaussianExcitation",
                                 R"(A stationary Gaussian ground acceleration with a given spectrum.

A sum of cosines with random phases, by one inverse FFT a motion, thesis (4.49)::

    n(m dt) = sum_k 2 sqrt(S(k domega) domega) cos(k domega m dt + phi_k),    k = 1 .. period / 2
    domega = 2 pi / (period dt)

(At the Nyquist frequency a line and its mirror image are one, of variance S domega and not 2 S domega.)

Parameters
----------
spectrum : Spectrum
    Two-sided, of the motion. One with an upper edge must have it at or below the Nyquist frequency pi / dt; one without
    is cut there, see `lost_variance`.
dt : float
    Between samples [s], positive and finite.
samples : int
    Of one motion, at least 2.
interpolation : {'linear', 'constant'}, optional
    What the ground does between samples.
correct_interpolation : bool, optional
    Samples joined by lines lack high frequencies: the Fourier amplitude at omega is multiplied by sinc^2(omega dt / 2),
    by sinc where values are held. The correction gives the samples the reciprocal, so that the motion that acts has the
    spectrum that was asked for, exactly at every line (thesis 4.58, with the errata: 1/sinc^4 in density).
random_amplitudes : bool, optional
    Rayleigh amplitudes: each motion is truly Gaussian whatever the number of lines, but its own variance differs from
    member to member. Otherwise, as in the thesis, only phases are random.
zero_frequency : bool, optional
    The line at zero frequency too, with variance S(0) domega: a random constant for each member. Without it a motion of
    one whole period has no mean, and a spectrum that reaches down to zero loses the band |omega| < domega / 2.
period : int, optional
    Samples after which the motion would repeat itself; as many as there are, or more. A longer one puts the lines
    closer together, the end of a motion no longer joins its beginning, and a motion may have a mean: the remedy for
    periodicity, and for bands that reach zero or are narrow. Cost grows with it.
envelope : Envelope, optional
    Multiplies the samples.

Raises
------
ValueError
    A value out of range; a band beyond the Nyquist frequency (the message says which dt would do); a band in which
    no line lies (which period would do).

Warns
-----
UserWarning
    Where the band is carried by fewer than 30 effective lines; the message says which period would give as many.

Notes
-----
With fixed amplitudes the kurtosis is 3 - 1.5 / effective_lines: it takes many lines in the band to be Gaussian, not
many samples.

References
----------
M. Shinozuka, C.-M. Jan, Digital simulation of random processes and its applications, J. Sound Vib. 25 (1972), 111-128;
thesis 4.4.)")
      .def(py::init([](const Spectrum& spectrum, double dt, std::size_t samples, const std::string& interpolation,
                       bool correct_interpolation, bool random_amplitudes, bool zero_frequency,
                       std::optional<std::size_t> period, std::optional<Envelope> envelope) {
             GaussianExcitation result(spectrum, dt, samples,
                                       options_of(interpolation, correct_interpolation, random_amplitudes,
                                                  zero_frequency, period, std::move(envelope)));
             warn_of_few_lines(result);
             return result;
           }),
           py::arg("spectrum"), py::arg("dt"), py::arg("samples"), py::kw_only(), py::arg("interpolation") = "linear",
           py::arg("correct_interpolation") = true, py::arg("random_amplitudes") = false,
           py::arg("zero_frequency") = false, py::arg("period") = py::none(), py::arg("envelope") = py::none())
      .def("sample", py::overload_cast<std::uint64_t, std::uint64_t>(&GaussianExcitation::sample, py::const_),
           py::kw_only(), py::arg("seed"), py::arg("member"), py::call_guard<py::gil_scoped_release>(),
           R"(One motion, from time 0 to `duration`.

Parameters
----------
seed, member : int
    From 0 to 2^64 - 1. The same two give the same motion for ever: to the bit on processors of the same instruction set
    with the same FFTW, elsewhere to round-off.

Returns
-------
GroundMotion)")
      .def("refined", &GaussianExcitation::refined, py::arg("factor"), R"(The same motions sampled finer.

The same lines with the same phases and amplitudes, the same duration. Lines or steps between finer samples are nearer to
the sum of cosines, so that the error of the interpolation, which falls as dt^2 (linear) or dt (constant), can be seen
to vanish.

Parameters
----------
factor : int
    At least 1.

Returns
-------
GaussianExcitation

Raises
------
ValueError
    For 0, and for more than 2147483647 samples in a period.)")
      .def_property_readonly("spectrum", &GaussianExcitation::spectrum, "What was asked for.")
      .def_property_readonly("dt", &GaussianExcitation::dt, "Between samples [s].")
      .def_property_readonly("samples", &GaussianExcitation::samples, "Of one motion.")
      .def_property_readonly("duration", &GaussianExcitation::duration, "Of one motion [s]: (samples - 1) dt.")
      .def_property_readonly(
          "interpolation", [](const GaussianExcitation& e) { return name_of(e.interpolation()); },
          "'linear' or 'constant'.")
      .def_property_readonly(
          "correct_interpolation", [](const GaussianExcitation& e) { return e.options().correct_interpolation; },
          "Whether the motion that acts has the spectrum, rather than the samples.")
      .def_property_readonly(
          "random_amplitudes", [](const GaussianExcitation& e) { return e.options().random_amplitudes; },
          "Whether amplitudes are random, not only phases.")
      .def_property_readonly(
          "zero_frequency", [](const GaussianExcitation& e) { return e.options().zero_frequency; },
          "Whether there is a line at zero frequency.")
      .def_property_readonly(
          "period", [](const GaussianExcitation& e) { return e.options().period; },
          "Samples after which a motion would repeat itself.")
      .def_property_readonly(
          "envelope", [](const GaussianExcitation& e) { return e.options().envelope; }, "Of the samples, or None.")
      .def_property_readonly("refinement", &GaussianExcitation::refinement, "How many times finer than it was made.")
      .def_property_readonly("line_spacing", &GaussianExcitation::line_spacing, "domega [rad/s].")
      .def_property_readonly("lines", &GaussianExcitation::lines, "Number of lines with an amplitude.")
      .def_property_readonly("effective_lines", &GaussianExcitation::effective_lines,
                             "(sum p)^2 / sum p^2 over the variances p that the lines give the samples.")
      .def_property_readonly("variance", &GaussianExcitation::variance,
                             "Expected variance of the samples [m^2/s^4], correction included, envelope not.")
      .def_property_readonly("lost_variance", &GaussianExcitation::lost_variance,
                             R"(Share of the spectrum's variance beyond the Nyquist frequency, from 0 to 1.

1 for white noise, whose variance is infinite.)")
      .def_property_readonly("configuration", &GaussianExcitation::configuration,
                             "All that the motions depend on, as one JSON object.")
      .def("__repr__", &repr_of_gaussian)
      .def(
          "__eq__", [](const GaussianExcitation& a, const GaussianExcitation& b) { return a == b; }, py::is_operator())
      .def("__hash__", [](const GaussianExcitation& e) { return py::hash(py::str(e.configuration())); })
      .def(py::pickle(&state, &restored));
}

}  // namespace stickslip::python
