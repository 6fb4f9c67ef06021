// The motion under friction that is defined by numbers only, or that depends on temperature, by collocation.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <exception>
#include <optional>

#include "stickslip/base/equal.hpp"
#include "stickslip/base/error.hpp"
#include "stickslip/base/min_max.hpp"
#include "stickslip/flow/detail/maker.hpp"
#include "stickslip/flow/power_series.hpp"
#include "stickslip/friction/law.hpp"
#include "stickslip/numerics/collocation.hpp"
#include "stickslip/slider/slider.hpp"
#include "stickslip/state/state.hpp"

namespace stickslip {

namespace detail {

using Nodes = numerics::Collocation<8>;

/// Cooling and heating of a surface within a step. Coefficients are cached while the step length stays the same.
class Cooling {
 public:
  /// Half-integrals of the heat from before the step, at the nodes of the step.
  [[gnu::noinline]] Nodes::Values half_integrals(const SurfaceHeat& heat, double step) {
    if (!heat.warm()) return {};
    if (!alike(step, step_)) {
      step_ = step;
      for (std::size_t i = 0; i < left_.size(); ++i) left_[i] = SurfaceHeat::decay(Nodes::get().nodes[i] * step);
    }
    return heat.half_integrals_after(left_);
  }

  /// Heat the surface for a fraction `part` of a step.
  [[gnu::noinline]] void heat(SurfaceHeat& heat, const Nodes::Values& q, double step, double part) {
    if (part < 1) return heat.heat(q, SurfaceHeat::Step(part * step), part);
    if (!alike(step, heating_step_)) heating_.emplace(heating_step_ = step);
    heat.heat(q, *heating_);
  }

 private:
  // Time steps of a record differ by round-off.
  static bool alike(double one, double other) noexcept { return std::abs(one - other) <= 1e-12 * one; }

  double step_ = -1;
  std::array<SurfaceHeat::Modes, Nodes::points> left_{};
  std::optional<SurfaceHeat::Step> heating_;
  double heating_step_ = -1;
};

}  // namespace detail

/// A slip under a law that is defined by numbers only, or that depends on temperature. The acceleration is a polynomial
/// of degree 8 in time that satisfies, at nine Chebyshev points of the step,
///     d'' = a + g(t) - wn^2 d - c (d' - u) - [w resist(x0 +- d, d') - w0 resist(x0, u)],   thesis (2.27), (2.50)
/// with the terms of TaylorFlow. It is found by iteration. The step (the horizon) is shortened until the last
/// coefficients of the acceleration contribute at most 1e-11 of the speed (1e-8 with temperature), or are round-off of
/// the forces, and until the step ends shortly after a stop. After the stop the speed is negative; there the resistance
/// is continued to be odd about its value at zero speed. A step that leaves the range of speeds possible in it, or in
/// which the law has no level, is shortened too.
///
/// Frictional heat generated within the step affects the step itself: its half-integral is a matrix times the heat at
/// the nodes.
template <FrictionLaw Law, class SlipStart = Start>
class CollocationFlow : public PowerSeriesFlow<SlipStart> {
  using Base = PowerSeriesFlow<SlipStart>;
  using Base::at_part, Base::end_series, Base::find_first_stop, Base::integral, Base::stiffness, Base::weight;
  using Base::loaded, Base::mounting_, Base::direction_, Base::displacement_, Base::start_, Base::gain_, Base::horizon_,
      Base::order_, Base::distance_, Base::speed_, Base::acceleration_, Base::end_, Base::weight_rate_,
      Base::rise_rate_;
  using Nodes = detail::Nodes;
  using Values = Nodes::Values;
  static constexpr bool heated = HeatedLaw<Law>;

