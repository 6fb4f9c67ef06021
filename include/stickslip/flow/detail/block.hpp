// The flows of friction that is constant while the slider moves in one direction.
#pragma once

#include <concepts>
#include <utility>

#include "stickslip/flow/closed_form.hpp"
#include "stickslip/flow/detail/maker.hpp"
#include "stickslip/flow/polynomial.hpp"
#include "stickslip/friction/law.hpp"
#include "stickslip/state/state.hpp"

namespace stickslip::detail {

/// Makes the flows of constant friction: those of a mass on a spring and a damper, or free.
/// @tparam Oscillator  Polynomial, Harmonic, Damped or Sinusoidal
template <FrictionLaw Law, class Oscillator>
requires(form_of<Law> == Form::constant) class BlockFlows : public LawFlows<Law> {
 public:
  static constexpr bool in_closed_form = requires { typename Oscillator::Basis; };
  static constexpr int most_steps = in_closed_form ? 1'000'000 : 3'000'000;

  BlockFlows(const Law& law, Oscillator oscillator) : LawFlows<Law>(law), oscillator_(std::move(oscillator)) {}

  double pull(double x, double /*weight*/) const noexcept { return oscillator_.pull(x); }
  double drag(double speed) const noexcept { return oscillator_.drag(speed); }

  template <class AnyState, class SlipStart>
  auto flow(Direction, const AnyState&, const SlipStart& start, double duration) const noexcept {
    return oscillator_.flow(start, duration);
  }

  template <class Slide, class Leg, class AnyState>
  double friction_work(const Slide& slide, const Leg& leg, const AnyState& state) const {
    if constexpr (std::derived_from<decltype(slide.start), LoadStart>)
      return slide.start.friction_work(leg.time, slide.left, leg.end);
    else
      return stickslip::friction_work(this->law_, state.displacement, leg.end.distance, slide.direction);
  }

 private:
  Oscillator oscillator_;
};

}  // namespace stickslip::detail
