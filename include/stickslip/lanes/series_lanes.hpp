// Sliders with any analytic law in parallel lanes, each over a segment of its own ground motion, by power series.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "stickslip/flow/damped.hpp"
#include "stickslip/friction/caster.hpp"
#include "stickslip/friction/coulomb.hpp"
#include "stickslip/friction/law.hpp"
#include "stickslip/friction/velocity_dependent.hpp"
#include "stickslip/lanes/row.hpp"
#include "stickslip/lanes/vector.hpp"
#include "stickslip/series/series.hpp"
#include "stickslip/slider/slider.hpp"

#ifdef STICKSLIP_VECTORS
namespace stickslip::detail {

#define STICKSLIP_LANES_INLINE
#include "stickslip/lanes/kernel.inl"
#undef STICKSLIP_LANES_INLINE

/// A law that can be evaluated as a power series in lanes.
template <class Law>
concept LawWithLanes = FrictionLaw<Law> && requires(const Law& law, const series::VariableOf<BaselineVector>& x) {
  series::series_of<BaselineVector>(resist(law, x, x, Direction::forward));
};

/// A slide of several sliders, each in its own direction, over a step of its own:
///     u' = s (p(t) - wn^2 x) - c u - resist(x, u),    x' = s u,
/// as power series in time, in units of the step.
template <LawWithLanes Law, class Vector>
class SlideOfLanes {
  using Mask = typename Vector::Mask;
  static constexpr bool both_ways = !SymmetricLaw<Law>;

 public:
  static constexpr int max_orders = 20;

  SlideOfLanes(const Slider<Law>& slider, const Vector& displacement, const Vector& speed)
      : slider_(slider), forward_(level(Direction::forward)), backward_(level(Direction::backward)) {
    x_[0] = displacement;
    u_[0] = speed;
    forward_.update(0);
    if constexpr (both_ways) backward_.update(0);
  }
  SlideOfLanes(const SlideOfLanes&) = delete;
  SlideOfLanes& operator=(const SlideOfLanes&) = delete;

  /// At the beginning [m/s^2].
  Vector resists(Direction direction) const { return resists_at(0, direction); }
  Vector resists(const Mask& back) const { return resists_at(0, back); }

  /// Compute the series.
  /// @param back          the sliders that slide backward
  /// @param acceleration  net, at the beginning, in each one's direction [m/s^2]
  /// @param gain          of the load within the step, in each one's direction [m/s^2]
  /// @param step          [s]
  /// @param wanted        lanes that are needed; the others may have any result
  void expand(const Mask& back, const Vector& acceleration, const Vector& gain, const Vector& step,
              const Mask& wanted) {
    const double stiffness = slider_.stiffness(), damping = slider_.damping();
    const Vector s = select(back, -1.0, 1.0), to_x = s * step;
    const Vector here = resists(back);
    Vector net = acceleration, change[3] = {0.0, 0.0, 0.0};
    Vector fastest = abs(u_[0]), last = fastest;
    Mask small{};
    for (int k = 0;; ++k) {
      if (k > 0) {
        forward_.update(k);
        if constexpr (both_ways) backward_.update(k);
        change[k % 3] = resists_at(k, back);
        net = -change[k % 3];
        if (k == 1) net += gain;
        if (stiffness > 0) net -= stiffness * (s * x_[k]);
        if (damping > 0) net -= damping * u_[k];
      }
      u_[k + 1] = step * net * series::reciprocal[k + 1];
      x_[k + 1] = to_x * u_[k] * series::reciprocal[k + 1];
      const Vector term = abs(u_[k + 1]);
      fastest = max(fastest, term);
      small = max(term, last) <= left_out * fastest;
      last = term;
      orders_ = k + 1;
      if (k >= 3 && (orders_ == max_orders || all(small | ~wanted))) break;
    }
    x_[orders_ + 1] = to_x * u_[orders_] * series::reciprocal[orders_ + 1];
    converges_ = small;
    if constexpr (form_of<Law> == Form::constant) return;

    // Whether the equation of motion holds at the end of the step, and within it for sliders that may have returned to
    // their initial position.
    const Mask recent = max(abs(change[0]), max(abs(change[1]), abs(change[2]))) <= max(abs(here), Vector(1e-290));
    // If the level has almost underflowed, its series does not represent the level closer to the center.
    const Mask blind = (here <= 1e-290) & (s * x_[0] < 0.0);
    if (any(blind)) converges_ = converges_ & ~(blind & (resists_now(0.0, u_[0], back) > 1e-290));
    start_ = {back, acceleration, gain, step, fastest};
    converges_ = converges_ & recent & balanced(1.0);
    const Mask slow = converges_ & wanted & (u_[0] * 16.0 <= fastest);
    if (any(slow)) converges_ = converges_ & (~slow | balanced(0.6));
    if constexpr (SpeedLaw<Law>) {
      // A level that changes only at low speeds is seen at the minimum of the speed, or nowhere.
      Vector last_change = 0.0;
      for (int k = orders_; k > 0; --k) last_change += static_cast<double>(k) * u_[k];
      const Mask dips = converges_ & wanted & (acceleration < 0.0) & (last_change > 0.0);
      const Vector first_change = acceleration * step;
      if (any(dips)) converges_ = converges_ & (~dips | balanced(first_change / (first_change - last_change)));
    }
  }

