#include "stickslip/sweep/sweep.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <mutex>
#include <stdexcept>
#include <tuple>

#include "base/threads.hpp"
#include "lanes/level_lanes.hpp"
#include "sweep/sweep_groups.hpp"

namespace stickslip::detail {
namespace {

struct Stopped {};

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

class Sweep {
 public:
  Sweep(std::span<const SweepSlider> sliders, std::span<const SweepGroup> groups,
        std::span<const GroundMotion* const> motions, const SweepOptions& options)
      : sliders_(sliders), motions_(motions), options_(options) {
    table_.sliders = sliders.size();
    table_.records = motions.size();
    table_.polarity = options.polarity;
    table_.polarities = options.polarity == Polarity::both ? 2 : 1;
    const std::size_t size = table_.sliders * table_.records * table_.polarities;
    for (auto* values : {&table_.peak, &table_.residual, &table_.sliding_distance})
      values->assign(size, std::numeric_limits<double>::quiet_NaN());
    table_.events.assign(size, 0);
    table_.airborne.assign(size, 0);
    if (std::ranges::any_of(sliders, &SweepSlider::has_stops)) table_.impacts.assign(size, {});

    for (std::size_t s = 0; s < sliders.size(); ++s)
      if (const auto& block = sliders[s].block; block && has_level_lanes(block->law))
        add_lanes(s, *block);
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
    const std::size_t tasks_a_record = (lanes_.empty() ? 0 : 1) + grouped;
    const std::size_t tasks = tasks_a_record * motions_.size();
    std::atomic<std::size_t> next = 0;
    const auto work = [&] {
      Response storage;
      for (std::size_t task; !stopped_ && (task = next++) < tasks;) {
        const std::size_t record = task / tasks_a_record, part = task % tasks_a_record;
        if (part == grouped)
          run_lanes(record);
        else if (part >= singles_.size())
          run_group(parts_[part - singles_.size()], record);
        else
          for_each_polarity([&](bool reversed) { run_single(singles_[part], record, reversed, storage); });
      }
    };
    run_on_threads(options_.threads, tasks, stopped_, work, [this] {
      if (options_.progress) options_.progress({done_, table_.peak.size()});
    });
    std::ranges::sort(table_.failures, {},
                      [](const SweepFailure& f) { return std::tuple(f.slider, f.record, f.polarity); });
    return std::move(table_);
  }

 private:
  void add_lanes(std::size_t slider, const LevelBlock& block) {
    const auto& law = block.law;
    const bool alike = block.slope_degrees == 0 && law.static_forward() == law.static_backward() &&
                       law.sliding().forward() == law.sliding().backward();
    const bool both = options_.polarity == Polarity::both;
    if (options_.polarity != Polarity::reversed) lanes_.push_back({slider, block, false, both && alike});
    if (options_.polarity == Polarity::reversed || (both && !alike)) lanes_.push_back({slider, block, true, false});
  }

  template <class Use>
  void for_each_polarity(Use&& use) const {
    for (const bool reversed : {false, true})
      if (options_.polarity != (reversed ? Polarity::recorded : Polarity::reversed)) use(reversed);
  }

  std::size_t place(std::size_t slider, std::size_t record, bool reversed) const {
    return table_.at(slider, record, reversed && table_.polarities == 2 ? 1 : 0);
  }

  void write(std::size_t slider, std::size_t record, bool reversed, double peak, double residual,
             double sliding_distance, std::size_t events) {
    const std::size_t i = place(slider, record, reversed);
    table_.peak[i] = peak;
    table_.residual[i] = residual + 0.0;  // minus zero is zero
    table_.sliding_distance[i] = sliding_distance;
    table_.events[i] = events;
  }

