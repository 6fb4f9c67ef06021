// Flows of friction that changes with the sliding distance.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <variant>

#include "stickslip/base/equal.hpp"
#include "stickslip/flow/closed_form.hpp"
#include "stickslip/flow/collocation.hpp"
#include "stickslip/flow/damped.hpp"
#include "stickslip/flow/detail/maker.hpp"
#include "stickslip/flow/oscillator.hpp"
#include "stickslip/flow/taylor.hpp"
#include "stickslip/friction/law.hpp"
#include "stickslip/slider/slider.hpp"
#include "stickslip/state/state.hpp"

namespace stickslip {

/// Friction that is linear in the sliding distance. A level that rises by k per meter is equivalent to constant friction
/// with a spring whose stiffness is larger by k:
///     d'' = a + g(t) - (wn^2 + k) d - c (d' - u).
/// If wn^2 + k is negative, the spring pushes away from its center.
class LinearLevel {
 public:
  /// @param stiffness       wn^2 + k [1/s^2]
  /// @param usual_duration  time whose basis is precomputed without a damper [s]; the segments of a record have equal
  ///                        length. With one, a step of usual duration would be computed in another way than an equal
  ///                        one of a run that is split, and the last bits would differ
  LinearLevel(double damping, double stiffness, double usual_duration) noexcept : stiffness_(stiffness) {
    const double root = std::copysign(std::sqrt(std::abs(stiffness)), stiffness);
    if (stiffness > 0 && !(damping > 0))
      motion_.emplace<Harmonic>(root, usual_duration);
    else
      motion_.emplace<Damped>(damping, root);
  }

  double stiffness() const noexcept { return stiffness_; }
  /// On a spring without a damper; else null.
  const Harmonic* undamped() const noexcept { return std::get_if<Harmonic>(&motion_); }
  /// Any other motion.
  const Damped* damped() const noexcept { return std::get_if<Damped>(&motion_); }

 private:
  double stiffness_;
  std::variant<std::monostate, Harmonic, Damped> motion_;
};

/// The flow of a LinearLevel, in closed form.
class LinearLevelFlow {
 public:
  /// @param level     held by reference
  /// @param friction  the part of the resistance that dissipates, at the start [m/s^2]
  /// @param wears     and its slope [1/s^2]
  LinearLevelFlow(const LinearLevel& level, double friction, double wears, const Start& start, double duration)
      : friction_(friction), wears_(wears), damped_(level.damped() && level.damped()->damping() > 0) {
    const double k = level.stiffness();
    if (level.undamped())
      undamped_.emplace(level.undamped()->flow(start, duration));
    else
      flow_.emplace(*level.damped(), part_of(start, duration, k), reach(duration, k));
  }
  LinearLevelFlow(const LinearLevelFlow&) = delete;
  LinearLevelFlow& operator=(const LinearLevelFlow&) = delete;

  double horizon() const noexcept { return undamped_ ? undamped_->horizon() : flow_->horizon(); }
  double first_stop() const noexcept { return undamped_ ? undamped_->first_stop() : flow_->first_stop(); }
  Progress at(double t) const noexcept { return undamped_ ? undamped_->at(t) : flow_->at(t); }
  Progress at_horizon() const noexcept { return undamped_ ? undamped_->at_horizon() : flow_->at_horizon(); }

  /// Work on the damper up to time t [m^2/s^2].
  double damped_work(double t) const noexcept { return damped_ ? flow_->damped_work(t) : 0; }
  /// Work against friction up to time t [m^2/s^2].
  double friction_work(double t) const noexcept {
    const double way = t < horizon() ? at(t).distance : at_horizon().distance;
    return way * (friction_ + wears_ / 2 * way);
  }

 private:
  // A motion that grows by more than e^16 could overflow long before the linear piece of the level ends.
  static double reach(double duration, double stiffness) noexcept {
    return stiffness < 0 ? std::min(duration, 16 / std::sqrt(-stiffness)) : duration;
  }
  static Start part_of(const Start& start, double duration, double stiffness) noexcept {
    return {start.speed, start.acceleration, start.gain_within(reach(duration, stiffness), duration)};
  }

  double friction_, wears_;
  bool damped_;
  std::optional<ClosedForm<Harmonic>> undamped_;
  std::optional<DampedFlow> flow_;
};

/// Makes the flows of a slider whose law has memory, from the law that applies from each state on. The flow has a
/// closed form if both that law and the load are linear; otherwise it is a Taylor series.
template <MemoryLaw Law>
class Remembering : public detail::LawFlows<Law> {
 public:
  static constexpr bool in_closed_form = form_of<Law> == Form::linear;

  /// @param usual_duration  of most segments [s]
  explicit Remembering(const Slider<Law>& slider, double usual_duration = std::numeric_limits<double>::quiet_NaN())
      : detail::LawFlows<Law>(slider.law()), slider_(slider), usual_duration_(usual_duration) {}

  double pull(double x, double weight) const noexcept { return slider_.mounting().spring().under(weight) * x; }
  double drag(double speed) const noexcept { return slider_.damping() * speed; }

  /// The spring on which a segment of the usual duration runs if the law does not change, without a damper; null if
  /// there is none.
  template <class Now>
  const Harmonic* spring(const Now& law, Direction direction, double duration) const {
    if (!detail::equal(duration, usual_duration_) || slider_.damping() > 0) return nullptr;
    return level(slider_.stiffness() + law.slope(direction)).undamped();
  }

  /// The returned flow must be destroyed before the next call.
  template <class SlipStart>
  auto flow(Direction direction, const State& state, const SlipStart& start, double duration) const {
    if constexpr (std::same_as<SlipStart, Start> && form_of<Now> == Form::linear) {
      const Now law = this->law_toward(direction, state, 1);
      const double slope = law.slope(direction);
      return LinearLevelFlow(level(slider_.stiffness() + slope), friction(law, state.displacement, 0, direction),
                             detail::SpringLaw<Now> ? 0 : slope, start, duration);
    } else {
      now_.emplace(slider_.at(state));
      return TaylorFlow<Now, SlipStart>(*now_, direction, state.displacement, start, duration);
    }
  }

 private:
  using Now = std::remove_cvref_t<decltype(std::declval<const Law&>().at(State{}))>;

  // The levels met last: a law has few slopes, to which it returns.
  const LinearLevel& level(double stiffness) const {
    if (levels_[last_] && detail::equal(levels_[last_]->stiffness(), stiffness)) [[likely]]
      return *levels_[last_];
    for (last_ = 0; last_ < levels_.size(); ++last_)
      if (levels_[last_] && detail::equal(levels_[last_]->stiffness(), stiffness)) return *levels_[last_];
    last_ = std::exchange(oldest_, (oldest_ + 1) % levels_.size());
    return levels_[last_].emplace(slider_.damping(), stiffness, usual_duration_);
  }

  const Slider<Law>& slider_;
  double usual_duration_;
  mutable std::optional<Slider<Now>> now_;
  mutable std::array<std::optional<LinearLevel>, 8> levels_;
  mutable std::size_t oldest_ = 0, last_ = 0;  // of them
};

/// Makes flows that support the law under any load.
template <FrictionLaw Law>
auto general_flows(const Slider<Law>& slider,
                   [[maybe_unused]] double usual_duration = std::numeric_limits<double>::quiet_NaN()) {
  if constexpr (form_of<Law> == Form::numeric)
    return Collocating<Law>(slider);
  else if constexpr (MemoryLaw<Law>)
    return Remembering<Law>(slider, usual_duration);
  else
    return Taylor<Law>(slider);
}

}  // namespace stickslip
