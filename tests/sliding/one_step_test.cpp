// Segments that are passed in one step move a slider as the event loop does.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <variant>
#include <vector>

#include "stickslip/core.hpp"
#include "support/catch.hpp"
#include "support/motions.hpp"
#include "support/size.hpp"

using namespace stickslip;
using namespace test;

namespace {

using AnyBearing = std::variant<Slider<MultiPendulum>, Slider<Degrading>>;

AnyBearing bearing(std::mt19937_64& bits) {
  const auto draw = [&](double from, double to) { return std::uniform_real_distribution<double>(from, to)(bits); };
  if (bits() % 3 == 0) {
    const double level = draw(0.2, 2), reach = std::exp(draw(-5, 0));
    return Slider(Degrading({0, reach, 2 * reach}, {level, 0.3 * level, 0.6 * level}), draw(1, 30));
  }
  if (bits() % 2 == 0)
    return Slider(MultiPendulum({0.4, 2, 3}, {0.02, draw(0.03, 0.1), draw(0.06, 0.2)}, {0.09, 0.3, 0.3}, 0.3, true));
  std::vector<double> radii, mu, capacities;
  for (std::uint64_t k = 1 + bits() % 5; k > 0; --k) {
    radii.push_back(bits() % 12 == 0 ? infinity : draw(0.01, 3));  // down to half a period in a segment
    mu.push_back(bits() % 3 == 0 ? 0.05 : draw(0.01, 0.1));
    capacities.push_back(bits() % 4 == 0 ? infinity : draw(0.01, 0.3));
  }
  return Slider(MultiPendulum(radii, mu, capacities, 0.2));
}

// With quiet parts, and values that lie exactly on a level at rest.
std::vector<double> ground(std::mt19937_64& bits, std::size_t samples) {
  const bool smooth = bits() % 2 == 0;
  const double strength = std::exp(std::uniform_real_distribution<double>(-2, 2)(bits));
  std::vector<double> n = gaussian(bits(), samples, strength, smooth);
  for (std::size_t i = 0; i < samples; ++i) {
    if (i / 32 % 3 == 0) n[i] /= 50;
    if (bits() % 16 == 0) n[i] = std::copysign(0.05 * standard_gravity, n[i]);
  }
  n[0] = 0;
  return n;
}

}  // namespace

TEST_CASE("a segment passed in one step moves a slider as the event loop does") {
  std::mt19937_64 bits(1);
  std::size_t moved = 0;
  for (int problem = 0; problem < size(2000, 60); ++problem) {
    CAPTURE(problem);
    const AnyBearing any = bearing(bits);
    const double dt = std::ldexp(1.0, -4 - static_cast<int>(bits() % 5));
    const std::vector<double> n = ground(bits, 200);
    std::vector<double> times;
    for (std::size_t i = 0; i < n.size(); ++i) times.push_back(static_cast<double>(i) * dt);
    // Listed times have no usual duration, whose motion would be known.
    const GroundMotion even(n, dt), listed(n, times);
    std::visit(
        [&](const auto& slider) {
          const Response a = integrate(slider, even), b = integrate(slider, listed);
          moved += a.peak > 0;
          const double x = 1e-11 * std::max(b.peak, 1e-3), v = 1e-10 * std::max(b.peak / dt, 1e-3);
          REQUIRE(a.events.size() == b.events.size());
          for (std::size_t k = 0; k < a.events.size(); ++k) REQUIRE(a.events[k].kind == b.events[k].kind);
          double apart = 0, faster = 0;
          for (std::size_t i = 0; i < n.size(); ++i) {
            apart = std::max(apart, std::abs(a.displacement[i] - b.displacement[i]));
            faster = std::max(faster, std::abs(a.velocity[i] - b.velocity[i]));
          }
          CHECK(apart <= x);
          CHECK(faster <= v);
          CHECK(std::abs(a.sliding_distance - b.sliding_distance) <= 1e-11 * b.sliding_distance);
          CHECK(std::abs(a.time_sliding - b.time_sliding) <= 1e-11 * b.time_sliding);
          CHECK(std::abs(a.energy.dissipated - b.energy.dissipated) <= 1e-11 * b.energy.dissipated);
          CHECK(std::abs(a.energy.imbalance()) <= 1e-11 * (b.energy.dissipated + b.energy.impact + 1e-6));
        },
        any);
  }
  CHECK(moved > static_cast<std::size_t>(size(1500, 40)));
}
