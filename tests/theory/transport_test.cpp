#include "stickslip/theory/transport.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "stickslip/ensemble/run.hpp"
#include "stickslip/excitation/gaussian.hpp"
#include "stickslip/numerics/gauss_legendre.hpp"
#include "stickslip/theory/white_noise.hpp"
#include "theory/transport/chain.hpp"
#include "theory/transport/held_motion.hpp"
#include "theory/transport/load_grid.hpp"
#include "theory/transport/panels.hpp"
#include "theory/transport/spline_density.hpp"

using namespace stickslip;
using std::numbers::pi;
using theory::ShapingFilter;
using theory::Transport;

namespace {

/// Kanai and Tajimi's filter of the given rms acceleration; frequency 1 rad/s unless given.
ShapingFilter kanai_tajimi(double zeta, double rms, double frequency = 1) {
  const double s0 = rms * rms * 2 * zeta / (pi * frequency * (1 + 4 * zeta * zeta));
  return ShapingFilter(s0,
                       {{0, 2 * zeta * frequency, frequency * frequency, 2 * zeta * frequency, frequency * frequency}});
}

/// 20,000 members under Kanai and Tajimi's noise of frequency 1 rad/s, with their moments at 0, the half and the end.
Ensemble simulated(const AnySlider& slider, const ShapingFilter& filter, double zeta, double dt, double end) {
  GaussianOptions options;
  options.random_amplitudes = options.zero_frequency = true;
  const auto samples = static_cast<std::size_t>(std::lround(end / dt)) + 1;
  options.period = 4 * samples;
  EnsembleOptions many;
  many.members = 20'000, many.seed = 1, many.dt = end / 2;
  return run_ensemble(slider, GaussianExcitation(Spectrum::kanai_tajimi(filter.s0(), 1, zeta), dt, samples, options),
                      many);
}

/// The stated error and three standard errors cover the difference.
void near(const Estimates& is, const Estimates& ensemble, std::size_t k) {
  CHECK(std::abs(is.value[k] - ensemble.value[k + 1]) <= is.error[k] + 3 * ensemble.error[k + 1]);
}

}  // namespace

TEST_CASE("panels reproduce polynomials of their degree, and mirror each other") {
  const detail::Panels panels({-2, -0.5, 0, 0.5, 2}, 4);
  CHECK(panels.size() == 17);
  for (std::size_t i = 0; i < panels.size(); ++i) CHECK(panels.node(i) == -panels.node(16 - i));
  CHECK(panels.node(panels.node_at(0)) == 0);
  const auto f = [](double x) { return 1 + x * (2 - x * (1 + x * (0.5 - x))); };
  for (const double x : {-2.0, -1.3, -0.5, -1e-17, 0.0, 0.3, 0.5 + 1e-15, 1.999, 2.0}) {
    const auto at = panels.at(x);
    double value = 0, sum = 0;
    for (std::size_t k = 0; k <= 4; ++k) {
      value += at.weights[k] * f(panels.node(at.first + k));
      sum += at.weights[k];
    }
    CHECK(value == Approx(f(x)).epsilon(1e-14));
    CHECK(sum == Approx(1).epsilon(1e-14));
  }
  CHECK(panels.at(5).first == 12);  // constant beyond the ends
  CHECK(panels.at(5).weights[4] == 1);
}

TEST_CASE("a law on panels is found from its means") {
  // A point mass, and a cubic density, which is a spline: the means of the functions of nodes are exact.
  const detail::Panels panels({-1, -0.4, -0.1, 0, 0.1, 0.3, 1}, 4);
  const auto density = [](double x) { return 0.7 * (x < 0 ? 0.3 + 0.2 * x * x * x : 0.3 + 0.5 * x * (1 - x)); };
  const double mass = 0.3;
  Eigen::VectorXd means = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(panels.size()));
  const auto add = [&](double x, double weight) {
    const auto at = panels.at(x);
    for (std::size_t k = 0; k <= panels.degree(); ++k)
      means[static_cast<Eigen::Index>(at.first + k)] += weight * at.weights[k];
  };
  const std::vector<double>& edges = panels.edges();
  for (std::size_t i = 1; i < edges.size(); ++i)
    numerics::gauss_points<8>(edges[i - 1], edges[i], [&](double x, double weight) { add(x, weight * density(x)); });
  add(0, mass);
  const detail::SplineDensity law(panels, means, 0);
  const auto exact = [&](double x) {
    double sum = x >= 0 ? mass : 0;
    numerics::gauss_points<8>(-1, std::min(x, 0.0), [&](double at, double weight) { sum += weight * density(at); });
    if (x > 0) numerics::gauss_points<8>(0, x, [&](double at, double weight) { sum += weight * density(at); });
    return sum;
  };
  const std::vector<double> points = {-2, -1, -0.7, -0.1, -0.03, 0, 0.05, 0.1, 0.6, 1, 3};
  const std::vector<double> found = law.below(points);
  for (std::size_t i = 0; i < points.size(); ++i)
    CHECK(found[i] == Approx(exact(std::clamp(points[i], -1.0, 1.0))).margin(1e-13));
}

