// Constant friction between two events, in closed form.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace stickslip {

/// The beginning of a slip or of a part of one, seen in the direction of sliding: speed is |x'|, and the net
/// acceleration (load less friction less spring) is positive where the slip speeds up. Unequal levels, slopes and the
/// sign of the motion have vanished into it.
struct Start {
  double speed;         ///< [m/s], at least 0
  double acceleration;  ///< [m/s^2]; exactly 0 on breaking away
  double load_rate;     ///< rate of change of the load [m/s^3]
};

/// What a flow has come to after a time.
struct Progress {
  double distance;      ///< slid since its start [m]
  double speed;         ///< [m/s]
  double acceleration;  ///< net, in the direction of sliding [m/s^2]
  double area;          ///< integral of the distance over time [m s]
};

inline constexpr double never = std::numeric_limits<double>::infinity();

/// b0 .. b4 at one time: b0'' = -wn^2 b0, b0(0) = 1, b0'(0) = 0, and each the integral of the one before.
struct Basis {
  double b0, b1, b2, b3, b4;
};

/// First root y other than 0 of j y^2 / 2 + a y + u, u >= 0, on the line that runs from 0 to infinity and comes back
/// from minus infinity to 0: where the roots of a speed lie that starts at u with the slope a. NaN where there is none.
/// Neither form cancels.
inline double first_root(double u, double a, double j) noexcept {
  double discriminant = a * a - 2 * j * u;
  if (!(a * a < 0x1p900 && std::abs(j) * u < 0x1p900) || std::max(a * a, std::abs(j) * u) < 0x1p-900) {
    // Formed again with numbers near 1, which leaves y as it is.
    const double largest = std::max({u, std::abs(a), std::abs(j)});
    if (largest > 0 && std::abs(std::ilogb(largest)) > 1) {
      const int exponent = -std::ilogb(largest);
      return first_root(std::ldexp(u, exponent), std::ldexp(a, exponent), std::ldexp(j, exponent));
    }
  }
  if (a < 0) return 2 * u / (std::sqrt(discriminant) - a);
  return -(a + std::sqrt(discriminant)) / j;
}

/// Constant friction from a given start, with the net acceleration a there and the load's rate of change j:
///     speed    = u b0(t) + a b1(t) + j b2(t),
///     distance = u b1(t) + a b2(t) + j b3(t),
/// thesis (4.51) to (4.53), (2.44). `Oscillator` gives the basis: `Polynomial` without a spring, `Harmonic` with one.
/// Exact but for round-off.
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
    const auto [u, a, j] = start_;
    if (u == 0 && a <= 0) return a < 0 || j <= 0 ? 0 : never;
    const double last_speed = speed(end_);
    const bool one_arch = duration_ <= oscillator_.half_period();
    if (one_arch && last_speed > 0) {
      // It ends in motion: it can have stopped on the way only if it slowed down at first and speeds up at the end.
      if (a >= 0 || acceleration(end_) <= 0) return never;
    }
    const double stop = oscillator_.time(first_root(u, a, j - oscillator_.stiffness() * u / 2));
    if (stop <= duration_) return stop;
    return one_arch && last_speed <= 0 ? duration_ : never;  // past the end by rounding alone
  }

  Progress at(double t) const noexcept {
    const auto [u, a, j] = start_;
    const Basis b = t == duration_ ? end_ : oscillator_.basis(t);
    return {u * b.b1 + a * b.b2 + j * b.b3, std::max(speed(b), 0.0), acceleration(b), u * b.b2 + a * b.b3 + j * b.b4};
  }

 private:
  double speed(const Basis& b) const noexcept {
    return start_.speed * b.b0 + start_.acceleration * b.b1 + start_.load_rate * b.b2;
  }

  double acceleration(const Basis& b) const noexcept {
    return start_.acceleration * b.b0 + (start_.load_rate - oscillator_.stiffness() * start_.speed) * b.b1;
  }

  const Oscillator& oscillator_;
  Start start_;
  double duration_;
  Basis end_;
};

}  // namespace stickslip
