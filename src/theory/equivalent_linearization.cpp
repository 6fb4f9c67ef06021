#include "stickslip/theory/equivalent_linearization.hpp"

#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <string>
#include <variant>

#include "stickslip/error.hpp"
#include "theory/covariance.hpp"
#include "theory/linear_friction.hpp"
#include "theory/theory_moments.hpp"

namespace stickslip::theory {
namespace {

using detail::require;
using detail::shortest;
using std::numbers::pi;

const std::string noun = "EquivalentLinearization";
const double nowhere = std::numeric_limits<double>::quiet_NaN();

/// Whether friction and spring hold a displacement variance: the work of friction, -2 a22 q22, goes up to 2 a reach wn
/// with the displacement, and the noise does 2 pi S0.
double growth_rate(const detail::LinearizedLaw& law, double natural_frequency, double s0) {
  if (const auto* const coulomb = std::get_if<Coulomb>(&law); coulomb != nullptr && coulomb->forward() > 0) {
    if (natural_frequency > 0) return 0;
    const double velocity = s0 / coulomb->forward();
    return std::pow(pi, 5) / 2 * velocity * velocity * (velocity / coulomb->forward());  // (3.47)
  }
  if (const auto* const wheel = std::get_if<Caster>(&law); wheel != nullptr && wheel->slip_level() > 0) {
    if (std::isinf(wheel->reach())) return growth_rate(Coulomb(wheel->slip_level()), natural_frequency, s0);
    if (wheel->slip_level() * wheel->reach() * natural_frequency > pi * s0) return 0;
  }
  return nowhere;
}

std::string remark(const detail::LinearizedLaw& law, const EquivalentLinearization::Options& options,
                   double natural_frequency, double s0) {
  const auto* const wheel = std::get_if<Caster>(&law);
  const auto* const coulomb = std::get_if<Coulomb>(&law);
  if ((coulomb != nullptr && coulomb->forward() == 0) || (wheel != nullptr && wheel->slip_level() == 0))
    return {};  // exact
  if (options.start == EquivalentLinearization::Start::thesis)
    return "starts from (3.38) to (3.40), whose q11(0) outweighs the displacement up to t = 0.2 S0 / a^2";
  if (natural_frequency > 0) return {};
  if (coulomb != nullptr || (wheel != nullptr && std::isinf(wheel->reach())))
    return "the stationary velocity variance is 21 % low and the growth of the displacement variance 51 %: WhiteNoise "
           "has the exact figures";
  if (options.force != EquivalentLinearization::Force::gaussian)
    return "a21, which the thesis drops, is left out: the displacement variance is low by a third and more once a "
           "caster breaks loose";
  if (wheel != nullptr &&
      s0 / wheel->slip_level() * (s0 / wheel->slip_level()) < 0.05 * wheel->reach() * wheel->slip_level())
    return "gamma = S0^2 / (reach a^3) is small: the displacement variance is low by up to a factor of three while the "
           "caster breaks loose";
  return {};
}

}  // namespace

EquivalentLinearization::EquivalentLinearization(Options options) : options_(options) {
  require(options.tolerance >= 1e-12 && options.tolerance <= 1e-2, noun + ": tolerance must be from 1e-12 to 1e-2",
          options.tolerance);
}

std::string EquivalentLinearization::name() const {
  switch (options_.force) {
    case Force::gaussian:
      return noun;
    case Force::gaussian_a22:
      return noun + ", gaussian_a22";
    case Force::thesis:
      return noun + ", thesis";
  }
  return noun;
}

void EquivalentLinearization::check(const detail::LinearizedLaw& law, double s0) const {
  detail::check_start(law, s0, options_.start);
  detail::expectation(law, options_.force, 0);
}

Moments EquivalentLinearization::predict(const detail::LinearizedLaw& law, double natural_frequency, double s0,
                                         std::span<const double> times, const std::function<void()>& heartbeat) const {
  const auto solution = detail::solve_covariance(law, natural_frequency, s0, times, options_, heartbeat);
  Moments moments = detail::moments_at(times);
  for (std::size_t i = 0; i < times.size(); ++i) {
    const auto& [q11, q12, q22] = solution.covariance[i];
    moments.displacement_variance.value[i] = q11;
    moments.covariance.value[i] = q12;
    moments.velocity_variance.value[i] = q22;
  }
  moments.growth_rate.value = growth_rate(law, natural_frequency, s0);
  moments.remark = remark(law, options_, natural_frequency, s0);
  return moments;
}

LinearFriction EquivalentLinearization::coefficients(const detail::LinearizedLaw& law, double q11, double q12,
                                                     double q22) const {
  require(std::isfinite(q11) && q11 > 0, noun + ": q11 must be positive and finite", q11, "m^2");
  require(std::isfinite(q22) && q22 > 0, noun + ": q22 must be positive and finite", q22, "m^2/s^2");
  const double displacement = std::sqrt(q11), velocity = std::sqrt(q22), c = q12 / displacement / velocity;
  require(std::abs(c) < 1, noun + ": q12^2 must be less than q11 q22 = " + shortest(q11 * q22) + " m^4/s^2; q12", q12,
          "m^2/s");
  const detail::Friction friction =
      detail::expectation(law, options_.force, 10 * displacement)(displacement, c, std::sqrt((1 - c) * (1 + c)));
  return {friction.pull / displacement, -std::sqrt(2 / pi) * friction.level / velocity};
}

TransitionTime transition_time(const Slider<Caster>& slider, WhiteLevel s0) {
  require(slider.natural_frequency() == 0,
          "transition_time: covers casters without a spring: natural_frequency must be 0", slider.natural_frequency(),
          "rad/s");
  detail::require_plain(slider, "transition_time");
  const double a = slider.law().slip_level(), reach = slider.law().reach();
  require(a > 0, "transition_time: without friction there is no transition: slip_level must be positive", a, "m/s^2");
  const double unit = s0.s0() / a / a, loose = reach / (s0.s0() / a) / unit;     // 1 / gamma
  const double thesis = unit * (loose * loose / std::pow(pi, 5) + pi * pi / 4);  // (3.51)
  require(std::isfinite(thesis) || std::isinf(reach),
          "transition_time: exceeds the range of doubles: reach must be less, or slip_level nearer to s0", reach, "m");
  return {thesis, thesis + 47 * pi * pi / 48 * unit};
}

}  // namespace stickslip::theory
