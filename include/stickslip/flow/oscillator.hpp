// Constant friction with a spring: the displacement is the sum of a sine, a cosine and a linear function of time.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

#include "stickslip/base/equal.hpp"
#include "stickslip/flow/closed_form.hpp"
#include "stickslip/state/state.hpp"

namespace stickslip {

/// With speed u and net acceleration a at the start, and a load that increases by g over the time t,
///     speed = u b0 + a b1 + g b2 / t,    distance = u b1 + a b2 + g b3 / t,
/// where b0 = cos(wn t) and each further b is the integral of the previous one; without a spring they are 1, t, t^2/2,
/// ...
///
/// In terms of y = (2/wn) tan(wn t / 2), the zeros of the speed are the roots of the same quadratic as without a
/// spring, except that the quadratic coefficient is reduced by wn^2 u / 2. Over one period, y runs from 0 to infinity
/// and from minus infinity to 0. A slip that does not stop within a period never stops.
class Harmonic {
 public:
  struct Basis {
    double b0, b1, b2;
    double c1, c2, c3, c4;  // b1/t, b2/t, b3/t and b4/t^2
  };

  /// @param natural_frequency  wn [rad/s], positive
  /// @param usual_duration     time whose basis is precomputed [s]; the segments of a record have equal length
  explicit Harmonic(double natural_frequency, double usual_duration = std::numeric_limits<double>::quiet_NaN()) noexcept
      : w_(natural_frequency), usual_duration_(usual_duration), usual_basis_(compute(usual_duration)) {}

  Basis basis(double t) const noexcept { return detail::equal(t, usual_duration_) ? usual_basis_ : compute(t); }
  bool one_arch(double t) const noexcept { return w_ * t <= std::numbers::pi; }

  double speed(const Start& start, const Basis& b) const noexcept {
    return start.speed * b.b0 + start.acceleration * b.b1 + start.gain * b.c2;
  }
  double acceleration(const Start& start, const Basis& b) const noexcept {
    return start.acceleration * b.b0 - w_ * w_ * start.speed * b.b1 + start.gain * b.c1;
  }
  Progress progress(const Start& start, const Basis& b) const noexcept {
    const auto [u, a, g] = start;
    return {u * b.b1 + a * b.b2 + g * b.c3, speed(start, b), acceleration(start, b), u * b.c2 + a * b.c3 + g * b.c4};
  }

  /// As `Polynomial::first_stop`.
  double first_stop(double u, double a, double g, double duration) const noexcept {
    const double radians = w_ * duration;
    const double y = duration * first_root(u, a, g - radians * radians * u * (1.0 / 2));
    if (std::isnan(y)) return never;
    return (2 / w_) * (std::atan(w_ * y / 2) + (std::signbit(y) ? std::numbers::pi : 0.0));
  }

  /// Spring force per unit mass [m/s^2].
  double pull(double displacement) const noexcept { return w_ * w_ * displacement; }
  static constexpr double drag(double) noexcept { return 0; }

  ClosedForm<Harmonic> flow(const Start& start, double duration) const noexcept { return {*this, start, duration}; }

 private:
  // The closed forms of b3 and b4 suffer from cancellation at small wn t; the series would at large wn t.
  Basis compute(double t) const noexcept {
    const double w2 = w_ * w_, z = w2 * t * t;
    if (z < 2) {
      const double f3 = inverse_factorials<3>(z), f4 = inverse_factorials<4>(z);
      const double c1 = 1 - z * f3, half = 0.5 - z * f4;
      return {1 - z * half, t * c1, t * t * half, c1, t * half, t * t * f3, t * t * f4};
    }
    const double s = std::sin(w_ * t / 2), b1 = std::sin(w_ * t) / w_, b2 = 2 * s * s / w2;
    return {1 - w2 * b2, b1, b2, b1 / t, b2 / t, (1 - b1 / t) / w2, (0.5 - b2 / (t * t)) / w2};
  }

  // 1/n! - z/(n+2)! + z^2/(n+4)! - ..., below round-off after eleven terms for z < 2. Even and odd terms are summed
  // separately, to shorten the chain of dependent additions.
  template <int n>
  static double inverse_factorials(double z) noexcept {
    static constexpr auto terms = [] {
      std::array<double, 12> c{};
      double factorial = 1;
      for (int i = 2; i <= n; ++i) factorial *= i;
      int k = n;
      for (std::size_t i = 0; i < c.size(); ++i, k += 2, factorial *= (k - 1.0) * k)
        c[i] = (i % 2 == 0 ? 1 : -1) / factorial;
      return c;
    }();
    const double zz = z * z;
    const double* const c = terms.data();
    double even = c[10], odd = c[11];
    for (int i = 8; i >= 0; i -= 2) {
      even = even * zz + c[i];
      odd = odd * zz + c[i + 1];
    }
    return even + z * odd;
  }

  double w_;
  double usual_duration_;
  Basis usual_basis_;
};

}  // namespace stickslip
