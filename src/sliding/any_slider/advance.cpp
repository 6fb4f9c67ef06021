// The event loop for sliders of any law.
#include "stickslip/sliding/any_slider.hpp"

namespace stickslip {
namespace {

/// Calls a function now and then.
struct Reporting {
  const std::function<void()>& progress;
  unsigned slides = 0;

  void slide(const Slip&) {
    if (++slides % 16384 == 0 && progress) progress();
  }
  void event(EventKind, double, const State&) noexcept {}
};

}  // namespace

void advance(const AnySlider& slider, const Segment& segment, State& state, Contact contact,
             const std::function<void()>& progress) {
  std::visit([&](const auto& one) { advance(one, segment, state, Reporting{progress}, contact); }, slider);
}

void advance(const AnySlider& slider, const LoadSegment& segment, State& state, Contact contact,
             const std::function<void()>& progress) {
  std::visit([&](const auto& one) { advance(one, segment, state, Reporting{progress}, contact); }, slider);
}

}  // namespace stickslip
