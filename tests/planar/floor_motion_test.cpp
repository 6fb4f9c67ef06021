// The absolute acceleration of a mass in the plane: on one axis, momentum, its chords, impulses, spectra.
#include "stickslip/planar/floor_motion.hpp"

#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "stickslip/ground/processing.hpp"
#include "stickslip/planar/any_planar_slider.hpp"
#include "stickslip/sliding/floor_motion.hpp"
#include "stickslip/sliding/integrate.hpp"
#include "support/catch.hpp"
#include "support/motions.hpp"

using namespace stickslip;
using namespace test;
using Catch::Matchers::ContainsSubstring;

namespace {

constexpr std::size_t samples = 200;

/// Two independent components that rise and fade, and a vertical one if it is positive.
GroundMotion pair(double vertical = 0) {
  std::vector<double> n = gaussian(11, samples, 4), t = gaussian(12, samples, 3), up;
  if (vertical > 0) up = gaussian(13, samples, vertical);
  for (std::size_t i = 0; i < samples; ++i) {
    const double s = static_cast<double>(i) / (samples - 1), envelope = 4 * s * (1 - s);
    n[i] *= envelope, t[i] *= envelope;
    if (vertical > 0) up[i] *= envelope;
  }
  return GroundMotion(std::move(n), 0.02).with_components(std::move(t), std::move(up));
}

/// The integral of the acceleration, and the jumps of the velocity.
Vector2 gained(const PlanarFloorMotion& floor) {
  Vector2 sum;
  for (const PlanarSegment& s : floor.segments) sum += (s.duration / 2) * (s.start + s.end);
  for (const PlanarImpulse& i : floor.impulses) sum += i.velocity;
  return sum;
}
double duration(const PlanarFloorMotion& floor) {
  double sum = 0;
  for (const PlanarSegment& s : floor.segments) sum += s.duration;
  return sum;
}

}  // namespace

TEST_CASE("the momentum of a floor in the plane is that of its motion", "[planar][floor]") {
  // The floor begins at rest with the ground. At the end its velocity is that of the ground and of the slip.
  const std::vector<AnyPlanarSlider> sliders{
      PlanarSlider(Coulomb(1)),
      PlanarSlider(Coulomb(0.5), {.natural_frequency = 3, .damping = 0.4}),
      PlanarSlider(VelocityDependent(0.3, 0.6, 20), {.natural_frequency = 2, .pendulum = true}),
      PlanarSlider(StaticKinetic(Coulomb(0.8), 1.1)),
      PlanarSlider(Degrading({0, 0.2}, {1, 0.5})),
      PlanarSlider(Coulomb(0.3), {.natural_frequency = 3, .stops = {0.02, 0.02, 0.6}}),
      PlanarSlider(
          KumarFriction({.mu_ref = 0.06, .static_pressure = 20e6, .reference_pressure = 20e6, .contact_radius = 0.2}))};
  for (const double vertical : {0.0, 8.0}) {
    const GroundMotion ground = pair(vertical);
    Vector2 before;
    for (std::size_t i = 0; i + 1 < samples; ++i)
      before += 0.01 * Vector2{ground.acceleration()[i] + ground.acceleration()[i + 1],
                               ground.transverse()[i] + ground.transverse()[i + 1]};
    for (std::size_t k = 0; k < sliders.size(); ++k) {
      INFO("slider " << k << ", vertical " << vertical);
      const PlanarResponse r = integrate(sliders[k], ground, {.settle = k != 2});  // which creeps for long
      REQUIRE(r.sliding_distance > 0);
      const double tolerance = 1e-6;
      const PlanarFloorMotion floor = floor_motion(sliders[k], ground, r, tolerance);
      double largest = 0;
      for (const PlanarSegment& s : floor.segments) largest = std::max({largest, norm(s.start), norm(s.end)});
      CHECK(std::abs(duration(floor) - ground.dt() * static_cast<double>(r.displacement.size() - 1)) <= 1e-11);
      CHECK(norm(gained(floor) - before - r.velocity.back()) <= tolerance * largest * duration(floor));
      CHECK((floor.impulses.empty() || mounting_of(sliders[k]).stops || vertical > 0));
      if (mounting_of(sliders[k]).stops) CHECK(!floor.impulses.empty());
    }
  }
}

