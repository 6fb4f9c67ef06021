// An independent opinion on any law, in long double and straight from
//     x'' + level(x) sgn(x') + wn^2 x = -n(t),   at rest while -level_backward <= -(n + wn^2 x) <= level_forward.
//
// While it slides, x is a power series in time, over steps so short that the velocity either has no zero or runs one
// way: then a stop is a change of sign. It also bounds by how much a program in doubles may differ. For constant levels
// friction is monotone in the velocity: two motions never move apart in sqrt(v^2 + wn^2 x^2), whatever is decided at
// their stops, so the local errors only add up. A level that changes with x adds its slope (Gronwall).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

#include "stickslip/sliding/response.hpp"

namespace test {

class IndependentSlider {
 public:
  using Real = long double;

  struct TooLong : std::runtime_error {
    TooLong() : std::runtime_error("more steps than this integrator is meant for") {}
  };

  /// Levels a sech(x / reach), a one for each direction; an infinite reach is Coulomb friction.
  IndependentSlider(Real forward, Real backward, Real reach, Real natural_frequency, Real displacement, Real velocity)
      : x(displacement),
        v(velocity),
        direction(velocity > 0   ? 1
                  : velocity < 0 ? -1
                                 : 0),
        peak(std::abs(displacement)),
        forward_(forward),
        backward_(backward),
        reach_(reach),
        w_(natural_frequency) {}

  Real x, v;
  int direction;  // 0 at rest
  Real peak, path = 0, input = 0, dissipated = 0;
  std::vector<stickslip::EventKind> events{};
  bool clear = true;  // no decision so far was within round-off

  // Bounds of the effect of round-off in doubles, to first order.
  Real x_error = 0, v_error = 0;  // the latter of sqrt(v^2 + wn^2 x^2)
  Real peak_error = 0, path_error = 0, input_error = 0, dissipated_error = 0, imbalance = 0;
  Real largest = 0;  // of all that must fit into a double
  int steps = 0, max_steps = 1'000;

  /// The ground acceleration runs straight from `start` to `end`; `look(k)` sees the state at the k-th of the `times`
  /// in this segment, in order.
  template <class Times, class Look>
  void advance(Real duration, Real start, Real end, const Times& times, Look&& look) {
    if (!(duration > 0)) return;
    duration_ = duration;
    largest = std::max({largest, std::abs(x), v * v, w_ * w_ * x * x});
    rate_ = (start - end) / duration;
    Real now = 0;
    int came_from = 0;                                    // direction of a slip that stopped just now
    bool known = false;                                   // whether acceleration_ is that of a slip that begins
    if (v == 0) came_from = std::exchange(direction, 0);  // the end of a segment left it undecided
    std::size_t next = 0;
    const auto seen = [&](Real until) { return next < times.size() && (times[next] <= until || until >= duration); };
    for (;;) {
      const Real left = duration - now;
      load_ = rate_ * now - start;
      if (direction == 0) {
        const Real net = load_ - w_ * w_ * x, f = level(x, 1), b = level(x, -1);
        const Real last = -end - w_ * w_ * x;  // if it does not slip
        Real wait = left;
        if (net > f || net < -b)
          direction = net > f ? 1 : -1, wait = 0;
        else if (last > f)
          direction = 1, wait = left * ((f - net) / (last - net));
        else if (last < -b)
          direction = -1, wait = left * ((b + net) / (net - last));
        judge(net, last, f, b, wait, now == 0);
        const bool holds = direction == 0 || wait > 0;
        if (holds && came_from != 0) events.push_back(stickslip::EventKind::arrest);
        while (seen(direction == 0 ? duration : now + wait)) look(next++);
        if (direction == 0) return;
        if (holds || came_from == 0)
          events.push_back(stickslip::EventKind::breakaway);
        else if (came_from != direction)
          events.push_back(stickslip::EventKind::reversal);
        came_from = 0;
        now += wait;
        load_ = rate_ * now - start;
        acceleration_ = wait > 0 ? 0 : direction > 0 ? net - f : net + b;
        known = true;
        if (now >= duration) return;
        continue;
      }
      if (!std::exchange(known, false)) acceleration_ = load_ - w_ * w_ * x - Real(direction) * level(x, direction);
      if (++steps > max_steps) throw TooLong();
      const bool stops = step(duration - now);
      while (seen(now + h_)) {
        const Real from_x = x, from_v = v, from_error = x_error;
        const Real part = std::clamp((times[next] - now) / h_, Real(0), Real(1));
        x = from_x + way(part), v = velocity(part);
        account(part, true);
        look(next++);
        x = from_x, v = from_v, x_error = from_error, v_error = saved_error_;
      }
      account(1, false);
      x += way(1);
      v = stops ? 0 : velocity(1);
      now = h_ == duration - now ? duration : now + h_;
      peak = std::max(peak, std::abs(x));
      peak_error = std::max(peak_error, x_error);
      if (stops) {
        came_from = std::exchange(direction, 0);
        judge_stop(came_from, duration - now);
      } else if (now >= duration) {
        return;
      }
    }
  }

