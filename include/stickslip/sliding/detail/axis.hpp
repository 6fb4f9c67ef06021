// A slider on one axis, as a sliding system.
#pragma once

#include <cmath>
#include <concepts>
#include <limits>
#include <utility>

#include "stickslip/base/equal.hpp"
#include "stickslip/base/error.hpp"
#include "stickslip/base/min_max.hpp"
#include "stickslip/flow/closed_form.hpp"
#include "stickslip/flow/detail/maker.hpp"
#include "stickslip/friction/law.hpp"
#include "stickslip/numerics/root.hpp"
#include "stickslip/run/detail/loop.hpp"
#include "stickslip/run/detail/system.hpp"
#include "stickslip/sliding/detail/bounds.hpp"
#include "stickslip/sliding/detail/load.hpp"
#include "stickslip/sliding/detail/one_step.hpp"
#include "stickslip/sliding/observer.hpp"
#include "stickslip/state/state.hpp"

namespace stickslip::detail {

/// A slip in one direction from the present state on.
template <class SlipStart, class Flow>
struct AxisSlide {
  Direction direction;
  double load;  ///< of the ground, at the start [m/s^2]
  double left;  ///< time to the end of the segment [s]
  SlipStart start;
  Flow flow;
  double stop = flow.first_stop();  ///< [s]

  Leg until(double time) const { return {time, flow.at(time), start.gain_within(time, left)}; }
  /// Until the flow ends.
  Leg whole() const {
    const double time = flow.horizon();
    return {time, flow.at_horizon(), start.gain_within(time, left)};
  }
};

/// The way of a slip to a bound, or to a change of its law.
struct AxisPassage {
  bool passes = false;
  bool changes_law = false;
  double room = 0;  ///< [m]
  Leg leg{};
};

/// A slider on one axis during one segment (a SlidingSystem).
/// @tparam Flows   a FlowMaker: law, spring and damper
/// @tparam Place   its State, or BareState without the memory of a law
/// @tparam Limits  Bounds or Unbounded
template <class Flows, SegmentLoad Forces, class Place, class Limits>
class Axis {
 public:
  static constexpr int most_steps = Flows::most_steps;

  [[gnu::always_inline]] Axis(const Flows& flows, const Forces& forces, Place& state, const Limits& limits)
      : flows_(flows), forces_(forces), state_(state), limits_(limits), left_(forces.duration) {
    net_ = forces.first() - pull();
  }

  double left() const noexcept { return left_; }
  double elapsed() const noexcept { return forces_.duration - left_; }
  State state() const noexcept { return State(state_); }
  State resting_state() const noexcept {
    State at{.displacement = state_.displacement};
    if constexpr (requires { state_.sliding_distance; }) at.sliding_distance = state_.sliding_distance;
    return at;
  }
  bool at_rest() const noexcept { return state_.mode == Mode::stuck; }
  bool has_stopped() const noexcept { return stopped_ != Mode::stuck; }

  /// A slip begins when the load exceeds the holding level, at once or later in this segment. A load equal to the level
  /// is held.
  [[gnu::always_inline]] Departure departure() {
    const auto holds = [&](Direction direction) {
      return limits_.bound(direction, state_.displacement, hold(law_now(), state_.displacement, direction));
    };
    const double holds_forward = holds(Direction::forward), holds_backward = holds(Direction::backward);
    const double forward = weigh(holds_forward), backward = weigh(holds_backward);
    // A slip decelerates as it stops, so any excess of the load over the level is round-off, unless the speed only
    // touched zero.
    if (stopped_ != Mode::stuck) {
      const double tolerance = instant_ ? never : 0x1p-44 * (std::abs(net_) + 2 * std::abs(pull()));
      if (stopped_ == Mode::forward && net_ - forward <= tolerance)
        net_ = std::min(net_, forward);
      else if (stopped_ == Mode::backward && -net_ - backward <= tolerance)
        net_ = std::max(net_, -backward);
    }
    if (net_ > forward) return {Mode::forward, 0, net_, beyond(Direction::forward, net_ - forward)};
    if (net_ < -backward) return {Mode::backward, 0, net_, beyond(Direction::backward, -net_ - backward)};
    if (!(left_ > 0)) return {};
    const double pull_at_end = flows_.pull(state_.displacement, forces_.weight(0));
    return flows_.departure(forces_, limits_, state_, net_, pull_at_end, holds_forward, holds_backward, left_);
  }

  Resumption depart(const Departure& departure) noexcept {
    state_.mode = departure.mode;
    left_ -= departure.delay;
    net_ = departure.net;
    departs_ = true;
    acceleration_ = departure.acceleration;
    rise_ = departure.rise;
    const Mode stopped = std::exchange(stopped_, Mode::stuck);
    if (stopped == Mode::stuck) return Resumption::from_rest;
    return stopped == departure.mode || limits_.at_struck_wall() ? Resumption::onward : Resumption::reversed;
  }

