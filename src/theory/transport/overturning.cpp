#include "stickslip/theory/overturning.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "stickslip/base/error.hpp"
#include "stickslip/base/units.hpp"
#include "theory/transport/rocking_chain.hpp"

namespace stickslip::theory {
namespace {

using detail::FilterStates;
using detail::LoadGrid;
using detail::Panels;
using detail::require;
using detail::RockingChain;
using detail::RockingScales;
using std::numbers::pi;

/// A block and its noise, in units of its p and its larger alpha.
class OverturningProblem {
 public:
  OverturningProblem(const SlenderBlock& block, const TwoStateNoise& noise, double ratio)
      : p_(block.p()),
        unit_(std::max(block.alpha_right(), block.alpha_left()) * standard_gravity),
        held_(noise.held()) {
    const double larger = std::max(block.alpha_right(), block.alpha_left());
    scales_ = {{block.alpha_right() / larger, block.alpha_left() / larger}, block.restitution(), 0, ratio};
    if (noise.white()) {
      s0_ = noise.filter().s0();
      deviation_ = std::sqrt(pi * p_ * s0_) / unit_;
    } else {
      filtered_.emplace(noise.filter());
      const Eigen::Matrix2d lasting = (Eigen::Matrix2d::Identity() - filtered_->rate / p_).inverse();
      deviation_ = filtered_->rms / unit_ * std::sqrt(lasting(0, 0));
    }
    scales_.lost = 5.5 * deviation_;
  }

  /// Of what the noise adds to v + y from any time on, weighed by e^-pt.
  double deviation() const noexcept { return deviation_; }
  double held() const noexcept { return held_; }
  bool white() const noexcept { return s0_ > 0; }

  /// A step with which errors are some tens of percent [s].
  double first_step() const noexcept {
    if (held_ > 0) return held_;
    return white() ? 0.2 / p_ : std::min(0.8 / filtered_->frequency, 0.3 / p_);
  }

  LoadGrid loads(double step, std::size_t level) const {
    if (white()) return LoadGrid(std::sqrt(2 * pi * s0_ / step));
    // Edges where a block at rest lifts.
    const double rms = filtered_->rms, farthest = 4.5 * rms;
    std::vector<double> edges{0};
    const double low = std::min(scales_.alpha[0], scales_.alpha[1]) * unit_;
    for (const double edge : {low / 2, low, unit_}) {
      if (edge < farthest && edge > edges.back() * (1 + 1e-9)) edges.push_back(edge);
    }
    const double last = edges.back(), beyond = std::max(farthest, last + 2.5 * rms);
    const double parts = std::ceil((beyond - last) / (1.5 * rms));
    for (double i = 1; i <= parts; ++i) edges.push_back(last + (beyond - last) * i / parts);
    return {*filtered_, {mirrored(edges), 4}, level == 0 ? 5U : 7U, step};
  }

  RockingChain chain(const LoadGrid& loads, double step, std::size_t level,
                     const std::function<void()>& progress) const {
    const double end = 1 + scales_.lost;
    // Panels that shrink toward the corner of rest, where small bounces are.
    const auto graded = [&](double shrinks, double far) {
      std::vector<double> edges{0};
      for (std::size_t k = 3 + level; k > 0; --k) edges.push_back(0.25 * std::pow(shrinks, static_cast<double>(k)));
      for (const double edge : {0.25, 0.5, 0.75, 1.0}) edges.push_back(edge);
      const double widest = level == 0 ? 0.5 : 0.35, parts = std::ceil((far - 1) / widest);
      for (double i = 1; i <= parts; ++i) edges.push_back(1 + (far - 1) * i / parts);
      return edges;
    };
    const std::size_t degree = level == 0 ? 4 : 5;
    std::vector<double> y = graded(0.25, end);
    if (scales_.level < end) {
      std::erase_if(y, [&](double edge) { return edge > 0.95 * scales_.level; });
      y.push_back(scales_.level);
    }
    return {
        scales_, {y, degree}, {mirrored(graded(0.4, end)), degree}, loads, unit_, p_ * step, white() && !(held_ > 0),
        progress};
  }

 private:
  static std::vector<double> mirrored(const std::vector<double>& edges) {
    std::vector<double> all;
    for (std::size_t i = edges.size(); i > 1; --i) all.push_back(-edges[i - 1]);
    all.insert(all.end(), edges.begin(), edges.end());
    return all;
  }

  double p_, unit_, held_;
  double s0_ = 0;  // of white noise
  std::optional<FilterStates> filtered_{};
  RockingScales scales_{};
  double deviation_ = 0;
};

/// The probability from rest after every step, continued once the probability a step is constant.
class Survival {
 public:
  Survival(const RockingChain& chain, std::size_t steps, double tolerance, const std::function<void()>& progress) {
    constexpr std::size_t apart = 64;
    RockingChain::Values f = chain.lost();
    lost_ = {0};
    while (lost_.size() <= steps) {
      if (progress) progress();
      f = chain.carry(f);
      lost_.push_back(chain.at_rest(f));
      const std::size_t now = lost_.size() - 1;
      if (now % apart != 0 || now < 3 * apart) continue;
      const double last = decay(now - apart, now), before = decay(now - 2 * apart, now - apart);
      if (last > 0 && std::abs(last - before) <=
                          0.01 * tolerance * last * (static_cast<double>(now) / static_cast<double>(steps))) {
        rate_ = last / apart;
        break;
      }
    }
  }

