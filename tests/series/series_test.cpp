// Power series, order by order: every operator and function a law can be written with.
#include <array>

#include "support/catch.hpp"
#include "support/motions.hpp"

using namespace stickslip;
using namespace test;

namespace {

constexpr int orders = series::highest_order + 1;
using Expansion = std::array<double, orders>;

/// The coefficients of f(x(t)).
template <class Function>
Expansion expand(Function f, std::initializer_list<double> x_coefficients) {
  series::Coefficients x;
  std::size_t given = 0;
  for (int k = 0; k < orders; ++k, ++given) x[k] = given < x_coefficients.size() ? x_coefficients.begin()[given] : 0;
  auto y = f(series::Variable{&x});
  Expansion result;
  for (int k = 0; k < orders; ++k) {
    y.update(k);
    result[static_cast<std::size_t>(k)] = y[k];
  }
  return result;
}

/// Largest error, relative to each coefficient.
double error(const Expansion& found, const Expansion& known) {
  double result = 0;
  for (std::size_t k = 0; k < found.size(); ++k) {
    const double size = std::max(std::abs(known[k]), 1e-300);
    result = std::max(result, std::abs(found[k] - known[k]) / size);
  }
  return result;
}

template <class Rule>
Expansion by_rule(Rule rule) {
  Expansion result;
  for (int k = 0; k < orders; ++k) result[static_cast<std::size_t>(k)] = static_cast<double>(rule(k));
  return result;
}

long double factorial(int n) { return n == 0 ? 1 : n * factorial(n - 1); }

// Euler zigzag numbers over k!: the expansion of sec t + tan t. 2 z_(n+1) = sum of z_k z_(n-k) / (n+1), all positive.
std::array<long double, orders> zigzag() {
  std::array<long double, orders> z{1, 1};
  for (std::size_t n = 1; n + 1 < z.size(); ++n) {
    for (std::size_t k = 0; k <= n; ++k) z[n + 1] += z[k] * z[n - k];
    z[n + 1] /= 2 * static_cast<long double>(n + 1);
  }
  return z;
}

// Each coefficient comes of at most 31 products, whose terms have one sign or a largest one: a few roundings times 31.
constexpr double tight = 1e-14;

}  // namespace

TEST_CASE("exp, sinh, cosh, sin and cos of t have their well-known series", "[series]") {
  const auto reciprocal = [](int k) { return 1 / factorial(k); };
  CHECK(error(expand([](auto x) { return exp(x); }, {0, 1}), by_rule(reciprocal)) <= tight);
  CHECK(error(expand([](auto x) { return cosh(x); }, {0, 1}),
              by_rule([&](int k) { return k % 2 == 0 ? reciprocal(k) : 0; })) <= tight);
  CHECK(error(expand([](auto x) { return sinh(x); }, {0, 1}),
              by_rule([&](int k) { return k % 2 == 1 ? reciprocal(k) : 0; })) <= tight);
  const double signs[] = {1, 1, -1, -1};
  CHECK(error(expand([](auto x) { return cos(x); }, {0, 1}),
              by_rule([&](int k) { return k % 2 == 0 ? signs[k % 4] * reciprocal(k) : 0; })) <= tight);
  CHECK(error(expand([](auto x) { return sin(x); }, {0, 1}),
              by_rule([&](int k) { return k % 2 == 1 ? signs[k % 4] * reciprocal(k) : 0; })) <= tight);
}

TEST_CASE("what decays from one level to another has the series of exp, and no cancellation", "[series]") {
  const auto from = [](double first, double last) { return [=](auto x) { return decaying(x, first, last); }; };
  for (const double first : {0.0, 1e-20, 2.0})
    for (const double last : {0.0, 1e-20, 3.0}) {
      const Expansion found = expand(from(first, last), {0, 1});
      CHECK(error(found, by_rule([&](int k) { return k == 0 ? first : (first - last) / factorial(k); })) <= tight);
    }
  CHECK(decaying(-1e-200, 0, 1) == 1e-200);
  CHECK(std::abs(decaying(-100, 1, 0) / std::exp(-100.0) - 1) <= 1e-15);
  CHECK(decaying(-3, 0.7, 0.7) == 0.7);
}

