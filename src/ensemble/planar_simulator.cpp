// Members with sliders of any law in the plane.
#include "stickslip/ensemble/detail/planar_simulator.hpp"

namespace stickslip::detail {

void simulate_member(const AnyPlanarSlider& slider, const GroundMotion& motion, bool settle, Contact contact,
                     const PlanarMemberPlace& place) {
  std::visit([&](const auto& one) { simulate_member(one, motion, settle, contact, place); }, slider);
}

}  // namespace stickslip::detail
