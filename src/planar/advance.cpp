// The event loop for sliders of any law in the plane.
#include "stickslip/planar/any_planar_slider.hpp"

namespace stickslip {
namespace {

/// Calls a function now and then.
struct Reporting {
  const std::function<void()>& progress;
  unsigned flows = 0;

  template <class Flow>
  void follow(const Flow&, double, double) {
    if (++flows % 4096 == 0 && progress) progress();
  }
  void event(EventKind, double, const PlanarState&) noexcept {}
};

}  // namespace

void advance(const AnyPlanarSlider& slider, const PlanarSegment& segment, PlanarState& state, Contact contact,
             const std::function<void()>& progress) {
  advance(slider, detail::load_segment(segment, mounting_of(slider).slope()), state, contact, progress);
}

void advance(const AnyPlanarSlider& slider, const PlanarLoadSegment& segment, PlanarState& state, Contact contact,
             const std::function<void()>& progress) {
  std::visit([&](const auto& one) { advance(one, segment, state, Reporting{progress}, contact); }, slider);
}

}  // namespace stickslip
