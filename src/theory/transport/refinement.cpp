#include "theory/transport/refinement.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <optional>
#include <utility>

#include "stickslip/base/error.hpp"
#include "theory/transport/motion.hpp"

namespace stickslip::detail {
namespace {

using std::numbers::pi;

/// Panels from 0 to `end` whose widths grow from `first` to `widest`.
std::vector<double> graded(double first, double widest, double end) {
  std::vector<double> edges{0};
  for (double width = std::min(first, widest); edges.back() < end; width = std::min(1.7 * width, widest))
    edges.push_back(edges.back() + width);
  return edges;
}

/// Halves panels in x that are too wide for friction that falls off over a reach: within three of it they are at most
/// half of it wide, beyond they grow.
std::vector<double> split(const std::vector<double>& edges, double reach) {
  std::vector<double> result{edges.front()};
  const std::function<void(double, double)> panel = [&](double from, double to) {
    const double near = std::min(std::abs(from), std::abs(to));
    if (to - from > reach / 2 + 0.35 * std::max(near - 3 * reach, 0.0)) {
      const double middle = (from + to) / 2;
      panel(from, middle);
      panel(middle, to);
    } else {
      result.push_back(to);
    }
  };
  for (std::size_t i = 1; i < edges.size(); ++i) panel(edges[i - 1], edges[i]);
  return result;
}

/// Edges from 0 on, those given among them, for friction that falls off over a reach: panels of one reach, and growing
/// by about two thirds each.
std::vector<double> growing(double reach, const std::vector<double>& ends) {
  std::vector<double> edges;
  double edge = 0;
  for (const double end : ends)
    while (edge < end) {
      const double width = reach + 0.65 * std::max(edge - reach, 0.0);
      edge = end - edge < 1.5 * width ? end : edge + width;
      edges.push_back(edge);
    }
  return edges;
}

}  // namespace

TransportProblem::TransportProblem(const AnySlider& slider, const theory::TransportExcitation& excitation)
    : motion_(slider) {
  if (const auto* pulses = std::get_if<PoissonPulses>(&excitation)) {
    const PulseShape& shape = pulses->options().shape;
    const double half_width = shape.times()[1] * pulses->half_width();
    pulses_ = {half_width,
               {pulses->rate() * half_width, std::abs(shape.values()[0] * pulses->sigma())},
               pulses->options().stationary_start,
               std::sqrt(pulses->ground_velocity_variance())};
    power_ = pi * pulses->density(motion_.natural_frequency());
    return;
  }
  const auto& noise = std::get<theory::TwoStateNoise>(excitation);
  held_ = noise.held();
  power_ = pi * noise.filter()(motion_.natural_frequency());
  if (noise.white())
    s0_ = noise.filter().s0();
  else
    filtered_.emplace(noise.filter());
}

double TransportProblem::level() const noexcept {
  return std::min(motion_.start(Direction::forward), motion_.start(Direction::backward));
}

double TransportProblem::levels_apart() const noexcept {
  return std::max(motion_.start(Direction::forward), motion_.start(Direction::backward)) / level();
}

double TransportProblem::first_step() const noexcept {
  if (held_ > 0) return held_;
  if (pulses_) return pulses_->half_width;
  const double wn = motion_.natural_frequency();
  if (filtered_) return wn > 0 ? std::min(0.4 / filtered_->frequency, 0.8 / wn) : 0.3 / filtered_->frequency;
  // A caster that has left its reach does not resist.
  return std::min((wanders() ? 0.12 : 0.08) * power_ / (level() * level()), wn > 0 ? 0.25 / wn : 1e300);
}

TransportProblem::Window TransportProblem::first_window() const noexcept {
  const double v = std::max(1.4 * power_ / motion_.least(), ground_velocity());
  return {sprung() ? v / motion_.natural_frequency() : 0, v};
}

/// A speed of the ground, which a mass on ice has.
double TransportProblem::ground_velocity() const noexcept {
  return pulses_ ? pulses_->velocity : filtered_ ? 0.5 * filtered_->rms / filtered_->frequency : 0;
}

TransportProblem::Window TransportProblem::free_window(double time) const noexcept {
  // Its velocity is Gaussian: half of the reach of an exponential distribution suffices. Of the velocity of the ground a
  // mass keeps what it had at the start.
  const double ground = 2 * ground_velocity();
  return {std::hypot(std::sqrt(2 * power_ * time * time * time / 3), ground * time),
          std::hypot(std::sqrt(2 * power_ * time), ground) / 2};
}

TransportProblem::Steps TransportProblem::steps_to(double time) const {
  const double step = first_step();
  if (!(time > 0)) return {step, 0};
  require(time >= earliest(step) || !pulses_,
          "Transport: a time under pulses must be 0 or at least " + shortest(earliest(step)) +
              " s, before which pulses do not overlap as they do on the lattice; it",
          time, "s");
  const double count = fixed_step() ? std::ceil(time / step - 1e-9) : std::max(least_steps(), std::ceil(time / step));
  require(count < 1e6, "Transport: the last time must be less than a million steps, of " + shortest(step) + " s; it",
          time, "s");
  return {fixed_step() ? step : time / count, static_cast<std::size_t>(count)};
}

Estimate TransportProblem::resting(double time) const {
  if (white() && !(held_ > 0)) return {0, 0};
  const double forward = motion_.hold(Direction::forward), backward = motion_.hold(Direction::backward);
  if (held_ > 0) {
    const LoadGrid load(std::sqrt(2 * pi * s0_ / held_));
    return {chance_of_loads(load, -forward, backward, static_cast<std::size_t>(std::ceil(time / held_ - 1e-9))), 0};
  }
  if (pulses_) {
    // Amplitudes on fine lattices whose nodes lie on either side of the lower level.
    const auto after = [&](std::size_t slots) {
      const double step = pulses_->half_width / static_cast<double>(slots), sigma = pulses_->arrivals.sigma;
      const double level = motion_.least_hold(), nodes = slots == 1 ? 30 : 4;
      const double spacing = level / (std::max(std::round(level * nodes / sigma), 1.0) - 0.5);
      const int reach = static_cast<int>(std::ceil(4.5 * sigma / spacing));
      const double none = std::exp(-pulses_->arrivals.rate / static_cast<double>(slots));
      pulse_chain::Weights batch = pulses_->arrivals.batch(1 / static_cast<double>(slots), spacing, reach);
      batch[0] -= none;
      const LoadGrid load(batch, none, slots, pulses_->stationary ? std::optional(batch) : std::nullopt);
      return chance_of_loads(load, -forward, backward, static_cast<std::size_t>(std::ceil(time / step - 1e-9)));
    };
    const double once = after(1), twice = after(2);
    return {std::clamp(twice + (twice - once) / 3, 0.0, 1.0), std::abs(twice - once)};
  }
  // Noise whose middles of steps stay within the levels, which are lowered as in `chain`.
  const double lowering = 0.5826 * filtered_->roughness, farthest = 4.5 * filtered_->rms;
  const double least = std::max(24.0, 4 * time / first_step());
  const double count = std::ceil(std::max(least, time * std::pow(4 * lowering / motion_.least_hold(), 2)));
  if (count > 20 * least) return {0, 0};  // it slips at once
  const auto after = [&](double steps) {
    const double step = time / steps, less = lowering * std::sqrt(step);
    const double low = -std::min(forward - less, farthest), high = std::min(backward - less, farthest);
    std::vector<double> edges, jumps;
    if (low > -farthest) edges.push_back(low - farthest), jumps.push_back(low);
    for (double i = 0; i <= 4; ++i) edges.push_back(low + (high - low) * i / 4);
    if (high < farthest) edges.push_back(high + farthest), jumps.push_back(high);
    const LoadGrid load(*filtered_, {edges, 6, jumps}, 13, step);
    return chance_of_loads(load, low, high, static_cast<std::size_t>(steps));
  };
  const double once = after(count), twice = after(2 * count);
  return {std::clamp(2 * twice - once, 0.0, 1.0), std::abs(twice - once)};
}

TransportProblem::Slip TransportProblem::strong_pulse(double reach) const {
  const double amplitude = (0.2 * reach + 2) * pulses_->arrivals.sigma * std::sqrt(1 + pulses_->arrivals.rate);
  const double speed = pulses_->half_width * amplitude, past = speed * pulses_->half_width / 2;
  return {past + speed * speed / (2 * (amplitude + motion_.least())), speed};
}

Panels TransportProblem::velocities(double step, std::size_t degree, double rms, double reach) const {
  double end = std::max(reach * rms, 0.8 * reach * ground_velocity());
  if (pulses_) end = std::max(end, strong_pulse(reach).velocity);
  const auto side = [&](Direction direction) {
    const double against = std::min(motion_.start(direction), end / step);
    // A held white load changes the velocity by this much; slips that end within the step have corners at 2 a h.
    const double kick = white() ? std::sqrt(2 * pi * s0_ * (held_ > 0 ? held_ : step)) : 0;
    std::vector<double> edges =
        graded(std::min(white() ? kick / 2 : against * step, motion_.speed() / 2), std::max(2 * rms, end / 8), end);
    const double corner = 2 * against * step;
    if (white() && corner < end) {
      const auto next = std::ranges::lower_bound(edges, corner);
      if (*next > corner) edges.insert(next, corner);
    }
    return edges;
  };
  std::vector<double> edges;
  if (!motion_.mirrors() && !one_way()) {
    edges = side(Direction::backward);
    std::ranges::reverse(edges);
    for (double& edge : edges) edge = -edge;
    edges.pop_back();
  }
  const std::vector<double> forward = side(Direction::forward);
  edges.insert(edges.end(), forward.begin(), forward.end());
  return {edges, degree, {0}};
}

TransportProblem::Lattice TransportProblem::lattice(double step, std::size_t fineness) const {
  const double sigma = pulses_->arrivals.sigma, level = motion_.least_hold();
  const double arriving = pulses_->arrivals.rate * step / pulses_->half_width;
  const auto slots = static_cast<std::size_t>(std::lround(pulses_->half_width / step));
  const double batch = sigma * std::max(1.0, std::sqrt(arriving) / 1.5);
  // Loads of successive steps are averaged independently of each other over some spacings. What that changes falls
  // with a high power of the spacing, and for short steps it is small. On a spring, where nodes are many, it is small
  // enough unless pulses are rare.
  const double spacing =
      slots == 1 ? std::min(batch, std::max(1.5 * level, batch / 2)) / (fineness < 2 ? 3 : 4.5)
                 : std::min(sprung() && arriving > 0.25 ? batch : batch / 1.25, std::max(4 * level, 4 * sigma / 3) / 3);
  const double farthest = (fineness == 0 ? 4 : 4.5) * sigma * std::sqrt(1 + arriving / 2);
  return {spacing, static_cast<int>(std::ceil(farthest / spacing)), slots, arriving};
}

bool TransportProblem::can_halve_slots(bool with_x) const {
  const Lattice halved = lattice(pulses_->half_width / 2, 0);
  return with_x ? halved.reach <= 6 && halved.spacing <= 1.2 * motion_.least_hold() : halved.reach <= 8;
}

double TransportProblem::error_of_one_slot() const {
  if (!motion_.mirrors()) return 0.4;
  return 0.2 * std::pow(std::min(1.0, motion_.least_hold() / pulses_->arrivals.sigma), 1.5);
}

double TransportProblem::error_of_start(double time) const {
  if (!pulses_ || !pulses_->stationary || can_halve_slots(with_displacement())) return 0;
  return 0.7 * pulses_->half_width / time;
}

LoadGrid TransportProblem::batches(double step, std::size_t fineness) const {
  const auto [spacing, reach, slots, arriving] = lattice(step, fineness);
  const double none = std::exp(-arriving);
  const auto weights = [&, spacing = spacing, reach = reach](pulse_chain::Arrivals arrivals) {
    pulse_chain::Weights batch = arrivals.batch(step / pulses_->half_width, spacing, reach);
    batch[0] -= none;
    return batch;
  };
  std::optional<pulse_chain::Weights> past;
  if (pulses_->stationary) {
    // What is left of those that began before the start must move a free mass as in continuous time, where they began
    // between the nodes of the lattice: with half the slots that is part of the change.
    pulse_chain::Arrivals before = pulses_->arrivals;
    if (!can_halve_slots(with_displacement())) before.sigma *= std::sqrt(2.0 / 3);
    past = weights(before);
  }
  return {weights(pulses_->arrivals), none, slots, past};
}

Chain TransportProblem::chain(double step, std::size_t fineness, const Window& window, double wall) const {
  constexpr std::size_t hiddens[] = {7, 9, 13, 17, 21};
  constexpr double speeds[] = {10, 12, 15, 19, 24}, displacements[] = {6.2, 7.2, 8.4, 9.6, 11};  // over their rms
  const bool with_x = with_displacement() || std::isfinite(wall) || window.graded;
  const std::size_t degree = 3 + fineness, hidden = hiddens[fineness] - (with_x ? 2 : 0);
  Panels x, v = velocities(step, degree, window.v, speeds[fineness]);
  if (with_x) {
    std::vector<double> edges{0};
    double end = displacements[fineness] * window.x;
    if (pulses_) end = std::max(end, strong_pulse(speeds[fineness]).displacement);
    const double panels = pulses_ && fineness == 0 ? 3 : 5;
    std::vector<double> parts;
    if (std::isfinite(wall))
      parts = {0.2, 0.4, 0.6, 0.75, 0.87, 0.95, 1.0};
    else if (window.graded && pulses_)  // whose errors are larger, and whose states are many
      parts = {0.005, 0.016, 0.042, 0.1, 0.23, 0.44, 0.7, 1};
    else if (window.graded)
      parts = {0.002, 0.005, 0.0095, 0.016, 0.026, 0.042, 0.064, 0.1, 0.15,
               0.23,  0.33,  0.44,   0.55,  0.66,  0.77,  0.88,  1};
    else
      for (double i = 1; i <= panels; ++i) parts.push_back(i / panels);
    const bool thrifty = filtered_ && std::isfinite(motion_.reach());
    if (thrifty && wanders() && !std::isfinite(wall) && !window.graded) parts = {1.0};
    if (thrifty) parts = growing(motion_.reach() / (std::isfinite(wall) ? wall : end), parts);
    for (const double part : parts) {
      const double edge = part * (std::isfinite(wall) ? wall : end);
      edges.push_back(edge);
      if (!(window.graded && one_way())) edges.insert(edges.begin(), -edge);
    }
    x = {thrifty ? edges : split(edges, motion_.reach()), degree};
  }
  if (pulses_) return {motion_, x, v, batches(step, fineness), step, wall};
  if (!filtered_) return {motion_, x, v, LoadGrid(std::sqrt(2 * pi * s0_ / (held_ > 0 ? held_ : step))), step, wall};

  // The held load passes the level of rest less often than the noise: by as much as a level that is higher by this,
  // see M. Broadie, P. Glasserman, S. Kou, Math. Finance 7 (1997), 325-349.
  const HeldMotion motion = motion_.holding_less(0.5826 * filtered_->roughness * std::sqrt(step));

  // Panels in the load: two between the levels, where the slider stays at rest, and two beyond each. A level that the
  // load hardly ever reaches is no edge.
  const double rms = filtered_->rms, farthest = 4.5 * rms;
  const double forward = motion.hold(Direction::forward), backward = motion.hold(Direction::backward);
  const auto beyond = [&](double level) { return std::max(farthest, level + 2.5 * rms); };
  const double low = forward < farthest ? -forward : -farthest, high = backward < farthest ? backward : farthest;
  std::vector<double> edges, jumps;
  if (forward < farthest) edges = {-beyond(forward), -(beyond(forward) + forward) / 2};
  const double parts = forward < farthest && backward < farthest ? 2 : 4;
  for (double i = 0; i <= parts; ++i) edges.push_back(low + (high - low) * i / parts);
  if (backward < farthest) edges.insert(edges.end(), {(beyond(backward) + backward) / 2, beyond(backward)});
  if (motion.breaks_away()) {
    jumps = {low, high};
    // A slip that begins needs a smaller load.
    for (const double edge : {-motion.start(Direction::forward), motion.start(Direction::backward)})
      if (edge > low && edge < high) edges.push_back(edge);
    std::ranges::sort(edges);
  }
  return {motion, x, v, LoadGrid(*filtered_, {edges, degree + 1, jumps}, hidden, step), step, wall};
}

namespace {

/// Pulses, with one slot to a half width on finer and finer grids. What two slots change is found on the coarsest grid.
/// The lattice of arrivals makes an error of second order in the slots, of which two leave a quarter, and terms of
/// higher order: what is left with two slots is 0.20 to 0.27 of what they have changed, docs/transport.md.
Refined refine_pulses(const TransportProblem& problem, const TransportProblem::Window& window, const Accuracy& accuracy,
                      const std::function<Figures(const Chain&)>& compute, double wall) {
  constexpr double whole = 1.24, uncertain = 0.12, least = 0.03;
  Refined result;
  const auto with = [&](double slots, std::size_t fineness) {
    const Chain chain = problem.chain(problem.first_step() / slots, fineness, window, wall);
    result.nodes = std::max(result.nodes, chain.size());
    return compute(chain);
  };
  const Figures coarse = with(1, 0);
  Figures before = coarse;
  for (std::size_t fineness = 1; fineness <= std::min<std::size_t>(accuracy.levels, 2); ++fineness) {
    result.value = with(1, fineness);
    result.error = (result.value - before).cwiseAbs();
    before = result.value;
    if (result.within(accuracy)) break;
  }
  if (!problem.can_halve_slots(problem.with_displacement() || std::isfinite(wall))) {
    result.lattice = std::max(problem.error_of_one_slot(), least) * result.value.cwiseAbs();
    return result;
  }
  const Figures change = with(2, 0) - coarse;
  result.lattice = Figures::Zero(change.size());
  for (Eigen::Index i = 0; i < change.size(); ++i) {
    const double scale = std::abs(coarse[i]) > 0 ? std::clamp(result.value[i] / coarse[i], 0.5, 2.0) : 1;
    // Probabilities of rest and of slow motion change in no such order.
    const bool slow = std::ranges::find(accuracy.slow, i) != accuracy.slow.end();
    result.value[i] += (slow ? 1 : whole) * scale * change[i];
    result.lattice[i] = (slow ? 1 : uncertain) * scale * std::abs(change[i]) + least * std::abs(result.value[i]);
  }
  return result;
}

}  // namespace

bool Refined::within(const Accuracy& accuracy) const {
  return std::ranges::all_of(accuracy.judged,
                             [&](Eigen::Index i) { return error[i] <= accuracy.tolerance * std::abs(value[i]); });
}

Refined refine(const TransportProblem& problem, const TransportProblem::Window& window, double first_step,
               const Accuracy& accuracy, const std::function<Figures(const Chain&)>& compute, double wall) {
  if (problem.pulses()) return refine_pulses(problem, window, accuracy, compute, wall);
  constexpr std::size_t most_nodes = 8'000'000;
  const bool one_way = problem.one_way(), breaks_away = problem.motion().breaks_away() && !problem.white();
  // Under white noise with levels far apart the steps are not yet short for the higher one, and changes are up to
  // three times too small.
  const double caution = problem.white() && problem.levels_apart() > 5 ? 3 : 1;
  Refined result;
  std::map<std::pair<std::size_t, std::size_t>, Figures> found;
  const auto with = [&](std::size_t halvings, std::size_t fineness) -> const Figures& {
    auto [at, is_new] = found.try_emplace({halvings, fineness});
    if (is_new) {
      const Chain chain = problem.chain(std::ldexp(first_step, -static_cast<int>(halvings)), fineness, window, wall);
      result.nodes = std::max(result.nodes, chain.size());
      at->second = compute(chain);
    }
    return at->second;
  };
  for (std::size_t level = 0; level < accuracy.levels; ++level) {
    const std::size_t fineness = level + 1;
    // The steps. The error of white noise has the powers 1, 3/2, 2, ... of the step, with one-way sliding, which
    // reflects the velocity at 0, from 1/2 on; that of filtered noise has the power 2, and 1, 3/2, ... where the slider
    // breaks away.
    std::size_t first = 0, last = 0;
    if (!(problem.held() > 0))
      first = problem.white() ? 0 : level, last = level + (problem.white() ? (one_way ? 3 : 2) : breaks_away ? 2 : 1);
    result.levels = level + 1;
    std::vector<Figures> column;
    for (std::size_t k = first; k <= last; ++k) column.push_back(with(k, fineness));
    Figures before = column.back(), last_change = Figures::Zero(before.size());
    result.error = last_change;
    for (std::size_t stage = 1; stage <= last - first; ++stage) {
      const double lowest = problem.white() && one_way ? 0.5 : problem.white() || breaks_away ? 1 : 2;
      const double ratio = std::exp2(lowest + 0.5 * static_cast<double>(stage - 1));
      for (std::size_t k = 0; k + stage <= last - first; ++k)
        column[k] = (ratio * column[k + 1] - column[k]) / (ratio - 1);
      const Figures& finest = column[last - first - stage];
      const Figures now = caution * (finest - before).cwiseAbs();
      result.error = now.cwiseMax(std::exchange(last_change, now) / 2);
      before = finest;
    }
    result.value = column.front();
    for (const Eigen::Index i : accuracy.slow) {
      if (last == first) break;
      // Filtered noise crosses a level infinitely often: the error is of the order of the root of the step. Successive
      // halvings change it by 1.3 to 1.9 times less.
      const double now = with(last, fineness)[i], change = now - with(last - 1, fineness)[i];
      result.value[i] = now + change / 0.6;
      result.error[i] = std::abs(change);
    }
    const std::size_t same = problem.white() ? last : first;
    result.error += (with(same, fineness) - with(same, fineness - 1)).cwiseAbs();
    // The linear systems and the quadratures have errors of this size; where the slider breaks away, the load at which
    // it does. On a spring that load depends on x, and values jump within a panel.
    result.error = result.error.cwiseMax((!breaks_away       ? 5e-7
                                          : problem.sprung() ? 4e-2
                                                             : 5e-3) *
                                         result.value.cwiseAbs());
    if (result.within(accuracy)) break;
    if (4 * result.nodes > most_nodes) break;
  }
  result.lattice = Figures::Zero(result.value.size());
  return result;
}

}  // namespace stickslip::detail
