// A remark where nothing slips, but would if the accelerations were in g.
#pragma once

#include <string>

#include "bindings.hpp"

namespace stickslip::python {

/// Whether a slider at rest at x begins to slip under a motion.
template <FrictionLaw Law>
bool begins_to_slip(const Slider<Law>& slider, const GroundMotion& motion, double x) {
  const detail::Bounds bounds{slider.mounting().stops, slider.mounting().one_way};
  const detail::LoadPieces loads(motion, slider.slope());
  const auto slips = [&](double load, double normal) {
    const double weight = std::max(normal, 0.0) / standard_gravity,
                 net = load - slider.mounting().spring().under(weight) * x;
    const Direction direction = net < 0 ? Direction::backward : Direction::forward;
    const double level = bounds.bound(direction, x, hold(law_at(slider.law(), State::at(x, 0), weight), x, direction));
    return std::abs(net) > detail::weigh(weight, level);
  };
  for (std::size_t i = 0; i < motion.segments(); ++i) {
    const LoadSegment s = loads.segment(i);
    if (!(s.duration > 0)) continue;
    if (slips(s.load_start, s.normal_start) || slips(s.load_end, s.normal_end)) return true;
    const double part = s.normal_start / (s.normal_start - s.normal_end);  // where N crosses zero
    if (s.normal_start * s.normal_end < 0 && slips(std::lerp(s.load_start, s.load_end, part), 0)) return true;
  }
  return false;
}

/// The same in the plane, at rest at r. Within a segment the excess of the load over the level is convex.
template <IsotropicLaw Law>
bool begins_to_slip(const PlanarSlider<Law>& slider, const GroundMotion& motion, Vector2 r) {
  const detail::PlanarPieces pieces(motion, slider.slope());
  const auto exceeds = [&](Vector2 load, double normal) {
    const double weight = std::max(normal, 0.0) / standard_gravity;
    const double pull = slider.mounting().spring().under(weight);
    return norm(load - pull * r) > weight * hold(law_at(slider.law(), State{}, weight), 0.0, Direction::forward);
  };
  for (std::size_t i = 0; i < motion.segments(); ++i) {
    const PlanarLoadSegment s = pieces.segment(i);
    if (exceeds(s.load_start, s.normal_start) || exceeds(s.load_end, s.normal_end)) return true;
  }
  return false;
}

/// Records are below 4 g.
inline constexpr double most_g = 4;

/// The remark where nothing slips, but would if accelerations were in g.
inline std::string in_g_remark(double peak) {
  return "nothing slips: the peak ground acceleration is " + digits(peak) + " m/s^2 (" +
         digits(peak / standard_gravity) + " g); if the accelerations are in g, give units=\"g\": at " + digits(peak) +
         " g it slips";
}

/// The remark on a slider that did not slip; empty if it would not slip either if the accelerations were in g.
/// @param peak   peak ground acceleration [m/s^2]
/// @param place  where it rests
template <class Sliders, class Place>
std::string units_remark(const Sliders& slider, const GroundMotion& motion, double peak, Place place) {
  if (!(peak > 0 && peak <= most_g)) return "";
  const GroundMotion in_g = motion.scaled(standard_gravity);
  const bool slips = std::visit(
      [&](const auto& one) { return !begins_to_slip(one, motion, place) && begins_to_slip(one, in_g, place); }, slider);
  return slips ? in_g_remark(peak) : "";
}
inline std::string units_remark(const AnySlider& slider, const GroundMotion& motion, double x = 0) {
  return units_remark(slider, motion, motion.peak_acceleration(), x);
}
inline std::string units_remark(const AnyPlanarSlider& slider, const GroundMotion& motion, Vector2 r) {
  double peak = 0;
  for (std::size_t i = 0; i < motion.samples(); ++i)
    peak = std::max(peak, norm({motion.acceleration()[i], motion.transverse()[i]}));
  return units_remark(slider, motion, peak, r);
}

}  // namespace stickslip::python
