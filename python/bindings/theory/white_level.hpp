// The level of white noise as Python gives it: a number, or a white Spectrum.
#pragma once

#include <pybind11/stl.h>

#include <variant>

#include "bindings.hpp"

namespace stickslip::python {

using AnyLevel = std::variant<double, Spectrum>;

inline theory::WhiteLevel white_level(const AnyLevel& s0) {
  return std::visit([](const auto& level) { return theory::WhiteLevel(level); }, s0);
}

}  // namespace stickslip::python
