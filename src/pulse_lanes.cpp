#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "pulse_lanes.cpp"
#include "pulse_lanes.hpp"

#include <hwy/foreach_target.h>

#include "pack-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace stickslip::detail::HWY_NAMESPACE {

using Real = Pack<1>;
using Bool = Real::Mask;
using Integers = hn::RebindToSigned<Tag>;

// Slides for a time under a load that stays: on, or to a stop and from there the other way if the load is beyond that
// level, which a load that stays then keeps to.
HWY_INLINE void slide(const Real& forward, const Real& backward, const Real& load, const Real& duration, Real& x,
                      Real& v, Real& peak) {
  const Bool back = v < 0, stuck = v == 0;
  const Real direction = select(back, Real(-1.0), 1.0);
  const Real speed = abs(v), acceleration = direction * (load - select(back, -backward, forward));
  const Bool stops = (acceleration < 0) & (speed < -acceleration * duration);
  const Real taken = where(!stuck, select(stops, speed / -acceleration, duration));
  x = fma(direction * taken, fma(acceleration, 0.5 * taken, speed), x);
  peak = max(peak, abs(x));
  const Real left = where(stops | stuck, duration - taken);
  const Real excess = select(load > forward, load - forward, where(load < -backward, load + backward));
  const Real gained = excess * left;
  v = select(stops | stuck, gained, direction * fma(acceleration, duration, speed));
  x = fma(0.5 * gained, left, x);
  peak = max(peak, abs(x));
}

void AdvancePulses(const PulseLanes& slider, double from, double until, PulseStreams& pulses,
                   const LaneStates& states) {
  const Integers integers;
  const Tag reals;
  const Real forward = slider.forward, backward = slider.backward;
  const std::size_t edges = slider.edges.size(), width = pulses.width;
  for (std::size_t i = 0; i < width; i += Real::size) {
    Real x = Real::load(states.displacement + i), v = Real::load(states.velocity + i);
    Real peak = Real::load(states.peak + i), ground = Real::load(&pulses.ground[i]), now = from;
    for (;;) {
      Real first = Real::load(&pulses.time[i]);
      for (std::size_t e = 1; e < edges; ++e) first = min(first, Real::load(&pulses.time[e * width + i]));
      const Bool meets = first < until;
      const Real then = select(meets, max(first, now), until);
      slide(forward, backward, -ground, then - now, x, v, peak);
      now = then;
      if (!any(meets)) break;
      // The edge that is met: which pulse, how far it jumps, when the next pulse meets it. Two at once come in turn.
      Bool open = meets;
      auto place = hn::Zero(integers);
      Real jump = 0.0, after = 0.0;
      for (std::size_t e = 0; e < edges; ++e) {
        const Bool met = open & (Real::load(&pulses.time[e * width + i]) == first);
        open = but_not(open, met);
        const auto those = hn::RebindMask(integers, met.part[0]);
        const auto next = hn::LoadU(integers, &pulses.next[e * width + i]);
        place = hn::IfThenElse(those, next, place);
        jump = select(met, Real(slider.jumps[e]), jump);
        after = select(met, Real(slider.edges[e]), after);
        hn::StoreU(hn::Add(next, hn::IfThenElseZero(those, hn::Set(integers, 1))), integers,
                   &pulses.next[e * width + i]);
      }
      Real amplitude, arrival;
      amplitude.part[0] = hn::GatherIndex(reals, pulses.amplitudes.data(), place);
      arrival.part[0] = hn::GatherIndex(reals, pulses.arrivals.data() + 1, place);
      const Real following = arrival + after;
      for (std::size_t e = 0; e < edges; ++e) {
        const Real time = Real::load(&pulses.time[e * width + i]);
        const Bool met = meets & (time == first) & (after == Real(slider.edges[e]));
        select(met, following, time).store(&pulses.time[e * width + i]);
      }
      // Where the pulses that began have all ended nothing is left, of rounding neither.
      Bool acts;
      acts.part[0] = hn::RebindMask(reals, hn::Ne(hn::LoadU(integers, &pulses.next[i]),
                                                  hn::LoadU(integers, &pulses.next[(edges - 1) * width + i])));
      ground = where(acts, fma(where(meets, amplitude), jump, ground));
    }
    x.store(states.displacement + i);
    v.store(states.velocity + i);
    peak.store(states.peak + i);
    ground.store(&pulses.ground[i]);
  }
}

}  // namespace stickslip::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace stickslip::detail {

HWY_EXPORT(AdvancePulses);

void advance_lanes(const PulseLanes& slider, double from, double until, PulseStreams& pulses,
                   const LaneStates& states) {
  HWY_DYNAMIC_DISPATCH(AdvancePulses)(slider, from, until, pulses, states);
}

}  // namespace stickslip::detail
#endif
