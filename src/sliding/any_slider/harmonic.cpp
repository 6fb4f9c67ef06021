// The integration of sliders of any law under harmonic motion.
#include <utility>

#include "stickslip/sliding/any_slider.hpp"

namespace stickslip {

Response integrate(const AnySlider& slider, const HarmonicMotion& motion, const IntegrateOptions& options,
                   Response storage) {
  return std::visit([&](const auto& one) { return integrate(one, motion, options, std::move(storage)); }, slider);
}

}  // namespace stickslip
