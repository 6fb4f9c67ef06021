// Coulomb friction under white noise, exactly: the closed densities, the transients that follow from them, and the
// transforms by which the library has them.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <type_traits>
#include <vector>

#include "numerics/quadrature.hpp"
#include "stickslip/ensemble/run.hpp"
#include "stickslip/theory/white_noise.hpp"
#include "support/catch.hpp"
#include "support/motions.hpp"
#include "support/reference.hpp"

using namespace stickslip;
using namespace test;
using Catch::Matchers::ContainsSubstring;
using detail::integral;
using std::numbers::pi;
using theory::WhiteNoise;

namespace {

double relative(double found, double value) { return std::abs(found / value - 1); }

/// Gauss and Legendre's rule of 20 points on `pieces` of equal length.
template <class F>
double gauss(F&& f, double from, double to, int pieces) {
  static const auto rule = [] {
    std::array<std::array<double, 2>, 20> all;
    for (int i = 0; i < 20; ++i) {
      double x = std::cos(pi * (i + 0.75) / 20.5), slope = 0;
      for (int iteration = 0; iteration < 100; ++iteration) {
        double p = 1, before = 0;
        for (int n = 1; n <= 20; ++n) before = std::exchange(p, ((2 * n - 1) * x * p - (n - 1) * before) / n);
        slope = 20 * (x * p - before) / (x * x - 1);
        x -= p / slope;
      }
      all[static_cast<std::size_t>(i)] = {x, 2 / ((1 - x * x) * slope * slope)};
    }
    return all;
  }();
  double sum = 0;
  const double half = (to - from) / pieces / 2;
  for (int piece = 0; piece < pieces; ++piece)
    for (const auto& [x, weight] : rule) sum += half * weight * f(from + half * (2 * piece + 1 + x));
  return sum;
}

/// Over all velocities; the density bends at rest and stands, soon after the start, around it.
template <class F>
double over_velocities(F&& f, double t, double start) {
  const double width = 9 * std::sqrt(2 * pi * t), far = std::abs(start) + t + width + 30;
  std::array<double, 7> breaks = {-far, -width, start - t - width, 0, start + t + width, width, far};
  std::ranges::sort(breaks);
  double sum = 0;
  for (std::size_t i = 1; i < breaks.size(); ++i) sum += gauss(f, breaks[i - 1], breaks[i], 8);
  return sum;
}

Moments at(const WhiteNoise& noise, double time) { return noise.predict(std::array<double, 1>{time}); }

const WhiteNoise unit = WhiteNoise::coulomb(1, 1.0);

}  // namespace

static_assert(!std::is_constructible_v<WhiteNoise, Caster, double>);
static_assert(!std::is_constructible_v<WhiteNoise, Slider<Caster>, double>);
static_assert(std::is_constructible_v<WhiteNoise, Slider<Coulomb>, Spectrum>);

TEST_CASE("the moments of the velocity are those of the closed density", "[white_noise_theory]") {
  for (const auto& value : reference::rows("white_noise_theory", "velocities")) {
    CAPTURE(value["time"]);
    CHECK(relative(unit.absolute_moment(2, value["time"]), value["square"]) < 1e-12);
    CHECK(relative(unit.absolute_moment(1, value["time"]), value["absolute"]) < 1e-12);
    CHECK(relative(unit.absolute_moment(4, value["time"]), value["fourth"]) < 1e-12);
    CHECK(relative(at(unit, value["time"]).velocity_variance.value[0], value["square"]) < 1e-12);
  }
  for (const int order : {3, 6, 8}) {
    const double moment =
        over_velocities([&](double v) { return std::pow(std::abs(v), order) * unit.transition_density(v, 2); }, 2, 0);
    CAPTURE(order);
    CHECK(relative(unit.absolute_moment(order, 2), moment) < (order == 8 ? 1e-10 : 1e-11));
  }
}

TEST_CASE("displacements are those of the moments' differential equations", "[white_noise_theory]") {
  for (const auto& value : reference::rows("white_noise_theory", "displacements")) {
    const Moments m = at(unit, value["time"]);
    CAPTURE(value["time"], value["error"]);
    // The reference's error is an estimate, by extrapolation, of its largest; twice that is allowed.
    CHECK(relative(m.displacement_variance.value[0], value["q11"]) < 2 * value["error"]);
    CHECK(relative(m.covariance.value[0], value["q12"]) < 2 * value["error"]);
    CHECK(relative(m.velocity_variance.value[0], value["q22"]) < 1e-12);
  }
}

