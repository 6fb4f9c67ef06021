// Coulomb friction under white noise in the plane and in d dimensions: the formulas against the equations that they
// solve, by means that share nothing with them, and against a simulation.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "numerics/quadrature.hpp"
#include "stickslip/excitation/random.hpp"
#include "stickslip/theory/white_noise.hpp"
#include "support/catch.hpp"
#include "support/mean.hpp"
#include "support/motions.hpp"
#include "support/size.hpp"
#include "theory/isotropic_noise.hpp"

using namespace stickslip;
using namespace test;
using Catch::Matchers::ContainsSubstring;
using detail::integral;
using std::numbers::pi;
using theory::WhiteNoise;

namespace {

double relative(double found, double value) { return std::abs(found / value - 1); }

/// a = D = 1.
WhiteNoise unit(int dimensions) { return WhiteNoise::coulomb(1, 1 / pi, dimensions); }

Moments at(const WhiteNoise& noise, double time) { return noise.predict(std::array<double, 1>{time}); }

/// The slope of f at 0, to fourth order.
template <class F>
double slope(F&& f, double h) {
  return (8 * (f(h) - f(-h)) - (f(2 * h) - f(-2 * h))) / (12 * h);
}

/// Expectations as functions of the speed at the start, by finite volumes on a grid of speeds: for f(u) Y(v / u) with a
/// spherical harmonic Y of degree l, the generator of the velocity with a = D = 1 is
///     L f = f'' + (d - 1) f' / u - l (l + d - 2) f / u^2 - f' = (w f')' / w - l (l + d - 2) f / u^2,  w = u^(d-1) e^-u
class Radial {
 public:
  Radial(int dimensions, double farthest, std::size_t cells)
      : dimensions_(dimensions), h_(farthest / static_cast<double>(cells)), weight_(cells), edge_(cells + 1) {
    const auto weight = [&](double u) { return std::pow(u, dimensions - 1) * std::exp(-u); };
    for (std::size_t i = 0; i < cells; ++i) weight_[i] = weight(speed(i));
    for (std::size_t i = 1; i < cells; ++i) edge_[i] = weight(h_ * static_cast<double>(i));
  }

  std::size_t size() const { return weight_.size(); }
  double speed(std::size_t i) const { return h_ * (static_cast<double>(i) + 0.5); }

  template <class F>
  std::vector<double> values(F&& f) const {
    std::vector<double> all(size());
    for (std::size_t i = 0; i < size(); ++i) all[i] = f(speed(i));
    return all;
  }

  /// (shift - L) f = source, by elimination.
  std::vector<double> solved(int l, double shift, std::vector<double> source) const {
    std::vector<double> upper(size());
    for (std::size_t i = 0; i < size(); ++i) {
      const double u = speed(i), scale = 1 / (weight_[i] * h_ * h_), below = edge_[i] * scale,
                   above = edge_[i + 1] * scale;
      double middle = shift + l * (l + dimensions_ - 2) / (u * u) + below + above;
      if (i > 0) {
        middle += below * upper[i - 1];
        source[i] += below * source[i - 1];
      }
      upper[i] = -above / middle;
      source[i] /= middle;
    }
    for (std::size_t i = size() - 1; i-- > 0;) source[i] -= upper[i] * source[i + 1];
    return source;
  }

  /// The stationary mean of f(|v|).
  double mean(const std::vector<double>& f) const {
    double sum = 0, all = 0;
    for (std::size_t i = 0; i < size(); ++i) sum += weight_[i] * f[i], all += weight_[i];
    return sum / all;
  }

  /// At rest: a parabola through the first three cells.
  static double at_rest(const std::vector<double>& f) { return (15 * f[0] - 10 * f[1] + 3 * f[2]) / 8; }

