// Integrate a slider in the plane over one segment of ground motion, for codes with their own time loop.
#pragma once

#include <cmath>
#include <stdexcept>
#include <string>

#include "stickslip/base/error.hpp"
#include "stickslip/planar/detail/plane.hpp"
#include "stickslip/planar/detail/sink.hpp"
#include "stickslip/planar/observer.hpp"
#include "stickslip/planar/segment.hpp"
#include "stickslip/planar/slider.hpp"
#include "stickslip/planar/state.hpp"
#include "stickslip/sliding/advance.hpp"
#include "stickslip/sliding/detail/contact.hpp"

namespace stickslip {
namespace detail {

/// Whether friction certainly holds a slider at rest during a segment: the load is within the level at both ends, and
/// its square grows more convexly than that of the level.
template <IsotropicLaw Law>
bool rests(const PlanarSlider<Law>& slider, const PlanarLoadSegment& segment, const PlanarState& state) {
  if constexpr (HeatedLaw<Law>) return false;
  if (slider.mounting().pendulum || !(segment.normal_start >= 0) || !(segment.normal_end >= 0)) return false;
  const double level = hold_at(slider, state) / standard_gravity;
  const Vector2 pull = slider.stiffness() * state.displacement;
  const Vector2 first = segment.load_start - pull, last = segment.load_end - pull, change = last - first;
  const double holds_first = level * segment.normal_start, holds_last = level * segment.normal_end;
  const double holds_change = holds_last - holds_first;
  return dot(first, first) <= holds_first * holds_first && dot(last, last) <= holds_last * holds_last &&
         dot(change, change) >= holds_change * holds_change;
}

/// The event loop. The library contains it for its laws; empty for a law that is not the same in all directions.
template <FrictionLaw Law, bool = IsotropicLaw<Law>>
struct PlaneEngine {};
template <FrictionLaw Law>
struct PlaneEngine<Law, true> {
  static void advance(const PlanarSlider<Law>& slider, const PlanarLoadSegment& segment, Contact contact,
                      PlanarState& state, PlanarSink& sink);
};

/// Moves through any segment.
template <IsotropicLaw Law>
void advance_plane(const PlanarSlider<Law>& slider, const PlanarLoadSegment& segment, Contact contact,
                   PlanarState& state, PlanarSink& sink) {
  PlaneEngine<Law>::advance(slider, segment, contact, state, sink);
}

template <FrictionLaw Law>
void PlaneEngine<Law, true>::advance(const PlanarSlider<Law>& slider, const PlanarLoadSegment& segment, Contact contact,
                                     PlanarState& state, PlanarSink& sink) {
  if (!state.in_flight && state.mode == PlanarMode::stuck && rests(slider, segment, state)) return;
  const auto move = [&](const PlanarLoadSegment& part, double begin, bool touching) {
    if (!(part.duration > 0)) return;
    WithinPlanarSegment within{sink, begin};
    Plane<Law> plane(slider, part, touching, state);
    detail::advance(plane, within);
  };
  // The friction impulse acts along the velocity vector.
  const auto land = [&](double impulse) {
    if (state.mode == PlanarMode::stuck) return false;
    const double before = norm(state.velocity);
    const double after =
        after_impulse(law_at(slider.law(), on_path<Law>(state), 1), 0, Direction::forward, before, impulse);
    sink.dissipate((before * before - after * after) / 2);
    if (after > 0) {
      state.velocity = (after / before) * state.velocity;
      return false;
    }
    state.velocity = {};
    state.mode = PlanarMode::stuck;
    return true;
  };
  advance_in_contact(segment, contact, state, move, land,
                     [&](EventKind kind, double time) { sink.event(kind, time, state); });
}

// Appended to, because GCC 12 warns wrongly of "(" + std::string.
inline std::string description(Vector2 v) {
  std::string text = "(";
  text += shortest(v.axis);
  text += ", ";
  text += shortest(v.transverse);
  text += ')';
  return text;
}

/// Throw if a state cannot be the start of a motion.
inline void check_start(const Mounting& mounting, const PlanarState& state, const char* function) {
  const double gap = mounting.stops.forward(), place = norm(state.displacement);
  if (place > gap * (1 + 0x1p-48))
    throw std::invalid_argument(std::string(function) + ": the displacement must be within the stop at " +
                                shortest(gap) + " m, got |r| = " + shortest(place) + " m");
  if (state.mode == PlanarMode::along_stop && !(place > gap * (1 - 0x1p-47)))
    throw std::invalid_argument(std::string(function) + ": a slider that slides along its stop must be at |r| = " +
                                shortest(gap) + " m, got |r| = " + shortest(place) + " m");
}

}  // namespace detail

/// Integrate the motion of a slider in the plane over one segment (see PlanarSlider for the equation), with every
/// breakaway, reversal, arrest and impact within it. For codes with their own time loop: the function allocates nothing
/// and keeps no state except `state`.
///
/// @param slider    the slider
/// @param segment   load and normal force, finite; the state is unchanged if its duration is not positive
/// @param state     state at the start, finite; replaced by the state at the end. `PlanarState::at(r, v)` makes one
/// @param observer  receives events and flows (PlanarObserver); optional
/// @param contact   what the slider does while N < 0
/// @throws std::invalid_argument  a number of the segment or the state is not finite; a place beyond the stop, or off
///                                the stop along which the slider slides
/// @throws std::overflow_error    the motion leaves the range of doubles
/// @throws ConvergenceError       more than three million steps within a hundredth of the segment
/// On any error `state` is unchanged. Accuracy: near round-off. Cost: about 10 ns at rest, 0.5 to 1.5 us while it
/// slides.
template <IsotropicLaw Law, PlanarObserver Observer = const NoPlanarObserver>
void advance(const PlanarSlider<Law>& slider, const PlanarLoadSegment& segment, PlanarState& state,
             Observer&& observer = {}, Contact contact = Contact::flight) {
  const auto finite = [](const PlanarState& s) {
    return detail::finite(s.displacement.axis, s.displacement.transverse, s.velocity.axis, s.velocity.transverse, s.gap,
                          s.gap_velocity, s.sliding_distance);
  };
  if (!detail::finite(segment.duration, segment.load_start.axis, segment.load_start.transverse, segment.load_end.axis,
                      segment.load_end.transverse, segment.normal_start, segment.normal_end) ||
      !finite(state)) [[unlikely]]
    throw std::invalid_argument(
        "advance: segment and state must be finite, got a duration of " + detail::shortest(segment.duration) +
        " s, load " + detail::description(segment.load_start) + " to " + detail::description(segment.load_end) +
        " m/s^2, normal force " + detail::shortest(segment.normal_start) + " to " +
        detail::shortest(segment.normal_end) + " m/s^2, r = " + detail::description(state.displacement) +
        " m, r' = " + detail::description(state.velocity) + " m/s");
  detail::check_start(slider.mounting(), state, "advance");
  PlanarState moved = state;
  detail::PlanarObserverSink sink(observer);
  detail::advance_plane(slider, segment, contact, moved, sink);
  if (!finite(moved)) [[unlikely]]
    throw std::overflow_error(
        "advance: the motion leaves the range of doubles, from r = " + detail::description(state.displacement) +
        " m, r' = " + detail::description(state.velocity) + " m/s");
  state = moved;
}

/// The same under a segment of horizontal ground motion, without vertical motion.
template <IsotropicLaw Law, PlanarObserver Observer = const NoPlanarObserver>
void advance(const PlanarSlider<Law>& slider, const PlanarSegment& segment, PlanarState& state,
             Observer&& observer = {}, Contact contact = Contact::flight) {
  advance(slider, detail::load_segment(segment, slider.slope()), state, observer, contact);
}

}  // namespace stickslip

#ifdef STICKSLIP_LIBRARY
#include "stickslip/planar/detail/engines.hpp"
#endif
