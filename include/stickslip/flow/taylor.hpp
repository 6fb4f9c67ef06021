// The motion under friction that varies with position or speed, as a Taylor series of high order.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <type_traits>
#include <utility>

#include "stickslip/base/equal.hpp"
#include "stickslip/base/error.hpp"
#include "stickslip/base/min_max.hpp"
#include "stickslip/flow/detail/maker.hpp"
#include "stickslip/flow/power_series.hpp"
#include "stickslip/flow/sinusoidal.hpp"
#include "stickslip/friction/law.hpp"
#include "stickslip/numerics/root.hpp"
#include "stickslip/series/dual.hpp"
#include "stickslip/series/series.hpp"
#include "stickslip/slider/slider.hpp"

namespace stickslip {

/// A slip under friction that varies with position or speed. The distance slid d is a Taylor series in time that solves
///     d'' = a + g(t) - wn^2 d - c (d' - u) - [resist(x0 +- d, d') - resist(x0, u)],      thesis (2.27), (2.50)
/// where g is the change of the load, linear in time or sinusoidal; the coefficients are found order by order
/// (series.hpp). Under a variable normal force, a weight w = N/g that is linear in time multiplies the resistance and
/// the spring of a pendulum.
///
/// Orders are added until they are below round-off at the end of the step, where the equation of motion is then checked
/// against the law itself, as is the level alone under a variable weight. If `highest_order` is not enough, the step
/// (the horizon) is shortened.
template <FrictionLaw Law, class SlipStart = Start>
class TaylorFlow : public PowerSeriesFlow<SlipStart> {
  using Base = PowerSeriesFlow<SlipStart>;
  using Base::at_part, Base::end_series, Base::find_first_stop, Base::integral, Base::weight;
  using Base::loaded, Base::direction_, Base::displacement_, Base::start_, Base::gain_, Base::weight_rate_,
      Base::rise_rate_, Base::horizon_, Base::order_, Base::distance_, Base::speed_, Base::acceleration_, Base::end_;

