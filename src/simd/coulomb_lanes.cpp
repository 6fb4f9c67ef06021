#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simd/coulomb_lanes.cpp"
#include "simd/coulomb_lanes.hpp"

#include <hwy/foreach_target.h>

#include <algorithm>
#include <cstdint>
#include <type_traits>

#include "simd/pack-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace stickslip::detail::HWY_NAMESPACE {

using Real = Pack<1>;
using Bool = Real::Mask;

// Slides a while, in its own direction: from a speed, with a net acceleration and its slope in time.
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
  Bool at_once, later;  // neither: it rests
  Bool forward;         // which way
  Bool stops;           // before the end of the segment
  Real begin, duration;
  Real displacement;  // that it comes to
  Real velocity;      // at its end
};

struct Blocks;

// Takes no account.
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
    const Bool stuck = v == 0, back = v < 0;  // where it is stuck the other level, which may be infinite, is never met
    const Real direction = select(back, Real(-1.0), 1.0);
    const Slide slide{abs(v), direction * (load - select(back, -backward, forward)), direction * slope};

    // The first zero of u + a t + q t^2/2, from the form of the roots in which nothing cancels.
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
    // It reversed and stopped once more: from here the load runs the way it slips, and it will not stop a third time.
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

// Collects what goes into a LaneAccount.
class Account {
 public:
  HWY_INLINE Account() : work_(0.0), indistinct_(Bool::first(0)) {}

  void distinct(const Bool& are) { indistinct_ = indistinct_ | ~are; }

  // The work of a load that runs straight on what moves as a cubic: the displacement's mean is known from its ends.
  HWY_INLINE void slide(const Blocks& blocks, const Real& distance, const Real& begin, const Real& duration,
                        const Real& first_velocity, const Real& last_velocity) {
    const Real gain = blocks.slope * duration, start = multiply_add(blocks.slope, begin, blocks.load);
    work_ = work_ + nfma(gain * duration, (first_velocity - last_velocity) * (1.0 / 12),
                         distance * multiply_add(gain, 0.5, start));
  }

  // Blocks that were stuck until now, or have just stopped, having come forward or `back`.
  HWY_INLINE void turn(const Bool& stuck, const Bool& stops, const Bool& back, const Real& x, const Real& t,
                       const Slip& slip) {
    const Bool turns = stuck | stops, rests = but_not(stops, slip.at_once);
    const Bool reverses = but_not(stops & slip.at_once, slip.forward ^ back);
    Turn& turn = turns_[count_++];
    x.store(turn.displacement);
    t.store(turn.time);
    select(rests, code(EventKind::arrest),
           select(reverses, code(EventKind::reversal),
                  select(stuck & slip.at_once, code(EventKind::breakaway), code(EventKind::end))))
        .store(turn.kind);
    slip.begin.store(turn.later);
    select(turns & slip.later, code(EventKind::breakaway), code(EventKind::end)).store(turn.later_kind);
    distinct(~(turns & but_not((slip.at_once | slip.later) & (slip.velocity == 0), slip.stops)));
    distinct(~(stops & slip.later & (slip.begin <= t)));
  }

  void write(const std::uint8_t* lane, std::size_t blocks, LaneAccount& account) const {
    double work[Real::size];
    work_.store(work);
    const std::uint64_t indistinct = bits(indistinct_);
    for (std::size_t i = 0; i < blocks; ++i) {
      LaneEvent* next = account.next[lane[i]];
      for (std::size_t k = 0; k < count_; ++k) {
        const Turn& turn = turns_[k];
        const auto write_if = [&](double time, double kind) {  // the next one goes over it, if it is none
          *next = {time, turn.displacement[i], account.segment, static_cast<EventKind>(static_cast<int>(kind))};
          next += next->kind != EventKind::end;
        };
        write_if(turn.time[i], turn.kind[i]);
        write_if(turn.later[i], turn.later_kind[i]);
      }
      account.next[lane[i]] = next;
      account.work_after[lane[i]] += work[i];
      account.indistinct |= (indistinct >> i & 1) << lane[i];
    }
  }

 private:
  struct Turn {
    double displacement[Real::size], time[Real::size], kind[Real::size], later[Real::size], later_kind[Real::size];
  };

  static Real code(EventKind kind) { return static_cast<double>(kind); }  // `end` where there is none

  Real work_;
  Bool indistinct_;
  Turn turns_[2];
  std::size_t count_ = 0;
};

