// The motion of a slender block about one corner.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "stickslip/base/equal.hpp"
#include "stickslip/base/units.hpp"
#include "stickslip/flow/closed_form.hpp"
#include "stickslip/flow/power_series.hpp"
#include "stickslip/numerics/gauss_legendre.hpp"
#include "stickslip/numerics/root.hpp"
#include "stickslip/rocking/slender_block.hpp"
#include "stickslip/rocking/state.hpp"

namespace stickslip::detail {

/// The ground under a block during a segment, linear in time.
struct RockingSegment {
  double duration;                // [s]
  double n_start, n_end;          // horizontal ground acceleration [m/s^2]
  double heavy_start, heavy_end;  // G = g + a_z [m/s^2]
  bool still = false;             // the ground does not move, nor will it ever again

  double n(double time) const noexcept { return at(n_start, n_end, time); }
  double heavy(double time) const noexcept { return at(heavy_start, heavy_end, time); }

 private:
  double at(double first, double last, double time) const noexcept {
    return time < duration ? first + (last - first) * (time / duration) : last;
  }
};

inline double sign(RockingMode mode) noexcept { return static_cast<double>(static_cast<int>(mode)); }
inline double alpha_of(const SlenderBlock& block, RockingMode mode) noexcept {
  return mode == RockingMode::left ? block.alpha_left() : block.alpha_right();
}

/// sinh(Pt)/P, (cosh(Pt) - 1)/P^2 and t - sinh(Pt)/P, without cancellation.
struct HyperbolicSums {
  constexpr HyperbolicSums() noexcept : first(0), second(0), third(0), cosh(1) {}
  HyperbolicSums(double p, double t) noexcept {
    const double x = p * t;
    double half;  // sinh(x/2)
    if (x < 1) {
      const double square = x * x;
      third = -t * square * excess<19>(square);
      first = t - third;
      half = x / 2 * (1 + square / 4 * excess<17>(square / 4));
    } else {
      first = std::sinh(x) / p;
      third = t - first;
      half = std::sinh(x / 2);
    }
    second = 2 * half * half / (p * p);
    cosh = 1 + 2 * half * half;
  }

  double first, second, third, cosh;

 private:
  // (sinh(x)/x - 1)/x^2 = 1/3! + x^2/5! + ... + x^(last - 3)/last!
  template <int last>
  static double excess(double square) noexcept {
    double sum = 1;
    for (int k = last; k > 3; k -= 2) sum = 1 + sum * (square * (1.0 / (k * (k - 1))));
    return sum / 6;
  }
};

/// The sums at the time last asked for: a record has one time step, and of a leg several things are asked at its end.
class LastSums {
 public:
  const HyperbolicSums& operator()(double p, double t) noexcept {
    if (!equal(t, t_) || !equal(p, p_)) {
      sums_ = {p, t};
      p_ = p;
      t_ = t;
    }
    return sums_;
  }

 private:
  double p_ = 0, t_ = 0;
  HyperbolicSums sums_{};
};

struct RockingPlace {
  double rotation, rate;
};

/// The motion about a corner from a start, theta(0) = theta0 and theta'(0) = w0, under a constant G:
///     theta = theta0 + w0 S1 + a0 S2 + c1 S3,   theta' = w0 cosh(Pt) + a0 S1 + c1 (1 - cosh(Pt)),
/// P = p sqrt(G/g), a0 = theta''(0), c1 = p^2 n'/(g P^2); S of HyperbolicSums. Near theta = 0 no other form keeps the digits of
/// a small bounce.
struct HyperbolicMotion {
  RockingPlace start;
  double a0, c1, p;

