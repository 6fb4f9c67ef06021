// Requirements on the compiler: C++20, exceptions, and IEEE 754 arithmetic.
#pragma once

#if defined(_MSVC_LANG) ? _MSVC_LANG < 202002L : __cplusplus < 202002L
#error "stickslip needs C++20: compile with -std=c++20 (MSVC: /std:c++20), or link to a CMake target of stickslip."
#include "stickslip/stops-here.hpp"  // does not exist: one error is clearer than the hundreds that would follow
#endif

#if !defined(__cpp_exceptions)
#error \
    "stickslip needs exceptions: compile without -fno-exceptions (MSVC: with /EHsc), or call the C interface, stickslip/stickslip.h, from code without them."
#include "stickslip/stops-here.hpp"  // does not exist, see above
#endif

#if defined(__FAST_MATH__) || defined(_M_FP_FAST) || defined(__ASSOCIATIVE_MATH__) || defined(__RECIPROCAL_MATH__) || \
    (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__)
#error \
    "stickslip needs IEEE 754 arithmetic: compile without -ffast-math, -Ofast and -ffinite-math-only (MSVC: /fp:fast). With them infinity and NaN are not recognized, roots lose their digits, and events are missed."
#include "stickslip/stops-here.hpp"  // does not exist, see above
#endif
