// A slip in the plane under a load and a level that are constant.
#pragma once

#include <cmath>
#include <limits>

#include "stickslip/base/equal.hpp"
#include "stickslip/base/min_max.hpp"
#include "stickslip/base/vector2.hpp"
#include "stickslip/numerics/root.hpp"

namespace stickslip {

/// The progress of a planar flow.
struct PlanarProgress {
  double time = 0;      ///< since its start [s]
  Vector2 way;          ///< displacement since its start [m]
  Vector2 velocity;     ///< r' [m/s]
  double distance = 0;  ///< path length since its start [m]
};

namespace detail {

/// A slip under a constant load Q and a constant level a,
///     r'' + a r'/u = Q,   u = |r'|.
/// In regularized time, dt = u d tau, three velocities are exponentials: u + v_q, u - v_q and the velocity across the
/// load decay at the rates a - Q, a + Q and a, where v_q is the velocity along the load. Time and place are integrals
/// of their products. Docs: planar_motion.md.
class HeldSlip {
 public:
  HeldSlip() = default;
  /// @param to      direction of the load
  /// @param level   a [m/s^2], at least 0
  /// @param load    Q [m/s^2], at least 0
  /// @param plus    u + v_q at the start [m/s]
  /// @param minus   u - v_q at the start [m/s]
  /// @param across  velocity at the start, clockwise from the load [m/s]
  HeldSlip(Vector2 to, double level, double load, double plus, double minus, double across) noexcept
      : to_(to), level_(level), load_(load), plus_(plus), minus_(minus), across_(across) {}

  /// Progress since the start at a regularized time.
  PlanarProgress at(double tau) const noexcept {
    // Each product of two velocities decays at the sum of their rates.
    const Exponentials e(*this, tau);
    const double slow = level_ - load_, fast = level_ + load_, across = std::expm1(-level_ * tau);
    PlanarProgress to;
    to.time = time(e, tau);
    const double pp = plus_ * plus_ * integral(e.plus * (2 + e.plus), 2 * slow, tau),
                 mm = minus_ * minus_ * integral(e.minus * (2 + e.minus), 2 * fast, tau),
                 pm = plus_ * minus_ * integral(across * (2 + across), 2 * level_, tau);
    const double turning = slow + level_, ap = integral(std::expm1(-turning * tau), turning, tau);
    const double am = integral(e.minus + across + e.minus * across, fast + level_, tau);
    to.way = ((pp - mm) / 4) * to_ + (across_ * (plus_ * ap + minus_ * am) / 2) * turned(to_);
    to.distance = (pp + 2 * pm + mm) / 4;
    const double p = plus_ * remaining(e.plus, slow * tau), m = minus_ * remaining(e.minus, fast * tau);
    to.velocity = ((p - m) / 2) * to_ + (across_ * remaining(across, level_ * tau)) * turned(to_);
    return to;
  }

  /// The regularized time at a time from the start [s], or before a stop, when what is left is closed otherwise.
  double parameter(double duration) const noexcept {
    const double slow = level_ - load_, fast = level_ + load_;
    const double until_stop = (plus_ > 0 ? slow > 0 ? plus_ / slow : never_ : 0) / 2 + minus_ / fast / 2;
    constexpr double decay = 14;  // to e^-28 of the way that is left
    if (!(duration < until_stop * (1 - 0x1p-20))) return decay / (plus_ > 0 ? slow : fast);
    const double u = (plus_ + minus_) / 2, slower = (slow * plus_ + fast * minus_) / 2,
                 bend = (slow * slow * plus_ + fast * fast * minus_) / 2;
    const double part = duration / u, change = slower * part / u, bends = bend * part * part / u;
    double tau = part * (1 + change / 2 + (3 * change * change - bends) / 6), low = 0, high = never_;
    if (!(std::abs(change) < 0.25 && bends < 0.25)) {
      tau = part;
      if (slow < 0 && plus_ > 0) tau = std::min(tau, std::log1p(-2 * slow * duration / plus_) / -slow);
    }
    for (;;) {
      const Exponentials e(*this, tau);
      const double excess = time(e, tau) - duration;
      (excess < 0 ? low : high) = tau;
      const double speed = (plus_ * (1 + e.plus) + minus_ * (1 + e.minus)) / 2, next = tau - excess / speed;
      // The error of the next step is the square of this one.
      if (std::abs(next - tau) <= 0x1p-27 * std::min(tau, 1 / fast)) return next;
      tau = next > low && next < high ? next : high < never_ ? low + (high - low) / 2 : 2 * tau;
      if (!(low < tau && tau < high)) return tau;
    }
  }

