// The expansion of the motion of a structure under the law of its interface.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "stickslip/base/equal.hpp"
#include "stickslip/flow/collocation.hpp"
#include "stickslip/flow/detail/heated_level.hpp"
#include "stickslip/friction/coulomb.hpp"
#include "stickslip/friction/law.hpp"
#include "stickslip/state/state.hpp"
#include "stickslip/structure/response.hpp"
#include "structure/expansion.hpp"

namespace stickslip::detail {

/// The state of the interface alone.
inline State interface_of(const StructureState& state) {
  return {.displacement = state.displacement,
          .velocity = state.velocity,
          .mode = state.mode,
          .sliding_distance = state.sliding_distance,
          .heat = state.heat,
          .pendulum = state.pendulum};
}

/// The memory of the law of the interface, back from its state.
inline void remember(const State& interface, StructureState& state) {
  state.sliding_distance = interface.sliding_distance;
  state.pendulum = interface.pendulum;
}

/// What friction can hold at rest during an expansion: powers of time in units of its duration [m/s^2].
struct Held {
  std::array<double, Nodes::points> of{};
  int degree = 1;
};

/// Expands the motion of a structure under a law, and carries the heat in its surface.
template <FrictionLaw Law>
class LawExpansion : public Expansion {
 public:
  LawExpansion(const ModalInterface& of, const Law& law, double step) : Expansion(of, step), law_(law) {}

  /// Expand a state that is stuck.
  /// @param left    time to the end of the segment [s]
  /// @param demand  q at the start [m/s^2]
  void stand(const StructureState& state, const GroundLoad& ground, double left, double demand) {
    expand(state, ground, left, share(left), demand, Coulomb(1));
  }
  /// Expand a slip.
  void slide(const StructureState& state, const GroundLoad& ground, double left, double demand) {
    if constexpr (MemoryLaw<Law>)
      expand(state, ground, left, share(left), demand, law_at(law_, interface_of(state)));
    else
      expand(state, ground, left, share(left), demand, law_);
  }
  /// What is held during the last expansion.
  /// @param level  for the weight g [m/s^2]
  Held held(double level) const noexcept { return {{level * weight()[0], level * weight()[1]}}; }
  /// Heats or cools the surface over the last expansion.
  void heat(SurfaceHeat&) const noexcept {}

 private:
  const Law& law_;
};

/// If friction heats the surface, its level during a slip is a polynomial of time times the factor of the speed. A step
/// is shortened until the last terms of that polynomial change the velocity by at most 1e-8 of itself, or are 1e-10 of
/// the level. What can be held at rest is a polynomial, too, whose last terms are at most 1e-9 of it.
template <SeparableHeatedLaw Law>
class LawExpansion<Law> : public Expansion {
 public:
  LawExpansion(const ModalInterface& of, const Law& law, double step) : Expansion(of, step), law_(law) {}

  void stand(const StructureState& state, const GroundLoad& ground, double left, double demand) {
    expand(state, ground, left, share(left), demand, Coulomb(1));
    heating_ = false;
    while (!hold(state) && duration() > shortest_part * ground.duration) restrict_to(0.5);
  }

  void slide(const StructureState& state, const GroundLoad& ground, double left, double demand) {
    const Nodes& nodes = Nodes::get();
    const State now = interface_of(state);
    const double s = static_cast<double>(static_cast<int>(state.mode)), longest = share(left);
    const double heating = law_.heating(now, direction_of(state.mode)), present = state.heat.half_integral();
    for (double step = std::min(longest, 2 * last_step_);;) {
      const auto weights =
          nodes.at_nodes([&](double part) { return ground.weight(std::max(left - part * step, 0.0)); });
      const double first = law_.level_at_high_speed(weights[0], present), v = s * now.velocity;
      const double friction = weights[0] * first * law_.speed_factor(v);
      const double gains = step * (s * demand - of().damper * v - friction) / of().mass;
      HeatedLevel<Law> level(law_, heating, cooling_.half_integrals(state.heat, step), weights, step,
                             nodes.at_nodes([&](double part) { return std::max(v + part * gains, 0.0); }));
      double fastest = 0, stop = never;  // a part of the step
      bool settled = false;
      for (int sweep = 0; sweep < 30 && !settled; ++sweep) {
        expand(state, ground, left, step, demand, Step(law_, level.powers(), first, step));
        stop = first_stop(s);
        if (duration() < step || stop < 0.9) break;
        const auto speeds = nodes.at_nodes([&](double part) { return speed(s, part); });
        fastest = *std::max_element(speeds.begin(), speeds.end());
        settled = level.follow(speeds);
      }
      const double error = level.error(), shorter = duration() < step ? duration() : 1.02 * stop * step;
      const bool whole = !(shorter < 0.95 * step), stands = !(stop > 0);
      const bool resolved = settled && (step * error <= 1e-8 * fastest * of().mass || error <= 1e-10 * first);
      if (stands || (whole && resolved) || !(step > shortest_part * ground.duration)) {
        heating_ = heating > 0 && !stands;
        heat_ = level.heat();
        step_ = step;
        last_step_ = step < longest ? step : std::max(step, last_step_);
        return;
      }
      step = whole ? step / 2 : shorter;
    }
  }

  Held held(double) const noexcept { return held_; }

  void heat(SurfaceHeat& surface) {
    if (heating_ && duration() > 0)
      cooling_.heat(surface, heat_, step_, std::min(duration() / step_, 1.0));
    else
      surface.rest(duration());
  }

 private:
  static constexpr double shortest_part = 0x1p-60;  // of a segment

  // The law during a step (LawInTime).
  class Step {
   public:
    /// @param powers  of the time in units of the step
    /// @param first   exactly the level at the start
    Step(const Law& law, const Nodes::Values& powers, double first, double step)
        : law_(law), powers_(powers), step_(step) {
      powers_[0] = first;
    }
    double power(int k, double h) const {
      if (k >= static_cast<int>(powers_.size())) return 0;
      const double power = powers_[static_cast<std::size_t>(k)];
      return equal(h, step_) ? power : power * std::pow(h / step_, k);
    }
    template <class Factor, class Speed>
    auto resist(const Factor& factor, const Speed& speed) const {
      return factor * law_.speed_factor(speed);
    }

   private:
    const Law& law_;
    Nodes::Values powers_;
    double step_;
  };

  // Finds what friction can hold. @return whether that is known over the whole expansion
  bool hold(const StructureState& state) {
    const double first = weight()[0], last = first + weight()[1], least = std::min(first, last);
    const double holds = least * law_.level(0, std::max(first, last), state.heat.half_integral());
    double most = 0;
    for (int k = 0; k <= order(); ++k) most += std::abs(demand()[k]);
    held_ = {{holds}, 0};  // at least: the surface cools
    if (most < holds) return true;
    const Nodes::Values half = cooling_.half_integrals(state.heat, duration());
    Nodes::Values values;
    double highest = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
      const double at = std::max(first + Nodes::get().nodes[i] * weight()[1], 0.0);
      values[i] = at * law_.level(0, at, half[i]);
      highest = std::max(highest, values[i]);
    }
    const Nodes::Values c = Nodes::get().chebyshev(values);
    held_.degree = Nodes::powers(c, 1e-15 * highest, held_.of);
    return std::abs(c[c.size() - 1]) + std::abs(c[c.size() - 2]) <= 1e-9 * highest;
  }

  const Law& law_;
  Cooling cooling_{};
  Held held_{};
  Nodes::Values heat_{};  // of the last slip, in powers of time per step
  double step_ = 0, last_step_ = never;
  bool heating_ = false;
};

}  // namespace stickslip::detail
