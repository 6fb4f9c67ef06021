// The memory of pendulums with several surfaces, and the surfaces that slide along a loop.
#include "stickslip/friction/pendulum_loop.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "stickslip/friction/multi_pendulum.hpp"
#include "stickslip/state/state.hpp"
#include "support/catch.hpp"

using namespace stickslip;
using Catch::Matchers::WithinAbs;

TEST_CASE("a pendulum that starts beyond a jump of its force has its memory") {
  // The first element is at its stop at 0.02 m, where phi = 0.02/1 + 0.01; from there the second needs phi = 0.1.
  const MultiPendulum law({1, 2}, {0.01, 0.1}, {0.02, 0.1});
  for (const double start : {0.05, -0.05}) {
    State begun = State::at(start, 0), pushed = State::at(0, start);
    law.begin(begun);
    for (double left = std::abs(start); left > 0;) {
      const double way = std::min(left, law.ahead(pushed, direction_of(pushed.mode)));
      law.slide(pushed, way);
      left -= way;
    }
    CHECK(begun.pendulum == pushed.pendulum);
    const double s = start > 0 ? 1 : -1;
    const std::vector<double> elements = law.displacements(begun.pendulum);
    CHECK_THAT(elements[0], WithinAbs(s * 0.02, 1e-16));
    CHECK_THAT(elements[1], WithinAbs(s * 0.03, 1e-16));
    CHECK_THAT(law.force(begun.pendulum, direction_of(pushed.mode)), WithinAbs(s * (0.03 / 2 + 0.1), 1e-16));
    CHECK_THAT(law.force(begun.pendulum, opposite(direction_of(pushed.mode))), WithinAbs(s * (0.02 - 0.01), 1e-16));
  }
}

TEST_CASE("the corners of a loop name the surfaces that slide, in Fenz and Constantinou's order") {
  const MultiPendulum triple({0.3937, 3.7465, 3.7465}, {0.01, 0.04, 0.08}, {0.0716, 0.5043, 0.5043}, 0, true);
  // From bottom to top: lower outer 1, lower inner 2, upper inner 4, upper outer 8.
  std::vector<unsigned> sliding;
  const std::vector<double> path{triple.capacity() * (1 - 1e-9)};
  for (const auto& corner : trace(triple, path).corners) sliding.push_back(corner.moving);
  CHECK(sliding == std::vector<unsigned>{2 + 4, 1 + 4, 1 + 8, 2 + 8, 2 + 4, 2 + 4});
}
