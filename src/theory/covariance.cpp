#include "theory/covariance.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numbers>
#include <string>
#include <variant>

#include "numerics/ode.hpp"
#include "stickslip/base/error.hpp"
#include "theory/linear_friction.hpp"
#include "theory/theory_moments.hpp"

namespace stickslip::detail {
namespace {

using std::numbers::pi;
using Start = theory::EquivalentLinearization::Start;

const std::string noun = "EquivalentLinearization";

/// 1 - sin(z) / z.
double one_less_sinc(double z) {
  if (z > 1) return 1 - std::sin(z) / z;
  double term = z * z / 6, sum = term;
  for (int k = 4; std::abs(term) > 1e-17 * sum; k += 2) sum += term *= -z * z / (k * (k + 1));
  return sum;
}

/// Whether the law is without friction, so that there is a closed form.
bool frictionless(const LinearizedLaw& law) {
  const auto* const coulomb = std::get_if<Coulomb>(&law);
  const auto* const wheel = std::get_if<Caster>(&law);
  return coulomb != nullptr ? coulomb->forward() == 0 && coulomb->backward() == 0
                            : wheel != nullptr && wheel->slip_level() == 0;
}

/// The slip level at x = 0 with which a Gaussian velocity would be linearized.
double level_at_rest(const LinearizedLaw& law, theory::EquivalentLinearization::Force force) {
  if (const auto* const any = std::get_if<std::function<double(double, Direction)>>(&law))
    return (*any)(0, Direction::forward);
  if (const auto* const wheel = std::get_if<Caster>(&law)) return wheel->slip_level();
  return std::get<Coulomb>(law).forward() *
         (force == theory::EquivalentLinearization::Force::laplace ? std::sqrt(pi) / 2 : 1);
}

// Two states under stationary white noise have their own equations instead of those of shaped_covariance.cpp: scale
// free, valid from the first instant, and without a Jacobian, they are 50 times faster.
//
// The covariance in the variables of the integration: logarithms of q11 and q22 relative to those without friction or
// spring, (3.43) and (3.41), and the correlation between them. Their frictionless values are 0, sqrt(3) / 2 and 0.
struct Variables {
  double ln_r11, c, ln_r22;
};

Variables variables(const Covariance& q, double s0, double t) {
  return {std::log(q.q11 / t / t * (3 / (2 * pi)) / (s0 * t)), q.q12 / std::sqrt(q.q11) / std::sqrt(q.q22),
          std::log(q.q22 / (2 * pi * s0 * t))};
}

Covariance covariance(const Variables& y, double s0, double t) {
  const double velocity = std::sqrt(2 * pi * s0 * t) * std::exp(y.ln_r22 / 2),
               displacement = t * std::sqrt(2 * pi / 3 * s0 * t) * std::exp(y.ln_r11 / 2);
  return {displacement * displacement, y.c * velocity * displacement, velocity * velocity};
}

/// The right side over ln t, with s = sqrt(1 - c^2), g = t rms x' / rms x, a22 t = damping, a21 t^2 = pull g:
///     (ln r11)' = 2 c g - 3
///     c' = s^2 (g + (a21 - wn^2) t^2 / g) - c / (2 r22)
///     (ln r22)' = 1 / r22 - 1 + 2 a22 t + 2 c (a21 - wn^2) t^2 / g
class CovarianceEquations {
 public:
  CovarianceEquations(Expectation friction, double natural_frequency, double s0, double last)
      : friction_(std::move(friction)), natural_frequency_(natural_frequency), s0_(s0), last_(last) {}

  double time(double ln_t) const { return last_ * std::exp(ln_t); }

