// The motion of a structure with one sliding interface over a short time, as power series.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "stickslip/base/equal.hpp"
#include "stickslip/base/error.hpp"
#include "stickslip/flow/power_series.hpp"
#include "stickslip/friction/law.hpp"
#include "stickslip/ground/ground_motion.hpp"
#include "stickslip/numerics/root.hpp"
#include "stickslip/series/series.hpp"
#include "stickslip/structure/response.hpp"
#include "structure/modal_interface.hpp"

namespace stickslip::detail {

/// Load and weight over a segment, both linear in time.
struct GroundLoad {
  double duration;                          ///< [s]
  double start, end;                        ///< ground acceleration n at both ends [m/s^2]
  double weight_start = 1, weight_end = 1;  ///< N+/g at both ends

  double ground(double left) const noexcept { return at(start, end, left); }
  double weight(double left) const noexcept { return at(weight_start, weight_end, left); }

 private:
  double at(double first, double last, double left) const noexcept { return last + (first - last) * (left / duration); }
};

using Polynomial = std::array<double, series::highest_order + 1>;

inline double value_at(const double* c, int degree, double u) {
  double value = 0;
  for (int k = degree; k >= 0; --k) value = value * u + c[k];
  return value;
}

/// The Bernstein coefficients of a polynomial on [0, 1], which lie around it.
Polynomial bernstein(const double* c, int degree);

/// The largest magnitude of a polynomial on [0, 1], or `least` if that is larger.
double largest_magnitude(const double* c, int degree, double least);

/// The integral over [0, 1] of a product of polynomials.
double product_integral(const double* a, int degree_a, const double* b, int degree_b);

inline double mean_step(const GroundMotion& motion) noexcept {
  return motion.duration() / static_cast<double>(motion.segments());
}

/// @param step  mean time between the samples of the ground motion [s]
/// @throws std::invalid_argument  fastest times step is above SlidingStructure::most_rate_per_step
void check_rate(const ModalInterface& of, double step);

/// A law over a short time, whose level is a factor of time and one of the speed:
///
///     power(k, h)            // the k-th coefficient of the factor of time, for time in units of h [m/s^2]
///     resist(factor, speed)  // for numbers and series
template <class Law>
concept LawInTime = requires(const Law& law, double value) {
  law.power(0, value);
  law.resist(value, value);
};

/// Power series of the motion over a duration h, for time in units of h.
class Expansion {
 public:
  /// @throws as `check_rate`: the work of a motion has a bound before it begins
  Expansion(const ModalInterface& of, double step)
      : of_(of),
        modes_(static_cast<std::size_t>(of.modes())),
        y_((series::highest_order + 1) * modes_),
        rate_(y_.size()),
        acceleration_(y_.size()),
        force_(modes_) {
    check_rate(of, step);
  }

  /// The longest duration of one expansion of linear equations [s]: its terms grow to exp(3) before they fall.
  double longest() const noexcept { return of_.fastest > 0 ? 3 / of_.fastest : never; }
  /// The longest duration that is an equal part of the time left in a segment [s].
  double share(double left) const noexcept {
    const double pieces = std::ceil(left / longest());
    return pieces > 1 ? left / pieces : left;
  }

  /// Expand from a state, stuck or with a law in a direction.
  /// @param left    time to the end of the segment [s]
  /// @param h       duration, at most `left` and, for linear equations, `longest`; a law may shorten it
  /// @param demand  q at the start [m/s^2]
  template <class Law>
  void expand(const StructureState& state, const GroundLoad& ground, double left, double h, double demand,
              const Law& law) {
    const double s = static_cast<double>(static_cast<int>(state.mode));
    const Direction direction = state.mode == Mode::backward ? Direction::backward : Direction::forward;
    for (;;) {
      h_ = h;
      series::Coefficients place, speed, factor;
      auto level = as_series(
          along(law, series::Variable{&factor}, series::Variable{&place}, series::Variable{&speed}, direction));
      const bool slides = state.mode != Mode::stuck;
      begin(state, ground, left, h);
      if constexpr (SpringLaw<Law>) dissipating_ = law.friction(state.displacement, direction);
      constexpr bool linear = std::is_same_v<decltype(level), series::Constant>;
      const int least = order_;
      if (!linear && slides) order_ = series::highest_order;
      double fastest = 0, highest = 0;
      for (int k = 0; k <= order_; ++k) {
        double net = take_demand(k, demand);
        if (slides) {
          place[k] = x_[at(k)];
          speed[k] = s * v_[at(k)];
          if constexpr (LawInTime<Law>) factor[k] = law.power(k, h);
          level.update(k);
          // The level that the demand has just exceeded, to the last digit: under a larger one, a slip would stop at
          // once, break away again, and so on without an end.
          level_[at(k)] =
              k > 0 ? level[k] : along(law, factor_at(law, 0), state.displacement, std::abs(state.velocity), direction);
          friction_[at(k)] = weight_[0] * level_[at(k)] + (k > 0 ? weight_[1] * level_[at(k - 1)] : 0);
          net = (net - of_.damper * v_[at(k)] - s * friction_[at(k)]) / of_.mass;
        } else {
          net = 0;
        }
        next(k, net);
        if constexpr (!linear) {
          fastest = std::max(fastest, std::abs(v_[at(k)]));
          highest = std::max(highest, std::abs(level_[at(k)]));
          if (slides && k >= least && ends(k, fastest, highest, 0)) order_ = k;
        }
      }
      if (linear || !slides ||
          (ends(order_, fastest, highest, slack(fastest)) &&
           (form_of<Law> == Form::linear || follows(law, s, direction, fastest, highest))))
        return;
      h /= 2;
      if (!(h > 0x1p-60 * ground.duration))
        throw ConvergenceError("the slip level has no finite power series at x = " + shortest(state.displacement) +
                               " m, x' = " + shortest(state.velocity) + " m/s");
    }
  }

