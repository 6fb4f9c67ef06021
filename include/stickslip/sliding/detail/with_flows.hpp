// The flows that suit a slider.
#pragma once

#include "stickslip/base/equal.hpp"
#include "stickslip/flow/damped.hpp"
#include "stickslip/flow/detail/block.hpp"
#include "stickslip/flow/oscillator.hpp"
#include "stickslip/flow/polynomial.hpp"
#include "stickslip/flow/remembering.hpp"
#include "stickslip/flow/sinusoidal.hpp"
#include "stickslip/flow/taylor.hpp"
#include "stickslip/friction/law.hpp"
#include "stickslip/slider/slider.hpp"

namespace stickslip::detail {

/// Return the result of `work` with the flows that suit constant friction on a level plane or a spring.
template <FrictionLaw Law, class Work>
[[gnu::always_inline]] inline auto with_block_flows(const Slider<Law>& slider, double usual_duration, Work&& work) {
  if (slider.damping() > 0) [[unlikely]]
    return work(BlockFlows(slider.law(), Damped(slider.damping(), slider.natural_frequency(), usual_duration)));
  if (slider.stiffness() > 0)
    return work(BlockFlows(slider.law(), Harmonic(slider.natural_frequency(), usual_duration)));
  return work(BlockFlows(slider.law(), Polynomial{}));
}

/// The same for any slider: closed forms if the resistance is constant or linear in the distance slid, else Taylor
/// series.
/// @param weighed  whether the normal force may differ from the weight; only then is a pendulum not a spring
template <FrictionLaw Law, class Work>
[[gnu::always_inline]] inline auto with_flows(const Slider<Law>& slider, bool weighed, double usual_duration,
                                              Work&& work) {
  if constexpr (form_of<Law> == Form::constant) {
    if (weighed && slider.mounting().pendulum) [[unlikely]]
      return work(Taylor<Law>(slider));
    return with_block_flows(slider, usual_duration, work);
  } else {
    return work(general_flows(slider, usual_duration));
  }
}

/// The same under a load of one frequency.
template <FrictionLaw Law, class Work>
auto with_harmonic_flows(const Slider<Law>& slider, double omega, double usual_duration, Work&& work) {
  if constexpr (form_of<Law> == Form::constant) {
    if (equal(slider.stiffness(), 0) && equal(slider.damping(), 0))
      return work(BlockFlows(slider.law(), Sinusoidal(omega, usual_duration)));
  }
  return work(general_flows(slider, usual_duration));
}

}  // namespace stickslip::detail
