// A structure with one sliding interface during one segment, as a sliding system.
#pragma once

#include <cmath>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>

#include "stickslip/base/equal.hpp"
#include "stickslip/base/error.hpp"
#include "stickslip/base/min_max.hpp"
#include "stickslip/friction/law.hpp"
#include "stickslip/numerics/root.hpp"
#include "stickslip/run/detail/loop.hpp"
#include "stickslip/run/detail/system.hpp"
#include "stickslip/sliding/detail/bounds.hpp"
#include "stickslip/sliding/detail/load.hpp"
#include "stickslip/state/state.hpp"
#include "structure/expansion.hpp"
#include "structure/law_expansion.hpp"

namespace stickslip::detail {

class LinearMove;

/// Where and how fast the interface is at an event.
struct InterfacePlace {
  InterfacePlace(double x, double v) noexcept : displacement(x), velocity(v) {}
  InterfacePlace(const StructureState& state) noexcept : InterfacePlace(state.displacement, state.velocity) {}

  double displacement, velocity;
};

/// A slip in one direction, over one expansion.
struct InterfaceSlide {
  double direction;  // sign
  const Expansion& motion;
  double stop;  // [s]

  struct Leg {
    double time;      // [s]
    double part;      // of the duration of the expansion
    double distance;  // [m]
    double speed;     // [m/s]
  };
  Leg until(double time) const { return until_part(time / motion.duration()); }
  Leg whole() const { return until_part(1); }
  Leg until_part(double u) const {
    return {equal(u, 1) ? motion.duration() : u * motion.duration(), u, motion.distance(direction, u),
            motion.speed(direction, u)};
  }
};

struct InterfacePassage {
  bool passes = false, changes_law = false;
  double room = 0;  // [m]
  InterfaceSlide::Leg leg{};
};

/// Receives a motion while it is computed. Times are measured from the beginning of the segment [s].
class StructureSink {
 public:
  virtual void event(EventKind kind, double time, const InterfacePlace& place) = 0;
  /// After each expansion, whose duration is over.
  virtual void follow(const Expansion& motion, Mode mode) = 0;
  /// A whole segment without an event.
  /// @param from   the state at its start
  /// @param level  of the friction while it slides [m/s^2]
  /// @return whether that is all that must be known of it; otherwise it is expanded
  virtual bool pass(const LinearMove& /*move*/, const StructureState& /*from*/, double /*level*/) { return true; }
  /// Energy lost in an impact [J].
  virtual void lose(double /*energy*/) {}
  /// The distance of a demand from a level where the velocity is zero [m/s^2].
  virtual void decide(double /*difference*/) {}

 protected:
  ~StructureSink() = default;
};

/// A structure with one sliding interface during one segment (a SlidingSystem).
template <FrictionLaw Law>
class StructureMotion {
 public:
  static constexpr int most_steps = 3'000'000;

  StructureMotion(const ModalInterface& of, const Law& law, const GroundLoad& ground, StructureState& state,
                  LawExpansion<Law>& motion, StructureSink& observer)
      : of_(of),
        law_(law),
        ground_(ground),
        state_(state),
        motion_(motion),
        observer_(observer),
        limits_(of.stops, of.one_way),
        left_(ground.duration) {
    demand_ = demand_now();
  }

  double left() const noexcept { return left_; }
  /// While an arrest has not been shown yet, its time: a search for the next slip moves through the segment.
  double elapsed() const noexcept { return ground_.duration - (has_stopped() ? stopped_left_ : left_); }
  InterfacePlace state() const noexcept { return state_; }
  InterfacePlace resting_state() const noexcept { return {state_.displacement, 0}; }
  bool at_rest() const noexcept { return state_.mode == Mode::stuck; }
  bool has_stopped() const noexcept { return stopped_ != Mode::stuck; }

  /// Moves through the segment until the demand exceeds a level.
  Departure departure() {
    stopped_left_ = left_;
    const double forward_level = holds(Direction::forward), backward_level = holds(Direction::backward);
    double forward = weigh(ground_.weight(left_), forward_level);
    double backward = weigh(ground_.weight(left_), backward_level);
    if (has_stopped()) {
      observer_.decide(std::min(std::abs(demand_ - forward), std::abs(demand_ + backward)));
      // A slip decelerates as it stops, so any excess of the demand over the level is round-off, unless the speed only
      // touched zero.
      const double tolerance = instant_ ? never : 0x1p-44 * size_of_demand();
      if (stopped_ == Mode::forward && demand_ - forward <= tolerance)
        demand_ = std::min(demand_, forward);
      else if (stopped_ == Mode::backward && -demand_ - backward <= tolerance)
        demand_ = std::max(demand_, -backward);
    }
    if (demand_ > forward) return {Mode::forward, 0, demand_};
    if (demand_ < -backward) return {Mode::backward, 0, demand_};
    double waited = 0;
    while (left_ > 0) {
      motion_.stand(state_, ground_, left_, demand_);
      const double up = exit(1, forward_level), down = exit(-1, backward_level), part = std::min(up, down);
      // At the end of the expansion what follows decides: a level may vanish there with its weight.
      if (part < 1 - 0x1p-48) {
        const Mode mode = up < down ? Mode::forward : Mode::backward;
        waited += part * motion_.duration();
        finish(part);
        const double level = weigh(ground_.weight(left_), holds(direction_of(mode)));
        // Under round-off, time itself may not pass.
        return {mode, std::max(waited, std::numeric_limits<double>::min()), mode == Mode::forward ? level : -level};
      }
      waited += motion_.duration();
      finish(1);
      demand_ = demand_now();
    }
    return {};
  }

