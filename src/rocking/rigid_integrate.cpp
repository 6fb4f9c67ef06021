#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "rocking/overturning.hpp"
#include "rocking/rigid_leg.hpp"
#include "rocking/rigid_system.hpp"
#include "rocking/run.hpp"
#include "stickslip/base/error.hpp"
#include "stickslip/rocking/integrate.hpp"
#include "stickslip/run/detail/event_log.hpp"
#include "stickslip/run/detail/loop.hpp"
#include "stickslip/run/detail/run.hpp"

namespace stickslip {
namespace detail {
namespace {

class NoRigidSink final : public RigidSink {
 public:
  void follow(const RigidLeg&, double, double, const RigidLeg::Place&) override {}
  void event(EventKind, double, const RockingState&) override {}
};

// Moves a state through a segment. A block that lies on its side stays there.
void move(const RockingBlock& block, const RockingSegment& ground, RockingState& state, RigidSink& sink) {
  if (!(ground.duration > 0) || state.overturned != 0) return;
  RigidSystem system(block, ground, state);
  stickslip::detail::advance(system, sink);
}

double top_displacement(const RockingBlock& block, const RockingState& state) noexcept {
  return base_displacement(block, state) + block.height() * std::sin(state.rotation);
}

// The height of the lower corner in flight [m].
double lower_corner(const RockingBlock& block, const RockingState& state) noexcept {
  const double side = state.rotation < 0 ? -1 : 1;
  return state.rise + block.center_height() + arm(block, side, state.rotation).y;
}

class RigidRecorder final : public RigidSink, public EventLog<RockingEvent>, public Pace<4096> {
 public:
  RigidRecorder(const RockingBlock& block, const Overturning* overturning, double begin, const RockingState& state,
                std::size_t event_limit, const std::function<void()>& progress, RockingResponse& response)
      : EventLog(event_limit, {}), Pace(progress), block_(block), overturning_(overturning), response_(response) {
    reach(state.rotation, begin);
  }

  void begin_segment(double begin, double end, const RockingSegment& ground, std::optional<std::size_t> number) {
    EventLog::begin_segment(begin, end);
    ground_ = ground;
    number_ = number;
  }
  using EventLog::begin_segment;

  void follow(const RigidLeg& leg, double begin, double duration, const RigidLeg::Place& end) override {
    count_work();
    const double far = leg.bound();
    if (far > std::min(response_.peak, block_.alpha() / 2))
      leg.for_each_turn(duration, [&](double rotation, double t) {
        reach(rotation, when(begin + t));
        if (overturning_ == nullptr || !number_ || !(std::abs(rotation) > block_.alpha() / 2)) return;
        const Segment motion{ground_.duration, ground_.n_start, ground_.n_end};
        const double left = std::max(ground_.duration - begin - t, 0.0);
        decide(overturning_->distance(*number_, motion, left, {rotation, 0}, rotation > 0 ? 1 : -1));
      });
    reach(end.rotation, when(begin + duration));
    response_.energy.input += leg.input(duration);
    response_.energy.dissipated += leg.friction(duration);
    if (leg.rocks()) response_.time_rocking += duration;
    if (!leg.slips()) return;
    response_.time_sliding += duration;
    response_.sliding_distance += std::abs(end.displacement - leg.begins_at());
  }

  void event(EventKind kind, double time, const RockingState& state) override {
    switch (kind) {
      case EventKind::arrest:
        add(RockingEventKind::rest, time, state, 0);
        break;
      case EventKind::end:
        add(RockingEventKind::end, time, state, 0);
        break;
      default:
        if (state.mode == RockingMode::flight) {
          happens(RockingEventKind::liftoff, time, state, 0, 0, state.rate);
          break;
        }
        if (on_corner(state.mode)) {
          if (equal(state.rotation, 0) && equal(state.rate, 0)) ++response_.uplifts;
          add(RockingEventKind::uplift, time, state, sign(state.mode));
        }
        if (state.slip != 0) add(RockingEventKind::slip, time, state, on_corner(state.mode) ? sign(state.mode) : 0);
    }
  }
  void happens(RockingEventKind kind, double time, const RockingState& state, double side, double speed,
               double after) override {
    add(kind, time, state, side, speed, after);
    if (kind == RockingEventKind::liftoff) ++response_.liftoffs;
    if ((kind == RockingEventKind::impact || kind == RockingEventKind::landing) && speed > 1e-3) ++response_.impacts;
    if (kind != RockingEventKind::overturned) return;
    reach(state.rotation, when(time));
    response_.overturned = side > 0 ? 1 : -1;
    response_.overturned_at = when(time);
  }
  void lose(double energy) override { response_.energy.impact += energy; }
  void fall(double energy) override { response_.energy.damped += energy; }
  void slipped() override { ++response_.impacts_with_slip; }
  void decide(double margin) { response_.margin = std::min(response_.margin, margin); }

  void finish(RockingResponse& response) {
    for (const EventAt<RockingEvent>& one : take()) {
      response.events.push_back(one.displacement);
      response.events.back().time = one.time;
    }
    finish_peak(response);
  }

 private:
  void add(RockingEventKind kind, double time, const RockingState& state, double side) {
    add(kind, time, state, side, 0, state.rate);
  }
  void add(RockingEventKind kind, double time, const RockingState& state, double side, double speed, double after) {
    count_work();
    EventLog::add({}, time,
                  {0, state.rotation, state.rate, kind, after, base_displacement(block_, state), speed,
                   static_cast<std::int8_t>(side)},
                  {});
  }
  void reach(double rotation, double time) { detail::reach(response_, block_, rotation, time); }