 public:
  /// Kept out of line: inlining it wherever a flow is made would take a compiler minutes.
  /// @param longest  step to try first [s]
  [[gnu::noinline]] CollocationFlow(const Slider<Law>& slider, Direction direction, const detail::StateOf<Law>& state,
                                    const SlipStart& start, double duration, double longest, detail::Cooling& cooling)
      : Base(slider.mounting(), direction, state.displacement, start, duration, longest),
        law_(slider.law()),
        cooling_(cooling) {
    if (detail::equal(start.speed, 0) && start.acceleration < 0) {  // the slip cannot begin
      stand();
      return;
    }
    if constexpr (heated) heating_ = law_.heating(state, direction);
    if constexpr (loaded)
      level_here_ = start.weight * start.level;
    else
      level_here_ = resist(law_at(law_, state), state.displacement, start.speed, direction);
    horizon_ = std::min(horizon_, longest_trial());
    for (;;) {
      if constexpr (heated) before_ = cooling.half_integrals(state.heat, horizon_);
      const bool found = solve();
      const double shorter = found ? horizon_to_stop() : horizon_ / 2;
      if (found && !(shorter < horizon_)) return;
      if (!(shorter > 0x1p-200 * duration && shorter < horizon_)) break;
      if ((no_level_ || no_number_) && stays()) break;
      horizon_ = shorter;
    }
    if (no_level_) std::rethrow_exception(no_level_);
    if (no_number_)
      throw ConvergenceError("the resistance is not finite next to x = " + detail::shortest(state.displacement) +
                             " m and a speed of " + detail::shortest(start.speed) + " m/s");
    throw ConvergenceError("friction changes too fast to be followed at x = " + detail::shortest(state.displacement) +
                           " m and a speed of " + detail::shortest(start.speed) +
                           " m/s: it must be a continuous function of both");
  }

  /// As `ClosedForm::first_stop`, within the horizon.
  double first_stop() const noexcept { return stop_; }

  /// Work against friction up to time t [m^2/s^2].
  double friction_work(double t) const noexcept {
    return integral(t, [&](const Progress& at, double s) { return power(friction_, s) * at.speed; });
  }

  /// Update the surface with the heat generated up to time t.
  void heat(double t, SurfaceHeat& surface) const requires heated {
    if (heating_ > 0 && t > 0)
      cooling_.heat(surface, heat_, horizon_, t / horizon_);
    else
      surface.rest(t);
  }

 private:
  static double power(const Values& coefficients, double s) noexcept {
    double sum = 0;
    for (std::size_t k = coefficients.size(); k-- > 0;) sum = sum * s + coefficients[k];
    return sum;
  }

  // Resistance at a node [m/s^2].
  double level(std::size_t i, double x, double speed, double half_integral) const {
    const auto at = [&](double v) {
      if constexpr (heated)
        return law_.level(v, weight(Nodes::get().nodes[i]), half_integral);
      else
        return resist(law_, x, v, direction_);
    };
    return speed >= 0 ? at(speed) : 2 * at(0) - at(-speed);
  }

  // A step beyond which the first trial would be far from the motion: one over which a spring or a damper changes the
  // speed by more than itself.
  double longest_trial() const noexcept {
    double longest = never;
    if (mounting_.natural_frequency > 0) longest = 2 / mounting_.natural_frequency;
    if (mounting_.damping > 0) longest = std::min(longest, 2 / mounting_.damping);
    return longest;
  }

  // Bound on the change of the speed within the horizon by all forces that can accelerate the slider [m/s].
  double gain_of_speed() const noexcept {
    double force = std::abs(start_.acceleration) + level_here_ + gain_.largest(horizon_, 1);
    force += mounting_.damping * start_.speed;
    force += mounting_.spring().rate(std::abs(weight_rate_)) * horizon_ * std::abs(displacement_);
    return horizon_ * force;
  }
  // Whether the motion within the horizon is too small to matter.
  bool stays() const noexcept {
    const double gain = gain_of_speed(), way = horizon_ * (start_.speed + gain);
    return gain <= 0x1p-40 * start_.speed && way <= 0x1p-40 * std::abs(displacement_);
  }

