// The engines that the library contains: those of the laws of AnySlider.
#pragma once

#include "stickslip/friction/caster.hpp"
#include "stickslip/friction/coulomb.hpp"
#include "stickslip/friction/degrading.hpp"
#include "stickslip/friction/function_law.hpp"
#include "stickslip/friction/kumar.hpp"
#include "stickslip/friction/multi_pendulum.hpp"
#include "stickslip/friction/static_kinetic.hpp"
#include "stickslip/friction/stribeck.hpp"
#include "stickslip/friction/velocity_dependent.hpp"
#include "stickslip/sliding/detail/engine_of.hpp"

namespace stickslip::detail {

extern template class EngineOf<Coulomb>;
extern template class EngineOf<Caster>;
extern template class EngineOf<VelocityDependent>;
extern template class EngineOf<Stribeck>;
extern template class EngineOf<Degrading>;
extern template class EngineOf<KumarFriction>;
extern template class EngineOf<MultiPendulum>;
extern template class EngineOf<FunctionLaw>;
extern template class EngineOf<StaticKinetic<Coulomb>>;
extern template class EngineOf<StaticKinetic<Caster>>;
extern template class EngineOf<StaticKinetic<VelocityDependent>>;
extern template class EngineOf<StaticKinetic<Degrading>>;

}  // namespace stickslip::detail
