// The motion in the plane between two events.
#pragma once

#include <cmath>
#include <limits>
#include <utility>

#include "stickslip/base/equal.hpp"
#include "stickslip/base/min_max.hpp"
#include "stickslip/flow/closed_form.hpp"
#include "stickslip/flow/power_series.hpp"
#include "stickslip/friction/law.hpp"
#include "stickslip/numerics/root.hpp"
#include "stickslip/planar/detail/held_slip.hpp"
#include "stickslip/planar/vector.hpp"
#include "stickslip/series/series.hpp"
#include "stickslip/slider.hpp"
#include "stickslip/state.hpp"

namespace stickslip {

/// The load on a slider in the plane and its weight N+/g, both linear in time, from now on.
struct PlanarLoad {
  Vector2 start;           ///< p [m/s^2]
  Vector2 rate;            ///< its rate [m/s^3]
  double weight = 1;       ///< N+/g
  double weight_rate = 0;  ///< its rate [1/s]
};

/// How a planar flow starts: moving, or from rest, under a load that exceeds the level or is equal to it.
enum class PlanarStart : unsigned char { moving, above_level, at_level };

/// Flows after which it is worth trying whether the direction of a slip follows the load, and whether its speed does.
struct PlanarPatience {
  int direction = 0, speed = 0;
};

namespace detail {

/// The resistance of an isotropic law as a function of the path length and of the time since the start of a flow, and
/// of the speed.
template <class Law, class Path, class Speed, class Time>
auto level_along(const Law& law, const Path& path, const Speed& speed, const Time& time) {
  if constexpr (requires { law.resist_at(time, speed); })
    return law.resist_at(time, speed);
  else
    return resist(law, path, speed, Direction::forward);
}

}  // namespace detail

/// A slip in the plane,
///     r'' + w a r'/u + c r' + wn^2 r = p(t),   u = |r'|,
/// in which p and the weight w = N+/g are linear in time, and a may depend on u and on the path length. Friction turns
/// with the velocity: as a function of time the motion has a singularity wherever u nearly vanishes. It has none as a
/// function of the regularized time that obeys dt = u d(tau),
///     t' = u,   r' = u v,   v' = u q - (w a + c u) v,   u' = q.v - (w a + c u) u,   q = p(t) - wn^2 r,
/// where a stop is at infinity. These equations are solved by power series in tau, which only need products. Under a
/// constant load their solutions are exponentials; a stop is closed by them as soon as the load no longer changes in
/// the time that is left.
///
/// From rest, tau begins at minus infinity. The motion is then a power series in time; where the load passes the level
/// smoothly, this series diverges (the start is an irregular singular point), and is used up to the time at which its
/// smallest term is below round-off.
/// @tparam Law  a law without memory, or one of time and speed, `resist_at(time, speed)`
template <class Law>
class PlanarFlow {
 public:
  static constexpr int highest_order = 28;

  /// Kept out of line, as TaylorFlow.
  /// @param mounting  spring, damper, pendulum
  /// @param law       as it applies from now on, a function of the path length and of the speed
  /// @param place     r at the start [m]
  /// @param velocity  r' at the start [m/s]; 0 only from rest
  /// @param start     the kind of start
  /// @param side      at a circular stop: 1 if it moves along the stop in the direction of the place turned clockwise,
  ///                  -1 if in the opposite one; it slides along the stop unless it leaves at once. Otherwise 0
  /// @param duration  for which the load is given [s], positive
  /// @param patience  updated
  [[gnu::noinline]] PlanarFlow(const Mounting& mounting, const Law& law, Vector2 place, Vector2 velocity,
                               PlanarStart start, int side, const PlanarLoad& load, double duration,
                               PlanarPatience& patience)
      : damping_(mounting.damping),
        stop_(mounting.stops.forward()),
        spring_(mounting.spring()),
        place_(place),
        velocity_(velocity),
        load_(load),
        duration_(duration) {
    if (side != 0 && move_along(law, side, start == PlanarStart::at_level)) {
      along_stop_ = true;
      return;
    }
    leaves_at_once_ = side != 0;
    if (start == PlanarStart::moving) {
      if (!close(law) && !hold(law) && !creep(law, patience.speed) && !follow(law, patience.direction)) move(law);
    } else {
      along_load(law, 0, start == PlanarStart::at_level);
    }
  }

  /// The time at which it stops [s], or `never` if it does not stop before the horizon.
  double stop() const noexcept { return stops_ ? end_.time : never; }
  /// Whether it does not stop but turns, in less time than can be resolved.
  bool turns() const noexcept { return turns_; }
  /// Whether it slides along a circular stop.
  bool along_stop() const noexcept { return along_stop_; }
  /// Whether it leaves a circular stop at the start.
  bool leaves_at_once() const noexcept { return leaves_at_once_; }
  /// Whether it leaves the stop along which it slides, at the horizon.
  bool leaves() const noexcept { return leaves_; }
  /// The time up to which the motion is known [s].
  double horizon() const noexcept { return end_.time; }
  PlanarProgress at_horizon() const noexcept { return end_; }
  /// r at the start [m].
  Vector2 place() const noexcept { return place_; }
  /// The largest value of the parameter.
  double last() const noexcept { return last_; }

  /// The progress at a parameter from 0 to `last()`: time, or regularized time.
  PlanarProgress at_parameter(double s) const noexcept {
    if (kind_ == Kind::stop) return closing_.at(1 - s, end_);
    if (kind_ == Kind::held) return detail::equal(s, last_) ? end_ : held_.at(s);
    return {value(t_, s), {value(x_, s), value(y_, s)}, {velocity_at(vx_, s), velocity_at(vy_, s)}, value(s_, s)};
  }

  /// r'' at a parameter [m/s^2]; at a stop, its limit there.
  Vector2 acceleration_at(double s) const noexcept {
    if (kind_ == Kind::held) return held_.acceleration(s);
    if (along_stop_) return (1 / slope(t_, s)) * Vector2{slope(vx_, s), slope(vy_, s)};
    // By its forces: near a stop the derivative of the velocity is the difference of large numbers.
    const bool stop = kind_ == Kind::stop;
    PlanarProgress at = at_parameter(s);
    if (stop) at.velocity = at_parameter(std::min(s, 1 - 0x1p-40)).velocity;  // of which the direction has a limit
    const double weight = load_.weight + load_.weight_rate * at.time, speed = norm(at.velocity);
    const Vector2 q = load_.start + at.time * load_.rate - spring_.under(weight) * (place_ + at.way);
    double level = stop ? closing_.level - damping_ * norm(velocity_) : 0;
    for (int k = stop ? -1 : order_ - 1; k >= 0; --k) level = level * s + l_[k];
    const double size = norm(q);
    const Vector2 direction = speed > 0 ? (1 / speed) * at.velocity : size > 0 ? (1 / size) * q : Vector2{};
    return q - level * direction - damping_ * at.velocity;
  }

