// Coulomb friction of unequal levels on a spring: of equal levels, about another place.
#pragma once

#include <cmath>
#include <concepts>

#include "stickslip/detail/equal.hpp"
#include "stickslip/friction/coulomb.hpp"
#include "stickslip/friction/law.hpp"
#include "stickslip/slider.hpp"

namespace stickslip::detail {

/// A slider, and where its x = 0 lies for the one that it stands for [m].
template <FrictionLaw Law>
struct Balanced {
  Slider<Law> slider;
  double center;
};

/// With x = center + y, center = (backward - forward) / (2 wn^2), a block whose levels differ is one of their mean,
///     y'' + (forward + backward)/2 sgn(y') + c y' + wn^2 y = -n,
/// which also holds at rest what that one holds. Without a spring, with an infinite level, and under any other law the
/// slider stays as it is, about 0.
template <FrictionLaw Law>
Balanced<Law> balanced(const Slider<Law>& slider) {
  if constexpr (std::same_as<Law, Coulomb>) {
    const double forward = slider.law().forward(), backward = slider.law().backward();
    const double center = (backward - forward) / 2 / slider.stiffness();
    if (!equal(forward, backward) && std::isfinite(center))
      return {Slider(Coulomb(forward / 2 + backward / 2), slider.natural_frequency(), slider.damping()), center};
  }
  return {slider, 0};
}

}  // namespace stickslip::detail
