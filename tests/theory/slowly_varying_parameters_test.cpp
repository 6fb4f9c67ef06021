// Slowly varying parameters: the coefficients, every branch and its stability, and the final states of transients.
#include "stickslip/theory/slowly_varying_parameters.hpp"

#include <cmath>
#include <numbers>
#include <random>

#include "stickslip/friction/caster.hpp"
#include "stickslip/friction/coulomb.hpp"
#include "stickslip/harmonic/orbits.hpp"
#include "support/catch.hpp"
#include "support/motions.hpp"
#include "support/reference.hpp"

using namespace stickslip;
using namespace test;
using Catch::Matchers::ContainsSubstring;
using std::numbers::pi;
using Theory = theory::SlowlyVaryingParameters;

namespace {

constexpr double round_off = std::numeric_limits<double>::epsilon();
const double half = std::sqrt(0.5);  // natural frequency of wn^2 = 0.5 (rad/s)^2

double relative(double value, double expected) { return std::abs(value - expected) / std::abs(expected); }

// ---- user-defined laws, which do not state their work

struct OwnCaster {
  double slip_level, reach;
  template <class T>
  auto resist(const T& x, Direction) const {
    return slip_level * sech(x / reach);
  }
};

struct Patch {
  double slip_level, reach;
  template <class T>
  auto resist(const T& x, Direction) const {
    using std::exp;
    return slip_level * exp(-(x / reach) * (x / reach));
  }
};

/// a sgn(x') + k x, all of it called friction: Coulomb friction with a spring of k.
struct CoulombWithSpring {
  double slip_level, k;
  template <class T>
  auto resist(const T& x, Direction direction) const {
    return slip_level + sign(direction) * k * x;
  }
};

/// Ripples on a floor that gets smoother outwards: curves of many folds.
struct Ripples {
  double slip_level, reach;
  template <class T>
  auto resist(const T& x, Direction) const {
    using std::cos;
    return slip_level * sech(x / (20 * reach)) * (1 + 0.9 * cos(x / reach));
  }
};

struct Lopsided {
  template <class T>
  auto resist(const T& x, Direction direction) const {
    using std::exp;
    return 1 + (direction == Direction::forward ? 0.1 : 0.0) * x * x * exp(-x * x);
  }
};

// The error of an amplitude: some roundings of B^2 over the slope of (2.16), 2 A times the determinant (2.19).
double allowed(double B, const reference::Value& s) {
  return round_off * (8 + 8 * B * B / (s["amplitude"] * s["amplitude"] * std::abs(s["determinant"])));
}

void check_solutions(const Theory& svp, double B, double omega, const std::vector<reference::Value>& expected) {
  INFO("B = " << B << ", omega = " << omega);
  const auto found = svp.response(B, omega);
  REQUIRE(found.size() == expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    CHECK(relative(found[i].amplitude, expected[i]["amplitude"]) <= allowed(B, expected[i]));
    CHECK(relative(found[i].amplitude, expected[i]["amplitude"]) <= 1e-12);
    CHECK(std::abs(found[i].phase / pi - expected[i]["phase_over_pi"]) <= 1e-14);  // its last digit
    CHECK(found[i].stable == expected[i]["stable"].as<bool>());
  }
}

}  // namespace

// ---- S and C

TEST_CASE("S and C are what quadrature in 30 digits says", "[svp]") {
  for (const auto& r : reference::rows("slowly_varying_parameters", "dissipations")) {
    INFO("A = " << r["amplitude"] << ", reach " << r["reach"]);
    const Theory svp = r["reach"] > 0 ? Theory(Slider(Caster(1, r["reach"]), 0.7)) : Theory(Slider(Coulomb(1), 0.7));
    CHECK(relative(svp.dissipative(r["amplitude"]), r["s"]) <= 1e-15);
    CHECK(std::abs(svp.dissipative_slope(r["amplitude"]) - r["slope"]) <= 1e-14 * r["slope"]);
    CHECK(svp.in_phase(r["amplitude"]) == 0.7 * 0.7 * r["amplitude"]);
    CHECK(svp.in_phase_slope(r["amplitude"]) == 0.7 * 0.7);
  }
}

TEST_CASE("S of a caster and its derivative keep their digits however far the amplitude is from the reach", "[svp]") {
  // S': the difference of mean and last level is at worst 1/25 of either, of some four roundings.
  for (const auto& r : reference::rows("slowly_varying_parameters", "caster_means"))
    for (const double reach : {1e-20, 0.003, 1.0, 7e5}) {
      INFO("y = " << r["y"] << ", reach " << reach);
      const Theory svp(Caster(2.5, reach));
      const double y_rounding = std::abs(r["y"] * reach / reach - r["y"]) / r["y"] * 3;
      CHECK(relative(svp.dissipative(r["y"] * reach), -4 / pi * 2.5 * r["mean"]) <= 2e-15 + y_rounding);
      CHECK(relative(svp.dissipative_slope(r["y"] * reach), -4 / pi * 2.5 / reach * r["y"] * r["slope"]) <=
            3e-14 + y_rounding);
    }
  const Theory svp(Caster(1, 1));
  // gd(18), values.json svp.pitfall.arcsin_tanh: arcsin(tanh y) is wrong by 6.6e-10 there.
  CHECK(relative(-svp.dissipative(18) * 18 * pi / 4, 1.570796296334937129806067) <= 1e-15);
  CHECK(svp.dissipative(0) == Approx(-4 / pi).epsilon(1e-15));
  CHECK(svp.dissipative_slope(0) == 0);
}