  /// The parameter at a time from 0 to the horizon [s].
  double parameter(double time) const noexcept {
    if (!(time < end_.time)) return last_;
    if (!(time > 0)) return 0;
    if (kind_ == Kind::stop)
      return numerics::root([&](double s) { return at_parameter(s).time - time; }, 0, -time, 1, end_.time - time);
    if (kind_ == Kind::held) return std::min(held_.parameter(time), last_);
    double low = 0, high = last_, s = last_ * (time / end_.time);
    for (int steps = 0; steps < 64; ++steps) {
      double sum = 0, slope = 0;
      for (int k = order_; k >= 1; --k) slope = slope * s + sum, sum = sum * s + t_[k];
      slope = slope * s + sum;
      sum = sum * s - time;
      (sum < 0 ? low : high) = s;
      double next = s - sum / slope;
      if (std::abs(next - s) <= 0x1p-52 * s) return next;
      if (!(next > low && next < high)) next = low + (high - low) / 2;
      if (next <= low || next >= high) return s;
      s = next;
    }
    return s;
  }

  PlanarProgress at(double time) const noexcept {
    PlanarProgress progress = at_parameter(parameter(time));
    progress.time = std::min(time, end_.time);
    return progress;
  }

  /// The first parameter up to `until` at which the path reaches a distance [m] from its start; `never` if it does not.
  double parameter_at_distance(double distance, double until) const noexcept {
    if (!(distance_at(until) > distance)) return never;
    double low = 0, high = until;
    for (double s = until / 2;;) {
      (distance_at(s) < distance ? low : high) = s;
      const double next = low + (high - low) / 2;
      if (next <= low || next >= high) return high;
      s = next;
    }
  }
  double distance_at(double s) const noexcept { return is_series() ? value(s_, s) : at_parameter(s).distance; }

  /// The first parameter at which the path crosses a circle about the origin, outward or inward; `never` if it does
  /// not. A start on the circle is not counted.
  /// @param radius   [m]
  /// @param outward  whether the start is inside
  double parameter_at_radius(double radius, bool outward) const noexcept {
    const double from = norm(place_);
    if (outward ? from + end_.distance < radius * (1 - 0x1p-50) : from - end_.distance > radius * (1 + 0x1p-50))
      return never;
    if (kind_ == Kind::stop) {
      const double to = norm(place_ + end_.way);
      return (outward ? to > radius * (1 + 0x1p-50) : to < radius * (1 - 0x1p-50)) ? last_ : never;
    }
    const bool at_circle = std::abs(radius - from) <= 0x1p-48 * radius;
    Array room;
    const int degree = square_degree();
    double power = 1;
    const double sign = outward ? -1 : 1;
    for (int k = 0; k <= degree; ++k, power *= last_) {
      double terms = 0;
      const double square = square_of_distance(k, terms);
      // Along the circle, and where a slider leaves it, what is left of the first terms is round-off: also of the load,
      // which is the small difference of larger ones where its radial part changes sign.
      if (k == 2) terms += from * largest_load() * t_[1] * t_[1];
      room[k] =
          at_circle && (k < 4 || leaves_at_once_) && std::abs(square) <= graze * terms ? 0 : sign * power * square;
    }
    room[0] = at_circle ? 0 : sign * (from - radius) * (from + radius);
    if (at_circle && leaves_at_once_)  // what says otherwise is round-off
      for (int k = 0; k < degree && !(room[k] > 0); ++k) room[k] = 0;
    const double part = first_zero(room, degree);
    return part < never ? part * last_ : never;
  }

  /// The largest distance from the origin up to a parameter [m], where it may exceed `peak`; otherwise any value that
  /// is not larger. `where` receives its parameter.
  double largest_radius(double until, double peak, double& where) const noexcept {
    const double from = norm(place_);
    if (from + end_.distance <= peak) return 0;
    if (kind_ == Kind::held) return held_.largest_radius(place_, until, where);
    const auto radius = [&](double s) { return norm(place_ + at_parameter(s).way); };
    where = until;
    double largest = radius(until);
    if (kind_ == Kind::stop) {
      // A slip may turn sharply on its last way.
      double tau = 0;
      const double reached = closing_.slip().largest_radius(place_, closing_.slip().parameter(never), tau);
      if (reached > largest) largest = reached, where = -std::expm1(-(closing_.level + closing_.load) * tau);
      return largest;
    }
    // Where |r|^2 stops growing. After each such zero the search continues where it grows again.
    Array square, growth;
    const int degree = square_degree() - 1;
    double power = until;
    for (int k = 1; k <= degree + 1; ++k, power *= until) {
      double terms = 0;
      growth[k - 1] = k * power * square_of_distance(k, terms);
    }
    double begin = 0, sign = 1;
    for (int turns = 0; turns < 2 * highest_order && begin < 1; ++turns) {
      // The polynomial in z, with s = begin + (1 - begin) z.
      for (int k = 0; k <= degree; ++k) square[k] = sign * growth[k];
      for (int i = 0; i < degree; ++i)
        for (int k = degree - 1; k >= i; --k) square[k] += begin * square[k + 1];
      double scale = 1;
      for (int k = 0; k <= degree; ++k, scale *= 1 - begin) square[k] *= scale;
      int leading = turns > 0 ? 1 : 0;  // the zero at which it starts
      while (leading < degree && detail::equal(square[leading], 0)) ++leading;
      if (leading == degree && !(std::abs(square[leading]) > 0)) break;
      if (square[leading] < 0) {
        sign = -sign;
        for (int k = leading; k <= degree; ++k) square[k] = -square[k];
      }
      const double z = leading < degree ? FirstRoot(square + leading, degree - leading).find() : never;
      if (!(z < 1)) break;
      begin += (1 - begin) * z;
      if (sign > 0) {
        const double there = radius(begin * until);
        if (there > largest) largest = there, where = begin * until;
      }
      sign = -sign;
    }
    return largest;
  }

  bool is_series() const noexcept { return kind_ == Kind::series; }
  int order() const noexcept { return order_; }
  /// Coefficients of the displacement since the start, of order 1 to `order()`.
  const double* axis() const noexcept { return x_; }
  const double* transverse() const noexcept { return y_; }

  /// The work up to a parameter.
  detail::PlanarWork work(double s) const noexcept {
    const PlanarProgress to = at_parameter(s);
    detail::PlanarWork work{dot(load_.start, to.way), 0, 0};
    // The spring of a pendulum does work against the deviation of the weight from 1.
    if (spring_.pendulum) work.load += spring_.rate(1 - load_.weight) * (dot(place_, to.way) + dot(to.way, to.way) / 2);
    if (kind_ == Kind::stop) {
      work.load += dot(load_.rate, to.way) * to.time / 3;
      work.friction = level_ * to.distance;
      work.damper = damping_ * to.distance * norm(velocity_) * 2 / 3;
      return work;
    }
    if (constant_level_) work.friction = level_ * to.distance;
    if (kind_ == Kind::held) return work;
    const bool weighed = spring_.pendulum && !detail::equal(load_.weight_rate, 0);
    const int degree = square_degree();
    Array energy;  // of the spring, per stiffness
    if (weighed) {
      for (int k = 1; k <= degree; ++k) {
        double terms = 0;
        energy[k] = square_of_distance(k, terms) / 2;
      }
    }
    // Integrals of products with the derivatives of the path.
    double power = s;
    for (int k = 1; k <= degree; ++k, power *= s) {
      double load = 0, friction = 0, damper = 0;
      if (weighed)
        for (int i = 0; i < std::min(k, order_); ++i)
          load -= (k - i) * t_[i] * load_.weight_rate * spring_.stiffness * energy[k - i];
      for (int i = std::max(0, k - order_); i < std::min(k, order_); ++i) {
        const int rest = k - i;
        load += rest * t_[i] * (load_.rate.axis * x_[rest] + load_.rate.transverse * y_[rest]);
        if (!constant_level_) friction += rest * l_[i] * s_[rest];
        damper += rest * u_[i] * s_[rest];
      }
      const double share = power * series::reciprocal[k];
      work.load += load * share;
      work.friction += friction * share;
      work.damper += damping_ * damper * share;
    }
    return work;
  }