 private:
  int dimensions_;
  double h_;
  std::vector<double> weight_, edge_;
};

/// E|v|^2 and E[x v] at `time` from rest, from the backward equations: with E[v(t) | v] = g(u) v / u,
///     g' = L1 g, g(0) = u;   E[x v]' = L0 E[x v] + u g, from 0;   E|v|^2' = L0 E|v|^2, from u^2
/// by the L-stable rule of two stages of order 2.
std::array<double, 2> backward_in_time(int dimensions, double time, std::size_t cells, int steps) {
  const Radial grid(dimensions, 40 + 2 * time, cells);
  const double stage = 1 - std::numbers::sqrt2 / 2, h = time / steps, shift = 1 / (stage * h);
  std::vector<double> g = grid.values([](double u) { return u; }), product(grid.size()),
                      square = grid.values([](double u) { return u * u; });
  // One stage, f1 = f0 + stage h (L f1 + source); its slope is (f1 - f0) / (stage h).
  const auto solve = [&](int l, const std::vector<double>& from, const std::vector<double>* source) {
    std::vector<double> right(from.size());
    for (std::size_t i = 0; i < right.size(); ++i)
      right[i] = from[i] * shift + (source != nullptr ? grid.speed(i) * (*source)[i] : 0);
    return grid.solved(l, shift, std::move(right));
  };
  const auto between = [&](const std::vector<double>& from, const std::vector<double>& first) {
    std::vector<double> start(from.size());
    for (std::size_t i = 0; i < start.size(); ++i) start[i] = from[i] + (1 - stage) / stage * (first[i] - from[i]);
    return start;
  };
  for (int step = 0; step < steps; ++step) {
    const std::vector<double> g1 = solve(1, g, nullptr), product1 = solve(0, product, &g1),
                              square1 = solve(0, square, nullptr);
    g = solve(1, between(g, g1), nullptr);
    product = solve(0, between(product, product1), &g);
    square = solve(0, between(square, square1), nullptr);
  }
  return {Radial::at_rest(square), Radial::at_rest(product)};
}

/// Many blocks in d dimensions under white noise with a = D = 1, from rest: increments of the velocity are Gaussian,
/// and friction then reduces the speed by the step, not below zero. The same noise in steps h and h / 2, and the limit
/// of zero step from both; sums of squares over the components.
struct Simulated {
  Mean velocity_square, covariance, displacement_square;  // of each component, with the scatter of blocks
};

Simulated simulated(int dimensions, double time, double h, int blocks, std::uint64_t seed) {
  struct Block {
    std::array<double, 3> x{}, v{};
    void step(const double* noise, double length, int dimensions) {
      std::array<double, 3> next{};
      double square = 0;
      for (int i = 0; i < dimensions; ++i) {
        next[std::size_t(i)] = v[std::size_t(i)] + noise[i];
        square += next[std::size_t(i)] * next[std::size_t(i)];
      }
      const double left = square > length * length ? 1 - length / std::sqrt(square) : 0;
      for (std::size_t i = 0; i < 3; ++i) {
        next[i] *= left;
        x[i] += length / 2 * (v[i] + next[i]);
        v[i] = next[i];
      }
    }
  };
  const int steps = static_cast<int>(std::lround(time / h));
  std::vector<double> noise(static_cast<std::size_t>(2 * steps * dimensions));
  Simulated all;
  for (int block = 0; block < blocks; ++block) {
    normals({.seed = seed, .member = static_cast<std::uint64_t>(block)}, noise);
    Block coarse, fine;
    const double* next = noise.data();
    for (int step = 0; step < steps; ++step, next += 2 * dimensions) {
      std::array<double, 6> halves{};
      std::array<double, 3> whole{};
      for (int i = 0; i < dimensions; ++i) {
        const auto first = static_cast<std::size_t>(i), second = static_cast<std::size_t>(i + 3);
        halves[first] = std::sqrt(h) * next[i];
        halves[second] = std::sqrt(h) * next[i + dimensions];
        whole[first] = halves[first] + halves[second];
      }
      coarse.step(whole.data(), h, dimensions);
      fine.step(halves.data(), h / 2, dimensions);
      fine.step(halves.data() + 3, h / 2, dimensions);
    }
    std::array<double, 3> sum{};
    for (std::size_t i = 0; i < 3; ++i) {
      sum[0] += 2 * fine.v[i] * fine.v[i] - coarse.v[i] * coarse.v[i];
      sum[1] += 2 * fine.x[i] * fine.v[i] - coarse.x[i] * coarse.v[i];
      sum[2] += 2 * fine.x[i] * fine.x[i] - coarse.x[i] * coarse.x[i];
    }
    all.velocity_square.add(sum[0] / dimensions);
    all.covariance.add(sum[1] / dimensions);
    all.displacement_square.add(sum[2] / dimensions);
  }
  return all;
}

}  // namespace