TEST_CASE("a caster of infinite reach is Coulomb friction, and one of far reach all but is", "[svp]") {
  const Theory coulomb(Slider(Coulomb(2), 1.5)), infinite(Slider(Caster(2, infinity), 1.5)),
      far(Slider(Caster(2, 1e9), 1.5));
  for (const double amplitude : {0.0, 1e-9, 0.3, 40.0, 1e300}) {
    CHECK(infinite.dissipative(amplitude) == coulomb.dissipative(amplitude));
    CHECK(infinite.dissipative_slope(amplitude) == 0);
  }
  CHECK(coulomb.dissipative(0.3) == Approx(-8 / pi).epsilon(1e-15));
  for (const double omega : {0.4, 1.4, 3.0}) {
    REQUIRE(infinite.response(5, omega).size() == 1);
    REQUIRE(far.response(5, omega).size() == 1);
    CHECK(infinite.response(5, omega)[0].amplitude == coulomb.response(5, omega)[0].amplitude);
    // (A / reach)^2 is below 1e-16
    CHECK(relative(far.response(5, omega)[0].amplitude, coulomb.response(5, omega)[0].amplitude) <= 1e-14);
  }
}

TEST_CASE("rolling resistance of a caster is Coulomb friction beside its own", "[svp]") {
  // S is linear in the level. The sum of two numbers known to 1e-15 or so of themselves.
  for (const double reach : {0.5, infinity})
    for (const double amplitude : {1e-6, 0.01, 0.12, 0.13, 2.0, 1e3}) {
      const auto S = [&](const auto& law) { return Theory(Slider(law)).dissipative(amplitude); };
      const double sum = S(Caster(1, reach)) + S(Coulomb(0.3)), whole = S(Caster(1, reach, 0.3));
      CHECK(std::abs(whole - sum) <= 4e-15 * std::abs(sum));
    }
  // On a spring in resonance, it limits a motion that a caster without it does not limit.
  const Slider plain(Caster(1, 0.5), 2), rolling(Caster(1, 0.5, 0.3), 2);
  CHECK(std::isfinite(Theory(plain).min_amplitude(0.3)));
  CHECK(std::isinf(Theory(rolling).min_amplitude(0.3)));  // B < 4 rolling / pi
  CHECK(Theory(rolling).response(0.3, 2).empty());
  const Theory svp(rolling);
  for (const double omega : {0.5, 1.7, 2.0, 3.0})
    for (const theory::HarmonicSolution& solution : svp.response(1.9, omega)) {
      const double s = svp.dissipative(solution.amplitude), c = (4 - omega * omega) * solution.amplitude;
      CHECK(std::abs(std::hypot(s, c) - 1.9) <= 1e-12);  // (2.16)
    }
}

TEST_CASE("a law that does not know its work is integrated to the same", "[svp]") {
  // Quadrature is asked for 1e-10; the derivative is a difference of which 1/25 at least is left.
  const Theory known(Caster(1.5, 0.2)), own(OwnCaster{1.5, 0.2});
  for (const double y : {1e-12, 1e-3, 0.1, 0.3, 0.36, 0.5, 1.0, 3.0, 30.0, 1e4, 1e9}) {
    INFO("y = " << y);
    CHECK(relative(own.dissipative(0.2 * y), known.dissipative(0.2 * y)) <= 1e-10);
    CHECK(relative(own.dissipative_slope(0.2 * y), known.dissipative_slope(0.2 * y)) <= 25 * 2e-10);
    CHECK(own.in_phase(0.2 * y) == 0);
  }
  // int_0^y exp(-s^2) ds / y = sqrt(pi) / 2 erf(y) / y
  const Theory patch(Patch{2, 0.3});
  for (const double y : {1e-5, 0.2, 1.0, 10.0, 1e8}) {
    INFO("y = " << y);
    CHECK(relative(patch.dissipative(0.3 * y), -4 / pi * 2 * std::sqrt(pi) / 2 * std::erf(y) / y) <= 1e-10);
  }
}

TEST_CASE("friction that pushes in phase with the displacement counts as a spring", "[svp]") {
  const double wn = 0.8, k = 0.49;
  const Theory apart(Slider(Coulomb(1.2), std::sqrt(wn * wn + k))), together(Slider(CoulombWithSpring{1.2, k}, wn));
  for (const double a : {1e-6, 0.01, 0.5, 2.0, 300.0}) {
    INFO("A = " << a);
    CHECK(together.in_phase(a) == Approx(apart.in_phase(a)).epsilon(1e-9));
    CHECK(together.in_phase_slope(a) == Approx(apart.in_phase_slope(a)).epsilon(1e-9));
    CHECK(together.dissipative(a) == Approx(apart.dissipative(a)).epsilon(1e-9));
    CHECK(together.frequency(2, a).upper == Approx(apart.frequency(2, a).upper).epsilon(1e-9));
    const auto boundary = together.stability_boundary(a);
    CHECK(boundary.lower == Approx(apart.stability_boundary(a).lower).epsilon(1e-4));  // a difference of equals
    CHECK(boundary.upper == Approx(apart.stability_boundary(a).upper).epsilon(1e-4));
  }
  for (const double omega : {0.3, 0.9, 1.3, 4.0}) {
    INFO("omega = " << omega);
    const auto expected = apart.response(2, omega), found = together.response(2, omega);
    REQUIRE(found.size() == 1);
    CHECK(found[0].amplitude == Approx(expected[0].amplitude).epsilon(1e-8));
    CHECK(found[0].phase == Approx(expected[0].phase).epsilon(1e-8));
    CHECK(found[0].stable);
  }
}

