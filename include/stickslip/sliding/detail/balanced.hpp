// Coulomb friction with unequal levels on a spring, expressed as equal levels about a shifted center.
#pragma once

#include <cmath>
#include <concepts>

#include "stickslip/base/equal.hpp"
#include "stickslip/friction/coulomb.hpp"
#include "stickslip/friction/law.hpp"
#include "stickslip/slider/slider.hpp"

namespace stickslip::detail {

/// A slider, and the position of its x = 0 in the coordinates of the original slider [m].
template <FrictionLaw Law>
struct Balanced {
  Slider<Law> slider;
  double center;
};

/// With x = center + y, center = (backward - forward) / (2 wn^2), a block with unequal levels is one with their mean,
///     y'' + (forward + backward)/2 sgn(y') + c y' + wn^2 y = -n,
/// with the same limits at rest. Without a spring, with an infinite level, and for any other law the slider is
/// unchanged, with center 0.
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