TEST_CASE("in d dimensions the speed has a Gamma distribution", "[white_noise_plane]") {
  for (const int d : {1, 2, 3, 4, 5, 6}) {
    const WhiteNoise noise = WhiteNoise::coulomb(1.7, 0.4, d);
    const double unit_speed = pi * 0.4 / 1.7;
    const auto moment = [&](int n) {
      return integral([&](double u) { return std::pow(u, n) * noise.speed_density(u); }, 0, 80 * unit_speed,
                      std::array<double, 3>{unit_speed, 5 * unit_speed, 20 * unit_speed});
    };
    CAPTURE(d);
    CHECK(noise.dimensions() == d);
    CHECK(relative(moment(0), 1) < 1e-9);
    CHECK(relative(moment(1), noise.mean_speed()) < 1e-9);
    CHECK(relative(moment(2), d * noise.variance()) < 1e-9);
    CHECK(relative(noise.mean_speed(), d * unit_speed) < 1e-14);
    CHECK(relative(noise.variance(), (d + 1) * unit_speed * unit_speed) < 1e-14);
    CHECK(noise.mean() == 0);
    CHECK(noise.speed_density(-1) == 0);
    CHECK(noise.speed_density(infinity) == 0);
    CHECK(std::isnan(noise.speed_density(not_a_number)));
  }
  // next_values.json, D.white: a = D = 1
  CHECK(relative(unit(2).variance(), 3) < 1e-15);
  CHECK(relative(unit(2).growth_rate(), 21) < 1e-15);
  CHECK(relative(unit(2).mean_speed(), 2) < 1e-15);
  CHECK(relative(unit(3).variance(), 4) < 1e-15);
  CHECK(relative(unit(3).growth_rate(), 36) < 1e-15);
  CHECK(relative(WhiteNoise(Coulomb(1, 3), 1 / pi).mean_speed(), (1 + 1.0 / 9) / (1 + 1.0 / 3)) < 1e-14);
  CHECK(std::isinf(WhiteNoise::coulomb(0, 1, 2).mean_speed()));
}

TEST_CASE("the density of a component is the margin of exp(-a |v| / D)", "[white_noise_plane]") {
  CHECK(relative(unit(2).density(0), 1 / pi) < 1e-14);
  for (const double v : {0.0, 1e-10, 0.3, 2.0, 9.0}) {
    CAPTURE(v);
    // The plane, by y = v sinh(t); three dimensions, exactly
    const double plane = v == 0
                             ? 1 / pi
                             : integral([&](double t) { return v / pi * std::exp(-v * std::cosh(t)) * std::cosh(t); },
                                        0, std::acosh(1 + 60 / v));
    CHECK(relative(unit(2).density(v), plane) < 1e-8);
    CHECK(relative(unit(3).density(v), (1 + v) * std::exp(-v) / 4) < 1e-13);
    CHECK(unit(2).density(-v) == unit(2).density(v));
  }
  for (const int d : {2, 3, 5, 6}) {
    const WhiteNoise noise = WhiteNoise::coulomb(0.3, 2, d);
    const double far = 60 * 2 * pi / 0.3;
    const auto moment = [&](int n) {
      return 2 * integral([&](double v) { return std::pow(v, n) * noise.density(v); }, 0, far,
                          std::array<double, 3>{far / 60, far / 12, far / 4});
    };
    CAPTURE(d);
    CHECK(relative(moment(0), 1) < 1e-8);
    CHECK(relative(moment(2), noise.variance()) < 1e-8);
    CHECK(noise.density(1e300) == 0);
    CHECK(std::isnan(noise.density(not_a_number)));
  }
  CHECK(WhiteNoise::coulomb(0, 1, 2).density(1) == 0);
}

