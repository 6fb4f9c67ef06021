// The histories of sliders of any law in the plane.
#include "stickslip/planar/any_planar_slider.hpp"

namespace stickslip {

PlanarHistories histories(const AnyPlanarSlider& slider, const GroundMotion& motion,
                          const std::function<void()>& progress) {
  return std::visit([&](const auto& one) { return histories(one, motion, progress); }, slider);
}

}  // namespace stickslip
