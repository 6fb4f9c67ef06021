// All of the header-only core: laws, sliders, ground motions, the event loop. Needs nothing but the standard library.
#pragma once

#include "stickslip/error.hpp"
#include "stickslip/friction/caster.hpp"
#include "stickslip/friction/coulomb.hpp"
#include "stickslip/friction/law.hpp"
#include "stickslip/friction/velocity_dependent.hpp"
#include "stickslip/ground/ground_motion.hpp"
#include "stickslip/ground/harmonic_motion.hpp"
#include "stickslip/ground/segment.hpp"
#include "stickslip/slider.hpp"
#include "stickslip/sliding/advance.hpp"
#include "stickslip/sliding/integrate.hpp"
#include "stickslip/sliding/response.hpp"
#include "stickslip/state.hpp"
#include "stickslip/units.hpp"
#include "stickslip/viscous.hpp"
