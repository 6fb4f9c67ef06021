#include "stickslip/statistics/moments.hpp"
#include "parts.hpp"

namespace stickslip::python {
namespace {

template <Estimates Moments::*figure, std::vector<double> Estimates::*part>
py::array_t<double> by_time(const py::object& self) {
  return view(self.cast<const Moments&>().*figure.*part, self);
}

}  // namespace

void bind_moments(py::module_& m) {
  value_class<Moments>(m, "Moments", R"(Means and covariances of displacement and velocity by time.

What each theory's `predict` answers, and `Ensemble.moments`. Arrays are of shape (T,) and read-only. The errors are
standard errors of an ensemble; those of a theory are zero: it has no scatter, and is wrong by what it neglects.)")
      .def_property_readonly(
          "time", [](const py::object& self) { return view(self.cast<const Moments&>().time, self); }, "Times [s].")
      .def_property_readonly("displacement_mean", &by_time<&Moments::displacement_mean, &Estimates::value>,
                             "Mean of x [m].")
      .def_property_readonly("displacement_mean_error", &by_time<&Moments::displacement_mean, &Estimates::error>,
                             "Its standard error [m].")
      .def_property_readonly("displacement_variance", &by_time<&Moments::displacement_variance, &Estimates::value>,
                             "Variance of x [m^2].")
      .def_property_readonly("displacement_variance_error",
                             &by_time<&Moments::displacement_variance, &Estimates::error>, "Its standard error [m^2].")
      .def_property_readonly("covariance", &by_time<&Moments::covariance, &Estimates::value>,
                             "Covariance of x and x' [m^2/s].")
      .def_property_readonly("covariance_error", &by_time<&Moments::covariance, &Estimates::error>,
                             "Its standard error [m^2/s].")
      .def_property_readonly("velocity_mean", &by_time<&Moments::velocity_mean, &Estimates::value>, "Mean of x' [m/s].")
      .def_property_readonly("velocity_mean_error", &by_time<&Moments::velocity_mean, &Estimates::error>,
                             "Its standard error [m/s].")
      .def_property_readonly("velocity_variance", &by_time<&Moments::velocity_variance, &Estimates::value>,
                             "Variance of x' [m^2/s^2].")
      .def_property_readonly("velocity_variance_error", &by_time<&Moments::velocity_variance, &Estimates::error>,
                             "Its standard error [m^2/s^2].")
      .def_readonly(
          "growth_rate", &Moments::growth_rate,
          "Growth of the displacement variance once the velocity is stationary [m^2/s], as Estimate; NaN where "
          "it never is, or is not known.")
      .def_readonly("remark", &Moments::remark, "What to know before trusting the figures; '' where there is nothing.")
      .def("__repr__", [](const Moments& moments) {
        return "<Moments at " + std::to_string(moments.time.size()) + " times" +
               (moments.remark.empty() ? "" : ": " + moments.remark) + ">";
      });
}

}  // namespace stickslip::python
