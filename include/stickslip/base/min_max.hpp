// std::min and std::max of two numbers. The rest of <algorithm>, which comes with the ranges, takes a sixth of the time
// that core.hpp takes to compile; libstdc++ has the two in a header that is included by all containers.
#pragma once

#include <version>

#include "stickslip/base/requirements.hpp"

#if defined(__GLIBCXX__) && __has_include(<bits/stl_algobase.h>)
#include <bits/stl_algobase.h>
#else
#include <algorithm>
#endif
