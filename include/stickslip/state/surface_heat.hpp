// The memory of the heat that friction has generated at a surface.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "stickslip/base/error.hpp"
#include "stickslip/base/min_max.hpp"

namespace stickslip {

/// The memory of a surface that is heated with q(t) [W/m^2] and cools into the solid below: the half-integral
///     H(t) = integral of q(t - tau) / sqrt(tau) over tau > 0,
/// from which the temperature rise of the surface of a half-space is sqrt(D) / (k sqrt(pi)) H (H. S. Carslaw, J. C.
/// Jaeger, Conduction of heat in solids, 2nd ed. 1959, section 2.9).
///
/// 1 / sqrt(tau) = integral of exp(u/2 - tau exp(u)) du / sqrt(pi) is summed by the trapezoidal rule, its tails by one
/// exponential each: 42 exponentials, within 6e-7 of the largest H for heat that lasts from 1 us to 500 s. Each is a
/// mode y' = q - rate y, so that the cost does not depend on the length of the history.
class SurfaceHeat {
 public:
  static constexpr std::size_t modes = 42;
  using Modes = std::array<double, modes>;

  SurfaceHeat() noexcept {}  // the modes of a cold surface are not used
  SurfaceHeat(const SurfaceHeat& other) noexcept : warm_(other.warm_) {
    if (warm_) modes_ = other.modes_;
  }
  SurfaceHeat& operator=(const SurfaceHeat& other) noexcept {
    warm_ = other.warm_;
    if (warm_) modes_ = other.modes_;
    return *this;
  }
  /// A surface whose modes y_j [J/m^2] are `values`.
  /// @throws std::invalid_argument  a value that is not finite
  explicit SurfaceHeat(const Modes& values) : warm_(true), modes_(values) {
    for (const double value : values)
      detail::require(std::isfinite(value), "SurfaceHeat: modes must be finite", value, "J/m^2");
  }
  /// A surface whose present half-integral is H, without its history.
  static SurfaceHeat with(double half_integral) noexcept {
    SurfaceHeat heat;
    heat.warm_ = half_integral > 0;
    if (heat.warm_) {
      heat.modes_.fill(0);
      heat.modes_[0] = half_integral / table().weight[0];
    }
    return heat;
  }

  /// Whether it was ever heated.
  bool warm() const noexcept { return warm_; }
  /// y_j [J/m^2].
  Modes values() const noexcept { return warm_ ? modes_ : Modes{}; }

  /// The present H [W s^(1/2)/m^2].
  double half_integral() const noexcept {
    double sum = 0;
    if (warm_)
      for (std::size_t j = 0; j < modes; ++j) sum += table().weight[j] * modes_[j];
    return sum;
  }

  /// The factors exp(-rate t) by which the modes decay in a time t [s]. All rates but the first and the last are twice
  /// the one before, so that each factor is the square of the one before.
  [[gnu::noinline]] static Modes decay(double time) noexcept {
    const Modes& rate = table().rate;
    Modes left;
    left[0] = std::exp(-rate[0] * time);
    double less = std::expm1(-rate[1] * time);  // factor - 1, accurate also near 1
    for (std::size_t j = 1; j + 1 < modes; ++j) {
      left[j] = 1 + less;
      less *= 2 + less;
    }
    left[modes - 1] = std::exp(-rate[modes - 1] * time);
    return left;
  }

  /// The effect of a time step on the modes: their decay, and the contributions of heat that is a power of time.
  class Step {
   public:
    static constexpr int degree = 8;  // of heat