 private:
  // The last moments of a stop under a constant load. In tau, u + v_q, v_q - u and the velocity across the load decay
  // exponentially, at the rates w a - Q, w a + Q and w a.
  struct Closing {
    Vector2 to;                  // direction of the load
    double level, load;          // w a and Q [m/s^2]
    double plus, minus, across;  // u + v_q, u - v_q, and the velocity across [m/s]

    detail::HeldSlip slip() const noexcept { return {to, level, load, plus, minus, across}; }

    // What is left from the time on at which u - v_q has decayed to a fraction g. Without friction the velocity only
    // reverses: u + v_q is then 0.
    PlanarProgress to_stop(double g) const noexcept {
      const double slow = level - load, fast = level + load;
      const double p = plus > 0 ? plus * std::pow(g, slow / fast) : 0, m = minus * g,
                   c = across * std::pow(g, level / fast);
      const double along = ((p > 0 ? p * p / slow : 0) - m * m / fast) / 8;
      const double aside = c * ((p > 0 ? p / (level + slow) : 0) + m / (level + fast)) / 2;
      PlanarProgress left;
      left.time = ((p > 0 ? p / slow : 0) + m / fast) / 2;
      left.way = along * to + aside * turned(to);
      left.velocity = ((p - m) / 2) * to + c * turned(to);
      left.distance = ((p > 0 ? p * p / slow : 0) + m * m / fast) / 8 + (p > 0 ? p * m / (4 * level) : 0);
      return left;
    }
    PlanarProgress at(double g, const PlanarProgress& end) const noexcept {
      const PlanarProgress left = to_stop(g);
      return {end.time - left.time, end.way - left.way, left.velocity, end.distance - left.distance};
    }
  };
  enum class Kind : unsigned char { series, held, stop };
  using Array = double[highest_order + 2];
  struct Four {
    double of[4];
  };

  // Products of four series at a time, in one loop that a compiler can put into vectors.
  static Four convolve(const double* a, const Four* b, int k) noexcept {
    Four even{}, odd{};
    int i = 0;
    for (; i + 1 <= k; i += 2)
      for (int j = 0; j < 4; ++j) {
        even.of[j] += a[i] * b[k - i].of[j];
        odd.of[j] += a[i + 1] * b[k - i - 1].of[j];
      }
    for (int j = 0; j < 4; ++j) even.of[j] += (i <= k ? a[k] * b[0].of[j] : 0) + odd.of[j];
    return even;
  }
  static Four convolve(const Four* a, const Four* b, int k) noexcept {
    Four even{}, odd{};
    int i = 0;
    for (; i + 1 <= k; i += 2)
      for (int j = 0; j < 4; ++j) {
        even.of[j] += a[i].of[j] * b[k - i].of[j];
        odd.of[j] += a[i + 1].of[j] * b[k - i - 1].of[j];
      }
    for (int j = 0; j < 4; ++j) even.of[j] += (i <= k ? a[k].of[j] * b[0].of[j] : 0) + odd.of[j];
    return even;
  }

  // Sum of c_k s^k from k = 1.
  double value(const double* c, double s) const noexcept {
    double odd = 0, even = 0;
    const double z = s * s;
    for (int k = order_ | 1; k >= 1; k -= 2) odd = odd * z + c[k];
    for (int k = order_ & ~1; k >= 2; k -= 2) even = even * z + c[k];
    return s * odd + z * even;
  }
  double velocity_at(const double* c, double s) const noexcept { return c[0] + value(c, s); }
  // Its derivative.
  double slope(const double* c, double s) const noexcept {
    double sum = 0;
    for (int k = order_; k >= 1; --k) sum = sum * s + k * c[k];
    return sum;
  }

  // A bound on the load during the segment [m/s^2].
  double largest_load() const noexcept { return norm(load_.start) + norm(load_.rate) * duration_; }

  Vector2 pull() const noexcept { return spring_.under(load_.weight) * place_; }

  void end_series(int order) noexcept {
    order_ = order;
    for (double* c : {t_, x_, y_, s_, u_, vx_, vy_}) c[order + 1] = 0;
  }

  // Shorten a series until its level is that of the law at its end: a high power of the speed may only act in terms
  // that were cut.
  void keep_to(const Law& law) noexcept {
    constexpr double exact = heated ? level_error : 0x1p-47;
    for (int halvings = 0; halvings < 60; ++halvings, last_ /= 2) {
      double level = 0;
      for (int k = order_ - 1; k >= 0; --k) level = level * last_ + l_[k];
      const PlanarProgress end = at_parameter(last_);
      const double weight = load_.weight + load_.weight_rate * end.time;
      const double actual = weight * detail::level_along(law, end.distance, norm(end.velocity), end.time);
      if (!(std::abs(level - actual) > exact * (std::abs(level) + std::abs(l_[0])))) return;
    }
  }

  // Close a stop, or a collinear reversal, with the constant load of now, if it comes before the load changes.
  bool close(const Law& law) noexcept {
    const double speed = norm(velocity_);
    const double a = detail::level_along(law, 0.0, speed, 0.0), level = load_.weight * a + damping_ * speed;
    const Vector2 q = load_.start - pull();
    const double load = norm(q);
    const Vector2 to = load > 0 ? (1 / load) * q : (1 / speed) * velocity_;
    const double along = dot(velocity_, to), across = cross(to, velocity_);
    // u + v_q and u - v_q, without cancellation.
    const double plus = along < 0 ? across * across / (speed - along) : speed + along;
    const double minus = along < 0 ? speed - along : across * across / (speed + along);
    const bool turns = !(load < level);
    if (turns && !(along < 0 && is_collinear(across, speed, level + load))) return false;
    const double time = turns ? minus / (2 * (level + load)) : (plus / (level - load) + minus / (level + load)) / 2;
    if (!(time <= duration_)) return false;
    const double slower = detail::level_along(law, 0.0, speed / 2, 0.0);
    const double changes = norm(load_.rate) + spring_.stiffness * (speed + std::abs(load_.weight_rate) * norm(place_)) +
                           std::abs(load_.weight_rate) * a +
                           (2 * load_.weight * std::abs(slower - a) / speed + damping_) * (level + load) +
                           load_.weight * (memory_slope(law) * speed + change_in_time(law, speed, a));
    // A constant load misplaces the stop by up to 0.2 S T^3, and its time by S T^2 / (2 (w a - Q)), which matters where
    // the motion goes on.
    const double far = norm(place_), closest = 0x1p-56 * far + 0x1p-64 * (level + load) * duration_ * duration_;
    if (changes * time * time * (turns ? time + std::sqrt(far / (level + load)) : time) > closest) return false;
    if (turns) {
      const double sideways = std::abs(cross(to, load_.rate)) + spring_.stiffness * std::abs(cross(to, velocity_));
      if (sideways * time > 0x1p-44 * (level + load)) return false;
    } else if (changes * time > (level - load) / 4) {
      return false;
    }
    const Closing closing{to, level, load, turns ? 0 : plus, minus, across};
    const PlanarProgress whole = closing.to_stop(1);
    // So close that neither a stop nor a largest displacement can be missed on the way.
    if (whole.distance > 0x1p-26 * far + 0x1p-40 * (level + load) * duration_ * duration_) return false;
    closing_ = closing;
    kind_ = Kind::stop;
    stops_ = true;
    // Along a line, round-off remains below a part of 1e-8 of the speed.
    turns_ = turns && std::abs(across) > 0x1p-23 * speed;
    // The mean level along the way, for the work: the speed falls linearly.
    level_ = (load_.weight + load_.weight_rate * time / 3) *
             detail::level_along(law, whole.distance / 2, speed * (2.0 / 3), time / 3);
    last_ = 1;
    end_ = whole;
    end_.velocity = {};
    return true;
  }

