#include "estimate.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <optional>
#include <string>

#include "in_python.hpp"
#include "parts.hpp"

namespace stickslip::python {

std::string digits(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

std::string with_error(const Estimate& estimate) {
  if (!(estimate.error > 0) || !std::isfinite(estimate.error) || !std::isfinite(estimate.value))
    return digits(estimate.value) + " +- " + digits(estimate.error);
  const double largest = std::max(std::abs(estimate.value), estimate.error);
  const int places = 1 - static_cast<int>(std::floor(std::log10(estimate.error)));
  const int before = static_cast<int>(std::floor(std::log10(largest)));
  char text[96];
  if (places >= 0 && places <= 12)
    std::snprintf(text, sizeof text, "%.*f +- %.*f", places, estimate.value, places, estimate.error);
  else
    std::snprintf(text, sizeof text, "%.*e +- %.1e", std::clamp(places + before, 1, 16), estimate.value,
                  estimate.error);
  return text;
}

namespace {

/// The value of an estimate, an interval or a number; nullopt for other objects, such as arrays, which compare
/// elements.
std::optional<double> value_of(const py::object& object) {
  if (py::isinstance<Estimate>(object)) return object.cast<const Estimate&>().value;
  if (py::isinstance<Interval>(object)) return object.cast<const Interval&>().value;
  if (!PyFloat_Check(object.ptr()) && !PyLong_Check(object.ptr()) &&
      (!py::hasattr(object, "__float__") || py::hasattr(object, "__len__")))
    return std::nullopt;
  const double value = PyFloat_AsDouble(object.ptr());
  if (PyErr_Occurred()) throw py::error_already_set();
  return value;
}

/// Common to both: comparisons by value.
template <class T>
void add_value(py::class_<T>& type) {
  const auto compare = [&](const char* name, auto holds) {
    type.def(
        name,
        [holds](const T& self, const py::object& other) -> py::object {
          const std::optional<double> value = value_of(other);
          if (!value) return py::reinterpret_borrow<py::object>(Py_NotImplemented);
          return py::bool_(holds(self.value, *value));
        },
        py::is_operator(), py::arg("other"));
  };
  compare("__lt__", std::less<>());
  compare("__le__", std::less_equal<>());
  compare("__gt__", std::greater<>());
  compare("__ge__", std::greater_equal<>());
  type.def("__float__", [](const T& self) { return self.value; });
}

/// Products and quotients with a number, by `scaled(self, factor)`.
template <class T, class Scaled>
void add_products(py::class_<T>& type, const std::string& name, Scaled scaled) {
  const auto times = [&](const char* method, const char* what, auto factor_of) {
    type.def(
        method,
        [name, what, scaled, factor_of](const T& self, const py::object& other) -> py::object {
          std::optional<double> number;
          if (!py::isinstance<Estimate>(other) && !py::isinstance<Interval>(other)) number = value_of(other);
          if (!number) return py::reinterpret_borrow<py::object>(Py_NotImplemented);
          const double factor = factor_of(*number);
          detail::require(std::isfinite(factor), name + ": a " + what, *number);
          return py::cast(scaled(self, factor));
        },
        py::is_operator(), py::arg("other"));
  };
  const auto itself = [](double number) { return number; };
  times("__mul__", "factor must be finite", itself);
  times("__rmul__", "factor must be finite", itself);
  times("__truediv__", "divisor must be finite and not zero", [](double number) {
    return std::isfinite(number) && number != 0 ? 1 / number : std::numeric_limits<double>::quiet_NaN();
  });
  type.def("__neg__", [scaled](const T& self) { return scaled(self, -1); });
}

/// Formats a value with a Python format such as ".3f".
std::string formatted(double value, const py::str& specification) {
  return py::module_::import("builtins").attr("format")(value, specification).cast<std::string>();
}

}  // namespace

void bind_estimates(py::module_& m) {
  auto estimate = value_class<Estimate>(m, "Estimate", R"(A value and its standard error, in the same unit.

`value, error = estimate` unpacks it, `float(estimate)` is the value, and `f"{estimate:.3f}"` formats both.
`100 * estimate` and `estimate / 2` convert it to another unit. `<`, `<=`, `>` and `>=` compare the value, also with numbers; `==` compares both parts, only with other estimates.)");
  estimate.def_readonly("value", &Estimate::value, "The value.")
      .def_readonly("error", &Estimate::error, "Standard error, from the scatter between members.")
      .def("__iter__", [](const Estimate& e) { return py::iter(py::make_tuple(e.value, e.error)); })
      .def(
          "__format__",
          [](const py::object& self, const py::str& specification) -> std::string {
            if (py::len(specification) == 0) return py::str(self);
            const auto& e = self.cast<const Estimate&>();
            return formatted(e.value, specification) + " +- " + formatted(e.error, specification);
          },
          py::arg("specification"))
      .def("__repr__", [](const Estimate& e) { return "<Estimate: " + with_error(e) + ">"; });
  add_value(estimate);
  add_products(estimate, "Estimate", [](const Estimate& e, double factor) {
    return Estimate{e.value * factor, e.error * std::abs(factor)};
  });

  auto interval = value_class<Interval>(m, "Interval", R"(A value between its confidence bounds, in the same unit.

`value, low, high = interval` unpacks it, `float(interval)` is the value, and `f"{interval:.3f}"` formats all three.
`100 * interval` and `interval / 2` convert it to another unit; a negative factor exchanges the bounds.
`<`, `<=`, `>` and `>=` compare the value, also with numbers; `==` compares all parts, only with other intervals.)");
  interval.def_readonly("value", &Interval::value, "The value.")
      .def_readonly("low", &Interval::low, "Lower bound.")
      .def_readonly("high", &Interval::high, "Upper bound; infinite if there are too few members.")
      .def("__iter__", [](const Interval& i) { return py::iter(py::make_tuple(i.value, i.low, i.high)); })
      .def(
          "__format__",
          [](const py::object& self, const py::str& specification) -> std::string {
            if (py::len(specification) == 0) return py::str(self);
            const auto& i = self.cast<const Interval&>();
            return formatted(i.value, specification) + " (" + formatted(i.low, specification) + " to " +
                   formatted(i.high, specification) + ")";
          },
          py::arg("specification"))
      .def("__repr__",
           [](const Interval& i) {
             return "<Interval: " + digits(i.value) + ", from " + digits(i.low) + " to " + digits(i.high) + ">";
           })
      .def("_repr_html_", in_python("stickslip._html", "interval_html"));
  add_value(interval);
  add_products(interval, "Interval", [](const Interval& i, double factor) {
    const auto times = [&](double bound) { return factor != 0 ? bound * factor : 0; };  // of infinite bounds too
    const double low = times(i.low), high = times(i.high);
    return Interval{i.value * factor, std::min(low, high), std::max(low, high)};
  });
}

}  // namespace stickslip::python
