// Engines of laws of the library; see engines.hpp.
#include "stickslip/sliding/detail/engines.hpp"

namespace stickslip::detail {

template class EngineOf<StaticKinetic<Coulomb>>;
template class EngineOf<Degrading>;
template class EngineOf<StaticKinetic<Degrading>>;
template class EngineOf<MultiPendulum>;

}  // namespace stickslip::detail
