// The wrapper of SUNDIALS: solves problems with closed-form solutions, and reports every error.
#include "numerics/ode.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "stickslip/base/error.hpp"
#include "support/catch.hpp"
#include "support/motions.hpp"

using namespace stickslip;
using namespace test;
using Catch::Matchers::ContainsSubstring;
using detail::OdeMethod;
using detail::OdeOptions;
using detail::solve_ode;

namespace {

void oscillator(double, std::span<const double> y, std::span<double> slope) {
  slope[0] = y[1];
  slope[1] = -y[0];
}

}  // namespace

TEST_CASE("an oscillator returns to where it was, within the tolerance", "[ode]") {
  const std::array<double, 2> start = {1, 0};
  const std::array<double, 4> times = {0, 1, std::numbers::pi, 2 * std::numbers::pi};
  for (const OdeMethod method : {OdeMethod::adams, OdeMethod::bdf, OdeMethod::runge_kutta})
    for (const double tolerance : {1e-6, 1e-9, 1e-12}) {
      const auto y = solve_ode(oscillator, 0, start, times,
                               {.relative_tolerance = tolerance, .absolute_tolerance = {tolerance}, .method = method});
      CAPTURE(static_cast<int>(method), tolerance, y.steps, y.evaluations);
      REQUIRE(y.states.size() == 8);
      // Local errors add up over a hundred steps or so.
      const double close = (method == OdeMethod::bdf ? 300 : 100) * tolerance;
      for (std::size_t i = 0; i < times.size(); ++i) {
        CHECK(std::abs(y.at(i)[0] - std::cos(times[i])) < close);
        CHECK(std::abs(y.at(i)[1] + std::sin(times[i])) < close);
      }
      CHECK(y.steps > 10);
      CHECK(y.evaluations >= y.steps);
    }
}

TEST_CASE("what decays in a millionth of the time asked for takes few steps when called stiff", "[ode]") {
  // y' = -1e6 (y - cos t): after the transient, y = (cos t + 1e-6 sin t) / (1 + 1e-12).
  const auto fast = [](double t, std::span<const double> y, std::span<double> slope) {
    slope[0] = -1e6 * (y[0] - std::cos(t));
  };
  const std::array<double, 1> start = {0}, times = {1};
  const auto y = solve_ode(fast, 0, start, times,
                           {.relative_tolerance = 1e-8, .absolute_tolerance = {1e-8}, .method = OdeMethod::bdf});
  CHECK(y.at(0)[0] == Approx((std::cos(1) + 1e-6 * std::sin(1)) / (1 + 1e-12)).epsilon(1e-7));
  CHECK(y.steps < 1000);
}

TEST_CASE("each component has its own absolute tolerance, whatever its scale", "[ode]") {
  // The oscillator in units of 1e-200 and 1e+200.
  const auto scaled = [](double, std::span<const double> y, std::span<double> slope) {
    slope[0] = 1e-200 * (1e-200 * y[1]);
    slope[1] = -1e200 * (1e200 * y[0]);
  };
  const std::array<double, 2> start = {1e-200, 0};
  const std::array<double, 1> times = {3};
  const auto y = solve_ode(scaled, 0, start, times, {.absolute_tolerance = {1e-210, 1e190}});
  CHECK(y.at(0)[0] == Approx(1e-200 * std::cos(3)).epsilon(1e-8));
  CHECK(y.at(0)[1] == Approx(-1e200 * std::sin(3)).epsilon(1e-8));
}

TEST_CASE("times no further from the start than round-off answer the start", "[ode]") {
  const std::array<double, 2> start = {1, 0};
  const std::array<double, 3> times = {1, std::nextafter(1, 2), 2};
  const auto y = solve_ode(oscillator, 1, start, times, {.absolute_tolerance = {1e-10}});
  REQUIRE(y.states.size() == 6);
  CHECK(y.at(0)[0] == 1);
  CHECK(y.at(1)[0] == 1);
  CHECK(y.at(2)[0] == Approx(std::cos(1)).epsilon(1e-8));
  CHECK(solve_ode(oscillator, 0, start, {}).states.empty());
}

