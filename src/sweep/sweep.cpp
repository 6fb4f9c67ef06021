#include "stickslip/sweep/sweep.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "lanes/level_lanes.hpp"
#include "lanes/linear_lanes.hpp"
#include "sweep/combinations.hpp"
#include "sweep/sweep_groups.hpp"

namespace stickslip::detail {
namespace {

/// A block in a lane: the index of its slider and its polarity. A block with equal levels in both directions on level
/// ground is integrated once for both polarities: the reversed motion only mirrors its response.
struct Lane {
  std::size_t slider;
  LevelBlock block;
  bool reversed, both;

  bool has_static() const {
    const auto& law = block.law;
    return law.static_forward() != law.sliding().forward() || law.static_backward() != law.sliding().backward();
  }
  /// The properties that all lanes of a group share.
  auto kind() const { return std::tuple(block.slope_degrees, has_static(), reversed); }
};

/// Sliders of a group that make one task.
struct GroupPart {
  const SweepGroup& group;
  std::size_t begin, end;
};

class Sweep : Combinations<double, Impacts> {
 public:
  Sweep(std::span<const SweepSlider> sliders, std::span<const SweepGroup> groups,
        std::span<const GroundMotion* const> motions, const SweepOptions& options)
      : Combinations(sliders.size(), std::ranges::any_of(sliders, &SweepSlider::has_stops), motions, options),
        sliders_(sliders) {
    for (std::size_t s = 0; s < sliders.size(); ++s)
      if (const auto& block = sliders[s].block; block && has_level_lanes(block->law))
        add_lanes(s, *block);
      else if (sliders[s].mover)
        linear_.push_back(s);
      else if (sliders[s].integrate)
        singles_.push_back(s);
    // With few records, threads share a group, and each of them does its common work.
    const std::size_t most = motions.size() < 8 ? 64 : std::numeric_limits<std::size_t>::max();
    for (const SweepGroup& group : groups)
      for (std::size_t begin = 0; begin < group.sliders.size();) {
        const std::size_t end = begin + std::min(most, group.sliders.size() - begin);
        parts_.push_back({group, std::exchange(begin, end), end});
      }
    // Neighbors in this order behave almost alike.
    std::ranges::stable_sort(lanes_, {}, [](const Lane& lane) {
      const double forward = lane.block.law.static_forward(), backward = lane.block.law.static_backward();
      return std::tuple(lane.kind(), std::isinf(backward), std::min(forward, backward));
    });
  }

  SweepTable run() {
    // Long tasks first would be fairer, but these are short: a record's lanes, or one slider under one record.
    const std::size_t grouped = singles_.size() + parts_.size();
    const std::size_t linear = (linear_.size() + linear_part - 1) / linear_part;
    const std::size_t tasks_a_record = (lanes_.empty() ? 0 : 1) + linear + grouped;
    return Combinations::run(tasks_a_record * motions(), [&](const auto& next) {
      Response storage;
      for (std::size_t task; next(task);) {
        const std::size_t record = task / tasks_a_record, part = task % tasks_a_record;
        if (part == grouped + linear)
          run_lanes(record);
        else if (part >= grouped)
          run_linear(part - grouped, record);
        else if (part >= singles_.size())
          run_group(parts_[part - singles_.size()], record);
        else
          run_single(singles_[part], record, storage);
      }
    });
  }

 private:
  void add_lanes(std::size_t slider, const LevelBlock& block) {
    const auto& law = block.law;
    const bool alike = block.slope_degrees == 0 && law.static_forward() == law.static_backward() &&
                       law.sliding().forward() == law.sliding().backward();
    const bool both = options().polarity == Polarity::both;
    if (options().polarity != Polarity::reversed) lanes_.push_back({slider, block, false, both && alike});
    if (options().polarity == Polarity::reversed || (both && !alike)) lanes_.push_back({slider, block, true, false});
  }

  void run_lanes(std::size_t record) {
    for (std::span<const Lane> left = lanes_; !left.empty();) {
      const auto end = std::ranges::find_if(left, [&](const Lane& lane) { return lane.kind() != left[0].kind(); });
      const auto count = static_cast<std::size_t>(end - left.begin());
      run_lanes(record, left.first(count));
      left = left.subspan(count);
    }
  }

