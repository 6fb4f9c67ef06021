// What a friction law is.
#pragma once

#include <concepts>

#include "stickslip/detail/min_max.hpp"
#include "stickslip/state.hpp"

namespace stickslip {

/// A friction law gives the slip level: the friction force per unit mass [m/s^2], not negative, by position and
/// direction. A slider at rest is held while the force on it stays within the two levels at its place; a slider in
/// motion is braked by the level of its direction.
///
/// `level` is a template over its scalar, so that one line serves doubles and power series alike; return `auto`:
///
///     struct Bump {                            // a slip level that decays as exp(-(x/reach)^2)
///       double slip_level, reach;
///       template <class T>
///       auto level(const T& x, Direction) const {
///         using std::exp;
///         return slip_level * exp(-(x / reach) * (x / reach));
///       }
///     };
///
/// It must be analytic in x (no branches on x). series/series.hpp lists the functions at hand.
template <class Law>
concept FrictionLaw = std::copy_constructible<Law> && requires(const Law& law, double x, Direction direction) {
  { law.level(x, direction) } -> std::convertible_to<double>;
};

/// A law whose level does not change while it slides one way, said by `static constexpr bool constant_while_sliding =
/// true;` its motion between events is known in closed form.
template <class Law>
concept ConstantLevelLaw = FrictionLaw<Law> && requires {
  requires Law::constant_while_sliding;
};

/// A law that knows the work against it in closed form, `work(from, distance, direction)` [m^2/s^2], distance >= 0 slid
/// from `from`: the integral of the level over the way.
template <class Law>
concept LawWithWork = FrictionLaw<Law> && requires(const Law& law, double x, Direction direction) {
  { law.work(x, x, direction) } -> std::convertible_to<double>;
};

/// The work against any law; by Gauss-Legendre quadrature of ten points where it is not known, so over short ways.
template <FrictionLaw Law>
double friction_work(const Law& law, double from, double distance, Direction direction) {
  if constexpr (LawWithWork<Law>) {
    return law.work(from, distance, direction);
  } else {
    constexpr double nodes[] = {0.14887433898163121, 0.43339539412924719, 0.67940956829902441, 0.86506336668898451,
                                0.97390652851717172};
    constexpr double weights[] = {0.29552422471475287, 0.26926671930999636, 0.21908636251598204, 0.14945134915058059,
                                  0.06667134430868814};
    const double half = distance / 2, middle = from + sign(direction) * half;
    double sum = 0;
    for (int i = 0; i < 5; ++i)
      sum += weights[i] *
             (law.level(middle - half * nodes[i], direction) + law.level(middle + half * nodes[i], direction));
    return half * sum;
  }
}

}  // namespace stickslip
