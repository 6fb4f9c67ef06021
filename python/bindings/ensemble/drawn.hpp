// A list of sliders or ground motions, from which each member draws one.
#pragma once

#include "bindings.hpp"

namespace stickslip::python {

struct Drawn {
  py::tuple items;
};

/// Whether a list holds ground motions; otherwise it holds sliders.
inline bool is_of_motions(const py::sequence& items) {
  return items.size() > 0 && py::isinstance<GroundMotion>(items[0]);
}

}  // namespace stickslip::python