  const Mask& converges() const { return converges_; }

  /// Lanes in which the speed certainly has no zero: the Bernstein coefficients of its first three terms exceed the
  /// largest possible sum of the others.
  Mask goes_on() const {
    Vector rest = 0.0;
    for (int k = 3; k <= orders_; ++k) rest += abs(u_[k]);
    const Vector middle = u_[0] + 0.5 * u_[1];
    return min(u_[0], min(middle, u_[0] + u_[1] + u_[2])) > rest;
  }

  Vector displacement(const Vector& part) const {
    Vector x = x_[orders_ + 1];
    for (int k = orders_; k >= 0; --k) x = multiply_add(x, part, x_[k]);
    return x;
  }
  Vector last_displacement() const { return sum(x_, orders_ + 1); }
  Vector last_speed() const { return sum(u_, orders_); }

  /// The zeros of the speed within the step, except the one at the start of a slide from rest.
  struct Stops {
    Mask none, one;  ///< lanes in which the number is certain
    Vector part;     ///< time of the zero, as a fraction of the step
  };
  Stops stops(const Mask& from_rest, const Mask& wanted) {
    Vector c[max_orders + 1], b[max_orders + 1];
    double binomial = 1;
    for (int k = 0; k <= orders_; ++k) {
      c[k] = select(from_rest, k < orders_ ? u_[k + 1] : Vector(0.0), u_[k]);
      b[k] = c[k] * (1 / binomial);
      binomial *= static_cast<double>(orders_ - k) / (k + 1);
    }
    // Descartes' rule for Bernstein coefficients.
    for (int i = 1; i <= orders_; ++i)
      for (int k = orders_; k >= i; --k) b[k] += b[k - 1];
    Mask changed{}, twice{}, negative{};
    for (int k = 0; k <= orders_; ++k) {
      const Mask now = b[k] < 0.0, changes = now ^ negative;
      twice = twice | (changed & changes);
      changed = changed | changes;
      negative = now;
    }
    Stops result{~changed, changed & ~twice, 1.0};
    const Mask searched = result.one & wanted;
    if (any(searched)) {
      result.part = zero_of_polynomials(c, orders_, Vector(0.5), searched);
      if constexpr (SpeedLaw<Law>) converges_ = converges_ & (~searched | balanced(result.part));
    }
    return result;
  }

 private:
  using Series = decltype(series::series_of<Vector>(resist(std::declval<const Law&>(), series::VariableOf<Vector>{},
                                                           series::VariableOf<Vector>{}, Direction::forward)));

