// All of the header-only core: laws, sliders, ground motions, the event loop. Needs nothing but the standard library.
#pragma once

#include "stickslip/advance.hpp"
#include "stickslip/error.hpp"
#include "stickslip/friction/caster.hpp"
#include "stickslip/friction/coulomb.hpp"
#include "stickslip/friction/law.hpp"
#include "stickslip/ground_motion.hpp"
#include "stickslip/harmonic_motion.hpp"
#include "stickslip/integrate.hpp"
#include "stickslip/orbits.hpp"
#include "stickslip/response.hpp"
#include "stickslip/segment.hpp"
#include "stickslip/slider.hpp"
#include "stickslip/state.hpp"
#include "stickslip/units.hpp"
#include "stickslip/viscous.hpp"
