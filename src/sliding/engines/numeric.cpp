// Engines of laws of the library; see laws.hpp.
#include "stickslip/sliding/detail/engines.hpp"

namespace stickslip::detail {

STICKSLIP_NUMERIC_LAWS(STICKSLIP_ENGINE)

}  // namespace stickslip::detail