  /// Whether the equation of motion holds at a fraction of the step.
  Mask balanced(const Vector& part) const {
    const auto& [back, acceleration, gain, step, fastest] = start_;
    const double stiffness = slider_.stiffness(), damping = slider_.damping();
    const Vector s = select(back, -1.0, 1.0), here = resists(back);
    Vector x = x_[orders_ + 1], u = 0.0, a = 0.0;  // a: by the unit of time
    for (int k = orders_; k >= 0; --k) {
      a = multiply_add(a, part, u);
      u = multiply_add(u, part, u_[k]);
      x = multiply_add(x, part, x_[k]);
    }
    const Vector there = resists_now(x, u, back), pull = stiffness * (s * (x - x_[0])), drag = damping * (u - u_[0]);
    const Vector off = acceleration + gain * part - pull - drag - (there - here);
    const Vector terms =
        abs(acceleration) + abs(gain) + abs(pull) + damping * fastest + abs(here) + abs(there) + stiffness * abs(x_[0]);
    return abs(off * step - a) <= 20 * left_out * (terms * step + fastest);
  }

  Series level(Direction direction) const {
    return series::series_of<Vector>(
        resist(slider_.law(), series::VariableOf<Vector>{&x_}, series::VariableOf<Vector>{&u_}, direction));
  }
  Vector resists_at(int k, Direction direction) const {
    return both_ways && direction == Direction::backward ? backward_[k] : forward_[k];
  }
  Vector resists_at(int k, const Mask& back) const {
    if constexpr (both_ways)
      return select(back, backward_[k], forward_[k]);
    else
      return forward_[k];
  }
  Vector resists_now(const Vector& x, const Vector& u, const Mask& back) const {
    const Vector forward = resist(slider_.law(), x, u, Direction::forward);
    if constexpr (both_ways)
      return select(back, resist(slider_.law(), x, u, Direction::backward), forward);
    else
      return forward;
  }

  static Vector sum(const series::CoefficientsOf<Vector>& c, int orders) {
    Vector even = 0.0, odd = 0.0;  // small terms first, in two independent sums
    int k = orders;
    for (; k >= 2; k -= 2) {
      even += c[k];
      odd += c[k - 1];
    }
    if (k == 1) odd += c[1];
    return (even + odd) + c[0];
  }

  static constexpr double left_out = form_of<Law> == Form::constant ? 0x1p-54 : 1e-14;  // relative to the largest term

  /// The arguments of `expand`, and the largest term of the speed.
  struct Beginning {
    Mask back;
    Vector acceleration, gain, step, fastest;
  };

  const Slider<Law>& slider_;
  Beginning start_;
  series::CoefficientsOf<Vector> x_, u_;  // displacement [m], and speed in its direction [m/s]
  Series forward_, backward_;             // resistance [m/s^2]
  int orders_ = 0;                        // of the speed
  Mask converges_{};
};

/// The slider common to all lanes, and the duration of the segments.
template <LawWithLanes Law>
struct SeriesLanes {
  SeriesLanes(const Slider<Law>& one, double segment)
      : slider(one), duration(segment), step(one.damping(), one.natural_frequency(), segment) {}

  /// In units of 1 / wn: longer segments with constant friction are integrated one by one.
  static constexpr double longest = 1;

  Slider<Law> slider;
  double duration;   ///< of each segment [s]
  DampedBasis step;  ///< over one segment, with constant friction
};

/// The holding levels of sliders at rest at x [m/s^2].
template <LawWithLanes Law, class Vector>
Vector holds(const Law& law, const Vector& x, const Vector& resists, Direction direction) {
  if constexpr (LawWithHold<Law>) {
    return max(each_lane(x, [&](double place) { return law.hold(place, direction); }), resists);
  } else {
    return resists;
  }
}

/// The motion of sliders through all slips and rests of a segment; some may not reach its end.
template <LawWithLanes Law, class Vector>
struct EventsOfLanes {
  using Mask = typename Vector::Mask;

  const SeriesLanes<Law>& lanes;
  Vector x, v, peak, load, last_load;