TEST_CASE("a floor under a load along one line is that of one axis", "[planar][floor]") {
  const GroundMotion along = GroundMotion(gaussian(3, samples, 4), 0.02);
  const GroundMotion ground = along.with_components(std::vector<double>(samples, 0.0));
  const Mounting mounting{.natural_frequency = 2, .damping = 0.1};
  const PlanarSlider plane(Coulomb(1), mounting);
  const Slider axis(Coulomb(1), mounting);
  const FloorMotion one = floor_motion(axis, along, integrate(axis, along));
  const FloorMotion two = floor_motion(plane, ground, integrate(plane, ground)).along(0);
  const FloorMotion across = floor_motion(plane, ground, integrate(plane, ground)).along(90);
  for (const Segment& s : across.segments) REQUIRE((s.start == 0 && s.end == 0));
  const std::vector<double> periods{0.05, 0.2, 1, 4};
  const ResponseSpectrum a = response_spectrum(one.segments, periods), b = response_spectrum(two.segments, periods);
  double peak = 0;
  for (const Segment& s : one.segments) peak = std::max({peak, std::abs(s.start), std::abs(s.end)});
  // Twice the bound of the chords, 12.7e-6 of the largest acceleration at a damping ratio of 5 %.
  for (std::size_t i = 0; i < periods.size(); ++i) CHECK(std::abs(a.values[i] - b.values[i]) <= 2 * 12.7e-6 * peak);
}

TEST_CASE("the chords of a floor in the plane are as close as asked", "[planar][floor][long]") {
  const PlanarSlider slider(Coulomb(0.7), {.natural_frequency = 3});
  const GroundMotion ground = pair();
  const PlanarResponse r = integrate(slider, ground);
  const PlanarForces exact = forces(slider, ground, r);
  for (const double tolerance : {1e-3, 1e-6, 1e-9}) {
    const PlanarFloorMotion floor = floor_motion(slider, ground, r, tolerance);
    double time = 0, worst = 0, largest = 0;
    std::size_t sample = 0;
    for (const PlanarSegment& s : floor.segments) {
      largest = std::max({largest, norm(s.start), norm(s.end)});
      for (; sample < samples && 0.02 * static_cast<double>(sample) < time + s.duration - 1e-9; ++sample) {
        const double part = (0.02 * static_cast<double>(sample) - time) / s.duration;
        if (part < 1e-6) continue;  // at a jump the sample has the value after it
        worst = std::max(worst, norm(s.start + part * (s.end - s.start) - exact.acceleration(sample)));
      }
      time += s.duration;
    }
    CHECK(worst <= tolerance * largest);
  }
}

TEST_CASE("turned components turn the floor", "[planar][floor]") {
  const PlanarSlider slider(Coulomb(0.7));
  const GroundMotion ground = pair(), turned = rotated(ground, 30);
  const std::vector<double> periods{0.1, 0.5, 2};
  const PlanarFloorMotion floor = floor_motion(slider, ground, integrate(slider, ground)),
                          other = floor_motion(slider, turned, integrate(slider, turned));
  for (const double degrees : {0.0, 45.0, 90.0}) {
    const ResponseSpectrum a = response_spectrum(floor.along(30 + degrees).segments, periods),
                           b = response_spectrum(other.along(degrees).segments, periods);
    for (std::size_t i = 0; i < periods.size(); ++i) CHECK(std::abs(a.values[i] - b.values[i]) <= 3e-5 * a.values[i]);
  }
}

TEST_CASE("a floor in the plane refuses what it cannot read", "[planar][floor]") {
  const PlanarSlider slider(Coulomb(0.7));
  const GroundMotion ground = pair();
  PlanarResponse r = integrate(slider, ground);
  CHECK_THROWS_WITH(floor_motion(slider, ground, r, 2), ContainsSubstring("tolerance must be from 1e-10 to 1"));
  r.truncated = true;
  CHECK_THROWS_WITH(floor_motion(slider, ground, r), ContainsSubstring("truncated"));
  r.truncated = false;
  r.displacement.pop_back();
  CHECK_THROWS_WITH(floor_motion(slider, ground, r), ContainsSubstring("200 samples, got 199"));
}
