// Sliders of any law.
#include "stickslip/sliding/any_slider.hpp"

#include <memory>
#include <utility>

#include "stickslip/sliding/trajectory.hpp"

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

Response integrate(const AnySlider& slider, const GroundMotion& motion, const IntegrateOptions& options,
                   Response storage) {
  return std::visit([&](const auto& one) { return integrate(one, motion, options, std::move(storage)); }, slider);
}
Response integrate(const AnySlider& slider, const HarmonicMotion& motion, const IntegrateOptions& options,
                   Response storage) {
  return std::visit([&](const auto& one) { return integrate(one, motion, options, std::move(storage)); }, slider);
}

Histories histories(const AnySlider& slider, const GroundMotion& motion, const std::function<void()>& progress,
                    Histories storage) {
  return std::visit([&](const auto& one) { return histories(one, motion, progress, std::move(storage)); }, slider);
}

void advance(const AnySlider& slider, const Segment& segment, State& state, Contact contact,
             const std::function<void()>& progress) {
  std::visit([&](const auto& one) { advance(one, segment, state, Reporting{progress}, contact); }, slider);
}
void advance(const AnySlider& slider, const LoadSegment& segment, State& state, Contact contact,
             const std::function<void()>& progress) {
  std::visit([&](const auto& one) { advance(one, segment, state, Reporting{progress}, contact); }, slider);
}

template <Motion M>
std::unique_ptr<const Trajectory> trajectory(const AnySlider& slider, const M& motion, const Response& response) {
  return std::visit([&](const auto& one) { return trajectory(one, motion, response); }, slider);
}
template std::unique_ptr<const Trajectory> trajectory(const AnySlider&, const GroundMotion&, const Response&);
template std::unique_ptr<const Trajectory> trajectory(const AnySlider&, const HarmonicMotion&, const Response&);

Sensitivity sensitivity(const AnySlider& slider, const GroundMotion& motion, const Response& response,
                        Parameter parameter, std::optional<std::size_t> surface) {
  return std::visit([&](const auto& one) { return sensitivity(one, motion, response, parameter, surface); }, slider);
}

}  // namespace stickslip
