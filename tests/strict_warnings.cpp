// Templates of the headers as a user's code makes them, compiled with the warnings of a strict user.
#include <all_headers.hpp>

using namespace stickslip;

namespace {

template <FrictionLaw Law>
double use(const Slider<Law>& slider) {
  const GroundMotion motion({0, 3, -2, 0}, 0.1);
  const GroundMotion shaken = motion.with_components({}, {0, 1, -1, 0});
  double sum = integrate(slider, motion).peak + integrate(slider, shaken).peak;
  if constexpr (!HeatedLaw<Law>) sum += integrate(slider, HarmonicMotion(2, 3, 1)).peak;
  return sum;
}

}  // namespace

double use_all();
double use_all() {
  const KumarFriction heated({.mu_ref = 0.1, .static_pressure = 5e7, .reference_pressure = 5e7, .contact_radius = 0.2});
  return use(Slider(Coulomb(1), 3, 0.1)) + use(Slider(Caster(1, 0.5))) + use(Slider(StaticKinetic(Coulomb(1), 2))) +
         use(Slider(VelocityDependent(1, 2, 5), 3)) + use(Slider(Stribeck(2, 1, 0.1, 3))) +
         use(Slider(Degrading({0, 1}, {2, 1}))) + use(Slider(heated, 3));
}
