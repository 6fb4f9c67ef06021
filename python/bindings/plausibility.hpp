// Warnings about arguments that are likely in another unit, by the ranges of stickslip/base/plausibility.hpp.
#pragma once

#include <pybind11/pybind11.h>

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "stickslip/base/plausibility.hpp"

namespace stickslip::python {

/// Warns with a PlausibilityWarning at the calling Python function; throws if warnings are errors.
inline void warn_of_unit(const std::string& text, int depth = 1) {
  const pybind11::object type = pybind11::module_::import("stickslip._core").attr("PlausibilityWarning");
  if (PyErr_WarnEx(type.ptr(), text.c_str(), depth) != 0) throw pybind11::error_already_set();
}

/// Warns of a value beyond the range of its quantity.
inline void check_unit(std::string_view quantity, const std::string& who, const std::string& name, double value,
                       int depth = 1) {
  if (plausible_range(quantity).holds(value)) return;
  if (const std::string text = implausibility(quantity, name, value); !text.empty())
    warn_of_unit(who + ": " + text, depth);
}
inline void check_unit(std::string_view quantity, const std::string& who, const std::string& name,
                       const std::optional<double>& value) {
  if (value) check_unit(quantity, who, name, *value);
}

/// Warns of the largest of several values beyond the range, else of the smallest: once, since they have one unit.
inline void check_unit(std::string_view quantity, const std::string& who, const std::string& name,
                       const std::vector<double>& values, int depth = 1) {
  std::optional<std::size_t> odd;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (plausible_range(quantity).holds(values[i]) || !std::isfinite(values[i])) continue;
    if (!odd || values[i] > values[*odd]) odd = i;
  }
  if (odd)
    check_unit(quantity, who, values.size() > 1 ? name + "[" + std::to_string(*odd) + "]" : name, values[*odd], depth);
}

}  // namespace stickslip::python
