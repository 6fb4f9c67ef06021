// The Stribeck law: reference values, limits.
#include "stickslip/friction/stribeck.hpp"

#include <cmath>

#include "stickslip/core.hpp"
#include "support/catch.hpp"
#include "support/motions.hpp"
#include "support/outcome.hpp"
#include "support/reference.hpp"

using namespace stickslip;
using namespace test;

static_assert(SpeedLaw<Stribeck> && SymmetricLaw<Stribeck>);

TEST_CASE("sliders on Stribeck friction move as the reference does", "[stribeck]") {
  const Response r = integrate(Slider(Stribeck(1.3, 0.8, 0.1, 2), 4), record_a());
  const auto expected = reference::row("sliders", "others", "C.stribeck2.spring4");
  check_outcome(r, expected, false);
  CHECK(std::abs(r.energy.dissipated - expected["dissipated"]) <= 1e-12 * expected["dissipated"]);
}

TEST_CASE("Stribeck friction of exponent 1 is speed-dependent friction that weakens", "[stribeck]") {
  const GroundMotion motion = broadband(8, 1000);
  const Response one = integrate(Slider(Stribeck(1.3, 0.8, 0.1, 1), 4), motion);
  const Response other = integrate(Slider(VelocityDependent(1.3, 0.8, 10), 4), motion);
  CHECK(difference(one.displacement, other.displacement) <= 1e-11 * other.peak);
  CHECK(count(one.events) == count(other.events));
}

TEST_CASE("Stribeck friction becomes Coulomb's in its limits", "[stribeck]") {
  const GroundMotion motion = record_a();
  for (const int exponent : {1, 2, 3, 7, 31}) {
    CAPTURE(exponent);
    const auto same = [&](const Stribeck& law, double level) {
      const Response one = integrate(law, motion), other = integrate(Coulomb(level), motion);
      CHECK(difference(one.displacement, other.displacement) <= 1e-12 * other.peak);
    };
    same(Stribeck(1, 1, 0.1, exponent), 1);                      // no fall
    if (exponent > 1) same(Stribeck(1, 0.2, 1e9, exponent), 1);  // never fast enough
    const Response r = integrate(Slider(Stribeck(1.3, 0.9, 0.05, exponent), 2), motion);
    CHECK(std::abs(r.energy.imbalance()) <= 1e-12 * turnover(r.energy));
    CHECK(grammatical(r));
  }
}

TEST_CASE("Stribeck friction that cannot be is refused", "[stribeck]") {
  CHECK_THROWS_WITH(Stribeck(0.5, 0.8, 0.1, 2),
                    "Stribeck: the static level must be finite and at least the kinetic one of "
                    "0.8 m/s^2, got 0.5 m/s^2");
  CHECK_THROWS_WITH(Stribeck(1, 0.8, 0, 2), "Stribeck: velocity must be positive, got 0 m/s");
  CHECK_THROWS_WITH(Stribeck(1, 0.8, 0.1, 0), "Stribeck: exponent must be a whole number from 1 to 31, got 0");
  CHECK_THROWS_AS(Stribeck(1, not_a_number, 0.1, 1), std::invalid_argument);
}
