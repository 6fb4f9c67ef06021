// The forces on carts: against a block in the plane, the gain of velocity, dense sampling, and closed forms.
#include "stickslip/carts/forces.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

#include "stickslip/carts/cart.hpp"
#include "stickslip/carts/integrate.hpp"
#include "stickslip/friction/coulomb.hpp"
#include "stickslip/planar/floor_motion.hpp"
#include "stickslip/planar/forces.hpp"
#include "stickslip/planar/integrate.hpp"
#include "support/catch.hpp"

using namespace stickslip;
using Catch::Matchers::ContainsSubstring;

namespace {

constexpr double g = standard_gravity;

GroundMotion shaking(std::size_t samples, double vertical = 0, Interpolation interpolation = Interpolation::linear) {
  std::vector<double> x, y, up;
  for (std::size_t i = 0; i < samples; ++i) {
    const auto m = static_cast<double>(i);
    x.push_back(2 * std::sin(0.7 * m) + 1.3 * std::cos(1.9 * m + 0.4));
    y.push_back(1.5 * std::sin(0.9 * m + 1.1) + 0.8 * std::cos(2.3 * m));
    up.push_back(vertical * std::cos(0.5 * m + 0.2));
  }
  const GroundMotion motion(std::move(x), 0.1, interpolation);
  return vertical > 0 ? motion.with_components(std::move(y), std::move(up)) : motion.with_components(std::move(y));
}

Cart on_feet(double mu) {
  return Cart({Foot{{0.3, 0.2}, mu}, Foot{{-0.3, 0.2}, mu}, Foot{{-0.3, -0.2}, mu}, Foot{{0.3, -0.2}, mu}}, 0.25);
}

Cart random_cart(std::mt19937_64& bits) {
  std::uniform_real_distribution<double> u(0, 1);
  std::vector<Support> supports;
  for (int i = 0; i < 4; ++i) {
    const Vector2 at{0.6 * u(bits) - 0.3, 0.4 * u(bits) - 0.2};
    const double kind = u(bits), rolling = 0.005 + 0.02 * u(bits);
    if (kind < 0.25)
      supports.push_back(Foot{at, 0.05 + 0.3 * u(bits), 0.25});
    else if (kind < 0.75)
      supports.push_back(SwivelCaster{at, 6.3 * u(bits), 0.3 * u(bits), 0.02 + 0.1 * u(bits), rolling, 0.25});
    else
      supports.push_back(FixedWheel{at, 6.3 * u(bits), 0.5 * u(bits), rolling, 0.25});
  }
  return Cart(std::move(supports), 0.15 + 0.3 * u(bits));
}

CartOptions settling() {
  CartOptions options;
  options.settle = true;
  return options;
}

double seconds(const PlanarFloorMotion& floor) {
  double sum = 0;
  for (const PlanarSegment& part : floor.segments) sum += part.duration;
  return sum;
}

}  // namespace

TEST_CASE("A cart on equal feet feels what a block in the plane feels", "[carts][forces]") {
  constexpr double mu = 0.15;
  const PlanarSlider block(Coulomb(mu * g));
  for (const Interpolation interpolation : {Interpolation::linear, Interpolation::constant})
    for (const double vertical : {0.0, 2.5}) {
      CAPTURE(static_cast<int>(interpolation), vertical);
      const GroundMotion motion = shaking(80, vertical, interpolation);
      const CartResponse r = integrate(on_feet(mu), motion, settling());
      const PlanarResponse expected = integrate(block, motion, {.settle = true});
      const CartForces felt = forces(on_feet(mu), motion, r);
      const PlanarForces known = forces(block, motion, expected);
      REQUIRE(felt.acceleration.size() == r.displacement.size());
      REQUIRE(felt.acceleration.size() == expected.displacement.size());
      double furthest = 0;
      for (std::size_t i = 0; i + 1 < felt.acceleration.size(); ++i)
        furthest = std::max(furthest, norm(felt.acceleration[i] - known.acceleration(i)));
      CHECK(furthest < 1e-6 * g);  // starts of feet are slaved to their force
      CHECK(felt.peak == Approx(known.peak).epsilon(1e-7));
      if (vertical > 0 && interpolation == Interpolation::linear)  // else it is constant in many slips
        CHECK(felt.peak_time == Approx(known.peak_time).margin(1e-3));

      const auto of_cart = response_spectrum(floor_motion(on_feet(mu), motion, r).along(30).segments, {0.05, 0.3, 2});
      const auto of_block = response_spectrum(floor_motion(block, motion, expected).along(30).segments, {0.05, 0.3, 2});
      for (std::size_t k = 0; k < 3; ++k) CHECK(of_cart.values[k] == Approx(of_block.values[k]).epsilon(2e-5));
    }
}

