// Explicit instantiations for the usual laws.
#include "stickslip/sliding/histories.hpp"
#include "stickslip/friction/caster.hpp"
#include "stickslip/friction/coulomb.hpp"

namespace stickslip {

template Histories histories(const Slider<Coulomb>&, const GroundMotion&, const std::function<void()>&);
template Histories histories(const Slider<Caster>&, const GroundMotion&, const std::function<void()>&);

}  // namespace stickslip
