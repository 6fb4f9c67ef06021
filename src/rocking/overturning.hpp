// When it is certain that a slender block overturns.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "rocking/leg.hpp"
#include "stickslip/base/units.hpp"
#include "stickslip/ground/ground_motion.hpp"
#include "stickslip/rocking/slender_block.hpp"

namespace stickslip::detail {

/// The certificate of overturning. On the right, q = theta' + p (theta - alpha) and d = theta' - p (theta - alpha) are
///     q = q* + sigma,  d = d* + delta,  theta - alpha = Theta + (sigma - delta)/(2p)
/// with the bounded motion Theta = (q* - d*)/(2p) under the whole record; sigma grows as e^(pt), delta decays as e^(-pt).
/// On the left the same of -theta under -n. Level ground without vertical motion only.
class Overturning {
 public:
  Overturning(const SlenderBlock& block, const GroundMotion& motion)
      : p_(block.p()),
        alpha_{block.alpha_right(), block.alpha_left()},
        ahead_(motion.samples()),
        behind_(motion.samples()),
        least_(motion.samples()),
        most_(motion.samples()) {
    const std::size_t last = motion.segments();
    double largest = 0;
    for (std::size_t i = last; i-- > 0;) {
      const Segment s = motion.segment(i);
      largest = std::max({largest, std::abs(s.start), std::abs(s.end)});
      ahead_[i] = before(s, decay(s.duration), s.duration, ahead_[i + 1]);
    }
    for (std::size_t i = 0; i < last; ++i) {
      const Segment s = motion.segment(i);
      const auto [x, lost] = decay(s.duration);
      const double rate = s.duration > 0 ? (s.end - s.start) / s.duration : 0;
      behind_[i + 1] = (1 - lost) * behind_[i] - (p_ * s.start * lost + rate * (x - lost)) / standard_gravity;
    }
    // After the record Theta decays. Between samples it departs from a straight line by (ph)^2/8 times the largest of
    // Theta - n/g, which is at most twice that of n/g.
    const auto bounded = [&](std::size_t i) { return (ahead_[i] - behind_[i]) / (2 * p_); };
    least_[last] = std::min(bounded(last), 0.0);
    most_[last] = std::max(bounded(last), 0.0);
    for (std::size_t i = last; i-- > 0;) {
      const double x = p_ * motion.segment(i).duration, bend = x * x / 8 * (2 * largest / standard_gravity);
      least_[i] = std::min({least_[i + 1], bounded(i) - bend, bounded(i + 1) - bend});
      most_[i] = std::max({most_[i + 1], bounded(i) + bend, bounded(i + 1) + bend});
    }
  }

  /// Whether a block never comes back, at a sample.
  bool certain(std::size_t sample, const RockingState& state) const noexcept {
    if (state.mode == RockingMode::rest) return false;
    const double s = sign(state.mode), alpha = alpha_[s > 0 ? 0 : 1];
    const double tilt = p_ * (s * state.rotation - alpha), rate = s * state.rate;
    const double sigma = rate + tilt - s * ahead_[sample], delta = rate - tilt - s * behind_[sample];
    const double least = s > 0 ? least_[sample] : -most_[sample];
    return sigma > 0 && alpha + least + (sigma - std::max(delta, 0.0)) / (2 * p_) > 0;
  }

  /// |sigma| / (p alpha), the distance from the stable manifold, within a segment.
  /// @param left  time to its end [s]
  double distance(std::size_t segment, const Segment& ground, double left, const RockingLeg::Place& at,
                  double s) const noexcept {
    const double alpha = alpha_[s > 0 ? 0 : 1];
    const double part = ground.duration > 0 ? left / ground.duration : 0;
    const Segment rest{left, ground.end + part * (ground.start - ground.end), ground.end};
    const double sigma = s * at.rate + p_ * (s * at.rotation - alpha) -
                         s * before(rest, {p_ * left, -std::expm1(-p_ * left)}, left, ahead_[segment + 1]);
    return std::abs(sigma) / (p_ * alpha);
  }

 private:
  // p h and 1 - e^(-p h) of a duration h. Most segments have the same.
  struct Decay {
    double x, lost;
  };
  Decay decay(double duration) noexcept {
    if (!equal(duration, usual_)) {
      usual_ = duration;
      decay_ = {p_ * duration, -std::expm1(-p_ * duration)};
    }
    return decay_;
  }

  // q* at the beginning of a segment, from that at its end.
  double before(const Segment& s, const Decay& by, double duration, double after) const noexcept {
    const double rate = duration > 0 ? (s.end - s.start) / duration : 0;
    return (p_ * s.start * by.lost + rate * (by.lost - by.x * (1 - by.lost))) / standard_gravity +
           (1 - by.lost) * after;
  }

  double p_;
  double alpha_[2];
  double usual_ = -1;
  Decay decay_{};
  std::vector<double> ahead_, behind_;  // q* and d* at the samples [rad/s]
  std::vector<double> least_, most_;    // bounds of Theta from a sample on [rad]
};

}  // namespace stickslip::detail
