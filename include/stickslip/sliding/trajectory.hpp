// The motion of a response at any time, with the load that drives it.
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "stickslip/base/equal.hpp"
#include "stickslip/base/error.hpp"
#include "stickslip/base/min_max.hpp"
#include "stickslip/base/units.hpp"
#include "stickslip/flow/closed_form.hpp"
#include "stickslip/friction/law.hpp"
#include "stickslip/ground/motion.hpp"
#include "stickslip/ground/segment.hpp"
#include "stickslip/run/detail/reading.hpp"
#include "stickslip/slider/slider.hpp"
#include "stickslip/sliding/detail/engine.hpp"
#include "stickslip/sliding/detail/engine_of.hpp"
#include "stickslip/sliding/detail/load.hpp"
#include "stickslip/sliding/detail/run.hpp"
#include "stickslip/sliding/detail/sink.hpp"
#include "stickslip/sliding/observer.hpp"
#include "stickslip/sliding/response.hpp"
#include "stickslip/state/state.hpp"

namespace stickslip {

/// The load p on a slider and the normal force N under it, per unit mass [m/s^2], as in LoadSegment. N is negative
/// while the ground falls away from the slider faster than it can fall.
struct Load {
  double load, normal;
};

namespace detail {
template <class Reader>
class Recall;
class Tracer;

/// Load and normal force at a time of a segment [s]; at its ends exactly those there.
inline Load load_at(const LoadSegment& line, double t) noexcept {
  if (!(t > 0)) return {line.load_start, line.normal_start};
  if (!(t < line.duration)) return {line.load_end, line.normal_end};
  return {line.load(t), line.normal(t)};
}

}  // namespace detail

/// An arc of a trajectory: a part of a motion with one mode and one direction, within one segment of the ground motion.
/// During an arc the load is monotonic in time, and N has one sign. Times `t` are measured from its beginning [s], from
/// 0 to `duration`.
class Arc {
 public:
  double begin, end;    ///< [s]
  double duration;      ///< [s], positive; `end - begin` without the rounding of these times
  const State& start;   ///< the state at its beginning, with the mode of the whole arc
  double distance = 0;  ///< sliding distance [m]
  /// Work of the load on the slider, and on a pendulum of the deviation of N+ from g, per unit mass [m^2/s^2]. Friction
  /// and damper take what of it becomes neither kinetic nor elastic energy.
  double work = 0;

  bool rests() const noexcept { return start.mode == Mode::stuck; }

  /// p and N.
  Load load(double t) const noexcept {
    if (wave_ != nullptr) {
      const double phase = wave_->phase + wave_->omega * (offset_ + t);
      return {wave_->amplitude * std::cos(phase), line_.normal_start};
    }
    return detail::load_at(line_, t);
  }

  /// N+/g, by which friction is multiplied; 0 in flight.
  double weight(double t) const noexcept {
    return start.in_flight ? 0 : std::max(load(t).normal, 0.0) / standard_gravity;
  }

  /// x'' [m/s^2].
  double acceleration(double t) const {
    return rests() ? 0 : sign(direction_of(start.mode)) * flow_.at(t).acceleration;
  }

  /// Whether the state changes during the arc.
  bool changes() const noexcept { return !rests() || start.in_flight || start.heat.warm(); }

  /// The state at a time, with the memory of the law.
  State at(double t) const {
    State state = start;
    go(state, t);
    return state;
  }

 private:
  template <class Reader>
  friend class detail::Recall;
  friend class detail::Tracer;

  Arc(double from, double to, double lasts, const State& state, const LoadSegment& line,
      const detail::Engine& engine) noexcept
      : begin(from), end(to), duration(lasts), start(state), line_(line), engine_(&engine) {}