TEST_CASE("between the steps answers are as good as at them", "[ode]") {
  // A thousand times, far closer together than the steps.
  const std::array<double, 2> start = {1, 0};
  std::vector<double> times;
  for (int i = 1; i <= 1000; ++i) times.push_back(0.01 * i);
  for (const OdeMethod method : {OdeMethod::adams, OdeMethod::bdf, OdeMethod::runge_kutta}) {
    const auto y = solve_ode(oscillator, 0, start, times,
                             {.relative_tolerance = 1e-7, .absolute_tolerance = {1e-7}, .method = method});
    CAPTURE(static_cast<int>(method), y.steps);
    CHECK(y.steps < 500);
    double largest = 0;
    for (std::size_t i = 0; i < times.size(); ++i)
      largest = std::max(largest, std::hypot(y.at(i)[0] - std::cos(times[i]), y.at(i)[1] + std::sin(times[i])));
    CHECK(largest < (method == OdeMethod::bdf ? 300 : 100) * 1e-7);
  }
}

TEST_CASE("exceptions from the right side propagate", "[ode]") {
  struct Stop {};
  const std::array<double, 2> start = {1, 0};
  const std::array<double, 1> times = {1e5};
  const auto thrower = [](double t, std::span<const double> y, std::span<double> slope) {
    if (t > 0.5) throw Stop();
    oscillator(t, y, slope);
  };
  for (const OdeMethod method : {OdeMethod::adams, OdeMethod::bdf, OdeMethod::runge_kutta}) {
    OdeOptions options{.absolute_tolerance = {1e-10}, .method = method};
    CHECK_THROWS_AS(solve_ode(thrower, 0, start, times, options), Stop);
    int calls = 0;
    options.progress = [&] {
      if (++calls == 3) throw Stop();
    };
    CHECK_THROWS_AS(solve_ode(oscillator, 0, start, times, options), Stop);
    CHECK(calls == 3);
  }
}

TEST_CASE("a solver that gives up says how far it came", "[ode]") {
  const std::array<double, 1> start = {1}, times = {2};
  // y' = y^2 is 1 / (1 - t): infinite at t = 1.
  const auto explosive = [](double, std::span<const double> y, std::span<double> slope) { slope[0] = y[0] * y[0]; };
  for (const OdeMethod method : {OdeMethod::adams, OdeMethod::bdf, OdeMethod::runge_kutta}) {
    CHECK_THROWS_AS(solve_ode(explosive, 0, start, times, {.method = method}), ConvergenceError);
    CHECK_THROWS_WITH(solve_ode(explosive, 0, start, times, {.method = method}),
                      ContainsSubstring("reached t = 0.99") || ContainsSubstring("reached t = 1"));
  }
  const auto unknown = [](double t, std::span<const double>, std::span<double> slope) {
    slope[0] = t > 1.5 ? not_a_number : 1;
  };
  CHECK_THROWS_WITH(solve_ode(unknown, 0, start, times),
                    ContainsSubstring("reached t = 1.4") || ContainsSubstring("reached t = 1.5"));
  const std::array<double, 2> two = {1, 0};
  const std::array<double, 1> late = {1e9};
  CHECK_THROWS_WITH(solve_ode(oscillator, 0, two, late, {.absolute_tolerance = {1e-10}, .max_steps = 2000}),
                    ContainsSubstring("2000 steps done"));
}

TEST_CASE("invalid arguments are rejected", "[ode]") {
  const std::array<double, 2> start = {1, 0};
  const auto solve = [&](const std::vector<double>& times,
                         const OdeOptions& options = {.absolute_tolerance = {1e-10}}) {
    return solve_ode(oscillator, 0, start, times, options);
  };
  CHECK_THROWS_AS(solve({-1}), std::invalid_argument);
  CHECK_THROWS_AS(solve({1, 1}), std::invalid_argument);
  CHECK_THROWS_AS(solve({not_a_number}), std::invalid_argument);
  CHECK_THROWS_AS(solve({1}, {.absolute_tolerance = {1, 1, 1}}), std::invalid_argument);
  CHECK_THROWS_AS(solve({1}, {.absolute_tolerance = {-1}}), std::invalid_argument);
  CHECK_THROWS_AS(solve({1}, {.absolute_tolerance = {0}}), std::invalid_argument);  // y[1] is 0
  CHECK_THROWS_AS(solve({1}, {.relative_tolerance = 0}), std::invalid_argument);
}
