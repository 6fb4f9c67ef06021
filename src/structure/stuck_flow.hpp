// The motion of a structure over even steps while its interface is stuck, and bounds of it between them.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "structure/modal_interface.hpp"

namespace stickslip::detail {

/// While its interface is stuck, each mode of a structure with classical damping is an oscillator. A step of it is a
/// linear map of the mode and of the ground acceleration at both ends, which is computed once, to round-off. A step is
/// divided into parts so short that the demand and the displacement of the first floor remain close to their chords.
///
/// A state is an array of the modes followed by their rates.
class StuckFlow {
 public:
  static constexpr std::size_t most_steps = 32;  ///< of `decay`

  /// Whether the modes are oscillators, and a step has no more than 256 parts.
  static bool covers(const ModalInterface& of, double step);

  /// @pre covers(of, step)
  StuckFlow(const ModalInterface& of, double step);

  std::size_t modes() const noexcept { return modes_.size(); }
  double part() const noexcept { return part_; }  ///< [s]

  /// Move a state through a part, in which the ground acceleration goes from n in a straight line by `change` [m/s^2].
  void advance(double* state, double n, double change) const noexcept {
    double* rate = state + modes();
    for (std::size_t j = 0; j < modes(); ++j) {
      const Map& m = modes_[j];
      const double y = state[j], r = rate[j];
      state[j] = m.yy * y + m.yr * r + (m.yn * n + m.yc * change);
      rate[j] = m.ry * y + m.rr * r + (m.rn * n + m.rc * change);
    }
  }

  /// Calls `use(n, change)` for each part of a step, in which the ground acceleration goes in a straight line.
  template <class Use>
  void each_part(double n_start, double n_end, Use&& use) const {
    const double parts = static_cast<double>(parts_), change = (n_end - n_start) / parts;
    for (std::size_t i = 0; i < parts_; ++i) use(n_start + static_cast<double>(i) * change, change);
  }

  /// Move a state through up to `most_steps` whole steps without ground acceleration.
  void decay(double* state, std::size_t steps) const noexcept {
    if (steps == 0) return;
    double* rate = state + modes();
    const Free* free = free_.data() + (steps - 1) * modes();
    for (std::size_t j = 0; j < modes(); ++j) {
      const Free& m = free[j];
      const double y = state[j], r = rate[j];
      state[j] = m.yy * y + m.yr * r;
      rate[j] = m.ry * y + m.rr * r;
    }
  }

  /// A bound of the demand at any later time without ground acceleration [m/s^2]. r = w^2 y + D y' obeys the equation
  /// of its mode, so that r^2 + (r'/w)^2 never grows.
  double later_demand(const double* state) const noexcept {
    const double* rate = state + modes();
    double sum = 0;
    for (std::size_t j = 0; j < modes(); ++j) {
      const auto& [square, damping, weight] = oscillators_[j];
      const double r = square * state[j] + damping * rate[j];
      const double change = square * rate[j] - damping * r;
      sum += weight * (square > 0 ? std::sqrt(r * r + change * change / square) : std::abs(r));
    }
    return sum;
  }

  /// A quantity that is linear in the state and the ground acceleration, such as the demand.
  class Row {
   public:
    double at(const double* state, double n) const noexcept {
      double sum = -ground_ * n;
      for (std::size_t i = 0; i < of_state_.size(); ++i) sum += of_state_[i] * state[i];
      return sum;
    }
    /// The largest distance from its chord, over a part that begins with this state.
    double departure(const double* state, double n, double change) const noexcept {
      double sum = from_n_ * std::abs(n) + from_change_ * std::abs(change);
      for (std::size_t i = 0; i < of_state_.size(); ++i) sum += from_state_[i] * std::abs(state[i]);
      return sum;
    }

   private:
    friend class StuckFlow;
    std::vector<double> of_state_{}, from_state_{};
    double ground_ = 0, from_n_ = 0, from_change_ = 0;
  };
  const Row& demand() const noexcept { return demand_; }  ///< without the spring [m/s^2]
  const Row& top() const noexcept { return top_; }        ///< displacement of the first floor, if there is any [m]

 private:
  struct Free {
    double yy, yr, ry, rr;
  };
  struct Oscillator {
    double square, damping, weight;  // w^2, D, |demand|
  };
  struct Map : Free {
    double yn, rn, yc, rc;
  };

  std::size_t parts_;
  double part_;
  std::vector<Map> modes_;
  std::vector<Oscillator> oscillators_;
  std::vector<Free> free_;  // of 1, 2, ... steps, mode by mode
  Row demand_{}, top_{};
};

}  // namespace stickslip::detail
