// A motion given as a power series in time.
#pragma once

#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <type_traits>

#include "stickslip/base/equal.hpp"
#include "stickslip/base/min_max.hpp"
#include "stickslip/flow/closed_form.hpp"
#include "stickslip/flow/sinusoidal.hpp"
#include "stickslip/numerics/gauss_legendre.hpp"
#include "stickslip/series/series.hpp"
#include "stickslip/slider/slider.hpp"
#include "stickslip/state/state.hpp"

namespace stickslip {

/// Finds the first root on [0, 1] of a polynomial that is positive at 0.
///
/// The number of sign changes of its Bernstein coefficients on an interval is the number of its roots there, or exceeds
/// it by an even number (Descartes' rule). Without a change there is no root; with one change there is one root, which
/// Newton's method finds inside its bracket; otherwise the interval is halved. A double root, which bisection cannot
/// separate, is a graze: the speed touches zero and rises again.
class FirstRoot {
 public:
  /// @param w  coefficients of t^0 .. t^degree, w[0] > 0
  FirstRoot(const double* w, int degree) noexcept : w_(w), degree_(degree) {}

  /// The first root, in (0, 1]; `never` if there is none.
  double find() const noexcept {
    double fall = 0;
    for (int k = 1; k <= degree_; ++k) fall += std::min(w_[k], 0.0);
    if (w_[0] + fall > 0) return never;

    // Tighter bounds on the value and the slope, by Horner's rule with the worse of t = 0 and t = 1 at each step.
    double lowest = 0, steepest = 0, last = 0, order = degree_;
    for (int k = degree_; k >= 1; --k, --order) {
      lowest = w_[k] + std::min(lowest, 0.0);
      steepest = order * w_[k] + std::max(steepest, 0.0);
      last += w_[k];
    }
    last += w_[0];
    if (w_[0] + std::min(lowest, 0.0) > 0) return never;
    if (steepest < 0) return last > 0 ? never : polish(0, 1);  // it decreases throughout

    Bernstein coefficients;
    double* const b = coefficients.data();
    double binomial = 1;
    for (int k = 0; k <= degree_; ++k) {
      b[k] = w_[k] / binomial;
      binomial *= static_cast<double>(degree_ - k) / (k + 1);
    }
    for (int i = 1; i <= degree_; ++i)
      for (int k = degree_; k >= i; --k) b[k] += b[k - 1];
    const double last_value = b[degree_], root = search(b, 0, 1);
    return detail::equal(root, never) && last_value <= 0 ? 1 : root;  // at the end, up to rounding
  }

 private:
  using Bernstein = std::array<double, series::highest_order + 1>;

  double search(double* b, double left, double width) const noexcept {
    int changes = 0;
    for (int k = 1; k <= degree_; ++k) changes += (b[k - 1] >= 0) != (b[k] >= 0);
    if (changes == 0) return never;
    if (changes == 1) return polish(left, left + width);
    if (width < 0x1p-40) return never;
    Bernstein half;
    double* const first = half.data();  // de Casteljau: `b` becomes the second half
    for (int i = 0; i <= degree_; ++i) {
      first[i] = b[0];
      for (int k = 0; k < degree_ - i; ++k) b[k] = (b[k] + b[k + 1]) / 2;
    }
    const double root = search(first, left, width / 2);
    return root < never ? root : search(b, left + width / 2, width / 2);
  }

