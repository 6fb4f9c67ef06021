#include "stickslip/statistics/moments.hpp"
#include <limits>

#include "parts.hpp"

namespace stickslip::python {
namespace {

template <Estimates Moments::*figure, std::vector<double> Estimates::*part>
py::array_t<double> by_time(const py::object& self) {
  return view(self.cast<const Moments&>().*figure.*part, self);
}

/// Moments of a user-defined theory.
Moments of_theory(const py::object& time, const py::object& displacement_mean, const py::object& displacement_variance,
                  const py::object& covariance, const py::object& velocity_mean, const py::object& velocity_variance,
                  double growth_rate, std::string remark) {
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> at = to_vector(time, "Moments: time", "s");
  const std::size_t count = at.size();
  const auto figure = [count](const py::object& given, const std::string& name, double otherwise) -> Estimates {
    std::vector<double> value =
        given.is_none() ? std::vector<double>(count, otherwise) : to_vector(given, "Moments: " + name);
    detail::require(value.size() == count,
                    "Moments: " + name + " must have as many values as there are times, " + std::to_string(count),
                    static_cast<double>(value.size()));
    return {std::move(value), std::vector<double>(count)};
  };
  return {std::move(at),
          figure(displacement_mean, "displacement_mean", 0),
          figure(displacement_variance, "displacement_variance", unknown),
          figure(covariance, "covariance", unknown),
          figure(velocity_mean, "velocity_mean", 0),
          figure(velocity_variance, "velocity_variance", unknown),
          {growth_rate, 0},
          std::move(remark)};
}

}  // namespace

void bind_moments(py::module_& m) {
  value_class<Moments>(m, "Moments", R"(Means and covariances of displacement and velocity by time.

The result of each theory's `predict`, and of `Ensemble.moments`. Arrays have shape (T,) and are read-only. The errors
are the standard errors of an ensemble; those of a theory are zero, because it has no scatter.

Parameters
----------
time : array_like, shape (T,)
    Times [s].
displacement_mean, velocity_mean : array_like, shape (T,), optional
    Means [m] and [m/s]; default: zeros.
displacement_variance, covariance, velocity_variance : array_like, shape (T,), optional
    Second moments [m^2], [m^2/s] and [m^2/s^2]; default: NaN, not predicted.
growth_rate : float, optional
    Growth rate of the displacement variance once the velocity is stationary [m^2/s]; default: NaN.
remark : str, optional
    A warning about the validity of the values.

Raises
------
ValueError
    Different numbers of values and times.)")
      .def(py::init(&of_theory), py::arg("time"), py::kw_only(), py::arg("displacement_mean") = py::none(),
           py::arg("displacement_variance") = py::none(), py::arg("covariance") = py::none(),
           py::arg("velocity_mean") = py::none(), py::arg("velocity_variance") = py::none(),
           py::arg("growth_rate") = std::numeric_limits<double>::quiet_NaN(), py::arg("remark") = "")
      .def_property_readonly(
          "time", [](const py::object& self) { return view(self.cast<const Moments&>().time, self); }, "Times [s].")
      .def_property_readonly("displacement_mean", &by_time<&Moments::displacement_mean, &Estimates::value>,
                             "Mean of x [m].")
      .def_property_readonly("displacement_mean_error", &by_time<&Moments::displacement_mean, &Estimates::error>,
                             "Standard error [m].")
      .def_property_readonly("displacement_variance", &by_time<&Moments::displacement_variance, &Estimates::value>,
                             "Variance of x [m^2].")
      .def_property_readonly("displacement_variance_error",
                             &by_time<&Moments::displacement_variance, &Estimates::error>, "Standard error [m^2].")
      .def_property_readonly("covariance", &by_time<&Moments::covariance, &Estimates::value>,
                             "Covariance of x and x' [m^2/s].")
      .def_property_readonly("covariance_error", &by_time<&Moments::covariance, &Estimates::error>,
                             "Standard error [m^2/s].")
      .def_property_readonly("velocity_mean", &by_time<&Moments::velocity_mean, &Estimates::value>, "Mean of x' [m/s].")
      .def_property_readonly("velocity_mean_error", &by_time<&Moments::velocity_mean, &Estimates::error>,
                             "Standard error [m/s].")
      .def_property_readonly("velocity_variance", &by_time<&Moments::velocity_variance, &Estimates::value>,
                             "Variance of x' [m^2/s^2].")
      .def_property_readonly("velocity_variance_error", &by_time<&Moments::velocity_variance, &Estimates::error>,
                             "Standard error [m^2/s^2].")
      .def_readonly(
          "growth_rate", &Moments::growth_rate,
          "Growth of the displacement variance once the velocity is stationary [m^2/s], as Estimate; NaN if it "
          "never is, or if unknown.")
      .def_readonly("remark", &Moments::remark, "A warning about the validity of the values; '' if there is none.")
      .def("__repr__", [](const Moments& moments) {
        return "<Moments at " + std::to_string(moments.time.size()) + " times" +
               (moments.remark.empty() ? "" : ": " + moments.remark) + ">";
      });
}

}  // namespace stickslip::python