  // The speed aside of a collinear motion is round-off of its largest speed, about sqrt((w a + Q) |r|).
  bool is_collinear(double across, double speed, double force) const noexcept {
    return std::abs(across) <= std::max(0x1p-46 * speed, 0x1p-52 * std::sqrt(force * norm(place_)));
  }

  // A slip under a constant load and a constant level has a closed form. A collinear one ends where it reverses.
  bool hold([[maybe_unused]] const Law& law) noexcept {
    if constexpr (form_of<Law> == Form::constant) {
      const bool constant = detail::equal(spring_.stiffness, 0) && detail::equal(damping_, 0) && !(stop_ < never) &&
                            detail::equal(load_.rate.axis, 0) && detail::equal(load_.rate.transverse, 0) &&
                            detail::equal(load_.weight_rate, 0);
      if (!constant) return false;
      level_ = load_.weight * detail::level_along(law, 0.0, 0.0, 0.0);
      const double load = norm(load_.start), speed = norm(velocity_);
      if (!(level_ > 0 || load > 0)) return false;
      const Vector2 to = load > 0 ? (1 / load) * load_.start : (1 / speed) * velocity_;
      const double along = dot(velocity_, to), across = cross(to, velocity_);
      const bool reverses = along < 0 && is_collinear(across, speed, level_ + load);
      const double plus = reverses ? 0 : along < 0 ? across * across / (speed - along) : speed + along;
      const double minus = along < 0 ? speed - along : across * across / (speed + along);
      held_ = detail::HeldSlip(to, level_, load, plus, minus, across);
      kind_ = Kind::held;
      constant_level_ = true;
      last_ = held_.parameter(duration_);
      end_ = held_.at(last_);
      if (std::abs(end_.time - duration_) <= 0x1p-40 * duration_) end_.time = duration_;
      return true;
    }
    return false;
  }

  // The rate at which the level changes at a given speed [m/s^3].
  double change_in_time([[maybe_unused]] const Law& law, [[maybe_unused]] double speed,
                        [[maybe_unused]] double now) const noexcept {
    if constexpr (heated)
      return std::max(std::abs(law.resist_at(duration_, speed) - now) - 1e-8 * now, 0.0) / duration_;  // known to 1e-8
    else
      return 0;
  }
  static double memory_slope([[maybe_unused]] const Law& law) noexcept {
    if constexpr (form_of<Law> == Form::linear)
      return std::abs(law.slope(Direction::forward));
    else
      return 0;
  }

  void move(const Law& law) {
    const double speed = norm(velocity_);
    const Vector2 q0 = load_.start - pull();
    series::Coefficients path, swift, when;
    path[0] = when[0] = 0, swift[0] = speed;
    auto resistance = series::series_of<double>(
        detail::level_along(law, series::Variable{&path}, series::Variable{&swift}, series::Variable{&when}));
    constexpr bool constant = std::same_as<decltype(resistance), series::Constant>;
    constant_level_ = constant && detail::equal(load_.weight_rate, 0);
    resistance.update(0);
    const double a = resistance[0], level = load_.weight * a;
    level_ = level;
    const double load = norm(q0), wn = std::sqrt(spring_.stiffness);
    const double steepest = norm(load_.rate) + a * std::abs(load_.weight_rate);
    const double rate = level + load + (damping_ + wn) * speed + std::sqrt(steepest * speed);
    // The step in tau that takes as long as the segment, at a constant acceleration along the velocity.
    const double speeds_up = dot(q0, velocity_) / speed - level - damping_ * speed,
                 grows = speeds_up * duration_ / speed;
    double h = largest_step / rate;
    if (grows > -0.99) {
      const double needed = duration_ / speed * (std::abs(grows) < 1e-3 ? 1 - grows / 2 : std::log1p(grows) / grows);
      h = std::min(h, 1.0625 * needed);
    }
    const bool spring = spring_.stiffness > 0, weighed = !detail::equal(load_.weight_rate, 0);
    t_[0] = x_[0] = y_[0] = s_[0] = 0;
    vx_[0] = velocity_.axis, vy_[0] = velocity_.transverse, u_[0] = speed;
    l_[0] = level;
    double fastest = speed, farthest = 0, term = 1, longest = 1;
    Array grows_along;  // the velocity along the rate of the load
    // Series side by side, whose products are computed together: r', and u, t; and those with q.
    Four moving[highest_order + 1], with_load[highest_order + 1], load_on[highest_order + 1];
    int k = 0;
    for (;; ++k) {
      const auto conv = [k](const double* p, const double* q) { return series::convolve(p, q, 0, k); };
      if (k > 0) {
        resistance.update(k);
        l_[k] = load_.weight * resistance[k];
        if (weighed) {
          const auto& level_of = resistance;
          double sum = 0;
          for (int i = 1; i <= k; ++i) sum += t_[i] * level_of[k - i];
          l_[k] += load_.weight_rate * sum;
        }
      }
      moving[k] = {vx_[k], vy_[k], u_[k], t_[k]};
      const Four by_speed = convolve(u_, moving, k);
      const auto [rx, ry, e, ut] = by_speed.of;
      double ux, uy, qv;
      if (spring) {
        double wx = x_[k], wy = y_[k];
        if (k == 0) wx = place_.axis, wy = place_.transverse;
        if (spring_.pendulum) {
          double gx = 0, gy = 0;
          if (weighed) {
            gx = t_[k] * place_.axis, gy = t_[k] * place_.transverse;
            for (int i = 1; i < k; ++i) gx += t_[i] * x_[k - i], gy += t_[i] * y_[k - i];
          }
          wx = load_.weight * wx + load_.weight_rate * gx;
          wy = load_.weight * wy + load_.weight_rate * gy;
        }
        const double qx = load_.rate.axis * t_[k] - spring_.stiffness * wx + (k == 0 ? load_.start.axis : 0);
        const double qy =
            load_.rate.transverse * t_[k] - spring_.stiffness * wy + (k == 0 ? load_.start.transverse : 0);
        load_on[k] = {qx, qy, qx, qy};
        with_load[k] = {u_[k], u_[k], vx_[k], vy_[k]};
        const Four products = convolve(load_on, with_load, k);
        const auto [of_x, of_y, work_x, work_y] = products.of;
        ux = of_x, uy = of_y, qv = work_x + work_y;
      } else {
        grows_along[k] = load_.rate.axis * vx_[k] + load_.rate.transverse * vy_[k];
        ux = load_.start.axis * u_[k] + load_.rate.axis * ut;
        uy = load_.start.transverse * u_[k] + load_.rate.transverse * ut;
        qv = load_.start.axis * vx_[k] + load_.start.transverse * vy_[k] + conv(t_, grows_along);
      }
      double lx, ly, lu;
      if (constant_level_) {
        lx = level * vx_[k], ly = level * vy_[k], lu = level * u_[k];
      } else {
        lx = conv(l_, vx_), ly = conv(l_, vy_), lu = conv(l_, u_);
      }
      const double by = h * series::reciprocal[k + 1];
      vx_[k + 1] = by * (ux - lx - damping_ * rx);
      vy_[k + 1] = by * (uy - ly - damping_ * ry);
      u_[k + 1] = by * (qv - lu - damping_ * e);
      t_[k + 1] = by * u_[k];
      x_[k + 1] = by * rx;
      y_[k + 1] = by * ry;
      s_[k + 1] = by * e;
      swift[k + 1] = u_[k + 1];
      path[k + 1] = s_[k + 1];
      when[k + 1] = t_[k + 1];
      // The path is a product of two speeds: its terms fall more slowly.
      const double of_speed = std::max(std::abs(vx_[k + 1]), std::max(std::abs(vy_[k + 1]), std::abs(u_[k + 1])));
      fastest = std::max(fastest, of_speed);
      farthest = std::max(farthest, s_[k + 1]);
      const double previous = std::exchange(term, std::max(of_speed / fastest, std::abs(s_[k + 1]) / farthest));
      if (k >= 2 && std::max(term, previous) <= round_off) break;
      if (k + 1 == highest_order) {
        // With a shorter step the terms shrink; the largest of them may then be the first.
        const double larger = std::max(std::max(of_speed / speed, std::abs(s_[k + 1]) / s_[1]), previous);
        longest = larger > 0 ? std::exp2(std::log2(round_off / larger) / (k + 1)) : 1;
        longest = std::max(std::min(longest, 1.0), 0x1p-40);
        break;
      }
    }
    end_series(k + 1);
    last_ = longest;
    if constexpr (!constant) keep_to(law);
    finish();
  }