TEST_CASE("E[x v] is the integral of E[v(s) v(t)] over the closed densities", "[white_noise_theory][statistics]") {
  for (const double t : {0.1, 3.0}) {
    // s = t sin^2: the roots of s and t - s, in which the integrand is smooth.
    const auto correlation = [&](double s) {
      return 2 * gauss(
                     [&](double u) {
                       const double mean = over_velocities(
                           [&](double v) { return v * unit.transition_density(v, t - s, u); }, t - s, u);
                       return u * unit.transition_density(u, s) * mean;
                     },
                     0, 9 * std::sqrt(2 * pi * s) + s, 6);
    };
    const double covariance = gauss(
        [&](double angle) {
          const double sine = std::sin(angle), cosine = std::cos(angle);
          return correlation(t * sine * sine) * 2 * t * sine * cosine;
        },
        0, pi / 2, 1);
    CAPTURE(t, covariance);
    CHECK(relative(at(unit, t).covariance.value[0], covariance) < 1e-9);
  }
}

TEST_CASE("displacement follows velocity: E[x]' = E[v], Var[x]' = 2 Cov[x, v]", "[white_noise_theory]") {
  // Also where levels in the units of the time pass 1, and the drift is taken out beforehand.
  for (const auto& [a, b] : {std::pair{1.0, 1.0}, std::pair{1.0, 2.0}, std::pair{0.9, 40.0}, std::pair{0.0, 1.5},
                             std::pair{2.0, infinity}, std::pair{3.0, 1e-3}})
    for (const double t : {0.02, 3.0, pi, 3.3, 50.0, 3e4}) {
      const WhiteNoise noise(Coulomb(a, b), 1.0);
      const double h = t * 1e-3;  // the rule's own error is h^4 times a fifth derivative: some 1e-12
      const std::array<double, 5> times = {t - 2 * h, t - h, t, t + h, t + 2 * h};
      const Moments m = noise.predict(times);
      const auto slope = [&](const std::vector<double>& x) { return (8 * (x[3] - x[1]) - (x[4] - x[0])) / (12 * h); };
      CAPTURE(a, b, t);
      const auto& x = m.displacement_mean.value;
      CHECK(std::abs(slope(x) - m.velocity_mean.value[2]) <= 1e-9 * (std::abs(m.velocity_mean.value[2]) + x[2] / t));
      CHECK(relative(slope(m.displacement_variance.value), 2 * m.covariance.value[2]) < 1e-8);
    }
}

TEST_CASE("the transition density solves its equation and begins where it is told", "[white_noise_theory]") {
  // p' = (a sgn(v) p)' + D p'', and the flux is continuous at rest; by differences of the fourth order.
  const auto five = [](auto&& f, double h) { return (8 * (f(h) - f(-h)) - (f(2 * h) - f(-2 * h))) / (12 * h); };
  for (const double start : {0.0, 2.5, -4.0})
    for (const double t : {0.7, 6.0}) {
      const auto p = [&](double v) { return unit.transition_density(v, t, start); };
      for (const double v : {-6.0, -1.3, 0.4, 3.0}) {
        const double h = 1e-2, way = v > 0 ? 1 : -1;
        const double in_time = five([&](double d) { return unit.transition_density(v, t + d, start); }, h * t);
        const double slope = five([&](double d) { return p(v + d); }, h);
        const double bend = (-p(v + 2 * h) + 16 * p(v + h) - 30 * p(v) + 16 * p(v - h) - p(v - 2 * h)) / (12 * h * h);
        CAPTURE(start, t, v);
        CHECK(std::abs(in_time - way * slope - pi * bend) < 1e-7);
      }
      const double h = 1e-4;
      const double up = (-3 * p(0) + 4 * p(h) - p(2 * h)) / (2 * h),
                   down = (3 * p(0) - 4 * p(-h) + p(-2 * h)) / (2 * h);
      CHECK(std::abs(pi * (up - down) + 2 * p(0)) < 1e-7);
      CHECK(over_velocities(p, t, start) == Approx(1).epsilon(1e-12));
    }
  CHECK(gauss([](double v) { return unit.transition_density(v, 1e-6, 3); }, 2.97, 3.03, 40) ==
        Approx(1).epsilon(1e-12));
}

TEST_CASE("two spells are one: Chapman and Kolmogorov", "[white_noise_theory]") {
  for (const double start : {0.0, 3.0})
    for (const double v : {-2.0, 0.0, 0.7, 8.0}) {
      const double both = over_velocities(
          [&](double u) { return unit.transition_density(v, 1.5, u) * unit.transition_density(u, 0.8, start); }, 0.8,
          start);
      CAPTURE(start, v);
      CHECK(relative(both, unit.transition_density(v, 2.3, start)) < 1e-10);
    }
}