  RockingPlace at(const HyperbolicSums& s) const noexcept {
    return {start.rotation + (start.rate * s.first + a0 * s.second + c1 * s.third),
            start.rate * s.cosh + a0 * s.first - c1 * (p * p) * s.second};
  }
  /// Of theta - theta0 until the time of the sums.
  double integral_of_rotation(const HyperbolicSums& s, double t) const noexcept {
    return start.rate * s.second - a0 * s.third / (p * p) + c1 * (t * t / 2 - s.second);
  }
};

/// Work of a horizontal ground acceleration, n0 + n1 t, per unit moment of inertia about the corner: the integral of -p^2 n/g
/// theta'.
/// @param square              p^2/g
/// @param turned, integral    theta - theta0 at the time, and its integral until then
inline double work_of_ground(double square, double n0, double n1, double t, double turned, double integral) noexcept {
  return -square * ((n0 + t * n1) * turned - n1 * integral);
}

/// The motion about a corner from a start: a HyperbolicMotion under a constant G, and a power series under one that is linear in
/// time.
class RockingLeg {
 public:
  using Place = RockingPlace;

  /// @param begin  since the beginning of the segment [s]
  /// @param tilt   s alpha; 0 for the variation of a motion with the scale of the ground motion
  /// @param sums   those of the legs of one run; must outlive the leg
  RockingLeg(const SlenderBlock& block, const RockingSegment& ground, double begin, const Place& start, double tilt,
             LastSums& sums)
      : RockingLeg(block, ground, begin, start, tilt, sums,
                   block.p() * block.p() / standard_gravity *
                       (ground.heavy(begin) * (start.rotation - tilt) - ground.n(begin))) {}
  /// @param acceleration  theta'' at the start, known
  RockingLeg(const SlenderBlock& block, const RockingSegment& ground, double begin, const Place& start, double tilt,
             LastSums& sums, double acceleration)
      : sums_(&sums),
        start_(start),
        duration_(ground.duration - begin),
        a0_(acceleration),
        square_(block.p() * block.p() / standard_gravity),
        n0_(ground.n(begin)),
        heavy0_(ground.heavy(begin)),
        tilt_(tilt) {
    if (ground.duration > 0) {
      n1_ = (ground.n_end - ground.n_start) / ground.duration;
      heavy1_ = (ground.heavy_end - ground.heavy_start) / ground.duration;
    }
    if (equal(heavy1_, 0)) {
      p_ = std::sqrt(square_ * heavy0_);
      c1_ = n1_ / heavy0_;
    } else {
      expand();
    }
  }

  double duration() const noexcept { return duration_; }
  const Place& start() const noexcept { return start_; }
  double side() const noexcept { return tilt_ > 0 ? 1 : -1; }

  Place at(double t) const noexcept {
    if (order_ > 0) {
      const double u = t / duration_;
      double value = 0, slope = 0;
      for (int k = order_; k > 0; --k) {
        slope = slope * u + k * series_[static_cast<std::size_t>(k)];
        value = (value + series_[static_cast<std::size_t>(k)]) * u;
      }
      return {start_.rotation + value, slope / duration_};
    }
    return hyperbolic().at((*sums_)(p_, t));
  }
  /// theta'' where it is at a time.
  double acceleration(double rotation, double t) const noexcept {
    return equal(t, 0) ? a0_ : square_ * ((heavy0_ + t * heavy1_) * (rotation - tilt_) - n0_ - t * n1_);
  }