    /// @param time  [s]
    [[gnu::noinline]] explicit Step(double time) noexcept : time_(time), left_(decay(time)) {
      Modes x;
      for (std::size_t j = 0; j < modes; ++j) x[j] = table().rate[j] * time;
      // The integrals of exp(-x (1 - s)) s^k over s from 0 to 1. For small x the highest k is a series in x, and the
      // others follow from it downward; for large x the recurrence runs upward from the lowest.
      constexpr double small = 8;
      Modes sum, term;
      for (std::size_t j = 0; j < modes; ++j) term[j] = left_[j], sum[j] = left_[j] / (degree + 1);
      for (int m = 1; m <= 48; ++m) {
        const double by = 1.0 / m, share = 1.0 / (m + degree + 1);
        for (std::size_t j = 0; j < modes; ++j) sum[j] += share * (term[j] *= by * std::min(x[j], small));
      }
      for (std::size_t j = 0; j < modes; ++j) {
        if (x[j] < small) {
          added_[degree][j] = sum[j];
          for (int k = degree; k > 0; --k) added_[at(k - 1)][j] = (1 - x[j] * added_[at(k)][j]) / k;
        } else {
          added_[0][j] = (1 - left_[j]) / x[j];
          for (int k = 1; k <= degree; ++k) added_[at(k)][j] = (1 - k * added_[at(k - 1)][j]) / x[j];
        }
      }
    }

   private:
    friend class SurfaceHeat;
    static constexpr std::size_t at(int k) noexcept { return static_cast<std::size_t>(k); }

    double time_;
    Modes left_;
    std::array<Modes, degree + 1> added_;
  };

  /// H after each of several times without heat; `left` has the decay of each.
  template <std::size_t times>
  std::array<double, times> half_integrals_after(const std::array<Modes, times>& left) const noexcept {
    std::array<double, times> result{};
    if (!warm_) return result;
    Modes weighted;
    for (std::size_t j = 0; j < modes; ++j) weighted[j] = table().weight[j] * modes_[j];
    for (std::size_t i = 0; i < times; ++i) {
      double sum[6] = {};  // several sums in parallel: the terms of one sum would wait for each other
      for (std::size_t j = 0; j < modes; j += 6)
        for (std::size_t k = 0; k < 6; ++k) sum[k] += weighted[j + k] * left[i][j + k];
      result[i] = (sum[0] + sum[1]) + (sum[2] + sum[3]) + (sum[4] + sum[5]);
    }
    return result;
  }

  /// Cool for a time [s].
  [[gnu::noinline]] void rest(double time) noexcept {
    if (!warm_ || !(time > 0)) return;
    const Modes left = decay(time);
    for (std::size_t j = 0; j < modes; ++j) modes_[j] *= left[j];
  }

  /// Heat for a step with q = sum of q_k (t / unit)^k [W/m^2]: exact to round-off for the modes.
  /// @param step  of a time that is `part` of the unit
  void heat(const std::array<double, Step::degree + 1>& q, const Step& step, double part = 1) noexcept {
    if (!warm_) modes_.fill(0);
    warm_ = true;
    Modes gained{};
    double power = step.time_;
    for (std::size_t k = 0; k < q.size(); ++k, power *= part)
      for (std::size_t j = 0; j < modes; ++j) gained[j] += q[k] * power * step.added_[k][j];
    for (std::size_t j = 0; j < modes; ++j) modes_[j] = step.left_[j] * modes_[j] + gained[j];
  }

 private:
  struct Table {
    Modes rate{}, weight{};  // [1/s], [s^(-1/2)]

    Table() noexcept {
      constexpr double step = std::numbers::ln2, slowest = 3e-5;  // `decay` needs this step
      const double r = std::exp(-step / 2), tail = r / (1 - r), tail3 = r * r * r / (1 - r * r * r);
      for (std::size_t j = 1; j + 1 < modes; ++j) {
        rate[j] = std::ldexp(slowest, static_cast<int>(j) - 1);
        weight[j] = step * std::sqrt(rate[j]) * std::numbers::inv_sqrtpi;
      }
      // What is slower keeps its sum and its mean rate; what is faster its area and its mean age.
      const std::size_t last = modes - 1;
      rate[0] = rate[1] * tail3 / tail;
      weight[0] = weight[1] * tail;
      const double area = weight[last - 1] / rate[last - 1] * tail;
      rate[last] = rate[last - 1] * tail / tail3;
      weight[last] = area * rate[last];
    }
  };
  static const Table& table() noexcept {
    static const Table values;
    return values;
  }

  bool warm_ = false;
  Modes modes_;
};

}  // namespace stickslip