TEST_CASE("log, powers and roots of 1 + t have the binomial series", "[series]") {
  CHECK(error(expand([](auto x) { return log(x); }, {1, 1}),
              by_rule([](int k) { return k == 0 ? 0.0L : (k % 2 == 1 ? 1.0L : -1.0L) / k; })) <= tight);
  for (const double exponent : {0.5, -2.5, 3.0, -1.0}) {
    const auto binomial = [&](int k) {
      long double result = 1;
      for (int i = 0; i < k; ++i) result *= (exponent - i) / (i + 1);
      return result;
    };
    CHECK(error(expand([&](auto x) { return pow(x, exponent); }, {1, 1}), by_rule(binomial)) <= tight);
    if (exponent == 0.5) {
      CHECK(error(expand([](auto x) { return sqrt(x); }, {1, 1}), by_rule(binomial)) <= tight);
    }
  }
}

TEST_CASE("sech and tanh of t have the Euler and tangent numbers", "[series]") {
  const auto z = zigzag();
  const auto number = [&](int k) { return (k % 4 < 2 ? 1 : -1) * z[static_cast<std::size_t>(k)]; };
  CHECK(error(expand([](auto x) { return sech(x); }, {0, 1}),
              by_rule([&](int k) { return k % 2 == 0 ? number(k) : 0; })) <= tight);
  CHECK(error(expand([](auto x) { return tanh(x); }, {0, 1}),
              by_rule([&](int k) { return k % 2 == 1 ? number(k) : 0; })) <= tight);
  CHECK(error(expand([](auto x) { return sin(x) / cos(x); }, {0, 1}),
              by_rule([&](int k) { return k % 2 == 1 ? z[static_cast<std::size_t>(k)] : 0; })) <= tight);
  CHECK(error(expand([](auto x) { return 1 / cos(x); }, {0, 1}),
              by_rule([&](int k) { return k % 2 == 0 ? z[static_cast<std::size_t>(k)] : 0; })) <= tight);
}

TEST_CASE("the four operations are those of polynomials", "[series]") {
  const auto ones = by_rule([](int) { return 1; });
  CHECK(error(expand([](auto x) { return 1 / x; }, {1, -1}), ones) == 0);
  CHECK(error(expand([](auto x) { return x / (x * x); }, {1, -1}), ones) <= tight);
  CHECK(error(expand([](auto x) { return x * x; }, {1, 2, 3}), by_rule([](int k) {
                return std::array{1, 4, 10, 12, 9}[static_cast<std::size_t>(std::min(k, 4))] * (k < 5);
              })) == 0);
  CHECK(error(expand([](auto x) { return (3 * x - 1) + (2 - x / 4) - (x + 5) * 2 + -x - (1 + x); }, {1, 2, 4}),
              by_rule([](int k) { return k == 0   ? -11.25
                                         : k == 1 ? -2.5
                                         : k == 2 ? -5
                                                  : 0; })) <= tight);
}

TEST_CASE("what undoes itself leaves the series it began with", "[series]") {
  // 1.2 + 0.5 t - 0.25 t^2 + 0.125 t^3 has its zeros beyond |t| = 1, so that an error of one order shrinks in the next
  // ones. Terms of size 1 cancel to nothing: 31 products of 1.1e-16 each.
  const std::initializer_list<double> x = {1.2, 0.5, -0.25, 0.125};
  const Expansion itself = expand([](auto y) { return y * 1.0; }, x);
  const Expansion one = by_rule([](int k) { return k == 0; });
  const auto apart = [](const Expansion& a, const Expansion& b) { return difference(a, b); };
  CHECK(apart(expand([](auto y) { return log(exp(y)); }, x), itself) <= tight);
  CHECK(apart(expand([](auto y) { return exp(log(y)); }, x), itself) <= tight);
  CHECK(apart(expand([](auto y) { return sqrt(y * y); }, x), itself) <= tight);
  CHECK(apart(expand([](auto y) { return pow(pow(y, 3.7), 1 / 3.7); }, x), itself) <= tight);
  CHECK(apart(expand([](auto y) { return sin(y) * sin(y) + cos(y) * cos(y); }, x), one) <= tight);
  CHECK(apart(expand([](auto y) { return cosh(y) * cosh(y) - sinh(y) * sinh(y); }, x), one) <= tight);
  CHECK(apart(expand([](auto y) { return sech(y) * cosh(y); }, x), one) <= tight);
  CHECK(apart(expand([](auto y) { return tanh(y) - sinh(y) / cosh(y); }, x), by_rule([](int) { return 0; })) <= tight);
}

