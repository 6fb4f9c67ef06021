// All of stickslip: the header-only core, and what the compiled library adds.
#pragma once

#include "stickslip/build_info.hpp"
#include "stickslip/core.hpp"
#include "stickslip/ensemble.hpp"
#include "stickslip/envelope.hpp"
#include "stickslip/excitation/gaussian.hpp"
#include "stickslip/excitation/poisson.hpp"
#include "stickslip/histories.hpp"
#include "stickslip/moments.hpp"
#include "stickslip/random.hpp"
#include "stickslip/records.hpp"
#include "stickslip/spectrum.hpp"
#include "stickslip/strong_motion.hpp"
#include "stickslip/theory/stationary_linearization.hpp"
