// A law of functions: what they return, and what is refused.
#include "stickslip/friction/function_law.hpp"

#include <limits>
#include <stdexcept>

#include "stickslip/friction/law.hpp"
#include "support/catch.hpp"

using namespace stickslip;

static_assert(form_of<FunctionLaw> == Form::numeric && LawWithHold<FunctionLaw>);

TEST_CASE("a law of functions names what is wrong with a level", "[function_law]") {
  CHECK_THROWS_AS(FunctionLaw(FunctionLaw::Resist()), std::invalid_argument);
  const FunctionLaw negative([](double, double, Direction) { return -1.0; });
  CHECK_THROWS_WITH(negative.resist(0.5, 2, Direction::forward),
                    "Law: resist must be finite and at least 0, got -1 m/s^2 at x = 0.5 m and a speed of 2 m/s");
  const FunctionLaw law([](double x, double speed, Direction) { return 1 + x + speed; },
                        [](double x, Direction) { return 2 + x; });
  CHECK(law.resist(1, 2, Direction::forward) == 4);
  CHECK(law.hold(1, Direction::forward) == 3);
  CHECK(FunctionLaw(law.resist_function()).hold(1, Direction::forward) == 2);
}

TEST_CASE("a level of functions that is not finite is refused", "[function_law]") {
  for (const double level : {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    const FunctionLaw law([](double, double, Direction) { return 1.0; }, [=](double, Direction) { return level; });
    CHECK(law.resist(0, 0, Direction::backward) == 1);
    CHECK_THROWS_AS(law.hold(0, Direction::backward), InvalidLevel);
  }
}