  const ModalInterface& of() const noexcept { return of_; }
  double duration() const noexcept { return h_; }
  int order() const noexcept { return order_; }
  const double* demand() const noexcept { return q_.data(); }           // [m/s^2]
  const double* velocity() const noexcept { return v_.data(); }         // [m/s]
  const double* displacement() const noexcept { return x_.data(); }     // [m]
  const double* acceleration() const noexcept { return a_.data(); }     // x'' [m/s^2]
  const double* friction() const noexcept { return friction_.data(); }  // F [m/s^2]
  const double* level() const noexcept { return level_.data(); }        // of the law, under the weight g [m/s^2]
  /// The constant part of the level that dissipates, of a law that contains springs [m/s^2]; NaN: all of it does.
  double dissipating() const noexcept { return dissipating_; }
  const std::array<double, 2>& ground() const noexcept { return n_; }
  const std::array<double, 2>& weight() const noexcept { return weight_; }
  const double* pull() const noexcept { return pull_.data(); }
  using Rows = Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>;
  Rows modal_displacement() const noexcept { return rows(y_); }  // one row per order
  Rows modal_velocity() const noexcept { return rows(rate_); }
  Rows modal_acceleration() const noexcept { return rows(acceleration_); }

  /// Force of friction, spring and damper between both sides of the interface [m/s^2], positive where it pulls toward
  /// negative x.
  Polynomial force(Mode mode) const;
  /// Work against friction of a slip in a direction, without that of springs in the law, and against the damper of the
  /// interface [m^2/s^2].
  double friction_work(double s) const;
  double damper_work() const { return of_.damper * h_ * product_integral(v_.data(), order_, v_.data(), order_); }

  /// Distance slid in a direction at a part of h, and x' at it.
  double distance(double s, double u) const { return s * u * value_at(x_.data() + 1, order_ - 1, u); }
  double speed(double s, double u) const { return s * value_at(v_.data(), order_, u); }
  /// The part of h at which a slip in a direction stops; `never`.
  double first_stop(double s) const {
    Polynomial speed;
    for (int k = 0; k <= order_; ++k) speed[at(k)] = s * v_[at(k)];
    return first_zero(speed.data(), order_);
  }

  /// Keep the first part of the duration only.
  void restrict_to(double u) {
    if (equal(u, 1)) return;
    double power = 1;
    for (int k = 1; k <= order_; ++k) {
      power *= u;
      for (auto* c : {&q_, &v_, &x_, &a_, &friction_, &level_, &pull_}) (*c)[at(k)] *= power;
      double *y = row(y_, k), *rate = row(rate_, k), *acceleration = row(acceleration_, k);
      for (std::size_t j = 0; j < modes_; ++j) y[j] *= power, rate[j] *= power, acceleration[j] *= power;
    }
    n_[1] *= u;
    weight_[1] *= u;
    h_ *= u;
  }

  /// Write the modes at the end of the duration.
  void end(StructureState& state) const {
    double *y = state.modal_displacement.data(), *rate = state.modal_velocity.data();
    const double *last_y = row(y_, order_), *last_rate = row(rate_, order_);
    for (std::size_t j = 0; j < modes_; ++j) y[j] = last_y[j], rate[j] = last_rate[j];
    for (int k = order_ - 1; k >= 0; --k) {
      const double *more_y = row(y_, k), *more_rate = row(rate_, k);
      for (std::size_t j = 0; j < modes_; ++j) y[j] += more_y[j], rate[j] += more_rate[j];
    }
  }

