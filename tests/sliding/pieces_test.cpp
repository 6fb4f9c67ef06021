#include "stickslip/sliding/detail/pieces.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

#include "lanes/instruction_sets.hpp"
#include "stickslip/friction/caster.hpp"
#include "support/catch.hpp"
#include "support/motions.hpp"

using namespace stickslip;
using namespace test;

namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

/// Same events and sums in both, within the round-off of what they are sums of. Displacements of both wander off by
/// some roundings of the scale of x at each sample; sums over many terms likewise, but for the time slid: in a sum of
/// equal terms roundings agree. Times are rounded where they are given, at the end of the record; that of a stop, a
/// root, has ten roundings and what its segment amplifies: 64. Squares of tiny numbers are rounded to the least number.
void check_same(const Response& a, const Response& b, double duration) {
  const double n = static_cast<double>(a.displacement.size()), walk = 20 * epsilon * std::sqrt(n);
  double speed = 0;
  for (const double v : a.velocity) speed = std::max(speed, std::abs(v));
  const double x = walk * a.peak,
               energy = walk * (a.energy.dissipated + speed * speed) + n * std::numeric_limits<double>::denorm_min();
  CHECK(difference(a.displacement, b.displacement) <= x);
  CHECK(difference(a.velocity, b.velocity) <= walk * speed);
  CHECK(std::abs(a.peak - b.peak) <= x);
  CHECK(std::abs(a.residual - b.residual) <= x);
  CHECK(std::abs(a.sliding_distance - b.sliding_distance) <= walk * a.sliding_distance);
  CHECK(std::abs(a.time_sliding - b.time_sliding) <= n * epsilon / 2 * duration);
  CHECK(a.energy.initial == b.energy.initial);
  CHECK(std::abs(a.energy.input - b.energy.input) <= energy);
  CHECK(std::abs(a.energy.dissipated - b.energy.dissipated) <= energy);
  CHECK(std::abs(b.energy.imbalance()) <= energy);
  CHECK(a.state.mode == b.state.mode);

  REQUIRE(a.events.size() == b.events.size());
  std::size_t other_kinds = 0;
  double time = 0, displacement = 0, velocity = 0;
  for (std::size_t i = 0; i < a.events.size(); ++i) {
    other_kinds += a.events[i].kind != b.events[i].kind;
    time = std::max(time, std::abs(a.events[i].time - b.events[i].time));
    displacement = std::max(displacement, std::abs(a.events[i].displacement - b.events[i].displacement));
    velocity = std::max(velocity, std::abs(a.events[i].velocity - b.events[i].velocity));
  }
  CHECK(other_kinds == 0);
  CHECK(time <= 64 * epsilon * duration);
  CHECK(displacement <= x);
  CHECK(velocity <= walk * speed);
}

void check_same(const Coulomb& law, const GroundMotion& motion, const IntegrateOptions& options = {}) {
  check_same(detail::integrate_in_order(Slider(law), motion, options), integrate(law, motion, options),
             motion.duration());
}

}  // namespace

TEST_CASE("a response in pieces is that in one piece, event by event, on every instruction set", "[pieces]") {
  on_each_instruction_set([](const std::string& set) {
    for (const auto& [samples, smooth, interpolation] :
         {std::tuple{8192U, false, Interpolation::linear}, std::tuple{20479U, false, Interpolation::constant},
          std::tuple{33000U, true, Interpolation::linear}, std::tuple{100001U, false, Interpolation::linear}}) {
      const GroundMotion motion = broadband(samples, samples, smooth, interpolation);
      for (const Coulomb& law : {Coulomb(1), Coulomb(1, 1.6), Coulomb(1.5, 0.2), Coulomb(1, infinity)}) {
        INFO(set << ", " << samples << " samples, levels " << law.forward() << ", " << law.backward());
        check_same(law, motion);
      }
    }
  });
}

TEST_CASE("pieces begin from any state and settle", "[pieces]") {
  const GroundMotion motion = broadband(1, 9000);
  const IntegrateOptions options = GENERATE(from(0.3), from(-2, 1.5), from(0, -0.7, true), from(0, 0, true));
  check_same(Coulomb(1), motion, options);
  check_same(Coulomb(0.4, 1.1), motion, options);
}

TEST_CASE("where a block seldom sticks, or never, pieces are done again to their ends", "[pieces]") {
  const GroundMotion motion = broadband(1, 10000);
  check_same(Coulomb(0), motion);
  check_same(Coulomb(1e-9), motion);
  check_same(Coulomb(0.05), motion);
  check_same(Coulomb(0, infinity), motion);
}

