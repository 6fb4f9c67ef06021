// Constant friction with a viscous damper, and a spring if there is one.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <utility>

#include "stickslip/base/equal.hpp"
#include "stickslip/flow/closed_form.hpp"
#include "stickslip/numerics/gauss_legendre.hpp"
#include "stickslip/series/series.hpp"
#include "stickslip/state/state.hpp"

namespace stickslip {

namespace detail {

/// wn^2 with the sign of wn [1/s^2]; negative for a spring that pushes away from its center.
inline double stiffness_of(double natural_frequency) noexcept {
  return natural_frequency * std::abs(natural_frequency);
}

/// How often 1 must be doubled to reach a size.
inline int doublings_to(double size) noexcept {
  return size > 1 ? static_cast<int>(std::ceil(std::log2(std::min(size, std::numeric_limits<double>::max())))) : 0;
}

/// (c/2)^2 - wn^2 [1/s^2].
inline double excess_damping(double half, double natural_frequency) noexcept {
  if (natural_frequency < 0) return half * half + natural_frequency * natural_frequency;
  return (half - natural_frequency) * (half + natural_frequency);
}

}  // namespace detail

/// Basis functions of the motion of a mass with a damper c and a spring wn, at a given time. `impulse` is the solution
/// of y'' + c y' + wn^2 y = 0 with y(0) = 0 and y'(0) = 1: the velocity from rest under a unit load. `decay` is its
/// derivative: the velocity that remains of a unit velocity. `step`, `ramp` and `curve` are successive integrals of
/// `impulse`. Under a load that is linear in time, q + s t net of spring and friction at the start,
///     v(t) = u decay + q impulse + s step,    d(t) = u impulse + q step + s ramp.
/// Apart from powers of t, all five are entire functions of c t and (wn t)^2. They are accurate to round-off for
/// under-, over- and critically damped motion, with or without a spring; round-off grows in proportion to the time in
/// radians. If wn is negative, the spring pushes away from its center, with stiffness -wn^2.
struct DampedBasis {
  double duration;  ///< [s]
  double decay = 1, impulse = 0, step = 0, ramp = 0, curve = 0;

  /// @param damping            c [1/s], at least 0
  /// @param natural_frequency  wn [rad/s]
  DampedBasis(double damping, double natural_frequency, double time) noexcept : duration(time) {
    const double wn = natural_frequency, half = damping / 2, stiffness = detail::stiffness_of(wn);
    const double apart =
        half > wn ? 2 * std::sqrt(detail::excess_damping(half, wn)) : 0;  // difference of the two decay rates
    if (apart * time > 1) {
      from_rates(half + apart / 2, stiffness / (half + apart / 2), apart);
      return;
    }
    const double size = (damping + std::abs(wn)) * time;
    const int doublings = detail::doublings_to(size);
    duration = std::ldexp(time, -doublings);
    from_series(damping, stiffness);
    for (int i = 0; i < doublings; ++i) double_time(stiffness);
    duration = time;
  }

  /// Double the time.
  void double_time(double stiffness) noexcept {
    const double h = duration, position = 1 - stiffness * step;  // what remains of a unit displacement
    *this = {2 * h,
             decay * decay - stiffness * impulse * impulse,
             impulse * (position + decay),
             position * step + impulse * impulse + step,
             position * ramp + impulse * step + h * step + ramp,
             position * curve + impulse * ramp + h * (h / 2 * step + ramp) + curve};
  }

  double velocity(double u, double q, double s) const noexcept { return u * decay + q * impulse + s * step; }
  double distance(double u, double q, double s) const noexcept { return u * impulse + q * step + s * ramp; }
  double integral_of_distance(double u, double q, double s) const noexcept { return u * step + q * ramp + s * curve; }

 private:
  DampedBasis(double time, double decay_, double impulse_, double step_, double ramp_, double curve_) noexcept
      : duration(time), decay(decay_), impulse(impulse_), step(step_), ramp(ramp_), curve(curve_) {}