TEST_CASE("growth, spectrum and relaxation are those of the generator", "[white_noise_plane]") {
  const std::size_t cells = size<std::size_t>(8000, 4000);
  for (const int d : {2, 3, 5}) {
    const Radial grid(d, 60, cells);
    const std::vector<double> speeds = grid.values([](double u) { return u; });
    // With L phi = -v_i the rate is 2 E[v_i phi]: phi = (v_i / |v|) f.
    std::vector<double> f = grid.solved(1, 0, speeds);
    const auto with_speed = [&](std::vector<double> values) {
      for (std::size_t i = 0; i < values.size(); ++i) values[i] *= speeds[i];
      return grid.mean(values);
    };
    CAPTURE(d);
    CHECK(relative(2.0 / d * with_speed(f), unit(d).growth_rate()) < 1e-4);
    for (std::size_t i = cells / 30; i < cells / 3; i += cells / 30) {
      const double u = speeds[i];
      CHECK(std::abs(f[i] / (u * (u + d + 1) / 2) - 1) < 1e-3);  // f = u^2 / 2 + (d + 1) u / 2
    }
    // The transform of the autocovariance on the real axis, from `velocity_autocovariance`
    for (const double s : {0.2, 2.0}) {
      const double transform = integral([&](double t) { return std::exp(-s * t) * unit(d).velocity_autocovariance(t); },
                                        0, 40 / s, std::array<double, 4>{0.1, 1, 5, 20});
      CHECK(relative(1.0 / d * with_speed(grid.solved(1, s, speeds)), transform) < 1e-4);
    }
    // The slowest relaxation, by inverse iteration
    for (int iteration = 0; iteration < 200; ++iteration) {
      const double before = with_speed(f);
      f = grid.solved(1, 0, f);
      const double after = with_speed(f);
      if (iteration == 199) CHECK(relative(before / after, unit(d).relaxation_rate()) < 1e-3);
      for (double& value : f) value /= after;
    }
  }
  CHECK(relative(unit(1).relaxation_rate(), 0.25) < 1e-15);
  CHECK(relative(unit(2).relaxation_rate(), 2.0 / 9) < 1e-15);
  CHECK(relative(WhiteNoise::coulomb(3, 0.2, 2).relaxation_rate(), 2.0 / 9 * 9 / (0.2 * pi)) < 1e-14);
}

TEST_CASE("in one dimension the formulas for d dimensions are those of one axis", "[white_noise_plane]") {
  const WhiteNoise noise = unit(1);
  for (const double omega : {0.0, 1e-3, 0.3, 0.999, 1.0, 1.001, 7.0, 1e3}) {
    CAPTURE(omega);
    CHECK(relative(detail::isotropic_spectrum(omega, 1), noise.velocity_spectrum(omega)) < 1e-9);
  }
  for (const double t : {1e-6, 0.01, 1.0, 20.0})
    for (const int n : {1, 2, 5}) {
      CAPTURE(t, n);
      const double moment = detail::isotropic_moment(std::sqrt(t), n, 1) * std::pow(t, n / 2.0);
      CHECK(relative(moment, noise.absolute_moment(n, t)) < 1e-12);
    }
}