  void run_lanes(std::size_t record, std::span<const Lane> these) {
    const GroundMotion& motion = this->motion(record);
    const Lane& one = these[0];
    const bool weighed = one.block.slope_degrees > 0 || one.has_static() || motion.has_vertical();
    const LevelGround ground =
        weighed ? LevelGround(motion, one.block.slope_degrees, one.reversed) : LevelGround(motion);
    if (!ground.usable()) {
      Response storage;
      for (const Lane& lane : these) {
        run_single(lane.slider, record, lane.reversed, storage);
        if (lane.both) run_single(lane.slider, record, true, storage);
      }
      return;
    }
    std::vector<LevelLane> lanes;
    for (const Lane& lane : these) lanes.push_back({lane.block.law, lane.reversed && !weighed});
    slide_levels(ground, lanes, options().settle);
    for (std::size_t k = 0; k < lanes.size(); ++k) {
      const auto& [slider, block, reversed, both] = these[k];
      const LevelLane& lane = lanes[k];
      for (const bool other : {false, true}) {
        if (other && !both) continue;
        const bool turned = reversed || other;
        const double residual = other ? -lane.state.displacement : lane.state.displacement;
        if (lane.failure.empty())
          write(slider, record, turned, {lane.peak, residual, lane.sliding_distance, lane.events});
        else
          fail(slider, record, turned, lane.failure);
      }
    }
  }

  void run_single(std::size_t slider, std::size_t record, bool reversed, Response& storage) {
    run_single(slider, record, reversed, false, storage);
  }
  void run_single(std::size_t slider, std::size_t record, bool reversed, bool mirrors, Response& storage) {
    Combinations::run_single(slider, sliders_[slider].integrate, record, reversed, mirrors, IntegrateOptions{}, storage,
                             impacts);
  }
  // In each polarity, once if the slider mirrors: under the motion as recorded, so that no polarity changes the bits.
  void run_single(std::size_t slider, std::size_t record, Response& storage) {
    const bool mirrors = sliders_[slider].mirrors;
    for (const bool reversed : {false, true})
      if (mirrors ? !reversed : is_wanted(reversed)) run_single(slider, record, reversed, mirrors, storage);
  }

  void run_linear(std::size_t part, std::size_t record) {
    const auto these = std::span(linear_).subspan(part * linear_part);
    run_linear(record, these.first(std::min(linear_part, these.size())));
  }
  void run_linear(std::size_t record, std::span<const std::size_t> these) {
    const GroundMotion& motion = this->motion(record);
    Response storage;
    const LevelGround ground(motion);
    if (motion.has_vertical() || !ground.usable()) {
      for (const std::size_t slider : these) run_single(slider, record, storage);
      return;
    }
    std::vector<LinearLane> lanes;
    std::vector<std::size_t> of;
    for (const std::size_t slider : these)
      for (const bool turned : {false, true}) {
        if (sliders_[slider].mirrors ? turned : !is_wanted(turned)) continue;
        lanes.push_back({sliders_[slider].mover(motion.dt()), turned});
        of.push_back(slider);
      }
    slide_linear(ground, lanes, options().settle);
    for (std::size_t k = 0; k < lanes.size(); ++k) {
      const LinearLane& lane = lanes[k];
      const bool mirrors = sliders_[of[k]].mirrors;
      check_stopped();
      if (lane.failed) {
        run_single(of[k], record, lane.turned, mirrors, storage);
        continue;
      }
      const SweepOutcome outcome{lane.watch.peak, lane.state.displacement, lane.watch.sliding_distance,
                                 lane.watch.events, lane.watch.impacts};
      for_each_polarity([&](bool as) {
        if (as == lane.turned || mirrors) write(of[k], record, as, as == lane.turned ? outcome : outcome.mirrored());
      });
    }
  }

  void run_group(const GroupPart& part, std::size_t record) {
    SweepGroup::Each integrate;
    std::string failure;
    attempt([&] { integrate = part.group.start(motion(record), options().settle, [this] { check_stopped(); }); },
            [&](const char* message) { failure = message; });
    for (std::size_t k = part.begin; k < part.end; ++k)
      for_each_polarity([&](bool reversed) {
        check_stopped();
        const std::size_t slider = part.group.sliders[k];
        if (!integrate)
          fail(slider, record, reversed, failure);
        else
          attempt([&] { write(slider, record, reversed, integrate(k, reversed)); },
                  [&](const char* message) { fail(slider, record, reversed, message); });
      });
  }

  std::span<const SweepSlider> sliders_;
  std::vector<Lane> lanes_;
  static constexpr std::size_t linear_part = 64;  // sliders of a task
  std::vector<std::size_t> linear_;               // sliders in vectors whose motion is linear between events
  std::vector<std::size_t> singles_;              // sliders integrated one at a time
  std::vector<GroupPart> parts_;
};

}  // namespace

SweepTable sweep(std::span<const SweepSlider> sliders, std::span<const SweepGroup> groups,
                 std::span<const GroundMotion* const> motions, const SweepOptions& options) {
  return Sweep(sliders, groups, motions, options).run();
}

SweepTable sweep(std::span<const SweepSlider> sliders, std::span<const GroundMotion* const> motions,
                 const SweepOptions& options) {
  return sweep(sliders, {}, motions, options);
}

}  // namespace stickslip::detail
