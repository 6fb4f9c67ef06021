#include "stickslip/theory/transport.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include "stickslip/base/equal.hpp"
#include "stickslip/base/error.hpp"
#include "stickslip/numerics/root.hpp"
#include "stickslip/theory/noise.hpp"
#include "theory/theory_moments.hpp"
#include "theory/transport/motion.hpp"
#include "theory/transport/refinement.hpp"

namespace stickslip::theory {
namespace {

using detail::Accuracy;
using detail::Chain;
using detail::Figures;
using detail::MotionMoments;
using detail::Refined;
using detail::require;
using detail::StationaryMotion;
using detail::TransportProblem;
using detail::weights_from_rest;

using Progress = std::function<void()>;

constexpr double infinity = std::numeric_limits<double>::infinity();

ShapingFilter exact_filter(const Spectrum& spectrum) {
  if (!std::holds_alternative<Spectrum::White>(spectrum.form()) &&
      !std::holds_alternative<Spectrum::KanaiTajimi>(spectrum.form()))
    throw std::invalid_argument(
        "Transport: covers the spectra of white noise and of filters of two states, such as Kanai and Tajimi's; a "
        "filter for another is fitted by ShapingFilter.of(spectrum, order=2)");
  return ShapingFilter::of(spectrum);
}

std::string remark_of(const TransportExcitation& excitation) {
  const auto* noise = std::get_if<TwoStateNoise>(&excitation);
  return noise ? noise->remark()
               : "The errors include that of the lattice of times on which the pulses begin, measured to some percent.";
}

/// A value at a time, which under pulses may be within a step, from those after whole steps.
template <class Value, class OfSteps>
Value at_time(const Chain& chain, double time, Value at_start, const OfSteps& of_steps) {
  const double place = time / chain.step(), whole = std::floor(place + 1e-9), part = place - whole;
  const Value before = whole > 0 ? of_steps(static_cast<std::size_t>(whole)) : at_start;
  if (part < 1e-9) return before;
  return (1 - part) * before + part * of_steps(static_cast<std::size_t>(whole) + 1);
}

/// The probability that the walls of a chain have been exceeded.
double exceeded(const Chain& chain, double time, const Progress& progress) {
  return at_time(chain, time, 0.0,
                 [&](std::size_t steps) { return 1 - weights_from_rest(chain, steps, progress).sum(); });
}

constexpr double MotionMoments::*all[] = {&MotionMoments::x, &MotionMoments::xx, &MotionMoments::xv, &MotionMoments::v,
                                          &MotionMoments::vv};

/// The stationary figures: those of MotionMoments, and the probability of rest.
Figures stationary_figures(const Chain& chain, bool with_rest, const Chain::Vector& guess, const Progress& progress) {
  const StationaryMotion motion = stationary_motion(chain, with_rest, guess, progress);
  Figures figures(6);
  for (std::size_t i = 0; i < 5; ++i) figures[static_cast<Eigen::Index>(i)] = motion.moments.*all[i];
  figures[5] = motion.rest;
  return figures;
}

/// The window of the grid, from coarse chains whose windows are adapted to what they find.
/// @param rms  of a coarse chain
template <class Rms>
TransportProblem::Window adapted(const TransportProblem& problem, double step, const Rms& rms) {
  TransportProblem::Window window = problem.first_window();
  for (int pass = 0; pass < 12; ++pass) {
    const TransportProblem::Window found = rms(problem.chain(step, 0, window));
    const auto fits = [](double is, double was) { return is < 1.15 * was && was < 1.3 * is; };
    const bool fit = fits(found.v, window.v) && (!problem.sprung() || fits(found.x, window.x));
    window = found;
    if (fit) break;
  }
  return window;
}

/// The window of a motion from rest; without a spring that of the stationary velocity.
TransportProblem::Window window_from_rest(const TransportProblem& problem, double step, std::size_t steps,
                                          const Progress& progress) {
  if (problem.wanders()) return problem.free_window(step * static_cast<double>(steps));
  const double length = problem.sprung() ? step : problem.first_step();  // of a step
  return adapted(problem, length, [&](const Chain& chain) -> TransportProblem::Window {
    if (!problem.sprung() && !problem.pulses()) return {0, std::sqrt(stationary_velocity(chain, progress))};
    double x = 0, v = 0;
    for (const MotionMoments& m : history_from_rest(chain, std::max<std::size_t>(steps, 8), progress)) {
      x = std::max(x, m.xx + m.x * m.x);
      v = std::max(v, m.vv + m.v * m.v);
    }
    return {problem.sprung() ? std::sqrt(x) : 0, std::sqrt(v)};
  });
}

void require_accuracy(const Refined& refined, double tolerance, Eigen::Index i, const char* noun) {
  if (refined.error[i] <= tolerance * std::abs(refined.value[i])) return;
  throw ConvergenceError("Transport: " + std::string(noun) + " is " + detail::shortest(refined.value[i]) +
                         " with an error of " + detail::shortest(refined.error[i]) + " on the finest grid, of " +
                         std::to_string(refined.nodes) + " nodes; the tolerance must be larger, got " +
                         detail::shortest(tolerance));
}

/// Moments from rest at times that the steps to the last one resolve, in the order of `all`, with their whole errors.
Refined moments_from_rest(const TransportProblem& problem, std::span<const double> times, double tolerance,
                          std::size_t levels, const Progress& progress) {
  // The changes of one figure may vanish by chance; those shortly before do not as well.
  constexpr double nearby[] = {1, 0.85, 0.7};
  const auto [step, steps] = problem.steps_to(times.back());
  const TransportProblem::Window window = window_from_rest(problem, step, steps, progress);
  const auto count = static_cast<Eigen::Index>(5 * times.size());
  Accuracy accuracy{.tolerance = tolerance, .judged = {}, .levels = levels};
  for (Eigen::Index end = 3 * count; end > 0; end -= count)
    accuracy.judged.insert(accuracy.judged.end(), {end - 4, end - 1});
  Refined refined = refine(problem, window, step, accuracy, [&, first = step, last = steps](const Chain& chain) {
    const auto parts = static_cast<std::size_t>(std::lround(first / chain.step()));
    const std::vector<MotionMoments> history = history_from_rest(chain, last * parts, progress);
    Figures figures(3 * count);
    Eigen::Index at = 0;
    for (const double part : nearby)
      for (const double time : times)
        for (const auto figure : all) figures[at++] = between(history, figure, part * time / chain.step());
    return figures;
  });
  Figures error = Figures::Zero(count);
  for (Eigen::Index k = 0; k < 3 * count; k += 5) {
    const auto scales = [&](Eigen::Index first) {
      const double xx = std::max(refined.value[first + 1], 0.0), vv = std::max(refined.value[first + 4], 0.0);
      return std::array{std::sqrt(xx), xx, std::sqrt(xx * vv), std::sqrt(vv), vv};
    };
    const Eigen::Index to = k % count;
    const auto there = scales(k), here = scales(to);
    for (std::size_t i = 0; i < 5; ++i) {
      const auto at = static_cast<Eigen::Index>(i);
      const double ratio = k == to ? 1 : there[i] > 0 ? here[i] / there[i] : 0;
      error[to + at] = std::max(error[to + at], refined.whole_error(k + at) * ratio);
    }
  }
  refined.value.conservativeResize(count);
  for (std::size_t k = 0; k < times.size(); ++k)
    for (Eigen::Index at = 0; at < 3; ++at) {
      const Eigen::Index i = static_cast<Eigen::Index>(5 * k) + at;
      error[i] += problem.error_of_start(times[k]) * std::abs(refined.value[i]);
    }
  refined.error = error;
  refined.lattice = Figures::Zero(count);
  return refined;
}

TransportStationary stationary_estimates(const TransportProblem& problem, double tolerance, bool with_rest,
                                         const Progress& progress) {
  const double step = problem.first_step();
  // A spring forgets the start in some periods.
  const auto beginning = [&](const Chain& chain) {
    return weights_from_rest(chain, problem.sprung() ? 100 : 0, progress);
  };
  const bool sprung = problem.sprung();
  const auto window = adapted(problem, step, [&](const Chain& chain) -> TransportProblem::Window {
    if (!sprung) return {0, std::sqrt(stationary_velocity(chain, progress))};
    const Figures found = stationary_figures(chain, false, beginning(chain), progress);
    return {std::sqrt(found[1] + found[0] * found[0]), std::sqrt(found[4] + found[3] * found[3])};
  });
  const Refined refined =
      refine(problem, window, step, {.tolerance = tolerance, .judged = {1, 4}, .slow = {5}},
             [&](const Chain& chain) { return stationary_figures(chain, with_rest, beginning(chain), progress); });
  if (!problem.pulses()) {
    require_accuracy(refined, tolerance, 1, sprung ? "the variance of the displacement" : "the growth rate");
    require_accuracy(refined, tolerance, 4, "the variance of the velocity");
  }
  const auto figure = [&](Eigen::Index i) { return Estimate{refined.value[i], refined.whole_error(i)}; };
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  return {sprung ? figure(0) : Estimate{unknown, 0},
          sprung ? figure(1) : Estimate{infinity, 0},
          figure(3),
          figure(4),
          sprung ? Estimate{0, 0} : figure(1),
          figure(5)};
}

}  // namespace

TwoStateNoise::TwoStateNoise(const ShapingFilter& filter) : filter_(filter) {
  require(filter.order() <= 2,
          "Transport: covers filters of two states; each further one would multiply some 1e4 nodes by 10. The order "
          "of the filter",
          filter.order());
  if (!white())
    require(detail::equal(filter.sections().front().b2, 0),
            "Transport: a filter must not pass white noise, b2 must be 0", filter.sections().front().b2);
}

TwoStateNoise::TwoStateNoise(const Spectrum& spectrum) : TwoStateNoise(exact_filter(spectrum)) {}

TwoStateNoise::TwoStateNoise(const GaussianExcitation& excitation) : TwoStateNoise(excitation.spectrum()) {
  if (white()) (void)WhiteLevel(excitation);  // which refuses what is not white noise down to zero frequency
  const GaussianOptions& options = excitation.options();
  if (options.envelope) throw std::invalid_argument("Transport: covers stationary noise, the envelope must be None");
  if (white() && options.interpolation == Interpolation::constant && !options.correct_interpolation)
    held_ = excitation.dt();
  if (!options.zero_frequency && filter_(0) > 0)
    remark_ = "The motions have no line at zero frequency (zero_frequency is False), which this theory has.";
}

Transport::Transport(double tolerance) : tolerance_(tolerance) {
  require(tolerance >= 1e-6 && tolerance <= 0.3, "Transport: tolerance must be from 1e-6 to 0.3", tolerance);
}

namespace {

/// On a slope the normal force depends on the load.
void check_contact(const detail::HeldMotion& motion, double rms) {
  require(rms <= motion.lift_off() / 4.5,
          "Transport: on a slope the rms acceleration must be at most g / (4.5 tan(slope)) = " +
              detail::shortest(motion.lift_off() / 4.5) + " m/s^2, so that the slider does not lift off",
          rms, "m/s^2");
}

/// What is covered of casters under filtered noise: the range in which their errors were measured.
void check_caster(const detail::HeldMotion& motion, const ShapingFilter& filter, double frequency, double damping,
                  double rms) {
  if (!(filter(0) > 0))
    throw std::invalid_argument("Transport: covers casters under filtered noise with content at zero frequency");
  const double level = motion.start(Direction::forward), reach = motion.reach() * frequency * frequency / level;
  require(reach >= 1,
          "Transport: under filtered noise the reach of a caster must be at least a / wg^2 = " +
              detail::shortest(level / (frequency * frequency)) + " m",
          motion.reach(), "m");
  require(rms >= 0.699 * level && rms <= 6.01 * level,
          "Transport: under filtered noise the rms acceleration over the slip level of a caster must be from 0.7 to 6",
          rms / level);
  require(damping >= 0.3 && damping <= 0.9,
          "Transport: with a caster the damping ratio of the filter must be from 0.3 to 0.9", damping);
  if (motion.natural_frequency() > 0)
    throw std::invalid_argument("Transport: covers casters under filtered noise without a spring");
}

/// What is covered of static friction on a spring: the range in which its errors were measured.
void check_static_on_spring(const detail::HeldMotion& motion, double frequency, double damping, double rms,
                            double tolerance) {
  const double level = motion.start(Direction::forward), wn = motion.natural_frequency();
  require(tolerance >= 0.05,
          "Transport: static friction on a spring needs a tolerance of at least 0.05, its errors are 4 % and more; it",
          tolerance);
  require(motion.mirrors() && motion.hold(Direction::forward) <= 2 * level,
          "Transport: static friction on a spring must be equal both ways and at most twice the kinetic one",
          motion.hold(Direction::forward), "m/s^2");
  require(wn <= 3 * frequency,
          "Transport: with static friction natural_frequency must be at most 3 times the frequency of the filter, " +
              detail::shortest(3 * frequency) + " rad/s",
          wn, "rad/s");
  require(
      rms >= 0.699 * level && rms <= 3.01 * level,
      "Transport: with static friction on a spring the rms acceleration over the kinetic level must be from 0.7 to 3",
      rms / level);
  require(damping >= 0.3 && damping <= 0.9,
          "Transport: with static friction on a spring the damping ratio of the filter must be from 0.3 to 0.9",
          damping);
}

/// What of pulses is covered.
void check_pulses(const detail::HeldMotion& motion, const PoissonPulses& pulses) {
  const PoissonOptions& options = pulses.options();
  if (options.envelope) throw std::invalid_argument("Transport: covers pulses without an envelope; it must be None");
  if (options.quantile)
    throw std::invalid_argument("Transport: covers pulses of Gaussian amplitudes; PulseChain covers others");
  const auto times = options.shape.times(), values = options.shape.values();
  if (!(values.size() == 2 && std::abs(times[2] - 2 * times[1]) <= 1e-9 * times[1] &&
        std::abs(values[0] + values[1]) <= 1e-9 * std::abs(values[0])))
    throw std::invalid_argument("Transport: covers pulses of two equal steps, up and down; PulseChain covers others");
  if (motion.breaks_away()) throw std::invalid_argument("Transport: covers static friction above kinetic under noise");
  if (std::isfinite(motion.reach())) throw std::invalid_argument("Transport: covers casters under white noise alone");
  const double half_width = times[1] * pulses.half_width(), arriving = pulses.rate() * half_width;
  const double strength = std::abs(values[0]) * pulses.sigma() / motion.least_hold();
  require(arriving >= 0.03 && arriving <= 10,
          "Transport: the mean number of pulses in a half width must be from 0.03 to 10", arriving);
  require(strength >= 0.3 && strength <= 6,
          "Transport: the rms amplitude of pulses over the lower slip level must be from 0.3 to 6", strength);
  require(
      strength * std::sqrt(2 * arriving) >= 0.25,
      "Transport: the rms acceleration of pulses over the lower slip level must be at least 0.25, below which slips "
      "are too rare",
      strength * std::sqrt(2 * arriving));
  check_contact(motion, std::abs(values[0]) * pulses.sigma() * std::sqrt(std::max(1.0, 2 * arriving)));
  const double turn = motion.natural_frequency() * half_width;
  require(turn <= 3, "Transport: natural_frequency times the half width of a pulse must be at most 3", turn);
}

}  // namespace

void Transport::check(const AnySlider& slider, const TransportExcitation& excitation) const {
  const detail::HeldMotion motion(slider);
  constexpr Direction forward = Direction::forward, backward = Direction::backward;
  require(motion.start(forward) > 0 && std::isfinite(motion.start(forward)),
          "Transport: the forward slip level must be positive and finite", motion.start(forward), "m/s^2");
  require(motion.start(backward) > 0, "Transport: the backward slip level must be positive", motion.start(backward),
          "m/s^2");
  const double least = motion.least(), wn = motion.natural_frequency();
  require(least > 0, "Transport: the least resistance to sliding at any speed must be positive", least, "m/s^2");
  if (const auto* pulses = std::get_if<PoissonPulses>(&excitation)) return check_pulses(motion, *pulses);
  if (std::isfinite(motion.reach()) && std::isfinite(motion.lift_off()))
    throw std::invalid_argument("Transport: does not cover casters on a slope, which roll away beyond their reach");
  const auto& noise = std::get<TwoStateNoise>(excitation);
  if (noise.white()) {
    if (!(noise.held() > 0) && std::isfinite(motion.lift_off()))
      throw std::invalid_argument(
          "Transport: continuous white noise lifts a slider off a slope; covers slopes under filtered noise");
    const double ratio = std::max(motion.start(forward), motion.start(backward)) / least;
    require(ratio <= 10 || !std::isfinite(ratio),
            "Transport: under white noise a level must be at most 10 times the other, or infinite; their ratio", ratio);
    const double turn = wn * std::numbers::pi * noise.filter().s0() / (least * least);
    require(turn >= 0.05 || detail::equal(wn, 0),
            "Transport: under white noise natural_frequency times pi S0 / a^2 must be at least 0.05", turn);
    const double hold = motion.start(forward) * motion.reach() * wn, supply = std::numbers::pi * noise.filter().s0();
    require(detail::equal(wn, 0) || hold >= 3 * supply,
            "Transport: a caster on a spring under white noise must have a slip level times reach times "
            "natural_frequency of at least 3 pi S0 = " +
                detail::shortest(3 * supply) + " m^2/s^3",
            hold, "m^2/s^3");
    if (noise.held() > 0) check_contact(motion, std::sqrt(2 * std::numbers::pi * noise.filter().s0() / noise.held()));
    if (motion.breaks_away() && !(noise.held() > 0))
      throw std::invalid_argument(
          "Transport: continuous white noise exceeds any friction at rest at once; give the kinetic law alone");
    return;
  }
  const ShapingFilter::Section& section = noise.filter().sections().front();
  const double frequency = std::sqrt(section.d0), damping = section.d1 / (2 * frequency);
  require(damping >= 0.1 && damping <= 1.5, "Transport: the damping ratio of the filter must be from 0.1 to 1.5",
          damping);
  require(wn <= 5 * frequency,
          "Transport: natural_frequency must be at most 5 times the frequency of the filter, " +
              detail::shortest(5 * frequency) + " rad/s",
          wn, "rad/s");
  const double rms = detail::FilterStates(noise.filter()).rms;
  check_contact(motion, rms);
  require(rms / motion.least_hold() >= 0.35,
          "Transport: the rms acceleration over the lower slip level must be at least 0.35, below which slips are too "
          "rare",
          rms / motion.least_hold());
  require(rms / least <= 20,
          "Transport: the rms acceleration over the least slip level must be at most 20, above which friction hardly "
          "matters",
          rms / least);
  if (std::isfinite(motion.reach())) check_caster(motion, noise.filter(), frequency, damping, rms);
  if (motion.breaks_away() && wn > 0) check_static_on_spring(motion, frequency, damping, rms, tolerance_);
}

TransportPrediction Transport::predict(const AnySlider& slider, const TransportExcitation& excitation,
                                       std::span<const double> times, const Progress& progress) const {
  check(slider, excitation);
  detail::check_times("Transport", times);
  const auto started = std::chrono::steady_clock::now();
  Moments moments = detail::moments_at(times);
  moments.remark = remark_of(excitation);
  const TransportProblem problem(slider, excitation);
  constexpr Estimates Moments::*const estimates[] = {&Moments::displacement_mean, &Moments::displacement_variance,
                                                     &Moments::covariance, &Moments::velocity_mean,
                                                     &Moments::velocity_variance};
  TransportCost cost;
  // Times that the steps to the last one resolve, then those before with shorter steps.
  std::size_t levels = 4;
  for (std::size_t end = times.size(), begin = end; end > 0 && times[end - 1] > 0; end = begin) {
    const auto [step, steps] = problem.steps_to(times[end - 1]);
    while (begin > 0 && times[begin - 1] >= problem.earliest(step)) --begin;
    const bool late = end == times.size();
    const Refined refined = moments_from_rest(problem, times.subspan(begin, end - begin), tolerance_, levels, progress);
    for (std::size_t k = begin; k < end; ++k)
      for (std::size_t i = 0; i < 5; ++i) {
        const auto at = static_cast<Eigen::Index>(5 * (k - begin) + i);
        (moments.*estimates[i]).value[k] = refined.value[at];
        (moments.*estimates[i]).error[k] = refined.error[at];
      }
    if (!late) continue;
    cost.nodes = refined.nodes, cost.steps = steps, levels = refined.levels;
    const Eigen::Index last = refined.value.size();
    if (!problem.pulses()) {
      require_accuracy(refined, tolerance_, last - 4, "the variance of the displacement at the last time");
      require_accuracy(refined, tolerance_, last - 1, "the variance of the velocity at the last time");
    }
  }
  for (const std::size_t variance : {1U, 4U})  // where it is far below its error, interpolation can leave less than 0
    for (double& value : (moments.*estimates[variance]).value) value = std::max(value, 0.0);
  // With the step of the stationary motion: to a short time steps are short.
  if (problem.wanders())
    moments.growth_rate = {std::numeric_limits<double>::quiet_NaN(), 0};
  else
    moments.growth_rate =
        problem.sprung() ? Estimate{0, 0} : stationary_estimates(problem, tolerance_, false, progress).growth_rate;
  cost.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  return {std::move(moments), cost, *this, slider, excitation};
}

TransportPrediction::TransportPrediction(Moments moments, const TransportCost& cost, const Transport& theory,
                                         const AnySlider& slider, const TransportExcitation& excitation)
    : Moments(std::move(moments)),
      cost_(cost),
      tolerance_(theory.tolerance()),
      slider_(slider),
      excitation_(excitation) {}

TransportPeak TransportPrediction::peak(double end) const { return {Transport(tolerance_), slider_, excitation_, end}; }

TransportPeak::TransportPeak(const Transport& theory, const AnySlider& slider, const TransportExcitation& excitation,
                             double time)
    : tolerance_(theory.tolerance()), slider_(slider), excitation_(excitation), time_(time) {
  require(time > 0 && std::isfinite(time), "TransportPeak: time must be positive and finite", time, "s");
}

Estimate TransportPeak::exceedance(double level, const Progress& progress) const {
  require(level > 0 && std::isfinite(level), "TransportPeak: level must be positive and finite", level, "m");
  const TransportProblem problem(slider_, excitation_);
  const auto [step, steps] = problem.steps_to(time_);
  const auto window = window_from_rest(problem, step, steps, progress);
  const Refined refined = refine(
      problem, window, step, {.tolerance = tolerance_, .judged = {0}, .levels = 1},
      [&](const Chain& chain) { return Figures::Constant(1, exceeded(chain, time_, progress)); }, level);
  return {refined.value[0], refined.whole_error(0)};
}

Estimate TransportPeak::quantile(double probability, const Progress& progress) const {
  require(probability >= 0.01 && probability <= 0.999, "TransportPeak: probability must be from 0.01 to 0.999",
          probability);
  const TransportProblem problem(slider_, excitation_);
  const auto [step, steps] = problem.steps_to(time_);
  const auto window = window_from_rest(problem, step, steps, progress);
  const auto rms = std::sqrt(history_from_rest(problem.chain(step, 0, window), steps, progress).back().xx);
  // ln P(peak > level) of the coarse grid over ln(level), less that wanted.
  const double wanted = std::log1p(-probability);
  const auto excess = [&, h = step](double ln_level) {
    const Chain chain = problem.chain(h, 0, window, std::exp(ln_level));
    return std::log(std::max(exceeded(chain, time_, progress), 1e-12)) - wanted;
  };
  double low = std::log(rms), at_low = excess(low), high = low, at_high = at_low;
  while (at_low < 0 && std::exp(low) > 1e-3 * rms) high = low, at_high = at_low, at_low = excess(low -= 0.4);
  if (at_low < 0) {  // more than this part hardly moves
    const Estimate above = exceedance(std::exp(low), progress);
    if (above.value + above.error < 1 - probability) return {0, std::exp(low)};
  }
  while (at_high > 0 && std::exp(high) < 1e3 * rms) low = high, at_low = at_high, at_high = excess(high += 0.4);
  if (!(at_low > 0 && at_high < 0))
    throw ConvergenceError("TransportPeak: no level within a factor of 1000 of the rms displacement, " +
                           detail::shortest(rms) + " m, has the probability " + detail::shortest(probability));
  const double coarse = numerics::root(excess, low, at_low, high, at_high, 1e-3);
  const double slope = (excess(coarse + 0.02) - excess(coarse - 0.02)) / 0.04;
  const Estimate there = exceedance(std::exp(coarse), progress);
  const double level = std::exp(coarse - (std::log(there.value) - wanted) / slope);
  return {level, level * there.error / there.value / std::abs(slope)};
}

DisplacementDistribution Transport::displacement(const AnySlider& slider, const TransportExcitation& excitation,
                                                 double time, const Progress& progress) const {
  check(slider, excitation);
  require(time > 0 && std::isfinite(time), "Transport: time must be positive and finite", time, "s");
  const TransportProblem problem(slider, excitation);
  const auto [longest, steps] = problem.steps_to(time);
  auto window = window_from_rest(problem, longest, steps, progress);
  const Estimate resting = problem.resting(time);
  const MotionMoments last = history_from_rest(problem.chain(longest, 0, window), steps, progress).back();
  // Where slips are rare, single ones shape the law: their steps are shorter.
  const double step = resting.value > 0.01 && !problem.pulses() && !(problem.held() > 0) ? longest / 2 : longest;
  // The rms of those that have slipped, and wider until hardly any lies beyond.
  window.graded = true;
  window.x = std::sqrt((last.xx + last.x * last.x) / std::max(1 - resting.value, 1e-3));
  constexpr double beyond = 2e-5;
  const auto law = [&](const Chain& chain, std::span<const double> points) -> Figures {
    return at_time<Figures>(chain, time, Figures::Zero(static_cast<Eigen::Index>(points.size())),
                            [&](std::size_t count) -> Figures {
                              const auto below = chain.below(weights_from_rest(chain, count - 1, progress), points);
                              return Eigen::Map<const Figures>(below.data(), static_cast<Eigen::Index>(below.size()));
                            });
  };
  const bool both = !problem.one_way();
  double end = 0;
  for (int wider = 0;; ++wider) {
    const Chain coarse = problem.chain(step, 0, window);
    end = coarse.farthest();
    if (wider == 5) break;
    const Figures found = law(coarse, std::array{-0.9 * end, 0.9 * end});
    if (std::abs(1 - found[1]) + std::abs(found[0]) < beyond) break;
    window.x *= 1.4;
  }
  // The probabilities of at most each of some values below 0, and of more than each of some above it: so that errors in
  // the tails are small.
  constexpr std::size_t count = 40;
  std::vector<double> points;
  for (std::size_t i = count; both && i > 0; --i)
    points.push_back(-end * std::pow(static_cast<double>(i) / count, 2.5));
  const std::size_t before = points.size();
  for (std::size_t i = 1; i <= count; ++i) points.push_back(end * std::pow(static_cast<double>(i) / count, 2.5));
  const Refined refined =
      refine(problem, window, step, {.tolerance = tolerance_, .judged = {}, .levels = 1}, [&](const Chain& chain) {
        Figures found = law(chain, points);
        const Eigen::Index above = found.size() - static_cast<Eigen::Index>(before);
        found.tail(above) = 1 - found.tail(above).array();
        return found;
      });
  detail::DisplacementTable table{.atom = resting.value, .atom_error = resting.error};
  const auto add = [&](double x, double below, double error) {
    const double least = table.below.empty() ? 0 : table.below.back();
    table.displacement.push_back(x);
    table.below.push_back(std::clamp(below, least, 1 - resting.value));  // within the errors
    table.error.push_back(error);
  };
  const auto error = [&](std::size_t i) { return refined.whole_error(static_cast<Eigen::Index>(i)); };
  const auto found = [&](std::size_t i) { return refined.value[static_cast<Eigen::Index>(i)]; };
  for (std::size_t i = 0; i < before; ++i) add(points[i], found(i), error(i));
  const double first = 1 - found(before) - resting.value;
  add(0, both ? (table.below.back() + first) / 2 : 0, std::max(resting.error, error(before)));
  for (std::size_t i = before; i < points.size(); ++i) add(points[i], 1 - found(i) - resting.value, error(i));
  table.below.front() = 0;
  table.below.back() = 1 - resting.value;
  // Where some have not slipped, others have slipped by next to nothing, and within the two narrowest panels the law is
  // only known to lie between its values at 0 and at their end.
  constexpr std::size_t unresolved = 4;
  for (std::size_t k = 1; k <= unresolved && resting.value > 1e-3; ++k) {
    if (both) table.error[before - k] += table.below[before] - table.below[before - unresolved - 1];
    table.error[before + k] += table.below[before + unresolved + 1] - table.below[before];
  }
  return DisplacementDistribution(std::move(table), remark_of(excitation));
}

VelocityDistribution Transport::velocity(const AnySlider& slider, const TransportExcitation& excitation, double time,
                                         const Progress& progress) const {
  check(slider, excitation);
  require(time > 0 && std::isfinite(time), "Transport: time must be positive and finite", time, "s");
  const TransportProblem problem(slider, excitation);
  const auto [step, steps] = problem.steps_to(time);
  require(steps > 2 || problem.pulses(),
          "Transport: a velocity under held noise needs a time of more than two values, of " + detail::shortest(step) +
              " s; the time",
          time, "s");
  const auto window = window_from_rest(problem, step, steps, progress);
  // Values in both directions, finer near rest, to ten rms.
  std::vector<double> sizes;
  constexpr std::size_t count = 28;
  for (std::size_t i = 1; i <= count; ++i) {
    const double part = static_cast<double>(i) / count;
    sizes.push_back(10 * window.v * part * part * (0.5 + 0.5 * part));
  }
  const bool backward = !problem.one_way(), mirrored = problem.motion().mirrors();
  // The probabilities of less than 0, of 0, of more than each size, and of at most minus each size.
  const auto under_pulses = [&](const Chain& chain) -> Figures {
    Figures at_start = Figures::Zero(2 + 2 * count);
    at_start[1] = 1;
    return at_time(chain, time, at_start, [&](std::size_t number) -> Figures {
      const Chain::Speeds found = chain.speeds(weights_from_rest(chain, number - 1, progress), sizes);
      Figures figures = Figures::Zero(2 + 2 * count);
      figures[0] = backward ? found.backward : 0;
      figures[1] = found.rest;
      for (std::size_t i = 0; i < count; ++i) {
        const auto at = static_cast<Eigen::Index>(2 + i);
        figures[at] = found.forward - found.forward_to[i];
        if (backward) figures[at + static_cast<Eigen::Index>(count)] = found.backward - found.backward_to[i];
      }
      return figures;
    });
  };
  Accuracy accuracy{.tolerance = tolerance_, .judged = {}, .levels = 1, .slow = {1}};
  for (Eigen::Index i = 2; problem.pulses() && i < static_cast<Eigen::Index>(2 + 2 * count); ++i)
    accuracy.slow.push_back(i);
  const Refined refined = refine(problem, window, step, accuracy, [&, first = step, last = steps](const Chain& chain) {
    if (chain.pulses()) return under_pulses(chain);
    const auto parts = static_cast<std::size_t>(std::lround(first / chain.step()));
    const Chain::Vector p = weights_from_rest(chain, last * parts - chain.steps_to_below(), progress);
    Figures figures = Figures::Zero(2 + 2 * count);
    figures[0] = backward ? chain.below(p, 0, false) : 0;
    figures[1] = chain.below(p, 0, true) - figures[0];
    for (std::size_t i = 0; i < count; ++i) {
      const auto at = static_cast<Eigen::Index>(2 + i), opposite = at + static_cast<Eigen::Index>(count);
      if (progress) progress();
      figures[at] = 1 - chain.below(p, sizes[i], true);
      if (mirrored) figures[at] = (figures[at] + chain.below(p, -sizes[i], false)) / 2;
      if (backward) figures[opposite] = mirrored ? figures[at] : chain.below(p, -sizes[i], true);
    }
    return figures;
  });
  detail::VelocityTable table;
  const double atom = table.atom = problem.white() && !(problem.held() > 0) ? 0 : refined.value[1];
  double error = 0;
  for (std::size_t i = count; backward && i > 0; --i) {
    table.velocity.push_back(-sizes[i - 1]);
    table.below.push_back(refined.value[static_cast<Eigen::Index>(1 + count + i)]);
  }
  table.velocity.push_back(0);
  table.below.push_back(mirrored ? (1 - atom) / 2 : refined.value[0]);
  for (std::size_t i = 0; i < count; ++i) {
    table.velocity.push_back(sizes[i]);
    table.below.push_back(1 - atom - refined.value[static_cast<Eigen::Index>(2 + i)]);
    error = std::max(error, refined.whole_error(static_cast<Eigen::Index>(2 + i)));
  }
  table.below.front() = backward ? 0 : table.below.front();
  table.below.back() = 1 - atom;
  for (std::size_t i = 1; i < table.below.size(); ++i)  // within the errors
    table.below[i] = std::clamp(table.below[i], table.below[i - 1], 1 - atom);
  return {std::move(table), error, atom > 0 ? refined.whole_error(1) : 0, remark_of(excitation)};
}

VelocityDistribution TransportPrediction::velocity(double at, const Progress& progress) const {
  return Transport(tolerance_).velocity(slider_, excitation_, at, progress);
}

DisplacementDistribution TransportPrediction::displacement(double at, const Progress& progress) const {
  return Transport(tolerance_).displacement(slider_, excitation_, at, progress);
}

TransportStationary TransportPrediction::stationary(const Progress& progress) const {
  return Transport(tolerance_).stationary(slider_, excitation_, progress);
}

TransportStationary Transport::stationary(const AnySlider& slider, const TransportExcitation& excitation,
                                          const Progress& progress) const {
  check(slider, excitation);
  const TransportProblem problem(slider, excitation);
  if (std::isfinite(problem.motion().reach()))
    throw std::invalid_argument(
        "Transport: the motion of a caster does not become stationary without a spring, and slowly with one; predict "
        "it at late times");
  return stationary_estimates(problem, tolerance_, !problem.white() || problem.held() > 0, progress);
}

}  // namespace stickslip::theory
