#include "stickslip/ground/strong_motion.hpp"

#include "parts.hpp"

namespace stickslip::python {

void bind_strong_motion(py::module_& m) {
  value_class<StrongMotion>(m, "StrongMotion", "What a record's strong motion is like; what `strong_motion` returns.")
      .def_readonly("peak_acceleration", &StrongMotion::peak_acceleration, "Of the whole record [m/s^2], the PGA.")
      .def_readonly(
          "peak_velocity", &StrongMotion::peak_velocity,
          "Of the whole record [m/s], the PGV: the ground from rest at the first sample, the baseline as it is.")
      .def_readonly(
          "peak_displacement", &StrongMotion::peak_displacement,
          "Of the whole record [m], the PGD: the ground from rest at the first sample, the baseline as it is.")
      .def_readonly("cumulative_absolute_velocity", &StrongMotion::cumulative_absolute_velocity,
                    R"(Of the whole record [m/s], the CAV: the integral of |n| dt.)")
      .def_readonly(
          "mean_period", &StrongMotion::mean_period,
          "Of the whole record [s], T_m of Rathje et al. (1998): the mean of 1 / f over 0.25 to 20 Hz, weighted "
          "with the squared Fourier amplitudes of the samples, to which zeros are added up to 20 s. NaN where "
          "samples are 2 s apart or more.")
      .def_readonly("arias_intensity", &StrongMotion::arias_intensity,
                    "Of the whole record [m/s]: pi / 2g times the integral of n^2 dt.")
      .def_readonly("begin", &StrongMotion::begin, "When 5 % of it have come [s].")
      .def_readonly("end", &StrongMotion::end, "When 95 % of it have come [s].")
      .def_readonly("duration", &StrongMotion::duration, "From begin to end [s], the significant duration D5-95.")
      .def_readonly("duration_5_75", &StrongMotion::duration_5_75,
                    "From begin to when 75 % of the Arias intensity have come [s], the significant duration D5-75.")
      .def_readonly("rms_acceleration", &StrongMotion::rms_acceleration, "Between begin and end [m/s^2].")
      .def_readonly("rms_velocity", &StrongMotion::rms_velocity,
                    "Of the ground between begin and end, about a straight line [m/s].")
      .def_readonly("centre_frequency_hz", &StrongMotion::centre_frequency_hz,
                    "f_c of the pulses with these rms values [Hz].")
      .def("__repr__", [](const StrongMotion& s) {
        return "<StrongMotion: from " + detail::shortest(s.begin) + " to " + detail::shortest(s.end) +
               " s, rms_acceleration " + detail::shortest(s.rms_acceleration) + " m/s^2, centre frequency " +
               detail::shortest(s.centre_frequency_hz) + " Hz>";
      });

  m.def("strong_motion", &strong_motion, py::arg("motion"), py::call_guard<py::gil_scoped_release>(),
        R"(Computes intensity measures of a record, and estimates what a pulse process needs to be like it.

PGA, PGV, PGD, CAV, Arias intensity, significant durations D5-75 and D5-95 and mean period are those of the field;
integrals and maxima are exact for lines and steps. Spectral accelerations come from `response_spectrum`.

The rms acceleration, the centre frequency and the duration make the pulse process of thesis 5.6::

    s = strong_motion(record)
    PoissonPulses.from_earthquake(
        rms_acceleration=s.rms_acceleration,
        centre_frequency_hz=s.centre_frequency_hz,
        duration=s.duration,
    )

The strong part is that between 5 % and 95 % of the Arias intensity. The centre frequency is that of the pulses whose
ground moves as fast for its acceleration as the record's: by (5.46), (5.61) and (5.60) sigma_n / sigma_v = sqrt(3) / Dt,
f_c = 1 / (2 Dt) = sigma_n / (2 sqrt(3) sigma_v). (Zero crossings would not do: the pulses' spectrum (5.6) falls off so
slowly that it has no second moment.) The ground velocity is that of the strong part about its straight line of least
squares: neither a constant error of the acceleration nor the unknown velocity at its beginning counts. Of pulses the
line takes away 3 Dt / T of the variance of the velocity, T the duration, which is given back: f_c is divided by
sqrt(1 + 3 / (2 f_c T)).

Parameters
----------
motion : GroundMotion
    A record, lines or steps; integrals are exact.

Returns
-------
StrongMotion

Raises
------
ValueError
    A motion without acceleration; one whose velocity is a straight line over all its strong part.

Notes
-----
Slow drifts of a record that bend within the strong part count as velocity and lower f_c: correct the baseline, or take
out what is slower than some ten seconds, first. One motion of 60 pulses has f_c within some 7 %, one standard error.

References
----------
A. Arias, A measure of earthquake intensity (1970); M. D. Trifunac, A. G. Brady, Bull. Seism. Soc. Am. 65 (1975),
581-626; E. M. Rathje, N. A. Abrahamson, J. D. Bray, J. Geotech. Geoenviron. Eng. 124 (1998), 150-159; thesis 5.6.)");
}

}  // namespace stickslip::python