TEST_CASE("friction takes energy, so the first condition of stability always holds", "[svp]") {
  // S' + S/A = -(levels at +-A, both ways) / (pi A)
  for (const Theory& svp : {Theory(Coulomb(1)), Theory(Caster(1, 0.5)), Theory(Ripples{1, 0.5})})
    for (double a = 1e-6; a < 50; a *= 1.7) {
      const double secant = svp.dissipative(a) / a;
      CHECK(svp.dissipative_slope(a) + secant <= -1e-9 * secant);  // of two that may cancel, by quadrature
    }
}

// ---- Coulomb friction

TEST_CASE("Coulomb friction answers at every frequency once B exceeds 4 a / pi, and is stable", "[svp]") {
  // A^2 is the difference of B^2 and (4a/pi)^2, of a rounding each, over the stiffness.
  const Theory free(Coulomb(1)), spring(Slider(Coulomb(1), half));
  for (const auto& r : reference::rows("slowly_varying_parameters", "coulomb")) {
    INFO("B = " << r["B"] << ", omega = " << r["omega"]);
    const double rounding = 1e-15 * (1 + r["B"] * r["B"] / (r["B"] * r["B"] - 16 / pi / pi));
    const auto check = [&](const Theory& svp, double amplitude, double phase) {
      const auto found = svp.response(r["B"], r["omega"]);
      REQUIRE(found.size() == 1);
      CHECK(relative(found[0].amplitude, amplitude) <= rounding);
      CHECK(std::abs(found[0].phase - phase) <= 8e-15);
      CHECK(found[0].stable);
      CHECK_FALSE(svp.rests(r["B"]));
    };
    check(free, r["amplitude"], r["phase"]);
    check(spring, r["amplitude_spring"], r["phase_spring"]);
    CHECK(free.min_amplitude(r["B"]) == 0);
  }
  for (const double B : {0.1, 1.0, 1.27}) {
    CHECK(free.response(B, 1).empty());
    CHECK(spring.response(B, half).empty());
    CHECK(std::isnan(free.frequency(B, 1).upper));
    CHECK(free.rests(B));
    CHECK(free.min_amplitude(B) == infinity);
  }
}

TEST_CASE("the amplitude of Coulomb friction is that of the ground less the friction's first harmonic", "[svp]") {
  // (2.24); and the ratio to the exact amplitude sqrt(B^2 - (pi a/2)^2) / omega^2: values.json harm.coulomb.b*
  const Theory svp(Coulomb(1));
  for (const auto& [B, ratio] : {std::pair{2.0, 1.2458629882}, {4.0, 1.03079342282}, {8.0, 1.00685305301}}) {
    const double amplitude = svp.response(B, 0.5).at(0).amplitude;
    CHECK(amplitude == Approx(4 * std::sqrt(B * B - 16 / pi / pi)).epsilon(1e-14));
    CHECK(amplitude / (4 * std::sqrt(B * B - pi * pi / 4)) == Approx(ratio).epsilon(1e-10));
  }
  CHECK(svp.response(1e6, 2)[0].amplitude == Approx(1e6 / 4).epsilon(1e-12));
}

TEST_CASE("the lower branch of Coulomb friction on a spring begins at frequency zero", "[svp]") {
  const Theory svp(Slider(Coulomb(1), half));
  for (const auto& r : reference::rows("slowly_varying_parameters", "coulomb_branch_starts")) {
    INFO("B = " << r["B"]);
    CHECK(std::isnan(svp.frequency(r["B"], r["amplitude"] * (1 - 1e-13)).lower));
    CHECK(svp.frequency(r["B"], r["amplitude"] * (1 + 1e-13)).lower <= 1e-6);  // sqrt(1e-13 wn^2)
    CHECK(svp.frequency(r["B"], r["amplitude"]).upper == Approx(1).epsilon(1e-14));
    const auto [lower, upper] = svp.stability_boundary(r["amplitude"]);
    CHECK(lower == upper);  // nothing between
  }
}

TEST_CASE("a spring makes the response larger exactly above wn / sqrt(2)", "[svp]") {
  const Theory free(Coulomb(1)), spring(Slider(Coulomb(1), 1.3)), free_caster(Caster(1, 0.5)),
      caster(Slider(Caster(1, 0.5), 1.3));
  for (const double omega : {0.2, 0.6, 0.91, 0.93, 1.2, 1.31, 2.0, 9.0}) {
    INFO("omega = " << omega);
    const bool above = omega > 1.3 / std::sqrt(2.0);
    CHECK((spring.response(3, omega)[0].amplitude > free.response(3, omega)[0].amplitude) == above);
    CHECK((caster.response(3, omega)[0].amplitude > free_caster.response(3, omega)[0].amplitude) == above);
  }
}

// ---- casters

TEST_CASE("a caster has the solutions found with 40 digits, with and without a spring", "[svp]") {
  const Theory free(Caster(1, 1)), spring(Slider(Caster(1, 1), half));
  for (const auto& r : reference::rows("slowly_varying_parameters", "casters")) {
    check_solutions(free, r["B"], r["omega"], r["free"].items());
    check_solutions(spring, r["B"], r["omega"], r["spring"].items());
  }
}

TEST_CASE("solutions keep their digits where B is next to 4 a / pi", "[svp]") {
  const Theory svp(Caster(1, 1));
  for (const auto& r : reference::rows("slowly_varying_parameters", "small")) {
    INFO("B = " << r["B"] << ", omega = " << r["omega"]);
    const auto found = svp.response(r["B"], r["omega"]);
    REQUIRE(!found.empty());
    CHECK(relative(found[0].amplitude, r["amplitude"]) <= 4e-15);  // a few roundings of each term of (2.16)
    CHECK(std::abs(found[0].phase / pi - r["phase_over_pi"]) <= 1e-15);
    CHECK(found[0].stable == r["stable"].as<bool>());
    CHECK(relative(svp.frequency(r["B"], r["amplitude"]).upper, r["omega"]) <= 4e-15);
  }
}

