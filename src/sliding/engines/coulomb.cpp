// Engines of laws of the library; see engines.hpp.
#include "stickslip/sliding/detail/engines.hpp"

namespace stickslip::detail {

template class EngineOf<Coulomb>;

}  // namespace stickslip::detail
