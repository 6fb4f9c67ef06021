// A rigid block that rocks, slides and flies, as a sliding system: the event loop asks it what it asks a slider.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>

#include "rocking/rigid_impact.hpp"
#include "rocking/rigid_leg.hpp"
#include "stickslip/base/equal.hpp"
#include "stickslip/base/error.hpp"
#include "stickslip/base/units.hpp"
#include "stickslip/flow/closed_form.hpp"
#include "stickslip/rocking/response.hpp"
#include "stickslip/rocking/rocking_block.hpp"
#include "stickslip/rocking/state.hpp"
#include "stickslip/run/detail/loop.hpp"
#include "stickslip/run/detail/system.hpp"

namespace stickslip::detail {

inline Arm arm(const RockingBlock& block, const RockingState& state) noexcept {
  return arm(block, sign(state.mode), state.rotation);
}
/// The velocities of the center of mass and the rotation.
inline RigidVelocity velocity(const RockingBlock& block, const RockingState& state) noexcept {
  if (!on_corner(state.mode)) return {state.velocity, state.climb, state.rate};
  const Arm r = arm(block, state);
  return {state.velocity - state.rate * r.y, state.rate * r.x, state.rate};
}
/// The center of mass above its height at rest [m].
inline double rise(const RockingBlock& block, const RockingState& state) noexcept {
  if (!on_corner(state.mode)) return state.rise;
  const double half = std::sin(state.rotation / 2);
  return corner(block, sign(state.mode)) * std::sin(state.rotation) - 2 * block.center_height() * half * half;
}
/// The displacement of the center of mass [m].
inline double center_displacement(const RockingBlock& block, const RockingState& state) noexcept {
  if (!on_corner(state.mode)) return state.displacement;
  const double half = std::sin(state.rotation / 2);
  return state.displacement + 2 * corner(block, sign(state.mode)) * half * half +
         block.center_height() * std::sin(state.rotation);
}
/// The displacement of the middle of the base [m].
inline double base_displacement(const RockingBlock& block, const RockingState& state) noexcept {
  const double half = std::sin(state.rotation / 2), lost = 2 * half * half;
  if (on_corner(state.mode)) return state.displacement + sign(state.mode) * (block.width() / 2) * lost;
  return state.displacement - (block.right() - block.left()) / 2 * lost -
         block.center_height() * std::sin(state.rotation);
}

/// Receives the motion of a rigid block while it is computed. Times are since the beginning of the segment [s].
class RigidSink {
 public:
  virtual void follow(const RigidLeg& leg, double begin, double duration, const RigidLeg::Place& end) = 0;
  /// Of the event loop: `breakaway` and `reversal` out of rest, `arrest`.
  virtual void event(EventKind kind, double time, const RockingState& state) = 0;
  /// @param speed  at which a corner arrived [m/s]
  /// @param after  theta' after it [rad/s]
  virtual void happens(RockingEventKind /*kind*/, double /*time*/, const RockingState&, double /*side*/,
                       double /*speed*/, double /*after*/) {}
  /// Energy lost in an impact, per unit mass [m^2/s^2].
  virtual void lose(double /*energy*/) {}
  /// The same in the fall on its side.
  virtual void fall(double /*energy*/) {}
  /// An impact in which the given restitution could not hold.
  virtual void slipped() {}

 protected:
  ~RigidSink() = default;
};

struct RigidDeparture {
  enum class Which { none, right, left, ahead, back, up };
  Which which = Which::none;
  double delay = 0;
  bool beyond = false;  // the load lies beyond the level already
  bool departs() const noexcept { return which != Which::none; }
};

struct RigidSlide {
  RigidLeg leg;
  RigidLeg::Next next = leg.next();
  double stop = never;  // stops are passages

  struct Leg {
    double time;
    RigidLeg::Place end;
  };
  Leg whole() const noexcept { return {leg.duration(), leg.at(leg.duration())}; }
  Leg until(double t) const noexcept { return {t, leg.at(t)}; }
};

struct RigidPassage {
  bool passes = false;
  RigidSlide::Leg leg{};
};

/// A rigid block during one segment (a SlidingSystem).
class RigidSystem {
 public:
  static constexpr int most_steps = 1'000'000;
  using Event = RigidLeg::Event;