  [[gnu::always_inline]] auto slide() {
    const Direction direction = direction_of(state_.mode);
    const double load = net_ + pull(), speed = std::abs(state_.velocity);
    const double begins = std::exchange(departs_, false) ? acceleration_ : acceleration(direction);
    const auto start = forces_.slip(sign(direction), speed, begins, std::exchange(rise_, 0.0), load, left_, [&] {
      return resist(law_toward(direction), state_.displacement, speed, direction);
    });
    using Slide =
        AxisSlide<std::remove_const_t<decltype(start)>, decltype(flows_.flow(direction, state_, start, left_))>;
    return Slide{direction, load, left_, start, flows_.flow(direction, state_, start, left_)};
  }

  /// Until the velocity is zero, x is monotonic: it passes a bound, or a change of the law, if it ends beyond it.
  template <class Slide>
  [[gnu::always_inline]] AxisPassage passage(const Slide& slide) {
    const double to_wall = limits_.room(slide.direction, state_.displacement);
    const double to_change = flows_.ahead(state_, slide.direction), room = std::min(to_wall, to_change);
    if (!(room < never) && !limits_.has_struck()) return {};
    const auto& flow = slide.flow;
    const double most = slide.stop < never ? slide.stop : flow.horizon();
    const double way = (slide.stop < never ? flow.at(slide.stop) : flow.at_horizon()).distance, beyond = way - room;
    if (!(beyond > 0)) {
      limits_.move(slide.direction, way);
      return {};
    }
    const auto excess = [&](double t) { return flow.at(t).distance - room; };
    Leg leg = slide.until(room > 0 ? numerics::root(excess, 0, -room, most, beyond) : 0);
    leg.end.distance = room;
    leg.end.speed = std::max(leg.end.speed, 0.0);
    return {true, to_change < to_wall, room, leg};
  }

  template <class Slide, MotionObserver Observer>
  [[gnu::always_inline]] void show(const Slide& slide, const Leg& leg, Observer& observer) {
    if constexpr (requires { observer.follow(slide.flow, leg.time); }) observer.follow(slide.flow, leg.time);
    flows_.remember(slide.flow, leg.time, state_);
    if constexpr (EnergyObserver<Observer>)
      if (counts_energy(observer)) observer.dissipate(flows_.friction_work(slide, leg, state_));
    const double s = sign(slide.direction);
    observer.slide(Slip{slide.direction, state_.displacement, leg.end.distance, leg.time,
                        slide.start.work(slide.flow, s * slide.load, leg.gain, leg.time, leg.end)});
  }

  /// To the place of a passage. @return whether the segment goes on
  template <class Slide, MotionObserver Observer>
  [[gnu::always_inline]] bool pass(const Slide& slide, const AxisPassage& passage, Observer& observer) {
    const double s = sign(slide.direction);
    left_ -= passage.leg.time;
    state_.velocity = s * passage.leg.end.speed;
    if (passage.changes_law) {
      flows_.pass(state_, slide.direction);
      limits_.move(slide.direction, passage.room);
      if (!(left_ > 0)) return false;
      net_ = net_of(slide);
      return true;
    }
    flows_.slid(state_, passage.room);
    state_.displacement = limits_.wall(slide.direction);
    limits_.strike(slide.direction);
    observer.event(EventKind::impact, elapsed(), state());
    net_ = net_of(slide);
    return rebound(slide, passage.leg.end.speed, observer);
  }

  /// To the end of a flow that does not stop. @return whether the segment goes on
  template <class Slide>
  [[gnu::always_inline]] bool proceed(const Slide& slide, const Leg& leg) {
    const double s = sign(slide.direction);
    state_.displacement += s * leg.end.distance;
    flows_.slid(state_, leg.end.distance);
    state_.velocity = s * std::max(leg.end.speed, 0.0);
    if (equal(leg.time, left_)) return false;
    left_ = pass_time(left_, leg.time);
    net_ = slide.load + s * leg.gain - pull();
    // If the loads balance to the last digit, a slip too slow to change x would never end.
    if (std::abs(state_.velocity) < std::numeric_limits<double>::min() && acceleration(slide.direction) <= 0) {
      state_.velocity = 0;
      stopped_ = std::exchange(state_.mode, Mode::stuck);
      instant_ = false;
    }
    return true;
  }

  template <class Slide>
  [[gnu::always_inline]] void stop(const Slide& slide, const Leg& leg) {
    const double s = sign(slide.direction);
    state_.displacement += s * leg.end.distance;
    flows_.slid(state_, leg.end.distance);
    state_.velocity = 0;
    stopped_ = std::exchange(state_.mode, Mode::stuck);
    instant_ = !(left_ - leg.time < left_);
    left_ = pass_time(left_, leg.time);
    net_ = slide.load + s * leg.gain - pull();
  }

  [[noreturn]] void stall() const { refuse(forces_.duration, left_, state_.displacement, state_.velocity); }

