// Event loops in the plane for laws of the library; see laws.hpp.
#include "stickslip/planar/detail/engines.hpp"

namespace stickslip::detail {

STICKSLIP_ANALYTIC_LAWS(STICKSLIP_PLANE_ENGINE)
STICKSLIP_NUMERIC_LAWS(STICKSLIP_PLANE_ENGINE)

}  // namespace stickslip::detail