  RigidSystem(const RockingBlock& block, const RockingSegment& ground, RockingState& state)
      : block_(block), ground_(ground), state_(state) {
    // Forces can jump where a segment begins.
    if (state_.mode == RockingMode::slide)
      on_base();
    else if (on_corner(state_.mode))
      on_one(state_.slip);
  }

  double left() const noexcept { return ground_.duration - now_; }
  double elapsed() const noexcept { return now_; }
  const RockingState& state() const noexcept { return state_; }
  const RockingState& resting_state() const noexcept { return state_; }
  bool at_rest() const noexcept { return state_.mode == RockingMode::rest; }
  bool has_stopped() const noexcept { return stopped_; }

  /// All margins are linear in time.
  RigidDeparture departure() const noexcept {
    using Which = RigidDeparture::Which;
    RigidDeparture first;
    double soonest = never;
    bool beyond = false;
    const double n = ground_.n(now_), heavy = ground_.heavy(now_), h = block_.center_height();
    const auto look = [&](Which which, double from, double to) {
      if (!(std::max(from, to) > 0)) return;
      const double delay = from >= 0 ? 0 : left() * (from / (from - to));
      if (delay < soonest) soonest = delay, first = {which, delay};
      beyond = beyond || from > 0;
    };
    const auto level = [&](Which which, double load, double load_end, double half, double per) {
      look(which, load * per - half * heavy, load_end * per - half * ground_.heavy_end);
    };
    if (block_.mu() < never) {
      level(Which::ahead, -n, -ground_.n_end, block_.mu(), 1);
      level(Which::back, n, ground_.n_end, block_.mu(), 1);
    }
    level(Which::right, -n, -ground_.n_end, block_.right(), h);
    level(Which::left, n, ground_.n_end, block_.left(), h);
    look(Which::up, -heavy, -ground_.heavy_end);
    first.beyond = beyond;
    return first;
  }

  /// What comes next follows from the margin that vanished: the forces, computed again, could differ by round-off.
  Resumption depart(const RigidDeparture& departure) {
    using Which = RigidDeparture::Which;
    now_ = std::min(now_ + departure.delay, ground_.duration);
    how_ = {};
    if (departure.beyond) {
      jump();
    } else {
      how_.smooth = true;
      switch (departure.which) {
        case Which::ahead:
        case Which::back:
          state_.slip = departure.which == Which::ahead ? 1 : -1;
          state_.mode = RockingMode::slide;
          break;
        case Which::right:
        case Which::left:
          state_.mode = departure.which == Which::right ? RockingMode::right : RockingMode::left;
          how_.known_turn = true;
          break;
        default:
          state_.mode = RockingMode::flight;
          how_.lifts = 2;
      }
    }
    return std::exchange(stopped_, false) && !(departure.delay > 0) ? Resumption::reversed : Resumption::from_rest;
  }

  RigidSlide slide() const { return {RigidLeg(block_, ground_, now_, state_, how_)}; }

  RigidPassage passage(const RigidSlide& slide) const {
    if (state_.overturned != 0 || !(slide.next.time < never)) return {};
    return {true, {slide.next.time, slide.leg.at(slide.next.time)}};
  }

  void show(const RigidSlide& slide, const RigidSlide::Leg& leg, RigidSink& sink) const {
    sink.follow(slide.leg, now_, leg.time, leg.end);
  }

