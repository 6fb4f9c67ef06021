// Constant friction without a spring: the displacement is a cubic in time.
#pragma once

#include <cmath>

#include "stickslip/flow/closed_form.hpp"
#include "stickslip/state/state.hpp"

namespace stickslip {

/// With speed u and net acceleration a at the start, and a load that increases by g over the time t,
///     speed = u + a t + g t / 2,    distance = u t + a t^2 / 2 + g t^2 / 6.
struct Polynomial {
  using Basis = double;  // the time itself

  static constexpr Basis basis(double t) noexcept { return t; }
  static constexpr bool one_arch(double) noexcept { return true; }

  static constexpr double speed(const Start& start, double t) noexcept {
    return start.speed + t * (start.acceleration + start.gain * (1.0 / 2));
  }
  static constexpr double acceleration(const Start& start, double) noexcept { return start.acceleration + start.gain; }
  static constexpr Progress progress(const Start& start, double t) noexcept {
    const auto [u, a, g] = start;
    return {t * (u + t * (a * (1.0 / 2) + g * (1.0 / 6))), speed(start, t), acceleration(start, t),
            t * (u * (1.0 / 2) + t * (a * (1.0 / 6) + g * (1.0 / 24)))};
  }

  /// @param u, a, g  speed, and acceleration and gain times the duration [m/s]
  static double first_stop(double u, double a, double g, double duration) noexcept {
    const double root = first_root(u, a, g);
    return root >= 0 && !std::signbit(root) ? root * duration
                                            : never;  // an underflowed root is +0, or -0 if it lies before the start
  }

  /// Zero: there is no spring.
  static constexpr double pull(double) noexcept { return 0; }
  static constexpr double drag(double) noexcept { return 0; }

  ClosedForm<Polynomial> flow(const Start& start, double duration) const noexcept { return {*this, start, duration}; }
};

}  // namespace stickslip