TEST_CASE("The acceleration of a cart integrates to its velocity and displacement", "[carts][forces]") {
  std::mt19937_64 bits(20261129);
  for (int n = 0; n < 20; ++n) {
    CAPTURE(n);
    const Cart cart = random_cart(bits);
    const GroundMotion motion =
        shaking(60, n % 3 == 0 ? 2.5 : 0, n % 2 == 0 ? Interpolation::linear : Interpolation::constant);
    CartOptions options;
    options.velocity = {n % 4 == 1 ? 0.3 : 0, n % 4 == 2 ? -0.2 : 0};
    const CartResponse r = integrate(cart, motion, options);
    constexpr double tolerance = 1e-8;
    const PlanarFloorMotion floor = floor_motion(cart, motion, r, tolerance);
    const double largest = forces(cart, motion, r).peak, end = motion.time(motion.samples() - 1);
    CHECK(floor.impulses.empty());
    CHECK(seconds(floor) == Approx(end).epsilon(1e-12));

    Vector2 velocity = options.velocity, way{};  // absolute
    double peak = 0;
    for (const PlanarSegment& part : floor.segments) {
      way += part.duration * (velocity + (part.duration / 6) * (2 * part.start + part.end));
      velocity += (part.duration / 2) * (part.start + part.end);
      peak = std::max({peak, norm(part.start), norm(part.end)});
    }
    Vector2 ground{}, moved{};
    for (std::size_t i = 0; i < motion.segments(); ++i) {
      const Segment x = motion.segment(i);
      const bool held = motion.interpolation() == Interpolation::constant;
      const Vector2 from{x.start, motion.transverse()[i]}, to{x.end, motion.transverse()[held ? i : i + 1]};
      moved += x.duration * (ground + (x.duration / 6) * (2 * from + to));
      ground += (x.duration / 2) * (from + to);
    }
    // Chords differ from the curve by less than the tolerance; a foot that begins to slide gains velocity along its
    // force but for the square of an angle up to 1e-3.
    CHECK(norm(velocity - (r.state.velocity + ground)) < (tolerance * largest + 2e-7) * end);
    CHECK(norm(way - (r.residual + moved)) < (tolerance * largest + 2e-7) * end * end);
    CHECK(peak <= largest * (1 + 1e-9));
    CHECK(peak == Approx(largest).epsilon(1e-6));
  }
}

TEST_CASE("A cart that rests has the acceleration of the ground, one that rolls freely none", "[carts][forces]") {
  const GroundMotion motion = shaking(40);
  const Cart heavy = on_feet(10);
  const CartForces held = forces(heavy, motion, integrate(heavy, motion));
  for (std::size_t i = 0; i < motion.samples(); ++i) {
    CHECK(held.acceleration[i].axis == motion.acceleration()[i]);
    CHECK(held.acceleration[i].transverse == motion.transverse()[i]);
  }
  // Wheels along the axis, which never scrub.
  const Cart rolling({FixedWheel{{0.3, 0}, 0, 10, 0}, FixedWheel{{-0.3, 0}, 0, 10, 0}}, 0.25);
  const CartForces free = forces(rolling, motion, integrate(rolling, motion));
  for (std::size_t i = 0; i < motion.samples(); ++i) {
    CHECK(std::abs(free.acceleration[i].axis) < 1e-12);
    CHECK(free.acceleration[i].transverse == Approx(motion.transverse()[i]).margin(1e-12));
  }
}

