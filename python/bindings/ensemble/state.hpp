// The content of an ensemble as arrays.
#pragma once

#include "bindings.hpp"

namespace stickslip::python {

py::dict state_of(const Ensemble& ensemble);

/// @throws std::invalid_argument  inconsistent arrays
Ensemble ensemble_of(const py::dict& state);

}  // namespace stickslip::python
