#include "stickslip/sliding/histories.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <vector>

#include "stickslip/friction/caster.hpp"
#include "stickslip/sliding/integrate.hpp"
#include "support/catch.hpp"

using namespace stickslip;

namespace {

GroundMotion shaking(std::size_t samples, double deviation, double memory = 0,
                     Interpolation interpolation = Interpolation::linear) {
  std::mt19937_64 generator(samples);
  std::normal_distribution<double> normal(0, deviation * std::sqrt(1 - memory * memory));
  std::vector<double> acceleration(samples);
  double last = 0;
  for (double& n : acceleration) n = last = memory * last + normal(generator);
  return {acceleration, 0.1, interpolation};
}

// Largest difference from `integrate`, over the largest value.
template <class Slider>
double difference(const Slider& slider, const GroundMotion& motion) {
  const Response response = integrate(slider, motion);
  const Histories result = histories(slider, motion);
  REQUIRE(result.displacement.size() == motion.samples());
  REQUIRE(result.velocity.size() == motion.samples());
  double max_x = 0, max_v = 0, scale_x = 1e-300, scale_v = 1e-300;
  for (std::size_t i = 0; i < motion.samples(); ++i) {
    max_x = std::max(max_x, std::abs(result.displacement[i] - response.displacement[i]));
    max_v = std::max(max_v, std::abs(result.velocity[i] - response.velocity[i]));
    scale_x = std::max(scale_x, std::abs(response.displacement[i]));
    scale_v = std::max(scale_v, std::abs(response.velocity[i]));
  }
  return std::max(max_x / scale_x, max_v / scale_v);
}

// Round-off of the displacement adds up over the samples like a random walk, in both: 2^-52 sqrt(samples), with room.
double tolerance(const GroundMotion& motion) {
  return 20 * std::numeric_limits<double>::epsilon() * std::sqrt(static_cast<double>(motion.samples()));
}

}  // namespace

TEST_CASE("a long record in pieces moves as in one piece", "[histories]") {
  const auto interpolation = GENERATE(Interpolation::linear, Interpolation::constant);
  const auto memory = GENERATE(0.0, 0.9);
  for (const std::size_t samples : {8192U, 8193U, 20000U, 20479U}) {
    const GroundMotion motion = shaking(samples, 2, memory, interpolation);
    for (const Coulomb& law : {Coulomb(1), Coulomb(1, 1.6), Coulomb(1, std::numeric_limits<double>::infinity())})
      CHECK(difference(law, motion) < tolerance(motion));
  }
}

TEST_CASE("a record under which the block never sticks is done again to its end", "[histories]") {
  const GroundMotion motion = shaking(10000, 2);
  CHECK(difference(Coulomb(0), motion) < tolerance(motion));
  CHECK(difference(Coulomb(1e-9), motion) < tolerance(motion));
}

TEST_CASE("a record under which the block never slips leaves it at rest", "[histories]") {
  const GroundMotion motion = shaking(10000, 0.1);
  const Histories result = histories(Coulomb(5), motion);
  CHECK(std::ranges::all_of(result.displacement, [](double x) { return x == 0; }));
  CHECK(std::ranges::all_of(result.velocity, [](double v) { return v == 0; }));
}

TEST_CASE("short records, springs, casters and uneven steps give the bits of integrate", "[histories]") {
  CHECK(difference(Coulomb(1), shaking(500, 2)) == 0);
  CHECK(difference(Slider(Coulomb(1), 2.0), shaking(9000, 2)) == 0);
  CHECK(difference(Caster(1, 1), shaking(300, 2)) == 0);
  std::vector<double> times(9000);
  for (std::size_t i = 0; i < times.size(); ++i) times[i] = 0.1 * static_cast<double>(i) + (i % 2 == 0 ? 0 : 0.03);
  const GroundMotion even = shaking(times.size(), 2);
  CHECK(difference(Coulomb(1), GroundMotion({even.acceleration().begin(), even.acceleration().end()}, times)) == 0);
}

TEST_CASE("what leaves the range of doubles is refused", "[histories]") {
  CHECK_THROWS_AS(histories(Coulomb(0), GroundMotion(std::vector<double>(10000, 1e100), 1e103)), std::overflow_error);
}

TEST_CASE("a progress callback can end the work", "[histories]") {
  struct Enough {};
  CHECK_THROWS_AS(histories(Coulomb(1), shaking(1000000, 2), [] { throw Enough(); }), Enough);
  CHECK_THROWS_AS(histories(Slider(Coulomb(1), 1.0), shaking(10000, 2), [] { throw Enough(); }), Enough);
}

TEST_CASE("histories of the smallest motions are those of integrate", "[histories][range]") {
  for (const double scale : {1e-150, 1e-165, 1e-290})
    for (const auto interpolation : {Interpolation::linear, Interpolation::constant}) {
      const GroundMotion motion = shaking(10'000, 1, 0, interpolation).scaled(scale);
      const Response response = integrate(Coulomb(0.5 * scale), motion);
      const Histories result = histories(Coulomb(0.5 * scale), motion);
      double most = 0;
      for (std::size_t i = 0; i < motion.samples(); ++i)
        most = std::max(most, std::abs(result.displacement[i] - response.displacement[i]));
      CHECK(most <= 1e-12 * response.peak);
    }
}

TEST_CASE("single samples too small to be squared move a frictionless block as in integrate", "[histories][range]") {
  std::vector<double> samples;
  while (samples.size() < 10'000) samples.insert(samples.end(), {0x1p-1074, 0x1p-1074, -0x1.7d784p+27, 2, -2});
  const GroundMotion motion(samples, 0.1);
  CHECK(difference(Coulomb(0), motion) < tolerance(motion));
  CHECK(difference(Coulomb(1e-150), motion) < tolerance(motion));
}
