// Constant friction between two events, in closed form.
#pragma once

#include <cmath>
#include <limits>

#include "stickslip/base/equal.hpp"
#include "stickslip/base/min_max.hpp"
#include "stickslip/base/requirements.hpp"

namespace stickslip {

/// The progress of a flow after a given time.
struct Progress {
  double distance;       ///< slid since its start [m]
  double speed;          ///< [m/s]
  double acceleration;   ///< net, in the direction of sliding [m/s^2]
  double mean_distance;  ///< mean of the distance over the time since the start [m]
};

/// The start of a slip or of a part of one, expressed in the direction of sliding: speed is |x'|, and the net
/// acceleration (load minus friction minus spring force) is positive if the slip speeds up. It already accounts for
/// unequal levels, slopes and the sign of the motion.
struct Start {
  double speed;         ///< [m/s], at least 0
  double acceleration;  ///< [m/s^2]; exactly 0 on breaking away
  double gain;          ///< change of the load over the flow's duration, linear in time [m/s^2]

  double gain_within(double t, double duration) const noexcept { return t < duration ? gain * (t / duration) : gain; }

  /// Work of the load over a time in which it changes from `load` to `load + gained` [m^2/s^2].
  template <class Flow>
  double work(const Flow&, double load, double gained, double /*t*/, const Progress& end) const noexcept {
    return (load + gained) * end.distance - gained * end.mean_distance;
  }
};

/// A start under a variable normal force. Flows with constant levels use it as a plain Start: its `gain` includes the
/// change of friction with the normal force. Other flows use `load_gain` and the weight separately.
struct LoadStart : Start {
  double load_gain;      ///< change of the load over the flow's duration, in the direction of sliding [m/s^2]
  double weight;         ///< N+ / g at the start
  double weight_gained;  ///< change of the weight over the flow's duration
  double level;          ///< resistance at the start under a normal force of g [m/s^2]
  bool begins = false;  ///< from rest, at its level: `gain` is positive, and that of the net acceleration at this place

  double gain_within(double t, double duration) const noexcept {
    return t < duration ? load_gain * (t / duration) : load_gain;
  }

  /// Work against a constant level up to time t [m^2/s^2].
  double friction_work(double t, double duration, const Progress& end) const noexcept {
    const double gained = t < duration ? weight_gained * (t / duration) : weight_gained;
    return level * ((weight + gained) * end.distance - gained * end.mean_distance);
  }
};

inline constexpr double never = std::numeric_limits<double>::infinity();

namespace detail {

/// `first_root` with its arguments scaled to near 1, for arguments whose squares would overflow or underflow.
[[gnu::noinline]] inline double first_root_scaled(double u, double a, double j) noexcept {
  const double largest = std::max(u, std::max(std::abs(a), std::abs(j)));
  const int exponent = largest > 0 ? -std::ilogb(largest) : 0;
  u = std::ldexp(u, exponent), a = std::ldexp(a, exponent), j = std::ldexp(j, exponent);
  const double root = std::sqrt(a * a - 2 * j * u);
  return a < 0 ? 2 * u / (root - a) : -(a + root) / j;
}

}  // namespace detail

/// The first root y other than 0 of j y^2 / 2 + a y + u, u >= 0, in the order 0 to infinity, then minus infinity to 0.
/// The roots of a speed that starts at u with slope a lie in this order. NaN if there is no root. Neither of the two
/// formulas suffers from cancellation.
inline double first_root(double u, double a, double j) noexcept {
  const double square = a * a, product = 2 * j * u;
  const double magnitude = square + std::abs(product);
  if (!(magnitude > 0x1p-900 && magnitude < 0x1p900)) return detail::first_root_scaled(u, a, j);
  const double root = std::sqrt(square - product);
  return a < 0 ? 2 * u / (root - a) : -(a + root) / j;
}

/// Constant friction from a given start: thesis (4.51) to (4.53), (2.44), exact up to round-off.
///
/// `Oscillator` supplies the solution: `Polynomial` without a spring, `Harmonic` with one. In both cases the zeros of
/// the speed are the roots of a quadratic.
template <class Oscillator>
class ClosedForm {
 public:
  ClosedForm(const Oscillator& oscillator, const Start& start, double duration) noexcept
      : oscillator_(oscillator), start_(start), duration_(duration), end_(oscillator.basis(duration)) {}

  /// Time from the start over which the solution is valid [s].
  double horizon() const noexcept { return duration_; }

  /// First time after the start, within the duration, at which the speed reaches zero; 0 if the slip cannot begin;
  /// `never` if the slip does not stop.
  double first_stop() const noexcept {
    const auto [u, a, gain] = start_;
    const double last_speed = oscillator_.speed(start_, end_);
    const bool one_arch = oscillator_.one_arch(duration_);
    // Within one arch, a speed that ends above zero can have reached zero before only if it falls at the start and
    // rises at the end.
    if (one_arch && last_speed > 0 && (a >= 0 || oscillator_.acceleration(start_, end_) <= 0)) return never;
    if (detail::equal(u, 0) && a <= 0) return a < 0 || gain <= 0 ? 0 : never;
    // With time in units of the duration, all terms are speeds, which do not overflow or underflow where it matters.
    const double stop = oscillator_.first_stop(u, a * duration_, gain * duration_, duration_);
    if (stop <= duration_) return stop;
    return one_arch && last_speed <= 0 ? duration_ : never;  // the root exceeds the duration only by rounding
  }

  Progress at(double t) const noexcept {
    return oscillator_.progress(Start{start_.speed, start_.acceleration, start_.gain * (t / duration_)},
                                oscillator_.basis(t));
  }
  Progress at_horizon() const noexcept { return oscillator_.progress(start_, end_); }

 private:
  const Oscillator& oscillator_;
  Start start_;
  double duration_;
  typename Oscillator::Basis end_;
};

}  // namespace stickslip
