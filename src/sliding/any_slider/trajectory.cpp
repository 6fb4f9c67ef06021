// The continuous motion of sliders of any law.
#include "stickslip/sliding/trajectory.hpp"

#include <memory>

#include "stickslip/sliding/any_slider.hpp"

namespace stickslip {

template <Motion M>
std::unique_ptr<const Trajectory> trajectory(const AnySlider& slider, const M& motion, const Response& response) {
  return std::visit([&](const auto& one) { return trajectory(one, motion, response); }, slider);
}
template std::unique_ptr<const Trajectory> trajectory(const AnySlider&, const GroundMotion&, const Response&);
template std::unique_ptr<const Trajectory> trajectory(const AnySlider&, const HarmonicMotion&, const Response&);

}  // namespace stickslip