  // Two well separated decay rates: divided differences of e^-y and of its remainders (1 - e^-y) / y, ..., all free of
  // cancellation.
  void from_rates(double fast, double slow, double apart) noexcept {
    const double u = duration;
    const auto remainders = [](double y) {
      std::array<double, 3> r{};  // the sums of (-y)^k / (k + n)!, n = 1, 2, 3
      if (std::abs(y) < 1) {
        double term = 1.0 / 6, sum = 0;
        for (int k = 4; std::abs(term) > 1e-18; term *= -y / k++) sum += term;
        r[2] = sum;
        r[1] = 0.5 - y * r[2];
        r[0] = 1 - y * r[1];
      } else {
        r[0] = -std::expm1(-y) / y;
        r[1] = (1 - r[0]) / y;
        r[2] = (0.5 - r[1]) / y;
      }
      return r;
    };
    const double ys = slow * u, yf = fast * u, es = std::exp(-ys), ef = std::exp(-yf);
    const auto s = remainders(ys), f = remainders(yf);
    decay = (fast * ef - slow * es) / apart;
    impulse = (es - ef) / apart;
    step = u * (s[0] - f[0]) / apart;
    ramp = u * u * (s[1] - f[1]) / apart;
    curve = u * u * u * (s[2] - f[2]) / apart;
  }

  // curve'' + c curve' + wn^2 curve = t^2 / 2 as a power series, for (c + wn) t <= 1.
  void from_series(double damping, double stiffness) noexcept {
    const double u = duration, y = damping * u, q = stiffness * u * u;
    double before = 0, term = 1.0 / 24;
    decay = 0;
    for (int k = 4;; ++k) {
      curve += term;
      ramp += k * term;
      step += k * (k - 1) * term;
      impulse += k * (k - 1) * (k - 2) * term;
      decay += k * (k - 1) * (k - 2) * (k - 3) * term;
      const double next = -(y * term + q * before / k) / (k + 1);
      before = std::exchange(term, next);
      if (!(k * k * k * k * (std::abs(term) + std::abs(before * q)) >= 1e-18)) break;
    }
    impulse *= u;
    step *= u * u;
    ramp *= u * u * u;
    curve *= u * u * u * u;
  }
};

/// The integral of v^2 over a time, as a quadratic form in (u, q, s) of `DampedBasis`.
class DampedSquare {
 public:
  /// Uses 8-point Gauss-Legendre quadrature over a time so short that the motion changes little, then doubles that
  /// time.
  DampedSquare(double damping, double natural_frequency, double duration) noexcept {
    if (detail::equal(duration, 0)) return;
    const double stiffness = detail::stiffness_of(natural_frequency);
    const double size = (damping + std::abs(natural_frequency)) * duration;
    const int doublings = detail::doublings_to(size);
    const double part = std::ldexp(duration, -doublings);
    numerics::gauss_points<8>(0, part, [&](double time, double weight) {
      const DampedBasis at(damping, natural_frequency, time);
      const std::array<double, 3> v{at.decay, at.impulse, at.step};
      for (std::size_t a = 0; a < 3; ++a)
        for (std::size_t b = 0; b < 3; ++b) form_[a][b] += weight * v[a] * v[b];
    });
    DampedBasis basis(damping, natural_frequency, part);
    for (int i = 0; i < doublings; ++i) {
      double_time(stiffness, basis);
      basis.double_time(stiffness);
    }
  }

  double of(double u, double q, double s) const noexcept {
    const std::array<double, 3> z{u, q, s};
    double sum = 0;
    for (std::size_t a = 0; a < 3; ++a)
      for (std::size_t b = 0; b < 3; ++b) sum += form_[a][b] * z[a] * z[b];
    return sum;
  }

 private:
  void double_time(double k, const DampedBasis& at) noexcept {
    // Maps (u, q, s) at the start to (u, q, s) at the end.
    const double after[3][3] = {
        {at.decay, at.impulse, at.step}, {-k * at.impulse, 1 - k * at.step, at.duration - k * at.ramp}, {0, 0, 1}};
    const auto first = form_;
    for (std::size_t a = 0; a < 3; ++a)
      for (std::size_t b = 0; b < 3; ++b)
        for (std::size_t i = 0; i < 3; ++i)
          for (std::size_t j = 0; j < 3; ++j) form_[a][b] += after[i][a] * first[i][j] * after[j][b];
  }

