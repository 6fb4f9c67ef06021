#include "stickslip/statistics/distribution.hpp"

#include <pybind11/stl.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "parts.hpp"
#include "stickslip/ensemble/random_slider.hpp"

namespace stickslip::python {

template <>
inline constexpr auto parts<Lognormal> = std::tuple(&Lognormal::median, &Lognormal::beta);
template <>
inline constexpr auto parts<Normal> = std::tuple(&Normal::mean, &Normal::std, &Normal::low, &Normal::high);
template <>
inline constexpr auto parts<Uniform> = std::tuple(&Uniform::low, &Uniform::high);

namespace {

template <class D>
void add_quantile(py::class_<D>& type) {
  type.def(
      "quantile",
      [](const D& self, const py::object& probability) {
        return of_each(probability, "probability", [&](double p) { return self.quantile(p); });
      },
      py::arg("probability"),
      R"(Quantile: the value that is not exceeded with a given probability.

Parameters
----------
probability : float or array_like
    In (0, 1).

Returns
-------
float or ndarray
    In the unit of the parameter.

Raises
------
ValueError
    A probability out of range.)");
}

/// The distribution of an object; a real number is one, too.
Distribution distribution_of(const py::handle& object) {
  if (py::isinstance<Lognormal>(object)) return object.cast<Lognormal>();
  if (py::isinstance<Normal>(object)) return object.cast<Normal>();
  if (py::isinstance<Uniform>(object)) return object.cast<Uniform>();
  return object.cast<double>();
}

}  // namespace

void bind_distributions(py::module_& m) {
  auto lognormal = value_class<Lognormal>(m, "Lognormal", R"(A random parameter whose logarithm is normal.

median * exp(beta Z), where Z is a standard normal number.

Parameters
----------
median : float
    Positive and finite, in the unit of the parameter.
beta : float
    Standard deviation of the logarithm, finite and at least 0.

Raises
------
ValueError
    A value out of range.)");
  lognormal.def(py::init<double, double>(), py::arg("median"), py::arg("beta"))
      .def_property_readonly("median", &Lognormal::median, "Median.")
      .def_property_readonly("beta", &Lognormal::beta, "Standard deviation of the logarithm.")
      .def("__repr__", [](const Lognormal& d) {
        return "Lognormal(median=" + detail::shortest(d.median()) + ", beta=" + detail::shortest(d.beta()) + ")";
      });
  add_quantile(lognormal);

  constexpr double infinity = std::numeric_limits<double>::infinity();
  auto normal = value_class<Normal>(m, "Normal", R"(A normal random parameter, truncated at bounds.

Values beyond the bounds do not occur; the density between them keeps its shape.

Parameters
----------
mean, std : float
    Mean and standard deviation without bounds; finite, std at least 0. In the unit of the parameter.
low, high : float, optional
    Bounds, low < high, at least one of them within 37 std of the mean; default: none.

Raises
------
ValueError
    A value out of range.)");
  normal
      .def(py::init<double, double, double, double>(), py::arg("mean"), py::arg("std"), py::arg("low") = -infinity,
           py::arg("high") = infinity)
      .def_property_readonly("mean", &Normal::mean, "Mean without bounds.")
      .def_property_readonly("std", &Normal::std, "Standard deviation without bounds.")
      .def_property_readonly("low", &Normal::low, "Lower bound.")
      .def_property_readonly("high", &Normal::high, "Upper bound.")
      .def("__repr__", [](const Normal& d) {
        return "Normal(mean=" + detail::shortest(d.mean()) + ", std=" + detail::shortest(d.std()) +
               (std::isfinite(d.low()) ? ", low=" + detail::shortest(d.low()) : "") +
               (std::isfinite(d.high()) ? ", high=" + detail::shortest(d.high()) : "") + ")";
      });
  add_quantile(normal);

  auto uniform =
      value_class<Uniform>(m, "Uniform", R"(A random parameter with a uniform distribution between two bounds.

Parameters
----------
low, high : float
    Bounds, finite, low <= high. In the unit of the parameter.

Raises
------
ValueError
    A value out of range.)");
  uniform.def(py::init<double, double>(), py::arg("low"), py::arg("high"))
      .def_property_readonly("low", &Uniform::low, "Lower bound.")
      .def_property_readonly("high", &Uniform::high, "Upper bound.")
      .def("__repr__", [](const Uniform& d) {
        return "Uniform(low=" + detail::shortest(d.low()) + ", high=" + detail::shortest(d.high()) + ")";
      });
  add_quantile(uniform);

  m.def(
      "draw",
      [](const std::vector<py::object>& distributions, std::uint64_t seed, std::uint64_t member) {
        std::vector<Distribution> all;
        for (const py::object& one : distributions) all.push_back(distribution_of(one));
        std::vector<double> values(all.size());
        detail::draw(all, seed, member, values);
        return values;
      },
      py::arg("distributions"), py::kw_only(), py::arg("seed"), py::arg("member"),
      "The parameters of a member of `stickslip.Random`; a number in place of a distribution is constant.");
  m.def(
      "quantile", [](const py::object& distribution, double p) { return quantile(distribution_of(distribution), p); },
      py::arg("distribution"), py::arg("probability"),
      "The quantile of a distribution; that of a number is the number.");
  m.def(
      "describe", [](const py::object& distribution) { return detail::describe(distribution_of(distribution)); },
      py::arg("distribution"), "A distribution as JSON.");
}

}  // namespace stickslip::python
