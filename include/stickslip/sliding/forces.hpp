// The forces on a slider at the samples of its response.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "stickslip/detail/min_max.hpp"
#include "stickslip/friction/law.hpp"
#include "stickslip/ground/motion.hpp"
#include "stickslip/slider.hpp"
#include "stickslip/sliding/response.hpp"
#include "stickslip/state.hpp"

namespace stickslip {

/// Forces per unit mass at the samples of a response [m/s^2], positive where they pull toward negative x:
///     x'' + friction + damper + spring = -n,
/// so that the absolute acceleration of the mass is x'' + n = -(friction + damper + spring).
struct Forces {
  std::vector<double> friction;     ///< resist sgn(x') during a slip; -n - wn^2 x while the slider sticks
  std::vector<double> damper;       ///< c x'
  std::vector<double> spring;       ///< wn^2 x
  std::vector<std::uint8_t> stuck;  ///< 1 while the slider sticks, else 0

  /// The sum of the three [m/s^2].
  double total(std::size_t i) const noexcept { return friction[i] + damper[i] + spring[i]; }
};

namespace detail {

/// Ground acceleration just after each of the first `samples` samples [m/s^2]: at the end of the motion the value just
/// before it, then 0.
inline std::vector<double> acting(const GroundMotion& motion, std::size_t samples) {
  std::vector<double> n(motion.acceleration().begin(), motion.acceleration().end());
  if (motion.interpolation() == Interpolation::constant) {  // the last value never acts, nor do pieces of no length
    const std::size_t end = motion.segments();
    std::size_t last = end - 1;
    while (motion.time(last) == motion.time(end)) --last;  // the duration is positive
    n[end] = n[last];
    for (std::size_t i = end; i-- > 0;)
      if (motion.time(i) == motion.time(i + 1)) n[i] = n[i + 1];
  }
  n.resize(samples);
  return n;
}

inline std::vector<double> acting(const HarmonicMotion& motion, std::size_t samples) {
  std::vector<double> n(samples);
  for (std::size_t i = 0; i < std::min(samples, motion.samples()); ++i) n[i] = motion.acceleration(motion.time(i));
  return n;
}

}  // namespace detail

/// The forces on a slider during a response.
///
/// At a sample where a slip begins, turns or stops, or where a held ground acceleration jumps, the values are those
/// just after it. At the end of the ground motion they balance its last value (of held values, the last that acts);
/// after that the ground acceleration is 0.
///
/// @param slider    the slider that moved
/// @param motion    the ground motion it moved under
/// @param response  what `integrate` returned for them
/// @return vectors as long as `response.displacement`
/// Friction is as accurate as the displacement and the velocity. One pass over the samples and events.
template <FrictionLaw Law, Motion M>
Forces forces(const Slider<Law>& slider, const M& motion, const Response& response) {
  const std::size_t samples = response.displacement.size();
  const std::vector<double> ground = detail::acting(motion, samples);
  Forces result{std::vector<double>(samples), std::vector<double>(samples), std::vector<double>(samples),
                std::vector<std::uint8_t>(samples)};
  const std::vector<Event>& events = response.events;
  std::size_t next = 0;  // the first event after the sample, or the end
  for (std::size_t i = 0; i < samples; ++i) {
    const double time = motion.time(i), x = response.displacement[i], v = response.velocity[i];
    while (events[next].kind != EventKind::end && events[next].time <= time) ++next;
    result.damper[i] = slider.damping() * v + 0.0;  // no minus zero
    result.spring[i] = slider.stiffness() * x + 0.0;
    result.stuck[i] = next == 0 || events[next - 1].kind == EventKind::arrest;
    if (result.stuck[i]) {
      result.friction[i] = -ground[i] - result.spring[i];
    } else {
      // Where a slip begins at the sample, its direction shows in where it goes, or in the load if that is round-off.
      const double gone = events[next].displacement - events[next - 1].displacement;
      const double way = v != 0 ? v : gone != 0 ? gone : -ground[i] - result.spring[i];
      const Direction direction = way < 0 ? Direction::backward : Direction::forward;
      result.friction[i] = sign(direction) * resist(slider.law(), x, direction, std::abs(v)) + 0.0;  // no minus zero
    }
  }
  return result;
}

template <FrictionLaw Law, Motion M>
Forces forces(const Law& law, const M& motion, const Response& response) {
  return forces(Slider<Law>(law), motion, response);
}

}  // namespace stickslip
