// The histories of sliders of any law.
#include "stickslip/sliding/any_slider.hpp"

namespace stickslip {

Histories histories(const AnySlider& slider, const GroundMotion& motion, const std::function<void()>& progress) {
  return std::visit([&](const auto& one) { return histories(one, motion, progress); }, slider);
}

}  // namespace stickslip
