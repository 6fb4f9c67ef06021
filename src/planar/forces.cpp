// The forces on sliders of any law in the plane.
#include "stickslip/planar/any_planar_slider.hpp"

namespace stickslip {

PlanarForces forces(const AnyPlanarSlider& slider, const GroundMotion& motion, const PlanarResponse& response) {
  return std::visit([&](const auto& one) { return forces(one, motion, response); }, slider);
}

}  // namespace stickslip
