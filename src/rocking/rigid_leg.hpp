// The motion of a rigid block in one mode, as a power series in time.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

#include "numerics/each_root.hpp"
#include "rocking/leg.hpp"
#include "stickslip/base/equal.hpp"
#include "stickslip/base/error.hpp"
#include "stickslip/flow/closed_form.hpp"
#include "stickslip/flow/power_series.hpp"
#include "stickslip/rocking/rocking_block.hpp"
#include "stickslip/rocking/state.hpp"
#include "stickslip/series/series.hpp"

namespace stickslip::detail {

inline bool on_corner(RockingMode mode) noexcept { return mode == RockingMode::right || mode == RockingMode::left; }
/// The distance of a corner to the right of the center of mass [m].
/// @param side  +1 right, -1 left
inline double corner(const RockingBlock& block, double side) noexcept {
  return side > 0 ? block.right() : -block.left();
}

/// A vector [m].
struct Arm {
  double x, y;
};
/// From the center of mass to a corner.
inline Arm arm(const RockingBlock& block, double side, double rotation) noexcept {
  const double x = corner(block, side), h = block.center_height(), c = std::cos(rotation), s = std::sin(rotation);
  return {x * c - h * s, -x * s - h * c};
}

/// A block on the ground by a corner at which it slips: the part of the normal force that is known, N D = G + w^2 r_y, and
/// D = 1 + r_x (r_x + s mu r_y)/k^2.
inline double slip_denominator(const RockingBlock& block, const Arm& r, double slip) noexcept {
  return 1 + r.x * (r.x + slip * block.mu() * r.y) / block.gyration_square();
}

/// What is known of a leg where an event began it, and which round-off would spoil.
struct RigidStart {
  bool known_turn = false;  // theta'' is `turn`
  double turn = 0;
  bool smooth =
      false;  // what decides the event is continuous: the corner that starts to slip has no acceleration yet, nor
              // does what lifts off
  bool held = false;  // a corner that never slips is held by tension
  double lifts = 0;   // the corner that leaves the ground, +1 or -1; 2: both
};

/// A leg of a rigid block, about the start: theta and the displacement of what touches the ground (in flight that of the
/// center of mass), with the corner (r_x, r_y) from the center of mass,
///     r_x' = w r_y,   r_y' = -w r_x;
///     rock:        (k^2 + R^2) w' = r_y n - r_x G,   N = G - r_y'',   T = n - r_x''
///     slide-rock:  N = (G + w^2 r_y)/D,   k^2 w' = -(r_x + s mu r_y) N,   u' = -n - s mu N + r_x''
/// Times are in units of its duration, which is shortened until the series converges.
class RigidLeg {
 public:
  struct Place {
    double rotation, rate;
    double displacement, velocity;
    double rise, climb;
  };
  enum class Event { none, overturns, lands, sticks, slips_back, slips_ahead, lifts, lets_go, paradox };
  struct Next {
    double time = never;
    Event event = Event::none;
  };

  RigidLeg(const RockingBlock& block, const RockingSegment& ground, double begin, const RockingState& state,
           const RigidStart& how)
      : block_(block),
        mode_(state.mode),
        slip_(state.slip),
        start_(state),
        how_(how),
        duration_(ground.duration - begin) {
    n0_ = ground.n(begin);
    heavy0_ = ground.heavy(begin);
    if (ground.duration > 0) {
      n1_ = (ground.n_end - ground.n_start) / ground.duration;
      heavy1_ = (ground.heavy_end - ground.heavy_start) / ground.duration;
    }
    side_ = on_corner(mode_) ? detail::sign(mode_) : state.rotation < 0 ? -1 : 1;
    r_ = arm(block, side_, state.rotation);
    if (on_corner(mode_)) {
      const double square = r_.x * r_.x + r_.y * r_.y;
      const double heaviest = std::max(std::abs(heavy0_), std::abs(heavy0_ + heavy1_ * duration_)) +
                              std::max(std::abs(n0_), std::abs(n0_ + n1_ * duration_));
      duration_ = std::min(duration_, std::sqrt((block.gyration_square() + square) / (heaviest * std::sqrt(square))));
    }
    if (mode_ != RockingMode::slide && !equal(state.rate, 0)) duration_ = std::min(duration_, 1 / std::abs(state.rate));
    const double asked = duration_;
    for (double part; (part = expand()) < 1;) {
      duration_ *= part;
      if (!(duration_ > 0x1p-100 * asked) && asked > 0) refuse();
    }
  }

