#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "coulomb_lanes.cpp"
#include "coulomb_lanes.hpp"

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <bit>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace stickslip::detail::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using D = hn::CappedTag<double, row_padding>;
using V = hn::Vec<D>;
using M = hn::Mask<D>;

// Slides a while, in its own direction: from a speed, with a net acceleration and its slope in time.
struct Slide {
  V speed, acceleration, slope;

  HWY_INLINE V distance(V t) const {
    const D d;
    const V bend = hn::MulAdd(hn::Mul(slope, t), hn::Set(d, 1.0 / 3), acceleration);
    return hn::Mul(t, hn::MulAdd(hn::Mul(bend, t), hn::Set(d, 0.5), speed));
  }
  HWY_INLINE V speed_at(V t) const {
    const D d;
    return hn::MulAdd(t, hn::MulAdd(hn::Mul(slope, t), hn::Set(d, 0.5), acceleration), speed);
  }
};

// What is known of some blocks in their segment.
struct Lanes {
  V forward, backward;  // slip levels
  V load, slope;        // p = -n at the beginning, and its slope in time
  V duration;
  V peak;

  HWY_INLINE V load_at(V t) const { return hn::MulAdd(slope, t, load); }

  // From rest at time t: where it can't be held it slips at once; else it waits until the load, which is straight,
  // reaches the level it runs to. A reversal is a stick of no length, so this is both.
  // Becomes the time of the breakaway (or the end), the direction, the slide; returns the displacement in it.
  HWY_INLINE V slip_from_rest(V& t, V& velocity, M& stops) {
    const D d;
    const V zero = hn::Zero(d), p = load_at(t);
    const M above = hn::Gt(p, forward), below = hn::Lt(p, hn::Neg(backward));
    const M at_once = hn::Or(above, below);
    const M goes_forward = hn::Or(above, hn::AndNot(below, hn::Gt(slope, zero)));
    const V level = hn::IfThenElse(goes_forward, forward, hn::Neg(backward));
    const V reaches = hn::Max(t, hn::Div(hn::Sub(level, load), slope));
    const M later = hn::AndNot(at_once, hn::And(hn::Ne(slope, zero), hn::Lt(reaches, duration)));
    const V direction = hn::IfThenElse(goes_forward, hn::Set(d, 1), hn::Set(d, -1));
    const V begin = hn::IfThenElse(at_once, t, hn::IfThenElse(later, reaches, duration));
    const Slide slide{zero, hn::IfThenElseZero(at_once, hn::Abs(hn::Sub(p, level))), hn::Mul(direction, slope)};
    const V left = hn::Sub(duration, begin);
    // Starting at rest, the velocity a t + q t^2/2 has its other zero at -2 a/q.
    const V stop = hn::Div(hn::Mul(hn::Set(d, -2), slide.acceleration), slide.slope);
    stops = hn::And(at_once, hn::And(hn::Lt(slide.slope, zero), hn::Lt(stop, left)));
    const V taken = hn::IfThenElse(stops, stop, left);
    velocity = hn::IfThenElse(stops, zero, hn::Mul(direction, hn::Max(slide.speed_at(taken), zero)));
    t = hn::Add(begin, taken);
    return hn::Mul(direction, slide.distance(taken));
  }

  HWY_INLINE void move(V& x, V& v) {
    const D d;
    const V zero = hn::Zero(d);
    const M stuck = hn::Eq(v, zero);
    const M back = hn::Lt(v, zero);  // where it is stuck the other level, which may be infinite, is never looked at
    const V level = hn::IfThenElse(back, hn::Neg(backward), forward);
    const V direction = hn::IfThenElse(back, hn::Set(d, -1), hn::Set(d, 1));
    const Slide slide{hn::Abs(v), hn::Mul(direction, hn::Sub(load, level)), hn::Mul(direction, slope)};

    // The first zero of u + a t + q t^2/2, from the form of the roots in which nothing cancels.
    const V u = slide.speed, a = slide.acceleration, q = slide.slope;
    const V discriminant = hn::NegMulAdd(hn::Add(u, u), q, hn::Mul(a, a));
    const V root = hn::Sqrt(hn::Max(discriminant, zero));
    const M slows = hn::Lt(a, zero);
    const V numerator = hn::IfThenElse(slows, hn::Add(u, u), hn::Add(a, root));
    const V denominator = hn::IfThenElse(slows, hn::Sub(root, a), hn::Neg(q));
    const V stop = hn::Div(numerator, denominator);
    const M stops = hn::And(hn::And(hn::Ge(discriminant, zero), hn::Gt(denominator, zero)), hn::Le(stop, duration));

    V t = hn::IfThenZeroElse(stuck, hn::IfThenElse(stops, stop, duration));
    x = hn::MulAdd(direction, slide.distance(t), x);
    peak = hn::Max(peak, hn::Abs(x));
    const M slides_on = hn::AndNot(stuck, hn::Not(stops));
    const V last = hn::Mul(direction, hn::Max(slide.speed_at(duration), zero));
    if (hn::AllTrue(d, slides_on)) {
      v = last;
      return;
    }
    M again;
    V slip = slip_from_rest(t, v, again);
    v = hn::IfThenElse(slides_on, last, v);
    x = hn::IfThenElse(slides_on, x, hn::Add(x, slip));
    peak = hn::Max(peak, hn::Abs(x));
    again = hn::AndNot(slides_on, again);
    if (HWY_LIKELY(hn::AllFalse(d, again))) return;
    // It reversed and stopped once more: from here the load runs the way it slips, and it will not stop a third time.
    V late;
    M never;
    slip = slip_from_rest(t, late, never);
    v = hn::IfThenElse(again, late, v);
    x = hn::IfThenElse(again, hn::Add(x, slip), x);
    peak = hn::Max(peak, hn::Abs(x));
  }
};

