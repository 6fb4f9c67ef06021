// Random ground motions with a vertical component: reproducible, independent, joined without change, refusals.
//
// The seeds are fixed. Each statistical check says how often a correct program would fail it with a new seed.
#include "stickslip/excitation/with_vertical.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "stickslip/core.hpp"
#include "stickslip/excitation/gaussian.hpp"
#include "stickslip/excitation/poisson.hpp"
#include "support/catch.hpp"
#include "support/motions.hpp"

using namespace stickslip;
using namespace test;
using Catch::Matchers::ContainsSubstring;

namespace {

GaussianExcitation noise(double dt, std::size_t samples, Interpolation interpolation = Interpolation::linear) {
  return {Spectrum::band_pass(0.02, 2, 40), dt, samples, {.interpolation = interpolation}};
}

/// The acceleration between samples, at a time that is none of theirs.
double between(const GroundMotion& motion, std::span<const double> values, double time) {
  std::size_t i = 0;
  while (i + 1 < motion.segments() && motion.time(i + 1) <= time) ++i;
  if (motion.interpolation() == Interpolation::constant) return values[i];
  return values[i] + (values[i + 1] - values[i]) * (time - motion.time(i)) / (motion.time(i + 1) - motion.time(i));
}

/// One motion has the other two as its components: in the middle of each of its segments, to the rounding of a
/// difference of times over the shortest step.
void check_components(const GroundMotion& both, const GroundMotion& horizontal, const GroundMotion& vertical,
                      double ratio) {
  REQUIRE(both.has_vertical());
  CHECK_FALSE(both.has_transverse());
  CHECK(both.duration() == Approx(horizontal.duration()).epsilon(1e-15));
  for (const GroundMotion* one : {&horizontal, &vertical}) {
    std::size_t k = 0;  // each time of the component is one of the motion
    for (std::size_t i = 0; i < one->samples(); ++i) {
      while (k + 1 < both.samples() && both.time(k) < one->time(i) - 1e-13) ++k;
      REQUIRE(std::abs(both.time(k) - one->time(i)) <= 1e-13);
    }
  }
  for (std::size_t i = 0; i < both.segments(); ++i) {
    const double middle = both.time(i) + both.segment(i).duration / 2;
    if (!(both.segment(i).duration > 1e-12)) continue;
    REQUIRE(between(both, both.acceleration(), middle) ==
            Approx(between(horizontal, horizontal.acceleration(), middle)).margin(1e-11));
    REQUIRE(between(both, both.vertical(), middle) ==
            Approx(ratio * between(vertical, vertical.acceleration(), middle)).margin(1e-11));
  }
}

struct Still {  // a vertical acceleration that does not change
  double upward;
  GroundMotion sample(std::uint64_t, std::uint64_t) const {
    return {std::vector<double>(301, upward), 0.02, Interpolation::linear};
  }
  double duration() const { return 6; }
  std::string configuration() const { return detail::shortest(upward); }
};

}  // namespace

TEST_CASE("the components are those of the two excitations, the vertical one times the ratio", "[excitation]") {
  const GaussianExcitation along = noise(0.02, 301), up = noise(0.02, 301);
  const WithVertical both(along, up, 0.6);
  static_assert(Excitation<WithVertical<GaussianExcitation>>);
  for (const std::uint64_t member : {0U, 7U}) {
    const GroundMotion motion = both.sample(5, member), n = along.sample(5, member);
    CHECK(std::ranges::equal(motion.acceleration(), n.acceleration()));  // the same bits
    CHECK(motion.name() == n.name());
    const GroundMotion a_z = up.sample(detail::vertical_seed(5), member);
    for (std::size_t i = 0; i < motion.samples(); ++i) REQUIRE(motion.vertical()[i] == 0.6 * a_z.acceleration()[i]);
    CHECK(both.sample(5, member) == motion);
    CHECK_FALSE(both.sample(6, member) == motion);
  }
  CHECK((both.duration() == along.duration() && both.dt() == 0.02 && both.ratio() == 0.6));
  CHECK(WithVertical(along, 0.6) == both);
  CHECK_FALSE(WithVertical(along, 0.7) == both);
  CHECK(both.configuration() == R"({"excitation": "WithVertical", "horizontal": )" + along.configuration() +
                                    R"(, "vertical": )" + up.configuration() + R"(, "ratio": 0.6})");
}

TEST_CASE("different steps and pulses are joined at the times of both, without change", "[excitation]") {
  for (const auto interpolation : {Interpolation::linear, Interpolation::constant})
    for (const auto& [dt, samples] : {std::pair{0.005, std::size_t{1201}}, {0.01, 601}, {0.03, 201}, {0.04, 151}}) {
      const GaussianExcitation along = noise(0.02, 301, interpolation), up = noise(dt, samples, interpolation);
      const GroundMotion both = WithVertical(along, up, 2).sample(1, 3);
      check_components(both, along.sample(1, 3), up.sample(detail::vertical_seed(1), 3), 2);
      // Times that agree within rounding are merged: `common` of them belong to both components.
      const std::size_t common = 6000 / std::lcm(20U, static_cast<unsigned>(std::lround(dt * 1000)));
      CHECK(both.segments() == 300 + samples - 1 - common);
    }
  const PoissonPulses pulses(3, 0.2, 2, 6), faster(20, 0.05, 3, 6);
  const GroundMotion both = WithVertical(pulses, faster).sample(2, 9);
  CHECK(both.interpolation() == Interpolation::constant);
  check_components(both, pulses.sample(2, 9), faster.sample(detail::vertical_seed(2), 9), 1);
}

