#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "lanes/caster_lanes.cpp"
#include "lanes/caster_lanes.hpp"

#include <hwy/foreach_target.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "lanes/pack-inl.hpp"
#include "stickslip/sliding/advance.hpp"

HWY_BEFORE_NAMESPACE();
namespace stickslip::detail::HWY_NAMESPACE {

using Real = Pack<8 / lanes>;
using Bool = Real::Mask;

// Below, the unit of length is the reach and the unit of time is a step: y = x/l, w = dy/d(time).

constexpr int order = 9;            // of the series of sech; the velocity's has one more, the displacement's two
constexpr double left_out = 1e-13;  // of the velocity in a step, by the estimate; where terms cancel up to 3e-11
constexpr double far_off = 40;      // reaches; farther away friction is below 1e-17

struct Level {
  Real sech, tanh;

  static HWY_INLINE Level at(const Real& y) {
    const Real e = exp(-abs(y)), ee = e * e, share = Real(1) / (ee + 1);
    return {(e + e) * share, copysign((Real(1) - ee) * share, y)};
  }
};

// A slide over a step: y'' = load + slope t - friction sech(y), friction with the sign of the direction.
struct Series {
  Level level;  // at the beginning
  Real way;     // an upper bound of the distance
  Real w[order + 2];
  Bool converges;  // the truncation error is negligible

  // `first` may replace the first net acceleration by a more accurate one.
  template <class First>
  HWY_INLINE Series(const Real& y, const Real& speed, const Real& load, const Real& slope, const Real& friction,
                    First first)
      : level(Level::at(y)), way(abs(speed) + max(abs(load), abs(load + slope))) {
    Real s[order + 1], t[order + 1], angle[order];
    s[0] = level.sech;
    t[0] = level.tanh;
    w[0] = speed;
    w[1] = first(nfma(friction, s[0], load));
    // s = cos(angle), t = sin(angle) of the Gudermannian: angle' = s w, s' = -angle' t, t' = angle' s. The terms that
    // were computed last come last, so that the sums need not wait.
#pragma GCC unroll 16
    for (int k = 0; k < order; ++k) {
      Real sum = 0.0, cosine = 0.0, sine = 0.0;
#pragma GCC unroll 16
      for (int i = 1; i < k; ++i) sum = multiply_add(s[i], w[k - i], sum);
#pragma GCC unroll 16
      for (int i = 1; i < k; ++i) {
        cosine = multiply_add(angle[i], t[k - i], cosine);
        sine = multiply_add(angle[i], s[k - i], sine);
      }
      sum = multiply_add(s[0], w[k], sum);
      if (k > 0) {
        sum = multiply_add(s[k], w[0], sum);
        cosine = multiply_add(angle[0], t[k], cosine);
        sine = multiply_add(angle[0], s[k], sine);
      }
      angle[k] = sum;
      const Real share = 1.0 / (k + 1);
      s[k + 1] = -share * multiply_add(sum, t[0], cosine);
      t[k + 1] = share * multiply_add(sum, s[0], sine);
      const Real braked = friction * s[k + 1];
      w[k + 2] = (k == 0 ? slope - braked : -braked) * Real(1.0 / (k + 2));
    }
    // Terms decrease as the distance over pi/2, where the complex plane has the next pole, or faster; two of them are
    // tested, because one can vanish by symmetry. For distances beyond a reach they give no bound.
    const Real next = way * multiply_add(way * 0.4, abs(w[order]), abs(w[order + 1]));
    // From rest at y = 0, or nearly so, the level changes as y^2 ~ t^6 and then as y^4 ~ t^12, which the last terms do
    // not see.
    const Real far = abs(w[1]) + abs(w[2]);
    const Bool seen = (abs(w[0]) * 16.0 > far) | (abs(friction) * (far * far) * (far * far) <= 100 * left_out);
    converges = ((way <= 1) & (next <= left_out) & seen) | (abs(y) - way > far_off);
  }

  HWY_INLINE Real distance(const Real& t) const {
    Real sum = w[order + 1] * (1.0 / (order + 2));
#pragma GCC unroll 16
    for (int k = order; k >= 0; --k) sum = multiply_add(sum, t, w[k] * (1.0 / (k + 1)));
    return sum * t;
  }