TEST_CASE("spectrum and autocovariance belong together", "[white_noise_plane]") {
  for (const int d : {1, 2, 3, 6}) {
    const WhiteNoise noise = WhiteNoise::coulomb(1.7, 0.4, d);
    const auto spectrum = [&](double omega) { return noise.velocity_spectrum(omega); };
    const auto correlation = [&](double lag) { return noise.velocity_autocovariance(lag); };
    const double unit_time = pi * 0.4 / (1.7 * 1.7);
    CAPTURE(d);
    CHECK(relative(correlation(0), noise.variance()) < 1e-15);
    CHECK(relative(correlation(1e-9 * unit_time), noise.variance()) < 1e-8);
    CHECK(relative(spectrum(0), noise.growth_rate() / (2 * pi)) < 1e-13);
    CHECK(relative(2 * integral(spectrum, 0, infinity, std::array<double, 3>{1, 10, 100}), noise.variance()) < 1e-9);
    CHECK(relative(2 * integral(correlation, 0, 300 * unit_time, std::array<double, 3>{unit_time / 10, unit_time, 9}),
                   noise.growth_rate()) < 1e-9);
    for (const double omega : {0.7, 4.0}) {
      const double transform = detail::cosine_integral(correlation, omega, 0, 200 * unit_time, 1e-11) / pi;
      CHECK(relative(spectrum(omega), transform) < 1e-8);
      CHECK(spectrum(-omega) == spectrum(omega));
    }
    CHECK(correlation(-0.3) == correlation(0.3));
    CHECK(std::isnan(correlation(not_a_number)));
    CHECK(std::isnan(spectrum(not_a_number)));
    CHECK(correlation(infinity) == 0);
    // The velocity starts as Brownian motion: R(0) - R(t) = D t, and the spectrum ends as that of its noise. In more
    // than one dimension the next terms are smaller by the time.
    CHECK(relative((correlation(0) - correlation(1e-4 * unit_time)) / (pi * 0.4 * 1e-4 * unit_time), 1) < 1e-3);
    CHECK(relative(spectrum(1e5), 0.4 / 1e10) < 1e-2);
    if (d > 1) CHECK(relative(spectrum(1e9), 0.4 / 1e18) < 1e-12);
    // Continuous where the ways to compute it change
    CHECK(relative(correlation(unit_time * (1 - 1e-9)), correlation(unit_time * (1 + 1e-9))) < 1e-8);
    CHECK(relative(spectrum((1 - 1e-12) / unit_time), spectrum((1 + 1e-12) / unit_time)) < 1e-10);
  }
}

TEST_CASE("the autocovariance is a sum of the levels of a hydrogen atom", "[white_noise_plane]") {
  // The levels N (N + d - 1) / (2 N + d - 1)^2, all with positive weight; that of N = 1 is (d + 1) (1 - 1/d^2)^(d + 2).
  for (const int d : {2, 3, 5}) {
    const double first = unit(d).relaxation_rate(), weight = (d + 1) * std::pow(1 - 1.0 / (d * d), d + 2),
                 second = 2.0 * (d + 1) / ((d + 3.0) * (d + 3.0));
    for (const double t : {0.1, 1.0, 10.0, 40.0, 80.0}) {
      const double rest = unit(d).velocity_autocovariance(t) - weight * std::exp(-first * t);
      CAPTURE(d, t);
      CHECK(rest > 0);
      CHECK(rest < (unit(d).variance() - weight) * std::exp(-second * t));
    }
  }
}

TEST_CASE("moments from rest obey their own equations", "[white_noise_plane]") {
  // (E|v|^n)' = n (n + d - 2) D E|v|^(n - 2) - n a E|v|^(n - 1), and E[x^2]' = 2 E[x v]
  for (const int d : {2, 3, 4, 6})
    for (const double t : {1e-3, 0.4, 3.0, 25.0, 400.0}) {
      const WhiteNoise noise = WhiteNoise::coulomb(1.3, 0.6, d);
      const double D = 0.6 * pi, a = 1.3, h = 1e-3 * t;
      CAPTURE(d, t);
      for (const int n : {2, 3, 6}) {
        const double before = n == 2 ? 1 : noise.absolute_moment(n - 2, t), gain = n * (n + d - 2) * D * before;
        const double rate = slope([&](double dt) { return noise.absolute_moment(n, t + dt); }, h);
        CHECK(std::abs(rate - gain + n * a * noise.absolute_moment(n - 1, t)) < 1e-9 * gain);
      }
      const double growth = slope([&](double dt) { return at(noise, t + dt).displacement_variance.value[0]; }, h);
      CHECK(relative(growth, 2 * at(noise, t).covariance.value[0]) < 1e-8);
      CHECK(relative(at(noise, t).velocity_variance.value[0] * d, noise.absolute_moment(2, t)) < 1e-13);
    }
}

