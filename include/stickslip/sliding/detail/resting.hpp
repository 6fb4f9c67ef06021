// The loads that a slider at rest is certain to hold.
#pragma once

#include <cmath>

#include "stickslip/base/units.hpp"
#include "stickslip/ground/segment.hpp"
#include "stickslip/slider/slider.hpp"
#include "stickslip/sliding/detail/bounds.hpp"
#include "stickslip/sliding/detail/engine.hpp"
#include "stickslip/state/state.hpp"

namespace stickslip::detail {

/// What a slider holds while it rests at one place: under a load p and a weight w = N+/g
///     p - wn^2 x < w hold forward,   -(p - wn^2 x) < w hold backward,
/// both linear in time during a segment, so that its ends decide. Loads that equal a level but for round-off are left to
/// the event loop.
class Resting {
 public:
  explicit Resting(const Engine& engine) : engine_(engine), spring_(engine.mounting().spring()) {
    if (engine.law().constant) ask(State());
  }

  /// Whether levels may be kept for a rest: those of a surface that cools rise.
  bool known() const noexcept { return !engine_.law().heated; }

  /// A rest begins.
  /// @tparam Place  a state, or a view of one
  template <class Place>
  void begin(const Place& now) {
    if (!engine_.law().constant) {
      if constexpr (requires { now.state(); })
        ask(now.state());
      else
        ask(State(now));
    }
    place_ = now.displacement;
    const Bounds bounds(engine_.mounting().stops, engine_.mounting().one_way);
    forward_ = bounds.bound(Direction::forward, place_, holds_forward_);
    backward_ = bounds.bound(Direction::backward, place_, holds_backward_);
  }

  bool holds(const Segment& s) const noexcept { return within(-s.start, 1) && within(-s.end, 1); }
  bool holds(const LoadSegment& s) const noexcept {
    constexpr double per_force = 1 / standard_gravity;
    return within(s.load_start, per_force * s.normal_start) && within(s.load_end, per_force * s.normal_end);
  }

 private:
  bool within(double load, double weight) const noexcept {
    const double q = load - spring_.under(weight) * place_;
    return weight > 0 && q < weight * forward_ && -q < weight * backward_;
  }
  void ask(const State& at) {
    constexpr double gap = 0x1p-40;
    const auto certain = [&](Direction direction) {
      const double level = engine_.hold(at, 1, direction);
      return level < never ? level - gap * std::abs(level) : level;
    };
    holds_forward_ = certain(Direction::forward);
    holds_backward_ = certain(Direction::backward);
  }

  const Engine& engine_;
  Spring spring_;
  double holds_forward_ = 0, holds_backward_ = 0;  // levels [m/s^2]
  double place_ = 0, forward_ = 0, backward_ = 0;  // x, and the levels there
};

}  // namespace stickslip::detail