  // Both at the end of the step, by summation.
  HWY_INLINE Real last_speed() const {
    Real odd = w[order], even = w[order + 1];
#pragma GCC unroll 16
    for (int k = order - 1; k >= 1; k -= 2) {
      even = even + w[k];
      odd = odd + w[k - 1];
    }
    return (odd + even) + w[0];
  }
  HWY_INLINE Real whole_distance() const {
    Real odd = w[order] * (1.0 / (order + 1)), even = w[order + 1] * (1.0 / (order + 2));
#pragma GCC unroll 16
    for (int k = order - 1; k >= 1; k -= 2) {
      even = multiply_add(w[k], 1.0 / (k + 1), even);
      odd = multiply_add(w[k - 1], 1.0 / k, odd);
    }
    return (odd + even) + w[0];
  }
};

struct Same {
  HWY_INLINE Real operator()(const Real& net) const { return net; }
};

// The velocity of a slide over a step, in its own direction: its zeros, except one at the start.
struct Zeros {
  static constexpr int degree = order + 1;
  Real c[degree + 1];     // power series
  Bool are_none, is_one;  // where this is certain

  HWY_INLINE Zeros(const Series& series, const Real& direction, const Bool& from_rest) {
#pragma GCC unroll 16
    for (int k = 0; k <= degree; ++k)
      c[k] = direction * select(from_rest, k < degree ? series.w[k + 1] : Real(0.0), series.w[k]);
    // Bernstein coefficient j: the sum over i <= j of c_i (j over i) / (degree over i). Descartes' rule holds for them.
    Bool changed = Real(0.0) != 0.0, twice = changed, negative = changed;
#pragma GCC unroll 16
    for (int j = 0; j <= degree; ++j) {
      Real b = c[0];
      double weight = 1;
#pragma GCC unroll 16
      for (int i = 1; i <= j; ++i) {
        weight *= static_cast<double>(j - i + 1) / (degree - i + 1);
        b = multiply_add(c[i], weight, b);
      }
      const Bool now_negative = b < 0, changes = now_negative ^ negative;
      twice = twice | (changed & changes);
      changed = changed | changes;
      negative = now_negative;
    }
    are_none = ~changed;
    is_one = but_not(changed, twice);
  }

