// Movers of the laws of the library; see linear_mover.hpp and laws.hpp.
#include "stickslip/sliding/detail/linear_mover.hpp"

namespace stickslip::detail {

STICKSLIP_LAWS(STICKSLIP_LINEAR_MOVER)

}  // namespace stickslip::detail