  /// r'' at a regularized time [m/s^2].
  Vector2 acceleration(double tau) const noexcept {
    const double p = plus_ * std::exp((load_ - level_) * tau), m = minus_ * std::exp(-(load_ + level_) * tau);
    const double u = (p + m) / 2;
    return (load_ - level_ * (p - m) / (2 * u)) * to_ - (level_ * across_ * std::exp(-level_ * tau) / u) * turned(to_);
  }

  /// The largest distance from the origin up to a regularized time [m], and where it is.
  /// @param place  at the start
  double largest_radius(Vector2 place, double until, double& where) const {
    double largest = norm(place + at(until).way);
    where = until;
    search(place, 0, until, largest, where);
    return largest;
  }

 private:
  static constexpr double never_ = std::numeric_limits<double>::infinity();

  // exp(-rate tau) - 1 of u + v_q and of u - v_q.
  struct Exponentials {
    double plus, minus;
    Exponentials(const HeldSlip& slip, double tau) noexcept
        : plus(std::expm1((slip.load_ - slip.level_) * tau)), minus(std::expm1(-(slip.load_ + slip.level_) * tau)) {}
  };

  // exp(-decays), of which `change`, exp(-decays) - 1, is known.
  static double remaining(double change, double decays) noexcept {
    return change < -0.5 ? std::exp(-decays) : 1 + change;
  }

  // The integral of exp(-rate tau) from 0, of which `change` is known.
  static double integral(double change, double rate, double tau) noexcept {
    return equal(rate, 0) ? tau : -change / rate;
  }
  double time(const Exponentials& e, double tau) const noexcept {
    return (plus_ * integral(e.plus, level_ - load_, tau) + minus_ * integral(e.minus, level_ + load_, tau)) / 2;
  }

  struct Range {
    double low, high;
    Range(double a, double b) noexcept : low(std::min(a, b)), high(std::max(a, b)) {}
    friend Range operator+(Range a, Range b) noexcept { return {a.low + b.low, a.high + b.high}; }
    friend Range operator*(double factor, Range a) noexcept { return {factor * a.low, factor * a.high}; }
    double largest() const noexcept { return std::max(std::abs(low), std::abs(high)); }
  };

  // |r| has an extremum where r.r' vanishes. Where bounds show that r.r' is monotonic there is one at most; elsewhere
  // the interval is halved.
  void search(Vector2 place, double from, double to, double& largest, double& where) const {
    const PlanarProgress first = at(from), last = at(to);
    const Vector2 start = place + first.way, end = place + last.way;
    const double way = last.distance - first.distance;
    if (!((norm(start) + norm(end) + way) / 2 > largest * (1 + 0x1p-52))) return;
    // d(r.r')/d tau = u^3 + r.dr'/d tau: the three velocities are monotonic.
    const Exponentials e(*this, from), f(*this, to);
    const Range plus = plus_ * Range(1 + e.plus, 1 + f.plus), minus = minus_ * Range(1 + e.minus, 1 + f.minus),
                across = across_ * Range(std::exp(-level_ * from), std::exp(-level_ * to)),
                speed = 0.5 * (plus + minus);
    const Range along_rate = 0.5 * ((load_ - level_) * plus + (load_ + level_) * minus), across_rate = -level_ * across;
    const double slack = way * (along_rate.largest() + across_rate.largest());
    const auto cube = [](double u) { return u * u * u; };
    const Range change = Range(cube(speed.low), cube(speed.high)) + dot(start, to_) * along_rate +
                         cross(to_, start) * across_rate + Range(-slack, slack);
    const auto outward = [&](double tau) {
      const PlanarProgress there = at(tau);
      return dot(place + there.way, there.velocity);
    };
    if (change.low > 0) return;  // a minimum at most
    if (change.high < 0) {
      const double begins = dot(start, first.velocity), ends = dot(end, last.velocity);
      if (!(begins > 0 && ends < 0)) return;
      const double top = numerics::root(outward, from, begins, to, ends);
      if (const double radius = norm(place + at(top).way); radius > largest) largest = radius, where = top;
      return;
    }
    const double middle = from + (to - from) / 2;
    if (!(to - from > 0x1p-30 * to)) return;
    if (const double radius = norm(place + at(middle).way); radius > largest) largest = radius, where = middle;
    search(place, from, middle, largest, where);
    search(place, middle, to, largest, where);
  }

  Vector2 to_{};
  double level_ = 0, load_ = 0, plus_ = 0, minus_ = 0, across_ = 0;
};

}  // namespace detail
}  // namespace stickslip
