// Margins of the decisions in a response: stick or slip, impact or not.
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "stickslip/base/equal.hpp"
#include "stickslip/base/min_max.hpp"
#include "stickslip/friction/law.hpp"
#include "stickslip/ground/motion.hpp"
#include "stickslip/slider.hpp"
#include "stickslip/sliding/detail/bounds.hpp"
#include "stickslip/sliding/detail/load_history.hpp"
#include "stickslip/sliding/forces.hpp"
#include "stickslip/sliding/response.hpp"
#include "stickslip/state.hpp"
#include "stickslip/units.hpp"

namespace stickslip {

/// Relative margins of the closest decisions of a response; infinite if there was no decision.
///
/// If a margin is near round-off, for example 1e-12, the last digits of the input decided. With static friction above
/// kinetic friction, the smallest change of the input may then give another response. With equal static and kinetic
/// friction the response is continuous, and only the decision itself depends on these digits.
struct Margins {
  /// The smallest |load - level| / level of stick and slip. The load is q = p - wn^2 x, and the level is that of the
  /// law times N+/g. The comparisons are those with
  /// - the holding level in either direction, at the end of a slip: stick or reversal;
  /// - the resistance to sliding, at the end of a slip with zero velocity: stop or only deceleration;
  /// - the holding level, at each maximum of q / level during a rest: the slider stays;
  /// - the holding level, at the next such maximum after a breakaway, with x as at rest: the slider leaves.
  /// Comparisons with a level that is zero or infinite do not count, nor does the approach to a breakaway, during which
  /// the load passes through the level.
  double load = std::numeric_limits<double>::infinity();

  /// The smallest distance, relative to the distance of the stop from x = 0, by which a stop was missed or exceeded. At
  /// the end of a slip this is the remaining distance; at an impact with speed v under a decelerating load q, it is the
  /// distance v^2 / (2 (a - q)) that the slider would have continued, with the resistance a.
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

  /// The load without friction, and the factor on a level.
  struct Net {
    double load, weight;
  };
  Net net(const Load& now, double x) const noexcept {
    const double weight = std::max(now.normal, 0.0) / standard_gravity;
    return {now.load - slider_.stiffness() * (slider_.mounting().pendulum ? weight : 1) * x, weight};
  }
  /// The unused part of a level under a load in the given direction, relative to the level; infinite if it decides
  /// nothing.
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

  /// A slip ended, in a reversal or a stop.
  /// @param x       start of the slip [m]
  /// @param forced  whether a stop or a landing brought the velocity to zero
  void ended(const Event& e, double x, bool forced) {
    const Net now = net(history_.after(e.time), e.displacement);
    for (const Direction direction : {Direction::forward, Direction::backward})
      count(held(direction, e.displacement, now));
    if (forced || equal(e.displacement, x)) return;
    const Direction direction = e.displacement > x ? Direction::forward : Direction::backward;
    count(left_of(resist(law_at(slider_.law(), at_, now.weight), e.displacement, 0.0, direction), direction, now));
    count_impact(bounds_.room(direction, e.displacement), direction);
  }

  /// The maxima of load / level in both directions between two times, without the final one in the direction of the
  /// breakaway that follows, if any.
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

  /// The slider broke away, after a rest since a given time.
  void broke_away(double since, const Event& e) {
    const double x = e.displacement;
    const Net now = net(history_.after(e.time), x);
    const Direction direction = now.load > 0 ? Direction::forward : Direction::backward;
    if (since < e.time) rested(since, e.time, x, mode_of(direction));
    double least = infinite;  // unused part of the level
    history_.nodes(e.time, infinite, [&](const Load& load) {
      const Net then = net(load, x);
      // Where the normal force vanishes, the load exceeds the level by infinitely many times the level.
      const bool light = !(then.weight > 0) && sign(direction) * then.load > 0;
      const double left = light ? -infinite : held(direction, x, then);
      if (!(left <= least)) return false;
      least = left;
      return true;
    });
    count(least);
  }

  /// @param x  start of the slip [m]
  void hit(const Event& e, double x) {
    const Direction direction = !equal(e.velocity, 0) ? (e.velocity > 0 ? Direction::forward : Direction::backward)
                                : e.displacement >= x ? Direction::forward
                                                      : Direction::backward;
    const Net now = net(history_.after(e.time), e.displacement);
    const double speed = std::abs(e.velocity);
    const double slows = resist(law_at(slider_.law(), at_, now.weight), e.displacement, speed, direction) * now.weight -
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

/// The margins of the closest decisions of a response.
/// @param slider    the slider
/// @param motion    its ground motion
/// @param response  the result of `integrate` for them
/// If the level depends on a temperature, the temperature is linear between samples, and constant during a rest, as at
/// its end. A velocity that almost reaches zero without an event does not count, nor does a landing. Cost: one pass
/// over events and samples.
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