  /// Returns which sliders reached the end.
  Mask run() {
    const Vector h = lanes.duration, rate = (last_load - load) / h;
    const double stiffness = lanes.slider.stiffness(), damping = lanes.slider.damping();
    Vector time = 0.0, step = 1.0;  // in segments
    Vector s = select(v < 0.0, -1.0, 1.0), speed = abs(v), net = load - stiffness * x;
    Mask stuck = v == 0.0, done{}, lost{}, from_rest{};
    Vector halved = 0.0;  // consecutive times
    for (int round = 0; round < 64; ++round) {
      SlideOfLanes<Law, Vector> slide(lanes.slider, x, speed);
      if (any(stuck)) {
        const Vector forward = holds(lanes.slider.law(), x, slide.resists(Direction::forward), Direction::forward);
        const Vector backward = holds(lanes.slider.law(), x, slide.resists(Direction::backward), Direction::backward);
        const Vector last_net = last_load - stiffness * x;
        const DepartureOfLanes<Vector> departure(net, last_net, forward, backward);
        const Mask later = stuck & departure.later, slips = later | (stuck & departure.at_once);
        // The excess of the load over the level is positive for any rounding.
        const Vector room = abs(departure.level - net), beyond = abs(last_net - departure.level);
        time = select(later, min(time + (1.0 - time) * (room / (room + beyond)), 1.0), time);
        net = select(later, departure.level, net);
        s = select(slips, select(departure.forward, 1.0, -1.0), s);
        step = select(slips, 1.0 - time, step);
        done = done | (stuck & (~slips | (step <= 0.0)));
        from_rest = select_mask(stuck, slips, from_rest);
      }
      if (all(done | lost)) break;

      const Mask back = s < 0.0, open = ~(done | lost);
      const Vector tau = step * h;
      slide.expand(back, s * net - slide.resists(back) - damping * speed, s * rate * tau, tau, open);
      const auto zeros = slide.stops(from_rest, open & slide.converges());
      const Mask good = open & slide.converges();
      const Mask goes_on = good & zeros.none, stops = good & zeros.one, moves = goes_on | stops;
      const Vector part = select(stops, zeros.part, 1.0);
      x = select(moves, slide.displacement(part), x);
      speed = select(goes_on, max(slide.last_speed(), 0.0), select(stops, 0.0, speed));
      peak = select(moves, max(peak, abs(x)), peak);
      done = done | (goes_on & (step == 1.0 - time));
      time = select(moves, min(time + step * part, 1.0), time);
      net = select(moves, load + (last_load - load) * time - stiffness * x, net);
      step = select(goes_on, min(step + step, 1.0 - time), select(stops, 1.0 - time, step * 0.5));
      halved = select(moves, 0.0, halved + 1.0);
      lost = lost | (halved > 4.0);
      stuck = stops;
      from_rest = from_rest & ~moves;
    }
    v = s * speed;
    return done;
  }