TEST_CASE("a series sums up to its function", "[series]") {
  // x(t) = 0.7 + 0.5 t - 0.25 t^2 at t = 1/8: the series of all of these converge beyond t = 1, so 30 terms leave
  // 8^-30.
  const double t = 0.125;
  const auto sums_up = [&](auto f, double shift) {
    const double x0 = 0.7 + shift;
    const Expansion c = expand(f, {x0, 0.5, -0.25});
    double sum = 0;
    for (std::size_t k = c.size(); k-- > 0;) sum = sum * t + c[k];
    const double direct = f(x0 + t * (0.5 - 0.25 * t));
    CHECK(std::abs(sum - direct) <= 1e-15 * 4 * std::abs(direct) * (1 + std::abs(x0)));
  };
  for (const double shift : {0.0, 3.0, 20.0}) {
    sums_up(
        [](auto x) {
          using std::exp;
          return exp(x);
        },
        shift);
    sums_up(
        [](auto x) {
          using std::log;
          return log(x + 1);
        },
        shift);
    sums_up(
        [](auto x) {
          using std::sqrt;
          return sqrt(x + 1);
        },
        shift);
    sums_up(
        [](auto x) {
          using std::pow;
          return pow(x + 1, -1.7);
        },
        shift);
    sums_up(
        [](auto x) {
          using std::sinh;
          return sinh(x);
        },
        shift);
    sums_up(
        [](auto x) {
          using std::cosh;
          return cosh(x);
        },
        shift);
    sums_up(
        [](auto x) {
          using std::tanh;
          return tanh(x);
        },
        shift);
    sums_up(
        [](auto x) {
          using stickslip::sech;
          return sech(x);
        },
        shift);
    sums_up(
        [](auto x) {
          using std::exp;
          using std::cos;
          return (2 + cos(x)) / (1 + exp(-x * x));
        },
        shift);
  }
  for (const double shift : {-1.4, 0.0, 2.0}) {
    sums_up(
        [](auto x) {
          using std::sin;
          return 2 + sin(x);
        },
        shift);
    sums_up(
        [](auto x) {
          using std::cos;
          return 2 + cos(x);
        },
        shift);
    sums_up(
        [](auto x) {
          using std::tanh;
          return 2 + tanh(x);
        },
        shift);
  }
}

TEST_CASE("sech and tanh stay right far out and close to zero", "[series]") {
  for (const double x0 : {-700.0, -30.0, -1e-9, 1e-300, 1e-9, 0.499999, 0.5, 0.500001, 30.0, 700.0}) {
    const Expansion s = expand([](auto x) { return sech(x); }, {x0, 1}),
                    h = expand([](auto x) { return tanh(x); }, {x0, 1});
    CHECK(std::abs(h[0] - std::tanh(x0)) <= 4e-16 * std::abs(std::tanh(x0)));
    CHECK(std::abs(s[0] * std::cosh(x0) - 1) <= 1e-15 * (1 + std::abs(x0)));
    CHECK(std::abs(s[1] + s[0] * h[0]) <= 4e-16 * s[0]);
    CHECK(std::abs(h[1] - s[0] * s[0]) <= 1e-15 * s[0] * s[0]);
    for (std::size_t k = 2; k < s.size(); ++k) CHECK((std::isfinite(s[k]) && std::isfinite(h[k])));
  }
  CHECK(sech(1e4) == 0);
  CHECK(sech(-1e4) == 0);
  CHECK(sech(infinity) == 0);
  CHECK(sech(0) == 1);
}