TEST_CASE("the velocity is reversible and forgets its start", "[white_noise_theory]") {
  for (const double v : {-3.0, 0.0, 1.0})
    for (const double u : {-1.0, 0.5, 6.0}) {
      CHECK(relative(unit.density(u) * unit.transition_density(v, 2, u),
                     unit.density(v) * unit.transition_density(u, 2, v)) < 1e-13);
      CHECK(unit.transition_density(-v, 2, -u) == unit.transition_density(v, 2, u));
      CHECK(relative(unit.transition_density(v, 2000, u), unit.density(v)) < 1e-12);
    }
}

TEST_CASE("the stationary velocity has two exponentials", "[white_noise_theory]") {
  CHECK(relative(unit.variance(), 2 * pi * pi) < 1e-15);           // thesis (3.48)
  CHECK(relative(unit.growth_rate(), 10 * pi * pi * pi) < 1e-15);  // thesis (3.49)
  CHECK(relative(unit.density(0), 1 / (2 * pi)) < 1e-15);
  for (const auto& [a, b] : {std::pair{1.0, 1.0}, std::pair{1.0, 2.0}, std::pair{0.3, 0.2}, std::pair{2.0, infinity}}) {
    const WhiteNoise noise(Coulomb(a, b), 0.7);
    const auto moment = [&](int n) {
      return gauss([&](double v) { return std::pow(v, n) * noise.density(v); }, 0, 600, 80) +
             (std::isinf(b) ? 0 : gauss([&](double v) { return std::pow(v, n) * noise.density(v); }, -600, 0, 80));
    };
    CAPTURE(a, b);
    CHECK(moment(0) == Approx(1).epsilon(1e-12));
    CHECK(moment(1) == Approx(noise.mean()).margin(1e-12));
    CHECK(moment(2) - noise.mean() * noise.mean() == Approx(noise.variance()).epsilon(1e-12));
    // The transients end there: the variance by 1e-12 at t = 1e4, the growth by its very slope.
    const Moments late = noise.predict(std::array<double, 3>{1e4, 2e4, 3e4});
    CHECK(relative(late.velocity_variance.value[2], noise.variance()) < 1e-11);
    CHECK(std::abs(late.velocity_mean.value[2] - noise.mean()) < 1e-11);
    const auto& q11 = late.displacement_variance.value;
    CHECK(relative((q11[2] - q11[1]) / 1e4, noise.growth_rate()) < 1e-10);
    CHECK(late.growth_rate.value == noise.growth_rate());
    CHECK(late.growth_rate.error == 0);
  }
}

TEST_CASE("the velocity's spectrum holds its variance, and at zero its growth", "[white_noise_theory]") {
  const WhiteNoise noise = WhiteNoise::coulomb(1.7, 0.4);
  const auto spectrum = [&](double omega) { return noise.velocity_spectrum(omega); };
  CHECK(relative(2 * integral(spectrum, 0, infinity, std::array<double, 3>{1, 10, 100}), noise.variance()) < 1e-9);
  CHECK(relative(spectrum(0), noise.growth_rate() / (2 * pi)) < 1e-14);
  CHECK(spectrum(-2) == spectrum(2));
  CHECK(relative(spectrum(1e5), 0.4 / 1e10) < 1e-2);  // that of the noise, integrated
  CHECK(std::isnan(spectrum(not_a_number)));
}

TEST_CASE("a level each way: what mirrors, and what is known of one side alone", "[white_noise_theory]") {
  const Moments up = at(WhiteNoise(Coulomb(1, 3), 2.0), 4), down = at(WhiteNoise(Coulomb(3, 1), 2.0), 4);
  CHECK(relative(up.velocity_mean.value[0], -down.velocity_mean.value[0]) < 1e-12);
  CHECK(relative(up.displacement_mean.value[0], -down.displacement_mean.value[0]) < 1e-12);
  CHECK(relative(up.covariance.value[0], down.covariance.value[0]) < 1e-12);
  // Nearly equal is nearly the same.
  const Moments equal = at(unit, 4), nearly = at(WhiteNoise(Coulomb(1, 1 + 1e-12), 1.0), 4);
  CHECK(relative(equal.displacement_variance.value[0], nearly.displacement_variance.value[0]) < 1e-11);
  // Without friction forward and never backward the velocity is the modulus of Brownian motion.
  const WhiteNoise reflected(Coulomb(0, infinity), 1.0);
  const Moments m = at(reflected, 4);
  CHECK(relative(m.velocity_mean.value[0], std::sqrt(4 * pi * 4 / pi)) < 1e-12);
  CHECK(relative(m.velocity_variance.value[0], 2 * pi * 4 * (1 - 2 / pi)) < 1e-12);
  CHECK(relative(m.displacement_mean.value[0], 4 * std::sqrt(4 * pi * 4 / pi) / 1.5) < 1e-12);
  CHECK(std::isnan(m.growth_rate.value));
  CHECK(reflected.density(-1) == 0);
}

