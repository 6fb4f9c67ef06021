// The temperature of a surface on which a slider moves in the plane.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "stickslip/core.hpp"
#include "stickslip/friction/kumar.hpp"
#include "stickslip/planar/margins.hpp"
#include "support/catch.hpp"
#include "support/motions.hpp"

using namespace stickslip;
using namespace test;

namespace {

constexpr double toward_axis = 0.6, toward_transverse = -0.8;

/// Harmonic shaking of 3 m/s^2 along one line.
std::vector<double> shaking(std::size_t samples) {
  std::vector<double> n;
  for (std::size_t i = 0; i < samples; ++i) n.push_back(3 * std::sin(4 * 0.02 * static_cast<double>(i)));
  return n;
}
GroundMotion line(const std::vector<double>& n) {
  std::vector<double> axis, transverse;
  for (const double one : n) axis.push_back(toward_axis * one), transverse.push_back(toward_transverse * one);
  return GroundMotion(axis, 0.02).with_components(transverse, {});
}

Slider<KumarFriction> pendulum() {
  return Slider(
      KumarFriction({.mu_ref = 0.06, .static_pressure = 50e6, .reference_pressure = 50e6, .contact_radius = 0.2}),
      {.natural_frequency = std::sqrt(standard_gravity / 2.2), .pendulum = true});
}

}  // namespace

TEST_CASE("a heated surface in the plane has the temperature on one axis", "[planar]") {
  const std::vector<double> n = shaking(200);
  const Slider<KumarFriction> slider = pendulum();
  const PlanarSlider plane(slider);
  IntegrateOptions warm;
  warm.heat = SurfaceHeat::with(slider.law().half_integral_at(80));
  PlanarIntegrateOptions warm_too;
  warm_too.heat = warm.heat;
  const GroundMotion motion(n, 0.02);
  const Response one = integrate(slider, motion, warm);
  const PlanarResponse both = integrate(plane, line(n), warm_too);
  REQUIRE(both.temperature.size() == both.displacement.size());
  CHECK(both.temperature[0] == Approx(80).epsilon(1e-12));
  CHECK(*std::max_element(both.temperature.begin(), both.temperature.end()) > 100);
  // Both are accurate to 1e-7 of their scale.
  for (std::size_t i = 0; i < n.size(); ++i) {
    CHECK(both.temperature[i] == Approx(one.temperature[i]).epsilon(1e-6));
    CHECK(std::abs(both.displacement[i].axis - toward_axis * one.displacement[i]) <= 1e-6 * one.peak);
  }
  // The heat counts: a cold surface holds more.
  CHECK(integrate(plane, line(n)).peak < 0.999 * both.peak);
  CHECK(integrate(plane, line(n)).temperature[0] == 20);
  CHECK(integrate(PlanarSlider(Coulomb(1.0)), line(n)).temperature.empty());

  SECTION("the motion between samples, forces and margins begin with this heat") {
    const double times[] = {1.111, 3.333};
    const std::vector<PlanarState> states = states_at(plane, line(n), both, times);
    const std::vector<State> on_axis = states_at(slider, motion, one, times);
    for (std::size_t i = 0; i < 2; ++i)
      CHECK(std::abs(states[i].displacement.axis - toward_axis * on_axis[i].displacement) <= 1e-4 * one.peak);
    const PlanarForces found = forces(plane, line(n), both);
    CHECK(found.peak > 0);
    // Shaking under which it rests in between.
    const GroundMotion weak = motion.scaled(0.15), weak_line = line(n).scaled(0.15);
    const Margins on_axis_too = margins(slider, weak, integrate(slider, weak, warm)),
                  in_plane = margins(plane, weak_line, integrate(plane, weak_line, warm_too));
    CHECK(on_axis_too.load < 1);
    CHECK(in_plane.load == Approx(on_axis_too.load).epsilon(1e-5));
  }
}

TEST_CASE("a run in the plane that is continued with its heat is one run", "[planar]") {
  const std::vector<double> n = shaking(160);
  const PlanarSlider slider(pendulum());
  const PlanarResponse whole = integrate(slider, line(n));
  const std::vector<double> first(n.begin(), n.begin() + 81), second(n.begin() + 80, n.end());
  const PlanarResponse one = integrate(slider, line(first));
  PlanarIntegrateOptions then;
  then.displacement = one.state.displacement;
  then.velocity = one.state.velocity;
  then.sliding_distance = one.state.sliding_distance;
  then.heat = one.state.heat;
  const PlanarResponse other = integrate(slider, line(second), then);
  CHECK(norm(other.residual - whole.residual) <= 1e-7 * whole.peak);
  CHECK(other.temperature.back() == Approx(whole.temperature.back()).epsilon(1e-7));
  CHECK(other.temperature.front() == Approx(one.temperature.back()).epsilon(1e-12));
}