  Resumption depart(const Departure& departure) noexcept {
    state_.mode = departure.mode;
    demand_ = departure.net;
    const Mode stopped = std::exchange(stopped_, Mode::stuck);
    if (stopped == Mode::stuck || departure.delay > 0) return Resumption::from_rest;
    return stopped == departure.mode ? Resumption::onward : Resumption::reversed;
  }

  InterfaceSlide slide() {
    motion_.slide(state_, ground_, left_, demand_);
    const double s = static_cast<double>(static_cast<int>(state_.mode)), stop = motion_.first_stop(s);
    return {s, motion_, stop < never ? stop * motion_.duration() : never};
  }

  /// Until the velocity is zero, x is monotonic: it passes a bound, or a change of the law, if it ends beyond it.
  InterfacePassage passage(const InterfaceSlide& slide) {
    const Direction direction = direction_of(state_.mode);
    const double to_wall = limits_.room(direction, state_.displacement);
    double to_change = never;
    if constexpr (MemoryLaw<Law>) to_change = law_.ahead(memory(), direction);
    const double room = std::min(to_wall, to_change);
    if (!(room < never) && !limits_.has_struck()) return {};
    const double last = slide.stop < never ? slide.stop / motion_.duration() : 1;
    const double way = motion_.distance(slide.direction, last), beyond = way - room;
    if (!(beyond > 0)) {
      limits_.move(direction, way);
      return {};
    }
    const auto excess = [&](double u) { return motion_.distance(slide.direction, u) - room; };
    auto leg = slide.until_part(room > 0 ? numerics::root(excess, 0, -room, last, beyond) : 0);
    leg.distance = room;
    leg.speed = std::max(leg.speed, 0.0);
    return {true, to_change < to_wall, room, leg};
  }

  void show(const InterfaceSlide&, const InterfaceSlide::Leg& leg, StructureSink&) { finish_slip(leg); }

  /// To the place of a passage. @return whether the segment goes on
  bool pass(const InterfaceSlide& slide, const InterfacePassage& passage, StructureSink&) {
    const Direction direction = direction_of(state_.mode);
    state_.velocity = slide.direction * passage.leg.speed;
    if (passage.changes_law) {
      if constexpr (MemoryLaw<Law>) {
        State there = memory();
        law_.pass(there, direction);
        state_.displacement = there.displacement;
        remember(there, state_);
      }
      limits_.move(direction, passage.room);
      demand_ = demand_now();
      return left_ > 0;
    }
    slid(passage.room);
    state_.displacement = limits_.wall(direction);
    limits_.strike(direction);
    observer_.event(EventKind::impact, elapsed(), state());
    demand_ = demand_now();
    rebound(direction, passage.leg.speed);
    return left_ > 0 || state_.mode == Mode::stuck;
  }

  /// To the end of an expansion without a stop. @return whether the segment goes on
  bool proceed(const InterfaceSlide& slide, const InterfaceSlide::Leg& leg) {
    move(slide, leg);
    state_.velocity = slide.direction * std::max(leg.speed, 0.0);
    if (!(left_ > 0)) return false;
    demand_ = demand_now();
    // If the loads balance to the last digit, a slip too slow to change x would never end.
    if (std::abs(state_.velocity) < std::numeric_limits<double>::min() &&
        slide.direction * demand_ <= weigh(ground_.weight(left_), resistance())) {
      state_.velocity = 0;
      stopped_ = std::exchange(state_.mode, Mode::stuck);
      instant_ = false;
    }
    return true;
  }

  void stop(const InterfaceSlide& slide, const InterfaceSlide::Leg& leg) {
    move(slide, leg);
    state_.velocity = 0;
    instant_ = !(leg.part > 0);
    if (!instant_) demand_ = demand_now();
    stopped_ = std::exchange(state_.mode, Mode::stuck);
  }

  [[noreturn]] void stall() const {
    throw ConvergenceError(
        "advance: in a segment of " + shortest(ground_.duration) +
        " s the motion changes faster than its time can be resolved, at x = " + shortest(state_.displacement) +
        " m, x' = " + shortest(state_.velocity) + " m/s, " + shortest(left_) + " s before its end");
  }