TEST_CASE("a curve of the caster folds where its frequency is highest", "[svp]") {
  const Theory svp(Caster(1, 1));
  // values.json svp.caster.fold.b1.0
  const double least = 1.360590103585858371543901, amplitude = 2.207428623391956413395823,
               omega = 0.5326142189713826773184624;
  CHECK(relative(svp.min_amplitude(1), least) <= 1e-15);
  CHECK(relative(svp.frequency(1, amplitude).upper, omega) <= 1e-15);
  CHECK(relative(svp.stability_boundary(amplitude).upper, omega) <= 1e-15);
  CHECK(svp.stability_boundary(amplitude).lower == 0);

  CHECK(svp.response(1, omega * (1 + 1e-14)).empty());
  for (const double off : {1e-14, 1e-10, 1e-6, 1e-2}) {  // A differs from the fold's by as much as sqrt(off)
    INFO(off);
    const auto found = svp.response(1, omega * (1 - off));
    REQUIRE(found.size() == 2);
    CHECK(found[0].amplitude < amplitude);
    CHECK(found[1].amplitude > amplitude);
    CHECK_FALSE(found[0].stable);
    CHECK(found[1].stable);
    CHECK(found[1].amplitude - found[0].amplitude <= 8 * std::sqrt(off) * amplitude);
  }
}

TEST_CASE("next to a fold a caster has two solutions, one or none, and says so without fail", "[svp]") {
  // For every b < 4/pi: walk over the fold by single doubles.
  const Theory svp(Slider(Caster(1, 1), half));
  for (const double B : {1e-3, 0.3, 0.9, 1.2, 1.27, 1.2732}) {
    INFO("B = " << B);
    double low = half, high = 3;  // the fold above resonance, by bisection on the number of solutions
    while (std::nextafter(low, high) < high && high - low > 1e-15) {
      const double middle = low + (high - low) / 2;
      (svp.response(B, middle).empty() ? high : low) = middle;
    }
    double omega = high;
    for (int i = 0; i < 50; ++i) omega = std::nextafter(omega, 10.0);
    for (int i = 0; i < 100; ++i, omega = std::nextafter(omega, 0.0)) {
      const auto found = svp.response(B, omega);
      CHECK(found.size() <= 2);
      for (const auto& s : found) CHECK(relative(svp.frequency(B, s.amplitude).upper, omega) <= 1e-13);
    }
  }
}

TEST_CASE("a caster has one solution above 4 a / pi; below, two or none, and at resonance the unstable one", "[svp]") {
  const double a = 1.7, reach = 0.4, wn = 2.2;
  const Theory free(Caster(a, reach)), spring(Slider(Caster(a, reach), wn));
  for (const double b : {0.01, 0.5, 1.0, 1.27, 1.28, 2.0, 30.0})
    for (const double omega : {0.01, 0.3, 1.0, 1.9, 2.1, 2.199, 2.201, 2.3, 2.6, 4.0, 100.0}) {
      INFO("b = " << b << ", omega = " << omega);
      // The largest |omega^2 - wn^2| of the curve, by a fine grid.
      double most = 0;
      for (double amplitude = 1e-4; amplitude < 1e3; amplitude *= 1.001) {
        const double f = free.frequency(b * a, amplitude).upper;
        if (f * f > most) most = f * f;
      }
      for (const auto& [svp, frequency] : {std::pair{&free, 0.0}, {&spring, wn}}) {
        const double distance = std::abs(omega * omega - frequency * frequency);
        const std::size_t expected = b > 4 / pi ? 1 : distance < most ? 2 : 0;
        const auto found = svp->response(b * a, omega);
        CHECK(found.size() == expected);
        if (expected == 2) {
          CHECK_FALSE(found[0].stable);
          CHECK(found[0].amplitude >= svp->min_amplitude(b * a));
        }
        if (expected > 0) CHECK(found.back().stable);
      }
    }
  const auto resonant = spring.response(a, wn);
  REQUIRE(resonant.size() == 1);
  CHECK(relative(resonant[0].amplitude, spring.min_amplitude(a)) <= 1e-14);
  CHECK_FALSE(resonant[0].stable);
  CHECK(resonant[0].phase == -pi / 2);
  CHECK(spring.response(2 * a, wn).empty());
}

TEST_CASE("the branches of a caster on a spring begin and end where 40 digits say", "[svp]") {
  const Theory svp(Slider(Caster(1, 1), half));
  for (const auto& r : reference::rows("slowly_varying_parameters", "caster_branches")) {
    INFO("B = " << r["B"]);
    CHECK(std::abs(svp.min_amplitude(r["B"]) - r["least"]) <=
          1e-15 * r["least"] * (1 + r["B"] / std::abs(4 / pi - r["B"])));
    if (r["least"] > 0) {
      CHECK(std::isnan(svp.frequency(r["B"], r["least"] * (1 - 1e-13)).upper));
      CHECK(svp.frequency(r["B"], r["least"] * (1 + 1e-13)).upper == Approx(half).epsilon(1e-5));
      CHECK(svp.frequency(r["B"], r["least"] * (1 + 1e-13)).lower == Approx(half).epsilon(1e-5));
    }
    bool real = r["least"] > 0;  // from the least amplitude on, then by turns
    for (const double end : r["ends"].list()) {
      CHECK(std::isnan(svp.frequency(r["B"], end * (1 - 1e-12)).lower) != real);
      CHECK(std::isnan(svp.frequency(r["B"], end * (1 + 1e-12)).lower) == real);
      CHECK(svp.frequency(r["B"], end).upper == Approx(1).epsilon(1e-14));  // wn^2 + R = 2 wn^2
      real = !real;
    }
    CHECK(real);
    for (double y = std::max<double>(r["least"], 1e-3) * 1.001; y < 1e4; y *= 1.3)
      CHECK(svp.frequency(r["B"], y).upper >= half);
  }
}

