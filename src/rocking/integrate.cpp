#include "stickslip/rocking/integrate.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "rocking/leg.hpp"
#include "rocking/overturning.hpp"
#include "rocking/run.hpp"
#include "rocking/system.hpp"
#include "stickslip/base/error.hpp"
#include "stickslip/run/detail/event_log.hpp"
#include "stickslip/run/detail/loop.hpp"
#include "stickslip/run/detail/run.hpp"

namespace stickslip {
namespace detail {
namespace {

bool lies(const RockingState& state) noexcept { return std::abs(state.rotation) >= quarter_turn; }

RockingEventKind kind_of(EventKind kind) noexcept {
  switch (kind) {
    case EventKind::impact:
      return RockingEventKind::impact;
    case EventKind::arrest:
      return RockingEventKind::rest;
    case EventKind::end:
      return RockingEventKind::end;
    default:
      return RockingEventKind::uplift;
  }
}

double kinetic_energy(const RockingState& state) noexcept { return state.rate * state.rate / 2; }
double elastic_energy(const SlenderBlock& block, const RockingState& state) noexcept {
  const double tilt = std::abs(state.rotation), alpha = state.rotation < 0 ? block.alpha_left() : block.alpha_right();
  return block.p() * block.p() * tilt * (alpha - tilt / 2);
}

class NoRockingSink final : public RockingSink {
 public:
  void follow(const RockingLeg&, double, double, const RockingLeg::Place&) override {}
  void event(EventKind, double, const RockingState&) override {}
};

class RockingRecorder final : public RockingSink, public EventLog<double>, public Pace<4096> {
 public:
  RockingRecorder(const SlenderBlock& block, const GroundMotion& motion, const RockingState& state,
                  const std::function<void()>& progress, RockingResponse& response)
      : EventLog(max_events(motion.segments()), {}),
        Pace(progress),
        block_(block),
        motion_(motion),
        response_(response),
        count_from_(1e-3 * block.p() * block.alpha()) {
    reach(state.rotation, motion.time(0));
  }

  // The segment of the ground motion, and its number.
  void begin_segment(double begin, double end, const RockingSegment& ground, std::optional<std::size_t> number) {
    EventLog::begin_segment(begin, end);
    ground_ = ground;
    number_ = number;
  }
  using EventLog::begin_segment;

  void follow(const RockingLeg& leg, double begin, double duration, const RockingLeg::Place& end) override {
    count_work();
    const double s = leg.side();
    reach(end.rotation, when(begin + duration));
    leg.for_each_turn(duration, end, [&](const RockingLeg::Place& at, double t) {
      reach(at.rotation, when(begin + t));
      if (motion_.has_vertical() || !number_ || !(s * at.rotation > 0.5 * block_.alpha())) return;
      const Segment motion{ground_.duration, ground_.n_start, ground_.n_end};
      const double left = std::max(ground_.duration - begin - t, 0.0);
      response_.margin = std::min(response_.margin, overturning().distance(*number_, motion, left, at, s));
    });
    response_.energy.input += leg.input(end, duration);
    response_.time_rocking += duration;
    const RockingLeg varied(block_, ground_, begin, variation_, 0, sums());
    variation_ = varied.at(duration);
    arrives_ = leg.acceleration(end.rotation, duration);
  }

  // Moves a block through a whole segment about its corner, if it neither lands, turns nor falls there and the ground has no
  // vertical motion: what `follow` finds of its leg, without making one.
  bool glide(const RockingSegment& ground, double end, RockingState& state) {
    const double s = sign(state.mode), tilt = s * alpha_of(block_, state.mode), t = ground.duration;
    const double square = block_.p() * block_.p() / standard_gravity, heavy = ground.heavy_start;
    const double n = ground.n_start, slope = (ground.n_end - n) / t, p = std::sqrt(square * heavy), c = slope / heavy;
    const HyperbolicSums& sums = this->sums()(p, t);
    const double a = square * (heavy * (state.rotation - tilt) - n);
    const HyperbolicMotion motion{{state.rotation, state.rate}, a, c, p};
    const RockingPlace place = motion.at(sums);
    const double last = square * (heavy * (place.rotation - tilt) - ground.n_end);
    if (!(s * place.rotation > 0 && s * place.rotation < quarter_turn)) return false;
    if (!(state.rate * place.rate > 0 && a * last >= 0)) return false;
    count_work();
    reach(place.rotation, end);
    response_.energy.input +=
        work_of_ground(square, n, slope, t, place.rotation - state.rotation, motion.integral_of_rotation(sums, t));
    response_.time_rocking += t;
    variation_ = HyperbolicMotion{variation_, square * (heavy * variation_.rotation - n), c, p}.at(sums);
    state.rotation = place.rotation;
    state.rate = place.rate;
    return true;
  }