  bool pass(const RigidSlide& slide, const RigidPassage& passage, RigidSink& sink) {
    go(passage.leg);
    switch (slide.next.event) {
      case Event::overturns:
        fall(sink);
        return false;
      case Event::lands:
        land(sink);
        break;
      case Event::sticks:
        stick(sink);
        break;
      case Event::slips_ahead:
      case Event::slips_back:
        state_.slip = slide.next.event == Event::slips_ahead ? 1 : -1;
        state_.velocity = 0;
        how_.smooth = true;
        watch(arm(block_, state_), state_.slip);
        sink.happens(RockingEventKind::slip, now_, state_, sign(state_.mode), 0, state_.rate);
        break;
      case Event::lets_go:
        how_.held = ground_.heavy(now_) + state_.rate * state_.rate * arm(block_, state_).y > 0;
        if (how_.held) break;
        [[fallthrough]];
      case Event::lifts: {
        const double side = state_.mode == RockingMode::slide ? 2 : sign(state_.mode);
        fly();
        how_.lifts = side;
        how_.smooth = slide.next.event == Event::lifts;
        sink.happens(RockingEventKind::liftoff, now_, state_, on_side(side), 0, state_.rate);
        break;
      }
      case Event::paradox:
        refuse();
      case Event::none:
        break;
    }
    return left() > 0;
  }

  bool proceed(const RigidSlide&, const RigidSlide::Leg& leg) {
    const bool ends = !(leg.time < left());
    go(leg);
    return !ends;
  }

  void stop(const RigidSlide&, const RigidSlide::Leg&) const noexcept {}

  [[noreturn]] void stall() const {
    throw ConvergenceError(
        "advance: in a segment of " + shortest(ground_.duration) +
        " s the block has events faster than its time can be resolved, at theta = " + shortest(state_.rotation) +
        " rad and theta' = " + shortest(state_.rate) + " rad/s, " + shortest(left()) + " s before its end");
  }

 private:
  static double on_side(double side) noexcept { return equal(side, 2) ? 0 : side; }

  void go(const RigidSlide::Leg& leg) noexcept {
    now_ = leg.time < left() ? ground_.duration - pass_time(left(), leg.time) : ground_.duration;
    state_.rotation = leg.end.rotation;
    state_.rate = leg.end.rate;
    state_.displacement = leg.end.displacement;
    state_.velocity = leg.end.velocity;
    state_.rise = leg.end.rise;
    state_.climb = leg.end.climb;
    how_ = {};
  }

  // It leaves the ground with the motion that it has.
  void fly() noexcept {
    const RigidVelocity v = velocity(block_, state_);
    const double x = center_displacement(block_, state_), y = detail::rise(block_, state_);
    state_.displacement = x;
    state_.velocity = v.x;
    state_.rise = y;
    state_.climb = v.y;
    state_.slip = 0;
    state_.mode = RockingMode::flight;
  }
  // It stands on a corner, with a displacement of the center of mass.
  void stand(double side) noexcept {
    const double half = std::sin(state_.rotation / 2);
    state_.displacement -= 2 * corner(block_, side) * half * half + block_.center_height() * std::sin(state_.rotation);
    state_.rise = state_.climb = 0;
    state_.mode = side > 0 ? RockingMode::right : RockingMode::left;
  }

  // Whether a block that slides on its base keeps it down: a condition on the block alone.
  double tips(int slip) const noexcept {
    const double moves = slip * block_.mu() * block_.center_height();
    return moves > block_.right() ? 1 : moves < -block_.left() ? -1 : 0;
  }

  // At rest, the load jumps beyond a level.
  void jump() {
    const double n = ground_.n(now_), heavy = ground_.heavy(now_);
    if (!(heavy > 0)) {
      fly();
      how_.lifts = 2;
      return;
    }
    const int slip = n < 0 ? 1 : -1;
    if (std::abs(n) > block_.mu() * heavy && equal(tips(slip), 0)) {
      state_.slip = static_cast<std::int8_t>(slip);
      state_.mode = RockingMode::slide;
      return;
    }
    state_.mode = slip > 0 ? RockingMode::right : RockingMode::left;
    on_one(0);
  }

  // On its base, with a velocity.
  void on_base() {
    how_ = {};
    if (ground_.heavy(now_) < 0) {
      fly();
      how_.lifts = 2;
    } else if (const double side = tips(state_.slip); !equal(side, 0)) {
      state_.mode = side > 0 ? RockingMode::right : RockingMode::left;
    } else {
      state_.mode = RockingMode::slide;
    }
  }

