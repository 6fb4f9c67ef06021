// Constant friction with a spring: the displacement is a sine, a cosine and a line in time.
#pragma once

#include <cmath>
#include <limits>
#include <numbers>

#include "stickslip/flow/closed_form.hpp"
#include "stickslip/state.hpp"

namespace stickslip {

/// In y = (2/wn) tan(wn t / 2) the speed has the roots of the same quadratic as without a spring, but for j less
/// wn^2 u / 2, and its whole period is the line from 0 to infinity and back from minus infinity to 0: what is not zero
/// within a period never is.
class Harmonic {
 public:
  /// @param natural_frequency  wn [rad/s], positive
  /// @param usual_duration     a time whose basis is kept [s], as records have segments of one length
  explicit Harmonic(double natural_frequency, double usual_duration = std::numeric_limits<double>::quiet_NaN()) noexcept
      : w_(natural_frequency), usual_duration_(usual_duration), usual_basis_(compute(usual_duration)) {}

  double stiffness() const noexcept { return w_ * w_; }
  double half_period() const noexcept { return std::numbers::pi / w_; }
  Basis basis(double t) const noexcept { return t == usual_duration_ ? usual_basis_ : compute(t); }

  /// The time at which the speed's root y is reached.
  double time(double y) const noexcept {
    if (std::isnan(y)) return never;
    return (2 / w_) * (std::atan(w_ * y / 2) + (y < 0 ? std::numbers::pi : 0.0));
  }

  ClosedForm<Harmonic> flow(Direction, double /*displacement*/, const Start& start, double duration) const noexcept {
    return {*this, start, duration};
  }

 private:
  // b3 and b4 cancel where wn t is small, and so would the others made from them where it is large.
  Basis compute(double t) const noexcept {
    const double w2 = w_ * w_, z = w2 * t * t;
    if (z < 2) {
      const double b4 = t * t * t * t * inverse_factorials(z, 4);
      const double b3 = t * t * t * inverse_factorials(z, 3);
      return {1 - w2 * (t * t / 2 - w2 * b4), t - w2 * b3, t * t / 2 - w2 * b4, b3, b4};
    }
    const double s = std::sin(w_ * t / 2), b1 = std::sin(w_ * t) / w_, b2 = 2 * s * s / w2;
    return {1 - w2 * b2, b1, b2, (t - b1) / w2, (t * t / 2 - b2) / w2};
  }

  // 1/n! - z/(n+2)! + z^2/(n+4)! - ..., below round-off after eleven terms for z < 2.
  static double inverse_factorials(double z, int n) noexcept {
    double sum = 1;
    for (int k = 20; k >= 0; k -= 2) sum = 1 - z * sum / ((n + k + 1) * (n + k + 2));
    for (int k = 2; k <= n; ++k) sum /= k;
    return sum;
  }

  double w_;
  double usual_duration_;
  Basis usual_basis_;
};

}  // namespace stickslip