template <bool peaks, bool accounts>
HWY_INLINE void advance(const CoulombLanes& slider, std::size_t members, const double* HWY_RESTRICT start,
                        const double* HWY_RESTRICT end, const LaneStates& from, const LaneStates& to,
                        LaneAccount* account) {
  const Real h = slider.duration, forward = slider.forward, backward = slider.backward;
  const double half = slider.duration / 2, sixth = slider.duration / 6;

  // Without an event: on with the same friction, or stuck throughout. The others are marked, one bit each.
  std::uint64_t eventful = 0;
  for (std::size_t i = 0; i < members; i += Real::size) {
    const Real x = Real::load(from.displacement + i), v = Real::load(from.velocity + i);
    const Real n0 = Real::load(start + i), n1 = Real::load(end + i);
    const Real level = select(v < 0, -backward, forward);
    const Real g0 = n0 + level, g1 = n1 + level;  // decelerations
    // The velocity is a parabola: it stays within the triangle of its Bernstein coefficients v, `middle` and `last`.
    const Real middle = nfma(half, g0, v), last = nfma(half, g1, middle);
    const Bool slides = min(v * middle, v * last) > 0;
    const Bool held = (v == 0) & (max(n0, n1) <= backward) & (min(n0, n1) >= -forward);
    const Real mean = nfma(sixth, (g0 + g0) + g1, v);  // velocity
    const Real there = select(slides, multiply_add(h, mean, x), x);
    there.store(to.displacement + i);
    select(slides, last, v).store(to.velocity + i);
    if constexpr (peaks) max(Real::load(from.peak + i), abs(there)).store(to.peak + i);
    if constexpr (accounts) {
      const Real work = h * nfma(n0 + n1, mean * 0.5, (n1 - n0) * (v - last) * (1.0 / 12));
      (Real::load(account->work_before + i) + where(slides, work)).store(account->work_after + i);
    }
    eventful |= bits(~(slides | held)) << i;
  }

  if (eventful == 0) return;
  const double rate = 1 / slider.duration;
  go_through_events<Real>(
      eventful, start, end, to,
      [&](const LaneQueue& queue, std::size_t k, Real& x, Real& v, Real& peak) HWY_ATTR {
        const Real n0 = Real::load(queue.start + k), n1 = Real::load(queue.end + k);
        Blocks blocks{forward, backward, -n0, -n1, (n0 - n1) * rate, h, peak};
        std::conditional_t<accounts, Account, NoAccount> taken;
        blocks.move(x, v, taken);
        peak = blocks.peak;
        if constexpr (accounts) taken.write(queue.lane + k, std::min(Real::size, queue.count - k), *account);
        return Bool::first(Real::size);
      },
      [](const LaneQueue&, std::size_t) {});
}

void AdvanceCoulomb(const CoulombLanes& slider, std::size_t members, const double* HWY_RESTRICT start,
                    const double* HWY_RESTRICT end, const LaneStates& states) {
  advance<true, false>(slider, members, start, end, states, states, nullptr);
}
void AdvanceRow(const CoulombLanes& slider, const double* HWY_RESTRICT start, const double* HWY_RESTRICT end,
                const LaneStates& row, const LaneStates& next_row) {
  advance<false, false>(slider, most_lanes, start, end, row, next_row, nullptr);
}
void AdvanceRowWithAccount(const CoulombLanes& slider, const double* HWY_RESTRICT start, const double* HWY_RESTRICT end,
                           const LaneStates& row, const LaneStates& next_row, LaneAccount& account) {
  advance<false, true>(slider, most_lanes, start, end, row, next_row, &account);
}

}  // namespace stickslip::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace stickslip::detail {

HWY_EXPORT(AdvanceCoulomb);
HWY_EXPORT(AdvanceRow);
HWY_EXPORT(AdvanceRowWithAccount);

void advance_lanes(const CoulombLanes& slider, std::size_t members, const double* start, const double* end,
                   const LaneStates& states) {
  HWY_DYNAMIC_DISPATCH(AdvanceCoulomb)(slider, members, start, end, states);
}

void advance_lanes(const CoulombLanes& slider, const double* start, const double* end, const LaneStates& row,
                   const LaneStates& next_row, LaneAccount* account) {
  if (account == nullptr)
    HWY_DYNAMIC_DISPATCH(AdvanceRow)(slider, start, end, row, next_row);
  else
    HWY_DYNAMIC_DISPATCH(AdvanceRowWithAccount)(slider, start, end, row, next_row, *account);
}

}  // namespace stickslip::detail
#endif