  // Moves the state at the beginning to a time.
  void go(State& state, double t) const {
    if (!rests()) {
      const Progress progress = flow_.at(t);
      const double s = sign(direction_of(start.mode));
      state.displacement += s * progress.distance;
      state.velocity = s * std::max(progress.speed, 0.0);
      if (engine_->law().memory) engine_->slide(state, progress.distance);
    }
    if (flow_.heats())
      flow_.heat(t, state.heat);
    else
      state.heat.rest(t);
    if (!state.in_flight) return;
    const double first = line_.normal_start, change = load(t).normal - first;
    state.gap = std::max(state.gap + t * (state.gap_velocity - t * (first / 2 + change / 6)), 0.0);
    state.gap_velocity -= t * (first + change / 2);
  }

  LoadSegment line_;                       // of the arc
  const HarmonicSegment* wave_ = nullptr;  // that contains it; null if the load is linear
  double offset_ = 0;                      // of its beginning in that segment [s]
  detail::SlipFlow flow_{};                // of a slip
  const detail::Engine* engine_;
};

/// Receives the arcs and events of a trajectory in order. At an event the state is that before it, as in Event.
struct TrajectoryReader {
  virtual void arc(const Arc&) = 0;
  virtual void event(EventKind, double /*time*/, const State&, const Load&) {}

 protected:
  ~TrajectoryReader() = default;
};

/// The continuous motion of a response: exact at any time, not only at samples. It is integrated again whenever it is
/// read; nothing of it is stored. Forces, margins, floor motions and hysteresis loops are readers of it. `trajectory`
/// makes one.
class Trajectory {
 public:
  virtual ~Trajectory() = default;
  Trajectory(const Trajectory&) = delete;
  Trajectory& operator=(const Trajectory&) = delete;

  /// Show the motion to a reader, from its beginning to a time, which may be after the end of the response: the ground
  /// acceleration is zero there. The last arc may extend beyond the time, unless that is after the end of the ground
  /// motion; the last event is `end`. Cost: about that of `integrate`.
  virtual void read(TrajectoryReader& reader, double until) const = 0;

  /// Resistance to sliding, and largest friction at rest, as of the law under a normal force of `weight` times g,
  /// divided by the weight [m/s^2].
  double resist(const State& state, double weight, Direction direction) const {
    return engine_.resist(state, weight, direction);
  }
  double hold(const State& state, double weight, Direction direction) const {
    return engine_.hold(state, weight, direction);
  }

  /// Energy of the spring, and of springs in the law, under the weight, per unit mass [m^2/s^2].
  double elastic(const State& state) const {
    return mounting().stiffness() * state.displacement * state.displacement / 2 + engine_.elastic(state);
  }
  /// Whether the law has constant levels.
  bool has_constant_level() const noexcept { return engine_.law().constant; }
  /// Whether the levels depend on more than place and speed.
  bool has_memory() const noexcept { return engine_.law().memory || engine_.law().heated; }
  /// Whether a spring draws the slider back.
  bool has_spring() const noexcept { return mounting().stiffness() > 0 || engine_.law().springs; }

  /// The ground motion; null if it is harmonic.
  const GroundMotion* ground() const noexcept { return ground_; }
  /// Time of a sample of the response [s].
  double time(std::size_t sample) const { return ground_ != nullptr ? ground_->time(sample) : time_of(sample); }
  /// Number of samples of the ground motion.
  virtual std::size_t samples() const = 0;

  const Mounting& mounting() const noexcept { return engine_.mounting(); }
  const Response& response() const noexcept { return response_; }
  double begin() const { return time(0); }
  /// End of the response: its last event [s].
  double end() const noexcept { return response_.events.back().time; }

  /// Force of the spring at x under a weight N+/g, per unit mass [m/s^2].
  double pull(double x, double weight) const noexcept { return mounting().spring().under(weight) * x; }
  /// g sin(slope), the load of the weight [m/s^2].
  double downhill() const noexcept {
    return mounting().slope_degrees > 0 ? standard_gravity * std::sin(mounting().slope()) : 0;
  }

 protected:
  Trajectory(const detail::Engine& engine, const GroundMotion* ground, const Response& response)
      : engine_(engine), ground_(ground), response_(response) {}