  void fail(std::size_t slider, std::size_t record, bool reversed, const std::string& message) {
    const std::scoped_lock lock(mutex_);
    table_.failures.push_back({slider, record, reversed ? Polarity::reversed : Polarity::recorded, message});
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
    const GroundMotion& motion = *motions_[record];
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
    slide_levels(ground, lanes, options_.settle);
    for (std::size_t k = 0; k < lanes.size(); ++k) {
      const auto& [slider, block, reversed, both] = these[k];
      const LevelLane& lane = lanes[k];
      for (const bool other : {false, true}) {
        if (other && !both) continue;
        const bool turned = reversed || other;
        if (lane.failure.empty())
          write(slider, record, turned, lane.peak, other ? -lane.state.displacement : lane.state.displacement,
                lane.sliding_distance, lane.events);
        else
          fail(slider, record, turned, lane.failure);
        ++done_;
      }
    }
  }

  void check_stopped() const {
    if (stopped_) throw Stopped{};
  }

  /// Does `work`; calls `failed` with the message if a combination fails.
  template <class Work, class Failed>
  static void attempt(Work&& work, Failed&& failed) {
    try {
      work();
    } catch (const ConvergenceError& error) {
      failed(error.what());
    } catch (const std::overflow_error& error) {
      failed(error.what());
    } catch (const std::invalid_argument& error) {
      failed(error.what());
    }
  }

  void run_single(std::size_t slider, std::size_t record, bool reversed, Response& storage) {
    const IntegrateOptions how{.settle = options_.settle,
                               .contact = options_.contact,
                               .progress = [this] { check_stopped(); },
                               .may_end_in_flight = true};
    attempt(
        [&] {
          const GroundMotion& motion = *motions_[record];
          storage = sliders_[slider].integrate(reversed ? motion.scaled(-1) : motion, how,
                                               std::exchange(storage, Response{}));
          write(slider, record, reversed, storage.peak, storage.residual, storage.sliding_distance,
                storage.events.size() - 1);
          const std::size_t i = place(slider, record, reversed);
          table_.airborne[i] = storage.state.in_flight ? 1 : 0;
          if (!table_.impacts.empty()) table_.impacts[i] = impacts(storage.events);
        },
        [&](const char* message) { fail(slider, record, reversed, message); });
    ++done_;
  }

  void run_group(const GroupPart& part, std::size_t record) {
    SweepGroup::Each integrate;
    std::string failure;
    attempt([&] { integrate = part.group.start(*motions_[record], options_.settle, [this] { check_stopped(); }); },
            [&](const char* message) { failure = message; });
    for (std::size_t k = part.begin; k < part.end; ++k)
      for_each_polarity([&](bool reversed) {
        check_stopped();
        const std::size_t slider = part.group.sliders[k];
        if (!integrate)
          fail(slider, record, reversed, failure);
        else
          attempt(
              [&] {
                const SweepOutcome outcome = integrate(k, reversed);
                write(slider, record, reversed, outcome.peak, outcome.residual, outcome.sliding_distance,
                      outcome.events);
                if (!table_.impacts.empty()) table_.impacts[place(slider, record, reversed)] = outcome.impacts;
              },
              [&](const char* message) { fail(slider, record, reversed, message); });
        ++done_;
      });
  }

  std::span<const SweepSlider> sliders_;
  std::span<const GroundMotion* const> motions_;
  const SweepOptions& options_;
  std::vector<Lane> lanes_;
  std::vector<std::size_t> singles_;  // sliders integrated one at a time
  std::vector<GroupPart> parts_;
  SweepTable table_;
  std::mutex mutex_;  // guards the failures
  std::atomic<bool> stopped_ = false;
  std::atomic<std::size_t> done_ = 0;
};

}  // namespace

SweepTable sweep(std::span<const SweepSlider> sliders, std::span<const SweepGroup> groups,
                 std::span<const GroundMotion* const> motions, const SweepOptions& options) {
  if (sliders.empty()) throw std::invalid_argument("sweep: needs at least one slider, got an empty list");
  if (motions.empty()) throw std::invalid_argument("sweep: needs at least one ground motion, got an empty list");
  return Sweep(sliders, groups, motions, options).run();
}

SweepTable sweep(std::span<const SweepSlider> sliders, std::span<const GroundMotion* const> motions,
                 const SweepOptions& options) {
  return sweep(sliders, {}, motions, options);
}

}  // namespace stickslip::detail
