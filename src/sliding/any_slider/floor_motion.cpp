// The motion of the mass of sliders of any law.
#include "stickslip/sliding/any_slider.hpp"

namespace stickslip {

template <Motion M>
FloorMotion floor_motion(const AnySlider& slider, const M& motion, const Response& response, double tolerance) {
  return std::visit([&](const auto& one) { return floor_motion(one, motion, response, tolerance); }, slider);
}
template FloorMotion floor_motion(const AnySlider&, const GroundMotion&, const Response&, double);
template FloorMotion floor_motion(const AnySlider&, const HarmonicMotion&, const Response&, double);

}  // namespace stickslip