  // Newton's method: the slope costs little once the value is computed. It starts at the zero of the parabola through
  // the start. Even and odd powers are summed separately, to shorten the chain of dependent additions.
  double polish(double low, double high) const noexcept {
    const double guess = degree_ < 2 ? 1 : first_root(w_[0], w_[1], 2 * w_[2]);
    double t = guess > low && guess < high ? guess : low + (high - low) / 2;
    for (int steps = 0;; ++steps) {
      const double z = t * t;
      double even = 0, odd = 0, even_slope = 0, odd_slope = 0;  // derivatives with respect to z
      for (int k = degree_ & ~1; k >= 0; k -= 2) {
        even_slope = even_slope * z + even;
        even = even * z + w_[k];
      }
      for (int k = (degree_ - 1) | 1; k >= 1; k -= 2) {
        odd_slope = odd_slope * z + odd;
        odd = odd * z + w_[k];
      }
      const double value = even + t * odd, slope = 2 * t * (even_slope + t * odd_slope) + odd;
      (value > 0 ? low : high) = t;
      double next = t - value / slope;
      if (std::abs(next - t) <= 0x1p-52 * t) return t;
      if (!(next > low && next < high) || steps > 64) next = low + (high - low) / 2;  // powers of t may underflow
      if (next <= low || next >= high) return high;
      t = next;
    }
  }

  const double* w_;
  int degree_;
};

namespace detail {

/// The first zero in [0, 1] of a polynomial that is at least 0 just after 0; `never` if there is none. Zeros at 0 are
/// divided out; if it is negative just after them, the zero is at 0.
inline double first_zero(const double* c, int degree) noexcept {
  int zeros = 0;
  while (zeros <= degree && equal(c[zeros], 0)) ++zeros;
  if (zeros > degree) return never;
  if (c[zeros] < 0) return 0;
  return FirstRoot(c + zeros, degree - zeros).find();
}

/// The change of a load since the start of a flow, as a power series: linear in time.
class GainSeries {
 public:
  GainSeries(const Start& start, double duration) noexcept : rate_(start.gain / duration) {}

  /// The longest step over which the series keeps its digits [s].
  double reach(double /*natural_frequency*/) const noexcept { return never; }

  /// Coefficients for time in units of h, to be called in order from k = 1 [m/s^2].
  auto coefficients(double h) const noexcept {
    return [first = rate_ * h](int k) { return k == 1 ? first : 0.0; };
  }

  double at(double h, double part) const noexcept { return rate_ * h * part; }
  double largest(double h, double part) const noexcept { return std::abs(at(h, part)); }
  double steepest() const noexcept { return std::abs(rate_); }  // [m/s^3]

 private:
  double rate_;
};

/// The change of a sinusoidal load. Its terms rise to exp(omega h) before they fall: over two radians of the load or of
/// the spring, one digit is lost. Both are treated alike, so resonance needs no special case.
class SinusoidalGainSeries {
 public:
  SinusoidalGainSeries(const SinusoidalStart& start, double /*duration*/) noexcept
      : start_(start),
        derivatives_{start.amplitude * std::cos(start.phase), -start.amplitude * std::sin(start.phase)} {}

  double reach(double natural_frequency) const noexcept { return 2 / std::max(start_.frequency, natural_frequency); }

  auto coefficients(double h) const noexcept {
    return [this, radians = start_.frequency * h, power = 1.0](int k) mutable {
      power *= radians * series::reciprocal[k];
      return (k & 2 ? -power : power) * derivatives_[k & 1];
    };
  }

  double at(double h, double part) const noexcept { return start_.gain_within(h * part, h); }
  double largest(double h, double part) const noexcept {
    return std::abs(start_.amplitude) * std::min(2.0, start_.frequency * h * part);
  }
  double steepest() const noexcept { return std::abs(start_.amplitude) * start_.frequency; }

 private:
  SinusoidalStart start_;
  double derivatives_[2];  // the load and its derivative with respect to the phase, at the start [m/s^2]
};

inline GainSeries gain_series(const Start& start, double duration) noexcept { return {start, duration}; }
inline GainSeries gain_series(const LoadStart& start, double duration) noexcept {
  return {Start{start.speed, start.acceleration, start.load_gain}, duration};
}
inline SinusoidalGainSeries gain_series(const SinusoidalStart& start, double duration) noexcept {
  return {start, duration};
}

}  // namespace detail

/// A slip whose acceleration is a power series in time: its first stop, its motion and the work done. Derived classes
/// compute the coefficients.
template <class SlipStart>
class PowerSeriesFlow {
 protected:
  static constexpr bool loaded = std::same_as<SlipStart, LoadStart>;