 private:
  static std::size_t at(int k) noexcept { return static_cast<std::size_t>(k); }
  double* row(std::vector<double>& of, int k) const noexcept { return of.data() + at(k) * modes_; }
  const double* row(const std::vector<double>& of, int k) const noexcept { return of.data() + at(k) * modes_; }
  Rows rows(const std::vector<double>& of) const noexcept {
    return {of.data(), order_ + 1, static_cast<Eigen::Index>(modes_)};
  }

  static constexpr double round_off = std::numeric_limits<double>::epsilon() / 4;

  void begin(const StructureState& state, const GroundLoad& ground, double left,
             double h);                      // order of linear equations
  double take_demand(int k, double demand);  // q_k; keeps the forces of the modes
  void next(int k, double acceleration);

  // An error of the level that changes the velocity by less than round-off does not matter: far from its middle, a
  // caster's level is known to fewer digits, but is next to nothing.
  double slack(double fastest) const noexcept { return round_off * fastest * of_.mass / h_; }
  // Whether the terms of orders k - 1 and k are below round-off.
  bool ends(int k, double fastest, double highest, double slack) const noexcept {
    const auto last = [&](const Polynomial& c) { return std::max(std::abs(c[at(k)]), std::abs(c[at(k - 1)])); };
    return last(v_) <= round_off * fastest && last(level_) <= 0x1p-48 * highest + slack;
  }
  // Whether the level is that of its law, until the motion stops: also where it is slowest, because terms that are
  // lost in round-off at a high speed may be all of the level at a low one.
  template <class Law>
  bool follows(const Law& law, double s, Direction direction, double fastest, double highest) const {
    const double reach = std::min(first_stop(s), 1.0);
    const auto is_right = [&](double u) {
      const double x = value_at(x_.data(), order_, u), v = std::max(speed(s, u), 0.0);
      const double level = along(law, factor_at(law, u), x, v, direction);
      return std::abs(level - value_at(level_.data(), order_, u)) <= 0x1p-46 * highest + slack(fastest);
    };
    constexpr int parts = 16;
    std::array<double, parts + 1> speeds;
    for (int i = 0; i <= parts; ++i) speeds[at(i)] = speed(s, reach * i / parts);
    for (const int i : {4, 8, 12, 16})
      if (!is_right(reach * i / parts)) return false;
    // A caster may pass all of its level between two of these places: it is highest at x = 0.
    const auto place = [&](double u) { return value_at(x_.data(), order_, u); };
    const double from = x_[0], to = place(reach);
    if (from * to < 0 && !is_right(numerics::root(place, 0, from, reach, to))) return false;
    const auto slowest = static_cast<int>(std::min_element(speeds.begin(), speeds.end()) - speeds.begin());
    if (slowest == 0 || slowest == parts) return true;
    const double here = speeds[at(slowest)], before = speeds[at(slowest - 1)] - here;
    const double after = speeds[at(slowest + 1)] - here;  // the parabola through three points
    const double shift = before + after > 0 ? (before - after) / (2 * (before + after)) : 0;
    return is_right(reach * (slowest + shift) / parts);
  }

  // The resistance along the motion.
  template <class Law, class Factor, class X, class Speed>
  static auto along(const Law& law, const Factor& factor, const X& x, const Speed& speed, Direction direction) {
    if constexpr (LawInTime<Law>)
      return law.resist(factor, speed);
    else
      return resist(law, x, speed, direction);
  }
  template <class Law>
  double factor_at(const Law& law, double u) const {
    double factor = 1;
    if constexpr (LawInTime<Law>) {
      factor = 0;
      for (int k = order_; k >= 0; --k) factor = factor * u + law.power(k, h_);
    }
    return factor;
  }

  static auto as_series(double level) noexcept { return series::Constant{level}; }
  template <series::Series S>
  static S as_series(const S& level) noexcept {
    return level;
  }

  const ModalInterface& of_;
  std::size_t modes_;
  double h_ = 0;
  int order_ = 0;
  std::array<double, 2> n_{}, weight_{};
  Polynomial q_{}, v_{}, x_{}, a_{}, friction_{}, level_{}, pull_{};
  std::vector<double> y_, rate_, acceleration_;  // order by order
  std::vector<double> force_;                    // r of the present order
  double demand_force_ = 0;                      // demand.r of it
  double dissipating_ = std::numeric_limits<double>::quiet_NaN();
};

}  // namespace stickslip::detail
