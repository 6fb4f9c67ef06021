#include "support/motions.hpp"

namespace stickslip {
STICKSLIP_TEST_INTEGRATE(Coulomb, GroundMotion);
STICKSLIP_TEST_INTEGRATE(Coulomb, HarmonicMotion);
STICKSLIP_TEST_INTEGRATE(Caster, GroundMotion);
STICKSLIP_TEST_INTEGRATE(Caster, HarmonicMotion);
}  // namespace stickslip