TEST_CASE("moments from rest solve the backward equations", "[white_noise_plane]") {
  // Grid and step leave some 1e-3; the difference of two sizes is extrapolated to zero by their order, 2.
  const std::size_t cells = size<std::size_t>(800, 400);
  const int steps = size(100, 60);
  for (const int d : {2, 3, 4})
    for (const double t : {1.0, 12.0}) {
      const auto coarse = backward_in_time(d, t, cells, steps), fine = backward_in_time(d, t, 2 * cells, 2 * steps);
      CAPTURE(d, t);
      CHECK(relative((4 * fine[0] - coarse[0]) / 3, d * at(unit(d), t).velocity_variance.value[0]) < 1e-3);
      CHECK(relative((4 * fine[1] - coarse[1]) / 3, d * at(unit(d), t).covariance.value[0]) < 1e-3);
    }
}

TEST_CASE("early, late, without friction, and at any scale", "[white_noise_plane]") {
  for (const int d : {2, 3, 6}) {
    const WhiteNoise noise = unit(d);
    CAPTURE(d);
    // Friction first acts along the Gaussian velocity: E|v| = sqrt(2 D t) mean
    const double mean = std::numbers::sqrt2 * std::tgamma((d + 1) / 2.0) / std::tgamma(d / 2.0);
    const double t = 1e-8, e = mean / d * std::sqrt(2 * t);
    const Moments early = at(noise, t);
    CHECK(std::abs(early.velocity_variance.value[0] / (2 * t) - (1 - 2.0 / 3 * e)) < 2e-8);
    CHECK(std::abs(early.covariance.value[0] / (t * t) - (1 - 11.0 / 15 * e)) < 2e-8);
    CHECK(std::abs(early.displacement_variance.value[0] / (2.0 / 3 * t * t * t) - (1 - 22.0 / 35 * e)) < 2e-8);
    // Late the variance is the rate times the time, less (d + 1) (47 d^2 + 151 d + 126) / 12.
    const double delay = (d + 1) * (47.0 * d * d + 151.0 * d + 126) / 12;
    const Moments late = at(noise, 1e4);
    CHECK(std::abs(late.displacement_variance.value[0] - noise.growth_rate() * 1e4 + delay) < 1e-6 * delay);
    CHECK(relative(late.velocity_variance.value[0], noise.variance()) < 1e-12);
    CHECK(relative(late.covariance.value[0], noise.growth_rate() / 2) < 1e-12);
    CHECK(late.growth_rate.value == noise.growth_rate());
    CHECK(relative(noise.absolute_moment(3, 1e4), d * (d + 1.0) * (d + 2)) < 1e-12);

    const Moments free = at(WhiteNoise::coulomb(0, 0.3, d), 7);
    CHECK(relative(free.velocity_variance.value[0], 2 * pi * 0.3 * 7) < 1e-12);
    CHECK(relative(free.covariance.value[0], pi * 0.3 * 49) < 1e-12);
    CHECK(relative(free.displacement_variance.value[0], 2 * pi / 3 * 0.3 * 343) < 1e-12);
    CHECK(std::isnan(free.growth_rate.value));

    const Moments one = at(noise, 5);
    for (const auto& [a, D] : {std::pair{3.0, 0.2}, std::pair{1e-40, 1e-50}, std::pair{1e30, 1e40}}) {
      const double time = D / a / a, velocity = D / a, displacement = velocity * time;
      const WhiteNoise other = WhiteNoise::coulomb(a, D / pi, d);
      const Moments m = at(other, 5 * time);
      CAPTURE(a, D);
      CHECK(relative(m.displacement_variance.value[0] / displacement / displacement,
                     one.displacement_variance.value[0]) < 1e-12);
      CHECK(relative(m.covariance.value[0] / displacement / velocity, one.covariance.value[0]) < 1e-12);
      CHECK(relative(m.velocity_variance.value[0] / velocity / velocity, one.velocity_variance.value[0]) < 1e-12);
      CHECK(relative(other.velocity_spectrum(0.1 / time) / velocity / velocity / time, noise.velocity_spectrum(0.1)) <
            1e-12);
      CHECK(relative(other.velocity_autocovariance(2 * time) / velocity / velocity, noise.velocity_autocovariance(2)) <
            1e-12);
    }
    CHECK(relative(at(noise, 1e-30).displacement_variance.value[0], 2.0 / 3 * 1e-90) < 1e-12);
    CHECK(relative(at(noise, 1e30).displacement_variance.value[0], noise.growth_rate() * 1e30) < 1e-12);
    CHECK(at(noise, 0).displacement_variance.value[0] == 0);
  }
}

