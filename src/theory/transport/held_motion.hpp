// The exact motion of a slider over a step whose load is held: the part S of the transport operator.
#pragma once

#include <limits>

#include "stickslip/sliding/any_slider.hpp"
#include "stickslip/state/state.hpp"

namespace stickslip::detail {

/// A slider without stops, of a law without memory, under a load that is held over each step: a ground acceleration n.
/// Friction is given as the ground acceleration that it resists. On level ground that is the level of the law; on a
/// slope it is larger backward than forward, and a level becomes
///     (level cos(slope) - g sin(slope)) / (cos(slope) + level / g sin(slope))  forward,
///     (level cos(slope) + g sin(slope)) / (cos(slope) - level / g sin(slope))  backward;
/// where sliding is one-way, or the last denominator is not positive, the backward one is infinite. Contact is never
/// lost: where N < 0 there is no friction.
class HeldMotion {
 public:
  /// @throws std::invalid_argument  a law that is not covered, or stops
  explicit HeldMotion(const AnySlider& slider);

  /// Displacement [m] and velocity [m/s] after a step, and the largest |x| on the way.
  struct End {
    double displacement, velocity, farthest;
  };

  /// @param x     displacement at the beginning [m]
  /// @param v     velocity at the beginning [m/s]; 0 is rest
  /// @param load  ground acceleration [m/s^2]
  /// @param step  [s]
  End operator()(double x, double v, double load, double step) const;

  double stiffness() const noexcept { return mounting_of(slider_).stiffness(); }
  double natural_frequency() const noexcept { return mounting_of(slider_).natural_frequency; }

  /// The ground acceleration, downward along the slope, at which the normal force vanishes [m/s^2]; infinite on level
  /// ground.
  double lift_off() const noexcept { return lift_off_; }

  /// Friction at x = 0 [m/s^2]: the largest at rest and the resistance just after it, against sliding in a direction.
  double hold(Direction direction) const noexcept { return of(direction).hold; }
  double start(Direction direction) const noexcept { return of(direction).start; }
  /// The smaller one of the two at rest.
  double least_hold() const noexcept;
  /// The least resistance to sliding at x = 0 in either direction, at any speed.
  double least() const noexcept { return least_; }

  /// Whether friction at rest exceeds that just after it: motions then depend on the load discontinuously.
  bool breaks_away() const noexcept;

  /// Whether the motion under the opposite load, from the opposite state, is the opposite motion.
  bool mirrors() const noexcept { return mirrors_; }

  /// The distance [m] and the speed [m/s] over which friction changes; infinite if it does not.
  double reach() const noexcept { return reach_; }
  double speed() const noexcept { return speed_; }

  /// The same slider with its friction at rest reduced, but not below that just after it.
  /// @param by  ground acceleration [m/s^2]
  HeldMotion holding_less(double by) const;

 private:
  struct Friction {
    double hold, start;
  };
  const Friction& of(Direction direction) const noexcept {
    return direction == Direction::forward ? forward_ : backward_;
  }

  AnySlider slider_;
  Friction forward_{}, backward_{};
  double least_ = 0, reach_ = 0, speed_ = 0, lift_off_ = std::numeric_limits<double>::infinity();
  bool mirrors_ = false;
};

}  // namespace stickslip::detail