  void watch(const Arm& r, int slip) const {
    if (slip != 0 && !(slip_denominator(block_, r, slip) > 0)) refuse();
  }

  // On one corner, which slips or not: what the forces make of it.
  // @param slip  the direction in which it moves; 0 if it does not
  void on_one(int slip) {
    how_ = {};
    const Arm r = arm(block_, state_);
    const double w = state_.rate, n = ground_.n(now_), heavy = ground_.heavy(now_), mu = block_.mu();
    const double square = block_.gyration_square(), known = heavy + w * w * r.y;
    state_.slip = 0;
    if (slip == 0) {
      state_.velocity = 0;
      const double turn = (r.y * n - r.x * heavy) / (square + r.x * r.x + r.y * r.y);
      const double push = heavy + turn * r.x + w * w * r.y, across = n - turn * r.y + w * w * r.x;
      if (mu < never ? push > 0 && std::abs(across) <= mu * push : push > 0 || known > 0) return;
      if (mu < never)
        for (const int s : {across > 0 ? -1 : 1, across > 0 ? 1 : -1}) {
          const double weight = slip_denominator(block_, r, s), normal = known / weight, drag = -s * mu * normal;
          if (!(weight > 0)) refuse();
          if (!(normal > 0)) break;
          const double starts = -n + drag + r.y * (r.y * drag - r.x * normal) / square - w * w * r.x;
          if (s * starts < 0) continue;
          state_.slip = static_cast<std::int8_t>(s);
          return;
        }
    } else {
      watch(r, slip);
      if (known > 0) {
        state_.slip = static_cast<std::int8_t>(slip);
        return;
      }
    }
    const double side = sign(state_.mode);
    fly();
    how_.lifts = side;
  }

  void stick(RigidSink& sink) {
    const int before = state_.slip;
    state_.velocity = 0;
    state_.slip = 0;
    if (state_.mode == RockingMode::slide) {
      state_.mode = RockingMode::rest;
      stopped_ = true;
      return;
    }
    on_one(0);
    if (state_.slip == before) return;  // its velocity has merely touched zero
    sink.happens(state_.slip != 0 ? RockingEventKind::slip : RockingEventKind::stick, now_, state_, sign(state_.mode),
                 0, state_.rate);
  }

  void land(RigidSink& sink) {
    const bool flew = state_.mode == RockingMode::flight;
    const double before_side = sign(state_.mode);
    const bool flat = !flew || equal(state_.rotation, 0);
    if (!flew) state_.rotation = 0;
    const RigidVelocity v = velocity(block_, state_);
    if (!flew) state_.displacement = center_displacement(block_, state_);
    const double before = kinetic_energy(block_, v);
    const RockingState arrived = state_;
    RigidImpact impact;
    double speed, arrives;
    if (flat) {
      impact = base_impact(block_, v);
      const double right = -(v.y - v.w * corner(block_, 1)), left_side = -(v.y - v.w * corner(block_, -1));
      arrives = !flew ? -before_side : impact.side;
      speed = flew ? std::max(right, left_side) : before_side > 0 ? left_side : right;
    } else {
      arrives = state_.rotation > 0 ? 1 : -1;
      const Arm r = arm(block_, arrives, state_.rotation);
      speed = v.w * r.x - v.y;
      impact = corner_impact(block_, v, arrives, r);
      if (!impact.consistent) refuse();
    }
    const double arrived_at = now_;
    how_ = {};
    state_.rate = impact.after.w;
    state_.slip = static_cast<std::int8_t>(impact.slip);
    if (!equal(impact.side, 0) && flat && closes(impact, speed)) {
      impact.side = 0;
      impact.after = {impact.slip == 0 ? 0 : slipping(impact), 0, 0};
      state_.rate = 0;
    }
    sink.happens(flew ? RockingEventKind::landing : RockingEventKind::impact, arrived_at, arrived, arrives, speed,
                 impact.after.w);
    sink.lose(before - kinetic_energy(block_, impact.after));
    if (flat && !equal(impact.side, 0) && !impact.lever &&
        !equal(impact.side > 0 ? block_.lever_right() : block_.lever_left(), 1))
      sink.slipped();
    if (equal(impact.side, 0)) {
      state_.rise = state_.climb = 0;
      state_.rotation = 0;
      state_.velocity = impact.after.x;
      if (impact.slip == 0) {
        state_.mode = RockingMode::rest;
        stopped_ = true;
      } else {
        on_base();
      }
      return;
    }
    stand(impact.side);
    state_.velocity = impact.slip == 0 ? 0 : impact.after.x + impact.after.w * arm(block_, state_).y;
    on_one(impact.slip);
    if (state_.mode == RockingMode::flight) {
      sink.happens(RockingEventKind::liftoff, now_, state_, impact.side, 0, state_.rate);
      return;
    }
    const bool slid = arrived.slip != 0, slides = state_.slip != 0;
    if (slid != slides)
      sink.happens(slides ? RockingEventKind::slip : RockingEventKind::stick, now_, state_, impact.side, 0,
                   state_.rate);
  }
  // The speed of a corner after an impact.
  double slipping(const RigidImpact& impact) const noexcept {
    return impact.after.x - impact.after.w * block_.center_height();
  }