  double duration() const noexcept { return duration_; }
  double side() const noexcept { return side_; }
  bool slips() const noexcept { return slip_ != 0; }
  bool rocks() const noexcept { return turns_; }
  double begins_at() const noexcept { return start_.displacement; }  ///< of the displacement [m]

  Place at(double t) const noexcept {
    const double s = duration_ > 0 ? t / duration_ : 0, per = duration_ > 0 ? 1 / duration_ : 0;
    Place place{start_.rotation, start_.rate, start_.displacement, start_.velocity, start_.rise, start_.climb};
    if (!(s > 0)) return place;
    if (turns_) {
      place.rotation += sum(theta_, order_ + 1, s);
      place.rate = slope(theta_, order_ + 1, s) * per;
    }
    if (moves_) {
      place.displacement += sum(way_, way_order_, s);
      place.velocity = slope(way_, way_order_, s) * per;
    }
    if (mode_ == RockingMode::flight) {
      place.rise += sum(rise_, 3, s);
      place.climb = slope(rise_, 3, s) * per;
    }
    return place;
  }

  /// The first event.
  Next next() const {
    Next first;
    double w[series::highest_order + 1];
    const auto root = [&](int degree) {
      int leading = 0;
      while (leading <= degree && equal(w[leading], 0)) ++leading;
      if (leading > degree) return never;
      const double part = w[leading] < 0 ? 0 : FirstRoot(w + leading, degree - leading).find();
      return part < never ? part * duration_ : never;
    };
    const auto look = [&](Event event, int degree) {
      if (const double time = root(degree); time < first.time) first = {time, event};
    };
    if (turns_) {
      const int degree = order_ + 1;
      const double way = on_corner(mode_) ? side_ : start_.rate > 0 ? 1 : -1;
      double most = 0;
      for (int k = 1; k <= degree; ++k) most += std::abs(theta_[k]);
      if (way * start_.rotation + most >= quarter_turn) {
        w[0] = quarter_turn - way * start_.rotation;
        for (int k = 1; k <= degree; ++k) w[k] = -way * theta_[k];
        look(Event::overturns, degree);
      }
      if (on_corner(mode_)) {
        w[0] = side_ * start_.rotation;
        for (int k = 1; k <= degree; ++k) w[k] = side_ * theta_[k];
        look(Event::lands, degree);
      }
    }
    if (mode_ == RockingMode::flight) {
      for (const double to : {1.0, -1.0}) {
        height(to, w);
        look(Event::lands, arm_order_);
      }
      return first;
    }
    if (slip_ != 0) {
      for (int k = 0; k < way_order_; ++k) w[k] = slip_ * (k + 1) * way_[k + 1];
      look(Event::sticks, way_order_ - 1);
      if (mode_ == RockingMode::slide) {
        w[0] = heavy0_;
        w[1] = heavy1_ * duration_;
        look(Event::lifts, 1);
      } else {
        for (int k = 0; k <= order_; ++k) w[k] = push_[k];
        look(Event::lifts, order_);
        if (block_.mu() >= block_.painleve_friction()) {
          for (int k = 0; k <= order_; ++k) w[k] = denominator_[k];
          look(Event::paradox, order_);
        }
      }
    } else {
      // N and T times the square of the duration.
      double push[series::highest_order + 1], across[series::highest_order + 1];
      const double square = duration_ * duration_;
      const int degree = order_;
      for (int k = 0; k <= degree; ++k) {
        push[k] = -(k + 1) * (k + 2) * y_[k + 2];
        across[k] = -(k + 1) * (k + 2) * x_[k + 2];
      }
      push[0] += square * heavy0_;
      across[0] += square * n0_;
      if (degree > 0) {
        push[1] += square * duration_ * heavy1_;
        across[1] += square * duration_ * n1_;
      }
      if (block_.mu() < never) {
        for (const double to : {-1.0, 1.0}) {
          for (int k = 0; k <= degree; ++k) w[k] = block_.mu() * push[k] + to * across[k];
          const double largest = std::abs(block_.mu() * push[0]) + std::abs(across[0]);
          if (w[0] < 8 * round_off * largest) w[0] = 0;  // it has just been found to stick
          look(to < 0 ? Event::slips_back : Event::slips_ahead, degree);
        }
      } else if (push[0] > 0 && !how_.held) {
        for (int k = 0; k <= degree; ++k) w[k] = push[k];
        look(Event::lets_go, degree);
      }
    }
    return first;
  }

