// Engines of laws of the library; see engines.hpp.
#include "stickslip/sliding/detail/engines.hpp"

namespace stickslip::detail {

template class EngineOf<Caster>;
template class EngineOf<StaticKinetic<Caster>>;
template class EngineOf<VelocityDependent>;
template class EngineOf<StaticKinetic<VelocityDependent>>;
template class EngineOf<Stribeck>;

}  // namespace stickslip::detail
