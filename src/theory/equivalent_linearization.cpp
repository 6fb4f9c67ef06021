#include "stickslip/theory/equivalent_linearization.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include "stickslip/base/error.hpp"
#include "stickslip/structure/sliding_structure.hpp"
#include "structure/modal_interface.hpp"
#include "theory/covariance.hpp"
#include "theory/linear_friction.hpp"
#include "theory/ranges.hpp"
#include "theory/shaped_covariance.hpp"
#include "theory/theory_moments.hpp"

namespace stickslip::theory {
namespace {

using detail::require;
using detail::shortest;
using std::numbers::pi;

const std::string noun = "EquivalentLinearization";
const double nowhere = std::numeric_limits<double>::quiet_NaN();

using Options = EquivalentLinearization::Options;

/// Friction a |v| along the velocity vector in d dimensions, with the linear force -c v: c = a E|v| / E|v|^2, relative
/// to that in one dimension, for each density.
double level_factor(const Options& options) {
  const double d = options.dimensions;
  if (options.dimensions == 1) return 1;
  if (options.force == EquivalentLinearization::Force::laplace) return std::sqrt(2 / (d + 1));
  return std::sqrt(pi) * std::tgamma((d + 1) / 2) / (d * std::tgamma(d / 2));
}

/// The law along one axis whose linear equivalent is that of each coordinate.
detail::LinearizedLaw along_one_axis(const detail::LinearizedLaw& law, const Options& options) {
  if (options.dimensions == 1) return law;
  const auto* const coulomb = std::get_if<Coulomb>(&law);
  const std::string where = noun + ": in " + std::to_string(options.dimensions) + " dimensions ";
  if (coulomb == nullptr)
    throw std::invalid_argument(where +
                                "covers Coulomb friction, because other laws of position are not the same in "
                                "all directions");
  if (coulomb->forward() != coulomb->backward())
    throw std::invalid_argument(where + "the levels must be equal, because friction opposes the velocity vector, got " +
                                shortest(coulomb->forward()) + " and " + shortest(coulomb->backward()) + " m/s^2");
  return Coulomb(level_factor(options) * coulomb->forward());
}

/// By how much a fraction falls short of 1, in percent.
std::string low(double fraction) { return shortest(std::round(100 * (1 - fraction))) + " %"; }

/// Errors under white noise in more than one dimension, without a spring: from q22 = (D / a f)^2, f = sqrt(2 / pi)
/// level_factor, and the growth 2 D^3 / (a f)^4, against (d + 1) D^2 / a^2 and (d + 1) (2 d + 3) D^3 / a^4.
std::string remark_in_dimensions(const Options& options) {
  const double d = options.dimensions;
  const bool laplace = options.force == EquivalentLinearization::Force::laplace;
  const double factor = level_factor(options) * (laplace ? 1 / std::numbers::sqrt2 : std::sqrt(2 / pi)),
               square = factor * factor;
  const std::string growth = low(2 / (square * square * (d + 1) * (2 * d + 3)));
  return "in " + std::to_string(options.dimensions) +
         " dimensions under white noise the stationary velocity variance is " +
         (laplace ? "exact, the growth of the displacement variance " + growth + " low"
                  : low(1 / (square * (d + 1))) + " low and the growth of the displacement variance " + growth) +
         ": WhiteNoise has the exact figures";
}

/// The level of stationary white noise, if two states alone describe the response: equal levels, no damper.
std::optional<double> two_states(const detail::LinearizedLaw& law, double damping, const ShapedNoise& noise) {
  const auto* const coulomb = std::get_if<Coulomb>(&law);
  if (damping > 0 || (coulomb != nullptr && coulomb->forward() != coulomb->backward())) return {};
  return noise.white();
}

/// The growth rate of the displacement variance: 0 where friction and spring bound it. The work of friction, -2 a22
/// q22, grows with the displacement up to 2 a reach wn; the noise supplies 2 pi S0. Of any law that is constant far
/// away, such as a caster with rolling resistance, it is that of Coulomb friction with this level.
double growth_rate(const detail::LinearizedLaw& law, double natural_frequency, double s0, double last,
                   const Options& options) {
  if (const auto* const coulomb = std::get_if<Coulomb>(&law); coulomb != nullptr && coulomb->forward() > 0) {
    if (natural_frequency > 0) return 0;
    const double velocity = s0 / coulomb->forward();
    // (3.47); 2 pi S0 / a22^2 with the stationary a22
    const double factor =
        options.force == EquivalentLinearization::Force::laplace ? 8 * pi * pi * pi : std::pow(pi, 5) / 2;
    return factor * velocity * velocity * (velocity / coulomb->forward());
  }
  if (const auto* const wheel = std::get_if<Caster>(&law); wheel != nullptr && wheel->slip_level() > 0) {
    if (std::isinf(wheel->reach()))
      return growth_rate(Coulomb(wheel->slip_level()), natural_frequency, s0, last, options);
    if (wheel->slip_level() * wheel->reach() * natural_frequency > pi * s0) return 0;
  }
  if (std::holds_alternative<std::function<double(double, Direction)>>(law) && last > 0)
    if (const auto level = detail::far_level(law, last * std::sqrt(s0 * last)); level && *level > 0)
      return growth_rate(Coulomb(*level), natural_frequency, s0, last, options);
  return nowhere;
}

/// To three digits.
std::string rounded(double value) {
  const double scale = std::pow(10, 2 - std::floor(std::log10(value)));
  return shortest(std::round(scale * value) / scale);
}

/// While a caster breaks loose at any of the times, its error and z of thesis (3.30).
std::string caster_remark(const detail::LinearizedLaw& law, const Options& options, double natural_frequency, double s0,
                          const Moments& moments) {
  const auto* const wheel = std::get_if<Caster>(&law);
  if (wheel == nullptr || !(wheel->slip_level() > 0) || std::isinf(wheel->reach()) ||
      options.force != EquivalentLinearization::Force::gaussian)
    return {};
  const double a = wheel->slip_level(), gamma = s0 / a * (s0 / a) / (wheel->reach() * a);
  if (natural_frequency == 0 && gamma > detail::caster_gamma) return {};
  double least = std::numeric_limits<double>::infinity(), largest = 0;
  for (std::size_t i = 0; i < moments.time.size(); ++i) {
    const double q11 = moments.displacement_variance.value[i], q12 = moments.covariance.value[i],
                 q22 = moments.velocity_variance.value[i];
    if (!(q22 > 0)) continue;
    const double z = wheel->reach() / std::sqrt(2 * (q11 - q12 * (q12 / q22)));
    if (!(z >= detail::caster_loose_z && z <= detail::caster_held_z)) continue;
    least = std::min(least, z);
    largest = std::max(largest, z);
  }
  if (!(largest > 0)) return {};
  return detail::caster_range + std::string("; here z is ") +
         (least < largest ? "from " + rounded(largest) + " to " : "") + rounded(least) +
         (natural_frequency > 0 ? ", on a spring"
                                : ", gamma = S(0)^2 / (reach a^3) = " + (gamma > 0 ? rounded(gamma) : "0"));
}

std::string remark(const detail::LinearizedLaw& law, const Options& options, double natural_frequency, double s0,
                   const Moments& moments) {
  const auto* const wheel = std::get_if<Caster>(&law);
  const auto* const coulomb = std::get_if<Coulomb>(&law);
  if ((coulomb != nullptr && coulomb->forward() == 0) || (wheel != nullptr && wheel->slip_level() == 0))
    return {};  // exact
  if (options.start == EquivalentLinearization::Start::thesis)
    return "starts from (3.38) to (3.40), whose q11(0) outweighs the displacement up to t = 0.2 S0 / a^2";
  if (std::string loose = caster_remark(law, options, natural_frequency, s0, moments); !loose.empty()) return loose;
  if (natural_frequency > 0) return {};
  if (options.dimensions > 1) return remark_in_dimensions(options);
  if (options.force == EquivalentLinearization::Force::laplace)
    return detail::laplace_white_range + std::string(": WhiteNoise has the exact figures");
  if (coulomb != nullptr || (wheel != nullptr && std::isinf(wheel->reach())))
    return "the stationary velocity variance is 21 % low and the growth of the displacement variance 51 %: WhiteNoise "
           "has the exact figures";
  if (options.force != EquivalentLinearization::Force::gaussian)
    return "a21, which the thesis drops, is left out: the displacement variance is low by a third and more once a "
           "caster breaks loose";
  return {};
}

Moments moments_of(std::span<const double> times, std::span<const detail::ShapedState> states) {
  Moments moments = detail::moments_at(times);
  for (std::size_t i = 0; i < times.size(); ++i) {
    moments.displacement_mean.value[i] = states[i].displacement_mean;
    moments.displacement_variance.value[i] = states[i].q11;
    moments.covariance.value[i] = states[i].q12;
    moments.velocity_mean.value[i] = states[i].velocity_mean;
    moments.velocity_variance.value[i] = states[i].q22;
  }
  return moments;
}

/// The law of the sliding interface of a structure.
detail::LinearizedLaw law_of(const SlidingStructure& system) {
  return std::visit(
      [&]<FrictionLaw Law>(const Slider<Law>& slider) -> detail::LinearizedLaw {
        detail::require_one_level(slider, noun);
        if constexpr (PositionLaw<Law>)
          return detail::linearized_law(slider.law());
        else
          detail::refuse_law<Law>(noun);
      },
      system.slider());
}

detail::ShapedProblem problem_of(const SlidingStructure& system, const detail::LinearizedLaw& law,
                                 const ShapedNoise& noise, const ShapingFilter& filter, const Options& options) {
  const Mounting& on = mounting_of(system.slider());
  return {law, on.natural_frequency, on.damping, noise, filter, options, &system.modal()};
}

std::string percent(double fraction) { return shortest(std::round(1000 * fraction) / 10) + " %"; }

/// @param ratio  the least of the rms ground accelerations, over that below which no motion is predicted
/// @param held   at how many of the times friction holds the slider
std::string shaped_remark(const detail::ShapedProblem& problem, double ratio, std::size_t held = 0,
                          std::size_t times = 0) {
  std::string all;
  const auto add = [&](const std::string& remark) { all += (all.empty() ? "" : "; ") + remark; };
  if (problem.filter.misfit() > 0)
    add("the spectrum is approximated by a filter of order " + std::to_string(problem.filter.order()) + " (misfit " +
        percent(problem.filter.misfit()) + " of its variance)");
  if (ratio < 1.5)
    add((problem.structure ? "the rms force on the stuck interface is" : "the rms acceleration of the ground is") +
        std::string(times > 1 ? " as low as " : " ") + shortest(std::round(1000 * ratio) / 1000) +
        " times that below which no motion is predicted, thesis (4.22): displacements may be far too small");
  if (held > 0)
    add("at " + std::to_string(held) + " of " + std::to_string(times) +
        " times friction is predicted to hold the slider: its velocity variance there is given as 0");
  if (problem.natural_frequency == 0 && problem.filter(0) == 0 && std::isfinite(ratio))
    add("no acceleration at zero frequency: under friction the displacement drifts all the same");
  if (const auto* const coulomb = std::get_if<Coulomb>(&problem.law);
      coulomb != nullptr && problem.options.force == EquivalentLinearization::Force::laplace &&
      problem.natural_frequency == 0) {
    const double low = std::min(coulomb->forward(), coulomb->backward()),
                 high = std::max(coulomb->forward(), coulomb->backward());
    if (problem.noise.white() && problem.damping == 0 && !problem.structure)
      add(problem.options.dimensions > 1
              ? remark_in_dimensions(problem.options)
              : detail::laplace_white_range + std::string(": WhiteNoise has the exact figures"));
    else if (high > detail::laplace_unequal * low)
      add(detail::laplace_unequal_range);
  }
  if (problem.noise.returns())
    add("the excitation has no line at zero frequency, so that ground velocities return to where they began; the "
        "spectrum is taken without that gap");
  return all;
}

}  // namespace

EquivalentLinearization::EquivalentLinearization(Options options) : options_(options) {
  require(options.filter.max_misfit > 0, noun + ": max_misfit must be above 0", options.filter.max_misfit);
  require(options.tolerance >= 1e-12 && options.tolerance <= 1e-2, noun + ": tolerance must be from 1e-12 to 1e-2",
          options.tolerance);
  require(options.dimensions >= 1 && options.dimensions <= 6, noun + ": dimensions must be from 1 to 6",
          options.dimensions);
  require(options.dimensions == 1 || (options.force != Force::thesis && options.start != Start::thesis),
          noun + ": the thesis's force and start are those of one dimension: dimensions must be 1", options.dimensions);
}

std::string EquivalentLinearization::name() const {
  const std::string dimensions =
      options_.dimensions == 1 ? "" : ", " + std::to_string(options_.dimensions) + " dimensions";
  switch (options_.force) {
    case Force::gaussian:
      break;
    case Force::gaussian_a22:
      return noun + ", gaussian_a22" + dimensions;
    case Force::laplace:
      return noun + ", laplace" + dimensions;
    case Force::thesis:
      return noun + ", thesis" + dimensions;
  }
  return noun + dimensions;
}

void EquivalentLinearization::check(const detail::LinearizedLaw& given, double damping,
                                    const ShapedNoise& noise) const {
  const detail::LinearizedLaw law = along_one_axis(given, options_);
  if (const auto s0 = two_states(law, damping, noise)) {
    detail::check_start(law, *s0, options_.start);
    detail::expectation(law, options_.force, 0);
    return;
  }
  if (options_.start == Start::thesis)
    throw std::invalid_argument(noun + ": (3.38) to (3.40) are of stationary white noise, equal levels and no damper");
  detail::AverageFriction(law, options_.force, 0);
}

void EquivalentLinearization::check(const SlidingStructure& system, const ShapedNoise&) const {
  require(options_.dimensions == 1, noun + ": structures move along one axis: dimensions must be 1",
          options_.dimensions);
  if (options_.start == Start::thesis)
    throw std::invalid_argument(noun + ": (3.38) to (3.40) are of sliders under white noise, not of structures");
  if (const auto modes = system.modal().modes(); modes > detail::ShapedProblem::most_modes)
    throw std::invalid_argument(noun + ": covers structures of at most " +
                                std::to_string(detail::ShapedProblem::most_modes) + " modes, got " +
                                std::to_string(modes) + "; take the first ones by from_modes");
  detail::AverageFriction(law_of(system), options_.force, 0);
}

Moments EquivalentLinearization::predict(const detail::LinearizedLaw& given, double natural_frequency, double damping,
                                         const ShapedNoise& noise, std::span<const double> times,
                                         const std::function<void()>& progress) const {
  const detail::LinearizedLaw law = along_one_axis(given, options_);
  if (const auto s0 = two_states(law, damping, noise)) {
    const auto solution = detail::solve_covariance(law, natural_frequency, *s0, times, options_, progress);
    Moments moments = detail::moments_at(times);
    for (std::size_t i = 0; i < times.size(); ++i) {
      const auto& [q11, q12, q22] = solution.covariance[i];
      moments.displacement_variance.value[i] = q11;
      moments.covariance.value[i] = q12;
      moments.velocity_variance.value[i] = q22;
    }
    moments.growth_rate.value = growth_rate(law, natural_frequency, *s0, times.empty() ? 0 : times.back(), options_);
    moments.remark = remark(law, options_, natural_frequency, *s0, moments);
    return moments;
  }
  check(given, damping, noise);
  const ShapingFilter filter = noise.filter(options_.filter);
  return predict(detail::ShapedProblem{law, natural_frequency, damping, noise, filter, options_}, times, progress);
}

Moments EquivalentLinearization::predict(const SlidingStructure& system, const ShapedNoise& noise,
                                         std::span<const double> times, const std::function<void()>& progress) const {
  check(system, noise);
  const detail::LinearizedLaw law = law_of(system);
  const ShapingFilter filter = noise.filter(options_.filter);
  return predict(problem_of(system, law, noise, filter, options_), times, progress);
}

Moments EquivalentLinearization::predict(const detail::ShapedProblem& problem, std::span<const double> times,
                                         const std::function<void()>& progress) const {
  detail::check_times(noun, times);
  const std::vector<detail::ShapedState> states = detail::solve_shaped(problem, times, progress).state;
  Moments moments = moments_of(times, states);
  try {
    if (!problem.noise.envelope())
      moments.growth_rate.value = detail::late_growth(problem, times.empty() ? 0 : times.back());
  } catch (const std::invalid_argument&) {  // there is no stationary solution
  }
  double ratio = std::numeric_limits<double>::infinity();
  std::size_t held = 0;
  for (const detail::ShapedState& state : states) {
    ratio = std::min(ratio, state.motion_ratio);
    if (state.motion_ratio < 1 && state.q22 == 0) ++held;
  }
  moments.remark = shaped_remark(problem, ratio, held, times.size());
  if (const std::string loose =
          caster_remark(problem.law, options_, problem.natural_frequency, problem.filter(0), moments);
      !loose.empty())
    moments.remark += (moments.remark.empty() ? "" : "; ") + loose;
  return moments;
}

Moments EquivalentLinearization::stationary(const detail::LinearizedLaw& given, double natural_frequency,
                                            double damping, const ShapedNoise& noise) const {
  const detail::LinearizedLaw law = along_one_axis(given, options_);
  const ShapingFilter filter = noise.filter(options_.filter);
  return stationary(detail::ShapedProblem{law, natural_frequency, damping, noise, filter, options_});
}

Moments EquivalentLinearization::stationary(const SlidingStructure& system, const ShapedNoise& noise) const {
  check(system, noise);
  const detail::LinearizedLaw law = law_of(system);
  const ShapingFilter filter = noise.filter(options_.filter);
  return stationary(problem_of(system, law, noise, filter, options_));
}

Moments EquivalentLinearization::stationary(const detail::ShapedProblem& problem) const {
  const detail::StationaryState found = detail::solve_stationary(problem);
  const double never = std::numeric_limits<double>::infinity();
  Moments moments = moments_of(std::span(&never, 1), std::span(&found.state, 1));
  moments.growth_rate.value = found.growth_rate;
  moments.remark = shaped_remark(problem, detail::motion_ratio(problem));
  if (!std::isfinite(found.state.q11))
    moments.remark += std::string(moments.remark.empty() ? "" : "; ") +
                      "without a spring the displacement has no stationary variance";
  return moments;
}

LinearFriction EquivalentLinearization::coefficients(const detail::LinearizedLaw& given, double q11, double q12,
                                                     double q22) const {
  const detail::LinearizedLaw law = along_one_axis(given, options_);
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
  require(slider.law().rolling() == 0,
          "transition_time: a caster with rolling resistance is not covered, rolling must be 0", slider.law().rolling(),
          "m/s^2");
  const double a = slider.law().slip_level(), reach = slider.law().reach();
  require(a > 0, "transition_time: without friction there is no transition: slip_level must be positive", a, "m/s^2");
  const double unit = s0.s0() / a / a, loose = reach / (s0.s0() / a) / unit;     // 1 / gamma
  const double thesis = unit * (loose * loose / std::pow(pi, 5) + pi * pi / 4);  // (3.51)
  require(std::isfinite(thesis) || std::isinf(reach),
          "transition_time: exceeds the range of doubles: reach must be less, or slip_level nearer to s0", reach, "m");
  return {thesis, thesis + 47 * pi * pi / 48 * unit};
}

}  // namespace stickslip::theory
