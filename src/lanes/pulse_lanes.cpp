#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "lanes/pulse_lanes.cpp"
#include "lanes/pulse_lanes.hpp"

#include <hwy/foreach_target.h>

#include <limits>

#include "lanes/pack-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace stickslip::detail::HWY_NAMESPACE {

using Real = Pack < lanes<8 ? 2 : 1>;
using Bool = Real::Mask;
using Place = Places<Real::size / lanes>;

// Slides for a time under a load that stays: on, or to a stop and from there the other way if the load is beyond that
// level, which a load that stays then keeps to.
HWY_INLINE void slide(const Real& forward, const Real& backward, const Real& load, const Real& duration, Real& x,
                      Real& v, Real& peak) {
  const Bool back = v < 0, stuck = v == 0;
  const Real direction = select(back, Real(-1.0), 1.0);
  const Real speed = abs(v), acceleration = direction * (load - select(back, -backward, forward));
  const Bool stops = (acceleration < 0) & (speed < -acceleration * duration);
  const Real taken = where(~stuck, select(stops, speed / -acceleration, duration));
  x = multiply_add(direction * taken, multiply_add(acceleration, 0.5 * taken, speed), x);
  peak = max(peak, abs(x));
  const Real left = where(stops | stuck, duration - taken);
  const Real excess = select(load > forward, load - forward, where(load < -backward, load + backward));
  const Real gained = excess * left;
  v = select(stops | stuck, gained, direction * multiply_add(acceleration, duration, speed));
  x = multiply_add(0.5 * gained, left, x);
  peak = max(peak, abs(x));
}

// @tparam fixed_edges  number of edges, small enough to stay in registers; 0: any number up to `max_edges`
template <std::size_t fixed_edges>
HWY_INLINE void move(const PulseLanes& slider, double end, const PulseStreams& pulses, const PulseHistory& history,
                     const LaneStates& states) {
  constexpr std::size_t room = fixed_edges == 0 ? max_edges : fixed_edges;
  const Real forward = slider.forward, backward = slider.backward;
  const std::size_t edges = fixed_edges == 0 ? slider.edges.size() : fixed_edges, width = pulses.first.size();
  for (std::size_t i = 0; i < width; i += Real::size) {
    Real x = 0.0, v = 0.0, peak = 0.0, ground = 0.0, now = 0.0;
    Place next[room];
    Real time[room];  // at which the next pulse meets each edge
    for (std::size_t e = 0; e < edges; ++e) {
      next[e] = Place::load(&pulses.first[i]);
      time[e] = next[e].gather(pulses.arrivals.data()) + slider.edges[e];
    }
    Place row = Place::counting(static_cast<std::int64_t>(i));  // in the history
    Real wanted = 0.0, number = 0.0;                            // the next time that is wanted, and its number
    for (;;) {
      Real first = wanted;
      for (std::size_t e = 0; e < edges; ++e) first = min(first, time[e]);
      const Bool meets = first < end;
      const Real then = max(min(first, end), now);
      slide(forward, backward, -ground, then - now, x, v, peak);
      now = then;
      // Always written: what stays is what was written last before the row moved on, at the time that was wanted.
      row.scatter(x, history.displacement);
      row.scatter(v, history.velocity);
      if (!any(meets | (wanted <= end))) break;
      // The edge that is met: which pulse, how far it jumps, when the next pulse meets it. Two at once come in turn.
      Bool open = meets, met[room];
      Place place = next[0];
      Real jump = 0.0, after = 0.0;
      for (std::size_t e = 0; e < edges; ++e) {
        met[e] = open & (time[e] == first);
        open = but_not(open, met[e]);
        place = select(met[e], next[e], place);
        jump = select(met[e], Real(slider.jumps[e]), jump);
        after = select(met[e], Real(slider.edges[e]), after);
        next[e].step(met[e]);
      }
      const Real following = place.gather(pulses.arrivals.data() + 1) + after;
      for (std::size_t e = 0; e < edges; ++e) time[e] = select(met[e], following, time[e]);
      // Where the pulses that began have all ended nothing is left, of rounding neither.
      ground = where(next[0] != next[edges - 1], multiply_add(place.gather(pulses.amplitudes.data()), jump, ground));
      // A time that is wanted, where no edge is met at the same one.
      const Bool reached = (wanted == first) & (open | ((first >= end) & (wanted <= end)));
      number = number + where(reached, Real(1.0));
      wanted = select(number < static_cast<double>(history.times), number * history.dt,
                      std::numeric_limits<double>::infinity());
      row.step(reached, static_cast<std::int64_t>(width));
    }
    x.store(states.displacement + i);
    v.store(states.velocity + i);
    peak.store(states.peak + i);
  }
}

void AdvancePulses(const PulseLanes& slider, double end, const PulseStreams& pulses, const PulseHistory& history,
                   const LaneStates& states) {
  slider.edges.size() == 3 ? move<3>(slider, end, pulses, history, states)
                           : move<0>(slider, end, pulses, history, states);
}

}  // namespace stickslip::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace stickslip::detail {

HWY_EXPORT(AdvancePulses);

void advance_lanes(const PulseLanes& slider, double end, const PulseStreams& pulses, const PulseHistory& history,
                   const LaneStates& states) {
  HWY_DYNAMIC_DISPATCH(AdvancePulses)(slider, end, pulses, history, states);
}

}  // namespace stickslip::detail
#endif
