// Distributions: that quantiles invert the probabilities, by the error function of the standard library.
#include "stickslip/statistics/distribution.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "support/catch.hpp"

using namespace stickslip;
using Catch::Matchers::ContainsSubstring;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The probability of a standard normal number below z.
double below(double z) { return std::erfc(-z / std::numbers::sqrt2) / 2; }

const std::vector<double> probabilities = {1e-12, 1e-3, 0.1, 0.25, 0.5, 0.8413, 0.99, 1 - 1e-9};

}  // namespace

TEST_CASE("quantiles invert the probabilities of a lognormal number", "[distribution]") {
  const Lognormal mu(0.3, 0.4);
  for (const double p : probabilities) {
    // z is right to some units in the last place of the probability, or of itself.
    CHECK(below(std::log(mu.quantile(p) / 0.3) / 0.4) == Approx(p).epsilon(1e-13));
  }
  CHECK(mu.quantile(0.5) == 0.3);
  CHECK(Lognormal(0.3, 0).quantile(0.01) == 0.3);
}

TEST_CASE("quantiles invert the probabilities of a normal number between bounds", "[distribution]") {
  const auto check = [](double low, double high) {
    const Normal number(2, 0.5, low, high);
    const double a = (low - 2) / 0.5, b = (high - 2) / 0.5;
    for (const double p : probabilities) {
      INFO("from " << low << " to " << high << ", p = " << p);
      const double x = number.quantile(p), z = (x - 2) / 0.5;
      CHECK((x >= low && x <= high));
      // In an upper tail the probabilities above are the exact ones.
      const double found =
          a > 0 ? (below(-a) - below(-z)) / (below(-a) - below(-b)) : (below(z) - below(a)) / (below(b) - below(a));
      // x is rounded to 1e-15, z then to 2e-15, and in a tail beyond z the probability falls by exp(-z) a unit.
      CHECK(std::abs(found - p) < 1e-13);
    }
  };
  check(-infinity, infinity);
  check(1.5, 2.25);
  check(0, infinity);
  check(6, infinity);    // eight standard deviations above
  check(-infinity, -3);  // ten below
  CHECK(Normal(2, 0.5).quantile(0.5) == 2);
  CHECK(Normal(2, 0, 1, 3).quantile(0.1) == 2);
}

TEST_CASE("quantiles of a uniform number are in proportion", "[distribution]") {
  const Uniform number(2, 6);
  for (const double p : probabilities) CHECK(number.quantile(p) == Approx(2 + 4 * p).epsilon(1e-15));
  CHECK(Uniform(3, 3).quantile(0.7) == 3);
  CHECK(quantile(number, 0.25) == 3);
  CHECK(quantile(7.0, 0.25) == 7);  // a number is always that number
}

TEST_CASE("distributions that do not exist are refused", "[distribution][errors]") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_WITH(Lognormal(0, 1), "Lognormal: median must be positive and finite, got 0");
  CHECK_THROWS_WITH(Lognormal(nan, 1), ContainsSubstring("median must be positive and finite, got nan"));
  CHECK_THROWS_WITH(Lognormal(1, -0.1), "Lognormal: beta must be finite and at least 0, got -0.1");
  CHECK_THROWS_WITH(Normal(infinity, 1), "Normal: mean must be finite, got inf");
  CHECK_THROWS_WITH(Normal(1, -1), "Normal: std must be finite and at least 0, got -1");
  CHECK_THROWS_WITH(Normal(1, 1, 3, 2), "Normal: low must be less than high, 2, got 3");
  CHECK_THROWS_WITH(Normal(1, 1, nan, 2), ContainsSubstring("low must be less than high, 2, got nan"));
  CHECK_THROWS_WITH(Normal(1, 0.01, 2, 3), ContainsSubstring("must leave some probability"));
  CHECK_THROWS_WITH(Normal(1, 0, 2, 3), ContainsSubstring("must leave some probability"));
  CHECK_THROWS_WITH(Uniform(2, 1), "Uniform: high must be finite and at least low, 2, got 1");
  CHECK_THROWS_WITH(Uniform(-infinity, 1), "Uniform: low must be finite, got -inf");
  for (const double p : {0.0, 1.0, -1.0, nan}) {
    CHECK_THROWS_WITH(Lognormal(1, 1).quantile(p), ContainsSubstring("probability must lie between 0 and 1"));
    CHECK_THROWS_WITH(quantile(7.0, p), ContainsSubstring("probability must lie between 0 and 1"));
  }
}