  void operator()(double ln_t, std::span<const double> y, std::span<double> slope) const {
    const double t = time(ln_t), c = std::clamp(y[1], -1.0, 1.0), s = std::sqrt((1 - c) * (1 + c)),
                 r22 = std::exp(y[2]), g = std::sqrt(3.0) * std::exp((y[2] - y[0]) / 2);
    const double velocity = std::sqrt(2 * pi * s0_ * t * r22), angle = natural_frequency_ * t;
    const Friction friction = friction_(velocity * t / g, c, s);
    const double damping = -std::sqrt(2 / pi) * friction.level * (t / velocity),
                 pull = friction.pull * (t / velocity) - angle * angle / g;
    slope[0] = 2 * c * g - 3;
    slope[1] = s * s * (g + pull) - c / (2 * r22);
    slope[2] = 1 / r22 - 1 + 2 * damping + 2 * c * pull;
  }

 private:
  Expectation friction_;
  double natural_frequency_, s0_, last_;
};

/// From rest, before the law away from x = 0 and the spring have an effect, with p = a sqrt(t / S0) / pi:
///     q22 = 2 pi S0 t (1 - 4/3 p + 2/3 p^2 - ...)             2 pi t - (8/3) t^1.5 + ... in units of S0 and a
///     q12 = pi S0 t^2 (1 - 22/15 p + 32/45 p^2 - ...)
///     q11 = (2 pi / 3) S0 t^3 (1 - 44/35 p + 8/15 p^2 - ...)
Variables from_rest(double a, double s0, double t) {
  const double p = a * std::sqrt(t / s0) / pi;
  const auto series = [p](const std::array<double, 5>& terms) {
    double sum = 0;
    for (std::size_t i = terms.size(); i-- > 0;) sum = p * (terms[i] + sum);
    return sum;
  };
  const double r22 = series({-4. / 3, 2. / 3, -4. / 45, -8. / 405, -2. / 945}),
               r12 = series({-22. / 15, 32. / 45, -22. / 315, -52. / 2835, -199. / 42525}),
               r11 = series({-44. / 35, 8. / 15, -44. / 945, -52. / 4725, -398. / 155925});
  return {std::log1p(r11), std::sqrt(0.75) * (1 + r12) / std::sqrt((1 + r11) * (1 + r22)), std::log1p(r22)};
}

/// From (3.38) to (3.40), one Euler step.
Variables from_thesis(double a, double s0, double t) {
  const double unit = s0 / a / a, velocity = s0 / a, displacement = velocity * unit, passed = t / unit;
  const double q11 = 0.01, q12 = 5.4e-8, q22 = 1.3e-5, damping = std::sqrt(2 / (pi * q22));
  return variables({displacement * displacement * (q11 + 2 * q12 * passed),
                    displacement * velocity * (q12 + (q22 - damping * q12) * passed),
                    velocity * velocity * (q22 + 2 * (pi - damping * q22) * passed)},
                   s0, t);
}

/// The time at which integration begins: as late as the series is accurate to 1e-12; at the latest when the terms that
/// it neglects have died away, as t0 / t, by the first requested time.
double first_time(const Expectation& friction, double a, double natural_frequency, double s0, double asked) {
  const double unit = s0 / a / a, surely = std::min({1e-8 * asked, 1e-10 * unit, 1e-6 / natural_frequency});
  for (double t = std::min(1e-3 * unit, 1e-6 / natural_frequency); t > surely && std::isfinite(t); t /= 8) {
    const Friction early = friction(t * std::sqrt(2 * pi / 3 * s0 * t), std::sqrt(0.75), 0.5);
    if (std::abs(early.level - a) <= 1e-11 * a && std::abs(early.pull) <= 1e-11 * a) return t;
  }
  return surely;
}

}  // namespace

Covariance frictionless_covariance(double natural_frequency, double s0, double time) {
  const Covariance free{2 * pi / 3 * s0 * time * time * time, pi * s0 * time * time, 2 * pi * s0 * time};
  const double angle = natural_frequency * time;
  if (angle < 1e-9) return free;
  const double phase = std::sin(angle) / angle, less = one_less_sinc(2 * angle);
  return {free.q11 * (1.5 * less / angle / angle), free.q12 * phase * phase, free.q22 * (1 - less / 2)};
}

void check_start(const LinearizedLaw& law, double s0, Start start) {
  const double a = level_at_rest(law, theory::EquivalentLinearization::Force::gaussian), unit = s0 / a / a;
  if (start == Start::thesis)
    require(std::isfinite(unit * unit * unit * s0) && unit > 0,
            noun + ": (3.38) to (3.40) need friction: slip_level must be positive, and not too far from s0", a,
            "m/s^2");
}

CovarianceSolution solve_covariance(const LinearizedLaw& law, double natural_frequency, double s0,
                                    std::span<const double> times,
                                    const theory::EquivalentLinearization::Options& options,
                                    const std::function<void()>& progress) {
  check_times(noun, times);
  CovarianceSolution solution;
  if (times.empty()) return solution;
  check_start(law, s0, options.start);
  const double a = level_at_rest(law, options.force), last = times.back();
  const double unit = s0 / a / a;
  const bool rest = options.start == Start::rest;
  const auto keep = [&](const Covariance& q, double time) {
    check_range(noun, time, q.q11 + q.q22 + std::abs(q.q12));
    solution.covariance.push_back(q);
  };
  if (times.front() == 0) {
    const double velocity = s0 / a, displacement = velocity * unit;
    if (!rest)
      keep({0.01 * displacement * displacement, 5.4e-8 * displacement * velocity, 1.3e-5 * velocity * velocity}, 0);
    else
      keep({0, 0, 0}, 0);
    times = times.subspan(1);
    if (times.empty()) return solution;
  }

  if (frictionless(law)) {
    for (const double time : times) keep(frictionless_covariance(natural_frequency, s0, time), time);
    return solution;
  }

  const Expectation friction = expectation(law, options.force, 10 * last * std::sqrt(2 * pi / 3 * s0 * last));
  const double t0 = rest ? first_time(friction, a, natural_frequency, s0, times.front())
                         : std::min({1e-8 * times.front(), 1e-10 * unit, 1e-8 / natural_frequency});
  const auto early = [&](double time) { return rest ? from_rest(a, s0, time) : from_thesis(a, s0, time); };
  const std::size_t before = static_cast<std::size_t>(std::ranges::upper_bound(times, t0) - times.begin());
  for (const double time : times.first(before)) keep(covariance(early(time), s0, time), time);
  times = times.subspan(before);
  if (times.empty()) return solution;

  const CovarianceEquations equations(friction, natural_frequency, s0, last);
  const Variables start = early(t0);
  std::vector<double> ln_times;
  for (const double time : times) ln_times.push_back(std::log(time / last));
  const std::array<double, 3> y0 = {start.ln_r11, start.c, start.ln_r22};
  try {
    const auto states =
        solve_ode(std::cref(equations), std::log(t0 / last), y0, ln_times,
                  {.relative_tolerance = options.tolerance / 10,
                   .absolute_tolerance = {options.tolerance / 10, options.tolerance / 1000, options.tolerance / 10},
                   // Coulomb's velocity settles within unit; up to there no slower without
                   .method = last > 1000 * unit ? OdeMethod::bdf : OdeMethod::adams,
                   .max_steps = 300'000,  // some 1 s; needed for many periods of a spring
                   .progress = progress});
    solution.steps = states.steps;
    solution.evaluations = states.evaluations;
    for (std::size_t i = 0; i < times.size(); ++i) {
      const auto y = states.at(i);
      keep(covariance({y[0], y[1], y[2]}, s0, times[i]), times[i]);
    }
  } catch (const OdeFailure& failure) {
    throw ConvergenceError(noun + ": reached " + shortest(equations.time(failure.reached)) + " s of " + shortest(last) +
                           " s: " + failure.why);
  }
  return solution;
}

}  // namespace stickslip::detail