  // A slow slip whose direction follows the load, because it has had the time to turn into it: a power series in time,
  // without the singularity of a direction that is still turning. Near a stop, under a load that is nearly equal to the
  // level, and in creep it takes one step where the regularized time would take hundreds.
  // @return false if the slip is too fast for it, or still turns
  bool follow(const Law& law, int& patience) {
    if (--patience > 0) return false;
    const Vector2 q = load_.start - pull();
    const double load = norm(q), speed = norm(velocity_);
    if (!(load * duration_ > follows * speed) || !(dot(velocity_, q) > 0)) return false;
    if (nears_stop()) return false;
    // The direction lags behind that of the load by u/Q times its rate, to first order.
    const Vector2 rate =
        load_.rate - spring_.rate(load_.weight_rate) * place_ - spring_.under(load_.weight) * velocity_;
    const double lag = speed / load, turns = cross(q, rate) / (load * load);
    const double actual = cross(q, velocity_) / (load * speed), error = std::abs(actual + lag * turns);
    const double per_time = lag * (norm(rate) / load + damping_) +
                            std::abs(load - load_.weight * detail::level_along(law, 0.0, speed, 0.0)) / load;
    const double allowed = tolerated(speed, load), second_order = 4 * lag * std::abs(turns) * per_time;
    if (error > second_order + allowed) {
      patience = flows_to_decay(error / (second_order + allowed));
      return false;
    }
    if (along_load(law, speed, false)) return true;
    patience = flows_to_decay(misaligned_ / allowed);
    return false;
  }
  // Whether a stop will soon turn its velocity.
  bool nears_stop() const noexcept {
    return norm(place_) > stop_ * (1 - 0x1p-30) && !leaves_at_once_ && !(dot(place_, velocity_) < 0);
  }

  // Creep: a slow slip under a level that rises so steeply with the speed that the speed follows the load, too. Its
  // equation u' = q.e - w a(u) - c u is solved for the u in a(u), and iterated with that of the direction. Without the
  // fast decay that any other speed would have, the series holds for as long as the load hardly changes.
  // @return false if the slip is too fast for it, or its speed still decays
  bool creep([[maybe_unused]] const Law& law, [[maybe_unused]] int& patience) {
    if constexpr (creeps) {
      if (--patience > 0) return false;
      const Vector2 q = load_.start - pull();
      const double load = norm(q), speed = norm(velocity_);
      if (!(dot(velocity_, q) > 0) || nears_stop()) return false;
      series::Coefficients path, swift, when;
      path[0] = path[1] = when[0] = when[1] = 0, swift[0] = speed, swift[1] = 1;
      auto resistance = series::series_of<double>(
          detail::level_along(law, series::Variable{&path}, series::Variable{&swift}, series::Variable{&when}));
      resistance.update(0), resistance.update(1);
      const double resists = resistance[0], steep = load_.weight * resistance[1] + damping_;
      if (!(steep * duration_ > follows)) return false;
      const Vector2 rate =
          load_.rate - spring_.rate(load_.weight_rate) * place_ - spring_.under(load_.weight) * velocity_;
      // The rate of the level at this speed.
      double drift = resists * load_.weight_rate;
      if constexpr (heated) {
        const double soon = 0x1p-8 * duration_;
        drift += load_.weight * (detail::level_along(law, 0.0, speed, soon) - resists) / soon;
      }
      const double growth = norm(rate) + std::abs(drift);
      const double step = growth > 0 ? std::min(duration_, std::min(load, steep * speed) / (2 * growth)) : duration_;
      if (!(steep * step > follows) || !(load * step > follows * speed)) return false;
      // The speed lags behind that at which friction balances the load, to first order.
      const double lag = (dot(q, rate) / load - drift) / steep;
      const double error = std::abs(load - load_.weight * resists - damping_ * speed - lag) / steep;
      const double allowed = std::max(steep * (0x1p-55 * duration_ * speed + 0x1p-58 * norm(place_)),
                                      heated ? level_error * load_.weight * resists / steep : 0.0);
      const double second_order = 16 * std::abs(lag) / (steep * steep * step);
      if (error > second_order + allowed) {
        patience = flows_to_decay(error / (second_order + allowed));
        return false;
      }
      if (is_held_up(speed, 0x1p-46 * load / steep)) return true;
      if (creep(law, q, step, speed, allowed)) return true;
      patience = 10;
    }
    return false;
  }

  // Under a constant load creep slows down without end. A speed that is the round-off of the load displaces nothing
  // more.
  bool is_held_up(double speed, double unresolved) noexcept {
    if (heated || speed > unresolved || !(load_.rate == Vector2{}) || !detail::equal(load_.weight_rate, 0))
      return false;
    for (double* c : {t_, x_, y_, s_, u_, vx_, vy_, l_}) c[0] = c[1] = 0;
    t_[1] = duration_;
    u_[0] = speed;
    vx_[0] = velocity_.axis, vy_[0] = velocity_.transverse;
    end_series(1);
    last_ = 1;
    finish();
    return true;
  }