TEST_CASE("a displacement of a block that hardly slips has an atom, and symmetric probabilities") {
  const AnySlider block(Slider<Coulomb>(Coulomb(1.0)));
  const auto d = Transport(0.1).displacement(block, kanai_tajimi(0.5, 0.5), 5);
  CHECK(d.atom() > 0.4);
  CHECK(d.atom() < 0.45);
  CHECK(d.atom_error() < 0.002);
  CHECK(d.quantile(0.5) == 0);
  CHECK(d.cdf(0) - d.cdf(-1e-300) == Approx(d.atom()).margin(1e-6));
  CHECK(d.cdf(1e9) == Approx(1).margin(1e-12));
  CHECK(d.cdf(-1e9) == 0);
  for (const double x : {0.02, 0.1, 0.5}) {
    CHECK(1 - d.cdf(x) == Approx(d.cdf(-x)).epsilon(1e-3));
    CHECK(d.error_at(x) > 0);
    CHECK(d.error_at(x) <= d.error());
  }
  CHECK(d.error_at(1) < 0.1 * d.error());
  CHECK_THROWS_WITH(d.error_at(std::nan("")), Catch::Contains("must be a number"));
}

TEST_CASE("the displacement of a block under strong white noise is nearly that of a free mass, a Gaussian") {
  // Friction takes part of the velocity: sqrt(pi S0 t) >> a t. E[x^2] -> 2 pi S0 t^3 / 3.
  const double s0 = 1000, t = 1;
  const AnySlider block(Slider<Coulomb>(Coulomb(1.0)));
  const auto d = Transport().displacement(block, theory::TwoStateNoise(s0), t);
  const double sd = std::sqrt(d.variance());
  CHECK(d.variance() ==
        Approx(Transport().predict(block, theory::TwoStateNoise(s0), std::array{t}).displacement_variance.value[0])
            .epsilon(2e-3));
  CHECK(sd == Approx(std::sqrt(2 * pi * s0 / 3)).epsilon(0.03));
  CHECK(d.atom() == 0);
  for (const double z : {-3.0, -1.0, 0.0, 0.5, 2.0})
    CHECK(d.cdf(z * sd) == Approx(std::erfc(-z / std::sqrt(2)) / 2).margin(2e-3));
}

TEST_CASE("errors cancel in differences of predictions") {
  // R = (a^2 / wg^3) f(S0 wg / a^2): d ln R / d ln a = 2 - 2 d ln R / d ln S0. Under white noise -4.
  const Transport theory(0.1);
  const auto growth = [&](double level, double rms) {
    return std::log(theory.stationary(Slider(Coulomb(level)), kanai_tajimi(0.5, rms)).growth_rate.value);
  };
  constexpr double part = 0.01;
  const double width = std::log1p(part) - std::log1p(-part);
  const double by_level = (growth(1 + part, 0.8) - growth(1 - part, 0.8)) / width;
  const double by_rms = (growth(1, 0.8 * (1 + part)) - growth(1, 0.8 * (1 - part))) / width;
  CHECK(by_level == Approx(2 - by_rms).epsilon(2e-4));
  const auto white = [&](double level) {
    return std::log(theory.stationary(Slider(Coulomb(level)), theory::TwoStateNoise(1)).growth_rate.value);
  };
  CHECK((white(1 + part) - white(1 - part)) / width == Approx(-4).epsilon(1e-6));
}

TEST_CASE("panels whose functions may jump have two nodes at the edge") {
  const detail::Panels panels({-1, 0, 1}, 3, {0});
  CHECK(panels.size() == 8);
  CHECK(panels.node(3) < 0);
  CHECK(panels.node(3) > -2e-12);
  CHECK(panels.node(4) == -panels.node(3));
  const auto sign = [&](double x) {
    const auto at = panels.at(x);
    double value = 0;
    for (std::size_t k = 0; k <= 3; ++k) value += at.weights[k] * (panels.node(at.first + k) < 0 ? -1 : 1);
    return value;
  };
  for (const double x : {1e-15, 0.1, 0.7, 3.0}) {
    CHECK(sign(x) == Approx(1).epsilon(1e-14));
    CHECK(sign(-x) == Approx(-1).epsilon(1e-14));
  }
}

