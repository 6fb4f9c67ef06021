// By how much the decisions of a response fell as they did.
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "stickslip/detail/equal.hpp"
#include "stickslip/detail/event_loop.hpp"
#include "stickslip/detail/load_history.hpp"
#include "stickslip/detail/min_max.hpp"
#include "stickslip/friction/law.hpp"
#include "stickslip/ground/motion.hpp"
#include "stickslip/slider.hpp"
#include "stickslip/sliding/forces.hpp"
#include "stickslip/sliding/response.hpp"
#include "stickslip/state.hpp"
#include "stickslip/units.hpp"

namespace stickslip {

/// By how much the closest decisions of a response fell as they did; relative, infinite where none fell.
///
/// A margin near round-off, 1e-12 say, means that the last digits of the input decided. Static friction above kinetic
/// then gives another response for the least change of it; where static and kinetic friction are equal the response is
/// continuous, and the decision alone hangs on them.
struct Margins {
  /// The smallest |load - level| / level of stick and slip. The load is q = p - wn^2 x, the level what the law says
  /// times N+/g, and the comparisons are those with
  /// - what holds in either direction, where a slip ends: it sticks, or turns round;
  /// - what resists sliding, where a slip ends in a zero of velocity: it stops, or only slows down;
  /// - what holds, at each maximum of q / level of a rest: it stays;
  /// - what holds, at the next such maximum after a breakaway, x as at rest: it leaves.
  /// Comparisons with a level that is zero or infinite do not count, nor does the way into a breakaway, on which the
  /// load passes through the level.
  double load = std::numeric_limits<double>::infinity();

  /// The smallest way, over the distance of the stop from x = 0, by which a stop was missed or met: where a slip ends,
  /// the way that was left; in an impact at speed v under a load that slows the slider down, the way v^2 / (2 (a - q))
  /// that it would have gone on, with a what resists.
  double impact = std::numeric_limits<double>::infinity();
};

namespace detail {

/// Collects the margins of a response.
template <FrictionLaw Law, class History>
class MarginFinder {
 public:
  MarginFinder(const Slider<Law>& slider, const History& history)
      : slider_(slider), history_(history), bounds_{slider.mounting().stops, slider.mounting().one_way} {}

  /// @param heat  heat(time), at the surface
  template <class Heat>
  Margins find(const std::vector<Event>& events, SlidAlong slid, double begin, double from, const Heat& heat) {
    bool sticks = true, flies = false;
    double since = begin, x = from;
    const Event* before = nullptr;
    for (std::size_t k = 0; k < events.size(); ++k) {
      const Event& e = events[k];
      const bool at_once = before != nullptr && equal(before->time, e.time);
      at_ = slid.to(e.displacement);
      at_.heat = heat(e.time);
      switch (e.kind) {
        case EventKind::breakaway:
          if (equal(e.velocity, 0) && !flies) broke_away(since, e);
          sticks = false;
          break;
        case EventKind::reversal:
        case EventKind::arrest:
          if (!flies) ended(e, x, at_once && before->kind != EventKind::reversal);
          sticks = e.kind == EventKind::arrest;
          since = e.time;
          break;
        case EventKind::impact:
          hit(e, x);
          break;
        case EventKind::end:
          if (sticks && since < e.time) rested(since, e.time, e.displacement);
          break;
        case EventKind::liftoff:
        case EventKind::landing:
          flies = e.kind == EventKind::liftoff;
          break;
      }
      x = e.displacement;
      before = &e;
    }
    return margins_;
  }

 private:
  static constexpr double infinite = std::numeric_limits<double>::infinity();

  /// Load without friction, and what a level is multiplied by.
  struct Net {
    double load, weight;
  };
  Net net(const Load& now, double x) const noexcept {
    const double weight = std::max(now.normal, 0.0) / standard_gravity;
    return {now.load - slider_.stiffness() * (slider_.mounting().pendulum ? weight : 1) * x, weight};
  }
  /// What is left of a level, over it, under a load that goes in a direction; infinite where that decides nothing.
  static double left_of(double level, Direction direction, const Net& net) noexcept {
    const double weighed = level < infinite ? level * net.weight : infinite;
    return weighed > 0 && weighed < infinite ? 1 - sign(direction) * net.load / weighed : infinite;
  }
  double held(Direction direction, double x, const Net& net) const {
    return left_of(bounds_.bound(direction, x, hold(law_at(slider_.law(), at_, net.weight), x, direction)), direction,
                   net);
  }