  /// @param allowed  error of the speed at the start that displaces the path by less than round-off [m/s]
  bool creep(const Law& law, Vector2 q, double step, double speed, double allowed) {
    series::Coefficients path, swift, when;
    path[0] = when[0] = 0, swift[0] = speed;
    auto resistance = series::series_of<double>(
        detail::level_along(law, series::Variable{&path}, series::Variable{&swift}, series::Variable{&when}));
    AlongLoad slip(q, load_.rate - spring_.rate(load_.weight_rate) * place_);
    slip.step = step;
    const double gains = load_.weight_rate * step;
    t_[0] = x_[0] = y_[0] = s_[0] = 0;
    for (double& value : u_) value = 0;
    u_[0] = speed;
    // A coefficient is set twice. GCC 12 at -O1 drops the first of two such stores (-fipa-modref), although the update
    // between them reads it; an empty statement that may read all memory keeps it.
    const auto update = [&](int k, double speed_k) {
      swift[k] = speed_k;
#if defined(__GNUC__)
      asm volatile("" : : "r"(&swift) : "memory");
#endif
      resistance.update(k);
    };
    double previous = never, steep = 0;
    for (int sweep = 0;; ++sweep) {
      double changed = 0;
      for (int k = 0; k <= lagging_order; ++k) {
        if (k > 0) lead(slip, k);
        changed = std::max(changed, turn_into(slip, k));
        // What friction and damper take: the level is linear in the last coefficient of the speed.
        const double taken = slip.sigma[k] - (k + 1) * u_[k + 1] / step, before = u_[k];
        if (k == 0) {
          for (int i = 0; i < 3; ++i) {
            path[1] = when[1] = 0;
            update(0, u_[0]), update(1, 1);
            steep = load_.weight * resistance[1] + damping_;
            if (!(steep > 0)) return false;
            u_[0] -= (load_.weight * resistance[0] + damping_ * u_[0] - taken) / steep;
            if (!(u_[0] > 0)) return false;
          }
          update(0, u_[0]);
          l_[0] = load_.weight * resistance[0];
        } else {
          path[k] = s_[k], when[k] = t_[k];
          update(k, 0);
          const double rest = load_.weight * resistance[k] + gains * resistance[k - 1];
          update(k, u_[k] = (taken - rest) / steep);
          l_[k] = load_.weight * resistance[k] + gains * resistance[k - 1];
        }
        // The round-off of the load remains.
        const double change = std::abs(u_[k] - before) - 0x1p-51 * slip.load / steep;
        changed = std::max(changed, change / speed);
      }
      if (changed <= round_off) break;
      if (sweep > 1 && !(changed < previous / 4)) {
        if (changed <= 0x1p-48) break;
        return false;
      }
      if (sweep == 20) return false;
      previous = changed;
    }
    level_ = l_[0];
    constant_level_ = false;
    const double misaligned = std::abs(cross(slip.to, velocity_) / speed - slip.d[0]);
    if (!(std::abs(u_[0] - speed) <= allowed) || !(misaligned <= tolerated(speed, slip.load))) return false;
    return end_along(law, slip, lagging_order, true, false);
  }

  // Flows in which an error of the direction decays by a factor: by about e in each.
  static int flows_to_decay(double factor) noexcept {
    return factor > 1 ? static_cast<int>(std::min(std::log(factor), 40.0)) + 1 : 10;
  }
  // The error of the direction that displaces the path by less than round-off while the slip turns into the load.
  double tolerated(double speed, double load) const noexcept {
    return load / speed * (0x1p-55 * duration_ + 0x1p-58 * norm(place_) / speed);
  }

  // A slip along the load as a power series in time, in the frame of the load at its start.
  struct AlongLoad {
    Vector2 to;     // direction of the load
    double load;    // its magnitude [m/s^2]
    Vector2 rate;   // its rate, without that of the spring
    double step;    // for which the series is computed [s]
    bool unloaded;  // without any load the motion begins in the direction into which the load grows
    // Along `to` and clockwise from it: the load q, the direction e of the motion, the path; and q.e.
    Array qa, qb, c, d, ra, rb, sigma;

    AlongLoad(Vector2 q, Vector2 its_rate) : to{1, 0}, load(norm(q)), rate(its_rate), step(0), unloaded(!(load > 0)) {
      const double growth = norm(rate);
      if (!unloaded)
        to = (1 / load) * q;
      else if (growth > 0)
        to = (1 / growth) * rate;
      for (double& value : d) value = 0;
      for (double& value : sigma) value = 0;
      ra[0] = rb[0] = qb[0] = 0;
      qa[0] = load;
    }
  };

  // Coefficient k > 0 of time, path and load, from the speed and the direction up to k - 1.
  void lead(AlongLoad& s, int k) noexcept {
    const double by = s.step * series::reciprocal[k];
    t_[k] = k == 1 ? s.step : 0;
    s_[k] = by * u_[k - 1];
    double gained_a = 0, gained_b = 0;
    for (int i = 0; i < k; ++i) gained_a += u_[i] * s.c[k - 1 - i], gained_b += u_[i] * s.d[k - 1 - i];
    s.ra[k] = by * gained_a, s.rb[k] = by * gained_b;
    double wa = s.ra[k], wb = s.rb[k];
    if (spring_.pendulum) {
      const double gains = load_.weight_rate * s.step;
      wa = load_.weight * wa + gains * s.ra[k - 1];
      wb = load_.weight * wb + gains * s.rb[k - 1];
    }
    s.qa[k] = (k == 1 ? dot(s.rate, s.to) * s.step : 0) - spring_.stiffness * wa;
    s.qb[k] = (k == 1 && !s.unloaded ? cross(s.to, s.rate) * s.step : 0) - spring_.stiffness * wb;
  }

  // Coefficient k of the direction: u e' = q - (q.e) e, solved for the part of e perpendicular to the load. The part
  // along it follows from |e| = 1. @return the change
  double turn_into(AlongLoad& s, int k) const noexcept {
    double turned = 0;
    if (!s.unloaded) {
      double rest = s.step * s.qb[k] - u_[0] * (k + 1) * s.d[k + 1];
      for (int i = 1; i <= k; ++i) rest -= s.step * s.sigma[i] * s.d[k - i];
      for (int i = 2; i <= k; ++i) rest -= u_[i] * (k - i + 1) * s.d[k - i + 1];
      turned = rest / ((k > 0 ? k * u_[1] : 0) + s.step * s.load);
    }
    const double change = std::abs(turned - s.d[k]);
    s.d[k] = turned;
    double square = s.d[0] * s.d[k];
    for (int i = 1; i < k; ++i) square += s.c[i] * s.c[k - i] + s.d[i] * s.d[k - i];
    if (k > 0) square += s.d[k] * s.d[0];
    s.c[k] = k > 0 ? -square / (2 * s.c[0]) : std::sqrt(1 - square);
    double sum = 0;
    for (int i = 0; i <= k; ++i) sum += s.qa[i] * s.c[k - i] + s.qb[i] * s.d[k - i];
    s.sigma[k] = sum;
    return change;
  }

