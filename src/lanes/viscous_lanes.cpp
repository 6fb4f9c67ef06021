#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "lanes/viscous_lanes.cpp"
#include "lanes/viscous_lanes.hpp"

#include <hwy/foreach_target.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "lanes/pack-inl.hpp"
#include "stickslip/sliding/advance.hpp"

HWY_BEFORE_NAMESPACE();
namespace stickslip::detail::HWY_NAMESPACE {

using Real = Pack<1>;
using Bool = Real::Mask;

void AdvanceViscous(const ViscousLanes& all, std::size_t members, const double* start, const double* end,
                    const LaneStates& states) {
  const DampedBasis& step = all.step;
  const Slider<Coulomb>& slider = all.slider;
  const double h = step.duration;
  const Real zeta = slider.damping(), stiffness = slider.stiffness(), decay = step.decay, impulse = step.impulse,
             by_step = step.step, ramp = step.ramp, rate = 1 / h;
  // The acceleration decays, or is a free vibration of a radian at most: within the segment it is at most the larger of
  // those at the ends, with a spring less than three times their sum. From a turn to the nearer end, half a segment at
  // most, the displacement goes by an eighth of it times the segment squared.
  const Real reach = (slider.stiffness() == 0 ? 1 : 3) * h * h / 8;
  double displacement[max_lanes], velocity[max_lanes];  // at the beginning
  std::uint64_t turning = 0;
  for (std::size_t i = 0; i < members; i += Real::size) {
    const Real x = Real::load(states.displacement + i), v = Real::load(states.velocity + i);
    x.store(displacement + i);
    v.store(velocity + i);
    const Real n0 = Real::load(start + i), n1 = Real::load(end + i), slope = (n0 - n1) * rate;
    const Real q = nfma(stiffness, x, -n0);
    const Real there = x + multiply_add(v, impulse, multiply_add(q, by_step, slope * ramp));
    const Real then = multiply_add(v, decay, multiply_add(q, impulse, slope * by_step));
    const Real before = nfma(zeta, v, q), after = nfma(zeta, then, nfma(stiffness, there, -n1));
    const Real farthest = max(abs(x), abs(there)), peak = max(Real::load(states.peak + i), farthest);
    const Bool turns =
        ((v * then <= 0) | (before * after <= 0)) & (multiply_add(abs(before) + abs(after), reach, farthest) > peak);
    there.store(states.displacement + i);
    then.store(states.velocity + i);
    peak.store(states.peak + i);
    turning |= bits(turns) << i;
  }
  for (; turning != 0; turning &= turning - 1) {
    const auto i = static_cast<std::size_t>(std::countr_zero(turning));
    const LaneStates none{displacement, velocity, states.peak};
    advance_alone(slider, Segment{h, start[i], end[i]}, State::at(displacement[i], velocity[i]), none, i);
  }
}

}  // namespace stickslip::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace stickslip::detail {

HWY_EXPORT(AdvanceViscous);

void advance_lanes(const ViscousLanes& lanes, std::size_t members, const double* start, const double* end,
                   const LaneStates& states) {
  HWY_DYNAMIC_DISPATCH(AdvanceViscous)(lanes, members, start, end, states);
}

}  // namespace stickslip::detail
#endif
