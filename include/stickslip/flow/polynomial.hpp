// Constant friction without a spring: the displacement is a cubic in time.
#pragma once

#include "stickslip/flow/closed_form.hpp"
#include "stickslip/state.hpp"

namespace stickslip {

struct Polynomial {
  static constexpr double stiffness() noexcept { return 0; }
  static constexpr double half_period() noexcept { return never; }

  static constexpr Basis basis(double t) noexcept {
    const double t2 = t * t / 2;
    return {1, t, t2, t2 * t / 3, t2 * t2 / 6};
  }

  /// The time at which the speed's root y is reached: itself, if it lies ahead.
  static constexpr double time(double y) noexcept { return y > 0 ? y : never; }

  ClosedForm<Polynomial> flow(Direction, double /*displacement*/, const Start& start, double duration) const noexcept {
    return {*this, start, duration};
  }
};

}  // namespace stickslip
