// Constant friction between two events, in closed form.
#pragma once

#include <cmath>
#include <limits>

#include "stickslip/detail/equal.hpp"
#include "stickslip/detail/min_max.hpp"
#include "stickslip/detail/requirements.hpp"

namespace stickslip {

/// What a flow has come to after a time.
struct Progress {
  double distance;       ///< slid since its start [m]
  double speed;          ///< [m/s]
  double acceleration;   ///< net, in the direction of sliding [m/s^2]
  double mean_distance;  ///< mean of the distance over the time since the start [m]
};

/// The beginning of a slip or of a part of one, seen in the direction of sliding: speed is |x'|, and the net
/// acceleration (load less friction less spring) is positive where the slip speeds up. Unequal levels, slopes and the
/// sign of the motion have vanished into it.
struct Start {
  double speed;         ///< [m/s], at least 0
  double acceleration;  ///< [m/s^2]; exactly 0 on breaking away
  double gain;          ///< of the load until the end of the flow's duration, linear in time [m/s^2]

  double gain_within(double t, double duration) const noexcept { return t < duration ? gain * (t / duration) : gain; }

  /// Work of the load within a time in which it comes from `load` to `load + gained` [m^2/s^2].
  template <class Flow>
  double work(const Flow&, double load, double gained, double /*t*/, const Progress& end) const noexcept {
    return (load + gained) * end.distance - gained * end.mean_distance;
  }
};

/// The same where the normal force varies. For flows of constant levels it is a Start like others: what friction loses
/// or gains with the normal force is in its gain. Others take the load's gain and the weight apart.
struct LoadStart : Start {
  double load_gain;      ///< of the load until the end of the flow's duration, in the direction of sliding [m/s^2]
  double weight;         ///< N+ / g now
  double weight_gained;  ///< until the end of the flow's duration
  double level;          ///< what resists under the weight g now [m/s^2]

  double gain_within(double t, double duration) const noexcept {
    return t < duration ? load_gain * (t / duration) : load_gain;
  }

  /// Work against a constant level within t [m^2/s^2].
  double friction_work(double t, double duration, const Progress& end) const noexcept {
    const double gained = t < duration ? weight_gained * (t / duration) : weight_gained;
    return level * ((weight + gained) * end.distance - gained * end.mean_distance);
  }
};

inline constexpr double never = std::numeric_limits<double>::infinity();

namespace detail {

/// The roots are formed again from numbers near 1, where their squares leave the range of doubles.
[[gnu::noinline]] inline double first_root_scaled(double u, double a, double j) noexcept {
  const double largest = std::max(u, std::max(std::abs(a), std::abs(j)));
  const int exponent = largest > 0 ? -std::ilogb(largest) : 0;
  u = std::ldexp(u, exponent), a = std::ldexp(a, exponent), j = std::ldexp(j, exponent);
  const double root = std::sqrt(a * a - 2 * j * u);
  return a < 0 ? 2 * u / (root - a) : -(a + root) / j;
}

}  // namespace detail

/// First root y other than 0 of j y^2 / 2 + a y + u, u >= 0, on the line that runs from 0 to infinity and comes back
/// from minus infinity to 0: where the roots of a speed lie that starts at u with the slope a. NaN where there is none.
/// Neither form cancels.
inline double first_root(double u, double a, double j) noexcept {
  const double square = a * a, product = 2 * j * u;
  const double magnitude = square + std::abs(product);
  if (!(magnitude > 0x1p-900 && magnitude < 0x1p900)) return detail::first_root_scaled(u, a, j);
  const double root = std::sqrt(square - product);
  return a < 0 ? 2 * u / (root - a) : -(a + root) / j;
}

/// Constant friction from a given start: thesis (4.51) to (4.53), (2.44), exact but for round-off.
///
/// `Oscillator` knows the solution: `Polynomial` without a spring, `Harmonic` with one. In either the speed's zeros are
/// the roots of one quadratic.
template <class Oscillator>
class ClosedForm {
 public:
  ClosedForm(const Oscillator& oscillator, const Start& start, double duration) noexcept
      : oscillator_(oscillator), start_(start), duration_(duration), end_(oscillator.basis(duration)) {}

  /// How far the solution may be trusted from its start [s].
  double horizon() const noexcept { return duration_; }

  /// First time within the duration at which the speed comes to zero, the start left out; 0 where the slip cannot
  /// begin; `never` where there is none.
  double first_stop() const noexcept {
    const auto [u, a, gain] = start_;
    const double last_speed = oscillator_.speed(start_, end_);
    const bool one_arch = oscillator_.one_arch(duration_);
    // Within one arch a speed that ends above zero can have stopped on the way only if it fell at first and rises at
    // the end.
    if (one_arch && last_speed > 0 && (a >= 0 || oscillator_.acceleration(start_, end_) <= 0)) return never;
    if (detail::equal(u, 0) && a <= 0) return a < 0 || gain <= 0 ? 0 : never;
    // In units of the duration all terms are speeds, which neither overflow nor underflow where it matters.
    const double stop = oscillator_.first_stop(u, a * duration_, gain * duration_, duration_);
    if (stop <= duration_) return stop;
    return one_arch && last_speed <= 0 ? duration_ : never;  // past the end by rounding alone
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
