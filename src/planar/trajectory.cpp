// The motion of sliders of any law in the plane between samples.
#include "stickslip/planar/any_planar_slider.hpp"

namespace stickslip {

// By the compiled `advance`, and not by the template, which would be compiled once more for each law.
std::vector<PlanarState> states_at(const AnyPlanarSlider& slider, const GroundMotion& motion,
                                   const PlanarResponse& response, std::span<const double> times) {
  return detail::planar_states(
      motion, mounting_of(slider).slope(), response, times,
      [&](const PlanarLoadSegment& segment, PlanarState& state) { advance(slider, segment, state, response.contact); });
}

}  // namespace stickslip
