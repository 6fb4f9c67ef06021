// The linear system of the hysteresis loop with the largest displacement.
#pragma once

#include <cmath>
#include <cstddef>
#include <functional>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "stickslip/detail/equal.hpp"
#include "stickslip/detail/min_max.hpp"
#include "stickslip/detail/recorder.hpp"
#include "stickslip/error.hpp"
#include "stickslip/friction/law.hpp"
#include "stickslip/ground/motion.hpp"
#include "stickslip/slider.hpp"
#include "stickslip/sliding/advance.hpp"
#include "stickslip/sliding/response.hpp"
#include "stickslip/state.hpp"

namespace stickslip {

/// The hysteresis loop with the largest displacement, per unit mass.
struct Loop {
  double displacement;  ///< D, the peak |x| [m]
  double force;         ///< F, of spring and friction on arrival there [m/s^2]
  double area;          ///< E_d, energy that a cycle of amplitude D dissipates [m^2/s^2]

  /// k_eff = F / D, of the secant [1/s^2].
  double stiffness() const noexcept { return force / displacement; }

  /// 2 pi / sqrt(k_eff) [s].
  double period() const noexcept { return 2 * std::numbers::pi / std::sqrt(stiffness()); }

  /// E_d / (2 pi k_eff D^2), a fraction of critical damping.
  double damping() const noexcept { return area / (2 * std::numbers::pi * force * displacement); }
};

namespace detail {

/// Moves a slider from one time to a later one.
template <FrictionLaw Law, class Observer>
void advance_between(const Slider<Law>& slider, const GroundMotion& motion, double from, double to, State& state,
                     Observer& observer) {
  const bool linear = motion.interpolation() == Interpolation::linear;
  for (std::size_t i = 0; i < motion.segments() && motion.time(i) < to; ++i) {
    const double begin = std::max(motion.time(i), from), end = std::min(motion.time(i + 1), to);
    if (!(begin < end)) continue;
    const Segment whole = motion.segment(i);
    const auto n = [&](double time) {
      return linear ? std::lerp(whole.start, whole.end, (time - motion.time(i)) / whole.duration) : whole.start;
    };
    advance(slider, Segment{end - begin, n(begin), n(end)}, state, observer);
  }
  const double begin = std::max(motion.time(motion.segments()), from);
  advance(slider, Segment{to - begin, 0, 0}, state, observer);
}

template <FrictionLaw Law, class Observer>
void advance_between(const Slider<Law>& slider, const HarmonicMotion& motion, double from, double to, State& state,
                     Observer& observer) {
  const double end = std::min(motion.time(motion.segments()), to);
  for (double begin = from; begin < end;) {
    const double next = std::min(begin + motion.period(), end);
    advance(slider, HarmonicSegment{next - begin, motion.amplitude(), motion.omega(), motion.phase(begin)}, state,
            observer);
    begin = next;
  }
  advance(slider, Segment{to - std::max(end, from), 0, 0}, state, observer);
}

}  // namespace detail

/// The hysteresis loop with the largest displacement, as used in the design of sliding isolators.
///
/// D is the peak |x|, F the force of spring and friction there, before the slider reverses or stops. The response to an
/// earthquake does not close a loop. The area is therefore that of a cycle from D to -D and back: 4 D times the energy
/// per meter that friction and damper dissipated in the half cycle up to the peak. In a steady cycle about x = 0 this
/// is the area of the loop. With Coulomb friction of level a, and wn^2 of a spring,
///     k_eff = wn^2 + a / D,    E_d = 4 a D,    E_d / (2 pi k_eff D^2) = (2 / pi) a / (a + wn^2 D).
///
/// @param slider    the slider, on a spring
/// @param motion    its ground motion
/// @param response  the result of `integrate` for them
/// @throws std::invalid_argument  no spring; it never slips; |x| is largest at the start, or at the end of the motion
///                                during a slip
/// Accuracy: that of `integrate`. Cost: one pass over the events, and the integration of that half cycle.
template <FrictionLaw Law, Motion M>
Loop largest_loop(const Slider<Law>& slider, const M& motion, const Response& response) {
  detail::require_plain_mounting(slider, "largest_loop");
  if constexpr (std::same_as<M, GroundMotion>)
    if (motion.has_vertical())
      throw std::invalid_argument("largest_loop: covers horizontal motion alone: under vertical motion no loop closes");
  if (!(slider.stiffness() > 0))
    throw std::invalid_argument(
        "largest_loop: needs a slider on a spring (natural_frequency or period): without one no force draws the mass "
        "back, and it has no effective period");
  if (!(response.peak > 0)) throw std::invalid_argument("largest_loop: the slider never slips");
  if constexpr (HeatedLaw<Law>)
    throw std::invalid_argument(
        "largest_loop: does not cover friction that depends on the temperature, which differs "
        "from one loop to the next");
  const std::vector<Event>& events = response.events;
  std::size_t peak = 1;
  while (peak < events.size() &&
         !((events[peak].kind == EventKind::reversal || events[peak].kind == EventKind::arrest) &&
           detail::equal(std::abs(events[peak].displacement), response.peak)))
    ++peak;
  if (peak >= events.size())
    throw std::invalid_argument("largest_loop: |x| is largest, " + detail::shortest(response.peak) +
                                " m, where no slip ends: at the start, or at the end of a motion that is not over "
                                "(settle continues it)");

  // Back to the last reversal from the other direction, or to the start.
  const double s = events[peak].displacement < 0 ? -1 : 1;
  const auto way = [&](std::size_t k) { return s * (events[k].displacement - events[k - 1].displacement); };
  std::size_t turn = peak;
  while (turn > 0 && way(turn) >= 0) --turn;
  const Event& from = events[turn];
  const Direction direction = s < 0 ? Direction::backward : Direction::forward;
  State state{from.displacement, from.velocity, from.kind == EventKind::arrest ? Mode::stuck : mode_of(direction)};
  state.sliding_distance = std::max(response.state.sliding_distance - response.sliding_distance, 0.0);
  for (std::size_t k = 1; k <= turn; ++k) state.sliding_distance += std::abs(way(k));
  const double end = events[peak].time;
  const std::function<void()> none;
  detail::Recorder<Law, true> recorder(slider.law(), from.displacement, events.size() + detail::max_events(0), none,
                                       {});
  recorder.begin_segment(from.time, end);
  detail::advance_between(slider, motion, from.time, end, state, recorder);
  Response swing;
  recorder.finish(end, state, swing);

  const double x = events[peak].displacement;
  const double work = (swing.energy.dissipated + swing.energy.damped) / swing.sliding_distance;
  return {response.peak, slider.stiffness() * response.peak + resist(law_at(slider.law(), state), x, direction, 0.0),
          4 * response.peak * work};
}

}  // namespace stickslip