  void event(EventKind kind, double time, const RockingState& state) override {
    count_work();
    add(kind, time, state.rotation, state.rate);
    if (kind == EventKind::impact) {
      if (std::abs(state.rate) > count_from_) ++response_.impacts;
      variation_ = after_impact(block_, ground_, time, state, arrives_, variation_);
    } else {
      if (kind == EventKind::breakaway && equal(state.rotation, 0) && equal(state.rate, 0)) ++response_.uplifts;
      if (kind != EventKind::end) variation_ = {0, 0};
    }
  }
  void lose(double energy) override { response_.energy.impact += energy; }
  void fall(double energy) override { response_.energy.damped += energy; }
  void decide(double margin) { response_.margin = std::min(response_.margin, margin); }

  bool has_overturned() const noexcept { return response_.overturned != 0; }
  // Whether the block never comes back, at a sample.
  bool certain(std::size_t sample, const RockingState& state) {
    return !motion_.has_vertical() && !is_stuck(state) && overturning().certain(sample, state);
  }
  void overturned(double time, const RockingState& state) {
    response_.overturned = state.overturned;
    response_.overturned_at = time;
    log_overturning_ = {time, state.rotation, state.rate, RockingEventKind::overturned, state.rate};
  }
  // How far theta depends on the logarithm of the scale.
  void sample(const RockingState& state) {
    if (response_.overturned != 0) return;
    if (is_stuck(state)) variation_ = {0, 0};
    response_.condition = std::max(response_.condition, std::abs(variation_.rotation) / block_.alpha());
  }

  void finish(RockingResponse& response) {
    for (const EventAt<double>& one : take()) {
      if (log_overturning_ && log_overturning_->time <= one.time)
        response.events.push_back(*std::exchange(log_overturning_, std::nullopt));
      const double r = one.kind == EventKind::impact ? block_.restitution() : 1;
      response.events.push_back({one.time, one.displacement, one.velocity, kind_of(one.kind), r * one.velocity});
    }
    finish_peak(response);
  }

 private:
  // Made for the first rocking: many blocks never leave their rest.
  const Overturning& overturning() {
    if (!overturning_) overturning_.emplace(block_, motion_);
    return *overturning_;
  }
  void reach(double rotation, double time) { detail::reach(response_, block_, rotation, time); }

  const SlenderBlock& block_;
  const GroundMotion& motion_;
  std::optional<Overturning> overturning_{};
  RockingResponse& response_;
  double count_from_;
  RockingSegment ground_{};
  std::optional<std::size_t> number_{};
  std::optional<RockingEvent> log_overturning_{};
  RockingLeg::Place variation_{0, 0};  // of theta and theta' by the logarithm of the scale
  double arrives_ = 0;                 // theta'' at the end of the last leg
};

class RockingRun {
 public:
  using State = RockingState;
  using Response = RockingResponse;
  using Recorder = RockingRecorder;

  RockingRun(const SlenderBlock& block, const GroundMotion& motion, const RockingOptions& options, Samples samples)
      : block_(block), motion_(motion), options_(options), samples_(samples) {
    for (std::size_t i = 0; i < motion.vertical().size(); ++i)
      require(standard_gravity + motion.vertical()[i] > 0,
              "integrate: under this vertical motion the block leaves the ground, which a SlenderBlock cannot: "
              "g + a_z must be positive; is the vertical acceleration in m/s^2?",
              standard_gravity + motion.vertical()[i], "m/s^2");
  }

  const GroundMotion& motion() const noexcept { return motion_; }
  const RockingOptions& options() const noexcept { return options_; }

  State start() const { return start_of(options_); }

  Recorder recorder(const State& state, Response& response) const {
    const std::size_t kept = samples_ == Samples::kept ? motion_.samples() : 0;
    response.rotation.assign(kept, 0);
    response.rate.assign(kept, 0);
    keep(0, state, response);
    if (motion_.has_vertical()) response.components = "axis + vertical";
    return {block_, motion_, state, options_.progress, response};
  }

  void walk(State& state, Recorder& recorder, Response& response) const {
    const std::size_t count = motion_.segments();
    for (std::size_t i = 0; i < count; ++i) {
      if (is_stuck(state)) i = rest(i, recorder);
      if (i == count) break;
      const RockingSegment ground = segment_of(motion_, i);
      const bool glides = !motion_.has_vertical() && ground.duration > 0 && !lies(state) && !is_stuck(state);
      if (!(glides && recorder.glide(ground, motion_.time(i + 1), state))) {
        recorder.begin_segment(motion_.time(i), motion_.time(i + 1), ground, i);
        rock(block_, ground, state, recorder);
      }
      judge(i + 1, state, recorder);
      recorder.sample(state);
      keep(i + 1, state, response);
      if (i % Recorder::work_per_report == 0) recorder.report_progress();
    }
  }

