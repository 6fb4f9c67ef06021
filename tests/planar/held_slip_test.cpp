// A slip in the plane under a constant load, against quadrature and itself.
#include "stickslip/planar/detail/held_slip.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

#include "stickslip/planar/integrate.hpp"
#include "support/catch.hpp"
#include "support/motions.hpp"
#include "support/size.hpp"

using namespace stickslip;
using namespace test;

namespace {

using Real = long double;

struct SlipStart {
  double level, load, speed, angle;  // from the load
  double plus() const { return along() < 0 ? across() * across() / (speed - along()) : speed + along(); }
  double minus() const { return along() < 0 ? speed - along() : across() * across() / (speed + along()); }
  double along() const { return speed * std::cos(angle); }
  double across() const { return speed * std::sin(angle); }
  detail::HeldSlip slip() const { return {{1, 0}, level, load, plus(), minus(), across()}; }
};

SlipStart random_start(std::mt19937_64& bits, int i) {
  std::uniform_real_distribution<double> part(0, 1);
  SlipStart s{3 * part(bits), 4 * part(bits), std::pow(10, -2 + 2 * part(bits)), 2 * std::numbers::pi * part(bits)};
  if (i % 5 == 1) s.load = 2 * s.level;  // at which a rate of the motion across the load vanishes
  if (i % 5 == 2) s.load = s.level;
  if (i % 5 == 3) s.load = 0;
  if (i % 5 == 4) s.angle = std::numbers::pi - 1e-3 * part(bits);  // nearly against the load
  return s;
}

/// The integrals over regularized time of u, u v_q, u v_c and u^2, by ten-point Gauss-Legendre quadrature of panels in
/// which no exponential changes by more than e^(1/4): exact to 1e-20 of each.
struct Integrals {
  Real time = 0, along = 0, across = 0, distance = 0;
  Integrals(const SlipStart& s, double until) {
    static constexpr Real nodes[] = {0.1488743389816312108848260011297200L, 0.4333953941292471907992659431657842L,
                                     0.6794095682990244062343273651148736L, 0.8650633666889845107320966884234930L,
                                     0.9739065285171717200779640120844521L};
    static constexpr Real weights[] = {0.2955242247147528701738929946513383L, 0.2692667193099963550912269215694694L,
                                       0.2190863625159820439955349342281632L, 0.1494513491505805931457763396576973L,
                                       0.0666713443086881375935688098933318L};
    const int panels = static_cast<int>(8 * (s.level + s.load) * until) + 1;
    const Real width = static_cast<Real>(until) / panels;
    const Real plus = s.plus(), minus = s.minus(), across_now = s.across(), a = s.level, q = s.load;
    for (int i = 0; i < panels; ++i)
      for (int k = 0; k < 10; ++k) {
        const Real node = k < 5 ? nodes[k] : -nodes[k - 5], tau = width * (i + (1 + node) / 2);
        const Real weight = width / 2 * weights[k % 5];
        const Real p = plus * std::exp(-(a - q) * tau), m = minus * std::exp(-(a + q) * tau), u = (p + m) / 2;
        time += weight * u;
        along += weight * u * (p - m) / 2;
        across += weight * u * across_now * std::exp(-a * tau);
        distance += weight * u * u;
      }
  }
};

}  // namespace

TEST_CASE("a slip under a held load is the integral of its exponentials", "[planar][held]") {
  std::mt19937_64 bits(1);
  std::uniform_real_distribution<double> part(0, 1);
  int stops = 0;
  for (int i = 0; i < size(400, 40); ++i) {
    const SlipStart s = random_start(bits, i);
    const double duration = std::pow(10, -3 + 3 * part(bits));
    INFO("level " << s.level << ", load " << s.load << ", speed " << s.speed << ", angle " << s.angle << " for "
                  << duration);
    const detail::HeldSlip slip = s.slip();
    const double tau = slip.parameter(duration);
    if ((s.level + s.load) * tau > 500) continue;  // a near stop that lasts
    const PlanarProgress at = slip.at(tau);
    if (at.time < duration * (1 - 1e-9)) {
      ++stops;
      // So close to a stop that the rest of the way is e^-28 of it. The time that is left is e^-14 of the whole.
      CHECK(s.load <= s.level);
      CHECK(norm(at.velocity) <= 2e-6 * s.speed);
    } else {
      CHECK(std::abs(at.time - duration) <= 1e-14 * duration);
    }
    // The exponents are rounded: 1e-16 of up to 500.
    const Integrals exact(s, tau);
    CHECK(std::abs(static_cast<double>(at.time - exact.time)) <= 1e-13 * at.time);
    const double path = at.distance;
    CHECK(std::abs(static_cast<double>(path - exact.distance)) <= 1e-13 * path);
    CHECK(std::abs(static_cast<double>(at.way.axis - exact.along)) <= 1e-13 * path);
    CHECK(std::abs(static_cast<double>(at.way.transverse - exact.across)) <= 1e-13 * path);
    // r'' = Q - a r'/u.
    const double u = norm(at.velocity);
    const Vector2 expected = Vector2{s.load, 0} - (s.level / u) * at.velocity;
    CHECK(norm(slip.acceleration(tau) - expected) <= 1e-12 * (s.load + s.level));
  }
  CHECK(stops > 5);
}

TEST_CASE("the largest distance of a slip under a held load is found between its ends", "[planar][held]") {
  std::mt19937_64 bits(2);
  std::uniform_real_distribution<double> part(-2, 2);
  int inside = 0;
  for (int i = 0; i < size(300, 40); ++i) {
    const SlipStart s = random_start(bits, i);
    const detail::HeldSlip slip = s.slip();
    const double tau = slip.parameter(0.3 * (1 + i % 7));
    const double path = slip.at(tau).distance;
    const Vector2 place{path * part(bits), path * part(bits)};
    double where = 0;
    const double largest = slip.largest_radius(place, tau, where);
    CHECK(std::abs(largest - norm(place + slip.at(where).way)) <= 1e-15 * largest);
    const double start = norm(place), end = norm(place + slip.at(tau).way);
    for (int k = 1; k < 200; ++k) {
      const double radius = norm(place + slip.at(tau * k / 200).way);
      if (radius > start) CHECK(radius <= largest * (1 + 1e-15));
    }
    inside += largest > std::max(start, end) * (1 + 1e-9);
  }
  CHECK(inside > size(10, 0));
}

TEST_CASE("under held loads the closed form and power series give the same response", "[planar][held]") {
  // A damper of 1e-200/s changes nothing, but it has no closed form.
  for (std::uint64_t seed = 1; seed <= size(60u, 6u); ++seed) {
    const double strength = seed % 3 == 0 ? 0.1 : 2;
    const GroundMotion ground = GroundMotion(gaussian(seed, 300, 2), 0.02, Interpolation::constant)
                                    .with_components(gaussian(seed + 1000, 300, strength));
    const PlanarResponse one = integrate(PlanarSlider(Coulomb(1)), ground, {.settle = true}),
                         other = integrate(PlanarSlider(Coulomb(1), {.damping = 1e-200}), ground, {.settle = true});
    INFO("seed " << seed);
    const double scale = one.sliding_distance;
    CHECK(std::abs(one.peak - other.peak) <= 1e-12 * scale);
    CHECK(norm(one.residual - other.residual) <= 1e-12 * scale);
    CHECK(std::abs(one.sliding_distance - other.sliding_distance) <= 1e-12 * scale);
    CHECK(std::abs(one.energy.imbalance()) <= 1e-12 * one.energy.dissipated);
    CHECK(one.events.size() == other.events.size());
  }
}