 public:
  double horizon() const noexcept { return horizon_; }

  Progress at(double t) const noexcept { return at_part(t / horizon_); }
  Progress at_horizon() const noexcept { return end_; }

  /// Net acceleration at the start [m/s^2].
  double acceleration() const noexcept { return start_.acceleration; }

  /// Work on the damper up to time t [m^2/s^2].
  double damped_work(double t) const noexcept {
    if (detail::equal(mounting_.damping, 0)) return 0;
    return mounting_.damping * integral(t, [](const Progress& at, double) { return at.speed * at.speed; });
  }

  /// Work done on a pendulum up to time t by the deviation of the normal force from g [m^2/s^2]: the integral of
  /// wn^2 (1 - w) x x'.
  double pendulum_work(double t) const noexcept requires loaded {
    if (!mounting_.pendulum) return 0;
    return stiffness() * integral(t, [&](const Progress& at, double part) {
             return (1 - weight(part)) * (sign(direction_) * displacement_ + at.distance) * at.speed;
           });
  }

  /// Work of the change of the load since the start [m^2/s^2]: the integral of the product of two series.
  double work_of_gain(double t) const noexcept {
    const double s = t / horizon_;
    auto gain = gain_.coefficients(horizon_ * s);
    double way[series::highest_order + 1], power = horizon_, work = 0;
    for (int k = 1; k <= order_; ++k) way[k] = (power *= s) * speed_[k - 1];
    for (int i = 1; i <= order_; ++i) {
      double sum = 0;
      for (int k = 1; k <= order_; ++k) sum += way[k] * reciprocal_sums[static_cast<std::size_t>(i + k)];
      work += gain(i) * sum;
    }
    return work;
  }

 protected:
  PowerSeriesFlow(const Mounting& mounting, Direction direction, double displacement, const SlipStart& start,
                  double duration, double longest)
      : mounting_(mounting),
        direction_(direction),
        displacement_(displacement),
        start_(start),
        gain_(detail::gain_series(start, duration)),
        weight_rate_(weight_rate(start, duration)),
        rise_rate_(rise_rate(start, duration)),
        horizon_(std::min(std::min(duration, longest), gain_.reach(mounting.natural_frequency))) {}
  ~PowerSeriesFlow() = default;

  double stiffness() const noexcept { return mounting_.natural_frequency * mounting_.natural_frequency; }

  // The integral of a function of the motion up to time t, by Gauss-Legendre quadrature. With m points it errs by
  // 1 / ((2 m + 1) (2 m over m)^2) times the coefficient of degree 2 m. In the square of the fastest oscillation whose
  // series is below round-off at the order here, that is less than round-off.
  template <class Function>
  double integral(double t, Function&& of) const {
    const auto by = [&]<std::size_t points>(std::integral_constant<std::size_t, points>) {
      return horizon_ * numerics::gauss_integral<points>(0, t / horizon_, [&](double s) { return of(at_part(s), s); });
    };
    if (order_ <= 20) return by(std::integral_constant<std::size_t, 8>{});
    if (order_ <= 26) return by(std::integral_constant<std::size_t, 10>{});
    return by(std::integral_constant<std::size_t, 12>{});
  }

  double find_first_stop() const noexcept {
    // Skipping leading zeros removes roots at the start.
    int leading = 0;
    while (leading < order_ && detail::equal(speed_[leading], 0)) ++leading;
    // All coefficients underflow if a slip does begin but is too slow for doubles.
    const double gain = [&] {
      if constexpr (loaded)
        return start_.gain;  // change of the load minus change of friction
      else
        return start_.gain_within(horizon_, horizon_);
    }();
    const bool begins =
        start_.speed > 0 || start_.acceleration > 0 || (detail::equal(start_.acceleration, 0) && gain > 0);
    if (leading == order_) return begins ? never : 0;
    if (speed_[leading] < 0) return 0;
    const double root = FirstRoot(speed_ + leading, order_ - 1 - leading).find();
    return root < never ? root * horizon_ : never;
  }

