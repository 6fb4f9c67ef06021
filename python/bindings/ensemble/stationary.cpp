#include "stickslip/ensemble/stationary.hpp"

#include "parts.hpp"
#include "statistics/estimate.hpp"

namespace stickslip::python {

void bind_stationary(py::module_& m) {
  value_class<Stationary>(m, "Stationary",
                          R"(Averages over the central half of the motions, thesis 4.4, with standard errors.

The errors are from the scatter between members. The averages estimate stationary values only if the velocity is
stationary from begin to end: see `remark`.)")
      .def_readonly("begin", &Stationary::begin, "Begin of the average [s].")
      .def_readonly("end", &Stationary::end, "End of the average [s].")
      .def_readonly("velocity_mean", &Stationary::velocity_mean, "Mean of x' [m/s].")
      .def_readonly("velocity_variance", &Stationary::velocity_variance, "Variance of x' [m^2/s^2].")
      .def_readonly("velocity_kurtosis", &Stationary::velocity_kurtosis,
                    "Mean fourth power over the variance squared (Gaussian: 3, Laplace: 6); NaN at rest.")
      .def_readonly("covariance", &Stationary::covariance,
                    "Covariance of x and x' [m^2/s]: half of the growth rate, thesis (5.59), with more scatter.")
      .def_readonly("growth_rate", &Stationary::growth_rate,
                    R"(Growth of the displacement variance [m^2/s].

(D(T) - D(T/2)) / (T/2) with D(t) = Var[x(begin + t) - x(begin)], T from begin to end. Parts that do not grow cancel.)")
      .def_readonly("velocity_trend", &Stationary::velocity_trend,
                    R"(Trend of the velocity variance [m^2/s^2]; NaN with fewer than four times.

Average over the second half of the time from begin to end, minus that over the first half.)")
      .def_readonly("remark", &Stationary::remark,
                    R"(Why the averages are not shown to be stationary values; empty if there is no evidence against it.

The evidence is a significant trend of the velocity variance, by Student's t test with members - 2 degrees of freedom
and a false-alarm rate of 0.001: more than 3.29 standard errors for many members. If the halves are independent, the
standard error of the trend is twice that of velocity_variance: with a probability of one half, a linear drift goes
undetected until its ends are 6.6 standard errors off the average. Changes within the halves that leave their averages
equal are not detected. With fewer than eight members or four times the test is not possible, and the remark says so.)")
      .def_property_readonly("is_stationary", &Stationary::is_stationary, "Whether the remark is empty.")
      .def("__repr__", [](const Stationary& s) {
        return "<Stationary: from " + digits(s.begin) + " to " + digits(s.end) + " s, velocity_variance " +
               with_error(s.velocity_variance) + " m^2/s^2, growth_rate " + with_error(s.growth_rate) + " m^2/s" +
               (s.is_stationary() ? ">" : ", not shown to be stationary>");
      });
}

}  // namespace stickslip::python
