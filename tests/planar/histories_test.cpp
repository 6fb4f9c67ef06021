// The motion in the plane at the samples alone.
#include "stickslip/planar/histories.hpp"

#include <cmath>
#include <cstddef>
#include <functional>
#include <stdexcept>
#include <vector>

#include "stickslip/planar/any_planar_slider.hpp"
#include "support/catch.hpp"
#include "support/motions.hpp"

using namespace stickslip;
using namespace test;
using Catch::Matchers::ContainsSubstring;

namespace {

GroundMotion components(Interpolation interpolation, bool vertical) {
  std::vector<double> across, up;
  for (int m = 0; m <= 400; ++m) {
    across.push_back(1.5 * std::sin(0.9 * m + 1.1) + 0.8 * std::cos(2.3 * m));
    if (vertical) up.push_back(10 * std::cos(0.5 * m + 0.2));
  }
  return record_a(interpolation).with_components(across, up);
}

}  // namespace

TEST_CASE("histories in the plane are those of integrate", "[planar]") {
  const AnyPlanarSlider sliders[] = {
      PlanarSlider(Coulomb(1)),
      PlanarSlider(StaticKinetic(Coulomb(1), 1.3), {.natural_frequency = 2, .damping = 0.2}),
      PlanarSlider(VelocityDependent(0.5, 1, 20), {.natural_frequency = 2}),
      PlanarSlider(Degrading({0, 0.5}, {1, 0.5})),
      PlanarSlider(Coulomb(0.5), {.stops = Stops(0.1, 0.5)}),
  };
  for (const AnyPlanarSlider& slider : sliders)
    for (const Interpolation interpolation : {Interpolation::linear, Interpolation::constant})
      for (const bool vertical : {false, true}) {
        if (vertical && interpolation == Interpolation::constant) continue;
        const GroundMotion motion = components(interpolation, vertical);
        PlanarIntegrateOptions options;
        options.may_end_in_flight = true;
        const PlanarResponse r = integrate(slider, motion, options);
        const PlanarHistories alone = histories(slider, motion);
        CHECK(alone.displacement == r.displacement);
        CHECK(alone.velocity == r.velocity);
        CHECK(r.sliding_distance > 0);
      }
}

TEST_CASE("histories in the plane report progress, and refuse what integrate refuses", "[planar]") {
  const PlanarSlider slider(Coulomb(1));
  CHECK_THROWS_WITH(histories(slider, record_a()), ContainsSubstring("needs a ground motion with a transverse"));
  const std::vector<double> fall(401, -standard_gravity);
  CHECK_THROWS_WITH(histories(slider, record_a().with_components(record_a_samples(), fall)),
                    ContainsSubstring("it never lands"));
  const std::vector<double> huge(401, 1e99);
  CHECK_THROWS_AS(histories(PlanarSlider(Coulomb(1)), GroundMotion(huge, 1e200).with_components(huge)),
                  std::overflow_error);
  const std::vector<double> n = gaussian(1, 10'000, 2);
  int calls = 0;
  histories(slider, GroundMotion(n, 0.1).with_components(n), [&] { ++calls; });
  CHECK(calls >= 2);
  const auto stop = [] { throw std::runtime_error("stop"); };
  CHECK_THROWS_WITH(histories(slider, GroundMotion(n, 0.1).with_components(n), stop), "stop");
}