  double at(double place) const {
    const double most = static_cast<double>(lost_.size() - 1);
    if (place >= most) return 1 - (1 - lost_.back()) * std::exp(-rate_ * (place - most));
    const auto whole = static_cast<std::size_t>(place);
    const double part = place - static_cast<double>(whole);
    return lost_[whole] + (part > 0 ? part * (lost_[whole + 1] - lost_[whole]) : 0);
  }

 private:
  double decay(std::size_t from, std::size_t to) const { return std::log1p(-lost_[from]) - std::log1p(-lost_[to]); }

  std::vector<double> lost_;
  double rate_ = 0;  // a step
};

}  // namespace

std::vector<Estimate> overturning_probability(const SlenderBlock& block, const TwoStateNoise& noise,
                                              std::span<const double> times, const OverturningOptions& options) {
  const double tolerance = options.tolerance, right = block.alpha_right(), left = block.alpha_left();
  require(tolerance >= 0.005 && tolerance <= 0.3, "overturning_probability: tolerance must be from 0.005 to 0.3",
          tolerance);
  require(options.ratio > 0, "overturning_probability: ratio must be positive", options.ratio);
  require(
      block.restitution() >= 0.2,
      "overturning_probability: restitution must be at least 0.2, below which infinitely many impacts bring a block "
      "under noise to rest at once",
      block.restitution());
  require(std::max(right, left) <= 2 * std::min(right, left),
          "overturning_probability: one alpha must be at most twice the other; the ratio",
          std::max(right, left) / std::min(right, left));
  double before = 0;
  for (const double time : times) {
    require(std::isfinite(time) && time >= before,
            "overturning_probability: times must be finite, at least 0 and "
            "increasing",
            time, "s");
    before = time;
  }
  if (!noise.white()) {
    const ShapingFilter::Section& section = noise.filter().sections().front();
    const double frequency = std::sqrt(section.d0), damping = section.d1 / (2 * frequency);
    require(damping >= 0.1 && damping <= 1.5,
            "overturning_probability: the damping ratio of the filter must be from 0.1 to 1.5", damping);
    require(frequency >= 0.5 * block.p() && frequency <= 50 * block.p(),
            "overturning_probability: the frequency of the filter must be from 0.5 p to 50 p; over p",
            frequency / block.p());
  }
  const OverturningProblem problem(block, noise, options.ratio);
  require(
      problem.deviation() >= 0.04 && problem.deviation() <= 1,
      "overturning_probability: the deviation of the rate that the noise gives must be from 0.04 p alpha (below it, "
      "overturning is too rare) to 1 p alpha (above it, a block overturns at once); over p alpha",
      problem.deviation());
  const double last_time = times.empty() ? 0 : times.back();
  const double first_step = problem.first_step();
  require(last_time / first_step < 1e6,
          "overturning_probability: the last time must be less than a million steps, of " +
              detail::shortest(first_step) + " s; it",
          last_time, "s");

  // Steps and grids are refined together: a finer step on the same grid would let the errors of projection grow. The
  // error of filtered noise, which crosses the level of rest infinitely often, falls with the power 3/2 of the step.
  const std::size_t levels = problem.held() > 0 ? 2 : 3;
  const double gain = problem.white() ? 0 : 1 / (std::exp2(1.5) - 1);
  std::vector<Estimate> found(times.size());
  std::vector<double> coarse(times.size());
  for (std::size_t level = 0; level < levels; ++level) {
    const double halved = problem.held() > 0 ? 1 : std::exp2(-static_cast<double>(level)),
                 longest = first_step * halved;
    const double count = problem.held() > 0 ? 1 : std::max(1.0, std::ceil(last_time / longest));
    const double step = problem.held() > 0 ? longest : last_time > 0 ? last_time / count : longest;
    const LoadGrid loads = problem.loads(step, level);
    const RockingChain chain = problem.chain(loads, step, level, options.progress);
    const Survival survival(chain, static_cast<std::size_t>(std::ceil(last_time / step - 1e-9)), tolerance,
                            options.progress);
    bool within = level > 0;
    for (std::size_t i = 0; i < times.size(); ++i) {
      const double fine = std::clamp(survival.at(times[i] / step), 0.0, 1.0), change = fine - coarse[i];
      const double value = level == 0 || problem.held() > 0 ? fine : std::clamp(fine + gain * change, 0.0, 1.0);
      const double moved = std::abs(value - found[i].value);
      // A change may vanish by chance: grids of these sizes differ by this part.
      constexpr double least = 0.004;
      found[i] = {value, std::max({moved, (level < 2 ? 1 : 0.3) * std::abs(change), least * value})};
      if (found[i].error > tolerance * std::max(value, 1e-5)) within = false;
      coarse[i] = fine;
    }
    if (within) break;
  }
  return found;
}

}  // namespace stickslip::theory