  // Whether all further impacts of the base end before anything else happens.
  bool closes(const RigidImpact& impact, double speed) noexcept {
    const double n = ground_.n(now_), heavy = ground_.heavy(now_), h = block_.center_height();
    const double b[2] = {block_.right(), block_.left()};
    if (!(heavy > 0)) return false;
    if (impact.slip != 0)  // until its speed is negligible
      return speed < 1e-7 * std::sqrt(standard_gravity * h) && equal(tips(impact.slip), 0);
    double f[2];
    for (const int i : {0, 1})
      f[i] = (b[i] * heavy + (i == 0 ? n : -n) * h) / (block_.gyration_square() + h * h + b[i] * b[i]);
    if (!(f[0] > 0 && f[1] > 0) || !(std::abs(n) < block_.mu() * heavy)) return false;
    const int to = impact.side > 0 ? 0 : 1;
    const double r[2] = {block_.restitution_right(), block_.restitution_left()}, both = r[0] * r[1];
    if (!(both < 1)) return false;
    const double time = 2 * std::abs(impact.after.w) * (1 / f[to] + r[1 - to] / f[1 - to]) / (1 - both);
    if (!(std::max(block_.p_right(), block_.p_left()) * time < 1e-7) || !(time < left())) return false;
    now_ += time;
    return true;
  }

  void fall(RigidSink& sink) {
    const double side = state_.rotation > 0 ? 1 : -1;
    const auto energy = [&] {
      return kinetic_energy(block_, velocity(block_, state_)) + standard_gravity * detail::rise(block_, state_);
    };
    const double before = energy();
    const RockingState arrived = state_;
    if (state_.mode == RockingMode::flight) stand(side);  // its side hits the ground
    state_.mode = side > 0 ? RockingMode::right : RockingMode::left;
    state_.overturned = static_cast<std::int8_t>(side);
    state_.rotation = std::copysign(std::numbers::pi / 2, side);
    state_.rate = state_.velocity = state_.rise = state_.climb = 0;
    state_.slip = 0;
    sink.happens(RockingEventKind::overturned, now_, arrived, side, 0, arrived.rate);
    sink.fall(before - energy());
  }

  [[noreturn]] void refuse() const {
    throw ConvergenceError(
        "advance: " + shortest(now_) + " s into its segment the block slips at theta = " + shortest(state_.rotation) +
        " rad with mu = " + shortest(block_.mu()) +
        ", where friction at its corner decides nothing (the paradox of Painleve): below mu_P = " +
        shortest(block_.painleve_friction()) + " the motion is always determined, and without a mu it never slips");
  }

  const RockingBlock& block_;
  const RockingSegment& ground_;
  RockingState& state_;
  double now_ = 0;  // since the beginning of the segment [s]
  RigidStart how_{};
  bool stopped_ = false;
};

}  // namespace stickslip::detail
