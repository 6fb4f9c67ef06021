// White noise: figures 3.1 to 3.3.
#include <algorithm>
#include <numbers>
#include <stickslip/ensemble/run.hpp>
#include <stickslip/excitation/gaussian.hpp>
#include <stickslip/friction/caster.hpp>
#include <stickslip/friction/coulomb.hpp>
#include <stickslip/theory/equivalent_linearization.hpp>
#include <stickslip/theory/stationary_linearization.hpp>
#include <stickslip/theory/white_noise.hpp>

#include "reproduction/figures.hpp"

namespace stickslip::detail {

namespace {

using theory::EquivalentLinearization;
using theory::WhiteNoise;

const Coulomb block(1.0);
Caster caster(double gamma) { return {1.0, 1 / gamma}; }  // gamma = S0^2 / (3l a^3)

std::string of(double gamma) { return gamma == 0 ? "$\\gamma = 0$, Coulomb" : "$\\gamma = " + number(gamma) + "$"; }

Moments linearized(double gamma, bool printed, std::span<const double> times) {
  using Method = EquivalentLinearization;
  const Method method({.force = printed ? Method::Force::thesis : Method::Force::gaussian,
                       .start = printed ? Method::Start::thesis : Method::Start::rest});
  return gamma == 0 ? method.predict(block, 1.0, times) : method.predict(caster(gamma), 1.0, times);
}

// Loads held for dt, which is so short that they are white noise within some 0.3 % (t = 100), less accurately before.
Moments simulated(Thesis& thesis, double gamma, double end) {
  const double dt = end == 1 ? 0.005 : end == 10 ? 0.02 : 0.04;
  const auto samples = static_cast<std::size_t>(std::lround(end / dt)) + 1;
  const std::string what = "gamma = " + number(gamma) + " to t = " + number(end);
  return thesis
      .ensemble(what, thesis.options().members, false,
                [&](const EnsembleOptions& options) {
                  const GaussianExcitation noise(Spectrum::white(1.0), dt, samples,
                                                 {.interpolation = Interpolation::constant,
                                                  .correct_interpolation = false,
                                                  .random_amplitudes = true,
                                                  .zero_frequency = true});
                  return gamma == 0 ? run_ensemble(block, noise, options) : run_ensemble(caster(gamma), noise, options);
                })
      .moments();
}

struct Measure {
  const char *axis, *name;
  Estimates Moments::*figure;
  double (*frictionless)(double t);
};

const Measure of_velocity{"$a^2\\,E[\\dot x^2]/S_0^2$", "velocity variance", &Moments::velocity_variance,
                          [](double t) { return 2 * std::numbers::pi * t; }};  // (3.41)
const Measure of_covariance{"$a^4\\,E[x\\dot x]/S_0^3$", "velocity-displacement covariance", &Moments::covariance,
                            [](double t) { return std::numbers::pi * t * t; }};  // (3.42)
const Measure of_displacement{"$a^6\\,E[x^2]/S_0^4$", "displacement variance", &Moments::displacement_variance,
                              [](double t) { return 2 * std::numbers::pi * t * t * t / 3; }};  // (3.43)

ThesisFigure transient(Thesis& thesis, const char* number, const Measure& measure) {
  ThesisFigure figure{number,
                      std::string("White noise on a caster: ") + measure.name +
                          " from rest, γ = S0²/(3l a³). Dashed: equivalent linearization as in the thesis, (3.32) to "
                          "(3.34). Dash-dotted: with a21 and the exact friction law. Solid: exact (Coulomb). Points: "
                          "simulation with standard errors. Dotted: no friction.",
                      ""};
  ThesisPanel panel{measure.name, "$a^2 t/S_0$", measure.axis, true, true};
  const std::vector<double> times = geometric(0.1, 1000, 81);
  for (const double gamma : {0.0, 0.001, 0.01, 0.1, 1.0}) {
    for (const bool printed : {true, false}) {
      const Moments moments = linearized(gamma, printed, times);
      panel.curves.push_back(
          {of(gamma), printed ? Kind::thesis : Kind::theory, times, (moments.*measure.figure).value});
    }
    if (gamma == 0)
      panel.curves.push_back(
          {of(gamma), Kind::exact, times, (WhiteNoise(block, 1.0).predict(times).*measure.figure).value});
    if (gamma == 0.001) continue;  // as the block, up to t = 100
    Points points(of(gamma), thesis.options().members);
    for (const double end : {1.0, 10.0, 100.0}) {
      const Moments moments = simulated(thesis, gamma, end);
      const std::size_t last = moments.time.size() - 1;
      for (const double part : {0.2, 0.5, 1.0}) {
        const auto at = static_cast<std::size_t>(std::lround(part * static_cast<double>(last)));
        points.add(moments.time[at], {(moments.*measure.figure).value[at], (moments.*measure.figure).error[at]});
      }
    }
    panel.curves.push_back(std::move(points.curve));
  }
  panel.curves.push_back(curve("no friction", Kind::limit, times, measure.frictionless));
  figure.panels.push_back(std::move(panel));
  return figure;
}

Estimate last(const Moments& moments, Estimates Moments::*figure) {
  return {(moments.*figure).value.back(), (moments.*figure).error.back()};
}
// The ratio of linearization with the stationary damping to that with a time-dependent damping: the largest deviation
// of an rms value.
double stationary_damping_off_by(Estimates Moments::*figure) {
  const std::vector<double> times = geometric(0.05, 100, 1000);
  const Moments stationary = theory::StationaryLinearization().predict(block, Spectrum::white(1.0)).transient(times),
                by_time = linearized(0, false, times);
  double largest = 0;
  for (std::size_t i = 0; i < times.size(); ++i)
    largest = std::max(largest, std::abs(std::sqrt((stationary.*figure).value[i] / (by_time.*figure).value[i]) - 1));
  return largest;
}

Estimate over(double value, Estimate e) { return {value / e.value, value * e.error / (e.value * e.value)}; }

constexpr double pi = std::numbers::pi;

}  // namespace

ThesisFigure figure_3_1(Thesis& thesis) {
  ThesisFigure figure = transient(thesis, "3.1", of_velocity);
  const double late[] = {5.0, 1e4};
  const Moments by_linearization = linearized(0, false, late);
  const double stationary = by_linearization.velocity_variance.value[1];
  const WhiteNoise exact(block, 1.0);
  figure.statements.push_back(
      about("(3.45)", "stationary a² E[ẋ²]/S0² by linearization", pi * pi * pi / 2, 1e-6, {stationary}));
  figure.statements.push_back(about("(3.48)", "relative error by which linearization is low, variance", 0.20, 0.01,
                                    {1 - stationary / exact.variance()}, "1 − π/4 = 21.46 %"));
  figure.statements.push_back(about("(3.48)", "relative error by which linearization is low, rms", 0.11, 0.005,
                                    {1 - std::sqrt(stationary / exact.variance())}, "1 − √π/2 = 11.38 %"));
  figure.statements.push_back(
      about("(3.45)", "velocity variance is stationary for t > 5 S0/a²: fraction of it reached at t = 5 S0/a²", 1, 0.02,
            {by_linearization.velocity_variance.value[0] / stationary}, "it takes longer: 90 % at t = 10"));
  const double end[] = {100.0};
  figure.statements.push_back(about(
      "3.5", "equivalent linearization over simulation, velocity variance of the caster of γ = 0.01 at t = 100", 1, 0.2,
      over(linearized(0.01, true, end).velocity_variance.value[0],
           last(simulated(thesis, 0.01, 100), &Moments::velocity_variance)),
      "the thesis has no simulation here; the velocity has heavier tails than a Gaussian, and (3.24) drops a21"));
  figure.statements.push_back(at_most(
      "3.2", "maximum relative difference of stationary and generalized linearization, rms velocity (Ahmadi)", 0.15,
      {stationary_damping_off_by(&Moments::velocity_variance)}, "at t = 1.8; the two agree at short and long times"));
  return figure;
}

ThesisFigure figure_3_2(Thesis& thesis) {
  ThesisFigure figure = transient(thesis, "3.2", of_covariance);
  const double late[] = {5.0, 1e4};
  const Moments by_linearization = linearized(0, false, late);
  const double stationary = by_linearization.covariance.value[1];
  figure.statements.push_back(
      about("(3.46)", "stationary a⁴ E[xẋ]/S0³ by linearization", std::pow(pi, 5) / 4, 1e-4, {stationary}));
  figure.statements.push_back(
      about("(3.46)", "the covariance is stationary for t > 5 S0/a²: fraction of it reached at t = 5 S0/a²", 1, 0.02,
            {by_linearization.covariance.value[0] / stationary}));
  figure.statements.push_back(about("after (3.49)", "linearization's covariance over the exact one, Coulomb", 0.49,
                                    0.005, {stationary / (WhiteNoise(block, 1.0).growth_rate() / 2)}, "π²/20"));
  const EquivalentLinearization method;
  figure.statements.push_back(about("(3.24)", "a21 = 0: for 3l = a = 1 and q11 = 0.5, q12 = 0.3, q22 = 1.2 [1/s²]", 0,
                                    0, {method.coefficients(caster(1.0), 0.5, 0.3, 1.2).a21},
                                    "the kernel is odd in x and in v: a21 has the sign of the correlation of x and v"));
  return figure;
}

ThesisFigure figure_3_3(Thesis& thesis) {
  ThesisFigure figure = transient(thesis, "3.3", of_displacement);
  const WhiteNoise exact(block, 1.0);
  const double late[] = {1e5, 2e5}, end[] = {100.0};
  const Moments by_linearization = linearized(0, false, late);
  const double growth =
      (by_linearization.displacement_variance.value[1] - by_linearization.displacement_variance.value[0]) / 1e5;
  figure.statements.push_back(about("(3.47)", "growth of a⁴ E[x²]/S0³ by linearization", std::pow(pi, 5) / 2, 0.01,
                                    {growth}, "half of Ahmadi's value, as the thesis notes"));
  figure.statements.push_back(about("(3.49)", "exact growth", 10 * pi * pi * pi, 1e-6, {exact.growth_rate()}));
  figure.statements.push_back(
      about("after (3.49)", "growth by linearization over the exact one", 0.49, 0.005, {growth / exact.growth_rate()}));
  figure.statements.push_back(about("(3.47)", "a⁶ E[x²]/S0⁴ of a block at t = 100 by linearization",
                                    std::pow(pi, 5) / 2 * 100, 100,
                                    {linearized(0, false, end).displacement_variance.value[0]},
                                    "(3.47) drops an intercept of 47π²/48 times the growth"));
  // z of (3.30), computed as in the thesis.
  const std::vector<double> around = even(20, 60, 401);
  const Moments way = linearized(0.01, true, around);
  std::size_t passed = 0;
  for (double z = 2; z > 1; ++passed) {
    const double q11 = way.displacement_variance.value[passed], q12 = way.covariance.value[passed],
                 q22 = way.velocity_variance.value[passed];
    z = caster(0.01).reach() * std::sqrt(q22 / (2 * (q11 * q22 - q12 * q12)));
  }
  const theory::TransitionTime transition = theory::transition_time(caster(0.01), 1.0);
  figure.statements.push_back(about("(3.51)", "transition time for γ = 0.01, a² t/S0", transition.thesis,
                                    0.1 * transition.thesis, {around[passed - 1]},
                                    "when z = 1 in the thesis's own equations; with the intercept that (3.51) drops, " +
                                        number(std::round(10 * transition.with_intercept) / 10)));
  figure.statements.push_back(about("after (3.51)", "the transition is earlier than 5 S0/a² for γ above", 5e-2, 0.005,
                                    {1 / std::sqrt(std::pow(pi, 5) * (5 - pi * pi / 4))}));
  figure.statements.push_back(
      about("3.4.3", "linearization over simulation, displacement variance, γ = 0.01, t = 100", 1, 0.2,
            over(linearized(0.01, true, end).displacement_variance.value[0],
                 last(simulated(thesis, 0.01, 100), &Moments::displacement_variance)),
            "while the caster breaks loose; with a21, a third of the simulated variance instead of a fifth"));
  figure.statements.push_back(about(
      "", "linearization with a21 and the exact friction law over simulation, displacement variance, γ = 0.1, t = 100",
      1, 0.1,
      over(linearized(0.1, false, end).displacement_variance.value[0],
           last(simulated(thesis, 0.1, 100), &Moments::displacement_variance)),
      "by then the caster has broken loose"));
  figure.statements.push_back(about("(3.38)",
                                    "the thesis's initial value, q11(0) = 0.01, over the exact q11(0.1) from rest", 0,
                                    0.01, {0.01 / exact.predict(std::vector{0.1}).displacement_variance.value[0]},
                                    "it should be small in comparison; it exceeds q11 up to t = 0.2"));
  figure.statements.push_back(at_most(
      "3.2", "maximum relative difference of stationary and generalized linearization, rms displacement (Ahmadi)", 0.15,
      {stationary_damping_off_by(&Moments::displacement_variance)}, "at t = 3.7; the bound holds for the velocity"));
  return figure;
}

}  // namespace stickslip::detail