  // Compute the motion over the horizon. Returns false if the horizon must be shortened.
  bool solve() {
    no_level_ = nullptr;
    no_number_ = false;
    try {
      return iterate();
    } catch (const NoLevel&) {
      no_level_ = std::current_exception();
      return false;
    }
  }
  bool iterate() {
    const Nodes& nodes = Nodes::get();
    const double h = horizon_, s = sign(direction_), damping = mounting_.damping, root_h = std::sqrt(h);
    constexpr std::size_t n = Nodes::points;
    Values a{}, v{}, d{}, force{}, q{};
    for (std::size_t i = 0; i < n; ++i) a[i] = start_.acceleration + gain_.at(h, nodes.nodes[i]);
    a[0] = start_.acceleration;
    const Spring spring = mounting_.spring();
    const auto pull = [&](std::size_t i, double way) {  // change of the spring force since the start
      if constexpr (loaded) {
        const double now = weight(0), then = weight(nodes.nodes[i]);
        return spring.under(then) * way + spring.rate(then - now) * s * displacement_;
      } else {
        return spring.stiffness * way;
      }
    };
    // No force of this step makes the slider faster; a spring, up to four times as fast over `longest_trial`.
    const double speed_limit = 4 * (start_.speed + gain_of_speed());
    double fastest = 0, change = 0, least = 0;  // the round-off of the terms of the acceleration
    for (int sweep = 0;; ++sweep) {
      const double previous = change;
      double terms = 0;
      fastest = start_.speed;
      change = 0;
      for (std::size_t i = 0; i < n; ++i) {
        double gained = 0, way = 0, half = 0;
        for (std::size_t k = 0; k < n; ++k) {
          gained += nodes.integral[i][k] * a[k];
          way += nodes.double_integral[i][k] * a[k];
        }
        v[i] = start_.speed + h * gained;
        d[i] = h * (nodes.nodes[i] * start_.speed + h * way);
        fastest = std::max(fastest, std::abs(v[i]));
        if (!(fastest <= speed_limit)) return false;
        if constexpr (heated) {
          for (std::size_t k = 0; k < n; ++k) half += nodes.half_integral[i][k] * q[k];
          half = std::max(before_[i] + root_h * half, 0.0);
        }
        force[i] = weight(nodes.nodes[i]) * level(i, displacement_ + s * d[i], v[i], half);
        if constexpr (heated) q[i] = heating_ * force[i] * std::max(v[i], 0.0);
        const double drag = damping * (v[i] - start_.speed), back = pull(i, d[i]);
        terms = std::max(terms, std::abs(start_.acceleration) + std::abs(back) + std::abs(drag) + std::abs(force[i]));
        if (i == 0) continue;
        const double net = start_.acceleration + gain_.at(h, nodes.nodes[i]) - back - drag - (force[i] - force[0]);
        no_number_ = !std::isfinite(net);
        if (no_number_ || (sweep == 0 && h * std::abs(net - a[i]) > speed_limit)) return false;
        change = std::max(change, std::abs(net - a[i]));
        a[i] = net;
      }
      least = 4 * round_off * terms;
      // The next change would be smaller by the ratio of this change to the previous one.
      if (sweep > 0 && (h * change * change <= convergence * fastest * previous || change <= least)) break;
      if (sweep > 3 && change > previous / 2) return false;
      if (sweep == 60) return false;
    }
    const auto noise = [](const Values& values) {
      double largest = 0;
      for (const double value : values) largest = std::max(largest, std::abs(value));
      return round_off * largest;
    };
    const Values c = nodes.chebyshev(a);
    const double last = std::abs(c[n - 1]) + std::abs(c[n - 2]);
    if (h * last > tolerance * fastest && last > least) return false;
    Values coefficients;
    int degree = Nodes::powers(c, noise(a), coefficients);
    coefficients[0] = start_.acceleration;
    if constexpr (!heated) {  // of a slip that begins, only round-off can change the sign
      if (rise_rate_ > 0 && !(coefficients[1] > 0)) coefficients[1] = rise_rate_ * h, degree = std::max(degree, 1);
    }
    speed_[0] = start_.speed;
    distance_[0] = h * start_.speed;
    for (int k = 0; k <= degree; ++k) {
      acceleration_[k] = coefficients[static_cast<std::size_t>(k)];
      speed_[k + 1] = h * acceleration_[k] * series::reciprocal[k + 1];
      distance_[k + 1] = h * speed_[k + 1] * series::reciprocal[k + 2];
    }
    end_series(degree + 2);
    Nodes::powers(nodes.chebyshev(force), noise(force), friction_);
    if constexpr (heated) Nodes::powers(nodes.chebyshev(q), noise(q), heat_);
    end_ = at_part(1);
    stop_ = find_first_stop();
    return true;
  }

  // The horizon, or if the slip stops well before it, a little more than the time to the stop.
  double horizon_to_stop() const noexcept { return stop_ > 0 && stop_ < 0.95 * horizon_ ? 1.02 * stop_ : horizon_; }

  void stand() noexcept {
    acceleration_[0] = start_.acceleration;
    speed_[0] = distance_[0] = 0;
    speed_[1] = horizon_ * start_.acceleration;
    distance_[1] = horizon_ * speed_[1] / 2;
    end_series(2);
    end_ = at_part(1);
    stop_ = 0;
  }

  static constexpr double round_off = 0x1p-54;
  static constexpr double tolerance = heated ? 1e-8 : 1e-11, convergence = tolerance / 64;

