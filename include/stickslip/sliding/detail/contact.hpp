// One segment of a slider that may lose contact with the ground.
#pragma once

#include <cmath>
#include <utility>

#include "stickslip/base/equal.hpp"
#include "stickslip/base/min_max.hpp"
#include "stickslip/base/units.hpp"
#include "stickslip/flow/polynomial.hpp"
#include "stickslip/flow/power_series.hpp"
#include "stickslip/flow/remembering.hpp"
#include "stickslip/friction/law.hpp"
#include "stickslip/ground/segment.hpp"
#include "stickslip/sliding/detail/axis.hpp"
#include "stickslip/sliding/detail/bounds.hpp"
#include "stickslip/sliding/detail/one_step.hpp"
#include "stickslip/state/state.hpp"

namespace stickslip {

namespace detail {

/// Passes the events of a part of a segment to the observer, with times measured from the start of the whole segment.
/// The part starts at `begin` [s].
template <class Observer>
struct WithinSegment {
  Observer& observer;
  double begin;

  void slide(const Slip& slip) { observer.slide(slip); }
  void event(EventKind kind, double time, const State& state) { observer.event(kind, begin + time, state); }
  template <class Flow>
  void follow(const Flow& flow, double taken) requires requires(Observer& o) {
    o.follow(flow, taken);
  }
  { observer.follow(flow, taken); }
  bool counts_energy() const requires EnergyObserver<Observer> { return detail::counts_energy(observer); }
  void dissipate(double work) requires EnergyObserver<Observer> { observer.dissipate(work); }
  void lose(double energy) requires EnergyObserver<Observer> { observer.lose(energy); }
};

/// A law evaluated at a fixed displacement.
template <MemorylessLaw Law>
struct AtPlace {
  static constexpr bool numeric = form_of<Law> == Form::numeric;

  const Law* law;
  double displacement;