 private:
  State memory() const { return interface_of(state_); }
  decltype(auto) law_now() const {
    if constexpr (MemoryLaw<Law>)
      return law_at(law_, memory(), weight_now());
    else
      return (law_);
  }
  void slid(double distance) {
    if constexpr (MemoryLaw<Law>) {
      State there = memory();
      stickslip::detail::slide(law_, there, std::max(distance, 0.0));
      remember(there, state_);
    }
  }
  double holds(Direction direction) const {
    return limits_.bound(direction, state_.displacement, hold(law_now(), state_.displacement, direction));
  }
  double resistance() const {
    return resist(law_now(), state_.displacement, std::abs(state_.velocity), direction_of(state_.mode));
  }
  double weight_now() const { return left_ > 0 ? ground_.weight(left_) : ground_.weight_end; }
  double ground_now() const { return left_ > 0 ? ground_.ground(left_) : ground_.end; }
  double pull() const { return of_.spring.under(weight_now()) * state_.displacement; }
  double demand_now() const { return of_.force_of_modes(state_) - of_.ground_demand * ground_now() - pull(); }
  double size_of_demand() const {
    return of_.size_of_force(state_) + std::abs(of_.ground_demand * ground_now()) + 2 * std::abs(pull());
  }

  // When the demand exceeds a level in a direction, as a part of the expansion.
  double exit(double s, double level) const {
    if (!(level < never)) return never;
    const Held held = motion_.held(level);
    const int order = motion_.order(), degree = std::max(order, held.degree);
    const double* q = motion_.demand();
    double change = 0, least = held.of[0];
    for (int k = 1; k <= order; ++k) change += std::abs(q[k]);
    for (int k = 1; k <= held.degree; ++k) least += std::min(held.of[static_cast<std::size_t>(k)], 0.0);
    if (least - s * q[0] > change) return never;
    Polynomial room{};
    for (int k = 0; k <= order; ++k) room[static_cast<std::size_t>(k)] = -s * q[k];
    room[0] = held.of[0] - s * q[0];
    for (int k = 1; k <= held.degree; ++k) room[static_cast<std::size_t>(k)] += held.of[static_cast<std::size_t>(k)];
    return first_zero(room.data(), degree);
  }

  // To a part of the expansion, the state of the interface aside.
  void finish(double part) {
    const bool whole = equal(part, 1), last = whole && equal(motion_.duration(), left_);
    motion_.restrict_to(part);
    motion_.end(state_);
    motion_.heat(state_.heat);
    observer_.follow(motion_, state_.mode);
    left_ = last ? 0 : pass_time(left_, motion_.duration());
  }
  void finish_slip(const InterfaceSlide::Leg& leg) { finish(leg.part); }
  void move(const InterfaceSlide& slide, const InterfaceSlide::Leg& leg) {
    state_.displacement += slide.direction * leg.distance;
    slid(leg.distance);
  }

  void rebound(Direction direction, double arrives) {
    const double s = sign(direction);
    const Direction back = opposite(direction);
    const double level_back = resist(law_now(), state_.displacement, 0.0, back);
    double speed = limits_.restitution() * arrives;
    if (!(limits_.bound(back, state_.displacement, level_back) < never)) speed = 0;
    // Skip infinitely many bounces if their total distance is below round-off and the demand is practically constant
    // meanwhile: the last impact takes all of the speed.
    const double q = s * demand_ / of_.mass;
    const double a = weigh(weight_now(), resist(law_now(), state_.displacement, 0.0, direction)) / of_.mass;
    if (speed > 0 && q > a && left_ > 0) {
      const Bounces bounces(speed, q, a, limits_.restitution());
      if (bounces.distance <= 0x1p-52 * std::abs(state_.displacement) && bounces.time * of_.fastest <= 0x1p-10 &&
          bounces.time <= 0x1p-10 * ground_.duration)
        speed = 0;
    }
    observer_.lose((arrives * arrives - speed * speed) * of_.mass / 2);
    const double change = -s * (speed + arrives);
    state_.velocity = speed > 0 ? -s * speed : 0;
    view(state_.modal_velocity) -= of_.jump * change;
    demand_ = demand_now();
    state_.mode = speed > 0 ? mode_of(back) : Mode::stuck;
    stopped_ = speed > 0 ? Mode::stuck : mode_of(direction);
    instant_ = false;
  }

  const ModalInterface& of_;
  const Law& law_;
  GroundLoad ground_;
  StructureState& state_;
  LawExpansion<Law>& motion_;
  StructureSink& observer_;
  Bounds limits_;
  double left_;                 // time to the end of the segment [s]
  double demand_;               // q [m/s^2]
  Mode stopped_ = Mode::stuck;  // the mode of a slip that has just stopped,
  bool instant_ = false;        // whether it took no time,
  double stopped_left_ = 0;     // and the time to the end of the segment then [s]
};

}  // namespace stickslip::detail
