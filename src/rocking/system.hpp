// A slender block that rocks, as a sliding system: the event loop asks it what it asks a slider.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "rocking/leg.hpp"
#include "stickslip/base/equal.hpp"
#include "stickslip/base/error.hpp"
#include "stickslip/base/units.hpp"
#include "stickslip/flow/closed_form.hpp"
#include "stickslip/rocking/slender_block.hpp"
#include "stickslip/rocking/state.hpp"
#include "stickslip/run/detail/loop.hpp"
#include "stickslip/run/detail/system.hpp"
#include "stickslip/run/response.hpp"

namespace stickslip::detail {

/// Receives the motion of a block while it is computed. Times are since the beginning of the segment [s].
class RockingSink {
 public:
  /// The block rocks along a leg that begins at a time, for a duration, and is then at a place.
  virtual void follow(const RockingLeg& leg, double begin, double duration, const RockingLeg::Place& end) = 0;
  /// `breakaway` is an uplift from rest.
  virtual void event(EventKind kind, double time, const RockingState& state) = 0;
  /// Energy lost in an impact, per unit moment of inertia about a corner [1/s^2].
  virtual void lose(double /*energy*/) {}
  /// The same in the fall on its side.
  virtual void fall(double /*energy*/) {}
  /// Of its legs.
  LastSums& sums() noexcept { return sums_; }

 protected:
  ~RockingSink() = default;

 private:
  LastSums sums_;
};

/// The variation of a motion with a parameter, after an impact whose time varies with it.
/// @param time       of the impact, since the beginning of the segment [s]
/// @param before     the state with the rate before it
/// @param arrives    theta'' before it
inline RockingPlace after_impact(const SlenderBlock& block, const RockingSegment& ground, double time,
                                 const RockingState& before, double arrives, const RockingPlace& variation) noexcept {
  const double r = block.restitution();
  const double other = before.rate > 0 ? block.alpha_right() : -block.alpha_left();  // it goes on with its rate
  const double leaves = block.p() * block.p() / standard_gravity * (-ground.heavy(time) * other - ground.n(time));
  const double shift = variation.rotation / before.rate;
  return {r * variation.rotation, r * variation.rate - (r * arrives - leaves) * shift};
}

/// The moment by which the ground lifts a block off a corner, over that of its weight G: positive uplifts.
struct UpliftMargins {
  double right, left;  // -n - alpha_right G, n - alpha_left G

  UpliftMargins(const SlenderBlock& block, double n, double heavy) noexcept
      : right(-n - block.alpha_right() * heavy), left(n - block.alpha_left() * heavy) {}
};

struct Uplift {
  RockingMode mode = RockingMode::rest;
  double delay = 0;   // [s]
  double excess = 0;  // of the load over the level then [m/s^2], at least 0

  bool departs() const noexcept { return mode != RockingMode::rest; }
};

struct RockingSlide {
  RockingLeg leg;
  RockingLeg::Place end;
  double stop = never;  // impacts are passages

  struct Leg {
    double time;
    RockingLeg::Place end;
  };
  Leg whole() const noexcept { return {leg.duration(), end}; }
  Leg until(double t) const noexcept { return {t, leg.at(t)}; }
};

struct RockingPassage {
  bool passes = false;
  RockingSlide::Leg leg{};
};

/// A slender block during one segment (a SlidingSystem).
class RockingSystem {
 public:
  static constexpr int most_steps = 1'000'000;

  /// @param sums  of its sink
  RockingSystem(const SlenderBlock& block, const RockingSegment& ground, RockingState& state, LastSums& sums)
      : block_(block), ground_(ground), state_(state), sums_(sums) {}

  double left() const noexcept { return ground_.duration - now_; }
  double elapsed() const noexcept { return now_; }
  const RockingState& state() const noexcept { return state_; }
  const RockingState& resting_state() const noexcept { return state_; }
  bool at_rest() const noexcept { return state_.mode == RockingMode::rest; }
  bool has_stopped() const noexcept { return stopped_; }

  /// Both margins are linear in time.
  Uplift departure() const noexcept {
    const UpliftMargins now(block_, ground_.n(now_), ground_.heavy(now_));
    const UpliftMargins last(block_, ground_.n_end, ground_.heavy_end);
    Uplift first;
    double soonest = never;
    const auto look = [&](RockingMode mode, double from, double to) {
      if (!(std::max(from, to) > 0)) return;
      const double delay = from >= 0 ? 0 : left() * (from / (from - to));
      if (delay < soonest) soonest = delay, first = {mode, delay, std::max(from, 0.0)};
    };
    look(RockingMode::right, now.right, last.right);
    look(RockingMode::left, now.left, last.left);
    return first;
  }