  // Without ground motion a block falls where q = s theta' + p (s theta - alpha) is positive, and else comes to rest.
  double settle(State& state, Recorder& recorder, Response& response) const {
    const double begin = motion_.time(motion_.segments());
    const State at_end_of_motion = state;
    double time = begin;
    const double longest = 64 / block_.p();
    while (!is_stuck(state) && state.overturned == 0) {
      const double s = sign(state.mode);
      if (s * state.rate + block_.p() * (s * state.rotation - alpha_of(block_, state.mode)) > 0) {
        state.overturned = static_cast<std::int8_t>(s);
        recorder.overturned(time, state);
        break;
      }
      if (!(block_.restitution() < 1))
        throw ConvergenceError(
            "integrate: a block with a restitution of 1 never comes to rest; integrate it without settle");
      const RockingSegment calm = calm_for(longest);
      recorder.begin_segment(time, time + longest, calm, {});
      rock(block_, calm, state, recorder);
      time += longest;
      if (state.overturned != 0) recorder.overturned(recorder.last_event(), state);
    }
    const double end = std::max(begin, recorder.last_event());
    if (samples_ == Samples::dropped) return end;
    NoRockingSink none;
    keep_until(
        end, motion_, at_end_of_motion, state, response,
        [&](const RockingSegment& calm, State& one) { rock(block_, calm, one, none); },
        [&](const State& one) {
          response.rotation.push_back(one.rotation);
          response.rate.push_back(one.rate);
        });
    return end;
  }

  double kinetic(const State& state) const { return kinetic_energy(state); }
  double elastic(const State& state) const { return elastic_energy(block_, state); }
  void finish(const State& state, Response& response) const { response.state = state; }

 private:
  // The first segment from one on in which a resting block is lifted, or the number of segments.
  std::size_t rest(std::size_t i, Recorder& recorder) const {
    if (!motion_.has_vertical()) return rest_under(i, recorder, [](std::size_t) { return standard_gravity; });
    return rest_under(i, recorder, [&](std::size_t sample) { return standard_gravity + motion_.vertical()[sample]; });
  }
  template <class Heavy>
  std::size_t rest_under(std::size_t i, Recorder& recorder, Heavy&& heavy) const {
    const std::size_t count = motion_.segments(), ahead = motion_.interpolation() == Interpolation::constant ? 0 : 1;
    const std::span<const double> n = motion_.acceleration();
    LoadMaxima maxima;
    const auto stays = [&](std::size_t sample) {
      const UpliftMargins margins(block_, n[sample], heavy(sample));
      if (margins.right > 0 || margins.left > 0) return false;
      const double alpha = n[sample] < 0 ? block_.alpha_right() : block_.alpha_left();
      maxima.look(std::abs(n[sample]) / (alpha * heavy(sample)), [&](double margin) { recorder.decide(margin); });
      return true;
    };
    if (i < count && stays(i))
      while (i < count && stays(i + ahead)) ++i;
    return i;
  }
  void judge(std::size_t sample, State& state, Recorder& recorder) const {
    if (recorder.has_overturned()) return;
    if (recorder.certain(sample, state)) state.overturned = static_cast<std::int8_t>(sign(state.mode));
    if (state.overturned != 0) recorder.overturned(motion_.time(sample), state);
  }
  void keep(std::size_t sample, const State& state, Response& response) const {
    if (samples_ == Samples::dropped) return;
    response.rotation[sample] = state.rotation;
    response.rate[sample] = state.rate;
  }

  const SlenderBlock& block_;
  const GroundMotion& motion_;
  const RockingOptions& options_;
  Samples samples_;
};

}  // namespace

void rock(const SlenderBlock& block, const RockingSegment& ground, RockingState& state, RockingSink& sink) {
  if (!(ground.duration > 0) || lies(state)) return;
  RockingSystem system(block, ground, state, sink.sums());
  stickslip::detail::advance(system, sink);
  if (!lies(state)) return;
  const double before = kinetic_energy(state) + elastic_energy(block, state);
  state.overturned = state.rotation > 0 ? 1 : -1;
  state.rotation = std::copysign(quarter_turn, state.rotation);
  state.rate = 0;
  sink.fall(before - elastic_energy(block, state));
}

RockingResponse integrate_without_samples(const SlenderBlock& block, const GroundMotion& motion,
                                          const RockingOptions& options) {
  return integrate_run(RockingRun(block, motion, options, Samples::dropped), {});
}

}  // namespace detail

RockingResponse integrate(const SlenderBlock& block, const GroundMotion& motion, const RockingOptions& options) {
  return detail::integrate_run(detail::RockingRun(block, motion, options, detail::Samples::kept), {});
}

void advance(const SlenderBlock& block, const RockingGround& segment, RockingState& state) {
  const detail::RockingSegment ground = detail::segment_of(segment, state);
  for (const double up : {segment.vertical_start, segment.vertical_end})
    detail::require(standard_gravity + up > 0,
                    "advance: the block leaves the ground, which a SlenderBlock cannot; g + a_z must be positive",
                    standard_gravity + up, "m/s^2");
  RockingState moved = state;
  detail::NoRockingSink none;
  detail::rock(block, ground, moved, none);
  state = moved;
}

std::vector<RockingState> states_at(const SlenderBlock& block, const GroundMotion& motion,
                                    const RockingResponse& response, std::span<const double> times) {
  return detail::states_by_advance(block, motion, response, times);
}

}  // namespace stickslip