TEST_CASE("a block that never slips has no event in pieces but the end", "[pieces]") {
  const Response response = integrate(Coulomb(20), broadband(1, 10000));
  REQUIRE(response.events.size() == 1);
  CHECK(response.events[0].kind == EventKind::end);
  CHECK(response.peak == 0);
  CHECK(response.time_sliding == 0);
  CHECK(response.energy.input == 0);
}

TEST_CASE("in round numbers, where stops fall on samples and loads on levels, pieces have the same events",
          "[pieces]") {
  const auto interpolation = GENERATE(Interpolation::linear, Interpolation::constant);
  // Not with unequal levels, where velocities come to zero in passing: whether they stop is for the last bit to say.
  std::mt19937_64 bits(5);
  std::vector<double> n(10000);
  for (double& value : n) value = static_cast<double>(bits() % 7) - 3;
  for (const Coulomb& law : {Coulomb(1), Coulomb(2), Coulomb(2, infinity), Coulomb(0)})
    for (const double dt : {0.5, 1.0}) {
      INFO("levels " << law.forward() << ", " << law.backward() << ", dt " << dt);
      const GroundMotion motion(n, dt, interpolation);
      check_same(law, motion);
    }
  // A rectangular pulse each way, over and over: Newmark's block stops at a sample each time.
  for (std::size_t i = 0; i < n.size(); ++i) n[i] = std::vector<double>{-3, 1, 1, 0}[i % 4];
  check_same(Coulomb(1), GroundMotion(n, 0.5, interpolation));
  check_same(Coulomb(1, infinity), GroundMotion(n, 0.5, interpolation));
}

TEST_CASE("accelerations whose squares leave the range of doubles are right in pieces", "[pieces]") {
  const double scale = GENERATE(1e-300, 1e-160, 1e-100, 1e90);
  std::vector<double> n = gaussian(1, 9000, 2);
  for (double& value : n) value *= scale;
  check_same(Coulomb(scale), GroundMotion(n, 0.1));
  check_same(Coulomb(scale, 1.6 * scale), GroundMotion(n, 0.1, Interpolation::constant));
}

TEST_CASE("short records, springs, casters, uneven steps and harmonic motions go in order", "[pieces]") {
  const auto same_bits = [](const auto& slider, const auto& motion) {
    const Response a = detail::integrate_in_order(slider, motion), b = integrate(slider, motion);
    return a.displacement == b.displacement && a.velocity == b.velocity && a.events.size() == b.events.size();
  };
  CHECK(same_bits(Slider(Coulomb(1)), broadband(1, 8191)));
  CHECK(same_bits(Slider(Coulomb(1), 2.0), broadband(1, 9000)));
  CHECK(same_bits(Slider(Caster(1, 1)), broadband(1, 300)));
  CHECK(same_bits(Slider(Coulomb(1)), HarmonicMotion(2, 3, 10000, 0.1)));
  std::vector<double> times(9000);
  for (std::size_t i = 0; i < times.size(); ++i) times[i] = 0.1 * static_cast<double>(i) + (i % 2 == 0 ? 0 : 0.03);
  CHECK(same_bits(Slider(Coulomb(1)), GroundMotion(gaussian(1, 9000, 2), times)));
}

TEST_CASE("integrate by pieces refuses what it refuses in order, and can be stopped", "[pieces]") {
  const GroundMotion motion = broadband(1, 9000);
  CHECK_THROWS_AS(integrate(Coulomb(1), motion, from(infinity)), std::invalid_argument);
  CHECK_THROWS_AS(integrate(Coulomb(1, infinity), motion, from(0, -1)), std::invalid_argument);
  CHECK_THROWS_AS(integrate(Coulomb(1), GroundMotion(std::vector<double>(10000, 1e100), 1e103)), std::overflow_error);
  CHECK_THROWS_AS(integrate(Coulomb(1e-90), motion, from(0, 1, true)), ConvergenceError);
  struct Enough {};
  CHECK_THROWS_AS(integrate(Coulomb(1), motion, {.progress = [] { throw Enough(); }}), Enough);
}

TEST_CASE("memory of another response is used again in pieces", "[pieces]") {
  const GroundMotion motion = broadband(1, 9000);
  Response storage = integrate(Coulomb(0.5), broadband(1, 12000));
  const double* const memory = storage.displacement.data();
  const Response response = integrate(Coulomb(1), motion, {}, std::move(storage));
  CHECK(response.displacement.data() == memory);
  check_same(detail::integrate_in_order(Slider(Coulomb(1)), motion), response, motion.duration());
}
