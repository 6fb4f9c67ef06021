#include "estimate.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

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

void bind_estimates(py::module_& m) {
  value_class<Estimate>(m, "Estimate", "A figure and its standard error, in the same unit.")
      .def_readonly("value", &Estimate::value, "The figure.")
      .def_readonly("error", &Estimate::error, "Its standard error, from the scatter between members.")
      .def("__repr__", [](const Estimate& e) { return "<Estimate: " + with_error(e) + ">"; });

  value_class<Interval>(m, "Interval", "A figure between its confidence bounds, in the same unit.")
      .def_readonly("value", &Interval::value, "The figure.")
      .def_readonly("low", &Interval::low, "Lower bound.")
      .def_readonly("high", &Interval::high, "Upper bound; infinite where the members are too few to bound it.")
      .def("__repr__", [](const Interval& i) {
        return "<Interval: " + digits(i.value) + ", from " + digits(i.low) + " to " + digits(i.high) + ">";
      });
}

}  // namespace stickslip::python
