// Margins of the decisions in a response: stick or slip, impact or not.
#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "stickslip/base/equal.hpp"
#include "stickslip/base/min_max.hpp"
#include "stickslip/base/units.hpp"
#include "stickslip/flow/closed_form.hpp"
#include "stickslip/ground/motion.hpp"
#include "stickslip/sliding/detail/bounds.hpp"
#include "stickslip/sliding/detail/recall.hpp"
#include "stickslip/sliding/response.hpp"
#include "stickslip/sliding/trajectory.hpp"
#include "stickslip/state/state.hpp"

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

/// Reads the margins of a response.
class MarginReader final : public TrajectoryReader {
 public:
  explicit MarginReader(const Trajectory& trajectory)
      : trajectory_(trajectory),
        bounds_{trajectory.mounting().stops, trajectory.mounting().one_way},
        from_(trajectory.response().displacement.front()),
        constant_(trajectory.has_constant_level()),
        holds_{trajectory.hold(State(), 1, Direction::forward), trajectory.hold(State(), 1, Direction::backward)} {}

  void arc(const Arc& arc) override {
    if (!arc.rests() && departures_.empty()) {
      rested_ = went_on_ = false;
      return;
    }
    const auto pass = [&](double t, const Load& load) {
      if (!departures_.empty()) std::erase_if(departures_, [&](Departed& one) { return passes(one, load); });
      if (!arc.rests()) return;
      const auto approach_at = [&](const State& at) {
        for (Approach& one : approaches_) approach(one, at, load);
      };
      if (arc.changes())
        approach_at(arc.at(t));
      else  // no copy
        approach_at(arc.start);
    };
    // An arc that goes on where the last one ended, under the same load, has no new beginning.
    const Load begins = arc.load(0), ends = arc.load(arc.duration);
    if (!(went_on_ && rested_ == arc.rests() && equal(begins.load, ended_.load) && equal(begins.normal, ended_.normal)))
      pass(0, begins);
    pass(arc.duration, ends);
    went_on_ = true;
    ended_ = ends;
    rested_ = arc.rests();
  }

  void event(EventKind kind, double time, const State& at, const Load& load) override {
    const bool at_once = last_ && equal(last_->time, time);
    went_on_ = false;
    switch (kind) {
      case EventKind::breakaway:
        if (equal(at.velocity, 0) && !at.in_flight) broke_away(at, load);
        break;
      case EventKind::reversal:
      case EventKind::arrest:
        if (!at.in_flight) ended(at, load, at_once && last_->kind != EventKind::reversal);
        break;
      case EventKind::impact:
        hit(at, load);
        break;
      case EventKind::end:
        for (Departed& one : departures_)
          if (!passes(one, still())) count(one.least);
        if (rested_) leave(Mode::stuck);
        break;
      case EventKind::liftoff:
      case EventKind::landing:
        break;
    }
    if (kind != EventKind::liftoff && kind != EventKind::landing) {
      approaches_ = none();
      rested_ = false;
    }
    from_ = at.displacement;
    last_ = {time, at.displacement, at.velocity, kind};
  }

  Margins margins;

 private:
  static constexpr double infinite = std::numeric_limits<double>::infinity();

  /// The unused part of the level, relative to it, in a direction during a rest.
  struct Approach {
    Direction direction;
    double last;
    bool falls;
  };

  static constexpr std::array<Approach, 2> none() noexcept {
    return {{{Direction::forward, infinite, true}, {Direction::backward, infinite, true}}};
  }

  /// A slider that broke away, as if it still rested.
  struct Departed {
    State state;
    Direction direction;
    double least = infinite;  // unused part of the level
  };

  /// The load without friction, and the factor on a level.
  struct Net {
    double load, weight;
  };
  Net net(const Load& now, double x) const noexcept {
    const double weight = std::max(now.normal, 0.0) / standard_gravity;
    return {now.load - trajectory_.pull(x, weight), weight};
  }
  /// The unused part of a level under a load in the given direction, relative to the level; infinite if it decides
  /// nothing.
  static double left_of(double level, Direction direction, const Net& net) noexcept {
    const double weighed = level < infinite ? level * net.weight : infinite;
    return weighed > 0 && weighed < infinite ? 1 - sign(direction) * net.load / weighed : infinite;
  }
  double held(Direction direction, const State& at, const Net& net) const {
    const double holds =
        constant_ ? holds_[direction == Direction::forward ? 0 : 1] : trajectory_.hold(at, net.weight, direction);
    return left_of(bounds_.bound(direction, at.displacement, holds), direction, net);
  }

