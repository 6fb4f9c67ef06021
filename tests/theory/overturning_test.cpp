// The probability that a slender block overturns: against simulation, symmetry and limits.
#include "stickslip/theory/overturning.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <random>
#include <stdexcept>
#include <vector>

#include "stickslip/base/error.hpp"
#include "stickslip/base/units.hpp"
#include "stickslip/excitation/gaussian.hpp"
#include "stickslip/rocking/integrate.hpp"
#include "support/catch.hpp"
#include "support/size.hpp"

using namespace stickslip;
using Catch::Matchers::ContainsSubstring;
using std::numbers::pi;
using theory::overturning_probability;
using theory::TwoStateNoise;

namespace {

constexpr double p = 2, alpha = 0.2, unit = alpha * standard_gravity;

/// s0 of white noise that gives v, without units, the variance 2 d a unit of pt.
double white(double d) { return d * unit * unit / (pi * p); }

theory::OverturningOptions within(double tolerance, double ratio = std::numeric_limits<double>::infinity()) {
  return {.tolerance = tolerance, .ratio = ratio};
}

/// Shares of members that were lost by each time, and that exceeded a ratio, under held white noise.
struct Shares {
  std::vector<double> lost, exceeded;
};
Shares simulated(const SlenderBlock& block, double d, double dt, const std::vector<double>& times, double ratio,
                 std::size_t members) {
  std::mt19937_64 random(20261128);
  std::normal_distribution<double> normal;
  const double rms = std::sqrt(2 * pi * white(d) / dt), lost = 5.5 * std::sqrt(d);
  Shares shares{std::vector<double>(times.size()), std::vector<double>(times.size())};
  for (std::size_t m = 0; m < members; ++m) {
    RockingState state;
    bool is_lost = false, exceeds = false;
    std::size_t next = 0;
    for (int k = 1; next < times.size(); ++k) {
      const double n = rms * normal(random);
      if (!is_lost) {
        // The path in parts shows the peak within a step.
        for (int part = 0; part < 8; ++part) {
          advance(block, {dt / 8, n, n}, state);
          const double side = state.rotation < 0 ? -1 : 1;
          const double of_side = side > 0 ? block.alpha_right() : block.alpha_left();
          exceeds = exceeds || side * state.rotation > ratio * alpha;
          is_lost = is_lost || (part == 7 && (side * (state.rotation + state.rate / p) - of_side) / alpha > lost);
        }
      }
      for (; next < times.size() && times[next] < (k + 0.5) * dt; ++next) {
        shares.lost[next] += is_lost ? 1.0 / static_cast<double>(members) : 0;
        shares.exceeded[next] += is_lost || exceeds ? 1.0 / static_cast<double>(members) : 0;
      }
    }
  }
  return shares;
}

}  // namespace

TEST_CASE("the probability of overturning under held noise is that of simulation", "[long]") {
  // Nine comparisons at four standard errors: false alarm in 6e-4 of seeds.
  const SlenderBlock block(p, alpha, 0.85), leaning(p, alpha, 0.8 * alpha, 0.85);
  constexpr double d = 0.05, dt = 0.05, ratio = 0.6;
  GaussianOptions options;
  options.interpolation = Interpolation::constant;
  options.correct_interpolation = false;
  options.zero_frequency = true;
  const TwoStateNoise noise(GaussianExcitation(Spectrum::white(white(d)), dt, 101, options));
  const std::vector<double> times{2.5, 5, 10};
  const std::size_t members = test::size<std::size_t>(4000, 400);
  for (const SlenderBlock& each : {block, leaning}) {
    const Shares shares = simulated(each, d, dt, times, ratio, members);
    const auto lost = overturning_probability(each, noise, times, within(0.05));
    const auto exceeded = overturning_probability(each, noise, times, within(0.05, ratio));
    for (std::size_t i = 0; i < times.size(); ++i) {
      const auto agrees = [&](const Estimate& theory, double share) {
        const double deviation = std::sqrt(theory.value * (1 - theory.value) / static_cast<double>(members));
        CHECK(std::abs(theory.value - share) <= 4 * deviation + theory.error);
      };
      CAPTURE(times[i], each.alpha_left());
      agrees(lost[i], shares.lost[i]);
      if (each == block) agrees(exceeded[i], shares.exceeded[i]);
      CHECK(exceeded[i].value >= lost[i].value);
    }
  }
}

TEST_CASE("the probability of overturning holds for lossy and elastic blocks, in weak and strong noise", "[long]") {
  // Nine comparisons at four standard errors: false alarm in 6e-4 of seeds.
  struct Setting {
    double restitution, deviation;
  };
  for (const auto& [restitution, deviation] : {Setting{0.4, 0.6}, {0.65, 0.35}, {0.95, 0.2}}) {
    const SlenderBlock block(p, alpha, restitution);
    const double d = deviation * deviation, dt = 0.025;
    GaussianOptions options;
    options.interpolation = Interpolation::constant;
    options.correct_interpolation = false;
    options.zero_frequency = true;
    const TwoStateNoise noise(GaussianExcitation(Spectrum::white(white(d)), dt, 101, options));
    const std::vector<double> times{2.5, 10, 20};
    const std::size_t members = test::size<std::size_t>(2000, 200);
    const auto lost = overturning_probability(block, noise, times, within(0.1));
    const Shares shares = simulated(block, d, dt, times, 1, members);
    for (std::size_t i = 0; i < times.size(); ++i) {
      CAPTURE(restitution, deviation, times[i], lost[i].value, shares.lost[i]);
      const double spread = std::sqrt(lost[i].value * (1 - lost[i].value) / static_cast<double>(members));
      CHECK(std::abs(lost[i].value - shares.lost[i]) <= 4 * spread + lost[i].error);
    }
  }
}