  /// Call `use(rotation, time)` where the rate vanishes.
  template <class Use>
  void for_each_turn(double until, Use&& use) const {
    if (!turns_ || mode_ == RockingMode::flight || !(duration_ > 0)) return;
    double w[series::highest_order + 1];
    for (int k = 0; k <= order_; ++k) w[k] = (k + 1) * theta_[k + 1];
    for_each_root(w, order_, [&](double part) {
      const double t = part * duration_;
      if (t < until) use(at(t).rotation, t);
    });
  }
  /// The largest |theta| cannot exceed this [rad].
  double bound() const noexcept {
    double most = std::abs(start_.rotation);
    if (turns_)
      for (int k = 1; k <= order_ + 1; ++k) most += std::abs(theta_[k]);
    return most;
  }

  /// Work of the ground until a time, per unit mass [m^2/s^2]: the integral of -n X' - a_z Y'.
  double input(double t) const noexcept {
    if (!(duration_ > 0)) return 0;
    const double s = t / duration_;
    double across = 0, across_mean = 0, up = 0, up_mean = 0;
    if (moves_) {
      across += sum(way_, way_order_, s);
      across_mean += mean(way_, way_order_, s);
    }
    if (on_corner(mode_)) {
      across -= sum(x_, arm_order_, s);
      across_mean -= mean(x_, arm_order_, s);
      up -= sum(y_, arm_order_, s);
      up_mean -= mean(y_, arm_order_, s);
    } else if (mode_ == RockingMode::flight) {
      up += sum(rise_, 3, s);
      up_mean += mean(rise_, 3, s);
    }
    const double lift = heavy0_ - standard_gravity;
    return -((n0_ + n1_ * t) * across - n1_ * t * across_mean) - ((lift + heavy1_ * t) * up - heavy1_ * t * up_mean);
  }

  /// Work against friction until a time [m^2/s^2].
  double friction(double t) const noexcept {
    if (slip_ == 0 || !(duration_ > 0)) return 0;
    const double s = t / duration_, mu = block_.mu();
    if (mode_ == RockingMode::slide)
      return slip_ * mu *
             ((heavy0_ + heavy1_ * t) * sum(way_, way_order_, s) - heavy1_ * t * mean(way_, way_order_, s));
    double work = 0, force[series::highest_order + 1], power = 1;
    for (int i = 0; i <= order_; ++i, power *= s) force[i] = power * push_[i];
    power = s;
    for (int k = 1; k <= way_order_; ++k, power *= s) {
      double inner = 0;
      for (int i = 0; i <= order_; ++i) inner += force[i] * series_reciprocal(i + k);
      work += k * way_[k] * power * inner;
    }
    return slip_ * mu * work / (duration_ * duration_);
  }