  // The single zero, where there is one.
  HWY_INLINE Real find() const {
    // It starts from the zero of the first three terms.
    const Real root = sqrt(max(nfma(c[2] * 4.0, c[0], c[1] * c[1]), 0.0)), guess = (c[0] + c[0]) / (root - c[1]);
    return zero_of_polynomials(c, degree, select((guess > 0) & (guess < 1), guess, 0.5), is_one);
  }
};

// Moves casters through the events of their segments, with the duration as the unit of time; returns which of them
// reached the end.
HWY_INLINE Bool move(const Real& friction, Real& y, Real& w, const Real& load, const Real& slope, Real& peak) {
  Real time = 0.0, step = 1.0, direction = copysign(1.0, w);
  Bool stuck = w == 0, done = w != w, from_rest = done, eased = done;
  for (int round = 0; round < 64; ++round) {
    if (any(stuck)) {
      const Real held = friction * Level::at(y).sech;
      const DepartureOfLanes<Real> departure(multiply_add(slope, time, load), load + slope, held, held);
      const Bool later = stuck & departure.later, slips = later | (stuck & departure.at_once);
      direction = select(slips, select(departure.forward, Real(1.0), -1.0), direction);
      time = select(later, min(max(time, (departure.level - load) / slope), 1.0), time);
      step = select(slips, Real(1) - time, step);
      done = done | but_not(stuck, slips) | (slips & (step == 0));
      from_rest = slips | but_not(from_rest, stuck);
      eased = later | but_not(eased, stuck);
    }
    if (all(done)) break;

    const Real square = step * step;
    const Series series(y, w * step, multiply_add(slope, time, load) * square, slope * (square * step),
                        direction * (friction * square),
                        [&](const Real& net) HWY_ATTR { return select(from_rest & eased, 0.0, net); });
    const Zeros zeros(series, direction, from_rest);
    const Bool good = but_not(series.converges, done);
    const Bool goes_on = good & zeros.are_none, stops = good & zeros.is_one, moves = goes_on | stops;
    const Real at = any(stops) ? select(stops, zeros.find(), 1.0) : Real(1.0);
    y = select(moves, y + series.distance(at), y);
    w = select(goes_on, direction * (max(direction * series.last_speed(), 0.0) / step), select(stops, 0.0, w));
    peak = max(peak, abs(y));
    const Real left = Real(1) - time;
    done = done | (goes_on & (step == left));
    time = select(moves, multiply_add(step, at, time), time);
    step = select(moves, Real(1) - time, step * 0.5);
    stuck = stops;
    from_rest = but_not(from_rest, moves);
  }
  return done;
}

// Slides without an event in 2, 4, 8 ... steps, as many as all lanes need; returns which need no more than 64.
HWY_INLINE Bool slide(const Real& friction, Real& y, Real& w, const Real& load, const Real& slope) {
  const Real y0 = y, w0 = w, against = copysign(friction, w);
  Bool open;
  for (int steps = 2; steps <= 64; steps *= 2) {
    const double step = 1.0 / steps;
    const Real less_friction = against * (step * step), change = slope * (step * step * step);
    y = y0;
    w = w0 * step;
    open = w != w;
    for (int i = 0; i < steps; ++i) {
      const Series series(y, w, multiply_add(slope, i * step, load) * (step * step), change, less_friction, Same());
      open = open | ~series.converges;
      y = y + series.whole_distance();
      w = series.last_speed();
    }
    w = w * static_cast<double>(steps);
    if (!any(open)) break;
  }
  return ~open;
}

void AdvanceCasters(const CasterLanes& slider, std::size_t members, const double* HWY_RESTRICT start,
                    const double* HWY_RESTRICT end, const LaneStates& states) {
  const double reach = slider.law.reach(), h = slider.duration;
  const Real friction = slider.law.slip_level() * h * h / reach;
  const Real to_y = 1 / reach, to_w = h / reach, to_load = -h * h / reach, from_y = reach, from_w = reach / h;

  // Most slide on the way they do, or are stuck throughout. What is left, one bit each: those that may have an event;
  // those that have none but take shorter steps.
  std::uint64_t eventful = 0, fast = 0;
  for (std::size_t i = 0; i < members; i += Real::size) {
    const Real x = Real::load(states.displacement + i), v = Real::load(states.velocity + i);
    const Real load = Real::load(start + i) * to_load, load_end = Real::load(end + i) * to_load;
    const Real w = v * to_w, against = copysign(friction, v);
    const Series series(x * to_y, w, load, load_end - load, against, Same());

    // An upper bound of friction on the way: sech grows by no more than exp of the distance, and exp(z) is at most 1 +
    // z + z^2 for z < 1. With this constant level the velocity is a parabola, within its Bernstein coefficients.
    const Real growth = multiply_add(series.way, series.way + 1, 1.0);
    const Real most = against * select(series.way < 1, min(series.level.sech * growth, 1.0), 1.0);
    const Real middle = multiply_add(load - most, 0.5, w), lowest = multiply_add(load_end - most, 0.5, middle);
    const Bool safe = min(w * middle, w * lowest) > 0, slides = safe & series.converges;
    const Bool stuck = (v == 0) & (max(abs(load), abs(load_end)) <= friction * series.level.sech);

    const Real there = select(slides, multiply_add(from_y, series.whole_distance(), x), x);
    there.store(states.displacement + i);
    select(slides, from_w * series.last_speed(), v).store(states.velocity + i);
    max(Real::load(states.peak + i), abs(there)).store(states.peak + i);
    eventful |= bits(~(safe | stuck)) << i;
    fast |= bits(but_not(safe, series.converges)) << i;
  }

  const auto work_off = [&](std::uint64_t set_apart, auto work) HWY_ATTR {
    if (set_apart == 0) return;
    go_through_events<Real>(
        set_apart, start, end, states,
        [&](const LaneQueue& queue, std::size_t k, Real& x, Real& v, Real& peak) HWY_ATTR {
          const Real load = Real::load(queue.start + k) * to_load, load_end = Real::load(queue.end + k) * to_load;
          Real y = x * to_y, w = v * to_w, most = peak * to_y;
          const Bool settled = work(y, w, load, load_end - load, most);
          x = select(settled, y * from_y, x);
          v = select(settled, w * from_w, v);
          peak = select(settled, max(peak, max(most, abs(y)) * from_y), peak);
          return settled;
        },
        [&](const LaneQueue& queue, std::size_t k) {
          advance_alone(Slider<Caster>(slider.law), queue.segment(k, h), queue.state(k), states, queue.lane[k]);
        });
  };
  work_off(eventful, [friction](Real& y, Real& w, const Real& load, const Real& slope, Real& peak)
                         HWY_ATTR { return move(friction, y, w, load, slope, peak); });
  work_off(fast, [friction](Real& y, Real& w, const Real& load, const Real& slope, Real&)
                     HWY_ATTR { return slide(friction, y, w, load, slope); });
}

}  // namespace stickslip::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace stickslip::detail {

HWY_EXPORT(AdvanceCasters);

void advance_lanes(const CasterLanes& slider, std::size_t members, const double* start, const double* end,
                   const LaneStates& states) {
  HWY_DYNAMIC_DISPATCH(AdvanceCasters)(slider, members, start, end, states);
}

}  // namespace stickslip::detail
#endif