  // N/g at a fraction of the horizon, and its rate [1/s].
  double weight(double part) const noexcept {
    if constexpr (loaded)
      return start_.weight + weight_rate_ * horizon_ * part;
    else
      return 1;
  }
  static double weight_rate(const SlipStart& start, double duration) noexcept {
    if constexpr (loaded)
      return start.weight_gained / duration;
    else
      return 0;
  }

  // The rate of the acceleration of a slip that begins at its level, handed over by the departure [m/s^3]; else 0.
  static double rise_rate(const SlipStart& start, double duration) noexcept {
    if constexpr (loaded)
      return start.begins ? start.gain / duration : 0;
    else if constexpr (std::same_as<SlipStart, Start>)
      return start.speed > 0 || !detail::equal(start.acceleration, 0) ? 0 : std::max(start.gain, 0.0) / duration;
    else
      return 0;
  }

  // Even and odd powers are summed separately, to shorten the chain of dependent additions. The value at the start, by
  // far the largest term, is added last and unrounded.
  Progress at_part(double s) const noexcept {
    struct Sums {
      double distance = 0, speed = 0, acceleration = 0, mean = 0;
    } even, odd;
    const double z = s * s;
    for (int k = (order_ + 1) & ~1;; k -= 2) {
      odd.distance = odd.distance * z + distance_[k - 1];
      odd.speed = odd.speed * z + speed_[k - 1];
      odd.acceleration = odd.acceleration * z + acceleration_[k - 1];
      odd.mean = odd.mean * z + distance_[k - 1] * series::reciprocal[k + 1];
      if (k == 2) break;
      even.distance = even.distance * z + distance_[k - 2];
      even.speed = even.speed * z + speed_[k - 2];
      even.acceleration = even.acceleration * z + acceleration_[k - 2];
      even.mean = even.mean * z + distance_[k - 2] * series::reciprocal[k];
    }
    const auto gained = [s, z](double of_odd, double of_even) { return s * of_odd + z * of_even; };
    return {s * (distance_[0] + gained(odd.distance, even.distance)), start_.speed + gained(odd.speed, even.speed),
            start_.acceleration + gained(odd.acceleration, even.acceleration),
            s * (distance_[0] / 2 + gained(odd.mean, even.mean))};
  }

  // `order` is the highest order of the distance. Zeros are stored above it for sums taken in pairs.
  void end_series(int order) noexcept {
    order_ = order;
    distance_[order] = speed_[order] = acceleration_[order] = acceleration_[order - 1] = 0;
  }

  // 1/k, for k = 1 to twice the highest order.
  static constexpr auto reciprocal_sums = [] {
    std::array<double, 2 * series::highest_order + 1> table{};
    for (std::size_t k = 1; k < table.size(); ++k) table[k] = 1.0 / static_cast<double>(k);
    return table;
  }();

  const Mounting& mounting_;
  Direction direction_;
  double displacement_;
  SlipStart start_;
  decltype(detail::gain_series(SlipStart{}, 0)) gain_;
  double weight_rate_;  // of N/g [1/s]
  double rise_rate_;    // [m/s^3]
  double horizon_;
  int order_ = 0;
  // Coefficients, for time in units of the horizon, of the distance divided by that time [m], of the speed [m/s] and of
  // the acceleration [m/s^2].
  double distance_[series::highest_order + 1], speed_[series::highest_order + 1],
      acceleration_[series::highest_order + 1];
  Progress end_{};  // at the horizon
};

}  // namespace stickslip
