// Explicit instantiations for the usual laws.
#include "stickslip/harmonic/orbits.hpp"
#include "stickslip/friction/caster.hpp"
#include "stickslip/friction/coulomb.hpp"

namespace stickslip {

template std::vector<Orbit> orbits(const Slider<Coulomb>&, double, double, const std::function<void()>&);
template std::vector<Orbit> orbits(const Slider<Caster>&, double, double, const std::function<void()>&);
template std::vector<State> states_at(const Slider<Coulomb>&, const Orbit&, const std::vector<double>&);
template std::vector<State> states_at(const Slider<Caster>&, const Orbit&, const std::vector<double>&);

}  // namespace stickslip
