// Texts by which sliders in the plane are compared: in checkpoints of sweeps.
#pragma once

#include <string>

#include "stickslip/planar/slider.hpp"
#include "stickslip/slider/identity.hpp"

namespace stickslip {

/// Everything that the motion of a slider in the plane depends on, as a JSON object. It differs from the identity of
/// the same slider on one axis.
template <IsotropicLaw Law>
std::string identity(const PlanarSlider<Law>& slider) {
  return "{\"plane\": true, " + identity(slider.along_axis()).substr(1);
}

}  // namespace stickslip