  /// The effect of a rounding error in time on the velocity here.
  Real time_error() const { return round_off * scale() * duration_; }

 private:
  static constexpr int order = 28;
  static constexpr Real round_off = 32 * std::numeric_limits<double>::epsilon();
  static constexpr Real least = 0x1p-1066L;  // largest error from underflow
  using Series = std::array<Real, order + 1>;
  static constexpr auto one_over = [] {
    std::array<Real, 2 * order + 4> table{};
    for (std::size_t k = 1; k < table.size(); ++k) table[k] = 1 / Real(k);
    return table;
  }();

  Real level(Real at, int way_) const {
    const Real a = way_ > 0 ? forward_ : backward_;
    return std::isinf(reach_) ? a : a / std::cosh(at / reach_);
  }

  // The largest acceleration that is rounded.
  Real scale() const {
    const Real friction = level(x, direction == 0 ? 1 : direction);
    return std::abs(load_) + std::abs(rate_) * duration_ + friction * (1 + std::min(std::abs(x / reach_), Real(1e3))) +
           w_ * w_ * std::abs(x);
  }

  // Series of v over h_, with time in units of h_; shortened until it converges, and has a velocity that does not
  // vanish or runs one way. Whether it then ends in a stop.
  bool step(Real left) {
    h_ = left;
    if (w_ > 0) h_ = std::min(h_, 2 / w_);
    if (!std::isinf(reach_)) {  // towards the center no jump over it
      const Real ahead = std::max(reach_, std::abs(x)) * (Real(direction) * x < 0 ? 0.125L : 2);
      if (v != 0) h_ = std::min(h_, ahead / std::abs(v));
      if (acceleration_ != 0) h_ = std::min(h_, std::sqrt(ahead / std::abs(acceleration_)));
      if (rate_ != 0) h_ = std::min(h_, std::cbrt(ahead / std::abs(rate_)));
    }
    expand();
    const Real s = Real(direction);
    for (int attempts = 0;; ++attempts) {
      if (attempts > 1000) throw std::logic_error("the independent slider finds no step");
      int first = 0;
      while (first < terms_ && c_[first] == 0) ++first;
      Real rest = 0, slopes = 0;
      for (int k = terms_; k > first; --k) rest += std::abs(c_[k]);
      for (int k = terms_; k > 1; --k) slopes += Real(k) * std::abs(c_[k]);
      Real part = 0;
      if (terms_ == 2 || (vanishes_up_to(terms_, c_, std::abs(c_[first]) + rest) &&
                          vanishes_up_to(terms_, level_, std::abs(level_[0]) + std::abs(level_[1])))) {
        const bool keeps_sign = std::abs(c_[first]) > rest;
        if (keeps_sign && s * c_[first] <= 0) throw std::logic_error("the independent slider goes backward");
        min_speed_ = std::abs(c_[0]) - rest;
        if (keeps_sign && first > 0) min_speed_ = s * velocity(1);
        if (keeps_sign && min_speed_ > 0) return false;
        if (first == 0 && std::abs(c_[1]) > slopes) {
          min_speed_ = std::min(std::abs(c_[0]), s * velocity(1));
          if (min_speed_ > 0) return false;
          min_speed_ = never;
          shorten(stop());
          return true;
        }
        // Far below, one of two coefficients decides.
        const Real next = c_[first + 1], other = first + 2 <= terms_ ? c_[first + 2] : 0;
        part = std::min(std::abs(c_[first] / (4 * next)), std::sqrt(std::abs(c_[first] / (4 * other))));
        if (first == 0) part = std::max(part, std::abs(c_[1] / (4 * c_[2])));
      }
      shorten(part > 0 && part < 0.5L ? part : 0.5L);
    }
  }