  std::array<std::array<double, 3>, 3> form_{};
};

class DampedFlow;

/// Makes the flows of constant friction with a damper, and with a spring if wn is not 0.
class Damped {
 public:
  /// @param damping            c [1/s], at least 0
  /// @param natural_frequency  wn [rad/s]; if negative, the spring pushes away, as in `DampedBasis`
  /// @param usual_duration     time whose basis is precomputed [s]; the segments of a record have equal length
  Damped(double damping, double natural_frequency,
         double usual_duration = std::numeric_limits<double>::quiet_NaN()) noexcept
      : damping_(damping),
        natural_frequency_(natural_frequency),
        stiffness_(detail::stiffness_of(natural_frequency)),
        usual_duration_(usual_duration),
        swings_(natural_frequency > damping / 2),
        rate_(std::sqrt(std::abs(detail::excess_damping(damping / 2, natural_frequency)))),
        usual_basis_(compute(usual_duration > 0 ? usual_duration : 0)),
        usual_square_(damping, natural_frequency, usual_duration > 0 ? usual_duration : 0) {}

  double damping() const noexcept { return damping_; }
  double stiffness() const noexcept { return stiffness_; }

  /// Spring force per unit mass [m/s^2].
  double pull(double displacement) const noexcept { return stiffness_ * displacement; }
  /// Damper force per unit mass [m/s^2].
  double drag(double speed) const noexcept { return damping_ * speed; }

  bool usual(double t) const noexcept { return detail::equal(t, usual_duration_); }
  DampedBasis basis(double t) const noexcept { return usual(t) ? usual_basis_ : compute(t); }
  DampedSquare square(double t) const noexcept {
    return usual(t) ? usual_square_ : DampedSquare(damping_, natural_frequency_, t);
  }

  /// Whether the motion changes so little up to time t that a power series is fastest.
  bool soon(double t) const noexcept { return (damping_ + std::abs(natural_frequency_)) * t <= 1; }

  /// The first time after the start at which the acceleration a decay + rise impulse is zero; `never` if there is none.
  /// Apart from the factor exp(-c t/2), the acceleration is a cosine plus a sine, or their hyperbolic counterparts.
  double turn(double a, double rise) const noexcept {
    const double slope = a * (damping_ / 2) - rise;
    if (swings_) {
      const double angle = std::atan2(rate_ * a, slope);
      return (angle > 0 ? angle : angle + std::numbers::pi) / rate_;
    }
    const double ratio = a / slope, z = rate_ * ratio;
    if (!(ratio > 0 && z < 1)) return never;
    return z > 0 ? ratio * (std::atanh(z) / z) : ratio;
  }
  /// The time from one zero of the acceleration to the next; `never` if there is at most one.
  double half_period() const noexcept { return swings_ ? std::numbers::pi / rate_ : never; }

  DampedFlow flow(const Start& start, double duration) const noexcept;

 private:
  DampedBasis compute(double t) const noexcept { return {damping_, natural_frequency_, t}; }

  double damping_, natural_frequency_, stiffness_;
  double usual_duration_;
  bool swings_;
  double rate_;  // angular frequency [rad/s] if it oscillates, else half the difference of the two decay rates [1/s]
  DampedBasis usual_basis_;
  DampedSquare usual_square_;
};

/// Constant friction and a damper from a given start, in closed form: x'' + c x' + wn^2 x = p(t) - a, exact up to
/// round-off. The zeros of the acceleration are known, and the speed is monotonic between them. At most one root
/// therefore remains to be found, within a known bracket.
class DampedFlow {
 public:
  DampedFlow(const Damped& damped, const Start& start, double duration) noexcept
      : damped_(damped),
        u_(start.speed),
        a_(start.acceleration),
        q_(start.acceleration + damped.drag(start.speed)),
        s_(start.gain / duration),
        rise_(s_ - damped.stiffness() * u_),
        duration_(duration),
        soon_(damped.soon(duration)),
        end_(soon_ && !damped.usual(duration) ? at(duration) : progress(damped.basis(duration))) {}

  double horizon() const noexcept { return duration_; }

  /// As `ClosedForm::first_stop`.
  double first_stop() const noexcept {
    const double last = end_.speed;
    const bool one_arch = duration_ <= damped_.half_period();
    if (one_arch && last > 0 && (a_ >= 0 || end_.acceleration <= 0)) return never;
    const bool rises = a_ > 0 || (detail::equal(a_, 0) && rise_ > 0);
    if (detail::equal(u_, 0) && !rises) return 0;
    if (one_arch && last <= 0) return root(0, duration_, end_);
    // The speed first falls from `begin` to `end`; every later minimum is higher.
    double begin = 0, end = damped_.turn(a_, rise_);
    if (rises) begin = std::exchange(end, end + damped_.half_period());
    if (!(begin < duration_)) return never;
    const Progress there = end < duration_ ? at(end) : end_;
    return there.speed > 0 ? never : root(begin, std::min(end, duration_), there);
  }

