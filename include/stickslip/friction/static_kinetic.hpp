// Static friction above kinetic.
#pragma once

#include <cmath>
#include <string>
#include <utility>

#include "stickslip/base/equal.hpp"
#include "stickslip/base/error.hpp"
#include "stickslip/friction/coulomb.hpp"
#include "stickslip/friction/law.hpp"
#include "stickslip/state/state.hpp"

namespace stickslip {

/// Friction whose limit at rest exceeds the resistance to sliding. A slider at rest stays at rest while |load| <= hold;
/// then the sliding law applies. A slip that stops sticks if |load| <= hold.
///
/// The response is not a continuous function of the input: if a slip nearly stops, or a load nearly reaches the static
/// level, an arbitrarily small change decides whether the slider sticks.
///
/// @tparam Law  the sliding law. Where its resistance at zero speed exceeds the static level, that resistance limits
///              friction at rest. If the law has memory, the static level does not change with it, and must be at least
///              the level of the law at the start
template <FrictionLaw Law = Coulomb>
class StaticKinetic {
 public:
  static constexpr bool constant_while_sliding = form_of<Law> == Form::constant;
  static constexpr bool numeric = form_of<Law> == Form::numeric;

  /// @param sliding       the sliding law
  /// @param static_level  largest friction at rest in both directions, force per unit mass [m/s^2]; at least
  ///                      that of the sliding law at x = 0
  /// @throws std::invalid_argument naming the value
  StaticKinetic(Law sliding, double static_level) : StaticKinetic(std::move(sliding), static_level, static_level) {}

  /// @param static_level  against forward sliding [m/s^2]
  /// @param backward      against backward sliding [m/s^2]
  StaticKinetic(Law sliding, double static_level, double backward)
      : sliding_(std::move(sliding)), forward_(static_level), backward_(backward) {
    for (const Direction direction : {Direction::forward, Direction::backward}) {
      const double level = static_level_of(direction),
                   kinetic = stickslip::hold(law_at(sliding_, State{}), 0, direction);
      detail::require((std::isfinite(level) || detail::equal(level, kinetic)) && level >= kinetic,
                      "StaticKinetic: the static level " +
                          std::string(direction == Direction::forward ? "forward" : "backward") +
                          " must be finite and at least the kinetic one of " + detail::shortest(kinetic) + " m/s^2",
                      level, "m/s^2");
    }
  }

  const Law& sliding() const noexcept { return sliding_; }
  double static_forward() const noexcept { return forward_; }
  double static_backward() const noexcept { return backward_; }
  /// Whether the static and the sliding levels are equal in both directions.
  bool isotropic() const noexcept requires requires(const Law& law) { law.isotropic(); }
  { return sliding_.isotropic() && detail::equal(forward_, backward_); }

  template <class X>
  auto resist(const X& x, Direction direction) const requires PositionLaw<Law> {
    return sliding_.resist(x, direction);
  }
  template <class X, class Speed>
  auto resist(const X& x, const Speed& speed, Direction direction) const requires SpeedLaw<Law> {
    return sliding_.resist(x, speed, direction);
  }
  double hold(double, Direction direction) const noexcept { return static_level_of(direction); }

  double work(double from, double distance, Direction direction) const noexcept requires LawWithWork<Law> {
    return sliding_.work(from, distance, direction);
  }

  auto at(const State& state) const requires MemoryLaw<Law> {
    using Now = decltype(sliding_.at(state));
    return StaticKinetic<Now>(sliding_.at(state), forward_, backward_, typename StaticKinetic<Now>::Unchecked{});
  }
  double ahead(const State& state, Direction direction) const requires MemoryLaw<Law> {
    return sliding_.ahead(state, direction);
  }
  void pass(State& state, Direction direction) const requires MemoryLaw<Law> { sliding_.pass(state, direction); }
  double slope(Direction direction) const noexcept requires(form_of<Law> == Form::linear) {
    return sliding_.slope(direction);
  }

 private:
  template <FrictionLaw>
  friend class StaticKinetic;
  struct Unchecked {};
  StaticKinetic(Law sliding, double forward, double backward, Unchecked)
      : sliding_(std::move(sliding)), forward_(forward), backward_(backward) {}

  double static_level_of(Direction direction) const noexcept {
    return direction == Direction::forward ? forward_ : backward_;
  }

  Law sliding_;
  double forward_, backward_;
};

}  // namespace stickslip