  const detail::Engine& engine_;

 private:
  template <class Reader>
  friend class detail::Recall;

  virtual double time_of(std::size_t sample) const = 0;

  const GroundMotion* ground_;
  const Response& response_;
};

namespace detail {

/// Shows the arcs and events of a motion to a reader, segment by segment.
class Tracer final : public Sink {
 public:
  Tracer(TrajectoryReader& reader, const Engine& engine, const State& start)
      : reader_(reader), engine_(engine), state_(start) {}

  /// @param begin, end  times of the next segment [s]
  void begin_segment(double begin, double end, const LoadSegment& line) noexcept {
    begin_ = begin, end_ = end, now_ = 0;
    line_ = line;
    wave_.reset();
  }
  void begin_segment(double begin, double end, const HarmonicSegment& wave) noexcept {
    begin_segment(begin, end, LoadSegment{wave.duration, 0, 0, standard_gravity, standard_gravity});
    wave_ = wave;
  }
  void end_segment(const StateView& now) {
    rest(line_.duration);
    now.store(state_);
  }
  void finish() { reader_.event(EventKind::end, end_, state_, load(line_.duration)); }

  void slide(const Slip& slip, const SlipFlow& flow) override {
    if (!(slip.duration > 0)) return;
    state_.displacement = slip.from;
    state_.velocity = sign(slip.direction) * std::max(flow.at(0).speed, 0.0);
    state_.mode = mode_of(slip.direction);
    Arc arc = next(slip.duration);
    arc.distance = slip.distance;
    arc.work = slip.work + flow.pendulum_work(slip.duration);
    arc.flow_ = flow;
    show(arc);
  }

  void event(EventKind kind, double time, const State& at) override {
    rest(time);
    now_ = time;
    state_.displacement = at.displacement;
    state_.velocity = at.velocity;
    state_.mode = at.mode;
    if (kind == EventKind::liftoff || kind == EventKind::landing) {
      state_.in_flight = kind == EventKind::liftoff;
      state_.gap = state_.gap_velocity = 0;
    }
    reader_.event(kind, absolute(time), state_, load(time));
  }

 private:
  // Times are sums of durations: they agree up to round-off, and no arc is as short as that.
  double round_off() const noexcept { return 0x1p-40 * line_.duration; }
  bool at_end(double time) const noexcept { return !(time < line_.duration - round_off()); }
  double absolute(double time) const noexcept { return at_end(time) ? end_ : begin_ + time; }

  Load load(double time) const noexcept {
    if (wave_) return {wave_->amplitude * std::cos(wave_->phase + wave_->omega * time), line_.normal_start};
    if (!(time > 0)) return {line_.load_start, line_.normal_start};
    if (at_end(time)) return {line_.load_end, line_.normal_end};
    return {line_.load(time), line_.normal(time)};
  }

  // The slider rests in the time that no slip covers.
  void rest(double until) {
    if (!(until - now_ > round_off())) return;
    state_.velocity = 0;
    state_.mode = Mode::stuck;
    const double first = load(now_).normal, last = load(until).normal, after = until - now_;
    if (first * last < 0)
      if (const double before = after * (first / (first - last)); before > 0 && before < after) show(next(before));
    show(next(until - now_));
  }

  Arc next(double duration) const noexcept {
    const Load first = load(now_), last = load(now_ + duration);
    Arc arc(absolute(now_), absolute(now_ + duration), duration, state_,
            {duration, first.load, last.load, first.normal, last.normal}, engine_);
    arc.wave_ = wave_ ? &*wave_ : nullptr;
    arc.offset_ = now_;
    return arc;
  }
  void show(const Arc& arc) {
    reader_.arc(arc);
    arc.go(state_, arc.duration);
    now_ += arc.duration;
  }

