// What a friction law is.
#pragma once

#include <concepts>

#include "stickslip/detail/min_max.hpp"
#include "stickslip/numerics/gauss_legendre.hpp"
#include "stickslip/state.hpp"

namespace stickslip {

/// A friction law answers two questions, both with a friction force per unit mass [m/s^2] that is not negative:
///
///     resist(x, direction) or resist(x, direction, speed)    // what resists sliding at x [m] that way, at |x'| [m/s]
///     hold(x, direction)                                     // what holds it at rest against sliding that way
///
/// A law without `hold` holds what resists at no speed. `resist` is a template over its scalars, so that one line
/// serves doubles, power series, and several of either side by side; it names none of these types and returns `auto`:
///
///     struct Bump {                            // a slip level that decays as exp(-(x/reach)^2)
///       double slip_level, reach;
///       template <class T>
///       auto resist(const T& x, Direction) const {
///         using std::exp;
///         return slip_level * exp(-(x / reach) * (x / reach));
///       }
///     };
///
/// It must be analytic in x and speed (no branches on them). series/series.hpp lists the available functions.
template <class Law>
concept PositionLaw = std::copy_constructible<Law> && requires(const Law& law, double x, Direction direction) {
  { law.resist(x, direction) } -> std::convertible_to<double>;
};

/// A law whose resistance depends on the speed, too.
template <class Law>
concept SpeedLaw = std::copy_constructible<Law> && requires(const Law& law, double x, Direction direction) {
  { law.resist(x, direction, x) } -> std::convertible_to<double>;
};

template <class Law>
concept MemorylessLaw = PositionLaw<Law> || SpeedLaw<Law>;

/// A law of numbers alone, such as a table or a function of another language, said by `static constexpr bool numeric =
/// true;` its `resist` need be no template. It must be continuous in x and speed; its flows are found by collocation,
/// to 1e-10 of the scale.
template <class Law>
concept NumericLaw = MemorylessLaw<Law> && requires {
  requires Law::numeric;
};

/// A law with memory, whose level depends on how far it has slid, State::sliding_distance. It answers both questions
/// through another law:
///
///     at(state)                // the law as it goes on from a state, in x and the speed
///     ahead(state, direction)  // the way in a direction for which that holds [m], positive; infinite: for good
///     pass(state, direction)   // moves a state to the end of that way: x and the sliding distance
///
/// There the level must not jump. A law `at` that is linear in x says its rate, `slope(direction)`, the derivative
/// of what resists by the distance slid that way [1/s^2]: its motion is then known in closed form.
template <class Law>
concept MemoryLaw = std::copy_constructible<Law> &&
    requires(const Law& law, const State& state, State& there, Direction direction) {
  { law.at(state) } -> MemorylessLaw;
  { law.ahead(state, direction) } -> std::convertible_to<double>;
  law.pass(there, direction);
};

/// A law with memory whose level also depends on the normal force, and on the temperature of a surface that friction
/// heats, State::heat:
///
///     at(state, weight)            // the law under a normal force of weight times g
///     level(speed, weight, H)      // what resists, times the weight, with the heat's half-integral H [m/s^2]
///     heating(state, direction)    // heat per area that a slip makes where the temperature is taken, per force per
///                                  // unit mass and speed [kg/m^2]; constant along `ahead`
///     temperature(state)           // of the surface [degrees Celsius]
///     half_integral_at(T)          // H at a temperature [W s^(1/2)/m^2]
/// `at(state)` is `at(state, 1)`.
template <class Law>
concept HeatedLaw = MemoryLaw<Law> && requires(const Law& law, const State& state, Direction direction, double value) {
  { law.at(state, value) } -> MemorylessLaw;
  { law.level(value, value, value) } -> std::convertible_to<double>;
  { law.heating(state, direction) } -> std::convertible_to<double>;
  { law.temperature(state) } -> std::convertible_to<double>;
  { law.half_integral_at(value) } -> std::convertible_to<double>;
};

template <class Law>
concept FrictionLaw = MemorylessLaw<Law> || MemoryLaw<Law>;

/// The law as it goes on from a state under a normal force of `weight` times g: itself, unless it has a memory.
template <FrictionLaw Law>
decltype(auto) law_at(const Law& law, const State& state, double weight = 1) {
  if constexpr (HeatedLaw<Law>)
    return law.at(state, weight);
  else if constexpr (MemoryLaw<Law>)
    return law.at(state);
  else
    return law;
}

/// A law that is linear in x while it slides one way.
template <class Law>
concept LinearLaw = PositionLaw<Law> && requires(const Law& law, Direction direction) {
  { law.slope(direction) } -> std::convertible_to<double>;
};

/// A law that holds more at rest than what resists at no speed.
template <class Law>
concept LawWithHold = FrictionLaw<Law> && requires(const Law& law, double x, Direction direction) {
  { law.hold(x, direction) } -> std::convertible_to<double>;
};

/// What resists sliding, by any law without memory, of numbers or of power series [m/s^2].
template <MemorylessLaw Law, class X, class Speed>
auto resist(const Law& law, const X& x, Direction direction, const Speed& speed) {
  if constexpr (SpeedLaw<Law>)
    return law.resist(x, direction, speed);
  else
    return law.resist(x, direction);
}

/// What any law without memory holds at rest [m/s^2]; at least what resists at no speed, for a slip that it could not
/// begin would end where it begins.
template <MemorylessLaw Law>
double hold(const Law& law, double x, Direction direction) {
  const double resists = resist(law, x, direction, 0.0);
  if constexpr (LawWithHold<Law>)
    return std::max<double>(law.hold(x, direction), resists);
  else
    return resists;
}

/// A law whose resistance does not change while it slides one way, said by `static constexpr bool
/// constant_while_sliding = true;` its motion between events is known in closed form.
template <class Law>
concept ConstantLevelLaw = FrictionLaw<Law> && requires {
  requires Law::constant_while_sliding;
};

/// A law that resists both ways alike, said by `static constexpr bool symmetric = true;` it saves ensembles half of the
/// work. (A law that is derived from one and resists otherwise says `false`.)
template <class Law>
concept SymmetricLaw = FrictionLaw<Law> && requires {
  requires Law::symmetric;
};

/// A law that knows the work against it in closed form, `work(from, distance, direction)` [m^2/s^2], distance >= 0 slid
/// from `from`: the integral of the resistance over the way.
template <class Law>
concept LawWithWork = PositionLaw<Law> && requires(const Law& law, double x, Direction direction) {
  { law.work(x, x, direction) } -> std::convertible_to<double>;
};

/// The work against a law of position; by Gauss-Legendre quadrature of ten points where it is not known, so over short
/// ways.
template <PositionLaw Law>
double friction_work(const Law& law, double from, double distance, Direction direction) {
  if constexpr (LawWithWork<Law>) {
    return law.work(from, distance, direction);
  } else {
    const double s = sign(direction);
    return numerics::gauss_integral<10>(0, distance, [&](double way) { return law.resist(from + s * way, direction); });
  }
}

}  // namespace stickslip