TEST_CASE("the probability of overturning under white noise is that of an independent simulation", "[long]") {
  // 40,000 members of a program without this library, held over 0.02: its standard error, and that of the steps.
  const std::vector<double> times{20 / p, 40 / p, 60 / p};
  const auto found = overturning_probability({p, alpha, 0.9}, white(0.02), times, within(0.03));
  constexpr double simulated[] = {0.0173, 0.0834, 0.1517}, error[] = {0.0007, 0.0014, 0.0018};
  for (std::size_t i = 0; i < times.size(); ++i) {
    CHECK(std::abs(found[i].value - simulated[i]) <= 3 * error[i] + found[i].error);
    CHECK(found[i].error <= 0.03 * found[i].value);
  }
}

TEST_CASE("overturning: both half lines of a block with equal sides are one", "[long]") {
  // Sides that differ by a part in 1e9 are carried apart, without the mirror image.
  const std::vector<double> times{2, 4};
  const auto one = overturning_probability({p, alpha, 0.9}, white(0.06), times, within(0.3));
  const auto two = overturning_probability({p, alpha, alpha * (1 - 1e-9), 0.9}, white(0.06), times, within(0.3));
  for (std::size_t i = 0; i < times.size(); ++i) CHECK(two[i].value == Approx(one[i].value).epsilon(1e-6));
  // The mirror image of a block falls as often.
  const auto right = overturning_probability({p, alpha, 0.7 * alpha, 0.9}, white(0.04), times, within(0.3));
  const auto left = overturning_probability({p, 0.7 * alpha, alpha, 0.9}, white(0.04), times, within(0.3));
  for (std::size_t i = 0; i < times.size(); ++i) CHECK(left[i].value == Approx(right[i].value).epsilon(1e-9));
}

TEST_CASE("overturning: scales, order and limits", "[long]") {
  const std::vector<double> times{1, 2, 4};
  const auto base = overturning_probability({p, alpha, 0.9}, white(0.06), times, within(0.3));
  // Twice the alpha and the noise; half the p and twice the time.
  const auto large = overturning_probability({p, 2 * alpha, 0.9}, 4 * white(0.06), times, within(0.3));
  const auto slow =
      overturning_probability({p / 2, alpha, 0.9}, 2 * white(0.06), std::vector<double>{2, 4, 8}, within(0.3));
  const auto lossy = overturning_probability({p, alpha, 0.6}, white(0.06), times, within(0.3));
  for (std::size_t i = 0; i < times.size(); ++i) {
    CHECK(large[i].value == Approx(base[i].value).epsilon(1e-9));
    CHECK(slow[i].value == Approx(base[i].value).epsilon(1e-9));
    CHECK(lossy[i].value < base[i].value);
    if (i > 0) CHECK(base[i].value > base[i - 1].value);
  }
  const auto at_start = overturning_probability({p, alpha, 0.9}, white(0.06), std::vector<double>{0}, within(0.3));
  CHECK(at_start[0].value == 0);
}

TEST_CASE("overturning: what is not covered is refused by its number") {
  const SlenderBlock block(p, alpha, 0.9);
  const std::vector<double> time{1};
  const auto refused = [&](const SlenderBlock& of, const TwoStateNoise& noise, const std::vector<double>& times,
                           const theory::OverturningOptions& options, const char* words) {
    CHECK_THROWS_WITH(overturning_probability(of, noise, times, options), ContainsSubstring(words));
  };
  refused(block, white(0.06), time, within(0.001), "tolerance must be from 0.005 to 0.3, got 0.001");
  refused(block, white(0.06), time, within(0.03, 0), "ratio must be positive, got 0");
  refused(block, white(0.06), {2, 1}, within(0.03), "times must be finite, at least 0 and increasing, got 1 s");
  refused({p, alpha, 0.1}, white(0.06), time, within(0.03), "restitution must be at least 0.2");
  refused({p, alpha, 0.4 * alpha, 0.9}, white(0.06), time, within(0.03), "at most twice the other; the ratio, got 2.");
  refused(block, white(1e-4), time, within(0.03), "overturning is too rare");
  refused(block, white(1.5), time, within(0.03), "overturns at once");
  const auto filter = [](double frequency, double damping) {
    return theory::ShapingFilter::of(Spectrum::kanai_tajimi(0.01, frequency, damping));
  };
  refused(block, filter(200, 0.6), time, within(0.03), "from 0.5 p to 50 p; over p, got 100");
  refused(block, filter(10, 0.05), time, within(0.03), "from 0.1 to 1.5, got 0.05");
}