TEST_CASE("the vertical component has mean 0, the ratio as V/H, and no correlation", "[excitation][statistics]") {
  // Each bound of 5 standard errors fails once in 1.7 million seeds. One sample of each member: members are
  // independent.
  constexpr std::size_t n = 4000;
  const GaussianExcitation along = noise(0.02, 301);
  const double ratio = 2.0 / 3, variance = along.variance();
  const WithVertical both(along, ratio);
  double mean = 0, square = 0, product = 0, axis = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const GroundMotion motion = both.sample(17, i);
    const double a = motion.acceleration()[100], up = motion.vertical()[100];
    mean += up / n;
    square += up * up / n;
    axis += a * a / n;
    product += a * up / n;
  }
  const double error = 1 / std::sqrt(static_cast<double>(n));
  const double scatter = std::sqrt(2.0) * error;                    // of a variance, of kurtosis at most 3, relative
  CHECK(std::abs(mean) < 5 * ratio * std::sqrt(variance) * error);  // so that the mean of N = g + a_z is g
  CHECK(std::abs(square / (ratio * ratio * variance) - 1) < 5 * scatter);
  CHECK(std::abs(square / axis - ratio * ratio) < 5 * std::sqrt(2.0) * scatter * ratio * ratio);
  CHECK(std::abs(product) < 5 * ratio * variance * error);
}

TEST_CASE("a constant vertical acceleration makes the slider heavier or lighter", "[excitation]") {
  const GaussianExcitation along = noise(0.02, 301);
  const double g = standard_gravity;
  for (const double upward : {0.0, -g / 2, g}) {
    const GroundMotion motion = WithVertical(along, Still{upward}).sample(1, 2);
    const Response r = integrate(Coulomb(0.6), motion);
    const Response same = integrate(Coulomb(0.6 * (1 + upward / g)), along.sample(1, 2));
    CHECK(std::abs(r.peak - same.peak) <= 5e-13 * same.peak);
    CHECK(std::abs(r.residual - same.residual) <= 5e-13 * same.peak);
  }
}

TEST_CASE("components that do not fit are refused", "[excitation][errors]") {
  const GaussianExcitation along = noise(0.02, 301);
  CHECK_THROWS_WITH(WithVertical(along, -0.5), "WithVertical: ratio must be finite and at least 0, got -0.5");
  CHECK_THROWS_WITH(WithVertical(along, not_a_number), ContainsSubstring("ratio must be finite"));
  CHECK_THROWS_WITH(WithVertical(along, noise(0.02, 300)),
                    "WithVertical: the vertical component must last as long as the horizontal one, 6 s, got 5.98 s");
  CHECK_THROWS_WITH(WithVertical(along, PoissonPulses(3, 0.2, 2, 6)).sample(1, 0),
                    ContainsSubstring("both components must be lines between samples or both held values"));
  const WithVertical both(along, 1.0);
  CHECK_THROWS_WITH(WithVertical(both, along).sample(1, 0),
                    ContainsSubstring("the horizontal excitation must make motions without a vertical component"));
  CHECK_THROWS_WITH(WithVertical(along, both).sample(1, 0),
                    ContainsSubstring("the vertical excitation must make motions of one component"));
}

TEST_CASE("a transverse component is kept, also where the times differ", "[excitation]") {
  const GroundMotion along({1, 2, 4}, 0.5), across({3, 7, -1}, 0.5);
  const GroundMotion ground = along.with_components({3, 7, -1});
  for (const GroundMotion& vertical : {GroundMotion({0, 1, 2}, 0.5), GroundMotion({0, 1, 2, 3, 4}, 0.25)}) {
    const GroundMotion all = detail::with_vertical(ground, vertical, 2);
    REQUIRE(all.samples() == vertical.samples());
    for (std::size_t i = 0; i < all.samples(); ++i) {
      const double place = all.time(i) / 0.5;
      const auto k = std::min<std::size_t>(static_cast<std::size_t>(place), 1);
      const auto read = [&](const GroundMotion& motion) {
        return std::lerp(motion.acceleration()[k], motion.acceleration()[k + 1], place - static_cast<double>(k));
      };
      CHECK(all.acceleration()[i] == Approx(read(along)));
      CHECK(all.transverse()[i] == Approx(read(across)));
      CHECK(all.vertical()[i] == Approx(2 * vertical.acceleration()[i]));
    }
  }
}
