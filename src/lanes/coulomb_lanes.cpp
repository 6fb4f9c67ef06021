#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "lanes/coulomb_lanes.cpp"
#include "lanes/coulomb_lanes.hpp"

#include <hwy/foreach_target.h>

#include <algorithm>
#include <cstdint>
#include <type_traits>

#include "lanes/blocks-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace stickslip::detail::HWY_NAMESPACE {

// Collects the data of a LaneAccount.
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

  // Blocks that were stuck until now or have just stopped, after sliding forward or `back`.
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
        const auto write_if = [&](double time, double kind) {  // without an event, the next one overwrites it
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
  advance<false, false>(slider, max_lanes, start, end, row, next_row, nullptr);
}
void AdvanceRowWithAccount(const CoulombLanes& slider, const double* HWY_RESTRICT start, const double* HWY_RESTRICT end,
                           const LaneStates& row, const LaneStates& next_row, LaneAccount& account) {
  advance<false, true>(slider, max_lanes, start, end, row, next_row, &account);
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
