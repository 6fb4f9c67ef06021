// Coulomb blocks in one segment each, with all possible events: shared by the kernels of coulomb_lanes.cpp and
// level_lanes.cpp.
//
// Included once for each instruction set, as Highway's own -inl headers are.
#if defined(STICKSLIP_BLOCKS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef STICKSLIP_BLOCKS_INL
#undef STICKSLIP_BLOCKS_INL
#else
#define STICKSLIP_BLOCKS_INL
#endif

#include "lanes/pack-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace stickslip::detail::HWY_NAMESPACE {

using Real = Pack<1>;
using Bool = Real::Mask;

// Slides for a time, in its own direction: from a speed, with a net acceleration and its slope in time.
struct Slide {
  Real speed, acceleration, slope;

  HWY_INLINE Real distance(const Real& t) const {
    return t * multiply_add(multiply_add(slope * t, 1.0 / 3, acceleration) * t, 0.5, speed);
  }
  HWY_INLINE Real speed_at(const Real& t) const {
    return multiply_add(t, multiply_add(slope * t, 0.5, acceleration), speed);
  }
};

// From rest: at the beginning of a segment, or where a slip stopped.
struct Slip {
  Bool at_once, later;  // neither: it stays at rest
  Bool forward;         // direction
  Bool stops;           // before the end of the segment
  Real begin, duration;
  Real displacement;  // at the end of the slip
  Real velocity;      // at its end
};

struct Blocks;

// Records nothing.
struct NoAccount {
  void distinct(const Bool&) {}
  void slide(const Blocks&, const Real&, const Real&, const Real&, const Real&, const Real&) {}
  void turn(const Bool&, const Bool&, const Bool&, const Real&, const Real&, const Slip&) {}
};

// Coulomb blocks in their segments.
struct Blocks {
  Real forward, backward;       // slip levels
  Real load, last_load, slope;  // p = -n at the beginning and at the end, and its slope in time
  Real duration;
  Real peak;

  // From rest at time t.
  HWY_INLINE Slip slip_from_rest(const Real& t) const {
    const Real p = multiply_add(slope, t, load);
    const DepartureOfLanes<Real> departure(p, last_load, forward, backward);
    const Real level = departure.level, direction = select(departure.forward, Real(1.0), -1.0);
    const Real reaches = min(max(t, (level - load) / slope), duration);
    Slip slip;
    slip.at_once = departure.at_once;
    slip.later = departure.later;
    slip.forward = departure.forward;
    slip.begin = select(slip.at_once, t, select(slip.later, reaches, duration));
    const Real left = duration - slip.begin;
    const Slide slide{0.0, where(slip.at_once, abs(p - level)), direction * slope};
    // Starting at rest, the velocity a t + q t^2/2 has its other zero at -2 a/q.
    const Real stop = slide.acceleration * -2.0 / slide.slope;
    slip.stops = slip.at_once & (slide.slope < 0) & (stop < left);
    slip.duration = select(slip.stops, stop, left);
    slip.velocity = select(slip.stops, 0.0, direction * max(slide.speed_at(slip.duration), 0.0));
    slip.displacement = direction * slide.distance(slip.duration);
    return slip;
  }

  template <class Account>
  HWY_INLINE void move(Real& x, Real& v, Account& account) {
    const Bool stuck = v == 0,
               back = v < 0;  // where it is stuck, the other level, which may be infinite, is never reached
    const Real direction = select(back, Real(-1.0), 1.0);
    const Slide slide{abs(v), direction * (load - select(back, -backward, forward)), direction * slope};

    // The first zero of u + a t + q t^2/2, by the form of the roots without cancellation.
    const Real u = slide.speed, a = slide.acceleration, q = slide.slope;
    const Real square = a * a, magnitude = square + abs((u + u) * q);
    account.distinct(stuck | ((magnitude > 0x1p-900) & (magnitude < 0x1p900)));
    const Real discriminant = nfma(u + u, q, square), root = sqrt(max(discriminant, 0.0));
    const Bool slows = a < 0;
    const Real denominator = select(slows, root - a, -q);
    const Real stop = select(slows, u + u, a + root) / denominator;
    const Bool stops = but_not((discriminant >= 0) & (denominator > 0) & (stop <= duration), stuck);
    const Bool slides_on = ~(stuck | stops);

    const Real t = select(stuck, 0.0, select(stops, stop, duration));
    const Real distance = direction * slide.distance(t), last = direction * max(slide.speed_at(duration), 0.0);
    account.slide(*this, distance, 0.0, t, v, where(slides_on, last));
    account.distinct(~(slides_on & (last == 0)));
    x = x + distance;
    peak = max(peak, abs(x));

    Slip slip = slip_from_rest(t);
    account.turn(stuck, stops, back, x, t, slip);
    account.slide(*this, slip.displacement, slip.begin, slip.duration, 0.0, slip.velocity);
    v = select(slides_on, last, slip.velocity);
    x = select(slides_on, x, x + slip.displacement);
    peak = max(peak, abs(x));
    const Bool again = but_not(slip.stops, slides_on);
    if (HWY_LIKELY(!any(again))) return;
    // It reversed and stopped once more: from here on the load increases in its direction of slip, and it does not stop
    // a third time.
    const Bool came_back = ~slip.forward;
    const Real stopped = slip.begin + slip.duration;
    slip = slip_from_rest(stopped);
    account.turn(Bool::first(0), again, came_back, x, stopped, slip);
    account.slide(*this, where(again, slip.displacement), slip.begin, slip.duration, 0.0, slip.velocity);
    v = select(again, slip.velocity, v);
    x = select(again, x + slip.displacement, x);
    peak = max(peak, abs(x));
  }
};

}  // namespace stickslip::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