  const RockingBlock& block_;
  const Overturning* overturning_;  // null under vertical motion
  RockingResponse& response_;
  RockingSegment ground_{};
  std::optional<std::size_t> number_{};
};

class RigidRun {
 public:
  using State = RockingState;
  using Response = RockingResponse;
  using Recorder = RigidRecorder;

  RigidRun(const RockingBlock& block, const GroundMotion& motion, const RockingOptions& options, Samples samples)
      : block_(block),
        motion_(motion),
        options_(options),
        samples_(samples),
        slender_(std::min(block.p_right(), block.p_left()), block.alpha_right(), block.alpha_left(),
                 std::min(block.restitution_right(), block.restitution_left())) {
    if (!motion.has_vertical()) overturning_.emplace(slender_, motion);
  }

  const GroundMotion& motion() const noexcept { return motion_; }
  const RockingOptions& options() const noexcept { return options_; }

  State start() const { return start_of(options_); }

  Recorder recorder(const State& state, Response& response) const {
    for (std::vector<double>* history :
         {&response.rotation, &response.rate, &response.displacement, &response.top_displacement, &response.gap}) {
      history->clear();
      if (samples_ == Samples::kept) history->reserve(motion_.samples());
    }
    keep(state, response);
    response.condition = std::numeric_limits<double>::quiet_NaN();
    if (motion_.has_vertical()) response.components = "axis + vertical";
    return {block_,  overturning_ ? &*overturning_ : nullptr, motion_.time(0),
            state,   max_events(motion_.segments()),          options_.progress,
            response};
  }

  void walk(State& state, Recorder& recorder, Response& response) const {
    const std::size_t count = motion_.segments();
    LoadMaxima maxima;
    for (std::size_t i = 0; i < count; ++i) {
      const RockingSegment ground = segment_of(motion_, i);
      if (is_stuck(state)) {
        const double first = load(ground.n_start, ground.heavy_start), then = load(ground.n_end, ground.heavy_end);
        if (first <= 1 && then <= 1) {
          for (const double now : {first, then}) maxima.look(now, [&](double margin) { recorder.decide(margin); });
          keep(state, response);
          continue;
        }
      }
      maxima.forget();
      recorder.begin_segment(motion_.time(i), motion_.time(i + 1), ground, i);
      move(block_, ground, state, recorder);
      keep(state, response);
      if (i % Recorder::work_per_report == 0) recorder.report_progress();
    }
  }

  double settle(State& state, Recorder& recorder, Response& response) const {
    const double begin = motion_.time(motion_.segments()), longest = 64 / std::min(block_.p_right(), block_.p_left());
    const State at_end_of_motion = state;
    double time = begin;
    for (int tries = 0; !is_stuck(state) && state.overturned == 0; ++tries) {
      if (tries > 10'000 || equal(block_.mu(), 0) || (equal(block_.lever_left(), 0) && equal(block_.lever_right(), 0)))
        throw ConvergenceError(
            "integrate: this block does not come to rest, because its impacts or its friction lose too little; "
            "integrate "
            "it without settle");
      const RockingSegment calm = calm_for(longest);
      recorder.begin_segment(time, time + longest, calm, {});
      move(block_, calm, state, recorder);
      time += longest;
    }
    const double end = std::max(begin, recorder.last_event());
    if (samples_ == Samples::dropped) return end;
    NoRigidSink none;
    keep_until(
        end, motion_, at_end_of_motion, state, response,
        [&](const RockingSegment& calm, State& one) { move(block_, calm, one, none); },
        [&](const State& one) { keep(one, response); });
    return end;
  }

  double kinetic(const State& state) const { return kinetic_energy(block_, velocity(block_, state)); }
  double elastic(const State& state) const { return standard_gravity * rise(block_, state); }
  void finish(const State& state, Response& response) const {
    response.state = state;
    response.residual = base_displacement(block_, state);
  }

 private:
  // The load over the level at which the block slips, rocks or leaves the ground.
  double load(double n, double heavy) const noexcept {
    if (!(heavy > 0)) return never;
    const double most = std::min((n < 0 ? block_.right() : block_.left()) / block_.center_height(), block_.mu());
    return equal(n, 0) ? 0 : std::abs(n) / (most * heavy);
  }
  void keep(const State& state, Response& response) const {
    if (samples_ == Samples::dropped) return;
    response.rotation.push_back(state.rotation);
    response.rate.push_back(state.rate);
    response.displacement.push_back(base_displacement(block_, state));
    response.top_displacement.push_back(top_displacement(block_, state));
    response.gap.push_back(state.mode == RockingMode::flight ? lower_corner(block_, state) : 0);
  }

  const RockingBlock& block_;
  const GroundMotion& motion_;
  const RockingOptions& options_;
  Samples samples_;
  SlenderBlock slender_;
  std::optional<Overturning> overturning_{};
};

}  // namespace

RockingResponse integrate_without_samples(const RockingBlock& block, const GroundMotion& motion,
                                          const RockingOptions& options) {
  return integrate_run(RigidRun(block, motion, options, Samples::dropped), {});
}

}  // namespace detail

RockingResponse integrate(const RockingBlock& block, const GroundMotion& motion, const RockingOptions& options) {
  return detail::integrate_run(detail::RigidRun(block, motion, options, detail::Samples::kept), {});
}

void advance(const RockingBlock& block, const RockingGround& segment, RockingState& state) {
  const detail::RockingSegment ground = detail::segment_of(segment, state);
  RockingState moved = state;
  detail::NoRigidSink none;
  detail::move(block, ground, moved, none);
  state = moved;
}

std::vector<RockingState> states_at(const RockingBlock& block, const GroundMotion& motion,
                                    const RockingResponse& response, std::span<const double> times) {
  return detail::states_by_advance(block, motion, response, times);
}

}  // namespace stickslip