  TrajectoryReader& reader_;
  const Engine& engine_;
  State state_;
  double begin_ = 0, end_ = 0;  // of the segment [s]
  double now_ = 0;              // since its beginning [s]
  LoadSegment line_{};
  std::optional<HarmonicSegment> wave_{};
};

/// The segments of a trajectory to a time, shown to a tracer: those of a ground motion, if there is one, and one more
/// without ground acceleration.
class TracedSegments final : public Segments<LoadSegment> {
 public:
  /// @param motion       null for none
  /// @param from, until  times [s]
  TracedSegments(const GroundMotion* motion, double slope, double from, double until, Tracer& tracer)
      : motion_(motion), slope_(slope), now_(from), until_(until), tracer_(tracer) {
    if (motion_ != nullptr) pieces_.emplace(*motion_, slope);
  }

  bool next(const StateView& now, LoadSegment& segment) override {
    if (begun_) tracer_.end_segment(now);
    if (!(now_ < until_)) return false;
    begun_ = true;
    const double begin = now_;
    if (motion_ != nullptr && i_ < motion_->segments()) {
      segment = pieces_->segment(i_);
      now_ = pieces_->time(++i_);
    } else {
      segment = load_segment(Segment{until_ - begin, 0, 0}, slope_);
      now_ = until_;
    }
    tracer_.begin_segment(begin, now_, segment);
    return true;
  }

 private:
  const GroundMotion* motion_;
  Slope slope_;
  std::optional<LoadPieces> pieces_;
  std::size_t i_ = 0;
  double now_, until_;
  Tracer& tracer_;
  bool begun_ = false;
};

/// The same of a harmonic motion, to its end. A segment is from crest to crest, so that the load is monotonic.
class TracedWaves final : public Segments<HarmonicSegment> {
 public:
  TracedWaves(const HarmonicMotion& motion, double until, Tracer& tracer)
      : motion_(motion), begin_(motion.time(0)), until_(until), tracer_(tracer) {}

  bool next(const StateView& now, HarmonicSegment& segment) override {
    if (crests_ > 0) tracer_.end_segment(now);
    const double last = motion_.time(motion_.segments());
    if (!(begin_ < std::min(last, until_))) return false;
    const double end = std::min(++crests_ * (motion_.period() / 2), last);
    segment = {end - begin_, motion_.amplitude(), motion_.omega(), motion_.phase(begin_)};
    tracer_.begin_segment(begin_, end, segment);
    begin_ = end;
    return true;
  }

 private:
  const HarmonicMotion& motion_;
  double begin_, until_;
  Tracer& tracer_;
  double crests_ = 0;
};

template <Motion M>
class TrajectoryUnder : public Trajectory {
 public:
  void read(TrajectoryReader& reader, double until) const override;
  std::size_t samples() const override { return motion_.samples(); }

 protected:
  TrajectoryUnder(const Engine& engine, const M& motion, const Response& response)
      : Trajectory(engine, ground_of(motion), response), motion_(motion) {}

 private:
  static const GroundMotion* ground_of(const GroundMotion& motion) noexcept { return &motion; }
  static const GroundMotion* ground_of(const HarmonicMotion&) noexcept { return nullptr; }
  double time_of(std::size_t sample) const override { return motion_.time(sample); }