  template <class X, class Speed>
  auto resist(const X&, const Speed& speed, Direction direction) const {
    return stickslip::resist(*law, displacement, speed, direction);
  }
};

/// The speed that remains of `speed` after a normal impulse J of `impulse` [m/s]: d|v|/dJ = -mu(|v|). This is a slide
/// of duration J / g under weight g and no load. Springs in a law, and a pendulum's, take no part in the impulse.
template <MemorylessLaw Law>
double after_impulse(const Law& law, double displacement, Direction direction, double speed, double impulse) {
  if constexpr (SpeedLaw<Law>) {
    const Slider<AtPlace<Law>> slider({&law, displacement});
    BareState state(State::at(0, sign(direction) * speed));
    NoObserver none;
    advance(general_flows(slider), Segment{impulse / standard_gravity, 0, 0}, state, none);
    return std::abs(state.velocity);
  } else {
    return std::max(speed - friction(law, displacement, speed, direction) / standard_gravity * impulse, 0.0);
  }
}

/// Remove and return the first `time` [s] of a segment; the normal force at its end is given.
template <class AnyLoadSegment>
AnyLoadSegment take(AnyLoadSegment& segment, double time, double normal) noexcept {
  const auto load = segment.load(time);
  const AnyLoadSegment taken{time, segment.load_start, load, segment.normal_start, normal};
  segment = {segment.duration - time, load, segment.load_end, normal, segment.normal_end};
  return taken;
}

/// Time at which a slider in flight lands within a segment [s]; `never` if it does not land.
template <class AnyLoadSegment>
double landing(const AnyLoadSegment& s, double gap, double gap_velocity) noexcept {
  const double square = s.duration * s.duration;
  const double w[] = {gap, gap_velocity * s.duration, -s.normal_start * square / 2,
                      -(s.normal_end - s.normal_start) * square / 6};
  int leading = 0;  // leading zeros: the slider has just left the ground
  while (leading < 3 && equal(w[leading], 0)) ++leading;
  if (w[leading] < 0) return 0;
  const double root = leading < 3 ? FirstRoot(w + leading, 3 - leading).find() : never;
  return root < never ? root * s.duration : never;
}

/// Move a system through a segment in which it can leave the ground and land, on one axis or in the plane.
/// @param move  `move(part, begin, touching)` moves it through a part of the segment that begins at a time [s]
/// @param land  `land(impulse)` applies the normal impulse of a landing [m/s] to the sliding velocity
/// @param tell  `tell(kind, time)` reports an event [s]
template <class AnyLoadSegment, class Place, class Move, class Land, class Tell>
void advance_in_contact(AnyLoadSegment segment, Contact contact, Place& state, Move&& move, Land&& land, Tell&& tell) {
  const double duration = segment.duration;
  const auto go = [&](double time, double normal, bool touching) {
    const double begin = duration - segment.duration;
    move(time < segment.duration ? take(segment, time, normal) : std::exchange(segment, {}), begin, touching);
  };
  const auto report = [&](EventKind kind) { tell(kind, duration - segment.duration); };
  while (segment.duration > 0) {
    const double first = segment.normal_start, last = segment.normal_end;
    const auto crossing = [&] { return segment.duration * (first / (first - last)); };  // of N and zero
    if (state.in_flight) {
      const double lands = landing(segment, state.gap, state.gap_velocity);
      const double t = std::min(lands, segment.duration), change = (last - first) * (t / segment.duration);
      const double gap = state.gap + t * (state.gap_velocity - t * (first / 2 + change / 6));
      const double gap_velocity = state.gap_velocity - t * (first + change / 2);
      go(t, first + change, false);
      state.gap = std::max(gap, 0.0);
      state.gap_velocity = gap_velocity;
      if (equal(lands, never)) continue;
      report(EventKind::landing);
      state.in_flight = false;
      const double impulse = std::max(-std::exchange(state.gap_velocity, 0.0), 0.0);
      state.gap = 0;
      if (land(impulse)) report(EventKind::arrest);
    } else if (first < 0 || (equal(first, 0) && last < 0)) {
      if (contact == Contact::flight) {
        state.in_flight = true;
        report(EventKind::liftoff);
      } else {
        go(last > 0 ? crossing() : segment.duration, 0, false);
      }
    } else {
      go(last < 0 ? crossing() : segment.duration, 0, true);
    }
  }
}

/// The event loop over a segment in which the slider can reach a stop, leave the ground, and land.
template <FlowMaker Flows, class Place, MotionObserver Observer>
[[gnu::noinline]] void advance_with_contact(const Flows& flows, const LoadSegment& segment, const Bounds& bounds,
                                            Contact contact, Place& state, Observer& observer) {
  const auto weight_of = [](double normal, bool touching) { return touching ? normal / standard_gravity : 0.0; };
  const auto move = [&](const LoadSegment& part, double begin, bool touching) {
    const WeighedLoad weighed{part.duration, part.load_start, part.load_end, weight_of(part.normal_start, touching),
                              weight_of(part.normal_end, touching)};
    WithinSegment<Observer> within{observer, begin};
    advance(flows, weighed, state, within, bounds);
  };
  const auto land = [&](double impulse) {
    if (state.mode == Mode::stuck) return false;
    const Direction direction = direction_of(state.mode);
    const double before = std::abs(state.velocity);
    const double after = after_impulse(flows.law_now(state, 1), state.displacement, direction, before, impulse);
    if constexpr (EnergyObserver<Observer>) observer.dissipate((before * before - after * after) / 2);
    state.velocity = sign(direction) * after;
    if (after > 0) return false;
    state.mode = Mode::stuck;
    return true;
  };
  advance_in_contact(segment, contact, state, move, land,
                     [&](EventKind kind, double time) { observer.event(kind, time, State(state)); });
}

/// `pass_in_one_step` under a load and a normal force: only where that is the weight.
template <FlowsOnSprings Flows, MotionObserver Observer>
bool pass_in_one_step(const Flows& flows, const LoadSegment& segment, const Bounds& bounds, State& state,
                      Observer& observer) {
  return !state.in_flight && equal(segment.normal_start, standard_gravity) &&
         equal(segment.normal_end, standard_gravity) &&
         pass_in_one_step(flows, LinearLoad{segment.duration, -segment.load_start, -segment.load_end}, bounds, state,
                          observer);
}

/// The event loop over any segment. If the slider stays on the ground and cannot reach a stop, it checks for neither.
template <FlowMaker Flows, class Place, MotionObserver Observer>
[[gnu::always_inline]] inline void advance(const Flows& flows, const LoadSegment& segment, const Bounds& bounds,
                                           Contact contact, Place& state, Observer& observer) {
  if constexpr (Flows::in_closed_form) {  // other flows cost more than these checks
    const double first = segment.normal_start, last = segment.normal_end;
    if (!state.in_flight && first >= 0 && last >= 0 &&
        bounds.out_of_reach(segment, flows.pull(1, 1), flows.push(), state)) {
      if (equal(first, standard_gravity) && equal(last, standard_gravity))
        return advance(flows, Segment{segment.duration, -segment.load_start, -segment.load_end}, state, observer);
      const WeighedLoad weighed{segment.duration, segment.load_start, segment.load_end, first / standard_gravity,
                                last / standard_gravity};
      return advance(flows, weighed, state, observer);
    }
  }
  Place moving = state;  // a state whose address is taken is kept in memory
  advance_with_contact(flows, segment, bounds, contact, moving, observer);
  state = moving;
}

}  // namespace detail
}  // namespace stickslip
