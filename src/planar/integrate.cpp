// The integration of sliders of any law in the plane.
#include <utility>

#include "stickslip/planar/any_planar_slider.hpp"

namespace stickslip {

PlanarResponse integrate(const AnyPlanarSlider& slider, const GroundMotion& motion,
                         const PlanarIntegrateOptions& options, PlanarResponse storage) {
  return std::visit([&](const auto& one) { return integrate(one, motion, options, std::move(storage)); }, slider);
}

}  // namespace stickslip