  const M& motion_;
};

template <Motion M>
void TrajectoryUnder<M>::read(TrajectoryReader& reader, double until) const {
  State start = State::at(response().displacement.front(), response().velocity.front());
  start.sliding_distance = std::max(response().state.sliding_distance - response().sliding_distance, 0.0);
  if (engine_.law().heated) start.heat = engine_.heat_at(response().temperature.front());
  State state = engine_.started(start);
  Tracer tracer(reader, engine_, state);
  const auto trace = [&](const GroundMotion* motion, double from) {
    if (!(from < until)) return;
    TracedSegments segments(motion, mounting().slope(), from, until, tracer);
    engine_.move(segments, motion_.dt(), response().contact, state, tracer);
  };
  if constexpr (std::same_as<M, GroundMotion>) {
    trace(&motion_, begin());
  } else {
    TracedWaves waves(motion_, until, tracer);
    engine_.move(waves, motion_.omega(), motion_.dt(), state, tracer);
    trace(nullptr, motion_.time(motion_.segments()));
  }
  tracer.finish();
}

/// Keeps a copy of the slider.
template <FrictionLaw Law>
struct SliderWithEngine {
  explicit SliderWithEngine(const Slider<Law>& slider) : kept(slider), engine(kept) {}
  Slider<Law> kept;
  EngineOf<Law> engine;
};
template <FrictionLaw Law, Motion M>
class TrajectoryOf final : SliderWithEngine<Law>, public TrajectoryUnder<M> {
 public:
  TrajectoryOf(const Slider<Law>& slider, const M& motion, const Response& response)
      : SliderWithEngine<Law>(slider), TrajectoryUnder<M>(this->engine, motion, response) {}
};

}  // namespace detail

/// The continuous motion of a response.
/// @param slider    the slider, or a law alone
/// @param motion    its ground motion
/// @param response  the result of `integrate` for them; as `motion`, it must outlive the trajectory
/// Exact as `integrate`. For a law that depends on the temperature, the heat at the start is that of the response's
/// first temperature, as if it had come long ago.
template <FrictionLaw Law, Motion M>
std::unique_ptr<const Trajectory> trajectory(const Slider<Law>& slider, const M& motion, const Response& response) {
  return std::make_unique<const detail::TrajectoryOf<Law, M>>(slider, motion, response);
}
template <FrictionLaw Law, Motion M>
std::unique_ptr<const Trajectory> trajectory(const Law& law, const M& motion, const Response& response) {
  return trajectory(Slider<Law>(law), motion, response);
}

namespace detail {

/// The states at sorted times.
class StatesAt final : public TrajectoryReader {
 public:
  /// @param order  of the times
  StatesAt(std::span<const double> times, std::span<const std::size_t> order)
      : states(times.size()), times_(times), order_(order) {}

  void arc(const Arc& arc) override {
    for (; next_ < order_.size() && times_[order_[next_]] < arc.end; ++next_) {
      const double time = times_[order_[next_]];
      states[order_[next_]] = arc.at(std::min(std::max(time - arc.begin, 0.0), arc.duration));
    }
  }

  /// The rest have the state at the end.
  void finish(const State& last) {
    for (; next_ < order_.size(); ++next_) states[order_[next_]] = last;
  }

  std::vector<State> states;

 private:
  std::span<const double> times_;
  std::span<const std::size_t> order_;
  std::size_t next_ = 0;
};

}  // namespace detail

/// The states of a slider at any times of a response, also between its samples and after the last sample.
///
/// @param trajectory  of the response
/// @param times       in any order, from the start of the motion to the last event or sample of the response [s]
/// @return a state for each time, in their order; at an event, that after it
/// @throws std::invalid_argument  a time before the start or after the end
/// As exact as `integrate`. Cost: about that of `integrate`, and 0.1 us for each time.
inline std::vector<State> states_at(const Trajectory& trajectory, std::span<const double> times) {
  const double last_sample = trajectory.time(trajectory.response().displacement.size() - 1);
  const std::vector<std::size_t> order = detail::order_of(times, trajectory.begin(), trajectory.end(), last_sample);
  if (times.empty()) return {};
  detail::StatesAt reader(times, order);
  trajectory.read(reader, std::min(std::nextafter(times[order.back()], never), trajectory.end()));
  reader.finish(trajectory.response().state);
  return std::move(reader.states);
}

/// The same of a slider, or a law alone, under a ground motion.
template <class Slider, Motion M>
std::vector<State> states_at(const Slider& slider, const M& motion, const Response& response,
                             std::span<const double> times) {
  return states_at(*trajectory(slider, motion, response), times);
}

}  // namespace stickslip

#ifdef STICKSLIP_LIBRARY  // the linked library contains these
namespace stickslip::detail {
extern template class TrajectoryUnder<GroundMotion>;
extern template class TrajectoryUnder<HarmonicMotion>;
}  // namespace stickslip::detail
#endif