  // On breaking away at x = 0 five of six coefficients are zero.
  static bool vanishes_up_to(int last, const Series& c, Real biggest) {
    Real recent = 0;
    for (int k = std::max(last - 6, 0); k <= last; ++k) recent = std::max(recent, std::abs(c[k]));
    return recent <= 0x1p-66L * biggest;
  }

  void expand() {
    const Real s = Real(direction), a = direction > 0 ? forward_ : backward_;
    const bool caster = !std::isinf(reach_) && a > 0;
    terms_ = caster || w_ > 0 ? order : 2;
    c_[0] = v, c_[1] = h_ * acceleration_;
    level_[0] = level(x, direction);
    Real biggest = std::max(std::abs(c_[0]), std::abs(c_[1]));
    Series y, tangent, q;  // x / reach, tanh of it, (x' / reach) sech
    if (caster) {
      y[0] = h_ * c_[0] / reach_;
      tangent[0] = std::tanh(x / reach_);
      q[0] = level_[0] * y[0];
    }
    for (int k = 1; k < terms_; ++k) {
      Real friction = 0;
      if (caster) {  // sech' = -sech tanh, tanh' = sech^2
        Real of_level = 0, of_tangent = 0;
        for (int i = 0; i < k; ++i) of_level += q[i] * tangent[k - 1 - i], of_tangent += q[i] * level_[k - 1 - i];
        friction = level_[k] = -of_level * one_over[k];
        tangent[k] = of_tangent * one_over[k] / (a * a);
        y[k] = h_ * c_[k] / reach_;
        Real product = 0;
        for (int i = 0; i <= k; ++i) product += level_[i] * y[k - i];
        q[k] = product;
      }
      const Real gain = k == 1 ? rate_ * h_ : 0, pull = w_ * w_ * h_ * c_[k - 1] * one_over[k];
      c_[k + 1] = h_ * (gain - s * friction - pull) * one_over[k + 1];
      biggest = std::max(biggest, std::abs(c_[k + 1]));
      if (k >= 8 && vanishes_up_to(k + 1, c_, biggest) && (!caster || vanishes_up_to(k, level_, level_[0])))
        terms_ = k + 1;
    }
    if (caster)
      level_[terms_] = 0;  // beyond the relevant terms
    else
      std::fill_n(&level_[1], terms_, Real(0));
  }

  void shorten(Real part) {
    Real power = 1;
    for (int k = 0; k <= terms_; ++k, power *= part) c_[k] *= power, level_[k] *= power;
    h_ *= part;
  }

  Real velocity(Real part) const {
    Real sum = 0;
    for (int k = terms_; k >= 0; --k) sum = sum * part + c_[k];
    return sum;
  }

  Real way(Real part) const {
    Real sum = 0;
    for (int k = terms_; k >= 0; --k) sum = sum * part + c_[k] * one_over[k + 1];
    return h_ * part * sum;
  }

  // The velocity runs one way and changes its sign.
  Real stop() const {
    Real low = 0, high = 1, at = 0.5L;
    for (int i = 0; i < 100; ++i) {
      Real value = 0, slope = 0;
      for (int k = terms_; k >= 0; --k) slope = slope * at + value, value = value * at + c_[k];
      (Real(direction) * value > 0 ? low : high) = at;
      const Real next = at - value / slope;
      if (std::abs(next - at) < 0x1p-62L * at) return std::clamp(next, low, high);
      at = next > low && next < high ? next : low + (high - low) / 2;
      if (at <= low || at >= high) break;
    }
    return high;
  }

