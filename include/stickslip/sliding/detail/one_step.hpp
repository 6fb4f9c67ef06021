// Segments that hold no event, in one step.
#pragma once

#include <cmath>
#include <type_traits>

#include "stickslip/base/min_max.hpp"
#include "stickslip/flow/closed_form.hpp"
#include "stickslip/flow/detail/maker.hpp"
#include "stickslip/flow/oscillator.hpp"
#include "stickslip/friction/law.hpp"
#include "stickslip/sliding/detail/load.hpp"
#include "stickslip/sliding/observer.hpp"
#include "stickslip/state/state.hpp"

namespace stickslip::detail {

/// A maker of flows whose law has memory and changes linearly with the distance:
///
///     spring(law, direction, duration)  // the spring, without a damper, on which a slip runs over the distance
///                                       // `ahead`, if the motion on it over this duration is known; else null
template <class Flows>
concept FlowsOnSprings = FlowMaker<Flows> && MemoryLaw<typename Flows::Law> && form_of<typename Flows::Law>
== Form::linear;

/// Whether a slider that is stuck at the beginning of a segment stays so: the load is held at both ends.
template <FlowsOnSprings Flows>
bool stays(const Flows& flows, const LinearLoad& load, const State& state) {
  const auto law = flows.law_now(state, 1);
  const double x = state.displacement, pull = flows.pull(x, 1), net = load.first() - pull;
  const double forward = hold(law, x, Direction::forward), backward = hold(law, x, Direction::backward);
  return net <= forward && -net <= backward && !load.departure(net, pull, forward, backward, load.duration).departs();
}

/// Move a slider through a segment that certainly holds no event and no change of the law.
/// @param limits  Bounds or Unbounded
/// @return whether it did; if not, nothing has changed
template <FlowsOnSprings Flows, class Limits, MotionObserver Observer>
bool pass_in_one_step(const Flows& flows, const LinearLoad& load, const Limits& limits, State& state,
                      Observer& observer) {
  if (state.mode == Mode::stuck) return stays(flows, load, state);
  const Direction direction = direction_of(state.mode);
  const double s = sign(direction), x = state.displacement, speed = std::abs(state.velocity), time = load.duration;
  const auto law = flows.law_toward(direction, state, 1);
  const Harmonic* const spring = flows.spring(law, direction, time);
  if (spring == nullptr || !spring->one_arch(time)) return false;

  const double pull = flows.pull(x, 1), net = load.first() - pull, now = net + pull;
  const double begins = s * net - resist(law, x, speed, direction);
  const Start start = load.slip(s, speed, begins, 0, now, time, [] { return 0.0; });
  const ClosedForm<Harmonic> flow(*spring, start, time);
  const Progress end = flow.at_horizon();
  // Within one arch, a speed that ends above zero is zero before only if it falls at the start and rises at the end.
  if (!(end.speed > 0 && (begins >= 0 || end.acceleration <= 0))) return false;
  constexpr double surely = 1 - 0x1p-40;
  if (!(end.distance < std::min(flows.surely_ahead(state), surely * limits.room(direction, x)))) return false;

  if constexpr (requires { observer.follow(flow, time); }) observer.follow(flow, time);
  if constexpr (EnergyObserver<Observer>)
    if (counts_energy(observer)) {
      const double wears = SpringLaw<std::remove_cvref_t<decltype(law)>> ? 0 : law.slope(direction);
      observer.dissipate(end.distance * (friction(law, x, 0, direction) + wears / 2 * end.distance));
    }
  observer.slide(Slip{direction, x, end.distance, time, start.work(flow, s * now, start.gain, time, end)});
  state.displacement += s * end.distance;
  flows.slid_surely(state, end.distance);
  state.velocity = s * end.speed;
  return true;
}

}  // namespace stickslip::detail