 private:
  decltype(auto) law_now() const { return flows_.law_now(state_, forces_.weight(left_)); }
  decltype(auto) law_toward(Direction direction) const {
    return flows_.law_toward(direction, state_, forces_.weight(left_));
  }
  double weigh(double level) const { return Forces::weigh(forces_.weight(left_), level); }
  double pull() const { return flows_.pull(state_.displacement, forces_.weight(left_)); }

  // Net acceleration of a slip that begins under more load than is held, by an excess: at least that excess.
  double beyond(Direction direction, double excess) const {
    if constexpr (LawWithHold<std::remove_cvref_t<decltype(law_now())>>)
      return std::max(sign(direction) * net_ - weigh(resist(law_now(), state_.displacement, 0.0, direction)), excess);
    else
      return excess;
  }

  // Net acceleration in the direction of sliding.
  double acceleration(Direction direction) const {
    const double speed = std::abs(state_.velocity);
    return sign(direction) * net_ - weigh(resist(law_toward(direction), state_.displacement, speed, direction)) -
           flows_.drag(speed);
  }

  // The net load now, after a part of a slide.
  template <class Slide>
  double net_of(const Slide& slide) const {
    return slide.load + sign(slide.direction) * slide.start.gain_within(slide.left - left_, slide.left) - pull();
  }

  // After an impact at a speed. @return whether the segment goes on
  template <class Slide, MotionObserver Observer>
  [[gnu::always_inline]] bool rebound(const Slide& slide, double arrives, Observer& observer) {
    const double s = sign(slide.direction);
    const Direction back = opposite(slide.direction);
    double speed = limits_.restitution() * arrives;
    if (!(limits_.bound(back, state_.displacement, resist(law_now(), state_.displacement, speed, back)) < never))
      speed = 0;
    // Skip infinitely many bounces if their total distance is below round-off and the load is practically constant
    // meanwhile.
    // Levels that differ are their mean about a shifted load.
    const double toward = weigh(resist(law_now(), state_.displacement, speed, slide.direction));
    const double away = weigh(resist(law_now(), state_.displacement, speed, back));
    const double q = s * net_ - (toward - away) / 2, a = (toward + away) / 2;
    if (speed > 0 && q > a && left_ > 0) {
      const Bounces bounces(speed, q, a, limits_.restitution());
      const double changes = std::abs(slide.start.gain_within(slide.left, slide.left));
      if (bounces.distance <= 0x1p-52 * std::abs(state_.displacement) &&
          changes * (bounces.time / slide.left) <= (q - a) / 1024) {
        left_ -= std::min(bounces.time, left_);
        net_ = net_of(slide);
        speed = 0;
      }
    }
    if constexpr (EnergyObserver<Observer>) observer.lose((arrives * arrives - speed * speed) / 2);
    state_.velocity = -s * speed;
    state_.mode = speed > 0 ? mode_of(back) : Mode::stuck;
    stopped_ = speed > 0 ? Mode::stuck : mode_of(slide.direction);
    instant_ = false;
    return left_ > 0 || !(speed > 0);
  }

  // Takes its arguments by value: with a reference to the state, the event loop would keep the state in memory.
  [[noreturn, gnu::noinline]] static void refuse(double duration, double left, double x, double v) {
    throw ConvergenceError(
        "advance: in a segment of " + shortest(duration) +
        " s the motion changes faster than its time can be resolved, at x = " + shortest(x) +
        " m, x' = " + shortest(v) + " m/s, " + shortest(left) +
        " s before its end: the spring or damper is too stiff, or the acceleration or the slip level too large, for a "
        "segment this long");
  }

  const Flows& flows_;
  Forces forces_;
  Place& state_;
  Limits limits_;
  double left_;                 // time to the end of the segment [s]
  double net_;                  // all forces but friction [m/s^2]
  Mode stopped_ = Mode::stuck;  // the mode of a slip that has just stopped,
  bool instant_ = false;        // and whether it took no time
  bool departs_ = false;        // whether the next slip begins from rest,
  double acceleration_ = 0;     // with this acceleration [m/s^2]
  double rise_ = 0;             // Departure::rise [m/s^2]
};

/// Integrate a slider over a segment of any load.
template <FlowMaker Flows, class Segment, class Place, MotionObserver Observer, class Limits = Unbounded>
[[gnu::always_inline]] inline void advance(const Flows& flows, const Segment& segment, Place& state, Observer& observer,
                                           const Limits& limits = {}) {
  const auto& forces = load_of(segment);
  if (!(forces.duration > 0)) return;
  if constexpr (!Limits::bounded && std::same_as<std::remove_cvref_t<decltype(forces)>, LinearLoad> &&
                FlowsOnSprings<Flows>)
    if (pass_in_one_step(flows, forces, limits, state, observer)) return;
  Axis<Flows, std::remove_cvref_t<decltype(forces)>, Place, Limits> slider(flows, forces, state, limits);
  advance(slider, observer);
}

}  // namespace stickslip::detail
