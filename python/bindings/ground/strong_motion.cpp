#include "stickslip/ground/strong_motion.hpp"

#include "ground/suite.hpp"
#include "in_python.hpp"
#include "parts.hpp"
#include "statistics/estimate.hpp"

namespace stickslip::python {

void bind_strong_motion(py::module_& m) {
  value_class<StrongMotion>(m, "StrongMotion", "Intensity measures of a record, as `strong_motion` returns them.")
      .def_readonly("peak_acceleration", &StrongMotion::peak_acceleration, "PGA of the whole record [m/s^2].")
      .def_readonly("peak_velocity", &StrongMotion::peak_velocity,
                    "PGV of the whole record [m/s]; from rest at the first sample, without baseline correction.")
      .def_readonly("peak_displacement", &StrongMotion::peak_displacement,
                    "PGD of the whole record [m]; from rest at the first sample, without baseline correction.")
      .def_readonly("cumulative_absolute_velocity", &StrongMotion::cumulative_absolute_velocity,
                    R"(CAV of the whole record [m/s]: the integral of |n| dt.)")
      .def_readonly(
          "mean_period", &StrongMotion::mean_period,
          "Mean period T_m of the whole record [s], Rathje et al. (1998): the mean of 1 / f over 0.25 to 20 Hz, "
          "weighted "
          "with the squared Fourier amplitudes of the samples, zero-padded to 20 s. NaN if samples are 2 s apart or "
          "more.")
      .def_readonly("arias_intensity", &StrongMotion::arias_intensity,
                    "Arias intensity of the whole record [m/s]: pi / 2g times the integral of n^2 dt.")
      .def_readonly("begin", &StrongMotion::begin, "Time at which the Arias intensity reaches 5 % [s].")
      .def_readonly("end", &StrongMotion::end, "Time at which the Arias intensity reaches 95 % [s].")
      .def_readonly("duration", &StrongMotion::duration, "Significant duration D5-95, from begin to end [s].")
      .def_readonly("duration_5_75", &StrongMotion::duration_5_75,
                    "Significant duration D5-75, from 5 % to 75 % of the Arias intensity [s].")
      .def_readonly("rms_acceleration", &StrongMotion::rms_acceleration,
                    "Rms acceleration between begin and end [m/s^2].")
      .def_readonly("rms_velocity", &StrongMotion::rms_velocity,
                    "Rms ground velocity between begin and end, about a straight line [m/s].")
      .def_readonly("center_frequency_hz", &StrongMotion::center_frequency_hz,
                    "Center frequency f_c of the pulses with these rms values [Hz].")
      .def("__repr__",
           [](const StrongMotion& s) {
             return "<StrongMotion: PGA " + digits(s.peak_acceleration) + " m/s^2 (" +
                    digits(s.peak_acceleration / standard_gravity) + " g), PGV " + digits(s.peak_velocity) +
                    " m/s, Arias intensity " + digits(s.arias_intensity) + " m/s, D5-95 " + digits(s.duration) +
                    " s, center frequency " + digits(s.center_frequency_hz) + " Hz>";
           })
      .def("to_dataframe", in_python("stickslip.motions.tables", "strong_motion_to_dataframe"),
           R"(Convert the measures to a pandas DataFrame of one row.

The columns are named after the attributes; `df.attrs["units"]` has their units. ImportError without pandas.)")
      .def("to_csv", csv_in("stickslip.motions.tables", "strong_motion_to_csv"), py::arg("path"),
           csv_doc("Write the measures to a CSV file of one row, whole or not at all.").c_str())
      .def("to_json", in_python("stickslip.motions.tables", "strong_motion_to_json"),
           R"(The measures and their `units` as one JSON object (str); NaN is null.)")
      .def("_repr_html_", in_python("stickslip._html", "strong_motion_html"));

  m.def(
      "strong_motion",
      [](const py::object& motion) -> py::object {
        if (is_suite(motion)) return motion.attr("intensity_measures")();
        if (!py::isinstance<GroundMotion>(motion))
          throw py::type_error("strong_motion: motion must be a GroundMotion or a Suite, got " +
                               py::repr(motion).cast<std::string>());
        const auto& record = motion.cast<const GroundMotion&>();
        return py::cast([&] {
          const py::gil_scoped_release released;
          return strong_motion(record);
        }());
      },
      py::arg("motion"),
      R"(Compute intensity measures of a record, and estimate the parameters of an equivalent pulse process.

PGA, PGV, PGD, CAV, Arias intensity, significant durations D5-75 and D5-95 and mean period have their usual definitions;
integrals and maxima are exact for linear and constant interpolation. For spectral accelerations see
`response_spectrum`.

The rms acceleration, the center frequency and the duration define the pulse process of thesis 5.6::

    s = strong_motion(record)
    PoissonPulses.from_earthquake(
        rms_acceleration=s.rms_acceleration,
        center_frequency_hz=s.center_frequency_hz,
        duration=s.duration,
    )

The strong part is that between 5 % and 95 % of the Arias intensity. The center frequency is that of pulses with the
same ratio of rms ground acceleration to rms ground velocity as the record: by (5.46), (5.61) and (5.60) sigma_n /
sigma_v = sqrt(3) / Dt, f_c = 1 / (2 Dt) = sigma_n / (2 sqrt(3) sigma_v). (Zero crossings cannot be used: the spectrum
(5.6) of the pulses falls off so slowly that it has no second moment.) The ground velocity is that of the strong part
about its least-squares straight line, which removes a constant error of the acceleration and the unknown initial
velocity. For pulses, the line also removes 3 Dt / T of the variance of the velocity, where T is the duration; to
correct this, f_c is divided by sqrt(1 + 3 / (2 f_c T)).

Parameters
----------
motion : GroundMotion or Suite
    A record, with linear or constant interpolation; or a suite of them.

Returns
-------
StrongMotion, or IntensityMeasures of a suite

Raises
------
ValueError
    A motion of zeros; a motion whose velocity is a straight line over its whole strong part.

Notes
-----
Slow curved drifts within the strong part count as velocity and lower f_c: first correct the baseline, or filter out
periods above some ten seconds. For one motion of 60 pulses, the standard error of f_c is some 7 %.

References
----------
A. Arias, A measure of earthquake intensity (1970); M. D. Trifunac, A. G. Brady, Bull. Seism. Soc. Am. 65 (1975),
581-626; E. M. Rathje, N. A. Abrahamson, J. D. Bray, J. Geotech. Geoenviron. Eng. 124 (1998), 150-159; thesis 5.6.)");
}

}  // namespace stickslip::python