 public:
  /// Kept out of line: inlining it wherever a flow is made doubles the compile time of a law.
  /// @param longest  step to try first [s]
  [[gnu::noinline]] TaylorFlow(const Slider<Law>& slider, Direction direction, double displacement,
                               const SlipStart& start, double duration, double longest = never)
      : Base(slider.mounting(), direction, displacement, start, duration, longest),
        slider_(slider),
        level_here_(resist(slider.law(), displacement, start.speed, direction)) {
    // If the level has nearly underflowed, its series does not show how the level rises toward the center: cover at
    // most half of that distance.
    if (std::abs(level_here_) <= vanishing && sign(direction) * displacement < 0 &&
        resist(slider.law(), 0.0, start.speed, direction) > vanishing)
      horizon_ = std::min(horizon_, time_to_half_way());
    // Under a constant level, the speed then has at most one minimum, which is checked.
    if constexpr (SpeedLaw<Law>)
      if (slider.stiffness() > 0) horizon_ = std::min(horizon_, std::numbers::pi / slider.natural_frequency());

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

  /// As `ClosedForm::first_stop`, within the horizon.
  double first_stop() const noexcept {
    if constexpr (SpeedLaw<Law>)
      return stop_;
    else
      return find_first_stop();
  }

  /// As `SinusoidalFlow::variation`, from the series of y'' = -(wn^2 +- resist'(x)) y - c y' from (1, 0) and from (0,
  /// 1).
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

  /// Work against friction up to time t [m^2/s^2].
  double friction_work(double t) const {
    return integral(t, [&](const Progress& at, double part) {
      return weight(part) * at.speed * friction(slider_.law(), place(at), at.speed, direction_);
    });
  }

  /// As `PowerSeriesFlow::pendulum_work`, also on the springs that a law contains.
  double pendulum_work(double t) const requires loaded {
    double work = Base::pendulum_work(t);
    if constexpr (detail::SpringLaw<Law>)
      work += integral(t, [&](const Progress& at, double part) {
        const double pull = resist(slider_.law(), place(at), at.speed, direction_) -
                            friction(slider_.law(), place(at), at.speed, direction_);
        return (1 - weight(part)) * at.speed * pull;
      });
    return work;
  }

 private:
  // x [m].
  double place(const Progress& at) const noexcept { return displacement_ + sign(direction_) * at.distance; }

  // A level that changes fast only at low speeds cannot be recognized as such at high speed. The equation of motion
  // must therefore also hold at the minimum of the speed.
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

  // Computes the coefficients, for time in units of the horizon. Returns 1, or the fraction of the horizon over which a
  // series can converge.
  double expand() {
    const double s = sign(direction_), h = horizon_, stiffness = slider_.stiffness(), damping = slider_.damping();
    series::Coefficients x;
    series::Coefficients v;  // of the speed, if the law depends on it
    auto level = as_series(resist(slider_.law(), series::Variable{&x}, series::Variable{&v}, direction_));
    x[0] = displacement_;
    speed_[0] = start_.speed;
    if constexpr (SpeedLaw<Law>) v[0] = start_.speed;
    distance_[0] = start_.speed * h;
    x[1] = s * distance_[0];
    level.update(0);

    const double largest_level = std::max(std::abs(level[0]), vanishing);
    fastest_ = speed_[0];
    double term = speed_[0];
    keep_level(0, level);
    auto gain = gain_.coefficients(h);
    // The weight, a series of two terms, for products with it.
    const double weight_now = weight(0), weight_gains = weight_rate_ * h;
    const bool pendulum = loaded && slider_.mounting().pendulum;
    for (int k = 0; k + 2 <= series::highest_order; ++k) {
      double net = start_.acceleration;
      if (k > 0) {
        level.update(k);
        keep_level(k, level);
        if constexpr (loaded) {
          double pull = distance_[k - 1];
          if (pendulum) pull = weight_now * pull + weight_gains * (k == 1 ? s * displacement_ : distance_[k - 2]);
          net = gain(k) - stiffness * pull - (weight_now * level[k] + weight_gains * level[k - 1]);
          if (k == 1 && rise_rate_ > 0) net = rise_rate_ * h;
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
          form_of<Law> == Form::linear
              ? 0
              : std::max(std::max(std::abs(level[k]), std::abs(level[k - 1])), std::abs(level[k - 2]));
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

  // Whether the equation of motion holds at a fraction of the horizon, up to the round-off of its terms and the series.
  bool balanced(double part) {
    end_ = at_part(part);
    const double level_there =
        resist(slider_.law(), displacement_ + sign(direction_) * end_.distance, end_.speed, direction_);
    const double gain = gain_.at(horizon_, part), drag = slider_.damping() * (end_.speed - start_.speed);
    const double now = weight(0), then = weight(part);
    double pull = slider_.stiffness() * end_.distance;
    if constexpr (loaded) {
      const Spring spring = slider_.mounting().spring();
      pull = spring.under(then) * end_.distance + spring.rate(then - now) * sign(direction_) * displacement_;
    }
    const double net = start_.acceleration + gain - pull - drag - (then * level_there - now * level_here_);
    const double terms = std::abs(start_.acceleration) + gain_.largest(horizon_, part) + std::abs(pull) +
                         slider_.damping() * fastest_ + now * std::abs(level_here_) + then * std::abs(level_there) +
                         slider_.stiffness() * std::abs(displacement_) + fastest_ / horizon_;
    const double tolerance = 32 * round_off * terms + 1e-300;
    if (!(std::abs(net - end_.acceleration) <= tolerance)) return false;
    if constexpr (loaded) {
      // Where the weight vanishes, the equation of motion does not show the level.
      if (!detail::equal(weight_rate_, 0)) {
        double level = 0;
        for (int k = last_level_; k >= 0; --k) level = level * part + level_[static_cast<std::size_t>(k)];
        if (!(std::max(now, then) * std::abs(level - level_there) <= tolerance)) return false;
      }
    }
    return true;
  }

  // Keep a coefficient of the level, for time in units of the horizon [m/s^2].
  template <class Series>
  void keep_level(int k, const Series& level) noexcept {
    if constexpr (loaded) level_[static_cast<std::size_t>(last_level_ = k)] = level[k];
  }

  // The distance is bounded by d <= u t + (|a| + |j| t) t^2: each of the three terms may use a third of it (of half of
  // |x|).
  double time_to_half_way() const noexcept {
    const double third = std::abs(displacement_) / 6;
    return std::min(std::min(third / start_.speed, std::sqrt(third / std::abs(start_.acceleration))),
                    std::cbrt(third) / std::cbrt(gain_.steepest()));
  }

  static auto as_series(double level) noexcept { return series::Constant{level}; }
  template <series::Series S>
  static S as_series(const S& level) noexcept {
    return level;
  }

  static constexpr double vanishing = 1e-290;  // a negligible slip level, about to lose digits by underflow [m/s^2]
  static constexpr double round_off = std::numeric_limits<double>::epsilon() / 4;

  const Slider<Law>& slider_;
  double level_here_;    // at the start [m/s^2]
  double fastest_ = 0;   // the largest term of the speed [m/s]
  double stop_ = never;  // kept where the law depends on the speed [s]
  int last_level_ = 0;
  std::array<double, loaded ? series::highest_order + 1 : 0> level_;  // of the series of the level
};

/// Makes the Taylor flows of one slider.
template <FrictionLaw Law>
class Taylor : public detail::LawFlows<Law> {
 public:
  explicit Taylor(const Slider<Law>& slider) : detail::LawFlows<Law>(slider.law()), slider_(slider) {}

  double pull(double x, double weight) const noexcept { return slider_.mounting().spring().under(weight) * x; }
  double drag(double speed) const noexcept { return slider_.damping() * speed; }

  template <class AnyState, class SlipStart>
  TaylorFlow<Law, SlipStart> flow(Direction direction, const AnyState& state, const SlipStart& start,
                                  double duration) const {
    return {slider_, direction, state.displacement, start, duration};
  }
  template <class AnyState>
  TaylorFlow<Law, SinusoidalStart> flow(Direction direction, const AnyState& state, const SinusoidalStart& start,
                                        double duration) const {
    const TaylorFlow<Law, SinusoidalStart> flow(slider_, direction, state.displacement, start, duration,
                                                1.25 * last_step_);
    const double step = flow.horizon();
    last_step_ = step < duration ? step : std::max(step, last_step_);
    return flow;
  }

 private:
  const Slider<Law>& slider_;
  mutable double last_step_ = never;  // step to which a flow was last shortened, for long segments [s]
};

}  // namespace stickslip
