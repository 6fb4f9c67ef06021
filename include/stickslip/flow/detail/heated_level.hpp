// The level of a heated law during a step of a slip.
#pragma once

#include <cmath>
#include <cstddef>

#include "stickslip/base/min_max.hpp"
#include "stickslip/flow/collocation.hpp"
#include "stickslip/friction/law.hpp"

namespace stickslip::detail {

/// The level of a heated law during a step of a slip, without its factor of the speed, at Chebyshev points of the time.
/// The heat that the slip generates in the step acts back on the level, which is found by iteration.
template <SeparableHeatedLaw Law>
class HeatedLevel {
 public:
  using Values = Nodes::Values;

  /// @param heating  heat flux divided by speed and by friction force per unit mass [kg/m^2]
  /// @param before   half-integrals at the points, of the heat from before the step
  /// @param weights  N+/g at the points
  /// @param step     [s]
  /// @param speeds   at the points [m/s], at first a guess
  HeatedLevel(const Law& law, double heating, const Values& before, const Values& weights, double step,
              const Values& speeds)
      : law_(law), heating_(heating), root_step_(std::sqrt(step)), before_(before), weights_(weights) {
    for (std::size_t i = 0; i < Nodes::points; ++i) values_[i] = level(i);
    follow(speeds);
  }

  /// Levels from the speeds at the points [m/s]. @return whether none changes by more than 1e-9 of itself
  bool follow(const Values& speeds) {
    for (std::size_t i = 0; i < Nodes::points; ++i) q_[i] = flux(i, values_[i], speeds[i]);
    bool settled = true;
    for (std::size_t i = 0; i < Nodes::points; ++i) {
      const double now = level(i);
      settled = settled && std::abs(now - values_[i]) <= 1e-9 * now;
      values_[i] = now;
    }
    return settled;
  }

  /// The level [m/s^2], in powers of the time in units of the step.
  Values powers() const { return powers(values_); }
  /// Heat flux, in the same powers [W/m^2].
  Values heat() const { return powers(q_); }
  /// What the polynomial may err [m/s^2]: its last terms.
  double error() const {
    const Values c = Nodes::get().chebyshev(values_);
    return std::abs(c[Nodes::points - 1]) + std::abs(c[Nodes::points - 2]);
  }

 private:
  double flux(std::size_t i, double level, double speed) const {
    return heating_ * weights_[i] * level * law_.speed_factor(speed) * speed;
  }
  double level(std::size_t i) const {
    double half = 0;
    for (std::size_t k = 0; k < Nodes::points; ++k) half += Nodes::get().half_integral[i][k] * q_[k];
    return law_.level_at_high_speed(weights_[i], std::max(before_[i] + root_step_ * half, 0.0));
  }
  static Values powers(const Values& values) {
    double largest = 0;
    for (const double value : values) largest = std::max(largest, std::abs(value));
    Values result;
    Nodes::powers(Nodes::get().chebyshev(values), 0x1p-54 * largest, result);
    return result;
  }

  const Law& law_;
  double heating_, root_step_;
  Values before_, weights_, values_{}, q_{};
};

}  // namespace stickslip::detail