  // Sums and error bounds over a part of the step; for a look in between, errors alone.
  void account(Real part, bool look) {
    saved_error_ = v_error;
    Real fastest = 0;
    for (int k = 0; k <= terms_; ++k) fastest += std::abs(c_[k]);
    const Real time = h_ * part, distance = std::abs(way(part)), a = scale() + w_ * w_ * fastest * h_;
    const Real reach_error = std::isinf(reach_) ? 0 : slope_of_level();
    const Real lost_below = least * ((1 + duration_) * (1 + duration_) + a + fastest + (w_ > 0 ? a / w_ : 0));
    const Real x_rounding = round_off * (std::abs(x) + fastest * h_) + lost_below;
    const Real v_rounding = round_off * (fastest + a * duration_) + lost_below + w_ * x_rounding;
    v_error += v_rounding + reach_error * x_error * time;
    x_error += time * v_error + x_rounding;
    if (w_ > 0 && reach_error == 0) x_error = std::min(x_error, v_error / w_);
    if (x_error > reach_ / 8) x_error = v_error = never;
    if (look) return;

    const Real gain = rate_ * h_;
    Real work = 0, friction = 0;
    for (int k = 0; k <= terms_; ++k) work += c_[k] * (load_ * one_over[k + 1] + gain * one_over[k + 2]);
    if (std::isinf(reach_))
      friction = level_[0] * distance;
    else
      for (int i = 0; i <= terms_; ++i)
        for (int k = 0; k <= terms_ - i; ++k) friction += level_[i] * c_[k] * one_over[i + k + 1];
    if (!std::isinf(reach_)) friction *= Real(direction) * h_;
    input += h_ * work;
    dissipated += friction;
    path += distance;
    const Real lost = time * v_error + x_rounding;
    path_error += lost;
    input_error += a * lost + (round_off * a + least) * distance;
    dissipated_error += (level_[0] + a) * lost + reach_error * x_error * distance + (round_off * a + least) * distance;
    imbalance += v_rounding * (fastest + v_rounding) + a * (x_rounding + round_off * distance);
    largest = std::max({largest, std::abs(x) + distance, fastest * fastest, a * a, a * distance, std::abs(input), path,
                        w_ * w_ * x * x, a, a * duration_, gain / h_, w_ * w_ * fastest});
    if (min_speed_ <= 4 * v_error) clear = false;
  }

  // Largest slope of the level on the way of this step, whose ends are at most a reach apart.
  Real slope_of_level() const {
    const Real a = direction > 0 ? forward_ : backward_;
    return std::min(a / 2, 1.8L * std::max(level(x, direction), level(x + way(1), direction))) / reach_;
  }

  void judge_stop(int came_from, Real left) {
    Real slope = 0, steepest = 0;
    for (int k = 1; k <= terms_; ++k) slope += Real(k) * c_[k] / h_;
    for (int k = 2; k <= terms_; ++k) steepest += Real(k * (k - 1)) * std::abs(c_[k]) / (h_ * h_);
    slope = -Real(came_from) * slope;  // positive
    if (!(slope * slope > 8 * steepest * v_error)) {
      clear = false;
      stop_error_ = slope > 0 ? std::sqrt(v_error / (1e-300L + steepest)) : left;
    } else {
      stop_error_ = 2 * v_error / slope + round_off * duration_;
      if (left < 2 * stop_error_) clear = false;
    }
    x_error += v_error * stop_error_;
  }

  // How clear is it that a slider at rest holds, or slips?
  void judge(Real net, Real last, Real f, Real b, Real wait, bool from_start) {
    const Real rounding = round_off * scale() + least * (1 + std::abs(x) + duration_);
    const bool exact = w_ == 0 && (std::isinf(reach_) || x == 0) && from_start;
    const Real slope = std::isinf(reach_) ? 0 : std::max(f, std::isinf(b) ? 0 : b) / reach_;
    const Real force_error = exact ? 0 : rounding + (w_ * w_ + slope) * x_error + std::abs(rate_) * stop_error_;
    stop_error_ = 0;
    const Real margin_now = std::min(std::abs(f - net), std::abs(b + net));
    const Real margin_then = wait > 0 ? std::min(std::abs(f - last), std::abs(b + last)) : never;
    if (!exact && std::min(margin_now, margin_then) <= 2 * force_error) clear = false;
    if (wait <= 0) return;
    if (exact && v_error == 0) return;
    Real drift = wait * v_error;
    if (margin_now > 2 * force_error && margin_now * wait > 8 * v_error) {
      v_error = w_ * x_error;  // it surely rests before it slips again
    } else {
      if (v_error > w_ * x_error) clear = false;
      v_error += rounding * duration_;
      drift = wait * v_error;
    }
    if (margin_then <= 2 * force_error) v_error += force_error * wait, drift += force_error * wait * wait;
    x_error += drift;
    path_error += drift;
    input_error += drift * (std::abs(load_) + std::abs(rate_) * duration_);
    dissipated_error += drift * std::max(f, std::isinf(b) ? 0 : b);
  }

  static constexpr Real never = std::numeric_limits<Real>::infinity();

  Real forward_, backward_, reach_, w_;
  Real duration_ = 0, rate_ = 0, load_ = 0, acceleration_ = 0;
  Real h_ = 0, min_speed_ = 0, stop_error_ = 0, saved_error_ = 0;
  int terms_ = order;
  Series c_{}, level_{};
};

}  // namespace test
