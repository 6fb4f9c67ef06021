// One slider along all directions of a station: equal to integrate, rotations, mirrored directions, refusals.
#include "stickslip/sweep/orientations.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <vector>

#include "stickslip/core.hpp"
#include "stickslip/friction/function_law.hpp"
#include "stickslip/ground/processing.hpp"
#include "support/catch.hpp"
#include "support/motions.hpp"

using namespace stickslip;
using namespace test;
using Catch::Matchers::ContainsSubstring;

namespace {

/// Two horizontal components of several incommensurate frequencies.
GroundMotion station(std::size_t samples = 501) {
  std::vector<double> n, t;
  for (std::size_t i = 0; i < samples; ++i) {
    const double time = 0.01 * static_cast<double>(i), fades = std::sin(time * 0.6);
    n.push_back(fades * (3 * std::sin(7 * time) + 2 * std::sin(19 * time + 1)));
    t.push_back(fades * (2.5 * std::sin(5 * time + 2) - 3 * std::cos(13 * time)));
  }
  return GroundMotion(std::move(n), 0.01).with_components(std::move(t));
}

std::vector<double> degrees(int from, int to, int step = 1) {
  std::vector<double> all;
  for (int d = from; d < to; d += step) all.push_back(d);
  return all;
}

}  // namespace

TEST_CASE("each direction is what integrate says of the rotated station, to the bit", "[sweep]") {
  const GroundMotion one = station();
  const std::vector<double> angles{0, 17.25, 90, 179, -30, 725, 200.5};
  std::vector<double> a_z(one.samples());
  for (std::size_t i = 0; i < a_z.size(); ++i) a_z[i] = 4 * std::sin(0.3 * static_cast<double>(i));
  const GroundMotion lifted = one.with_components({one.transverse().begin(), one.transverse().end()}, std::move(a_z));
  const auto check = [&](const auto& slider, const GroundMotion& motion, bool settle) {
    const Orientations all = orientations(slider, motion, angles, {.settle = settle, .threads = 2});
    CHECK(all.failures.empty());
    for (std::size_t i = 0; i < angles.size(); ++i) {
      const Response r = integrate(slider, rotated(motion, angles[i]), {.settle = settle, .may_end_in_flight = true});
      CHECK(all.peak[i] == r.peak);
      CHECK(all.residual[i] == r.residual);
    }
  };
  for (const bool settle : {false, true}) {
    check(Slider(Coulomb(1.0)), one, settle);
    check(Slider(Coulomb(1.0), Mounting{.slope_degrees = 3, .one_way = true}), one, settle);
    check(Slider(VelocityDependent(0.5, 1, 10), 2.0, 0.3), one, settle);
    check(Slider(Coulomb(1.0), Mounting{.stops = Stops(0.02, 0.01, 0.5)}), one, settle);
    check(Slider(Coulomb(1.0)), lifted, settle);
  }
}

TEST_CASE("the opposite direction mirrors a slider that is equal both ways, and no other", "[sweep]") {
  const GroundMotion one = station();
  const std::vector<double> all = degrees(0, 360, 15);
  const auto check = [&](const auto& slider, bool mirrored) {
    CHECK(mirrors(slider) == mirrored);
    const Orientations found = orientations(slider, one, all);
    double largest = 0;
    for (const double peak : found.peak) largest = std::max(largest, peak);
    double difference = 0;
    for (std::size_t i = 0; i < 12; ++i) {
      difference = std::max(difference, std::abs(found.peak[i] - found.peak[i + 12]));
      difference = std::max(difference, std::abs(found.residual[i] + found.residual[i + 12]));
    }
    if (mirrored)
      CHECK(difference == 0);
    else
      CHECK(difference > 0.01 * largest);
  };
  check(Slider(Coulomb(1.0)), true);
  check(Slider(StaticKinetic(Coulomb(0.8), 1.2), 2.0), true);
  check(Slider(Caster(1.0, 0.1)), true);
  check(Slider(Degrading({0, 0.1}, {1.0, 0.5})), true);
  check(Slider(Coulomb(1.0), Mounting{.stops = Stops(0.01, 0.5)}), true);
  check(Slider(Coulomb(1.0, 1.5)), false);
  check(Slider(Degrading({0, 0.1}, {1.0, 0.5}, {1.5, 1.0})), false);
  check(Slider(StaticKinetic(Coulomb(0.8), 1.2, 2.5)), false);
  check(Slider(Coulomb(1.0), Mounting{.slope_degrees = 4}), false);
  check(Slider(Coulomb(1.0), Mounting{.one_way = true}), false);
  check(Slider(Coulomb(1.0), Mounting{.stops = Stops(0.01, 0.002, 0.5)}), false);
  CHECK_FALSE(mirrors(Slider(FunctionLaw([](double, double, Direction) { return 1.0; }))));
}

TEST_CASE("a station that is turned has the same responses in turned directions", "[sweep]") {
  const GroundMotion one = station();
  const Slider slider(Coulomb(1.0, 1.3), 1.5);
  const Orientations here = orientations(slider, one, degrees(0, 360, 10));
  const Orientations quarter = orientations(slider, rotated(one, 90), degrees(0, 360, 10));
  // Rotation rounds the samples by some 1e-16, and the peak responds in proportion where it depends smoothly on them.
  for (std::size_t i = 0; i < 36; ++i) CHECK(quarter.peak[i] == Approx(here.peak[(i + 9) % 36]).epsilon(1e-10));
  const Orientations turned = orientations(slider, rotated(one, 50), degrees(0, 360, 10));
  for (std::size_t i = 0; i < 36; ++i) {
    CHECK(turned.peak[i] == Approx(here.peak[(i + 5) % 36]).epsilon(1e-10));
    CHECK(turned.residual[i] == Approx(here.residual[(i + 5) % 36]).margin(1e-10 * here.peak[0]));
  }
}

TEST_CASE("orientations refuse what they cannot integrate, and stop on request", "[sweep][errors]") {
  const GroundMotion one = station();
  CHECK_THROWS_WITH(orientations(Coulomb(1), one, std::vector<double>{}), ContainsSubstring("at least one direction"));
  CHECK_THROWS_WITH(orientations(Coulomb(1), one, std::vector{0.0, not_a_number}),
                    ContainsSubstring("degrees[1] must be finite"));
  CHECK_THROWS_WITH(orientations(Coulomb(1), one.component(Component::axis), std::vector{0.0}),
                    ContainsSubstring("needs a transverse component"));
  const Orientations failed = orientations(Coulomb(0), one, std::vector{0.0, 90.0, 180.0}, {.settle = true});
  REQUIRE(failed.failures.size() == 3);
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(failed.failures[i].place == i);
    CHECK_THAT(failed.failures[i].message, ContainsSubstring("does not come to rest"));
    CHECK((std::isnan(failed.peak[i]) && std::isnan(failed.residual[i])));
  }
  std::size_t done = 0;
  static_cast<void>(orientations(Coulomb(1), one, degrees(0, 360),
                                 {.progress = [&](std::size_t some, std::size_t) { done = some; }}));
  CHECK(done == 360);
  struct Enough {};
  CHECK_THROWS_AS(orientations(Coulomb(1), station(200'001), degrees(0, 180),
                               {.progress = [](std::size_t, std::size_t) { throw Enough{}; }}),
                  Enough);
}