TEST_CASE("solutions are unstable inside the locus of vertical tangencies", "[svp]") {
  const Theory free(Caster(1, 1)), spring(Slider(Caster(1, 1), half));
  const double start = 0.8573827581049917128557100;  // values.json svp.caster.locus_at_A0, thesis (2.42)
  CHECK(relative(free.stability_boundary(1e-9).upper, start) <= 1e-15);
  CHECK(relative(Theory(Caster(9, 0.25)).stability_boundary(1e-9).upper, 6 * start) <= 1e-15);
  for (double y = 0.01; y < 100; y *= 1.1) {
    INFO("y = " << y);
    const double locus = free.stability_boundary(y).upper;
    // Through each of its points goes a curve, B^2 = S^2 + omega^4 A^2, whose highest frequency is there: on both sides
    // omega falls by the same, the square of the distance. B^2 - S^2 is small for small y, and has B's rounding.
    const double s = free.dissipative(y), B = std::hypot(s, locus * locus * y), h = 0.01;
    const double rounding = 4 * round_off * B * B / std::pow(locus * locus * y, 2);
    CHECK(B < 4 / pi);
    CHECK(relative(free.frequency(B, y).upper, locus) <= rounding);
    const double left = locus - free.frequency(B, y * (1 - h)).upper,
                 right = locus - free.frequency(B, y * (1 + h)).upper;
    if (y > 0.3) {
      CHECK(left > 0);
      CHECK(right == Approx(left).epsilon(0.1));
    }

    const auto [lower, upper] = spring.stability_boundary(y);
    CHECK(upper * upper == Approx(0.5 + locus * locus).epsilon(1e-13));
    CHECK(lower == Approx(std::sqrt(std::max(0.5 - locus * locus, 0.0))).margin(1e-7).epsilon(1e-12));
  }
  for (const double B : {0.4, 1.0, 1.25})
    for (const double omega : {0.2, 0.5, 0.6, 0.72, 0.8, 1.0})
      for (const auto& s : spring.response(B, omega)) {
        const auto [lower, upper] = spring.stability_boundary(s.amplitude);
        CHECK(s.stable == (omega < lower || omega > upper));
      }
}

TEST_CASE("the least amplitude is where friction's first harmonic is B", "[svp]") {
  const Theory svp(Caster(2, 0.3)), own(OwnCaster{2, 0.3});
  for (const double b : {1e-12, 1e-3, 0.5, 1.0, 1.27, 1.27323}) {
    INFO("b = " << b);
    const double least = svp.min_amplitude(2 * b);
    CHECK(relative(-svp.dissipative(least), 2 * b) <= 1e-15);
    if (b >= 1e-3) CHECK(relative(own.min_amplitude(2 * b), least) <= 2e-10 * (1 + b / (4 / pi - b)));
  }
  CHECK(own.min_amplitude(2e-12) == infinity);  // beyond the 1e12 reaches that are searched
  CHECK(svp.min_amplitude(2 * 1.2733) == 0);
  CHECK(svp.min_amplitude(1e9) == 0);
  // (2.37) from far out is y = 2 a / B of all the work pi a reach there is
  CHECK(svp.min_amplitude(1e-6) == Approx(2 * 2 * 0.3 / 1e-6).epsilon(1e-12));
}

// ---- properties of all solutions

