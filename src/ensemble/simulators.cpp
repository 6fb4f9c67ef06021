// The usual sliders and excitations, compiled once.
#include "stickslip/ensemble/ensemble.hpp"

namespace stickslip {

template class detail::MemberSimulator<Coulomb, GaussianExcitation>;
template class detail::MemberSimulator<Coulomb, PoissonPulses>;
template class detail::MemberSimulator<Caster, GaussianExcitation>;
template class detail::MemberSimulator<Caster, PoissonPulses>;
template class detail::ViscousSimulator<GaussianExcitation>;
template class detail::ViscousSimulator<PoissonPulses>;

}  // namespace stickslip
