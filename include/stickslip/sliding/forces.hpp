// The forces on a slider at the samples of its response.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "stickslip/base/equal.hpp"
#include "stickslip/base/min_max.hpp"
#include "stickslip/friction/law.hpp"
#include "stickslip/ground/motion.hpp"
#include "stickslip/ground/segment.hpp"
#include "stickslip/slider.hpp"
#include "stickslip/sliding/detail/load.hpp"
#include "stickslip/sliding/response.hpp"
#include "stickslip/state.hpp"
#include "stickslip/units.hpp"

namespace stickslip {

/// Forces per unit mass at the samples of a response [m/s^2], positive where they pull toward negative x:
///     x'' + friction + damper + spring = p,    on level ground p = -n,
/// so that the absolute acceleration of the mass along x is g sin(slope) - (friction + damper + spring). The force of a
/// stop is an impulse; the force that holds a slider at a stop counts as friction.
struct Forces {
  std::vector<double> friction;     ///< resist N+/g sgn(x') during a slip; p - spring while the slider sticks
  std::vector<double> damper;       ///< c x'
  std::vector<double> spring;       ///< wn^2 x; of a pendulum times N+/g
  std::vector<double> normal;       ///< N+, 0 while the slider is in flight
  std::vector<std::uint8_t> stuck;  ///< 1 while the slider sticks, else 0
  double downhill = 0;              ///< g sin(slope)

  /// The sum of friction, damper and spring [m/s^2].
  double total(std::size_t i) const noexcept { return friction[i] + damper[i] + spring[i]; }

  /// Absolute acceleration of the mass along x [m/s^2].
  double acceleration(std::size_t i) const noexcept { return downhill - total(i) + 0.0; }  // no minus zero
};

namespace detail {

/// The sliding distance along a response, from one sample or event to the next.
class SlidAlong {
 public:
  explicit SlidAlong(const Response& response) {
    if (!response.displacement.empty()) state_.displacement = response.displacement.front();
    state_.sliding_distance = std::max(response.state.sliding_distance - response.sliding_distance, 0.0);
  }

  /// x is monotonic between samples and events.
  const State& to(double displacement) noexcept {
    state_.sliding_distance += std::abs(displacement - state_.displacement);
    state_.displacement = displacement;
    return state_;
  }