TEST_CASE("without friction no stationary velocity: its variance and the growth are infinite", "[white_noise_theory]") {
  // A vanishing level, s0 = 1: the leading term of (3.49) with one side, 4 pi^3 / a^4.
  for (const double a : {1.0, 1e-3, 1e-12})
    CHECK(relative(WhiteNoise(Coulomb(a, infinity), 1.0).growth_rate() * std::pow(a, 4), 4 * pi * pi * pi) < 1e-14);
  for (const Coulomb& law : {Coulomb(0, infinity), Coulomb(0, 1), Coulomb(1, 0), Coulomb(0)}) {
    const WhiteNoise noise(law, 1.0);
    CAPTURE(law.forward(), law.backward());
    CHECK(noise.growth_rate() == infinity);
    CHECK(noise.variance() == infinity);
    CHECK(std::isnan(at(noise, 4).growth_rate.value));  // the velocity never is stationary
  }
  // Reflected Brownian motion, v = |w|: as it has no scale but time's, Var[x] grows as t^3.
  const std::array<double, 2> times = {2, 4};
  const Moments m = WhiteNoise(Coulomb(0, infinity), 1.0).predict(times);
  CHECK(relative(m.displacement_variance.value[1], 8 * m.displacement_variance.value[0]) < 1e-12);
}

TEST_CASE("ensembles with a level each way spread and drift so", "[white_noise_theory][statistics]") {
  // Held loads of step dt are wrong by O(dt), which halving shows, in the same motions. Fixed seed; with a new seed,
  // one of five checks within three standard errors would fail 1 time in 75.
  const Coulomb law(1, 2);
  const auto run = [&](double dt) {
    EnsembleOptions options;
    options.members = 10'000;
    options.seed = 5;
    options.velocity_spectrum = false;
    const GaussianExcitation noise(Spectrum::white(1), dt, static_cast<std::size_t>(std::lround(10.24 / dt)),
                                   {.interpolation = Interpolation::constant,
                                    .correct_interpolation = false,
                                    .random_amplitudes = true,
                                    .zero_frequency = true});
    return run_ensemble(law, noise, options).moments();
  };
  const Moments coarse = run(0.04), fine = run(0.02);
  const Moments exact = at(WhiteNoise(law, Spectrum::white(1)), 10.24);
  for (const auto figure : {&Moments::displacement_mean, &Moments::displacement_variance, &Moments::covariance,
                            &Moments::velocity_mean, &Moments::velocity_variance}) {
    const Estimates &c = coarse.*figure, &f = fine.*figure;
    const double limit = 2 * f.value.back() - c.value.back(), value = (exact.*figure).value[0];
    CAPTURE(limit, f.error.back(), value);
    CHECK(std::abs(limit - value) < 3 * f.error.back());
  }
}

TEST_CASE("without friction, (3.41) to (3.43)", "[white_noise_theory]") {
  const WhiteNoise noise = WhiteNoise::coulomb(0, 0.3);
  const Moments m = at(noise, 7);
  CHECK(relative(m.velocity_variance.value[0], 2 * pi * 0.3 * 7) < 1e-12);
  CHECK(relative(m.covariance.value[0], pi * 0.3 * 49) < 1e-12);
  CHECK(relative(m.displacement_variance.value[0], 2 * pi / 3 * 0.3 * 343) < 1e-12);
  CHECK(std::isnan(m.growth_rate.value));
  CHECK(std::isinf(noise.variance()));
  CHECK(std::isinf(noise.growth_rate()));
  CHECK(noise.density(1) == 0);
  CHECK(noise.mean() == 0);
  CHECK(relative(noise.transition_density(3, 2, 1),
                 std::exp(-4 / (4 * 0.3 * pi * 2)) / std::sqrt(4 * pi * 0.3 * pi * 2)) < 1e-14);
}

