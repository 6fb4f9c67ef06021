// A list of sliders or ground motions, of which each member draws one.
#pragma once

#include "bindings.hpp"

namespace stickslip::python {

struct Drawn {
  py::tuple items;
};

/// Whether a list is of ground motions; else it is one of sliders.
inline bool is_of_motions(const py::sequence& items) {
  return items.size() > 0 && py::isinstance<GroundMotion>(items[0]);
}

}  // namespace stickslip::python