  void count(double left) noexcept { margins_.load = std::min(margins_.load, std::abs(left)); }
  void count_impact(double way, Direction direction) noexcept {
    const double distance = std::abs(bounds_.wall(direction));
    if (distance < infinite) margins_.impact = std::min(margins_.impact, std::abs(way) / distance);
  }

  /// A slip ended: it turned round, or stopped.
  /// @param x       where it began [m]
  /// @param forced  its velocity was brought to zero by a stop or a landing
  void ended(const Event& e, double x, bool forced) {
    const Net now = net(history_.after(e.time), e.displacement);
    for (const Direction direction : {Direction::forward, Direction::backward})
      count(held(direction, e.displacement, now));
    if (forced || equal(e.displacement, x)) return;
    const Direction direction = e.displacement > x ? Direction::forward : Direction::backward;
    count(left_of(resist(law_at(slider_.law(), at_, now.weight), e.displacement, direction, 0.0), direction, now));
    count_impact(bounds_.room(direction, e.displacement), direction);
  }

  /// The maxima of load / level in both directions between two times; but for the last time in the direction in which
  /// it then breaks away, if it does.
  void rested(double from, double to, double x, Mode leaves = Mode::stuck) {
    for (const Direction direction : {Direction::forward, Direction::backward}) {
      double last = infinite;
      bool falls = true;
      history_.nodes(from, to, [&](const Load& load) {
        const double left = held(direction, x, net(load, x));
        if (left > last && falls) count(last);
        if (!equal(left, last)) falls = left < last;
        last = left;
        return true;
      });
      if (falls && leaves != mode_of(direction)) count(last);
    }
  }

  /// It broke away, from a rest since a time.
  void broke_away(double since, const Event& e) {
    const double x = e.displacement;
    const Net now = net(history_.after(e.time), x);
    const Direction direction = now.load > 0 ? Direction::forward : Direction::backward;
    if (since < e.time) rested(since, e.time, x, mode_of(direction));
    double least = infinite;  // left of the level
    history_.nodes(e.time, infinite, [&](const Load& load) {
      const double left = held(direction, x, net(load, x));
      if (!(left <= least)) return false;
      least = left;
      return true;
    });
    count(least);
  }

  /// @param x  where the slip began [m]
  void hit(const Event& e, double x) {
    const Direction direction = !equal(e.velocity, 0) ? (e.velocity > 0 ? Direction::forward : Direction::backward)
                                : e.displacement >= x ? Direction::forward
                                                      : Direction::backward;
    const Net now = net(history_.after(e.time), e.displacement);
    const double speed = std::abs(e.velocity);
    const double slows = resist(law_at(slider_.law(), at_, now.weight), e.displacement, direction, speed) * now.weight -
                         sign(direction) * now.load;
    if (slows > 0) count_impact(speed * speed / (2 * slows), direction);
  }

  const Slider<Law>& slider_;
  const History& history_;
  Bounds bounds_;
  State at_;  // at the event
  Margins margins_;
};

}  // namespace detail

/// By how much the closest decisions of a response fell as they did.
/// @param slider    the slider that moved
/// @param motion    the ground motion it moved under
/// @param response  what `integrate` returned for them
/// Where the level depends on a temperature, that is taken straight between samples, and during a rest as at its end.
/// A velocity that all but touches zero without an event is no decision here, nor is a landing. One pass over events
/// and samples.
template <FrictionLaw Law, Motion M>
Margins margins(const Slider<Law>& slider, const M& motion, const Response& response) {
  const auto history = detail::load_history(motion, slider.slope());
  return detail::MarginFinder(slider, history)
      .find(response.events, detail::SlidAlong(response), motion.time(0), response.displacement.front(),
            [&](double time) { return detail::heat_at(slider.law(), motion, response, time); });
}

template <FrictionLaw Law, Motion M>
Margins margins(const Law& law, const M& motion, const Response& response) {
  return margins(Slider<Law>(law), motion, response);
}

}  // namespace stickslip
