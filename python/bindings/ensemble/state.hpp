// All that an ensemble holds, as arrays.
#pragma once

#include "bindings.hpp"

namespace stickslip::python {

py::dict state_of(const Ensemble& ensemble);

/// @throws std::invalid_argument  arrays that do not fit together
Ensemble ensemble_of(const py::dict& state);

}  // namespace stickslip::python
