// std::function. The rest of <functional> takes a tenth of the time that core.hpp takes to compile; libstdc++ has it in
// a header of its own.
#pragma once

#include <version>

#include "stickslip/base/requirements.hpp"

#if defined(__GLIBCXX__) && __has_include(<bits/std_function.h>)
#include <bits/std_function.h>
#else
#include <functional>
#endif
