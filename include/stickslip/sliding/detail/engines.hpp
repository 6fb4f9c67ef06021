// The engines that the library contains: those of its laws.
#pragma once

#include "stickslip/friction/laws.hpp"
#include "stickslip/sliding/detail/engine_of.hpp"

namespace stickslip::detail {

#define STICKSLIP_ENGINE(...) template class EngineOf<__VA_ARGS__>;
#define STICKSLIP_EXTERN_ENGINE(...) extern STICKSLIP_ENGINE(__VA_ARGS__)
STICKSLIP_LAWS(STICKSLIP_EXTERN_ENGINE)
#undef STICKSLIP_EXTERN_ENGINE

}  // namespace stickslip::detail
