// What runs of slender and of rigid blocks have in common.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <span>
#include <vector>

#include "base/samples.hpp"
#include "base/states_by_steps.hpp"
#include "rocking/leg.hpp"
#include "stickslip/base/equal.hpp"
#include "stickslip/base/error.hpp"
#include "stickslip/base/units.hpp"
#include "stickslip/ground/ground_motion.hpp"
#include "stickslip/rocking/integrate.hpp"
#include "stickslip/rocking/response.hpp"
#include "stickslip/rocking/state.hpp"

namespace stickslip::detail {

constexpr double quarter_turn = std::numbers::pi / 2;  // the block lies on its side

/// `integrate` without the motion at the samples.
RockingResponse integrate_without_samples(const SlenderBlock& block, const GroundMotion& motion,
                                          const RockingOptions& options);
RockingResponse integrate_without_samples(const RockingBlock& block, const GroundMotion& motion,
                                          const RockingOptions& options);

inline RockingState start_of(const RockingOptions& options) {
  require(std::isfinite(options.rotation) && std::abs(options.rotation) < quarter_turn,
          "integrate: rotation must be below pi/2 in magnitude", options.rotation, "rad");
  require(std::isfinite(options.rate), "integrate: rate must be finite", options.rate, "rad/s");
  return RockingState::at(options.rotation, options.rate);
}

inline RockingSegment segment_of(const GroundMotion& motion, std::size_t i) {
  const Segment s = motion.segment(i);
  RockingSegment ground{s.duration, s.start, s.end, standard_gravity, standard_gravity};
  if (motion.has_vertical()) {
    const bool held = motion.interpolation() == Interpolation::constant;
    ground.heavy_start += motion.vertical()[i];
    ground.heavy_end += motion.vertical()[held ? i : i + 1];
  }
  return ground;
}
/// Of a user's own loop.
/// @throws std::invalid_argument  a number that is not finite
inline RockingSegment segment_of(const RockingGround& segment, const RockingState& state) {
  for (const double value : {segment.duration, segment.start, segment.end, segment.vertical_start, segment.vertical_end,
                             state.rotation, state.rate})
    require(std::isfinite(value), "advance: segment and state must be finite", value);
  return {segment.duration, segment.start, segment.end, standard_gravity + segment.vertical_start,
          standard_gravity + segment.vertical_end};
}

/// Without ground motion, which never comes back.
constexpr RockingSegment calm_for(double duration) noexcept {
  return {duration, 0, 0, standard_gravity, standard_gravity, true};
}

/// Keeps samples after the end of a motion, up to the first at or after a time, but at most ten times as many as the motion
/// has.
/// @param sampled  the state at the end of the motion
/// @param at_end   that at the time
/// @param move     `move(segment, state)`
/// @param keep     `keep(state)`
template <class Move, class Keep>
void keep_until(double end, const GroundMotion& motion, RockingState sampled, const RockingState& at_end,
                RockingResponse& response, Move&& move, Keep&& keep) {
  const RockingSegment calm{motion.last_step(), 0, 0, standard_gravity, standard_gravity};
  for (std::size_t i = motion.segments(); motion.time(i) < end; ++i) {
    if (i + 1 >= 10 * motion.samples()) {
      response.truncated = true;
      return;
    }
    move(calm, sampled);
    if (!(motion.time(i + 1) < end)) sampled = at_end;
    keep(sampled);
  }
}

/// `states_at` of both blocks.
template <class Block>
std::vector<RockingState> states_by_advance(const Block& block, const GroundMotion& motion,
                                            const RockingResponse& response, std::span<const double> times) {
  const auto step = [&](RockingState& state, double duration, std::size_t i, double from, double to) {
    RockingGround ground{duration, 0, 0};
    if (i < motion.segments()) {
      const RockingSegment whole = segment_of(motion, i);
      const auto at = [](double start, double end, double part) { return start + part * (end - start); };
      const double up_start = whole.heavy_start - standard_gravity, up_end = whole.heavy_end - standard_gravity;
      ground = {duration, at(whole.n_start, whole.n_end, from), at(whole.n_start, whole.n_end, to),
                at(up_start, up_end, from), at(up_start, up_end, to)};
    }
    advance(block, ground, state);
  };
  return states_by_steps(motion, times, RockingState::at(response.rotation.front(), response.rate.front()),
                         response.rotation.size(), response.events.back().time, response.state, step);
}

/// Adds a rotation to the peaks.
template <class Block>
void reach(RockingResponse& response, const Block& block, double rotation, double time) {
  const double size = std::abs(rotation);
  response.peak_ratio = std::max(response.peak_ratio, size / (rotation > 0 ? block.alpha_right() : block.alpha_left()));
  if (!(size > response.peak)) return;
  response.peak = size;
  response.peak_time = time;
}
/// The peaks of a block that has overturned are those of its side on the ground.
inline void finish_peak(RockingResponse& response) {
  if (response.overturned == 0) return;
  response.peak = quarter_turn;
  response.peak_time = response.overturned_at;
  response.peak_ratio = std::numeric_limits<double>::infinity();
}

/// The maxima at rest of the load over the level at which a block leaves it.
class LoadMaxima {
 public:
  /// @param decide  `decide(margin)`, the distance from 1 of a maximum above all before
  template <class Decide>
  void look(double load, Decide&& decide) {
    if (last_ > largest_ && load < last_ && rise_ > 0) {
      largest_ = last_;
      decide(1 - last_);
    }
    if (!equal(load, last_)) rise_ = load - last_;
    last_ = load;
  }
  void forget() noexcept { last_ = rise_ = 0; }

 private:
  double last_ = 0, rise_ = 0, largest_ = 0;
};

}  // namespace stickslip::detail
