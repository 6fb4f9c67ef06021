// A slider of any law in the plane: the same answers as in its own type; which sliders can be in the plane.
#include "stickslip/planar/any_planar_slider.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <variant>
#include <vector>

#include "support/catch.hpp"

using namespace stickslip;
using Catch::Matchers::ContainsSubstring;

namespace {

GroundMotion pair() {
  std::vector<double> axis, transverse;
  for (int i = 0; i < 200; ++i) {
    const double t = 0.01 * i;
    axis.push_back(3 * std::sin(9 * t) * std::sin(1.57 * t));
    transverse.push_back(3 * std::cos(7 * t) * std::sin(1.57 * t));
  }
  return GroundMotion(axis, 0.01).with_components(transverse);
}

}  // namespace

TEST_CASE("a slider of any law in the plane moves as in its own type", "[planar][any_planar_slider]") {
  const GroundMotion motion = pair();
  const PlanarSlider<Coulomb> own(Coulomb(0.8), Mounting{.natural_frequency = 3, .damping = 0.1});
  const AnyPlanarSlider any = planar(Slider<Coulomb>(own.law(), own.mounting()));
  CHECK(mounting_of(any) == own.mounting());
  CHECK(std::holds_alternative<Slider<Coulomb>>(along_axis(any)));
  const PlanarResponse one = integrate(own, motion), other = integrate(any, motion);
  // The compiler may round the same code differently where it is instantiated.
  CHECK(other.peak == Approx(one.peak).epsilon(1e-9));
  CHECK(norm(other.residual - one.residual) <= 1e-9 * one.peak);

  PlanarState state;
  for (std::size_t i = 0; i < motion.segments(); ++i) {
    const Segment axis = motion.segment(i);
    advance(any,
            PlanarSegment{axis.duration, {axis.start, motion.transverse()[i]}, {axis.end, motion.transverse()[i + 1]}},
            state);
  }
  CHECK(norm(state.displacement - one.residual) <= 1e-9 * one.peak);

  const double times[] = {1.234, one.peak_time};
  const std::vector<PlanarState> states = states_at(any, motion, one, times);
  CHECK(norm(states[0].displacement - states_at(own, motion, one, times)[0].displacement) <= 1e-9 * one.peak);
  CHECK(norm(states[1].displacement) == Approx(one.peak).epsilon(1e-9));
}

TEST_CASE("forces in the plane balance, and their peak is that of continuous time", "[planar][any_planar_slider]") {
  const GroundMotion motion = pair();
  const AnyPlanarSlider slider = planar(Slider<Coulomb>(Coulomb(0.8), Mounting{.natural_frequency = 3}));
  const PlanarResponse response = integrate(slider, motion);
  const PlanarForces found = forces(slider, motion, response);
  REQUIRE(found.friction.size() == response.displacement.size());
  double largest = 0;
  for (std::size_t i = 0; i < found.friction.size(); ++i) {
    largest = std::max(largest, norm(found.total(i)));
    CHECK(found.stuck[i] + 0 <= 1);
    if (found.stuck[i] == 0) CHECK(norm(found.friction[i]) == Approx(0.8).epsilon(1e-12));
    CHECK(norm(found.spring[i] - 9 * response.displacement[i]) <= 1e-12);
  }
  CHECK(found.peak >= largest * (1 - 1e-12));
  CHECK(found.peak <= largest * 1.01);  // between samples 10 ms apart
}

TEST_CASE("sliders that differ between directions are not in the plane", "[planar][any_planar_slider]") {
  CHECK_THROWS_WITH(planar(Slider<Caster>(Caster(0.5, 0.1))),
                    ContainsSubstring("Caster cannot be used") && ContainsSubstring("laws for the plane are Coulomb"));
  CHECK_THROWS_WITH(planar(Slider<Coulomb>(Coulomb(0.5, 0.6))), ContainsSubstring("must have equal levels"));
  CHECK_THROWS_AS(planar(Slider<Coulomb>(Coulomb(0.5), Mounting{.one_way = true})), std::invalid_argument);
  CHECK_THROWS_WITH(planar(Slider<Coulomb>(Coulomb(0.5), Mounting{.stops = Stops(0.1, 0.2, 0.5)})),
                    ContainsSubstring("one gap"));
}