 private:
  static constexpr int highest = 26;
  static constexpr double round_off = std::numeric_limits<double>::epsilon();
  static constexpr double quarter_turn = std::numbers::pi / 2;

  static double series_reciprocal(int k) noexcept {
    static constexpr auto table = [] {
      struct {
        double of[2 * series::highest_order + 2];
      } all{};
      for (int i = 1; i < 2 * series::highest_order + 2; ++i) all.of[i] = 1.0 / i;
      return all;
    }();
    return table.of[k];
  }

  // Sums from order 1 on: the change since the start.
  static double sum(const double* c, int order, double s) noexcept {
    double value = 0;
    for (int k = order; k > 0; --k) value = (value + c[k]) * s;
    return value;
  }
  static double slope(const double* c, int order, double s) noexcept {
    double value = 0;
    for (int k = order; k > 0; --k) value = value * s + k * c[k];
    return value;
  }
  // The mean of the change over the time since the start.
  static double mean(const double* c, int order, double s) noexcept {
    double value = 0;
    for (int k = order; k > 0; --k) value = (value + c[k] * series_reciprocal(k + 1)) * s;
    return value;
  }

  // The height of a corner in flight.
  void height(double to, double* w) const noexcept {
    double x[series::highest_order + 1], y[series::highest_order + 1];
    const Arm r = arm(block_, to, start_.rotation);
    x[0] = r.x, y[0] = r.y;
    for (int k = 0; k < arm_order_; ++k) {
      x[k + 1] = theta_[1] * y[k] / (k + 1);
      y[k + 1] = -theta_[1] * x[k] / (k + 1);
    }
    for (int k = 0; k <= arm_order_; ++k) w[k] = y[k] + (k <= 3 ? rise_[k] : 0);
    const double half = std::sin(start_.rotation / 2), h = block_.center_height();
    w[0] = start_.rise + 2 * h * half * half - corner(block_, to) * std::sin(start_.rotation);
    if (!(equal(how_.lifts, 2) || equal(how_.lifts, to))) return;
    w[0] = w[1] = 0;
    if (how_.smooth) w[2] = 0;
  }

