// Static friction above kinetic: reference values, grazes, limits.
#include "stickslip/friction/static_kinetic.hpp"

#include <cmath>

#include "stickslip/core.hpp"
#include "support/catch.hpp"
#include "support/motions.hpp"
#include "support/outcome.hpp"
#include "support/reference.hpp"

using namespace stickslip;
using namespace test;
using Catch::Matchers::ContainsSubstring;

static_assert(form_of<StaticKinetic<>> == Form::constant && LawWithWork<StaticKinetic<>> &&
              LawWithHold<StaticKinetic<>>);
static_assert(SpeedLaw<StaticKinetic<VelocityDependent>> && !PositionLaw<StaticKinetic<VelocityDependent>>);

namespace {

void check(const char* id, const StaticKinetic<>& law) {
  INFO(id);
  const GroundMotion motion = record_a();
  const Response r = integrate(law, motion);
  const auto expected = reference::row("sliders", "others", id);
  check_outcome(r, expected,
                -motion.acceleration()[0] > law.static_forward() || motion.acceleration()[0] > law.static_backward());
  CHECK(std::abs(r.energy.dissipated - expected["dissipated"]) <= 1e-12 * expected["dissipated"]);
}

}  // namespace

TEST_CASE("sliders with a static level move as the reference does", "[static_kinetic]") {
  check("B.as1.3.ak1", StaticKinetic(Coulomb(1), 1.3));
  check("B.as2.ak0.5", StaticKinetic(Coulomb(0.5), 2));
  check("B.unequal", StaticKinetic(Coulomb(0.9, 1.5), 1.2, 1.9));
  check("B.limit.as_eq_ak", StaticKinetic(Coulomb(1), 1));
}

TEST_CASE("a slip that all but stops sticks or goes on by the static level", "[static_kinetic]") {
  // next_values.json B.graze.*: load 0.8 + 0.45 t for 1 s, kinetic level 1: the least speed is 1e-6 m/s off zero.
  const auto slide = [](const auto& law, double speed) {
    return integrate(law, line(-0.8, -1.25, 1), from(0, speed)).state;
  };
  const double just_below = 2.0 / 45 - 1e-6, just_above = 2.0 / 45 + 1e-6;
  const State stuck = slide(StaticKinetic(Coulomb(1), 1.3), just_below);
  CHECK(stuck.mode == Mode::stuck);
  CHECK(std::abs(stuck.displacement - 0.006583919100929988881419621) <= 1e-13);
  const State goes_on = slide(Coulomb(1), just_below);
  CHECK(std::abs(goes_on.displacement - 0.01944400140545673785261304) <= 1e-13);
  CHECK(std::abs(goes_on.velocity - 0.06944444444444444444444444) <= 1e-13);
  for (const State& through : {slide(StaticKinetic(Coulomb(1), 1.3), just_above), slide(Coulomb(1), just_above)}) {
    CHECK(std::abs(through.displacement - 0.01944544444444444444444444) <= 1e-13);
    CHECK(std::abs(through.velocity - 0.06944544444444444444444444) <= 1e-13);
  }
}

TEST_CASE("any law of sliding may have a static level", "[static_kinetic]") {
  const GroundMotion motion = record_a();
  const auto same = [&](const auto& law, double level) {
    const Response one = integrate(Slider(StaticKinetic(law, level), 2), motion),
                   other = integrate(Slider(law, 2), motion);
    CHECK(difference(one.displacement, other.displacement) <= 1e-12 * other.peak);
    CHECK(count(one.events) == count(other.events));
  };
  same(Coulomb(1), 1);
  same(VelocityDependent(0.6, 1.5, 5), 0.6);
  same(Caster(1, 1e9), 1);
  // As much as never breaks away.
  CHECK(integrate(StaticKinetic(VelocityDependent(0.6, 1.5, 5), 4), motion).peak == 0);
  // Breaks away later than without it, with a jump of the acceleration.
  const Response r = integrate(StaticKinetic(Caster(1, 0.5), 1.5), line(0, -2, 2));
  CHECK(r.events[0].time == Approx(1.5).margin(1e-14));
}

TEST_CASE("static levels that cannot be are refused", "[static_kinetic]") {
  CHECK_THROWS_WITH(StaticKinetic(Coulomb(1), 0.9),
                    "StaticKinetic: the static level forward must be finite and at least "
                    "the kinetic one of 1 m/s^2, got 0.9 m/s^2");
  CHECK_THROWS_WITH(StaticKinetic(Coulomb(1), 1, 0.5), ContainsSubstring("static level backward"));
  CHECK_THROWS_AS(StaticKinetic(Coulomb(1), not_a_number), std::invalid_argument);
  CHECK_THROWS_AS(StaticKinetic(Coulomb(1), infinity), std::invalid_argument);
  CHECK_NOTHROW(StaticKinetic(Coulomb(1, infinity), 1.2, infinity));
}
