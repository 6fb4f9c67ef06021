// The motion under friction that varies with position or speed, as a Taylor series of high order.
#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>

#include "stickslip/detail/equal.hpp"
#include "stickslip/detail/min_max.hpp"
#include "stickslip/error.hpp"
#include "stickslip/flow/closed_form.hpp"
#include "stickslip/flow/sinusoidal.hpp"
#include "stickslip/friction/law.hpp"
#include "stickslip/numerics/gauss_legendre.hpp"
#include "stickslip/numerics/root.hpp"
#include "stickslip/series/dual.hpp"
#include "stickslip/series/series.hpp"
#include "stickslip/slider.hpp"

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

/// A slip under friction that varies with position or speed. The distance slid d is a Taylor series in time that solves
///     d'' = a + g(t) - wn^2 d - c (d' - u) - [resist(x0 +- d, d') - resist(x0, u)],      thesis (2.27), (2.50)
/// where g is the change of the load, linear in time or sinusoidal; the coefficients are found order by order
/// (series.hpp). Under a variable normal force, a weight w = N/g that is linear in time multiplies the resistance and
/// the spring of a pendulum.
///
/// Orders are added until they are below round-off at the end of the step, where the equation of motion is then checked
/// against the law itself. If `highest_order` is not enough, the step (the horizon) is shortened.
template <FrictionLaw Law, class SlipStart = Start>
class TaylorFlow {
  static constexpr bool loaded = std::same_as<SlipStart, LoadStart>;

 public:
  /// @param longest  step to try first [s]
  TaylorFlow(const Slider<Law>& slider, Direction direction, double displacement, const SlipStart& start,
             double duration, double longest = never)
      : slider_(slider),
        direction_(direction),
        displacement_(displacement),
        start_(start),
        gain_(detail::gain_series(start, duration)),
        weight_rate_(weight_rate(start, duration)),
        level_here_(resist(slider.law(), displacement, direction, start.speed)),
        horizon_(std::min(std::min(duration, longest), gain_.reach(slider.natural_frequency()))) {
    // If the level has nearly underflowed, its series does not show how the level rises toward the center: cover at
    // most half of that distance.
    if (level_here_ <= vanishing && sign(direction) * displacement < 0 &&
        resist(slider.law(), 0.0, direction, start.speed) > vanishing)
      horizon_ = std::min(horizon_, time_to_half_way());

    for (;;) {
      double within_reach = expand();
      if (detail::equal(within_reach, 1)) {
        if constexpr (SpeedLaw<Law>) {
          stop_ = find_first_stop();
          if (!balanced_where_slowest()) within_reach = 0.5;
        }
        if (detail::equal(within_reach, 1)) return;
      }
      const double longer = std::exchange(horizon_, horizon_ * within_reach);
      if (!(horizon_ < longer && horizon_ > 0x1p-200 * duration))
        throw ConvergenceError("the slip level has no finite power series at x = " + detail::shortest(displacement) +
                               " m, where it is " + detail::shortest(level_here_) + " m/s^2");
    }
  }

  double horizon() const noexcept { return horizon_; }

  /// As `ClosedForm::first_stop`, within the horizon.
  double first_stop() const noexcept {
    if constexpr (SpeedLaw<Law>)
      return stop_;
    else
      return find_first_stop();
  }

  Progress at(double t) const noexcept { return at_part(t / horizon_); }
  Progress at_horizon() const noexcept { return end_; }

  /// Net acceleration at the start [m/s^2].
  double acceleration() const noexcept { return start_.acceleration; }

  /// As `SinusoidalFlow::variation`: the series of y'' = -(wn^2 +- resist'(x)) y - c y' from (1, 0) and from (0, 1).
  std::array<double, 4> variation(double t) const requires PositionLaw<Law> {
    constexpr int order = series::highest_order;
    const double h = horizon_;
    series::Coefficients x, stiffness, y[2];
    x[0] = displacement_;
    for (int k = 1; k <= order; ++k) x[k] = k <= order_ ? sign(direction_) * distance_[k - 1] : 0;
    auto slope = series::slope_of(slider_.law().resist(series::variable(x), direction_));
    for (const int i : {0, 1}) y[i][i] = 1, y[i][1 - i] = 0;
    for (int k = 0; k + 2 <= order; ++k) {
      slope.update(k);
      stiffness[k] = h * h * (sign(direction_) * slope[k] + (k == 0 ? slider_.stiffness() : 0));
      for (auto& c : y)
        c[k + 2] =
            -(series::convolve(stiffness, c, 0, k) * series::reciprocal[k + 1] + h * slider_.damping() * c[k + 1]) *
            series::reciprocal[k + 2];
    }
    const double s = t / h;
    double value[2] = {0, 0}, rate[2] = {0, 0};
    for (const int i : {0, 1})
      for (int k = order; k >= 0; --k) {
        rate[i] = rate[i] * s + value[i];
        value[i] = value[i] * s + y[i][k];
      }
    return {value[0], value[1] * h, rate[0] / h, rate[1]};
  }

