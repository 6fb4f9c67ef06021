#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "coulomb_lanes.cpp"
#include "coulomb_lanes.hpp"

#include <hwy/foreach_target.h>

#include <cstdint>

#include "pack-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace stickslip::detail::HWY_NAMESPACE {

using Real = Pack<1>;
using Bool = Real::Mask;

// Slides a while, in its own direction: from a speed, with a net acceleration and its slope in time.
struct Slide {
  Real speed, acceleration, slope;

  HWY_INLINE Real distance(const Real& t) const {
    return t * fma(fma(slope * t, 1.0 / 3, acceleration) * t, 0.5, speed);
  }
  HWY_INLINE Real speed_at(const Real& t) const { return fma(t, fma(slope * t, 0.5, acceleration), speed); }
};

// Coulomb blocks in their segments.
struct Blocks {
  Real forward, backward;  // slip levels
  Real load, slope;        // p = -n at the beginning, and its slope in time
  Real duration;
  Real peak;

  // From rest at time t: where it can't be held it slips at once; else it waits until the load, which is straight,
  // reaches the level it runs to. A reversal is a stick of no length, so this is both. The time becomes that of the
  // next stop, where it `stops`, or the end; returns the displacement until then.
  HWY_INLINE Real slip_from_rest(Real& t, Real& velocity, Bool& stops) const {
    const Real p = fma(slope, t, load);
    const Bool above = p > forward, below = p < -backward, at_once = above | below;
    const Bool goes_forward = above | but_not(slope > 0, below);
    const Real level = select(goes_forward, forward, -backward), direction = select(goes_forward, Real(1.0), -1.0);
    const Real reaches = max(t, (level - load) / slope);
    const Bool later = but_not((slope != 0) & (reaches < duration), at_once);
    const Real begin = select(at_once, t, select(later, reaches, duration)), left = duration - begin;
    const Slide slide{0.0, where(at_once, abs(p - level)), direction * slope};
    // Starting at rest, the velocity a t + q t^2/2 has its other zero at -2 a/q.
    const Real stop = slide.acceleration * -2.0 / slide.slope;
    stops = at_once & (slide.slope < 0) & (stop < left);
    const Real taken = select(stops, stop, left);
    velocity = select(stops, 0.0, direction * max(slide.speed_at(taken), 0.0));
    t = begin + taken;
    return direction * slide.distance(taken);
  }

  HWY_INLINE void move(Real& x, Real& v) {
    const Bool stuck = v == 0, back = v < 0;  // where it is stuck the other level, which may be infinite, is never met
    const Real direction = select(back, Real(-1.0), 1.0);
    const Slide slide{abs(v), direction * (load - select(back, -backward, forward)), direction * slope};

    // The first zero of u + a t + q t^2/2, from the form of the roots in which nothing cancels.
    const Real u = slide.speed, a = slide.acceleration, q = slide.slope;
    const Real discriminant = nfma(u + u, q, a * a), root = sqrt(max(discriminant, 0.0));
    const Bool slows = a < 0;
    const Real denominator = select(slows, root - a, -q);
    const Real stop = select(slows, u + u, a + root) / denominator;
    const Bool stops = (discriminant >= 0) & (denominator > 0) & (stop <= duration);

    Real t = select(stuck, 0.0, select(stops, stop, duration));
    x = fma(direction, slide.distance(t), x);
    peak = max(peak, abs(x));
    const Bool slides_on = !(stuck | stops);
    Bool again;
    Real velocity;
    Real slip = slip_from_rest(t, velocity, again);
    v = select(slides_on, direction * max(slide.speed_at(duration), 0.0), velocity);
    x = select(slides_on, x, x + slip);
    peak = max(peak, abs(x));
    again = but_not(again, slides_on);
    if (HWY_LIKELY(!any(again))) return;
    // It reversed and stopped once more: from here the load runs the way it slips, and it will not stop a third time.
    Bool never;
    slip = slip_from_rest(t, velocity, never);
    v = select(again, velocity, v);
    x = select(again, x + slip, x);
    peak = max(peak, abs(x));
  }
};

void AdvanceCoulomb(const CoulombLanes& slider, std::size_t members, const double* HWY_RESTRICT start,
                    const double* HWY_RESTRICT end, const LaneStates& states) {
  const Real h = slider.duration, forward = slider.forward, backward = slider.backward;
  const double half = slider.duration / 2, sixth = slider.duration / 6;

  // Without an event: on with the same friction, or stuck throughout. The others are marked, one bit each.
  std::uint64_t eventful = 0;
  for (std::size_t i = 0; i < members; i += Real::size) {
    const Real x = Real::load(states.displacement + i), v = Real::load(states.velocity + i);
    const Real n0 = Real::load(start + i), n1 = Real::load(end + i);
    const Real level = select(v < 0, -backward, forward);
    const Real g0 = n0 + level, g1 = n1 + level;  // decelerations
    // The velocity is a parabola: it stays within the triangle of its Bernstein coefficients v, `middle` and `last`.
    const Real middle = nfma(half, g0, v), last = nfma(half, g1, middle);
    const Bool slides = min(v * middle, v * last) > 0;
    const Bool held = (v == 0) & (max(n0, n1) <= backward) & (min(n0, n1) >= -forward);
    const Real there = select(slides, fma(h, nfma(sixth, (g0 + g0) + g1, v), x), x);
    there.store(states.displacement + i);
    select(slides, last, v).store(states.velocity + i);
    max(Real::load(states.peak + i), abs(there)).store(states.peak + i);
    eventful |= bits(!(slides | held)) << i;
  }

  if (eventful == 0) return;
  LaneQueue queue(eventful, start, end, states);
  const double rate = 1 / slider.duration;
  for (std::size_t k = 0; k < queue.count; k += Real::size) {
    Real x = Real::load(queue.displacement + k), v = Real::load(queue.velocity + k);
    const Real n0 = Real::load(queue.start + k), n1 = Real::load(queue.end + k);
    Blocks blocks{forward, backward, -n0, (n0 - n1) * rate, h, Real::load(queue.peak + k)};
    blocks.move(x, v);
    x.store(queue.displacement + k);
    v.store(queue.velocity + k);
    blocks.peak.store(queue.peak + k);
  }
  queue.put_back(states);
}

}  // namespace stickslip::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace stickslip::detail {

HWY_EXPORT(AdvanceCoulomb);

void advance_lanes(const CoulombLanes& slider, std::size_t members, const double* start, const double* end,
                   const LaneStates& states) {
  HWY_DYNAMIC_DISPATCH(AdvanceCoulomb)(slider, members, start, end, states);
}

}  // namespace stickslip::detail
#endif
