// Explicit instantiations for the usual laws.
#include "stickslip/harmonic/continuation.hpp"
#include "stickslip/friction/caster.hpp"
#include "stickslip/friction/coulomb.hpp"

namespace stickslip {

template OrbitBranch continuation(const Slider<Coulomb>&, const Orbit&, double, double, const ContinuationOptions&);
template OrbitBranch continuation(const Slider<Caster>&, const Orbit&, double, double, const ContinuationOptions&);

}  // namespace stickslip
