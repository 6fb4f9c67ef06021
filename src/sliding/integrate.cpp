// Explicit instantiations for the usual laws.
#include "stickslip/sliding/integrate.hpp"
#include "stickslip/friction/caster.hpp"
#include "stickslip/friction/coulomb.hpp"

namespace stickslip {

template Response integrate(const Slider<Coulomb>&, const GroundMotion&, const IntegrateOptions&, Response);
template Response integrate(const Slider<Coulomb>&, const HarmonicMotion&, const IntegrateOptions&, Response);
template Response integrate(const Slider<Caster>&, const GroundMotion&, const IntegrateOptions&, Response);
template Response integrate(const Slider<Caster>&, const HarmonicMotion&, const IntegrateOptions&, Response);

}  // namespace stickslip