 private:
  static Mask select_mask(const Mask& mask, const Mask& yes, const Mask& no) { return (mask & yes) | (~mask & no); }
};

/// Most sliders slide throughout a segment without an event, or are stuck throughout; with constant friction both cases
/// have a closed form. The other sliders are packed and followed through their events; the few that remain are
/// integrated by `advance`.
template <class Vector, LawWithLanes Law>
void advance_row(const SeriesLanes<Law>& lanes, std::size_t members, const double* start, const double* end,
                 const LaneStates& states) {
  using Mask = typename Vector::Mask;
  const Slider<Law>& slider = lanes.slider;
  const double h = lanes.duration, stiffness = slider.stiffness(), damping = slider.damping();
  std::uint64_t eventful = 0;
  for (std::size_t i = 0; i < members; i += Vector::size) {
    const Vector x = Vector::load(states.displacement + i), v = Vector::load(states.velocity + i);
    const Vector load = -Vector::load(start + i), last_load = -Vector::load(end + i);
    const Mask stuck = v == 0.0, back = v < 0.0;
    const Vector s = select(back, -1.0, 1.0), speed = abs(v);
    const Vector net = load - stiffness * x, last_net = last_load - stiffness * x;
    SlideOfLanes<Law, Vector> slide(slider, x, speed);
    Mask held = stuck;
    if (any(stuck)) {
      const Vector forward = holds(slider.law(), x, slide.resists(Direction::forward), Direction::forward);
      const Vector backward = holds(slider.law(), x, slide.resists(Direction::backward), Direction::backward);
      held = held & (max(net, last_net) <= forward) & (min(net, last_net) >= -backward);
    }
    if (all(held)) continue;
    const Vector push = s * net - slide.resists(back), acceleration = push - damping * speed,
                 gain = s * (last_load - load);
    Vector there, last_speed;
    Mask slides;
    if constexpr (form_of<Law> == Form::constant) {
      const DampedBasis& step = lanes.step;
      const Vector slope = gain / h;
      there = x + s * (speed * step.impulse + push * step.step + slope * step.ramp);
      last_speed = speed * step.decay + push * step.impulse + slope * step.step;
      // The acceleration is a decaying oscillation; over at most one radian it never exceeds the sum of its values at
      // the ends of the step. The speed differs from the line between its ends by at most an eighth of its curvature.
      const Vector after = s * (last_load - stiffness * there) - slide.resists(back) - damping * last_speed;
      const Vector most = abs(acceleration) + abs(after);
      const Vector curvature = abs(slope) + stiffness * (max(speed, last_speed) + h * most) + damping * most;
      slides = ~stuck & (min(speed, last_speed) > (h * h / 8) * curvature);
    } else {
      slide.expand(back, acceleration, gain, h, ~stuck);
      there = slide.last_displacement();
      last_speed = max(slide.last_speed(), 0.0);
      slides = ~stuck & slide.converges() & slide.goes_on();
    }
    there = select(slides, there, x);
    there.store(states.displacement + i);
    select(slides, s * last_speed, v).store(states.velocity + i);
    max(Vector::load(states.peak + i), abs(there)).store(states.peak + i);
    eventful |= bits(~(slides | held)) << i;
  }
  if (members < 64) eventful &= (std::uint64_t{1} << members) - 1;
  if (eventful == 0) return;

  go_through_events<Vector>(
      eventful, start, end, states,
      [&](const LaneQueue& queue, std::size_t k, Vector& x, Vector& v, Vector& peak) {
        EventsOfLanes<Law, Vector> events{
            lanes, x, v, peak, -Vector::load(queue.start + k), -Vector::load(queue.end + k)};
        const Mask done = events.run();
        x = select(done, events.x, x);
        v = select(done, events.v, v);
        peak = select(done, events.peak, peak);
        return done;
      },
      [&](const LaneQueue& queue, std::size_t k) {
        advance_alone(slider, queue.segment(k, h), queue.state(k), states, queue.lane[k]);
      });
}

template <LawWithLanes Law>
STICKSLIP_FLATTEN void advance_lanes_anywhere(const SeriesLanes<Law>& lanes, std::size_t members, const double* start,
                                              const double* end, const LaneStates& states) {
  advance_row<BaselineVector>(lanes, members, start, end, states);
}
#ifdef STICKSLIP_AVX2
template <LawWithLanes Law>
[[gnu::target("avx2,fma")]] STICKSLIP_FLATTEN void advance_lanes_avx2(const SeriesLanes<Law>& lanes,
                                                                      std::size_t members, const double* start,
                                                                      const double* end, const LaneStates& states) {
  advance_row<Avx2Vector>(lanes, members, start, end, states);
}
#endif

/// Integrate each slider over its segment of ground acceleration, from start[i] to end[i] [m/s^2]:
///     x'' + resist sgn(x') + c x' + wn^2 x = -n(t)
/// with the same events as `advance`, with the instruction set of this processor.
/// @param members  at most `max_lanes`
template <LawWithLanes Law>
void advance_lanes(const SeriesLanes<Law>& lanes, std::size_t members, const double* start, const double* end,
                   const LaneStates& states) {
#ifdef STICKSLIP_AVX2
  static const bool avx2 = __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("fma") != 0;
  if (avx2) return advance_lanes_avx2(lanes, members, start, end, states);
#endif
  advance_lanes_anywhere(lanes, members, start, end, states);
}

}  // namespace stickslip::detail

#ifdef STICKSLIP_LIBRARY  // the linked library contains these
namespace stickslip::detail {
extern template void advance_lanes(const SeriesLanes<Coulomb>&, std::size_t, const double*, const double*,
                                   const LaneStates&);
extern template void advance_lanes(const SeriesLanes<Caster>&, std::size_t, const double*, const double*,
                                   const LaneStates&);
extern template void advance_lanes(const SeriesLanes<VelocityDependent>&, std::size_t, const double*, const double*,
                                   const LaneStates&);
}  // namespace stickslip::detail
#endif
#endif