  Progress at(double t) const noexcept { return soon_ ? expanded().at(t / duration_) : progress(damped_.basis(t)); }
  Progress at_horizon() const noexcept { return end_; }

  /// Work on the damper up to time t [m^2/s^2].
  double damped_work(double t) const noexcept {
    return damped_.damping() *
           (soon_ && !damped_.usual(t) ? expanded().square(t / duration_) : damped_.square(t).of(u_, q_, s_));
  }

 private:
  /// The speed as a power series, for time in units of the duration: v'' = rise - c v' - wn^2 (v - u).
  struct Expansion {
    static constexpr int terms = 20;  // the last is below round-off, as (c + wn) t <= 1
    double duration;
    double v[terms];

    Progress at(double part) const noexcept {
      double speed = v[terms - 1], slope = 0, distance = speed * (1.0 / terms), mean = distance * (1.0 / (terms + 1));
      for (int k = terms - 2; k >= 0; --k) {
        const double way = v[k] * series::reciprocal[k + 1];
        slope = slope * part + speed;
        speed = speed * part + v[k];
        distance = distance * part + way;
        mean = mean * part + way * series::reciprocal[k + 2];
      }
      return {distance * part * duration, speed, slope / duration, mean * part * duration};
    }

    /// The integral of v^2, by 8-point Gauss-Legendre quadrature with a relative error of 1e-18. The series is
    /// evaluated at all points in parallel.
    double square(double part) const noexcept {
      constexpr const auto& rule = numerics::gauss_legendre<8>;
      double value[8];
      for (double& sum : value) sum = v[terms - 1];
      for (int k = terms - 2; k >= 0; --k)
        for (std::size_t i = 0; i < 8; ++i) value[i] = value[i] * (part * rule.nodes[i]) + v[k];
      double sum = 0;
      for (std::size_t i = 0; i < 8; ++i) sum += rule.weights[i] * value[i] * value[i];
      return part * duration * sum;
    }
  };

  const Expansion& expanded() const noexcept {
    if (detail::equal(expansion_.duration, duration_)) return expansion_;
    expansion_.duration = duration_;
    double* const v = expansion_.v;
    const double y = damped_.damping() * duration_, z = damped_.stiffness() * duration_ * duration_;
    v[0] = u_;
    v[1] = a_ * duration_;
    v[2] = (rise_ * duration_ * duration_ - y * v[1]) / 2;
    for (int k = 1; k + 2 < Expansion::terms; ++k)
      v[k + 2] = -(y * v[k + 1] + z * v[k] * series::reciprocal[k + 1]) * series::reciprocal[k + 2];
    return expansion_;
  }

  Progress progress(const DampedBasis& b) const noexcept {
    return {b.distance(u_, q_, s_), b.velocity(u_, q_, s_), a_ * b.decay + rise_ * b.impulse,
            b.duration > 0 ? b.integral_of_distance(u_, q_, s_) / b.duration : 0};
  }

  // The only zero of the speed between `low` and `high`, where the speed has fallen to `last` <= 0. Newton's method,
  // kept within the bracket; the slope is available without further evaluation. The first guess is the zero of a
  // parabola through both ends.
  double root(double low, double high, const Progress& last) const noexcept {
    if (detail::equal(last.speed, 0)) return high;
    const double h = high - low, fall = last.acceleration * h, first = low > 0 ? at(low).speed : u_;
    double t = high - h * first_root(-last.speed, fall, -2 * (first - last.speed + fall));
    for (int i = 0; i < 200; ++i) {
      if (!(t > low && t < high)) t = low + (high - low) / 2;
      if (!(t > low && t < high)) return high;
      const Progress there = at(t);
      if (detail::equal(there.speed, 0)) return t;
      (there.speed > 0 ? low : high) = t;
      const double next = t - there.speed / there.acceleration;
      if (std::abs(next - t) <= 0x1p-52 * t) return t;
      t = next;
    }
    return t;
  }

  const Damped& damped_;
  double u_, a_, q_, s_, rise_, duration_;
  bool soon_;
  mutable Expansion expansion_{0, {}};  // computed on first use
  Progress end_;
};

inline DampedFlow Damped::flow(const Start& start, double duration) const noexcept { return {*this, start, duration}; }

}  // namespace stickslip