  /// After the ground motion.
  Load still() const noexcept {
    return {trajectory_.downhill(), standard_gravity * std::cos(trajectory_.mounting().slope())};
  }

  void count(double left) noexcept { margins.load = std::min(margins.load, std::abs(left)); }
  void count_impact(double way, Direction direction) noexcept {
    const double distance = std::abs(bounds_.wall(direction));
    if (distance < infinite) margins.impact = std::min(margins.impact, std::abs(way) / distance);
  }

  /// A slip ended, in a reversal or a stop.
  /// @param forced  whether a stop or a landing brought the velocity to zero
  void ended(const State& at, const Load& load, bool forced) {
    const double x = at.displacement;
    const Net now = net(load, x);
    for (const Direction direction : {Direction::forward, Direction::backward}) count(held(direction, at, now));
    if (forced || equal(x, from_)) return;
    const Direction direction = x > from_ ? Direction::forward : Direction::backward;
    count(left_of(trajectory_.resist(at, now.weight, direction), direction, now));
    count_impact(bounds_.room(direction, x), direction);
  }

  /// During a rest: the maxima of load / level.
  void approach(Approach& one, const State& at, const Load& load) {
    const double left = held(one.direction, at, net(load, at.displacement));
    const bool rises = left > one.last;
    // Without a branch, which no processor would foresee.
    constexpr double unless[] = {infinite, 0};
    count(std::abs(one.last) + unless[rises & one.falls]);
    one.falls = (left < one.last) | (one.falls & !rises);
    one.last = left;
  }
  /// The rest ends: the final approach counts, but not that to the breakaway.
  void leave(Mode mode) {
    for (const Approach& one : approaches_)
      if (one.falls && mode != mode_of(one.direction)) count(one.last);
  }

  void broke_away(const State& at, const Load& load) {
    const Direction direction = net(load, at.displacement).load > 0 ? Direction::forward : Direction::backward;
    if (rested_) leave(mode_of(direction));
    departures_.push_back({at, direction});
  }
  /// Whether the load of a slider that broke away passes its maximum.
  bool passes(Departed& one, const Load& load) {
    const Net now = net(load, one.state.displacement);
    // Where the normal force vanishes, the load exceeds the level by infinitely many times the level.
    const bool light = !(now.weight > 0) && sign(one.direction) * now.load > 0;
    const double left = light ? -infinite : held(one.direction, one.state, now);
    if (left <= one.least) {
      one.least = left;
      return false;
    }
    count(one.least);
    return true;
  }

  void hit(const State& at, const Load& load) {
    const Direction direction = !equal(at.velocity, 0) ? (at.velocity > 0 ? Direction::forward : Direction::backward)
                                : at.displacement >= from_ ? Direction::forward
                                                           : Direction::backward;
    const Net now = net(load, at.displacement);
    const double slows = trajectory_.resist(at, now.weight, direction) * now.weight - sign(direction) * now.load;
    if (slows > 0) count_impact(at.velocity * at.velocity / (2 * slows), direction);
  }

  const Trajectory& trajectory_;
  Bounds bounds_;
  std::array<Approach, 2> approaches_ = none();
  bool rested_ = false;               // during the last arc
  bool went_on_ = false;              // without an event since
  Load ended_{};                      // its load
  std::vector<Departed> departures_;  // whose loads still grow
  double from_;                       // x at the last event [m]
  bool constant_;                     // the levels
  double holds_[2];                   // if they are constant, those at rest, forward and backward [m/s^2]
  std::optional<Event> last_;
};

}  // namespace detail

/// The margins of the closest decisions of a response.
/// @param trajectory  of the response
/// A velocity that almost reaches zero without an event does not count, nor does a landing. Cost: about that of
/// `integrate`.
inline Margins margins(const Trajectory& trajectory) {
  detail::MarginReader reader(trajectory);
  // A motion integrated again may arrive at its final rest a few digits later.
  const double end = trajectory.end(), late = 0x1p-46 * std::abs(end);
  const bool settled = end > trajectory.time(trajectory.samples() - 1);
  detail::read_ends(trajectory, reader, settled ? end + late : end);
  return reader.margins;
}

/// The same of a slider, or a law alone, under a ground motion.
template <class Slider, Motion M>
Margins margins(const Slider& slider, const M& motion, const Response& response) {
  return margins(*trajectory(slider, motion, response));
}

}  // namespace stickslip