TEST_CASE("simulated blocks in the plane and in space move as the theory says", "[white_noise_plane][statistics]") {
  // 18 numbers within 4.7 standard errors: a false alarm in 20,000 seeds. The error of the extrapolated steps is below
  // a third of a standard error.
  const int blocks = size(20'000, 2000);
  for (const int d : {1, 2, 3})
    for (const auto& [time, h] : {std::pair{1.0, 0.04}, std::pair{20.0, 0.1}}) {
      const Simulated found = simulated(d, time, h, blocks, 20);
      const Moments exact = at(unit(d), time);
      CAPTURE(d, time);
      const auto check = [](const Mean& mean, double value) {
        CAPTURE(mean.value(), value, mean.error());
        CHECK(std::abs(mean.value() - value) < 4.7 * mean.error());
      };
      check(found.velocity_square, exact.velocity_variance.value[0]);
      check(found.covariance, exact.covariance.value[0]);
      check(found.displacement_square, exact.displacement_variance.value[0]);
    }
}

TEST_CASE("arguments that the theory in d dimensions does not cover are rejected", "[white_noise_plane]") {
  CHECK_THROWS_WITH(WhiteNoise::coulomb(1, 1.0, 0), ContainsSubstring("dimensions must be from 1 to 6, got 0"));
  CHECK_THROWS_WITH(WhiteNoise::coulomb(1, 1.0, 7), ContainsSubstring("dimensions must be from 1 to 6, got 7"));
  CHECK_THROWS_WITH(WhiteNoise(Coulomb(1, 2), 1.0, 2),
                    ContainsSubstring("in 2 dimensions the levels must be equal") && ContainsSubstring("got 1 and 2"));
  CHECK_THROWS_WITH(WhiteNoise(Slider<Coulomb>(Coulomb(1), 2), 1.0, 2),
                    ContainsSubstring("natural_frequency must be 0"));
  CHECK_THROWS_WITH(unit(2).transition_density(0, 1), ContainsSubstring("in one dimension only: dimensions, got 2"));
  CHECK_THROWS_WITH(WhiteNoise::coulomb(0, 1.0, 2).velocity_spectrum(1), ContainsSubstring("must be positive"));
  CHECK_THROWS_WITH(WhiteNoise::coulomb(0, 1.0, 2).velocity_autocovariance(1), ContainsSubstring("must be positive"));
  CHECK_THROWS_WITH(WhiteNoise(Coulomb(1, 2), 1.0).velocity_autocovariance(1), ContainsSubstring("equal levels only"));
  CHECK_THROWS_AS(unit(2).absolute_moment(9, 1), std::invalid_argument);
  CHECK_THROWS_AS(unit(2).predict(std::array<double, 1>{-1}), std::invalid_argument);
  // As a theory it predicts in its own number of dimensions.
  const WhiteNoise plane = unit(2);
  CHECK(plane.name() == "WhiteNoise, 2 dimensions");
  CHECK(WhiteNoise().name() == "WhiteNoise");
  CHECK(plane.covers(Slider(Coulomb(1)), 1.0));
  CHECK_THAT(plane.covers(Slider(Coulomb(1, 2)), 1.0).reason, ContainsSubstring("the levels must be equal"));
  CHECK(plane.predict(Slider(Coulomb(1)), 1 / pi, std::array<double, 1>{3}).velocity_variance.value ==
        at(plane, 3).velocity_variance.value);
}
