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

/// ERRATA (4.47): the number of lines that carry the band matters, not that of samples.
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

/// State for pickling: the excitation before refinement, and the refinement.
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

A sum of cosines with random phases, by one inverse FFT per motion, thesis (4.49)::

    n(m dt) = sum_k 2 sqrt(S(k domega) domega) cos(k domega m dt + phi_k),    k = 1 .. period / 2
    domega = 2 pi / (period dt)

(At the Nyquist frequency a line coincides with its mirror image; its variance is S domega instead of 2 S domega.)

Parameters
----------
spectrum : Spectrum
    Two-sided spectrum of the motion. An upper edge must be at or below the Nyquist frequency pi / dt; a spectrum
    without an upper edge is truncated there, see `lost_variance`.
dt : float
    Time between samples [s], positive and finite.
samples : int
    Number of samples of a motion, at least 2.
interpolation : {'linear', 'constant'}, optional
    Interpolation of the acceleration between samples.
correct_interpolation : bool, optional
    Interpolation attenuates high frequencies: it multiplies the Fourier amplitude at omega by sinc^2(omega dt / 2) if
    linear, by sinc if constant. The correction multiplies the samples by the reciprocal, so that the interpolated
    motion has the given spectrum, exactly at every line (thesis 4.58, with the errata: 1/sinc^4 in density).
random_amplitudes : bool, optional
    Use Rayleigh amplitudes: the motions are exactly Gaussian for any number of lines, but the variance differs between
    members. Otherwise, as in the thesis, only phases are random.
zero_frequency : bool, optional
    Include the line at zero frequency, with variance S(0) domega: a random constant for each member. Without it a
    motion of one whole period has zero mean, and a spectrum that extends to zero loses the band |omega| < domega / 2.
period : int, optional
    Number of samples after which the motion would repeat, at least `samples`, which is the default. With a longer
    period the lines are closer together, the end of a motion does not join its beginning, and a motion may have a mean.
    Use it against periodicity, and for bands that extend to zero or are narrow. The cost is proportional.
envelope : Envelope, optional
    Envelope that multiplies the samples.

Raises
------
ValueError
    A value out of range; a band beyond the Nyquist frequency (the message suggests dt); a band without a line (the
    message suggests a period).

Warns
-----
UserWarning
    Fewer than 30 effective lines carry the band; the message suggests a period.

Notes
-----
With fixed amplitudes the kurtosis is 3 - 1.5 / effective_lines: a nearly Gaussian motion needs many lines in the band,
not many samples.

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
           R"(Generate the motion of a member, from time 0 to `duration`.

Parameters
----------
seed, member : int
    From 0 to 2^64 - 1. They determine the motion: to the last bit on processors with the same instruction set and with
    the same FFTW, otherwise to round-off.

Returns
-------
GroundMotion)")
      .def("refined", &GaussianExcitation::refined, py::arg("factor"), R"(Sample the same motions with a finer step.

Lines, phases, amplitudes and duration do not change. With finer samples the interpolation is closer to the sum of
cosines: use this to verify that its error, which falls as dt^2 (linear) or dt (constant), is negligible.

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
    A factor of 0; more than 2147483647 samples in a period.)")
      .def_property_readonly("spectrum", &GaussianExcitation::spectrum, "The given spectrum.")
      .def_property_readonly("dt", &GaussianExcitation::dt, "Time between samples [s].")
      .def_property_readonly("samples", &GaussianExcitation::samples, "Number of samples of a motion.")
      .def_property_readonly("duration", &GaussianExcitation::duration, "Duration of a motion [s]: (samples - 1) dt.")
      .def_property_readonly(
          "interpolation", [](const GaussianExcitation& e) { return name_of(e.interpolation()); },
          "'linear' or 'constant'.")
      .def_property_readonly(
          "correct_interpolation", [](const GaussianExcitation& e) { return e.options().correct_interpolation; },
          "Whether the interpolated motion, rather than the samples, has the spectrum.")
      .def_property_readonly(
          "random_amplitudes", [](const GaussianExcitation& e) { return e.options().random_amplitudes; },
          "Whether amplitudes are random, not only phases.")
      .def_property_readonly(
          "zero_frequency", [](const GaussianExcitation& e) { return e.options().zero_frequency; },
          "Whether there is a line at zero frequency.")
      .def_property_readonly(
          "period", [](const GaussianExcitation& e) { return e.options().period; },
          "Number of samples after which a motion would repeat.")
      .def_property_readonly(
          "envelope", [](const GaussianExcitation& e) { return e.options().envelope; },
          "Envelope of the samples, or None.")
      .def_property_readonly("refinement", &GaussianExcitation::refinement,
                             "Factor by which the excitation was refined.")
      .def_property_readonly("line_spacing", &GaussianExcitation::line_spacing, "domega [rad/s].")
      .def_property_readonly("lines", &GaussianExcitation::lines, "Number of lines with an amplitude.")
      .def_property_readonly("effective_lines", &GaussianExcitation::effective_lines,
                             "(sum p)^2 / sum p^2 over the variances p that the lines give the samples.")
      .def_property_readonly("variance", &GaussianExcitation::variance,
                             "Expected variance of the samples [m^2/s^4], with the correction, without the envelope.")
      .def_property_readonly("lost_variance", &GaussianExcitation::lost_variance,
                             R"(Fraction of the variance of the spectrum beyond the Nyquist frequency, from 0 to 1.

1 for white noise, whose variance is infinite.)")
      .def_property_readonly("configuration", &GaussianExcitation::configuration,
                             "Everything that determines the motions, as a JSON object.")
      .def("__repr__", &repr_of_gaussian)
      .def(
          "__eq__", [](const GaussianExcitation& a, const GaussianExcitation& b) { return a == b; }, py::is_operator())
      .def("__hash__", [](const GaussianExcitation& e) { return py::hash(py::str(e.configuration())); })
      .def(py::pickle(&state, &restored));
}

}  // namespace stickslip::python
