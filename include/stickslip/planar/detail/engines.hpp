// The event loops in the plane that the library contains: those of its laws.
#pragma once

#include "stickslip/friction/laws.hpp"
#include "stickslip/planar/advance.hpp"

namespace stickslip::detail {

#define STICKSLIP_PLANE_ENGINE(...) template struct PlaneEngine<__VA_ARGS__>;
#define STICKSLIP_EXTERN_ENGINE(...) extern STICKSLIP_PLANE_ENGINE(__VA_ARGS__)
STICKSLIP_LAWS(STICKSLIP_EXTERN_ENGINE)
#undef STICKSLIP_EXTERN_ENGINE

}  // namespace stickslip::detail