  const Law& law_;
  detail::Cooling& cooling_;
  Values before_{}, friction_{}, heat_{};
  double heating_ = 0, stop_ = never;
  double level_here_ = 0;        // at the start, under the weight there [m/s^2]
  std::exception_ptr no_level_;  // of the last trial
  bool no_number_ = false;       // whether it met a resistance that is not finite
};

/// Makes the flows of a slider by collocation.
template <FrictionLaw Law>
class Collocating : public detail::LawFlows<Law> {
  using Base = detail::LawFlows<Law>;
  using Nodes = detail::Nodes;

 public:
  explicit Collocating(const Slider<Law>& slider) : Base(slider.law()), slider_(slider) {}

  double pull(double x, double weight) const noexcept { return slider_.mounting().spring().under(weight) * x; }
  double drag(double speed) const noexcept { return slider_.damping() * speed; }

  template <class SlipStart>
  CollocationFlow<Law, SlipStart> flow(Direction direction, const detail::StateOf<Law>& state, const SlipStart& start,
                                       double duration) const {
    const CollocationFlow<Law, SlipStart> flow(slider_, direction, state, start, duration, 2 * last_step_, cooling_);
    const double step = flow.horizon();
    last_step_ = step < duration ? step : std::max(step, last_step_);
    return flow;
  }

  using Base::remember;
  template <class Flow>
  void remember(const Flow& flow, double time, State& state) const requires HeatedLaw<Law> {
    flow.heat(time, state.heat);
  }

  using Base::departure;
  /// Of a level that changes as the surface cools. The margins are approximated by polynomials on successive parts of
  /// the time, to 1e-9 of the level.
  template <class Load, class Bounds>
  [[gnu::noinline]] detail::Departure departure(const Load& load, const Bounds&, State& state, double /*net*/,
                                                double /*pull*/, double forward, double backward,
                                                double left) const requires HeatedLaw<Law> {
    const Nodes& nodes = Nodes::get();
    const Law& law = this->law_;
    detail::Departure departure;
    for (double passed = 0, step = left;;) {
      const Nodes::Values half = cooling_.half_integrals(state.heat, step);
      Nodes::Values holds, net;
      double scale = 0;
      for (std::size_t i = 0; i < half.size(); ++i) {
        const double then = std::max(left - (passed + nodes.nodes[i] * step), 0.0), weight = load.weight(then);
        holds[i] = weight * law.level(0, weight, half[i]);
        net[i] = load.before_end(then) - pull(state.displacement, weight);
        scale = std::max(scale, std::abs(net[i]) + holds[i]);
      }
      bool resolved = true;
      const auto first_exceeded = [&](Direction direction, double level) -> double {
        if (!(level < never)) return never;
        Nodes::Values margin, powers;
        for (std::size_t i = 0; i < margin.size(); ++i) margin[i] = holds[i] - sign(direction) * net[i];
        const Nodes::Values c = nodes.chebyshev(margin);
        resolved = resolved && std::abs(c[c.size() - 1]) + std::abs(c[c.size() - 2]) <= 1e-9 * scale;
        int degree = Nodes::powers(c, 1e-15 * scale, powers);
        const double* from = powers.data();
        if (!(margin[0] > 0))  // a load equal to the level is held
          for (++from, --degree; degree >= 0 && detail::equal(*from, 0);) ++from, --degree;
        if (degree < 0) return never;
        return *from > 0 ? FirstRoot(from, degree).find() : 0;
      };
      const double to_forward = first_exceeded(Direction::forward, forward);
      const double to_backward = first_exceeded(Direction::backward, backward);
      if (!resolved && step > 0x1p-40 * left) {
        step /= 2;
        continue;
      }
      const double part = std::min(to_forward, to_backward);
      // At the end of the segment the next one decides: a level may vanish there with its weight.
      if (passed + part * step < left * (1 - 0x1p-48)) {
        state.heat.rest(part * step);
        departure.mode = to_forward <= to_backward ? Mode::forward : Mode::backward;
        departure.delay = passed + part * step;
        const Direction direction = direction_of(departure.mode);
        const double weight = load.weight(left - departure.delay);
        departure.net =
            sign(direction) * Load::weigh(weight, hold(law_at(law, state, weight), state.displacement, direction));
        return departure;
      }
      state.heat.rest(step);
      passed += step;
      if (!(passed < left && step > 0)) return departure;  // a time that is almost no number may have no half
      step = std::min(2 * step, left - passed);
    }
  }

 private:
  const Slider<Law>& slider_;
  mutable double last_step_ = never;  // step to which a flow was last shortened [s]
  mutable detail::Cooling cooling_;
};

}  // namespace stickslip