  /// When theta passes zero; `never` if it does not until the end.
  /// @param end  where it is then
  double impact(const Place& end) const {
    const double s = tilt_ > 0 ? 1 : -1;
    if (order_ > 0) {
      Polynomial room{};
      room[0] = s * start_.rotation;
      for (int k = 1; k <= order_; ++k) room[static_cast<std::size_t>(k)] = s * series_[static_cast<std::size_t>(k)];
      int leading = 0;
      while (leading <= order_ && equal(room[static_cast<std::size_t>(leading)], 0)) ++leading;
      if (leading > order_) return never;
      if (room[static_cast<std::size_t>(leading)] < 0) return 0;
      const double part = FirstRoot(room.data() + leading, order_ - leading).find();
      return part < never ? part * duration_ : never;
    }
    if (s * end.rotation > 0) {
      const double first = s * a0_, last = s * acceleration(end.rotation, duration_);
      if (first <= 0 && last <= 0) return never;  // concave
      const double from = s * start_.rate, to = s * end.rate;
      if (from <= 0 && to <= 0 && !(first > 0 && last < 0)) return never;  // monotone
      if (from >= 0 && to >= 0 && !(first < 0 && last > 0)) return never;
    }
    // theta is monotone between its turning points.
    double begin = 0, before = s * start_.rotation;
    for (const double turn : turning_points()) {
      const double until = turn < duration_ ? turn : duration_;
      const double after = s * (turn < duration_ ? at(until).rotation : end.rotation);
      if (!(after > 0) && (before > 0 || begin > 0)) return zero(s, begin, before, until);
      if (!(after > 0) && !(before > 0) && !leaves(s)) return 0;
      if (!(turn < duration_)) break;
      begin = until;
      before = after;
    }
    return never;
  }

  /// Where the rate vanishes within the leg, in order, and then never: at most twice under a constant G.
  std::array<double, 3> turning_points() const noexcept {
    const std::array<double, 2> times = zeros(start_.rate - 2 * c1_, a0_ / p_, start_.rate);
    std::array<double, 3> turns{never, never, never};
    std::size_t count = 0;
    for (const double t : times)
      if (t < duration_) turns[count++] = t;
    return turns;
  }
  /// Call `use(place, time)` where the rate vanishes.
  /// @param until, end  a time, and the place then
  template <class Use>
  void for_each_turn(double until, const Place& end, Use&& use) const {
    const double first = a0_, last = acceleration(end.rotation, until);
    if (start_.rate * end.rate > 0 && first * last >= 0) return;
    if (order_ == 0) {
      for (const double t : turning_points())
        if (t < until) use(at(t), t);
      return;
    }
    // The rate is monotone on both sides of the zero of the acceleration.
    double middle = until;
    Place there = end;
    if (first * last < 0) {
      middle = numerics::root([&](double t) { return acceleration(at(t).rotation, t); }, 0.0, first, until, last);
      there = at(middle);
    }
    const auto turn_between = [&](double from, double w, double to, double w_then) {
      if (!(w * w_then < 0)) return;
      const double t = numerics::root([&](double time) { return at(time).rate; }, from, w, to, w_then);
      use(at(t), t);
    };
    turn_between(0, start_.rate, middle, there.rate);
    if (middle < until) turn_between(middle, there.rate, until, end.rate);
  }

  /// Work of the ground until a time, per unit moment of inertia about the corner: the integral of -p^2 n/g theta', and of
  /// p^2 (G/g - 1)(theta - s alpha) theta'.
  double input(const Place& end, double t) const noexcept {
    const double integral = integral_of_rotation(t);  // of theta - theta0
    double work = work_of_ground(square_, n0_, n1_, t, end.rotation - start_.rotation, integral);
    const double first = heavy0_ - standard_gravity, last = first + t * heavy1_;
    if (!equal(first, 0) || !equal(last, 0)) {
      const auto potential = [&](double theta) { return theta * (theta / 2 - tilt_); };
      work += square_ * (last * potential(end.rotation) - first * potential(start_.rotation));
      if (!equal(heavy1_, 0)) work -= square_ * heavy1_ * integral_of_potential(t);
    }
    return work;
  }

 private:
  HyperbolicMotion hyperbolic() const noexcept { return {start_, a0_, c1_, p_}; }

  static constexpr int highest = 24;
  using Polynomial = std::array<double, highest + 1>;

  bool leaves(double s) const noexcept {
    if (!equal(start_.rate, 0)) return s * start_.rate > 0;
    if (!equal(a0_, 0)) return s * a0_ > 0;
    return s * c1_ < 0;  // S3 is negative
  }

