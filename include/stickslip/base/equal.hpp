// Exact comparison of two floating-point numbers, where it is meant: a value that was set and not computed (no spring,
// no damper, `never`), a zero that decides a sign or a division, the end of a segment that is handed on unchanged.
// Elsewhere == between floating-point numbers is a mistake: the headers compile under -Wfloat-equal.
#pragma once

#include "stickslip/base/requirements.hpp"

namespace stickslip::detail {

#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wfloat-equal"
#endif
/// a == b, exactly: 0 equals -0, and NaN equals nothing.
constexpr bool equal(double a, double b) noexcept { return a == b; }
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif

}  // namespace stickslip::detail