  // From rest, or slowly along the load. With a speed u at the start, the equation of the direction is iterated.
  bool along_load(const Law& law, double speed, bool smooth) {
    const Vector2 q0 = load_.start - pull();
    series::Coefficients path, swift, when;
    path[0] = when[0] = 0, swift[0] = speed;
    auto resistance = series::series_of<double>(
        detail::level_along(law, series::Variable{&path}, series::Variable{&swift}, series::Variable{&when}));
    resistance.update(0);
    const double load = norm(q0), level = load_.weight * resistance[0];
    level_ = level;
    constant_level_ = std::same_as<decltype(resistance), series::Constant> && detail::equal(load_.weight_rate, 0);
    const Vector2 rate = load_.rate - spring_.rate(load_.weight_rate) * place_;
    AlongLoad slip(q0, rate);
    const double growth = norm(rate);
    const double wn = std::sqrt(spring_.stiffness);
    double h = duration_;
    if (wn > 0) h = std::min(h, 1 / wn);
    if (damping_ > 0) h = std::min(h, 1 / damping_);
    const double steepest = growth + resistance[0] * std::abs(load_.weight_rate);
    if (steepest > 0 && load > 0) h = std::min(h, load / steepest);
    if (speed > 0) {
      if (load < level) h = std::min(h, 2 * speed / (level - load));
      const double slope =
          2 * load_.weight * std::abs(detail::level_along(law, 0.0, speed / 2, 0.0) - resistance[0]) / speed;
      if (slope > 0) h = std::min(h, 2 / slope);
      if (!(load * h > follows * speed)) return false;
    }

    slip.step = h;
    t_[0] = x_[0] = y_[0] = s_[0] = 0;
    u_[0] = speed;
    l_[0] = level;
    const double gains = load_.weight_rate * h;
    const double net0 = smooth || slip.unloaded ? 0 : std::max(load - level, 0.0);
    const int orders = speed > 0 ? lagging_order : highest_order;
    double previous = never;
    for (int sweep = 0; sweep < 12; ++sweep) {
      double changed = 0;
      for (int k = 0; k <= orders; ++k) {
        if (k > 0) {
          const double by = h * series::reciprocal[k];
          u_[k] = by * ((k == 1 && !(speed > 0) ? net0 : slip.sigma[k - 1] - l_[k - 1]) - damping_ * u_[k - 1]);
          lead(slip, k);
          swift[k] = u_[k];
          path[k] = s_[k];
          when[k] = t_[k];
          resistance.update(k);
          l_[k] = load_.weight * resistance[k] + gains * resistance[k - 1];
        }
        changed = std::max(changed, turn_into(slip, k));
      }
      if (!(speed > 0) || changed <= round_off) break;
      if (sweep > 1 && !(changed < previous / 4)) {
        if (changed <= 0x1p-50) break;
        return false;
      }
      previous = changed;
      if (sweep == 11) return false;
    }
    if (speed > 0) {
      misaligned_ = std::abs(cross(slip.to, velocity_) / speed - slip.d[0]);
      if (!(misaligned_ <= tolerated(speed, load))) return false;
    }
    constexpr bool constant = std::same_as<decltype(resistance), series::Constant>;
    return end_along(law, slip, orders, speed > 0, constant);
  }

  // The series of a slip along the load, up to where its terms reach round-off.
  // @param slow      whether it moves already, slowly
  // @param constant  whether the level is
  bool end_along(const Law& law, const AlongLoad& slip, int orders, bool slow, bool constant) {
    const double h = slip.step, load = slip.load;
    const Vector2 to = slip.to, aside = stickslip::turned(to);
    const auto &c = slip.c, &d = slip.d, &ra = slip.ra, &rb = slip.rb;
    for (int k = 0; k <= orders; ++k) {
      double va = 0, vb = 0;
      for (int i = 0; i <= k; ++i) va += u_[i] * c[k - i], vb += u_[i] * d[k - i];
      vx_[k] = va * to.axis + vb * aside.axis;
      vy_[k] = va * to.transverse + vb * aside.transverse;
      x_[k] = ra[k] * to.axis + rb[k] * aside.axis;
      y_[k] = ra[k] * to.transverse + rb[k] * aside.transverse;
    }
    // The order up to which the series can be used longest: from there on its terms may grow again.
    int leading = 0;
    while (leading < orders && detail::equal(u_[leading], 0)) ++leading;
    double scale = std::abs(u_[leading]), longest = 0;
    int order = orders;
    if (slow)
      for (int k = 1; k <= 3; ++k) scale = std::max(scale, std::abs(u_[k]));
    const auto part = [&](int k) {
      const double of = std::max(std::abs(u_[k]), std::max(std::abs(vx_[k]), std::abs(vy_[k])));
      return of > 0 ? std::exp2(std::log2(round_off * scale / of) / (k - leading)) : never;
    };
    double before = leading + 1 <= orders ? part(leading + 1) : 0;
    // Terms that vanish do not end it if a law, or a pendulum without weight at the start, may act on later ones.
    const bool delayed = !constant || (spring_.pendulum && !detail::equal(load_.weight_rate, 0));
    // Nor do those of a speed that is nearly zero: under a load that turns away from the level it grows as t^3.
    const int lowest = std::max(leading + 2, delayed ? orders - 8 : slow ? 5 : 0);
    for (int k = leading + 2; k <= orders && longest < 1; ++k) {
      const double now = part(k), both = std::min(before, now);
      before = now;
      if (k >= lowest && both > longest) longest = both, order = k;
    }
    last_ = longest > 0 ? std::min(longest, 1.0) : 1;
    end_series(order);
    if (!constant) keep_to(law);
    // Where the speed returns to zero, a slip along one line stops, and so does a slow one. Any other still turns: the
    // series ends before.
    Array slower{};  // for GCC, which takes it for uninitialized
    double power = 1;
    bool straight = true;
    for (int k = 0; k <= order_; ++k, power *= last_) {
      slower[k] = power * u_[k];
      straight = straight && detail::equal(d[k], 0);
    }
    if (const double stops = first_zero(slower); stops > 0 && stops < never) {
      last_ *= stops;
      if (straight || slow)
        stops_ = last_ * h <= duration_;
      else
        last_ *= 0.75;
    }
    if (slow) {
      // It remains slow; otherwise steps in tau are as long.
      const double reached = last_;
      while (last_ > 0x1p-10 && follows * std::max(u_[0] + value(u_, last_), u_[0] + value(u_, last_ / 2)) > load * h)
        last_ /= 2;
      if (!(load * h * last_ > 16 * (u_[0] + std::abs(value(u_, last_))))) return stops_ = false;
      if (last_ < reached) stops_ = false;
    }
    finish();
    return true;
  }

