#include "stickslip/excitation/pulse_fit.hpp"

#include "parts.hpp"

namespace stickslip::python {

void bind_pulse_fit(py::module_& m) {
  value_class<PulseFit>(m, "PulseFit", "Pulses fitted to a spectrum, as `fit_pulses` returns them.")
      .def_readonly("half_width", &PulseFit::half_width, "Dt [s].")
      .def_readonly("half_width_error", &PulseFit::half_width_error,
                    "Standard error of the half width [s]; 0 for a fit to a given spectrum.")
      .def_readonly("intensity", &PulseFit::intensity,
                    "lambda sigma^2 [m^2/s^5]; a spectrum determines only this product.")
      .def_readonly("rms_acceleration", &PulseFit::rms_acceleration, "sigma_n of the pulses [m/s^2], thesis (5.61).")
      .def_readonly("center_frequency_hz", &PulseFit::center_frequency_hz, "f_c = 1 / (2 Dt) [Hz], thesis (5.60).")
      .def_readonly("misfit", &PulseFit::misfit, "The integral of abs(S - S of the pulses) over that of S, below 1.")
      .def("__repr__", [](const PulseFit& fit) {
        return "<PulseFit: half_width " + digits(fit.half_width) + " s, intensity " + digits(fit.intensity) +
               " m^2/s^5, misfit " + digits(fit.misfit) + ">";
      });

  m.def(
      "fit_pulses",
      [](const py::object& source) {
        const auto fit = [](const auto& from) {
          const py::gil_scoped_release free;
          return fit_pulses(from);
        };
        if (py::isinstance<Spectrum>(source)) return fit(source.cast<const Spectrum&>());
        if (py::isinstance<GroundMotion>(source)) return fit(source.cast<const GroundMotion&>());
        throw py::type_error("fit_pulses: source must be a GroundMotion or a Spectrum, got " +
                             py::str(py::type::of(source)).cast<std::string>());
      },
      py::arg("source"),
      R"(Fit the spectrum of symmetric rectangular pulses to that of a record, or to a spectrum.

Least squares over all frequencies, in Dt and lambda sigma^2, of the corrected (5.6) of the thesis::

    S(omega) = 8 lambda sigma^2 sin^4(omega Dt / 2) / (pi omega^2)

Use the result to define pulses like the record::

    fit = fit_pulses(record)
    PoissonPulses.from_earthquake(
        rms_acceleration=fit.rms_acceleration,
        center_frequency_hz=fit.center_frequency_hz,
        duration=strong_motion(record).duration,
    )

Parameters
----------
source : GroundMotion or Spectrum
    A record, of which the fit takes the strong motion, between 5 % and 95 % of the Arias intensity, as a portion of a
    stationary process. Or a spectrum of finite variance.

Returns
-------
PulseFit

Raises
------
ValueError
    No fit: the half width of the best pulses is above an eighth of the strong part or below a time step, or the misfit
    is 1 or more, as without any pulses. A motion of zeros; a spectrum of infinite variance.

Notes
-----
The fit is to the periodogram, without smoothing. The misfit and the standard error (which also holds for records that
are not made of pulses) use its average over a third of f_c. For a record made of pulses, the scatter of this average
causes a misfit of some 1.4 / sqrt(f_c x duration). Strong frequencies dominate such a fit; low ones, which move a
slider most, have no extra weight. `strong_motion` uses the ground velocity instead; if the two frequencies differ much,
the spectrum of the record has a different shape from that of the pulses.

Takes 3 ms for a record of 4,000 samples.

References
----------
Thesis 5.2 and 5.6 with the errata to (5.6).)");
  m.def("estimate_spectrum", &estimate_spectrum, py::arg("motion"), py::arg("bandwidth"),
        py::call_guard<py::gil_scoped_release>(),
        R"(Estimate the power spectrum of a record's strong motion, as a portion of a stationary process.

It is the periodogram of the part between 5 % and 95 % of the Arias intensity, without its mean, averaged over a band
about each frequency (Daniell).

Parameters
----------
motion : GroundMotion
    A record; its interpolation between samples is included.
bandwidth : float
    Bandwidth of the average [Hz], finite and at least 1 / duration of the strong part. The relative standard error of a
    value is 1 / sqrt(bandwidth x duration).

Returns
-------
Spectrum
    A table, at least up to twice the sampling rate of the record.

Raises
------
ValueError
    A bandwidth out of its range; a motion of zeros, see `strong_motion`.

References
----------
M. B. Priestley, Spectral Analysis and Time Series (1981), 6.2.)");
}

}  // namespace stickslip::python