void AdvanceLanes(const CoulombLanes& slider, std::size_t members, const double* HWY_RESTRICT start,
                  const double* HWY_RESTRICT end, const LaneStates& states) {
  const D d;
  const V h = hn::Set(d, slider.duration), half = hn::Set(d, slider.duration / 2),
          sixth = hn::Set(d, slider.duration / 6);
  const V forward = hn::Set(d, slider.forward), backward = hn::Set(d, slider.backward);
  const V no_forward = hn::Neg(forward), no_backward = hn::Neg(backward), zero = hn::Zero(d);
  double* const HWY_RESTRICT displacement = states.displacement;
  double* const HWY_RESTRICT velocity = states.velocity;
  double* const HWY_RESTRICT peak = states.peak;

  // Without an event: on with the same friction, or stuck throughout.
  std::uint64_t eventful = 0;  // one bit each
  for (std::size_t i = 0; i < members; i += hn::Lanes(d)) {
    const V x = hn::LoadU(d, displacement + i), v = hn::LoadU(d, velocity + i);
    const V n0 = hn::LoadU(d, start + i), n1 = hn::LoadU(d, end + i);
    const V level = hn::IfThenElse(hn::Lt(v, zero), no_backward, forward);
    const V g0 = hn::Add(n0, level), g1 = hn::Add(n1, level);  // decelerations
    // The velocity is a parabola: it stays within the triangle of its Bernstein coefficients v, `middle` and `last`.
    const V middle = hn::NegMulAdd(half, g0, v);
    const V last = hn::NegMulAdd(half, g1, middle);
    const M slides = hn::Gt(hn::Min(hn::Mul(v, middle), hn::Mul(v, last)), zero);
    const M held = hn::And(hn::Le(hn::Max(n0, n1), backward), hn::Ge(hn::Min(n0, n1), no_forward));
    const M quiet = hn::Or(slides, hn::And(hn::Eq(v, zero), held));
    const V way = hn::NegMulAdd(sixth, hn::Add(hn::Add(g0, g0), g1), v);
    const V there = hn::IfThenElse(slides, hn::MulAdd(h, way, x), x);
    hn::StoreU(there, d, displacement + i);
    hn::StoreU(hn::IfThenElse(slides, last, v), d, velocity + i);
    hn::StoreU(hn::Max(hn::LoadU(d, peak + i), hn::Abs(there)), d, peak + i);
    alignas(8) std::uint8_t bits[8] = {};
    hn::StoreMaskBits(d, hn::Not(quiet), bits);
    eventful |= std::uint64_t{bits[0]} << i;
  }

  // The others, as many at a time as a vector holds; the last is repeated to fill it.
  if (eventful == 0) return;
  struct Queue {
    double x[most_lanes], v[most_lanes], start[most_lanes], end[most_lanes], peak[most_lanes];
    std::uint8_t lane[most_lanes];
  };
  alignas(64) Queue queue;
  std::size_t events = 0;
  const auto push = [&](std::size_t lane) {
    queue.x[events] = displacement[lane];
    queue.v[events] = velocity[lane];
    queue.start[events] = start[lane];
    queue.end[events] = end[lane];
    queue.peak[events] = peak[lane];
    queue.lane[events++] = static_cast<std::uint8_t>(lane);
  };
  for (; eventful != 0; eventful &= eventful - 1) push(static_cast<std::size_t>(std::countr_zero(eventful)));
  const std::size_t filled = events;
  while (events % hn::Lanes(d) != 0) push(queue.lane[0]);
  const V rate = hn::Set(d, 1 / slider.duration);
  for (std::size_t k = 0; k < events; k += hn::Lanes(d)) {
    V x = hn::Load(d, queue.x + k), v = hn::Load(d, queue.v + k);
    const V n0 = hn::Load(d, queue.start + k), n1 = hn::Load(d, queue.end + k);
    Lanes lanes{forward, backward, hn::Neg(n0), hn::Mul(hn::Sub(n0, n1), rate), h, hn::Load(d, queue.peak + k)};
    lanes.move(x, v);
    hn::Store(x, d, queue.x + k);
    hn::Store(v, d, queue.v + k);
    hn::Store(lanes.peak, d, queue.peak + k);
  }
  for (std::size_t k = 0; k < filled; ++k) {
    const std::size_t lane = queue.lane[k];
    displacement[lane] = queue.x[k];
    velocity[lane] = queue.v[k];
    peak[lane] = queue.peak[k];
  }
}

}  // namespace stickslip::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace stickslip::detail {

HWY_EXPORT(AdvanceLanes);

void advance_lanes(const CoulombLanes& slider, std::size_t members, const double* start, const double* end,
                   const LaneStates& states) {
  HWY_DYNAMIC_DISPATCH(AdvanceLanes)(slider, members, start, end, states);
}

}  // namespace stickslip::detail
#endif