  // Along a circular stop through the present place, as a power series in time: its angle psi, and
  //     u' = p.e - w a - c u,   psi' = +-u/d,   reaction = p.r/d - wn^2 d + u^2/d.
  // Up to a stop of the motion, the first term of the reaction that is not round-off decides whether it leaves at once;
  // without one it does not.
  // @return false if it is
  bool move_along(const Law& law, int side, bool at_level) {
    const double gap = norm(place_), speed = norm(velocity_), s = side;
    const Vector2 outward = (1 / gap) * place_, sideways = turned(outward);
    const double spring = spring_.under(load_.weight), spring_rate = spring_.rate(load_.weight_rate);
    const double centrifugal = speed * speed / gap, unknown = graze * (largest_load() + spring * gap + centrifugal);
    const double pa = dot(load_.start, outward), pb = dot(load_.start, sideways);
    Array c, d, reaction;
    reaction[0] = pa - spring * gap + centrifugal;
    if (reaction[0] < -unknown) return false;
    series::Coefficients path, swift, when;
    path[0] = when[0] = 0, swift[0] = speed;
    auto resistance = series::series_of<double>(
        detail::level_along(law, series::Variable{&path}, series::Variable{&swift}, series::Variable{&when}));
    resistance.update(0);
    constant_level_ = std::same_as<decltype(resistance), series::Constant> && detail::equal(load_.weight_rate, 0);
    level_ = l_[0] = load_.weight * resistance[0];
    double h = duration_;
    const double rate = speed / gap + std::sqrt((norm(load_.start) + level_) / gap) +
                        std::cbrt((norm(load_.rate) + resistance[0] * std::abs(load_.weight_rate)) / gap) + damping_;
    if (rate > 0) h = std::min(h, 1 / rate);
    // The direction of the place, cosine and sine in the frame of the start; the load in this frame.
    const double ga = h * dot(load_.rate, outward), gb = h * dot(load_.rate, sideways);
    c[0] = 1, d[0] = 0;
    u_[0] = speed;
    t_[0] = x_[0] = y_[0] = s_[0] = 0;
    vx_[0] = velocity_.axis, vy_[0] = velocity_.transverse;
    bool rests = !(speed > 0);
    for (int k = 0; k < highest_order; ++k) {
      const double by = h * series::reciprocal[k + 1];
      if (k > 0) {
        resistance.update(k);
        l_[k] = load_.weight * resistance[k] + load_.weight_rate * h * resistance[k - 1];
      }
      double along = -pa * d[k] + pb * c[k];
      if (k > 0) along += -ga * d[k - 1] + gb * c[k - 1];
      u_[k + 1] = by * (s * along - l_[k] - damping_ * u_[k]);
      // It departs. Under a load that equals the level, the speed grows with the square of the time.
      if (rests) {
        if ((k == 0 && at_level) || !(u_[k + 1] > 0)) u_[k + 1] = 0;
        rests = !(u_[k + 1] > 0);
      }
      const double angle = s / gap * h;  // per unit of u
      c[k + 1] = -angle * series::reciprocal[k + 1] * series::convolve(u_, d, 0, k);
      d[k + 1] = angle * series::reciprocal[k + 1] * series::convolve(u_, c, 0, k);
      s_[k + 1] = by * u_[k];
      t_[k + 1] = k == 0 ? h : 0;
      swift[k + 1] = u_[k + 1];
      path[k + 1] = s_[k + 1];
      when[k + 1] = t_[k + 1];
      const int j = k + 1;
      reaction[j] = pa * c[j] + pb * d[j] + ga * c[j - 1] + gb * d[j - 1] - (j == 1 ? spring_rate * h * gap : 0) +
                    series::convolve(u_, u_, 0, j) / gap;
      x_[j] = gap * (c[j] * outward.axis + d[j] * sideways.axis);
      y_[j] = gap * (c[j] * outward.transverse + d[j] * sideways.transverse);
      const double va = -s * series::convolve(u_, d, 0, j), vb = s * series::convolve(u_, c, 0, j);
      vx_[j] = va * outward.axis + vb * sideways.axis;
      vy_[j] = va * outward.transverse + vb * sideways.transverse;
    }
    end_series(highest_order);
    const double fastest = speed + h * (norm(load_.start) + level_ + h * norm(load_.rate));
    last_ = 1;
    for (const int k : {order_ - 1, order_}) {
      const double term = std::max(std::abs(u_[k]), fastest / gap * gap * std::max(std::abs(c[k]), std::abs(d[k])));
      if (term > round_off * fastest) last_ = std::min(last_, std::exp2(std::log2(round_off * fastest / term) / k));
    }
    Array slower, presses;
    double power = 1;
    for (int k = 0; k <= order_; ++k, power *= last_) slower[k] = power * u_[k];
    if (const double stops = first_zero(slower); stops < never) last_ *= stops, stops_ = true;
    power = 1;
    bool grazes = true;
    for (int k = 0; k <= order_; ++k, power *= last_) {
      presses[k] = power * reaction[k];
      if (!grazes) continue;
      if (presses[k] < -unknown) return stops_ = constant_level_ = false;
      grazes = presses[k] <= unknown;
      if (grazes) presses[k] = 0;
    }
    if (const double leaves = first_zero(presses); leaves < 1 || (leaves < never && !stops_)) {
      last_ *= leaves;
      stops_ = false;
      leaves_ = true;
    }
    if constexpr (!std::same_as<decltype(resistance), series::Constant>) {
      const double reached = last_;
      keep_to(law);
      if (last_ < reached) stops_ = leaves_ = false;
    }
    finish();
    if (end_.time >= duration_ && last_ * h > duration_ * (1 + 0x1p-50)) stops_ = leaves_ = false;
    return true;
  }

  // The first zero on (0, 1] of a polynomial that is positive just after 0, or 0 if it is negative there.
  double first_zero(const double* w) const noexcept { return first_zero(w, order_); }
  static double first_zero(const double* w, int degree) noexcept {
    int leading = 0;
    while (leading < degree && detail::equal(w[leading], 0)) ++leading;
    if (leading == degree) return never;
    if (w[leading] < 0) return 0;
    return FirstRoot(w + leading, degree - leading).find();
  }

  // |r|^2 less its value at the start is a polynomial of twice the order, whose terms beyond the longest series are
  // round-off. Its coefficient k, and the sum of the magnitudes of what it consists of.
  int square_degree() const noexcept { return std::min(2 * order_, highest_order); }
  double square_of_distance(int k, double& terms) const noexcept {
    double square = 0;
    const auto add = [&](double part) { square += part, terms += std::abs(part); };
    if (k <= order_) add(2 * place_.axis * x_[k]), add(2 * place_.transverse * y_[k]);
    for (int i = std::max(1, k - order_); i < k && i <= order_; ++i) add(x_[i] * x_[k - i]), add(y_[i] * y_[k - i]);
    return square;
  }

  // Shorten the parameter to the end of the segment, and evaluate there.
  void finish() noexcept {
    end_ = at_parameter(last_);
    if (end_.time >= duration_ * (1 - 0x1p-50)) {
      if (end_.time > duration_) {
        last_ = parameter(duration_);
        end_ = at_parameter(last_);
      }
      end_.time = duration_;
    }
  }

  static constexpr double round_off = std::numeric_limits<double>::epsilon() / 4;
  static constexpr double graze = 0x1p-42;  // a difference of radial terms that is round-off, as a fraction of them
  static constexpr double follows =
      64;  // times in which a direction turns into that of the load, at least, in a slow slip
  // Whether the level depends on time, by the heat of a step, and how well it is then known.
  static constexpr bool heated = requires(const Law& law) { law.resist_at(0.0, 0.0); };
  static constexpr double level_error = 1e-9;
  // Whether the level may depend on the speed.
  static constexpr bool creeps = [] {
    if constexpr (MemorylessLaw<Law>)
      return form_of<Law> == Form::analytic;
    else
      return true;
  }();
  static constexpr int lagging_order = 20;   // of the series of a slow slip
  static constexpr double largest_step = 2;  // of tau times the rate of the motion

  double damping_, stop_;
  Spring spring_;
  bool along_stop_ = false, leaves_at_once_ = false, constant_level_ = false;
  bool stops_ = false, leaves_ = false, turns_ = false;
  Kind kind_ = Kind::series;
  Closing closing_{};
  detail::HeldSlip held_;
  Vector2 place_, velocity_;
  PlanarLoad load_;
  double duration_;
  double level_ = 0;       // resistance at the start [m/s^2]
  double misaligned_ = 0;  // the direction of a slow slip, from that in which it would follow the load
  double last_ = 0;
  int order_ = 0;
  Array t_, u_, x_, y_, vx_, vy_, s_, l_;
  PlanarProgress end_;
};

}  // namespace stickslip