TEST_CASE("response and frequency are each other's inverse", "[svp]") {
  std::mt19937_64 bits(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto power = [&](double decades) { return std::pow(10, decades * uniform(bits)); };
  for (int i = 0; i < 2000; ++i) {
    const double a = power(2), reach = power(2), B = a * power(1), omega = std::sqrt(a / reach) * power(1);
    const double wn = i % 2 == 0 ? 0 : omega * power(0.3);
    INFO("a " << a << ", reach " << reach << ", wn " << wn << ", B " << B << ", omega " << omega);
    for (const Theory& svp : {Theory(Slider(Coulomb(a), wn)), Theory(Slider(Caster(a, reach), wn))})
      for (const auto& s : svp.response(B, omega)) {
        // A is known to a rounding, and to those of B^2 over the distance to (4a/pi)^2; and so is omega^2 - wn^2.
        const auto [lower, upper] = svp.frequency(B, s.amplitude);
        const double squared = svp.dissipative(s.amplitude) * svp.dissipative(s.amplitude);
        const double error = 1e-15 * (10 + 10 * B * B / std::abs(B * B - squared)) * (1 + wn * wn / omega / omega);
        CHECK(relative(omega < wn ? lower : upper, omega) <= error);
        // and the phase is that of (2.14), (2.15)
        CHECK(std::abs(B * std::sin(s.phase) - svp.dissipative(s.amplitude)) <= 1e-10 * B);
        CHECK(std::abs(B * std::cos(s.phase) - svp.in_phase(s.amplitude) + omega * omega * s.amplitude) <= 1e-10 * B);
      }
  }
}

TEST_CASE("the caster slides between Coulomb friction and the ground", "[svp]") {
  // (2.34), with a spring too
  for (const double wn : {0.0, 0.9})
    for (const double B : {1.3, 2.0, 5.0})
      for (const double omega : {0.1, 0.5, 0.8, 1.0, 2.0, 7.0}) {
        const Slider<Coulomb> coulomb(Coulomb(1), wn);
        const Slider<Caster> caster(Caster(1, 0.6), wn);
        const double least = Theory(coulomb).response(B, omega).at(0).amplitude;
        const double most = B / std::abs(omega * omega - wn * wn);
        const double amplitude = Theory(caster).response(B, omega).back().amplitude;
        INFO("B " << B << ", omega " << omega << ", wn " << wn);
        CHECK(amplitude >= least * (1 - 1e-15));
        CHECK(amplitude <= most * (1 + 1e-15));
      }
}

TEST_CASE("units do not matter", "[svp]") {
  // Lengths and times in other units, powers of two: the same to the last bits.
  const double length = 0x1p-7, time = 0x1p5, speed = length / time, acceleration = speed / time;
  const Theory svp(Slider(Caster(1.3, 0.7), 1.1)), scaled(Slider(Caster(1.3 * acceleration, 0.7 * length), 1.1 / time));
  const Theory own(Slider(Patch{1.3, 0.7}, 1.1)),
      own_scaled(Slider(Patch{1.3 * acceleration, 0.7 * length}, 1.1 / time));
  for (const double B : {0.5, 1.5, 3.0})
    for (const double omega : {0.3, 1.0, 1.2, 2.5})
      for (const auto& [one, other] : {std::pair{&svp, &scaled}, {&own, &own_scaled}}) {
        const auto found = one->response(B, omega), again = other->response(B * acceleration, omega / time);
        REQUIRE(found.size() == again.size());
        for (std::size_t i = 0; i < found.size(); ++i) {
          CHECK(relative(again[i].amplitude, found[i].amplitude * length) <= 1e-9);
          CHECK(again[i].phase == Approx(found[i].phase).epsilon(1e-9));
          CHECK(again[i].stable == found[i].stable);
        }
      }
}

TEST_CASE("without friction the mass swings with B / |omega^2 - wn^2|", "[svp]") {
  for (const Theory& svp : {Theory(Slider(Coulomb(0), 2)), Theory(Slider(Caster(0, 0.5), 2))}) {
    for (const double omega : {0.1, 1.9, 2.1, 30.0}) {
      const auto found = svp.response(3, omega);
      REQUIRE(found.size() == 1);
      CHECK(found[0].amplitude == Approx(3 / std::abs(omega * omega - 4)).epsilon(1e-13));
      CHECK(found[0].phase == (omega < 2 ? 0 : -pi));
      CHECK(found[0].stable);
    }
    CHECK(svp.response(3, 2).empty());
    CHECK_FALSE(svp.rests(1e-300));
    CHECK(svp.min_amplitude(1e-300) == 0);
  }
}

TEST_CASE("a law of one's own gets every solution, however its curves fold", "[svp]") {
  const Theory ripples(Slider(Ripples{1, 0.05}, 1));
  std::size_t most = 0;
  for (const double B : {0.3, 0.9, 1.2, 2.0})
    for (const double omega : {0.2, 0.9, 1.05, 1.3, 2.0, 4.0}) {
      INFO("B = " << B << ", omega = " << omega);
      // Changes of sign on a grid of which the law's ripples are 30 steps.
      const auto balance = [&](double a) {
        const double s = ripples.dissipative(a), e = ripples.in_phase(a) - omega * omega * a;
        return s * s + e * e - B * B;
      };
      std::vector<double> expected;
      const double top = B / std::abs(omega * omega - 1) * 1.001, step = 0.01;
      double last = balance(1e-9);
      for (double a = 1e-9; a < top; a += step) {
        const double next = balance(a + step);
        if ((last > 0) != (next > 0)) expected.push_back(a);
        last = next;
      }
      const auto found = ripples.response(B, omega);
      REQUIRE(found.size() == expected.size());
      bool up = balance(1e-9) < 0;
      for (std::size_t i = 0; i < found.size(); ++i, up = !up) {
        CHECK(found[i].amplitude >= expected[i] - 1e-9);
        CHECK(found[i].amplitude <= expected[i] + step + 1e-9);
        CHECK(found[i].stable == up);
        CHECK(std::abs(balance(found[i].amplitude)) <= 1e-8 * B * B);
      }
      most = std::max(most, found.size());
    }
  CHECK(most >= 3);
}

// ---- transients

TEST_CASE("without friction amplitude and phase turn about the response", "[svp]") {
  // p + i r = z0 + (p0 + i r0 - z0) exp(i (wn^2 - omega^2) t / (2 omega)), z0 = B / (wn^2 - omega^2)
  const double B = 2, omega = 1.5, stiffness = 1 - omega * omega;
  const Theory svp(Slider(Coulomb(0), 1));
  std::vector<double> times;
  for (int i = 0; i <= 40; ++i) times.push_back(2.5 * i);
  const auto found = svp.transient(B, omega, 0.7, 0.4, times);
  for (std::size_t i = 0; i < times.size(); ++i) {
    const double turned = stiffness * times[i] / (2 * omega), center = B / stiffness;
    const double p0 = 0.7 * std::cos(0.4) - center, r0 = 0.7 * std::sin(0.4);
    const double p = center + p0 * std::cos(turned) - r0 * std::sin(turned);
    const double r = p0 * std::sin(turned) + r0 * std::cos(turned);
    // local errors of 1e-10, some ten a unit of time
    CHECK(std::abs(found.amplitude[i] * std::cos(found.phase[i]) - p) <= 1e-7);
    CHECK(std::abs(found.amplitude[i] * std::sin(found.phase[i]) - r) <= 1e-7);
  }
}

TEST_CASE("at resonance the amplitude grows in proportion to time", "[svp]") {
  // dA/dt = (B - 4 a / pi) / (2 omega), not as the square root: ERRATA to the text after (2.48); simulated, the slope
  // is (1.3 - 4/pi) pi a cycle at omega = 1.
  const Theory svp(Slider(Coulomb(1), 1));
  const std::vector<double> times{0, 1, 10, 100, 1000, 10'000};
  const auto found = svp.transient(1.3, 1, 0, 0, times);
  for (std::size_t i = 0; i < times.size(); ++i) {
    CHECK(found.amplitude[i] == Approx((1.3 - 4 / pi) / 2 * times[i]).epsilon(1e-9));
    CHECK((i == 0 ? std::isnan(found.phase[i]) : std::abs(found.phase[i] + pi / 2) <= 1e-9));
  }
  CHECK(svp.settles_on(1.3, 1, 0, 0).amplitude == infinity);
  CHECK(svp.settles_on(1.2, 1, 5, 1).amplitude == 0);
}

TEST_CASE("a motion that B cannot keep up comes to rest, in a time that is known", "[svp]") {
  // Far off resonance the force has no effect: dA/dt = -4 a / (2 pi omega) until A = 0.
  const Theory svp(Coulomb(1));
  const double stops = 2 * pi * 3 / 4 * 0.01;
  const std::vector<double> times{0, stops / 2, stops * 0.99, stops * 1.01, 100 * stops};
  const auto found = svp.transient(1e-6, 3, 0.01, 1, times);
  CHECK(found.amplitude[1] == Approx(0.005).epsilon(1e-5));
  CHECK(found.amplitude[2] == Approx(0.0001).epsilon(1e-3));
  CHECK(found.amplitude[3] == 0);
  CHECK(found.amplitude[4] == 0);
  CHECK(std::isnan(found.phase[4]));
}

TEST_CASE("transients end on the stable solution that settles_on names", "[svp]") {
  const Theory svp(Caster(1, 1));
  const double B = 1.25, omega = 0.75;
  const auto solutions = svp.response(B, omega);
  REQUIRE(solutions.size() == 2);
  const std::vector<double> late{500};
  int rests = 0, moves = 0;
  for (double amplitude = 0; amplitude < 6; amplitude += 0.45)
    for (double phase = -3; phase < 3; phase += 0.9) {
      INFO("from " << amplitude << ", " << phase);
      const auto end = svp.settles_on(B, omega, amplitude, phase);
      const auto reached = svp.transient(B, omega, amplitude, phase, late);
      if (end.amplitude == 0) {
        CHECK(reached.amplitude[0] == 0);
        ++rests;
      } else {
        CHECK(end.amplitude == solutions[1].amplitude);
        CHECK(reached.amplitude[0] == Approx(solutions[1].amplitude).epsilon(1e-6));
        CHECK(reached.phase[0] == Approx(solutions[1].phase).epsilon(1e-6));
        ++moves;
      }
    }
  CHECK(rests > 10);
  CHECK(moves > 10);
}

TEST_CASE("from below the unstable solution a caster comes to rest, from above it goes to the stable one", "[svp]") {
  const Theory svp(Caster(1, 1));
  for (const double omega : {0.2, 0.3, 0.5}) {  // far out it turns for ages: friction is exp(-y)
    INFO("omega = " << omega);
    const auto solutions = svp.response(1, omega);
    const auto from = [&](double factor) {
      return svp.settles_on(1, omega, factor * solutions[0].amplitude, solutions[0].phase).amplitude;
    };
    CHECK(from(0.99) == 0);
    CHECK(from(1.01) == solutions[1].amplitude);
    CHECK(svp.settles_on(1, omega, 0, 0).amplitude == 0);
    CHECK(svp.settles_on(1, omega, solutions[1].amplitude, solutions[1].phase).amplitude == solutions[1].amplitude);
    CHECK(svp.settles_on(1, omega, 1.1 * solutions[1].amplitude, solutions[1].phase).amplitude ==
          solutions[1].amplitude);
  }
  // Started larger still, it turns about the stable solution so widely that it passes the center, where friction is.
  const auto wide = svp.response(1, 0.5)[1];
  CHECK(svp.settles_on(1, 0.5, 1.5 * wide.amplitude, wide.phase).amplitude == 0);
  // On a spring at resonance: growth without bound, or rest.
  const Theory spring(Slider(Caster(1, 1), 1));
  const auto resonant = spring.response(1, 1);
  CHECK(spring.settles_on(1, 1, 1.01 * resonant[0].amplitude, resonant[0].phase).amplitude == infinity);
  CHECK(spring.settles_on(1, 1, 0.99 * resonant[0].amplitude, resonant[0].phase).amplitude == 0);
}

TEST_CASE("small disturbances of a stable solution die down at the rate of the averaged equations", "[svp]") {
  // Areas contract by exp((S' + S/A) t / (2 omega)): a spiral's radius by half of that.
  const Theory svp(Slider(Coulomb(1), 1));
  const double B = 4, omega = 2, turning = 3.0 / 4;  // |1 - omega^2| / (2 omega), but for friction's part
  const auto at = svp.response(B, omega).at(0);
  const std::vector<double> times{0, 40};
  const auto found = svp.transient(B, omega, at.amplitude * (1 + 1e-4), at.phase, times);
  const auto off = [&](std::size_t i) {
    return std::hypot(found.amplitude[i] * std::cos(found.phase[i]) - at.amplitude * std::cos(at.phase),
                      found.amplitude[i] * std::sin(found.phase[i]) - at.amplitude * std::sin(at.phase));
  };
  const double rate = -4 / pi / at.amplitude / (2 * omega) / 2;
  // The spiral is an ellipse of about (1 + |rate| / turning): so much either way.
  CHECK(std::log(off(1) / off(0)) == Approx(rate * 40).margin(2 * std::abs(rate) / turning + 0.05));
}

// ---- unequal levels

TEST_CASE("unequal levels on a spring are those of their mean about another place", "[svp]") {
  const Theory unequal(Slider(Coulomb(1, 1.6), 0.7)), mean(Slider(Coulomb(1.3), 0.7));
  CHECK(unequal.center() == Approx(0.3 / 0.49).epsilon(1e-15));
  CHECK(mean.center() == 0);
  CHECK(unequal.response(10.4, 1.1).at(0).amplitude == mean.response(10.4, 1.1).at(0).amplitude);
  // The exact orbit, at B / a = 8 and within the 0.7 % that are off there without a spring.
  const Slider slider(Coulomb(1, 1.6), 0.7);
  const double exact = orbits(slider, 10.4, 1.1).at(0).amplitude;
  CHECK(unequal.response(10.4, 1.1).at(0).amplitude == Approx(exact).epsilon(0.007));
  // It begins at rest at x = 0, and ends in oscillations about the center.
  const HarmonicMotion motion(10.4, 1.1, 2000);
  const std::vector<double> times{0, 1900, 1900 + pi / 1.1};
  const Moments m = unequal.predict(motion, times);
  CHECK(m.displacement_mean.value[0] == Approx(0).margin(1e-12));
  CHECK((m.displacement_mean.value[1] + m.displacement_mean.value[2]) / 2 == Approx(unequal.center()).epsilon(1e-3));
  CHECK(unequal.predict(HarmonicMotion(0.5, 1.1, 100), std::vector<double>{50}).displacement_mean.value[0] == 0);
}

// ---- errors

TEST_CASE("SlowlyVaryingParameters names the arguments that it rejects", "[svp][errors]") {
  CHECK_THROWS_WITH(Theory(Coulomb(1, 1.6)),
                    "SlowlyVaryingParameters: the law must resist both ways alike, or the mass drifts; got 1 m/s^2 "
                    "forward, 1.6 m/s^2 backward at x = 0");
  CHECK_THROWS_WITH(Theory(Coulomb(1, infinity)), ContainsSubstring("got 1 m/s^2 forward, inf m/s^2 backward"));
  CHECK_THROWS_WITH(Theory(Lopsided{}), ContainsSubstring("unlike parts even in x, of order 2"));
  const Theory svp(Slider(Caster(1, 0.5), 1));
  for (const double bad : {0.0, -1.0, infinity, not_a_number}) {
    const std::string text = detail::shortest(bad);
    CHECK_THROWS_WITH(svp.response(bad, 1),
                      "SlowlyVaryingParameters: B must be positive and finite, got " + text + " m/s^2");
    CHECK_THROWS_WITH(svp.response(1, bad),
                      "SlowlyVaryingParameters: omega must be positive and finite, got " + text + " rad/s");
    CHECK_THROWS_WITH(svp.frequency(1, bad),
                      "SlowlyVaryingParameters: amplitude must be positive and finite, got " + text + " m");
    CHECK_THROWS_AS(svp.frequency(bad, 1), std::invalid_argument);
    CHECK_THROWS_AS(svp.stability_boundary(bad), std::invalid_argument);
    CHECK_THROWS_AS(svp.min_amplitude(bad), std::invalid_argument);
    CHECK_THROWS_AS(svp.rests(bad), std::invalid_argument);
    if (bad != 0) {
      CHECK_THROWS_AS(svp.dissipative(bad), std::invalid_argument);
      CHECK_THROWS_AS(svp.settles_on(1, 1, bad, 0), std::invalid_argument);
    }
  }
  CHECK_THROWS_AS(svp.transient(1, 1, 1, infinity, std::vector<double>{1}), std::invalid_argument);
  CHECK_THROWS_WITH(svp.transient(1, 1, 1, 0, std::vector<double>{0, 2, 2}), ContainsSubstring("time 2, got 2 s"));
  CHECK_THROWS_AS(svp.transient(1, 1, 1, 0, std::vector<double>{-1}), std::invalid_argument);
  CHECK(svp.transient(1, 1, 1, 0, {}).amplitude.empty());
}

TEST_CASE("amplitudes are right as far as doubles reach, and refused beyond", "[svp][errors]") {
  const Theory svp(Coulomb(1e-100)), caster(Caster(1, 1e-3));
  CHECK(svp.response(1e-90, 1e-90)[0].amplitude == Approx(1e90).epsilon(1e-14));
  CHECK(caster.response(1e100, 1e50)[0].amplitude == Approx(1).epsilon(1e-14));
  CHECK(caster.response(2, 1e-120)[0].amplitude == Approx(2e240).epsilon(1e-14));
  CHECK_THROWS_AS(svp.response(1e200, 1e-90), std::overflow_error);
  CHECK_THROWS_AS(caster.response(2, 1e-170), std::overflow_error);
  CHECK_THROWS_AS(caster.response(2, 1e200), std::overflow_error);
  CHECK_THROWS_AS(caster.transient(2, 1e200, 1, 0, std::vector<double>{1}), std::overflow_error);
}
