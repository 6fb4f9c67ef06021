// The sensitivity of sliders of any law.
#include "stickslip/sliding/any_slider.hpp"

namespace stickslip {

Sensitivity sensitivity(const AnySlider& slider, const GroundMotion& motion, const Response& response,
                        Parameter parameter, std::optional<std::size_t> surface) {
  return std::visit([&](const auto& one) { return sensitivity(one, motion, response, parameter, surface); }, slider);
}

}  // namespace stickslip
