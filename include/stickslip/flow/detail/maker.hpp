// What a sliding system asks the flows of its law.
#pragma once

#include <concepts>
#include <type_traits>

#include "stickslip/base/min_max.hpp"
#include "stickslip/flow/closed_form.hpp"
#include "stickslip/friction/law.hpp"
#include "stickslip/state/state.hpp"

namespace stickslip::detail {

/// The direction and the time in which a slider at rest begins to slip; stuck if it stays at rest. The slip starts with
/// the acceleration that decided this: computed once more it may round differently, as where a compiler contracts
/// multiplication and addition, and the slip would stop at once and begin again without end.
struct Departure {
  Mode mode = Mode::stuck;
  double delay = 0;  ///< from now [s]
  double net = 0;    ///< load minus pull of the spring at that time [m/s^2]
  double acceleration =
      0;  ///< of the slip at that time [m/s^2], at least 0; 0 if it begins at the level that resists it
  /// Of a slip that begins at the level that resists it, positive: the change of its acceleration at that place until the
  /// end of a segment of linear forces [m/s^2].
  double rise = 0;

  bool departs() const noexcept { return mode != Mode::stuck; }
};

/// Makes the flows of a slider, and knows the forces on it:
///
///     law_now(state, weight)            // the law in x and speed that applies now, under a weight N+/g
///     law_toward(direction, state, weight)
///                                       // the same, for a motion in one direction only
///     pull(x, weight), drag(speed)      // forces of spring and damper, per unit mass [m/s^2]
///     push()                            // the largest acceleration that springs in the law give under the weight
///     flow(direction, state, start, duration)
///                                       // a slip from its start on; over a part of `duration` if it is not known for
///                                       // longer. `law_now` applies over a distance `ahead(state, direction)` [m], at
///                                       // whose end `pass(state, direction)` puts a state
///     departure(load, bounds, state, net, pull, forward, backward, left)
///                                       // as SegmentLoad, with the net load and the acceleration at that time. A
///                                       // memory that changes at rest then has its value at the departure, or at the
///                                       // end of the segment
///     surely_ahead(state)               // a distance in the direction of the mode, a little less than `ahead` [m];
///                                       // `slid_surely(state, distance)` is `slid` over less than that
///     remember(flow, time, state), slid(state, distance)
///                                       // update the memory of the law after a part of a flow
///     friction_work(slide, leg, state)  // work against friction during a leg [m^2/s^2]
///     in_closed_form                    // whether its flows are, so that they cost little
///     most_steps                        // in a hundredth of a segment (Standstill)
template <class Maker>
concept FlowMaker = requires(const Maker& maker, const typename Maker::Place& state, typename Maker::Place& there,
                             Direction direction, double value) {
  { maker.law_now(state, value) } -> MemorylessLaw;
  { maker.pull(value, value) } -> std::convertible_to<double>;
  { maker.drag(value) } -> std::convertible_to<double>;
  { maker.ahead(state, direction) } -> std::convertible_to<double>;
  maker.pass(there, direction);
  maker.slid(there, value);
  { Maker::in_closed_form } -> std::convertible_to<bool>;
  { Maker::most_steps } -> std::convertible_to<int>;
};

/// The answers of a maker of flows that only depend on its law.
template <FrictionLaw AnyLaw>
class LawFlows {
 public:
  using Law = AnyLaw;
  using Place = StateOf<Law>;
  static constexpr bool in_closed_form = false;
  static constexpr int most_steps = 3'000'000;

  explicit LawFlows(const Law& law) noexcept : law_(law) {}

  const Law& law() const noexcept { return law_; }

  template <class AnyState>
  decltype(auto) law_now(const AnyState& state, double weight) const {
    return law_at(law_, state, weight);
  }
  /// The same for a motion in one direction only.
  template <class AnyState>
  decltype(auto) law_toward(Direction direction, const AnyState& state, double weight) const {
    if constexpr (requires { law_.toward(state, direction); })
      return law_.toward(state, direction);
    else
      return law_now(state, weight);
  }

  template <class Load, class Bounds, class AnyState>
  [[gnu::always_inline]] Departure departure(const Load& load, const Bounds&, const AnyState& state, double net,
                                             double pull, double forward, double backward, double left) const {
    Departure departure = load.departure(net, pull, forward, backward, left);
    if (!departure.departs()) return departure;
    const double then = load.weight(left - departure.delay);
    const double holds = departure.mode == Mode::forward ? forward : backward, level = Load::weigh(then, holds);
    departure.net = departure.mode == Mode::forward ? level : -level;
    if constexpr (LawWithHold<std::remove_cvref_t<decltype(law_now(state, then))>>) {
      const double resists = resist(law_now(state, then), state.displacement, 0.0, direction_of(departure.mode));
      if (holds > resists) {
        departure.acceleration = std::max(level - Load::weigh(then, resists), 0.0);
        departure.rise = 0;
      }
    }
    return departure;
  }

  /// The largest acceleration that springs in the law give [m/s^2].
  double push() const noexcept {
    if constexpr (requires { law_.push(); }) return law_.push();
    return 0;
  }

  template <class AnyState>
  double ahead(const AnyState& state, Direction direction) const {
    if constexpr (MemoryLaw<Law>) return law_.ahead(state, direction);
    return never;
  }
  /// A distance over which `law_now` applies for certain, in the direction of the mode [m].
  template <class AnyState>
  double surely_ahead(const AnyState& state) const {
    if constexpr (requires { law_.surely_ahead(state); })
      return law_.surely_ahead(state);
    else
      return (1 - 0x1p-40) * ahead(state, direction_of(state.mode));
  }
  /// Updates the memory of the law after less than that distance.
  template <class AnyState>
  void slid_surely(AnyState& state, double distance) const {
    if constexpr (requires { law_.slide_surely(state, distance); })
      law_.slide_surely(state, distance);
    else
      slid(state, distance);
  }
  template <class AnyState>
  void pass(AnyState& state, Direction direction) const {
    if constexpr (MemoryLaw<Law>) law_.pass(state, direction);
  }
  template <class AnyState>
  void slid(AnyState& state, double distance) const {
    if constexpr (MemoryLaw<Law>) detail::slide(law_, state, distance);
  }
  template <class Flow, class AnyState>
  void remember(const Flow&, double, AnyState&) const noexcept {}

  template <class Slide, class Leg, class AnyState>
  double friction_work(const Slide& slide, const Leg& leg, const AnyState&) const {
    return slide.flow.friction_work(leg.time);
  }

 protected:
  const Law& law_;
};

}  // namespace stickslip::detail