  // The times t > 0, in order, at which a tau^2 + 2 b tau + c = 0, tau = tanh(Pt/2); `never` where there is none.
  std::array<double, 2> zeros(double a, double b, double c) const noexcept {
    std::array<double, 2> tau{never, never};
    const double square = b * b - a * c;
    if (square >= 0) {
      const double q = -(b + std::copysign(std::sqrt(square), b));
      if (!equal(a, 0)) tau[0] = q / a;
      if (!equal(q, 0)) tau[1] = c / q;
    }
    for (double& one : tau) one = one > 0 && one < 1 ? 2 * std::atanh(one) / p_ : never;
    if (tau[1] < tau[0]) std::swap(tau[0], tau[1]);
    return tau;
  }

  // Where theta, monotone from a time at which s theta > 0, passes zero: by Newton's method, from where it would without
  // the change of the load.
  double zero(double s, double from, double before, double until) const {
    if (!(before > 0)) return until;  // it begins at zero and leaves: a little later it is above
    double low = from, high = until, t = until;
    for (const double near : zeros(2 * a0_ / (p_ * p_) - start_.rotation, start_.rate / p_, start_.rotation))
      if (near > low && near < high) t = near;
    for (;;) {
      const Place place = hyperbolic().at(HyperbolicSums(p_, t));
      const double room = s * place.rotation, slope = s * place.rate;
      if (equal(room, 0)) return t;
      (room > 0 ? low : high) = t;
      double next = t - room / slope;
      if (!(next > low && next < high)) next = low + (high - low) / 2;
      if (std::abs(next - t) <= 0x1p-52 * t || equal(next, low) || equal(next, high)) return next;
      t = next;
    }
  }

  // theta - theta0 in powers of t / duration, for as long as the series takes.
  void expand() {
    const double p = std::sqrt(square_ * std::max(heavy0_, heavy0_ + heavy1_ * duration_));
    duration_ = std::min(duration_, 1 / p);
    const double h = duration_, g0 = square_ * heavy0_ * h * h, g1 = square_ * heavy1_ * h * h * h;
    series_[0] = 0;
    series_[1] = start_.rate * h;
    series_[2] = a0_ * h * h / 2;
    for (std::size_t k = 1; k + 2 <= highest; ++k) {
      double next = g0 * series_[k] + g1 * series_[k - 1];
      if (k == 1) next += g1 * (start_.rotation - tilt_) - square_ * n1_ * h * h * h;
      series_[k + 2] = next / static_cast<double>((k + 1) * (k + 2));
    }
    order_ = highest;
  }

  double integral_of_rotation(double t) const noexcept {
    if (order_ > 0) {
      const double u = t / duration_;
      double value = 0;
      for (int k = order_; k > 0; --k) value = (value + series_[static_cast<std::size_t>(k)] / (k + 1)) * u;
      return value * t;
    }
    return hyperbolic().integral_of_rotation((*sums_)(p_, t), t);
  }
  // Of theta^2/2 - s alpha theta.
  double integral_of_potential(double t) const noexcept {
    constexpr int points = 12;
    double sum = 0;
    for (int i = 0; i < points; ++i) {
      const double u = numerics::gauss_legendre<points>.nodes[static_cast<std::size_t>(i)];
      const double theta = at(u * t).rotation;
      sum += numerics::gauss_legendre<points>.weights[static_cast<std::size_t>(i)] * theta * (theta / 2 - tilt_);
    }
    return sum * t;
  }

  LastSums* sums_;
  Place start_;
  double duration_;     // [s]
  double a0_, c1_ = 0;  // theta'' at the start; p^2 n'/(g P^2)
  double p_ = 0;        // P [rad/s]
  double square_;       // p^2 / g
  double n0_, n1_ = 0;  // n at the start, and its rate
  double heavy0_, heavy1_ = 0;
  double tilt_;    // s alpha
  int order_ = 0;  // 0: hyperbolic
  Polynomial series_{};
};

}  // namespace stickslip::detail
