// Members with sliders of any law.
#include "stickslip/ensemble/detail/simulator.hpp"

namespace stickslip::detail {

void simulate_member(const AnySlider& slider, const GroundMotion& motion, bool settle, Contact contact,
                     const MemberPlace& place) {
  std::visit([&](const auto& one) { simulate_member(one, motion, settle, contact, place); }, slider);
}

}  // namespace stickslip::detail