 private:
  State state_;
};

/// The last sample of a response at or before a time.
template <Motion M>
std::size_t sample_at(const M& motion, const Response& response, double time) {
  std::size_t first = 0, last = response.displacement.size();
  while (last - first > 1) {
    const std::size_t middle = first + (last - first) / 2;
    (motion.time(middle) <= time ? first : last) = middle;
  }
  return first;
}

/// The heat of the surface at a time, from the temperatures at the samples with linear interpolation; none if the law
/// does not depend on it.
template <FrictionLaw Law, Motion M>
SurfaceHeat heat_at(const Law& law, const M& motion, const Response& response, double time) {
  if constexpr (HeatedLaw<Law>) {
    const std::vector<double>& celsius = response.temperature;
    const std::size_t i = std::min(sample_at(motion, response, time), celsius.size() - 2);
    const double from = motion.time(i), part = (time - from) / (motion.time(i + 1) - from);
    return SurfaceHeat::with(
        law.half_integral_at(std::lerp(celsius[i], celsius[i + 1], std::min(std::max(part, 0.0), 1.0))));
  } else {
    return {};
  }
}

/// Ground acceleration just after each of the first `samples` samples [m/s^2], of a component of a motion: at the end
/// of the motion the value just before it, then 0.
inline std::vector<double> acting(const GroundMotion& motion, std::span<const double> component, std::size_t samples) {
  std::vector<double> n(component.begin(), component.end());
  if (motion.interpolation() == Interpolation::constant &&
      !n.empty()) {                             // the last value never acts, nor do segments of
    const std::size_t end = motion.segments();  // zero duration
    std::size_t last = end - 1;
    while (equal(motion.time(last), motion.time(end))) --last;  // the duration is positive
    n[end] = n[last];
    for (std::size_t i = end; i-- > 0;)
      if (equal(motion.time(i), motion.time(i + 1))) n[i] = n[i + 1];
  }
  n.resize(samples);
  return n;
}

inline std::vector<double> acting(const GroundMotion& motion, std::size_t samples) {
  return acting(motion, motion.acceleration(), samples);
}
inline std::vector<double> acting_upward(const GroundMotion& motion, std::size_t samples) {
  return acting(motion, motion.vertical(), samples);
}
inline std::vector<double> acting_upward(const HarmonicMotion&, std::size_t samples) {
  return std::vector<double>(samples);
}

inline std::vector<double> acting(const HarmonicMotion& motion, std::size_t samples) {
  std::vector<double> n(samples);
  for (std::size_t i = 0; i < std::min(samples, motion.samples()); ++i) n[i] = motion.acceleration(motion.time(i));
  return n;
}

}  // namespace detail

/// The forces on a slider during a response.
///
/// At a sample at which a slip begins, reverses or stops, or a held ground acceleration jumps, the values are those
/// just after it. At the end of the ground motion they balance its last value (of held values, the last that acts);
/// after that the ground acceleration is 0.
///
/// @param slider    the slider
/// @param motion    its ground motion
/// @param response  the result of `integrate` for them
/// @return vectors as long as `response.displacement`
/// Friction is as accurate as the displacement and the velocity. One pass over the samples and events.
template <FrictionLaw Law, Motion M>
Forces forces(const Slider<Law>& slider, const M& motion, const Response& response) {
  const std::size_t samples = response.displacement.size();
  const std::vector<double> ground = detail::acting(motion, samples), up = detail::acting_upward(motion, samples);
  Forces result{std::vector<double>(samples), std::vector<double>(samples),       std::vector<double>(samples),
                std::vector<double>(samples), std::vector<std::uint8_t>(samples), 0};
  if (slider.slope() > 0) result.downhill = standard_gravity * std::sin(slider.slope());
  bool sticks = true, flies = false;
  const std::vector<Event>& events = response.events;
  std::size_t next = 0;  // the first event after the sample, or the end
  detail::SlidAlong slid(response);
  for (std::size_t i = 0; i < samples; ++i) {
    const double time = motion.time(i), x = response.displacement[i], v = response.velocity[i];
    for (; events[next].kind != EventKind::end && events[next].time <= time; ++next) {
      const EventKind kind = events[next].kind;
      if (kind == EventKind::breakaway || kind == EventKind::reversal) sticks = false;
      if (kind == EventKind::arrest) sticks = true;
      if (kind == EventKind::liftoff || kind == EventKind::landing) flies = kind == EventKind::liftoff;
      slid.to(events[next].displacement);
    }
    const LoadSegment here = detail::load_segment(Segment{0, ground[i], ground[i]}, slider.slope(), up[i], up[i]);
    const double load = here.load_start, normal = flies ? 0 : std::max(here.normal_start, 0.0);
    const double weight = normal / standard_gravity;
    result.normal[i] = normal;
    result.damper[i] = slider.damping() * v + 0.0;  // no minus zero
    result.spring[i] = slider.stiffness() * (slider.mounting().pendulum ? weight : 1) * x + 0.0;
    result.stuck[i] = sticks;
    if (sticks) {
      result.friction[i] = load - result.spring[i];
    } else {
      // If a slip begins at the sample, its direction is that of the next displacement, or of the load if that is
      // round-off.
      const double gone = events[next].displacement - events[next - 1].displacement;
      const double way = !detail::equal(v, 0) ? v : !detail::equal(gone, 0) ? gone : load - result.spring[i];
      const Direction direction = way < 0 ? Direction::backward : Direction::forward;
      State there = slid.to(x);
      there.heat = detail::heat_at(slider.law(), motion, response, time);
      const double level = resist(law_at(slider.law(), there, weight), x, std::abs(v), direction);
      result.friction[i] = sign(direction) * detail::weigh(weight, level) + 0.0;  // no minus zero
    }
  }
  return result;
}

template <FrictionLaw Law, Motion M>
Forces forces(const Law& law, const M& motion, const Response& response) {
  return forces(Slider<Law>(law), motion, response);
}

}  // namespace stickslip