  Resumption depart(const Uplift& uplift) noexcept {
    now_ = std::min(now_ + uplift.delay, ground_.duration);
    state_.mode = uplift.mode;
    excess_ = uplift.excess;
    return std::exchange(stopped_, false) && !(uplift.delay > 0) ? Resumption::reversed : Resumption::from_rest;
  }

  RockingSlide slide() const {
    const RockingLeg leg = next_leg();
    return {leg, leg.at(leg.duration())};
  }

  RockingPassage passage(const RockingSlide& slide) const {
    if (state_.overturned != 0) return {};
    const double time = slide.leg.impact(slide.end);
    if (!(time < never)) return {};
    return {true, {time, {0, slide.leg.at(time).rate}}};
  }

  void show(const RockingSlide& slide, const RockingSlide::Leg& leg, RockingSink& sink) const {
    sink.follow(slide.leg, now_, leg.time, leg.end);
  }

  /// An impact. Infinitely many of them are skipped if they end within a time in which nothing else happens.
  bool pass(const RockingSlide& slide, const RockingPassage& passage, RockingSink& sink) {
    go(slide, passage.leg);
    sink.event(EventKind::impact, now_, state_);
    const double r = block_.restitution(), before = std::abs(state_.rate), after = r * before;
    const RockingMode other = state_.mode == RockingMode::right ? RockingMode::left : RockingMode::right;
    if (!(after > 0) || closes(other, before)) {
      sink.lose(before * before / 2);
      state_ = {};
      stopped_ = true;
      return true;
    }
    sink.lose((before * before - after * after) / 2);
    state_.rate *= r;
    state_.mode = other;
    if (ground_.still && after > block_.p() * alpha_of(block_, other)) {
      state_.overturned = static_cast<std::int8_t>(sign(other));
      return false;
    }
    return left() > 0;
  }

  bool proceed(const RockingSlide& slide, const RockingSlide::Leg& leg) {
    const bool ends = !(leg.time < left());
    go(slide, leg);
    return !ends;
  }

  void stop(const RockingSlide&, const RockingSlide::Leg&) const noexcept {}  // it never stops but by impacts

  [[noreturn]] void stall() const {
    throw ConvergenceError("advance: in a segment of " + shortest(ground_.duration) +
                           " s the block has impacts faster than its time can be resolved, at theta' = " +
                           shortest(state_.rate) + " rad/s, " + shortest(left()) + " s before its end");
  }

 private:
  void go(const RockingSlide&, const RockingSlide::Leg& leg) noexcept {
    now_ = leg.time < left() ? ground_.duration - pass_time(left(), leg.time) : ground_.duration;
    state_.rotation = leg.end.rotation;
    state_.rate = leg.end.rate;
    excess_ = -1;
  }

  // What decided an uplift is where the leg starts: computed again, it could differ by round-off.
  RockingLeg next_leg() const {
    const double s = sign(state_.mode), tilt = s * alpha_of(block_, state_.mode);
    const RockingLeg::Place start{state_.rotation, state_.rate};
    if (excess_ < 0) return {block_, ground_, now_, start, tilt, sums_};
    return {block_, ground_, now_, start, tilt, sums_, s * (block_.p() * block_.p() / standard_gravity) * excess_};
  }

  // Whether all further impacts end before anything else happens: T = 2 r v (1/f_a + r/f_b)/(1 - r^2), with the decelerations
  // f on the side to which it goes and on the other.
  bool closes(RockingMode to, double before) noexcept {
    const double r = block_.restitution(), square = block_.p() * block_.p() / standard_gravity;
    if (!(r < 1)) return false;
    const UpliftMargins margins(block_, ground_.n(now_), ground_.heavy(now_));
    const double right = -square * margins.right, left_side = -square * margins.left;
    if (!(right > 0 && left_side > 0)) return false;
    const double ahead = to == RockingMode::right ? right : left_side,
                 behind = to == RockingMode::right ? left_side : right;
    const double time = 2 * r * before * (1 / ahead + r / behind) / (1 - r * r);
    if (!(block_.p() * time < 1e-7) || !(time < left())) return false;
    now_ += time;
    return true;
  }

  const SlenderBlock& block_;
  const RockingSegment& ground_;
  RockingState& state_;
  LastSums& sums_;
  double now_ = 0;      // since the beginning of the segment [s]
  double excess_ = -1;  // with which the next leg starts from rest; negative if it does not
  bool stopped_ = false;
};

/// Moves a state through a segment. A block that lies on its side stays there.
void rock(const SlenderBlock& block, const RockingSegment& ground, RockingState& state, RockingSink& sink);

}  // namespace stickslip::detail