TEST_CASE("Floor motions of carts refuse what has none", "[carts][forces]") {
  const GroundMotion motion = shaking(40);
  const Cart cart = on_feet(0.1);
  CartResponse r = integrate(cart, motion);
  CHECK_THROWS_WITH(floor_motion(cart, motion, r, 0), ContainsSubstring("tolerance must be from 1e-10 to 1, got 0"));
  CHECK_THROWS_WITH(floor_motion(cart, shaking(50), r), ContainsSubstring("the motion of 50 samples, got 40"));
  r.truncated = true;
  CHECK_THROWS_WITH(floor_motion(cart, motion, r), ContainsSubstring("truncated"));
}

TEST_CASE("A step that ends where a wheel sticks shows no force beyond it", "[carts][forces]") {
  const GroundMotion motion = GroundMotion({-0.14013136992241282, -0.49152668715506564, 0.08260536086704671},
                                           {0.12232587576201269, 0.15520732487292574, 0.33033574341965166})
                                  .with_components({-0.0852877211421451, -0.5322927213156374, 0.5117371654728808},
                                                   {-1.167855950788736, 1.0574554234645541, -1.8596205959550685});
  const Cart cart({Foot{{0.3798336092307709, -0.25690854784278816}, 0.1},
                   SwivelCaster::with_locked_wheel({-0.3798336092307709, 0.25690854784278816}, 0, 0.5, 0.03)},
                  0.2687780375356007);
  const CartForces felt = forces(cart, motion, integrate(cart, motion));
  CHECK(felt.peak == Approx(0.7194).margin(1e-3));  // from differences of the velocity
}

TEST_CASE("The peak of a truncated response is that of the whole motion", "[carts][forces]") {
  const auto caster = [](Vector2 at, double heading) {
    return SwivelCaster::from_geometry(at, heading, 0.3, 0.03, 0.02, 0.005);
  };
  const Cart cart({caster({-0.38, -0.32}, -0.5), caster({0.38, 0.32}, -2.7)}, 0.11);
  const GroundMotion motion = GroundMotion({-3.5, 4.2, -3.2, 8.4}, 0.1).with_components({-2.5, 7.5, 2.5, 4.5});
  const CartResponse r = integrate(cart, motion, settling());
  REQUIRE(r.truncated);
  const CartForces felt = forces(cart, motion, r);
  CHECK(felt.acceleration.size() == r.displacement.size());
  constexpr double h = 1e-5;
  const std::vector<double> around{felt.peak_time - h, felt.peak_time, felt.peak_time + h};
  const std::vector<CartState> at = states_at(cart, motion, r, around);
  const double before = norm(at[1].velocity - at[0].velocity) / h, after = norm(at[2].velocity - at[1].velocity) / h;
  CHECK(felt.peak == Approx(std::max(before, after)).epsilon(1e-3));
  CHECK(felt.peak > 0.47);  // some 0.46 up to the last sample
  CHECK(felt.peak_time > motion.time(r.displacement.size() - 1));
  CHECK(felt.peak_time <= r.events.back().time);
}

TEST_CASE("The time of the peak is within the response, and infinite forces are refused", "[carts][forces]") {
  const Cart wheels({FixedWheel{{0.3, 0}, 0, 0.5, 0.4}, FixedWheel{{-0.3, 0}, 0, 0.5, 0.4}}, 0.3);
  CartOptions fast;
  fast.velocity = {50, 0};
  for (const double dt : {0.1, 0.01, 0.02, 0.3})
    for (std::size_t samples = 2; samples < 20; ++samples) {
      std::vector<double> up;
      for (std::size_t i = 0; i < samples; ++i) up.push_back(static_cast<double>(i));
      const GroundMotion motion =
          GroundMotion(std::vector<double>(samples), dt).with_components(std::vector<double>(samples), std::move(up));
      const CartResponse r = integrate(wheels, motion, fast);
      CHECK(forces(wheels, motion, r).peak_time <= r.events.back().time);
    }
  const GroundMotion instant = GroundMotion({0, 1e3, 0}, 1e-300).with_components({0, 1e3, 0});
  const Cart free({FixedWheel{{0.3, 0}, 0.3, 0.1, 0.01}, FixedWheel{{-0.3, 0}, -0.2, 0.1, 0.01}}, 0.3);
  CHECK_THROWS_WITH(forces(free, instant, integrate(free, instant)), ContainsSubstring("range of doubles"));
}
