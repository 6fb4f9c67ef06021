// Warnings about arguments of laws and mountings that are likely in another unit: the only place of these rules.
#pragma once

#include <pybind11/pybind11.h>

#include <numbers>
#include <string>

#include "statistics/estimate.hpp"

namespace stickslip::python {

/// Warns with a PlausibilityWarning at the calling Python function; throws if warnings are errors.
inline void warn_of_unit(const std::string& text, int depth = 1) {
  const pybind11::object type = pybind11::module_::import("stickslip._core").attr("PlausibilityWarning");
  if (PyErr_WarnEx(type.ptr(), text.c_str(), depth) != 0) throw pybind11::error_already_set();
}

/// Coefficients of friction in use are at most 2.5 (rock joints, tan 68 degrees). Above 100 nothing is meant to slip.
inline void check_coefficient(const std::string& law, const std::string& name, double mu) {
  if (mu > 3 && mu <= 100)
    warn_of_unit(law + ": " + name + " = " + digits(mu) + " is more than any surface has; if it is in percent, give " +
                 name + "=" + digits(mu / 100));
}

/// Bearings carry 1 to 100 MPa.
inline void check_pressure(const std::string& law, const std::string& name, double pascal) {
  if (pascal > 0 && pascal < 1e5) {
    const bool mega = pascal <= 1e3;
    warn_of_unit(law + ": " + name + " = " + digits(pascal) +
                 " Pa is less than any bearing carries (1e6 to 1e8 Pa); if it is in " + (mega ? "MPa" : "kPa") +
                 ", give " + name + "=" + digits(pascal * (mega ? 1e6 : 1e3)));
  }
}

/// Liners have rates from 20 to 100 s/m, 0.2 to 1 s/cm.
inline void check_rate(const std::string& law, double rate) {
  if (rate > 0 && rate < 2)
    warn_of_unit(law + ": rate = " + digits(rate) + " s/m is far below that of any liner (20 to 100 s/m); if it is " +
                 "in " + (rate < 0.15 ? "s/mm" : "s/cm") + ", give rate=" + digits(rate * (rate < 0.15 ? 1000 : 100)));
}

/// A slope of less than one degree changes load and friction by less than 2 % of g.
inline void check_slope(double degrees) {
  if (degrees > 0 && degrees < 1)
    warn_of_unit("Slider: slope_degrees = " + digits(degrees) + " is almost level ground; if it is in radians, give " +
                 "slope_degrees=" + digits(degrees * 180 / std::numbers::pi));
}

}  // namespace stickslip::python
