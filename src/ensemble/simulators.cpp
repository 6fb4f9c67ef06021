// Members with the usual sliders, instantiated once.
#include "stickslip/ensemble/detail/simulator.hpp"

namespace stickslip::detail {

template void simulate_member(const Slider<Coulomb>&, const GroundMotion&, bool, Contact, const MemberPlace&);
template void simulate_member(const Slider<Caster>&, const GroundMotion&, bool, Contact, const MemberPlace&);
template void simulate_member(const Slider<VelocityDependent>&, const GroundMotion&, bool, Contact, const MemberPlace&);

}  // namespace stickslip::detail