TEST_CASE("the step of a filter has the moments of its exact solution") {
  // E[u v] of a pair a step apart is the transition matrix, and the stationary noise stays stationary.
  const detail::FilterStates noise(kanai_tajimi(0.4, 2.0, 3.0));
  CHECK(noise.rms == Approx(2).epsilon(1e-14));
  const double step = 0.15;
  const detail::LoadGrid grid(noise, detail::Panels({-11, -6, -1, 0, 1, 6, 11}, 6), 9, step);
  const Eigen::VectorXd& p = grid.start();
  const auto hidden = static_cast<std::size_t>(p.size()) / grid.loads();
  const Eigen::MatrixXd& adjoint_step = *grid.adjoint_step();
  CHECK(p.sum() == Approx(1).epsilon(1e-14));
  const auto mean = [&](const Eigen::VectorXd& weights, auto&& f) {
    double sum = 0;
    for (std::size_t i = 0; i < grid.loads(); ++i)
      for (std::size_t j = 0; j < hidden; ++j)
        sum += weights[static_cast<Eigen::Index>(i * hidden + j)] * f(grid.load(i));
    return sum;
  };
  CHECK(mean(p, [](double n) { return n * n; }) == Approx(4).epsilon(1e-6));
  CHECK(mean(p, [](double n) { return n * n * n * n; }) == Approx(48).epsilon(1e-5));
  const Eigen::VectorXd later = adjoint_step * (adjoint_step * p);
  CHECK(later.sum() == Approx(1).epsilon(1e-13));
  CHECK(mean(later, [](double n) { return n * n; }) == Approx(4).epsilon(1e-6));
  Eigen::VectorXd times_load = p;
  for (std::size_t i = 0; i < grid.loads(); ++i)
    times_load.segment(static_cast<Eigen::Index>(i * hidden), static_cast<Eigen::Index>(hidden)) *= grid.load(i);
  const double correlation = mean(adjoint_step * times_load, [](double n) { return n; });
  CHECK(correlation == Approx(4 * noise.transition(step)(0, 0)).epsilon(1e-6));
  // By Euler steps: the transition solves dE/dt = rate E.
  Eigen::Matrix2d e = Eigen::Matrix2d::Identity();
  for (int i = 0; i < 100'000; ++i) e += noise.rate * e * (step / 1e5);
  CHECK((e - noise.transition(step)).norm() < 1e-5);
}

TEST_CASE("loads of pulses have the moments of a compound Poisson process") {
  // Cumulants of the load of an up and a down step of a half width: 2 rate E[b^k] for even k.
  const double rate = 0.5, sigma = 1.2;
  for (const std::size_t slots : {1U, 2U}) {
    const double slot = 1.0 / static_cast<double>(slots), none = std::exp(-rate * slot);
    detail::pulse_chain::Weights batch = detail::pulse_chain::Arrivals{rate, sigma}.batch(slot, 0.8 * sigma, 16);
    batch[0] -= none;
    const detail::LoadGrid grid(batch, none, slots, batch);
    double second = 0, fourth = 0, sum = 0;
    for (std::size_t i = 0; i < grid.loads(); ++i) {
      const double weight = grid.weight(i, grid.start().data()), n = grid.load(i);
      sum += weight, second += weight * n * n, fourth += weight * n * n * n * n;
      // Means over the neighborhood of a load keep polynomials, those that the quadrature finds exactly up to the
      // fourth degree.
      double one = 0, power = 0;
      grid.average(i, {n + 0.3 * grid.reach(i)},
                   [&](double at, double part) { one += part, power += part * std::pow(at, 4); });
      CHECK(one == Approx(1).epsilon(1e-12));
      CHECK(power == Approx(std::pow(n, 4)).epsilon(1e-10).margin(1e-9));
    }
    const double variance = 2 * rate * sigma * sigma;
    CHECK(sum == Approx(1).epsilon(1e-12));
    CHECK(second == Approx(variance).epsilon(1e-6));
    CHECK(fourth == Approx(3 * variance * variance + 2 * rate * 3 * std::pow(sigma, 4)).epsilon(1e-5));
  }
}

TEST_CASE("a prediction under pulses scales with the units, and a soft spring leaves the block alone", "[long]") {
  const std::vector<double> times{4, 9.5}, scaled{1, 9.5 / 4};
  const Transport theory(0.1);
  const auto one = theory.predict(Slider(Coulomb(1.0)), PoissonPulses(0.6, 1, 1.1, 10), times);
  const auto other = theory.predict(Slider(Coulomb(0.5)), PoissonPulses(2.4, 0.25, 0.55, 2.5), scaled);
  const auto soft = theory.predict(Slider(Coulomb(1.0), 0.02), PoissonPulses(0.6, 1, 1.1, 10), times);
  const double length = 0.5 / 16;
  for (const std::size_t k : {0U, 1U}) {
    CHECK(other.displacement_variance.value[k] ==
          Approx(length * length * one.displacement_variance.value[k]).epsilon(1e-9));
    CHECK(std::abs(soft.displacement_variance.value[k] - one.displacement_variance.value[k]) <
          soft.displacement_variance.error[k] + one.displacement_variance.error[k]);
  }
  CHECK_THAT(one.remark, Catch::Contains("lattice of times"));
  const auto v = one.velocity(9.5), scaled_v = other.velocity(9.5 / 4);
  CHECK(scaled_v.atom() == Approx(v.atom()).epsilon(1e-9));
  CHECK(scaled_v.cdf(0.3 * 0.5 / 4) == Approx(v.cdf(0.3)).epsilon(1e-9));
  CHECK(v.cdf(-0.3) == Approx(1 - v.cdf(0.3)).margin(1e-9));
}

TEST_CASE("probability is conserved over hundreds of steps") {
  const detail::FilterStates noise(kanai_tajimi(0.5, 1.5));
  const detail::HeldMotion block(Slider(Coulomb(1.0))), sprung(Slider(Coulomb(1.0, 1.7), 0.8));
  const detail::Panels load({-6.75, -3, -1, 0, 1, 3, 6.75}, 4), v({0, 0.3, 0.8, 2, 5, 12}, 4, {0});
  const detail::Panels both({-12, -5, -2, -0.8, -0.3, 0, 0.3, 0.8, 2, 5, 12}, 3, {0}), x({-8, -4, 0, 4, 8}, 3);
  const detail::Chain one(block, {}, v, {noise, load, 7, 0.3}, 0.3), other(sprung, x, both, {noise, load, 5, 0.3}, 0.3);
  for (const auto* chain : {&one, &other}) {
    Eigen::VectorXd p = chain->start();
    for (int k = 0; k < 300; ++k) p = chain->carry(p);
    CHECK(std::abs(p.sum() - 1) < 1e-12);
  }
  CHECK(one.mirrored());
  CHECK(!other.mirrored());
}

TEST_CASE("growth and variance under white noise converge to the exact moments") {
  // R = 10 pi^3, V = 2 pi^2 for a = S0 = 1, thesis (3.48), (3.49).
  const auto exact = theory::WhiteNoise::coulomb(1, 1);
  const std::vector<double> times{3, 30};
  const Moments expected = exact.predict(times);
  for (const double tolerance : {1e-2, 1e-4, 1e-6}) {
    const auto found = Transport(tolerance).predict(Slider(Coulomb(1.0)), 1.0, times);
    CHECK(found.growth_rate.value == Approx(exact.growth_rate()).epsilon(tolerance));
    CHECK(std::abs(found.growth_rate.value - exact.growth_rate()) <= found.growth_rate.error);
    CHECK(found.velocity_variance.value[1] == Approx(expected.velocity_variance.value[1]).epsilon(tolerance));
    CHECK(found.displacement_variance.value[1] == Approx(expected.displacement_variance.value[1]).epsilon(tolerance));
    CHECK(found.covariance.value[1] == Approx(expected.covariance.value[1]).epsilon(10 * tolerance));
    for (const double mean : found.displacement_mean.value) CHECK(mean == 0);
  }
}

TEST_CASE("unequal and one-way levels under white noise drift as they must") {
  for (const double backward : {1.5, std::numeric_limits<double>::infinity()}) {
    const theory::WhiteNoise exact(Coulomb(1.0, backward), 0.7);
    const std::vector<double> times{5, 20};
    const Moments expected = exact.predict(times);
    const auto found = Transport().predict(Slider(Coulomb(1.0, backward)), 0.7, times);
    CHECK(found.growth_rate.value == Approx(exact.growth_rate()).epsilon(0.01));
    for (const std::size_t k : {0U, 1U}) {
      CHECK(found.displacement_mean.value[k] == Approx(expected.displacement_mean.value[k]).epsilon(0.01));
      CHECK(found.velocity_mean.value[k] == Approx(expected.velocity_mean.value[k]).epsilon(0.01));
      CHECK(found.displacement_variance.value[k] == Approx(expected.displacement_variance.value[k]).epsilon(0.01));
      CHECK(found.velocity_variance.value[k] == Approx(expected.velocity_variance.value[k]).epsilon(0.01));
    }
  }
}

TEST_CASE("moments long after the start keep the exact growth, and early ones their errors") {
  for (const double backward : {1.0, 2.0}) {
    const std::vector<double> times{0.1, 1, 3000};
    const Moments exact = theory::WhiteNoise(Coulomb(1.0, backward), 1.0).predict(times);
    const auto found = Transport(1e-4).predict(Slider(Coulomb(1.0, backward)), 1.0, times);
    for (Estimates Moments::*const figure : {&Moments::displacement_variance, &Moments::covariance})
      for (const std::size_t k : {0U, 1U, 2U}) {
        const Estimates &is = found.*figure, &must_be = exact.*figure;
        CHECK(is.value[k] == Approx(must_be.value[k]).epsilon(1e-5));
        CHECK(std::abs(is.value[k] - must_be.value[k]) <= is.error[k]);
      }
  }
}

TEST_CASE("a prediction scales with the units of length and time", "[long]") {
  const std::vector<double> times{2, 7}, scaled{2 / 5.0, 7 / 5.0};
  const auto one = Transport(0.05).predict(Slider(Coulomb(1.0), 0.7), kanai_tajimi(0.5, 1.2), times);
  const auto other = Transport(0.05).predict(Slider(Coulomb(0.3), 3.5), kanai_tajimi(0.5, 0.36, 5.0), scaled);
  const double length = 0.3 / 25, speed = 0.3 / 5;
  for (const std::size_t k : {0U, 1U}) {
    CHECK(other.displacement_variance.value[k] ==
          Approx(length * length * one.displacement_variance.value[k]).epsilon(1e-9));
    CHECK(other.velocity_variance.value[k] == Approx(speed * speed * one.velocity_variance.value[k]).epsilon(1e-9));
  }
}

TEST_CASE("a spring with little friction and a damper is the linear oscillator", "[long]") {
  // Under white noise of level S0: E[x'^2] = pi S0 / c, E[x^2] = pi S0 / (c wn^2). Friction of level a takes the power
  // a E|x'|, so that it changes the variance by some a / (c rms x').
  const double s0 = 1, wn = 2, c = 0.8, a = 1e-3;
  const auto found = Transport(0.02).stationary(Slider(Coulomb(a), wn, c), s0);
  CHECK(found.velocity_variance.value == Approx(pi * s0 / c).epsilon(0.02 + 2 * a / (c * std::sqrt(pi / c))));
  CHECK(found.displacement_variance.value == Approx(pi * s0 / (c * wn * wn)).epsilon(0.022));
  CHECK(found.rest.value == 0);
}

TEST_CASE("a soft spring leaves the block alone", "[long]") {
  const ShapingFilter filter = kanai_tajimi(0.6, 1.0);
  const std::vector<double> times{10};
  const auto free = Transport(0.03).predict(Slider(Coulomb(1.0)), filter, times);
  const auto soft = Transport(0.03).predict(Slider(Coulomb(1.0), 0.01), filter, times);
  CHECK(soft.displacement_variance.value[0] ==
        Approx(free.displacement_variance.value[0])
            .epsilon(0.002)
            .margin(soft.displacement_variance.error[0] + free.displacement_variance.error[0]));
  CHECK(soft.velocity_variance.value[0] ==
        Approx(free.velocity_variance.value[0])
            .epsilon(0.002)
            .margin(soft.velocity_variance.error[0] + free.velocity_variance.error[0]));
}

TEST_CASE("white noise that is held is predicted as sampled") {
  // From rest, a first value n held for dt leaves the block at rest if |n| < a, and moves it by (|n| - a) dt^2 / 2.
  const double dt = 0.5, a = 1, deviation = std::sqrt(2 * pi / dt), y = a / deviation;
  GaussianOptions options;
  options.interpolation = Interpolation::constant;
  options.correct_interpolation = false;
  options.zero_frequency = true;
  const GaussianExcitation held(Spectrum::white(1), dt, 101, options);
  CHECK(theory::TwoStateNoise(held).held() == dt);
  const std::vector<double> times{dt};
  const auto found = Transport(1e-4).predict(Slider(Coulomb(a)), held, times);
  const double density = std::exp(-y * y / 2) / std::sqrt(2 * pi), beyond = std::erfc(y / std::numbers::sqrt2) / 2;
  const double square = 2 * deviation * deviation * ((1 + y * y) * beyond - y * density);  // E[(|n| - a)+^2]
  CHECK(found.velocity_variance.value[0] == Approx(square * dt * dt).epsilon(1e-10));
  CHECK(found.displacement_variance.value[0] == Approx(square * dt * dt * dt * dt / 4).epsilon(1e-10));
}

TEST_CASE("a level that the load never reaches does not matter") {
  const ShapingFilter filter = kanai_tajimi(0.6, 1.0);
  const std::vector<double> times{10};
  const auto one_way =
      Transport(0.05).predict(Slider(Coulomb(1.0, std::numeric_limits<double>::infinity())), filter, times);
  const auto high = Transport(0.05).predict(Slider(Coulomb(1.0, 1e9)), filter, times);
  CHECK(high.displacement_mean.value[0] == Approx(one_way.displacement_mean.value[0]).epsilon(1e-4));
  CHECK(high.displacement_variance.value[0] == Approx(one_way.displacement_variance.value[0]).epsilon(1e-4));
}

TEST_CASE("a one-way mounting is an infinite backward level") {
  const ShapingFilter filter = kanai_tajimi(0.6, 1.0);
  const std::vector<double> times{3, 10};
  const double inf = std::numeric_limits<double>::infinity();
  const Mounting one_way{.one_way = true};
  const auto same = [&](const AnySlider& mounted, const AnySlider& infinite,
                        const theory::TransportExcitation& excitation) {
    const auto one = Transport(0.1).predict(mounted, excitation, times);
    const auto other = Transport(0.1).predict(infinite, excitation, times);
    CHECK(one.displacement_mean.value[1] > 0);
    for (Estimates Moments::*const figure : {&Moments::displacement_mean, &Moments::displacement_variance,
                                             &Moments::velocity_mean, &Moments::velocity_variance})
      for (const std::size_t k : {0U, 1U})
        CHECK((one.*figure).value[k] == Approx((other.*figure).value[k]).epsilon(1e-9));
  };
  same(Slider(Coulomb(1.0), one_way), Slider(Coulomb(1.0, inf)), theory::TwoStateNoise(filter));
  same(Slider(Coulomb(1.0), one_way), Slider(Coulomb(1.0, inf)), theory::TwoStateNoise(1.0));
  same(Slider(Coulomb(1.0), one_way), Slider(Coulomb(1.0, inf)), PoissonPulses(0.6, 1, 1.1, 10));
  same(Slider(StaticKinetic<Coulomb>(Coulomb(1.0), 1.2), one_way),
       Slider(StaticKinetic<Coulomb>(Coulomb(1.0, inf), 1.2, inf)), theory::TwoStateNoise(filter));
}

TEST_CASE("friction on a slope is the ground acceleration that just moves the slider") {
  const Mounting slope{.slope_degrees = 20};
  for (const AnySlider& slider :
       {AnySlider(Slider(Coulomb::from_friction(0.5), slope)), AnySlider(Slider(Stribeck(6.0, 5.0, 0.2, 1), slope)),
        AnySlider(Slider(StaticKinetic<Coulomb>(Coulomb::from_friction(0.45), 5.0), slope)),
        AnySlider(Slider(StaticKinetic<Coulomb>(Coulomb::from_friction(0.45), 5.0),
                         Mounting{.slope_degrees = 20, .one_way = true}))}) {
    const detail::HeldMotion motion(slider);
    const double forward = motion.hold(Direction::forward), backward = motion.hold(Direction::backward);
    CHECK(backward > forward);
    CHECK(motion(0, 0, -forward * (1 - 1e-9), 0.1).displacement == 0);
    CHECK(motion(0, 0, -forward * (1 + 1e-9), 0.1).displacement > 0);
    if (!std::isfinite(backward)) {
      CHECK(motion(0, 0, 1e3, 0.1).displacement == 0);
    } else {
      CHECK(motion(0, 0, backward * (1 - 1e-9), 0.1).displacement == 0);
      CHECK(motion(0, 0, backward * (1 + 1e-9), 0.1).displacement < 0);
    }
    // Friction while sliding: no acceleration at the load that it resists.
    CHECK(motion(0, 1e-9, -motion.start(Direction::forward), 1e-6).velocity == Approx(1e-9).epsilon(1e-3));
    CHECK(!motion.mirrors());
    if (!motion.breaks_away()) continue;
    const detail::HeldMotion less = motion.holding_less(0.05);
    CHECK(less.hold(Direction::forward) == Approx(forward - 0.05).epsilon(1e-12));
    CHECK((!std::isfinite(backward) || less.hold(Direction::backward) == Approx(backward - 0.05).epsilon(1e-12)));
    CHECK(less.start(Direction::forward) == Approx(motion.start(Direction::forward)).epsilon(1e-12));
  }
  // Too rough to slide backward, however large the load.
  CHECK(!std::isfinite(detail::HeldMotion(Slider(Coulomb::from_friction(1.1), Mounting{.slope_degrees = 45}))
                           .hold(Direction::backward)));
}

TEST_CASE("a slider on a slope moves as an ensemble does", "[long]") {
  // A slope of 20 degrees: slip levels of 1.1 and 10 m/s^2. 20,000 members; three standard errors.
  const Slider slider(Coulomb(4.9), Mounting{.slope_degrees = 20});
  const double rms = 1.2, zeta = 0.6, dt = 0.05;
  const ShapingFilter filter = kanai_tajimi(zeta, rms);
  const Ensemble ensemble = simulated(slider, filter, zeta, dt, 20);
  const auto found = Transport(0.02).predict(slider, filter, std::vector<double>{10, 20});
  for (const std::size_t k : {0U, 1U}) {
    near(found.displacement_mean, ensemble.displacement_mean(), k);
    near(found.displacement_variance, ensemble.displacement_variance(), k);
    near(found.velocity_variance, ensemble.velocity_variance(), k);
  }
}

TEST_CASE("times far below a step have moments of their own") {
  // At first the load is what it was at the start: E[x'^2] = t^2 E[(|n| - a)+^2], E[x^2] = t^2 / 4 of it.
  const double t = 1e-5, y = 1;
  const auto found = Transport(0.05).predict(Slider(Coulomb(1.0)), kanai_tajimi(0.6, 1.0), std::vector<double>{t});
  const double density = std::exp(-y * y / 2) / std::sqrt(2 * pi), beyond = std::erfc(y / std::numbers::sqrt2) / 2;
  const double square = 2 * ((1 + y * y) * beyond - y * density);
  CHECK(found.velocity_variance.value[0] == Approx(square * t * t).epsilon(0.01));
  CHECK(found.displacement_variance.value[0] == Approx(square * t * t * t * t / 4).epsilon(0.01));
  CHECK(found.growth_rate.value > 0);
}

TEST_CASE("laws that are Coulomb's in a limit have its moments", "[long]") {
  const std::vector<double> times{5, 20};
  const ShapingFilter filter = kanai_tajimi(0.6, 1.2);
  const auto near = [&](const Moments& found, const Moments& expected, double tolerance, double errors) {
    for (const std::size_t k : {0U, 1U})
      for (Estimates Moments::*const figure : {&Moments::displacement_variance, &Moments::velocity_variance}) {
        const Estimates &one = found.*figure, &other = expected.*figure;
        CHECK(std::abs(one.value[k] - other.value[k]) <=
              tolerance * other.value[k] + errors * (one.error[k] + other.error[k]));
      }
  };
  const Transport theory(0.03);
  const auto block = theory.predict(Slider(Coulomb(1.0)), filter, times);
  // The same grid, or one for friction that does not change over the speeds that it resolves.
  near(theory.predict(Slider(StaticKinetic<Coulomb>(Coulomb(1.0), 1.0)), filter, times), block, 1e-12, 0);
  near(theory.predict(Slider(VelocityDependent(0.5, 1.0, 0.0)), filter, times),
       theory.predict(Slider(Coulomb(0.5)), filter, times), 1e-9, 0);
  near(theory.predict(Slider(Stribeck(1.0, 1.0, 0.3, 1)), filter, times), block, 0, 1);
  // A level that rises at once, by a speed far below all others.
  near(theory.predict(Slider(VelocityDependent(0.99, 1.0, 50.0)), filter, times), block, 0.005, 1);
  near(theory.predict(Slider(Caster(1.0, std::numeric_limits<double>::infinity())), 1.0, times),
       theory.predict(Slider(Coulomb(1.0)), 1.0, times), 1e-9, 0);
}

TEST_CASE("a caster of short reach is a free mass, one of long reach a block", "[long]") {
  // Without friction E[x'^2] = 2 pi S0 t and E[x^2] = 2 pi S0 t^3 / 3. Friction takes at most the work pi a r of a
  // crossing of its reach.
  const double t = 4, reach = 0.5;
  const auto loose = Transport(0.1).predict(Slider(Caster(1.0, reach)), 1.0, std::vector<double>{t});
  const double speed = std::sqrt(2 * pi * t), distance = speed * t / std::sqrt(3.0),
               lost = pi * reach / (speed * speed);
  CHECK(loose.velocity_variance.value[0] ==
        Approx(speed * speed).epsilon(2 * lost).margin(loose.velocity_variance.error[0]));
  CHECK(loose.displacement_variance.value[0] ==
        Approx(distance * distance).epsilon(8 * lost).margin(loose.displacement_variance.error[0]));
  CHECK(std::isnan(loose.growth_rate.value));
  // Far from its edge, sech(x / r) is 1 - x^2 / 2 r^2.
  const auto held = Transport(0.02).predict(Slider(Caster(1.0, 5000.0)), 1.0, std::vector<double>{t});
  const auto block = theory::WhiteNoise::coulomb(1, 1).predict(std::vector<double>{t});
  const double ratio = block.displacement_variance.value[0] / (5000.0 * 5000.0);
  CHECK(held.displacement_variance.value[0] ==
        Approx(block.displacement_variance.value[0]).margin(held.displacement_variance.error[0]).epsilon(5 * ratio));
}

TEST_CASE("a caster under filtered noise moves as an ensemble does", "[long]") {
  // It leaves its reach of 2 a / wg^2 meanwhile. 20,000 members; three standard errors.
  const double rms = 1.5, zeta = 0.6, dt = 0.05;
  const Slider slider(Caster(1.0, 2.0));
  const ShapingFilter filter = kanai_tajimi(zeta, rms);
  const Ensemble ensemble = simulated(slider, filter, zeta, dt, 8);
  const auto found = Transport(0.3).predict(slider, filter, std::vector<double>{4, 8});
  CHECK(std::isnan(found.growth_rate.value));
  for (const std::size_t k : {0U, 1U}) {
    near(found.displacement_variance, ensemble.displacement_variance(), k);
    near(found.covariance, ensemble.covariance(), k);
    near(found.velocity_variance, ensemble.velocity_variance(), k);
  }
  CHECK(found.displacement_variance.error[1] < 0.05 * found.displacement_variance.value[1]);
}

TEST_CASE("a caster breaks loose at the time of prototypes and ensembles", "[long]") {
  // z = 1, thesis (3.50), for gamma = S0^2 / (3 l a^3) = 0.01: at 32.78 by an independent program; (3.51) has 35.1.
  const double reach = 100, t = 32.78;
  const auto found = Transport().predict(Slider(Caster(1.0, reach)), 1.0, std::vector<double>{t});
  const double xx = found.displacement_variance.value[0], vv = found.velocity_variance.value[0],
               xv = found.covariance.value[0];
  const double z = reach * std::sqrt(vv / (2 * (xx * vv - xv * xv)));
  CHECK(z == Approx(1).epsilon(0.002));
}

TEST_CASE("static friction on a spring moves as an ensemble does", "[long]") {
  const double rms = 1.5, zeta = 0.4;
  const Slider slider(StaticKinetic<Coulomb>(Coulomb(1.0), 1.5), 1.0);
  const ShapingFilter filter = kanai_tajimi(zeta, rms);
  const Ensemble ensemble = simulated(slider, filter, zeta, 0.0125, 10);
  const auto found = Transport(0.3).predict(slider, filter, std::vector<double>{5, 10});
  for (const std::size_t k : {0U, 1U}) {
    near(found.displacement_variance, ensemble.displacement_variance(), k);
    near(found.velocity_variance, ensemble.velocity_variance(), k);
    CHECK(found.velocity_variance.error[k] >= 0.0399 * found.velocity_variance.value[k]);
  }
}

TEST_CASE("static friction makes slips rarer", "[long]") {
  const std::vector<double> times{20};
  double before = 1e300;
  for (const double level : {1.0, 1.3, 1.7}) {
    const auto found =
        Transport(0.03).predict(Slider(StaticKinetic<Coulomb>(Coulomb(1.0), level)), kanai_tajimi(0.6, 0.8), times);
    CHECK(found.velocity_variance.value[0] < before);
    before = found.velocity_variance.value[0];
  }
}

TEST_CASE("what is not covered is refused with the reason") {
  const Transport theory;
  const Slider block(Coulomb(1.0));
  CHECK(theory.covers(block, 1.0));
  CHECK(theory.covers(block, kanai_tajimi(0.5, 1)));
  CHECK(theory.covers(block, Spectrum::kanai_tajimi(1, 10, 0.5)));
  CHECK(theory.covers(Slider(Coulomb(1.0, 2.0), 3, 0.1), 1.0));
  const auto why = [&](const auto& slider, const auto& excitation) { return theory.covers(slider, excitation).reason; };
  using Catch::Contains;
  CHECK_THAT(why(Slider(Coulomb(0.0)), 1.0), Contains("forward slip level must be positive and finite, got 0"));
  CHECK_THAT(why(block, Spectrum::clough_penzien(1, 10, 0.5, 2, 0.5)), Contains("filters of two states"));
  CHECK_THAT(why(block, ShapingFilter(1, {{1, 0, 1, 1, 1}})), Contains("b2 must be 0, got 1"));
  CHECK_THAT(why(Slider(Coulomb(1.0), Mounting{.stops = Stops(1, 0.5)}), 1.0), Contains("without stops"));
  const Slider sloped(Coulomb(2.0), Mounting{.slope_degrees = 5});
  CHECK(theory.covers(sloped, kanai_tajimi(0.5, 1)));
  CHECK_THAT(why(sloped, 1.0), Contains("white noise lifts a slider off a slope"));
  CHECK_THAT(why(Slider(Coulomb(8.0), Mounting{.slope_degrees = 30}), kanai_tajimi(0.5, 4)),
             Contains("at most g / (4.5 tan(slope)) = 3.77"));
  CHECK_THAT(why(Slider(VelocityDependent(2.0, 0.5, 1.0), sloped.mounting()), kanai_tajimi(0.5, 1)),
             Contains("least resistance to sliding at any speed must be positive, got -0.3"));
  CHECK_THAT(why(block, kanai_tajimi(0.5, 0.3)), Contains("must be at least 0.35, below which slips are too rare"));
  CHECK_THAT(why(block, kanai_tajimi(0.05, 1)), Contains("damping ratio of the filter must be from 0.1 to 1.5"));
  CHECK_THAT(why(Slider(Coulomb(1.0), 5.1), kanai_tajimi(0.5, 1)), Contains("at most 5 times the frequency"));
  CHECK_THAT(why(Slider(Coulomb(1.0, 11.0)), 1.0), Contains("at most 10 times the other, or infinite"));
  CHECK_THAT(why(Slider(Coulomb(10.0), 1.0), 1.0), Contains("natural_frequency times pi S0 / a^2 must be at least"));
  CHECK(theory.covers(Slider(Caster(1.0, 10.0)), 1.0));
  CHECK(theory.covers(Slider(Stribeck(1.5, 1.0, 0.1, 2), 1.0), kanai_tajimi(0.5, 1)));
  const Slider sticky(StaticKinetic<Coulomb>(Coulomb(1.0), 1.5));
  CHECK(theory.covers(sticky, kanai_tajimi(0.5, 1)));
  CHECK_THAT(why(sticky, 1.0), Contains("exceeds any friction at rest at once"));
  const auto held = [&](double level, double wn, double rms, double zeta) {
    return Transport(0.1)
        .covers(Slider(StaticKinetic<Coulomb>(Coulomb(1.0), level), wn), kanai_tajimi(zeta, rms))
        .reason;
  };
  CHECK(held(1.5, 1, 1, 0.5).empty());
  CHECK_THAT(held(2.1, 1, 1, 0.5), Contains("at most twice the kinetic one, got 2.1"));
  CHECK_THAT(held(1.5, 3.1, 1, 0.5), Contains("at most 3 times the frequency"));
  CHECK_THAT(held(1.5, 1, 0.6, 0.5), Contains("must be from 0.7 to 3, got 0.6"));
  CHECK_THAT(held(1.5, 1, 1, 1.0), Contains("must be from 0.3 to 0.9, got 1"));
  CHECK_THAT(why(Slider(sticky.law(), 1.0), kanai_tajimi(0.5, 1)), Contains("needs a tolerance of at least 0.05"));
  CHECK(theory.covers(Slider(Caster(1.0, 10.0)), kanai_tajimi(0.5, 1)));
  CHECK_THAT(why(Slider(Caster(1.0, 0.9)), kanai_tajimi(0.5, 1)), Contains("must be at least a / wg^2 = 1 m, got 0.9"));
  CHECK_THAT(why(Slider(Caster(1.0, 10.0)), kanai_tajimi(0.5, 6.1)), Contains("of a caster must be from 0.7 to 6"));
  CHECK_THAT(why(Slider(Caster(1.0, 10.0)), kanai_tajimi(0.2, 1)), Contains("must be from 0.3 to 0.9, got 0.2"));
  CHECK_THAT(why(Slider(Caster(1.0, 10.0)), ShapingFilter(0.3, {{0, 1, 0, 1, 1}})),
             Contains("content at zero frequency"));
  CHECK_THAT(why(Slider(Caster(1.0, 10.0), 0.5), kanai_tajimi(0.5, 1)), Contains("filtered noise without a spring"));
  CHECK_THAT(why(Slider(Caster(2.0, 10.0), Mounting{.slope_degrees = 5}), kanai_tajimi(0.5, 1)),
             Contains("casters on a slope"));
  CHECK_THAT(why(Slider(Caster(1.0, 10.0), 0.9), 1.0), Contains("of at least 3 pi S0 = 9.42"));
  CHECK_THAT(why(Slider(Degrading({0, 1}, {1, 0.5})), 1.0), Contains("does not cover laws with memory"));
  CHECK_THROWS_WITH(theory.stationary(Slider(Caster(1.0, 10.0)), 1.0), Contains("does not become stationary"));
  const PoissonPulses pulses(0.5, 1, 1, 20);
  CHECK(theory.covers(block, pulses));
  CHECK(theory.covers(Slider(Stribeck(1.5, 1.0, 0.1, 2), 1.0, 0.1), pulses));
  CHECK_THAT(why(block, PoissonPulses(0.5, 1, 0.2, 20)), Contains("over the lower slip level must be from 0.3 to 6"));
  CHECK_THAT(why(block, PoissonPulses(0.02, 1, 2, 20)), Contains("in a half width must be from 0.03 to 10, got 0.02"));
  CHECK_THAT(why(block, PoissonPulses(0.1, 1, 0.5, 20)), Contains("must be at least 0.25, below which slips are too"));
  CHECK_THAT(why(Slider(Coulomb(1.0), 4), pulses),
             Contains("times the half width of a pulse must be at most 3, got 4"));
  CHECK_THAT(why(sticky, pulses), Contains("static friction above kinetic under noise"));
  CHECK_THAT(why(Slider(Caster(1.0, 10.0)), pulses), Contains("casters under white noise alone"));
  const std::vector<double> early{0, 1.9, 4};
  CHECK_THROWS_WITH(theory.predict(block, pulses, early),
                    Contains("must be 0 or at least 2 s") && Contains("got 1.9 s"));
  CHECK_THROWS_WITH(theory.displacement(block, pulses, 1.5), Contains("must be 0 or at least 2 s"));
  CHECK_THROWS_WITH(Transport(0.5), Contains("tolerance must be from 1e-6 to 0.3, got 0.5"));
  CHECK_THROWS_WITH(theory.predict(block, 1.0, std::vector<double>{2, 1}), Contains("times must increase"));
}
