// Many blocks: outcomes are those of single runs; critical scales; probabilities.
#include "stickslip/rocking/outcomes.hpp"

#include <cmath>
#include <cstddef>
#include <functional>
#include <numbers>
#include <vector>

#include "stickslip/base/error.hpp"
#include "stickslip/base/units.hpp"
#include "stickslip/rocking/integrate.hpp"
#include "stickslip/statistics/binomial.hpp"
#include "support/catch.hpp"

using namespace stickslip;

namespace {

const SlenderBlock block(2, 0.2, 0.9);

/// One sine of amplitude alpha g, 40 samples a cycle, that first pushes to the right; then stillness.
GroundMotion one_sine() {
  std::vector<double> n;
  for (int k = 0; k < 40; ++k) n.push_back(-0.2 * standard_gravity * std::sin(2 * std::numbers::pi * k / 40));
  n.insert(n.end(), 11, 0.0);
  return {n, 2 * std::numbers::pi / 400};
}

}  // namespace

TEST_CASE("rocking outcomes: critical scales have islands of safety") {
  // Bisection in 40 digits.
  const std::vector<ScaleRange> ranges = critical_scales(block, one_sine(), 8);
  REQUIRE(ranges.size() == 2);
  CHECK(ranges[0].begin == Approx(3.02479929533496626).epsilon(1e-9));
  CHECK(ranges[0].end == Approx(6.33109960422415951).epsilon(1e-9));
  CHECK(ranges[1].begin == Approx(7.18286102916019098).epsilon(1e-9));
  CHECK(ranges[1].end == 8);
  CHECK(critical_scales(block, one_sine(), 3).empty());
  CHECK_THROWS_AS(critical_scales(block, one_sine(), 0), std::invalid_argument);
  CHECK_THROWS_AS(critical_scales(block, one_sine(), 1, 0), std::invalid_argument);
}

TEST_CASE("rocking outcomes: those of single runs, for any number of threads") {
  const SlenderBlock lossless(2, 0.2, 1);
  const GroundMotion motion = one_sine();
  RockingRunOptions options;
  for (const unsigned threads : {1U, 3U}) {
    options.threads = threads;
    const auto outcomes = rocking_outcomes(
        20, [&](std::size_t i) -> const SlenderBlock& { return i == 3 ? lossless : block; },
        [&](std::size_t i, const auto& use) { use(motion.scaled(0.4 * static_cast<double>(i))); }, options);
    REQUIRE(outcomes.size() == 20);
    for (std::size_t i = 0; i < 20; ++i) {
      CAPTURE(i);
      if (i == 3) {
        CHECK(std::isnan(outcomes[i].peak));
        CHECK_THAT(outcomes[i].failure, Catch::Matchers::ContainsSubstring("never comes to rest"));
        continue;
      }
      RockingOptions how;
      how.settle = true;
      const RockingResponse r = integrate(block, motion.scaled(0.4 * static_cast<double>(i)), how);
      CHECK(outcomes[i].peak == r.peak);
      CHECK(outcomes[i].overturned == r.overturned);
      CHECK(outcomes[i].impacts == r.impacts);
      CHECK(outcomes[i].mirrored().overturned == -r.overturned);
    }
  }
}

TEST_CASE("slender block: the peak over alpha is that of the side") {
  const SlenderBlock uneven(2, 0.2, 0.15, 0.8);
  RockingOptions tilted;
  tilted.rotation = 0.1;
  tilted.settle = true;
  const RockingResponse r = integrate(uneven, {{0, 0}, 1.0}, tilted);
  // Half of alpha on the right; on the left the amplitude with 0.64 of that energy: a smaller angle, a larger part of alpha.
  CHECK(r.peak == 0.1);
  CHECK(r.peak_ratio == Approx(1 - std::sqrt(1 - 0.64 * 0.03 / (0.15 * 0.15))).epsilon(1e-12));
}

TEST_CASE("binomial intervals are those of Clopper and Pearson") {
  // scipy.stats.binomtest(7, 100).proportion_ci()
  const Interval seven = binomial_interval(7, 100);
  CHECK(seven.value == Approx(0.07));
  CHECK(seven.low == Approx(0.0286052889).epsilon(1e-8));
  CHECK(seven.high == Approx(0.1389197285).epsilon(1e-8));
  CHECK(binomial_interval(0, 10).low == 0);
  CHECK(binomial_interval(10, 10).high == 1);
  CHECK_THROWS_AS(binomial_interval(2, 1), std::invalid_argument);
  CHECK_THROWS_AS(binomial_interval(1, 2, 1), std::invalid_argument);
}

TEST_CASE("slender block: a motion beyond the range of doubles does not end a batch") {
  const SlenderBlock block(1000, 0.2, 0.9);
  const std::vector<GroundMotion> motions{GroundMotion({0, 1, 0}, 1), GroundMotion({0, 1000, -1000, 0}, 1)};
  const auto outcomes = rocking_outcomes(
      2, [&](std::size_t) -> const SlenderBlock& { return block; },
      [&](std::size_t i, const std::function<void(const GroundMotion&)>& use) { use(motions[i]); });
  CHECK(outcomes[0].failure.empty());
  CHECK(outcomes[0].peak == 0);
  CHECK_THAT(outcomes[1].failure, Catch::Matchers::ContainsSubstring("leaves the range of doubles"));
  CHECK(std::isnan(outcomes[1].peak));
}