TEST_CASE("the result depends on a^2 t / S0 alone", "[white_noise_theory]") {
  for (const auto& [a, s0] : {std::pair{3.0, 0.2}, std::pair{1e-40, 1e-50}, std::pair{1e30, 1e40}}) {
    const double time = s0 / a / a, velocity = s0 / a, displacement = velocity * time;
    const WhiteNoise noise = WhiteNoise::coulomb(a, s0);
    const Moments m = at(noise, 5 * time), one = at(unit, 5);
    CAPTURE(a, s0);
    CHECK(relative(m.displacement_variance.value[0] / displacement / displacement, one.displacement_variance.value[0]) <
          1e-12);
    CHECK(relative(m.covariance.value[0] / displacement / velocity, one.covariance.value[0]) < 1e-12);
    CHECK(relative(m.velocity_variance.value[0] / velocity / velocity, one.velocity_variance.value[0]) < 1e-12);
    CHECK(relative(noise.transition_density(2 * velocity, 5 * time, -velocity) * velocity,
                   unit.transition_density(2, 5, -1)) < 1e-12);
    CHECK(relative(noise.velocity_spectrum(0.1 / time) / velocity / velocity / time, unit.velocity_spectrum(0.1)) <
          1e-12);
  }
  // Much too early, and much too late, for friction to change by anything what it has made of the motion.
  CHECK(relative(at(unit, 1e-30).displacement_variance.value[0], 2 * pi / 3 * 1e-90) < 1e-12);
  CHECK(relative(at(unit, 1e30).displacement_variance.value[0], 10 * pi * pi * pi * 1e30) < 1e-12);
}

TEST_CASE("a start at rest is answered with zeros", "[white_noise_theory]") {
  const Moments m = unit.predict(std::array<double, 2>{0, 1});
  CHECK(m.time == std::vector<double>{0, 1});
  CHECK(m.displacement_variance.value[0] == 0);
  CHECK(m.velocity_variance.value[0] == 0);
  CHECK(m.velocity_variance.error == std::vector<double>{0, 0});
  CHECK(unit.predict({}).time.empty());
  CHECK(unit.absolute_moment(2, 0) == 0);
}

TEST_CASE("arguments that the white-noise theory does not cover are rejected", "[white_noise_theory]") {
  CHECK_THROWS_WITH(WhiteNoise::coulomb(1, 0.0), ContainsSubstring("s0 must be positive and finite, got 0 m^2/s^3"));
  CHECK_THROWS_AS(WhiteNoise::coulomb(1, not_a_number), std::invalid_argument);
  CHECK_THROWS_AS(WhiteNoise::coulomb(1, -1.0), std::invalid_argument);
  CHECK_THROWS_AS(WhiteNoise::coulomb(-1, 1.0), std::invalid_argument);
  CHECK_THROWS_WITH(WhiteNoise::coulomb(1, Spectrum::band_pass(1, 0, 3)), ContainsSubstring("covers white noise only"));
  CHECK_THROWS_WITH(WhiteNoise(Slider<Coulomb>(Coulomb(1), 2), 1.0), ContainsSubstring("natural_frequency must be 0"));
  CHECK_THROWS_WITH(WhiteNoise::coulomb(1e-200, 1e200), ContainsSubstring("exceeds the range of doubles"));
  CHECK_THROWS_WITH(unit.predict(std::array<double, 1>{-1}), ContainsSubstring("at least 0, got -1 s"));
  CHECK_THROWS_AS(unit.predict(std::array<double, 1>{not_a_number}), std::invalid_argument);
  CHECK_THROWS_WITH(unit.predict(std::array<double, 2>{2, 2}), ContainsSubstring("times must increase"));
  CHECK_THROWS_WITH(WhiteNoise::coulomb(0, 1.0).predict(std::array<double, 1>{1e200}),
                    ContainsSubstring("exceed the range of doubles"));
  const WhiteNoise unequal(Coulomb(1, 2), 1.0);
  CHECK_THROWS_WITH(unequal.transition_density(0, 1), ContainsSubstring("equal levels only"));
  CHECK_THROWS_AS(unequal.velocity_spectrum(1), std::invalid_argument);
  CHECK_THROWS_AS(WhiteNoise::coulomb(0, 1.0).velocity_spectrum(1), std::invalid_argument);
  CHECK_THROWS_AS(unit.transition_density(0, 0), std::invalid_argument);
  CHECK_THROWS_AS(unit.transition_density(infinity, 1), std::invalid_argument);
  CHECK_THROWS_AS(unit.absolute_moment(0, 1), std::invalid_argument);
  CHECK_THROWS_AS(unit.absolute_moment(9, 1), std::invalid_argument);
}
