// Zeros within a bracket, and where a condition begins to hold.
#include "stickslip/numerics/root.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include "support/catch.hpp"

using stickslip::numerics::first_where;
using stickslip::numerics::root;

namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

}  // namespace

TEST_CASE("bisection finds the first number at which a condition holds, to the last bit", "[root]") {
  CHECK(first_where(1, 2, [](double x) { return x * x >= 2; }) == std::numbers::sqrt2);  // rounded up
  CHECK(first_where(0, 1, [](double x) { return x >= 1e-300; }) == 1e-300);
  CHECK(first_where(-3, 5, [](double x) { return x >= 0.1; }) == 0.1);
  CHECK(first_where(0, 1, [](double) { return false; }) == 1);
  CHECK(first_where(0, 1, [](double) { return true; }) == std::numeric_limits<double>::denorm_min());
  CHECK(first_where(1, 1, [](double) { return true; }) == 1);
}

TEST_CASE("a zero within a bracket is found to round-off, from either side", "[root]") {
  int calls = 0;
  const auto zero = [&](auto&& f, double a, double b, double tolerance = 0) {
    calls = 0;
    const auto counted = [&](double x) {
      ++calls;
      return f(x);
    };
    const double found = root(counted, a, f(a), b, f(b), tolerance);
    CHECK(found == root(f, a, f(a), b, f(b), tolerance));
    return found;
  };
  const auto square = [](double x) { return x * x - 2; };
  // Two roundings of the zero, and that of the value, eps / 4 of it, over the slope of 2.8.
  CHECK(std::abs(zero(square, 0, 2) - std::numbers::sqrt2) <= 4 * epsilon);
  CHECK(calls <= 12);
  CHECK(std::abs(zero(square, -2, 0) + std::numbers::sqrt2) <= 4 * epsilon);
  CHECK(std::abs(zero([](double x) { return std::cos(x); }, 3, 0) - std::numbers::pi / 2) <= 4 * epsilon);
  // Flat and steep ones, where bisection must help.
  CHECK(std::abs(zero([](double x) { return std::pow(x - 0.3, 9); }, 0, 1) - 0.3) < 1e-15);
  CHECK(std::abs(zero([](double x) { return std::exp(60 * x) - 2; }, -1, 1) - std::log(2.0) / 60) < 1e-16);
  CHECK(calls <= 60);
  // A jump has no zero; it is bracketed.
  CHECK(std::abs(zero([](double x) { return x < 0.7 ? -1.0 : 1.0; }, 0, 1) - 0.7) <= 2 * epsilon);
  // With a tolerance it may end earlier, also where the zero is at 0.
  CHECK(std::abs(zero([](double x) { return std::expm1(x); }, -1, 2, 1e-6)) < 1e-6);
  CHECK(calls <= 10);
}