  /// Work on the damper within t [m^2/s^2].
  double damped_work(double t) const noexcept {
    if (detail::equal(slider_.damping(), 0)) return 0;
    return slider_.damping() * integral(t, [](const Progress& at, double) { return at.speed * at.speed; });
  }
  /// Work against friction within t [m^2/s^2].
  double friction_work(double t) const {
    return integral(t, [&](const Progress& at, double part) {
      return weight(part) * at.speed *
             resist(slider_.law(), displacement_ + sign(direction_) * at.distance, direction_, at.speed);
    });
  }

  /// Work that the deviation of the normal force from g does on a pendulum within t [m^2/s^2]: the integral of
  /// wn^2 (1 - w) x x'.
  double pendulum_work(double t) const noexcept requires loaded {
    if (!slider_.mounting().pendulum) return 0;
    return slider_.stiffness() * integral(t, [&](const Progress& at, double part) {
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
      for (int k = 1; k <= order_; ++k) sum += way[k] * reciprocal_sums[i + k];
      work += gain(i) * sum;
    }
    return work;
  }

 private:
  // The integral of a function of the motion within t. 20-point Gauss-Legendre quadrature is exact for products of two
  // series whose last terms are below round-off.
  template <class Function>
  double integral(double t, Function&& of) const {
    return horizon_ * numerics::gauss_integral<20>(0, t / horizon_, [&](double s) { return of(at_part(s), s); });
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

  // A level that changes fast only at low speeds does not show this at high speed. The equation of motion must
  // therefore also hold at the minimum of the speed.
  bool balanced_where_slowest() {
    double slowest = stop_ < never ? stop_ / horizon_ : 1;
    if (detail::equal(slowest, 1) && start_.acceleration < 0 && end_.acceleration > 0)
      slowest = numerics::root([&](double s) { return at_part(s).acceleration; }, 0, start_.acceleration, 1,
                               end_.acceleration);
    if (detail::equal(slowest, 1) || detail::equal(slowest, 0)) return true;
    const bool holds = balanced(slowest);
    end_ = at_part(1);
    return holds;
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

  // Computes the coefficients, for time in units of the horizon. Returns 1, or the fraction of the horizon over which a
  // series can converge.
  double expand() {
    const double s = sign(direction_), h = horizon_, stiffness = slider_.stiffness(), damping = slider_.damping();
    series::Coefficients x;
    series::Coefficients v;  // of the speed, if the law depends on it
    auto level = as_series(resist(slider_.law(), series::Variable{&x}, direction_, series::Variable{&v}));
    x[0] = displacement_;
    speed_[0] = start_.speed;
    if constexpr (SpeedLaw<Law>) v[0] = start_.speed;
    distance_[0] = start_.speed * h;
    x[1] = s * distance_[0];
    level.update(0);

    const double largest_level = std::max(std::abs(level[0]), vanishing);
    fastest_ = speed_[0];
    double term = speed_[0];
    auto gain = gain_.coefficients(h);
    // The weight, a series of two terms, for products with it.
    const double weight_now = weight(0), weight_gains = weight_rate_ * h;
    const bool pendulum = loaded && slider_.mounting().pendulum;
    for (int k = 0; k + 2 <= series::highest_order; ++k) {
      double net = start_.acceleration;
      if (k > 0) {
        level.update(k);
        if constexpr (loaded) {
          double pull = distance_[k - 1];
          if (pendulum) pull = weight_now * pull + weight_gains * (k == 1 ? s * displacement_ : distance_[k - 2]);
          net = gain(k) - stiffness * pull - (weight_now * level[k] + weight_gains * level[k - 1]);
        } else {
          net = gain(k) - stiffness * distance_[k - 1] - level[k];
        }
        if (damping > 0) net -= damping * speed_[k];
      }
      acceleration_[k] = net;
      speed_[k + 1] = h * net * series::reciprocal[k + 1];
      if constexpr (SpeedLaw<Law>) v[k + 1] = speed_[k + 1];
      distance_[k + 1] = h * speed_[k + 1] * series::reciprocal[k + 2];
      x[k + 2] = s * distance_[k + 1];
      const double previous = std::exchange(term, std::abs(speed_[k + 1]));
      fastest_ = std::max(fastest_, term);
      if (k < 2 || std::max(term, previous) > round_off * fastest_) continue;
      end_series(k + 2);
      // Just after breakaway x is cubic in time, and two of three coefficients of the level are zero. A linear level
      // converges as fast as the speed.
      const double recent_level =
          LinearLaw<Law> ? 0 : std::max(std::max(std::abs(level[k]), std::abs(level[k - 1])), std::abs(level[k - 2]));
      // From rest, or nearly so, x may also return to its start at the horizon, where the check would then see nothing.
      const bool fast = start_.speed > fastest_ / 16;
      if (recent_level <= largest_level && (fast || balanced(0.6)) && balanced(1)) return 1;
    }
    end_series(series::highest_order);
    const double last = std::max(std::abs(speed_[order_ - 1]), std::abs(speed_[order_ - 2])) / fastest_;
    const double outgrown = std::max(last / round_off, std::abs(level[order_ - 2]) / largest_level);
    const double part = std::pow(outgrown, -1.0 / (order_ - 2));
    return part > 0x1p-20 ? std::min(part, 0.75) : 0x1p-20;  // also where the coefficients overflowed
  }

  // `order` is the highest order of the distance. Zeros are stored above it for sums taken in pairs.
  void end_series(int order) noexcept {
    order_ = order;
    distance_[order] = speed_[order] = acceleration_[order] = acceleration_[order - 1] = 0;
  }

  // Whether the equation of motion holds at a fraction of the horizon, up to the round-off of its terms and the series.
  bool balanced(double part) {
    end_ = at_part(part);
    const double level_there =
        resist(slider_.law(), displacement_ + sign(direction_) * end_.distance, direction_, end_.speed);
    const double gain = gain_.at(horizon_, part), drag = slider_.damping() * (end_.speed - start_.speed);
    const double now = weight(0), then = weight(part);
    double pull = slider_.stiffness() * end_.distance;
    if constexpr (loaded)
      if (slider_.mounting().pendulum)
        pull = then * pull + slider_.stiffness() * (then - now) * sign(direction_) * displacement_;
    const double net = start_.acceleration + gain - pull - drag - (then * level_there - now * level_here_);
    const double terms = std::abs(start_.acceleration) + gain_.largest(horizon_, part) + std::abs(pull) +
                         slider_.damping() * fastest_ + now * std::abs(level_here_) + then * std::abs(level_there) +
                         slider_.stiffness() * std::abs(displacement_) + fastest_ / horizon_;
    return std::abs(net - end_.acceleration) <= 32 * round_off * terms + 1e-300;
  }

  // The distance is bounded by d <= u t + (|a| + |j| t) t^2: each of the three terms may use a third of it (of half of
  // |x|).
  double time_to_half_way() const noexcept {
    const double third = std::abs(displacement_) / 6;
    return std::min(std::min(third / start_.speed, std::sqrt(third / std::abs(start_.acceleration))),
                    std::cbrt(third) / std::cbrt(gain_.steepest()));
  }

  // 1/k, for k = 1 to twice the highest order.
  static constexpr auto reciprocal_sums = [] {
    std::array<double, 2 * series::highest_order + 1> table{};
    for (std::size_t k = 1; k < table.size(); ++k) table[k] = 1.0 / static_cast<double>(k);
    return table;
  }();

  static auto as_series(double level) noexcept { return series::Constant{level}; }
  template <series::Series S>
  static S as_series(const S& level) noexcept {
    return level;
  }

  static constexpr double vanishing = 1e-290;  // a negligible slip level, about to lose digits by underflow [m/s^2]
  static constexpr double round_off = std::numeric_limits<double>::epsilon() / 4;

  const Slider<Law>& slider_;
  Direction direction_;
  double displacement_;
  SlipStart start_;
  decltype(detail::gain_series(SlipStart{}, 0)) gain_;
  double weight_rate_;
  double level_here_;  // [m/s^2]
  double horizon_;
  double fastest_ = 0;  // the largest term of the speed [m/s]
  int order_ = 0;
  // Coefficients, for time in units of the horizon, of the distance divided by that time [m], of the speed [m/s] and of
  // the acceleration [m/s^2].
  double distance_[series::highest_order + 1], speed_[series::highest_order + 1],
      acceleration_[series::highest_order + 1];
  Progress end_{};       // at the horizon
  double stop_ = never;  // kept where the law depends on the speed [s]
};

/// Makes the Taylor flows of one slider.
template <FrictionLaw Law>
struct Taylor {
  const Slider<Law>& slider;
  mutable double last_step = never;  // to which a flow was last shortened, for long segments of motion [s]

  double pull(double displacement) const noexcept { return slider.stiffness() * displacement; }
  double drag(double speed) const noexcept { return slider.damping() * speed; }

  bool pendulum() const noexcept { return slider.mounting().pendulum; }

  TaylorFlow<Law> flow(Direction direction, double displacement, const Start& start, double duration) const {
    return {slider, direction, displacement, start, duration};
  }

  TaylorFlow<Law, LoadStart> flow(Direction direction, double displacement, const LoadStart& start,
                                  double duration) const {
    return {slider, direction, displacement, start, duration};
  }

  TaylorFlow<Law, SinusoidalStart> flow(Direction direction, double displacement, const SinusoidalStart& start,
                                        double duration) const {
    const TaylorFlow<Law, SinusoidalStart> flow(slider, direction, displacement, start, duration, 1.25 * last_step);
    const double step = flow.horizon();
    last_step = step < duration ? step : std::max(step, last_step);
    return flow;
  }
};

}  // namespace stickslip
