// Explicit instantiation for the usual law.
#include "stickslip/sliding/sensitivity.hpp"
#include "stickslip/friction/coulomb.hpp"

namespace stickslip {

template Sensitivity sensitivity(const Slider<Coulomb>&, const GroundMotion&, const Response&, Parameter,
                                 std::optional<std::size_t>);

}  // namespace stickslip
