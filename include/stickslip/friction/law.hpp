// What a friction law is: what its level depends on, in which form, how much it holds at rest, and whether it is equal
// in both directions.
#pragma once

#include <concepts>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include "stickslip/base/min_max.hpp"
#include "stickslip/numerics/gauss_legendre.hpp"
#include "stickslip/state/state.hpp"

namespace stickslip {

/// A friction law defines one or two functions. Each returns a non-negative friction force per unit mass [m/s^2]:
///
///     resist(x, direction) or resist(x, speed, direction)    // resistance to sliding at x [m] and speed |x'| [m/s]
///     hold(x, direction)                                     // largest friction at rest against that direction
///
/// Without `hold`, friction at rest is limited by the resistance at zero speed. `resist` is a template over its
/// scalars: one line serves doubles, power series, and several of either in SIMD lanes. It names none of these types
/// and returns `auto`:
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

/// A law whose resistance also depends on the speed.
template <class Law>
concept SpeedLaw = std::copy_constructible<Law> && requires(const Law& law, double x, Direction direction) {
  { law.resist(x, x, direction) } -> std::convertible_to<double>;
};

template <class Law>
concept MemorylessLaw = PositionLaw<Law> || SpeedLaw<Law>;

/// Marks the exceptions of a law that is defined by numbers only where it has no level. Trial steps go beyond the
/// motion: one that meets this exception, or a level that is not finite, is shortened. The exception is passed on only
/// if the motion itself goes there. All other exceptions are passed on at once.
struct NoLevel {};

/// A level that is negative or not finite.
class InvalidLevel : public std::invalid_argument, public NoLevel {
 public:
  using std::invalid_argument::invalid_argument;
};

/// A law with memory: its slip level depends on State::sliding_distance. It defines its friction through another law:
///
///     at(state)                // the law in x and speed that applies from this state on
///     ahead(state, direction)  // distance in a direction over which that law applies [m], positive; infinite: always
///     pass(state, direction)   // moves a state to the end of that distance: x and the sliding distance
///
/// A law whose memory is more than the sliding distance also defines
///
///     slide(state, distance)   // moves the memory of a state, the sliding distance included, in the direction of its
///                              // mode
///     begin(state)             // gives a state without memory that of its displacement
/// If its resistance contains springs, it also defines
///
///     elastic(state)           // energy in them where the normal force is g, per unit mass [m^2/s^2]
/// and the law in x and speed defines
///
///     friction(x, direction)   // the part of the resistance that dissipates [m/s^2]
/// Where these cost less than the above, it can define
///
///     toward(state, direction)      // as `at`, for a motion in one direction only
///     surely_ahead(state)           // a distance in the direction of the mode, a little less than `ahead`
///     slide_surely(state, distance) // as `slide`, over less than that
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
///     level(speed, weight, H)      // resistance divided by the weight, at the half-integral H of the heat [m/s^2]
///     heating(state, direction)    // heat flux where the temperature is taken, divided by speed and by the friction
///                                  // force per unit mass [kg/m^2]; constant over the distance `ahead`
///     temperature(state)           // temperature of the surface [degrees Celsius]
///     half_integral_at(T)          // H at a temperature [W s^(1/2)/m^2]
/// `at(state)` is equivalent to `at(state, 1)`.
template <class Law>
concept HeatedLaw = MemoryLaw<Law> && requires(const Law& law, const State& state, Direction direction, double value) {
  { law.at(state, value) } -> MemorylessLaw;
  { law.level(value, value, value) } -> std::convertible_to<double>;
  { law.heating(state, direction) } -> std::convertible_to<double>;
  { law.temperature(state) } -> std::convertible_to<double>;
  { law.half_integral_at(value) } -> std::convertible_to<double>;
};

/// A heated law whose level is a factor of normal force and heat times one of the speed:
///
///     level_at_high_speed(weight, H)   // [m/s^2]; non-increasing in H and in the weight
///     speed_factor(speed)              // for numbers and series
///     edge()                           // largest |r| at which the temperature is that of a covered surface [m]
template <class Law>
concept SeparableHeatedLaw = HeatedLaw<Law> && requires(const Law& law, double value) {
  { law.level_at_high_speed(value, value) } -> std::convertible_to<double>;
  { law.speed_factor(value) } -> std::convertible_to<double>;
  { law.edge() } -> std::convertible_to<double>;
};

template <class Law>
concept FrictionLaw = MemorylessLaw<Law> || MemoryLaw<Law>;

namespace detail {

/// The state that the event loop carries: with the memory of the law, if it has one.
template <FrictionLaw Law>
using StateOf = std::conditional_t<MemoryLaw<Law>, State, BareState>;

/// Stores a state of the event loop in a public one.
inline void store(const BareState& from, State& to) noexcept { from.store(to); }
inline void store(const State& from, State& to) noexcept { to = from; }

/// A class with the arguments of `resist` in the wrong order, for the error message.
template <class Law>
concept LawWithDirectionBeforeSpeed = !FrictionLaw<Law> && requires(const Law& law, double x, Direction direction) {
  law.resist(x, direction, x);
};

}  // namespace detail

/// The law that applies from a state on, under a normal force of `weight` times g: `law.at(...)` for a law with memory,
/// otherwise the law itself.
template <FrictionLaw Law, class AnyState>
decltype(auto) law_at(const Law& law, const AnyState& state, double weight = 1) {
  if constexpr (HeatedLaw<Law>)
    return law.at(state, weight);
  else if constexpr (MemoryLaw<Law>)
    return law.at(state);
  else
    return law;
}

namespace detail {

/// Moves the memory of a law over a distance, in the direction of the mode of a state.
template <MemoryLaw Law>
void slide(const Law& law, State& state, double distance) {
  if constexpr (requires { law.slide(state, distance); })
    law.slide(state, distance);
  else
    state.sliding_distance += distance;
}

/// A state as the event loop carries it, with a memory.
template <FrictionLaw Law>
StateOf<Law> with_memory(const Law& law, const State& state) {
  StateOf<Law> begins(state);
  if constexpr (requires { law.begin(begins); }) law.begin(begins);
  return begins;
}

/// A law that holds energy in springs of its own.
template <class Law>
concept LawWithSprings = requires(const Law& law, const State& state) {
  { law.elastic(state) } -> std::convertible_to<double>;
};

/// The energy in the springs of a law itself, per unit mass [m^2/s^2].
template <FrictionLaw Law>
double elastic(const Law& law, const State& state) {
  if constexpr (LawWithSprings<Law>)
    return law.elastic(state);
  else
    return 0;
}

/// A law in x that contains springs.
template <class Law>
concept SpringLaw = requires(const Law& law, double x, Direction direction) {
  { law.friction(x, direction) } -> std::convertible_to<double>;
};

}  // namespace detail

/// How the resistance varies with x and speed while the slider moves in one direction: this decides how its motion is
/// computed. A law with memory has the form of the law that applies from a state on.
enum class Form {
  constant,  ///< the law declares `static constexpr bool constant_while_sliding = true;`: closed forms
  linear,    ///< in x; the law defines `slope(direction)`, the derivative in that direction [1/s^2]: closed forms
  analytic,  ///< power series
  numeric    ///< known by numbers only, such as a table or a function in another language: the law declares `static
             ///< constexpr bool numeric = true;`, its `resist` need not be a template and must be continuous.
             ///< Collocation, to 1e-10 of the scale
};

template <class Law>
inline constexpr Form form_of = [] {
  if constexpr (requires { requires Law::constant_while_sliding; })
    return Form::constant;
  else if constexpr (MemoryLaw<Law>)
    return form_of<std::remove_cvref_t<decltype(law_at(std::declval<const Law&>(), State{}))>>;
  else if constexpr (requires { requires Law::numeric; })
    return Form::numeric;
  else if constexpr (requires(const Law& law, Direction direction) { law.slope(direction); })
    return Form::linear;
  else
    return Form::analytic;
}();

/// A law that can hold more at rest than its resistance at zero speed.
template <class Law>
concept LawWithHold = FrictionLaw<Law> && requires(const Law& law, double x, Direction direction) {
  { law.hold(x, direction) } -> std::convertible_to<double>;
};

/// Resistance to sliding of any law without memory, for numbers or power series [m/s^2].
template <MemorylessLaw Law, class X, class Speed>
auto resist(const Law& law, const X& x, const Speed& speed, Direction direction) {
  if constexpr (SpeedLaw<Law>)
    return law.resist(x, speed, direction);
  else
    return law.resist(x, direction);
}

/// The part of the resistance that dissipates, of any law without memory [m/s^2]: all of it, unless it contains
/// springs.
template <MemorylessLaw Law>
double friction(const Law& law, double x, double speed, Direction direction) {
  if constexpr (detail::SpringLaw<Law>)
    return law.friction(x, direction);
  else
    return resist(law, x, speed, direction);
}

/// Largest friction at rest of any law without memory [m/s^2]. It is at least the resistance at zero speed: otherwise a
/// slip could begin under a load too small to sustain it, and would end where it began.
template <MemorylessLaw Law>
double hold(const Law& law, double x, Direction direction) {
  const double resists = resist(law, x, 0.0, direction);
  if constexpr (LawWithHold<Law>)
    return std::max<double>(law.hold(x, direction), resists);
  else
    return resists;
}

/// A law with equal resistance in both directions. The law declares this with `static constexpr bool symmetric =
/// true;`, which saves ensembles half of the work. (A derived law that is not symmetric declares `false`.)
template <class Law>
concept SymmetricLaw = FrictionLaw<Law> && requires {
  requires Law::symmetric;
};

/// A law with a closed form of the work against friction, `work(from, distance, direction)` [m^2/s^2]: the integral of
/// the resistance over a distance >= 0 slid from `from`.
template <class Law>
concept LawWithWork = PositionLaw<Law> && requires(const Law& law, double x, Direction direction) {
  { law.work(x, x, direction) } -> std::convertible_to<double>;
};

/// The work against friction of a law that depends on position only [m^2/s^2]. Without a closed form it is computed by
/// ten-point Gauss-Legendre quadrature, which is accurate over short distances only.
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
