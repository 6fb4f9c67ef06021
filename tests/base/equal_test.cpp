// Exact comparison is equivalent to ==, also for the compiler.
#include "stickslip/base/equal.hpp"

#include <limits>

#include "support/catch.hpp"

using stickslip::detail::equal;

TEST_CASE("equal compares exactly, also while compiling", "[detail]") {
  constexpr double infinity = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
  static_assert(equal(0.0, -0.0) && equal(infinity, infinity) && equal(1, 1.0));
  static_assert(!equal(nan, nan) && !equal(nan, 0.0) && !equal(0.0, std::numeric_limits<double>::denorm_min()));
  volatile double one = 1;  // not known to the compiler
  CHECK(equal(one, 1));
  CHECK_FALSE(equal(one, 1 + std::numeric_limits<double>::epsilon()));
}