  // The coefficients. Returns 1, or the part of the duration over which they converge.
  double expand() {
    const double h = duration_, square = h * h, mu = block_.mu();
    turns_ = moves_ = false;
    if (mode_ == RockingMode::slide) {
      moves_ = true;
      way_order_ = 3;
      const double now = how_.smooth ? 0 : -n0_ - slip_ * mu * heavy0_;
      way_[0] = 0;
      way_[1] = h * start_.velocity;
      way_[2] = square * now / 2;
      way_[3] = square * h * (-n1_ - slip_ * mu * heavy1_) / 6;
      return 1;
    }
    if (mode_ == RockingMode::flight) {
      moves_ = true;
      way_order_ = 3;
      way_[1] = h * start_.velocity;
      way_[2] = -square * n0_ / 2;
      way_[3] = -square * h * n1_ / 6;
      rise_[0] = start_.rise;
      rise_[1] = h * start_.climb;
      rise_[2] = -square * heavy0_ / 2;
      rise_[3] = -square * h * heavy1_ / 6;
      order_ = 0;
      theta_[1] = h * start_.rate;
      turns_ = !equal(start_.rate, 0);
      arm_order_ = turns_ ? 24 : 3;
      return 1;
    }
    turns_ = true;
    moves_ = slip_ != 0;
    const double k_square = block_.gyration_square();
    const double distance = r_.x * r_.x + r_.y * r_.y, per_inertia = 1 / (k_square + distance), per_k = 1 / k_square;
    const double per_radius = 1 / std::sqrt(distance);
    const double n[2] = {square * n0_, square * h * n1_}, heavy[2] = {square * heavy0_, square * h * heavy1_};
    double w[series::highest_order + 1];  // theta' times the duration
    double turned[series::highest_order + 1], lever[series::highest_order + 1];
    w[0] = h * start_.rate;
    theta_[0] = 0;
    theta_[1] = w[0];
    x_[0] = r_.x, y_[0] = r_.y;
    x_[1] = w[0] * y_[0], y_[1] = -w[0] * x_[0];
    way_[0] = 0;
    way_[1] = h * start_.velocity;
    double largest = std::abs(w[0]), per_denominator = 0;
    bool last = false;
    for (int k = 0; k + 2 <= highest; ++k) {
      const double by_next = series::reciprocal[k + 1], by_second = series::reciprocal[k + 2];
      double net;
      if (slip_ == 0) {
        net = y_[k] * n[0] - x_[k] * heavy[0];
        if (k > 0) net += y_[k - 1] * n[1] - x_[k - 1] * heavy[1];
        net *= per_inertia;
        if (k == 0 && how_.known_turn) net = square * how_.turn;
      } else {
        turned[k] = series::convolve(w, w, 0, k);
        lever[k] = x_[k] + slip_ * mu * y_[k];
        denominator_[k] = (k == 0 ? 1 : 0) + series::convolve(x_, lever, 0, k) * per_k;
        double known = series::convolve(turned, y_, 0, k) + (k < 2 ? heavy[k] : 0);
        if (k > 0)
          known -= series::convolve(denominator_, push_, 1, k);
        else
          per_denominator = 1 / denominator_[0];
        push_[k] = known * per_denominator;
        net = -series::convolve(lever, push_, 0, k) * per_k;
      }
      w[k + 1] = net * by_next;
      theta_[k + 2] = w[k + 1] * by_second;
      x_[k + 2] = series::convolve(w, y_, 0, k + 1) * by_second;
      y_[k + 2] = -series::convolve(w, x_, 0, k + 1) * by_second;
      double term = std::abs(w[k + 1]);
      if (slip_ != 0) {
        double speed = -slip_ * mu * push_[k] + (k + 2) * (k + 1) * x_[k + 2] - (k < 2 ? n[k] : 0);
        if (k == 0 && how_.smooth) speed = 0;
        way_[k + 2] = speed * by_next * by_second;
        term = std::max(term, std::abs(speed) * per_radius);
      }
      largest = std::max(largest, term);
      const double turns = std::max(std::abs(x_[k + 2]), std::abs(y_[k + 2])) * per_radius * (k + 2);
      const bool now = term <= small * largest && turns <= small;
      if (k >= 3 && now && last) {
        order_ = k;
        arm_order_ = way_order_ = k + 2;
        return 1;
      }
      last = now;
      if (k + 3 > highest) {
        const double over = std::max(term / largest, turns) / small;
        const double part = over < never ? std::pow(over, -1.0 / k) : 0.01;
        return std::min(std::max(part, 0.01), 0.75);
      }
    }
    return 0.5;
  }

  [[noreturn]] void refuse() const {
    throw ConvergenceError("the motion of the block has no finite power series at theta = " +
                           shortest(start_.rotation) + " rad, theta' = " + shortest(start_.rate) + " rad/s");
  }

  static constexpr double small = 2e-17;

  const RockingBlock& block_;
  RockingMode mode_;
  int slip_;
  RockingState start_;
  RigidStart how_;
  double duration_;  // [s]
  double n0_, n1_ = 0, heavy0_, heavy1_ = 0;
  double side_;
  Arm r_{};
  bool turns_ = false, moves_ = false;
  int order_ = 0, arm_order_ = 0, way_order_ = 0;
  // Coefficients: of theta and the displacement since the start, of the corner, and of N times the square of the duration.
  double theta_[series::highest_order + 1], way_[series::highest_order + 1], x_[series::highest_order + 1],
      y_[series::highest_order + 1], push_[series::highest_order + 1], denominator_[series::highest_order + 1],
      rise_[4];
};

}  // namespace stickslip::detail
