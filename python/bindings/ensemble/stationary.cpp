#include "stickslip/ensemble/stationary.hpp"

#include "parts.hpp"
#include "statistics/estimate.hpp"

namespace stickslip::python {

void bind_stationary(py::module_& m) {
  value_class<Stationary>(m, "Stationary",
                          R"(Averages over the central half of the motions, thesis 4.4, with standard errors.

The errors are those of the scatter between members. The averages estimate stationary values only where the velocity is
stationary from begin to end: see `remark`.)")
      .def_readonly("begin", &Stationary::begin, "From when on it was averaged [s].")
      .def_readonly("end", &Stationary::end, "Until when [s].")
      .def_readonly("velocity_mean", &Stationary::velocity_mean, "Of x' [m/s].")
      .def_readonly("velocity_variance", &Stationary::velocity_variance, "Of x' [m^2/s^2].")
      .def_readonly("velocity_kurtosis", &Stationary::velocity_kurtosis,
                    "Mean fourth power over the variance squared (Gaussian: 3, Laplace: 6); NaN at rest.")
      .def_readonly("covariance", &Stationary::covariance,
                    "Of x and x' [m^2/s]: half of the growth rate, thesis (5.59), with more scatter.")
      .def_readonly("growth_rate", &Stationary::growth_rate,
                    R"(Growth of the displacement variance [m^2/s].

Of D(t) = Var[x(begin + t) - x(begin)]: (D(T) - D(T/2)) / (T/2), with T from begin to end. What does not grow cancels.)")
      .def_readonly("velocity_trend", &Stationary::velocity_trend,
                    R"(Trend of the velocity variance [m^2/s^2]; NaN with fewer than four times.

Its average over the second half of begin to end, less that over the first.)")
      .def_readonly("remark", &Stationary::remark,
                    R"(Why the averages are not shown to be stationary values; empty where nothing speaks against it.

A trend speaks against it that is so many of its errors from 0, either way, as Student's t of members - 2 degrees of
freedom exceeds with probability 0.001, the rate of false alarms: 3.29 of many members. Where the halves are independent
that error is twice the one of velocity_variance: a linear drift stays unseen, half of the time, until its ends are 6.6
standard errors off the average. A variance that is the same in both halves and changes within them is not seen. Fewer
than eight members or four times cannot tell, and the remark says so.)")
      .def_property_readonly("is_stationary", &Stationary::is_stationary, "Whether the remark is empty.")
      .def("__repr__", [](const Stationary& s) {
        return "<Stationary: from " + digits(s.begin) + " to " + digits(s.end) + " s, velocity_variance " +
               with_error(s.velocity_variance) + " m^2/s^2, growth_rate " + with_error(s.growth_rate) + " m^2/s" +
               (s.is_stationary() ? ">" : ", not shown to be stationary>");
      });
}

}  // namespace stickslip::python
