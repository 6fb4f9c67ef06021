// The exact motion of a slider over a step whose load is held: the part S of the transport operator.
#pragma once

#include "stickslip/sliding/any_slider.hpp"
#include "stickslip/state.hpp"

namespace stickslip::detail {

/// A plain slider on level ground, of a law without memory, under a load that is held over each step.
class HeldMotion {
 public:
  /// @throws std::invalid_argument  a law that is not covered, or a mounting that is not plain
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
  /// @param by  [m/s^2]
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
  double least_ = 0, reach_ = 0, speed_ = 0;
  bool mirrors_ = false;
};

}  // namespace stickslip::detail
