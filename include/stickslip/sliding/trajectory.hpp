// The motion of a response at any time, with the load that drives it.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <numeric>
#include <span>
#include <vector>

#include "stickslip/base/equal.hpp"
#include "stickslip/base/min_max.hpp"
#include "stickslip/error.hpp"
#include "stickslip/flow/closed_form.hpp"
#include "stickslip/friction/law.hpp"
#include "stickslip/ground/motion.hpp"
#include "stickslip/ground/segment.hpp"
#include "stickslip/slider.hpp"
#include "stickslip/sliding/advance.hpp"
#include "stickslip/sliding/detail/load.hpp"
#include "stickslip/sliding/detail/run.hpp"
#include "stickslip/sliding/observer.hpp"
#include "stickslip/sliding/response.hpp"
#include "stickslip/state.hpp"
#include "stickslip/units.hpp"

namespace stickslip {

/// The load p on a slider and the normal force N under it, per unit mass [m/s^2], as in LoadSegment. N is negative
/// while the ground falls away from the slider faster than it can fall.
struct Load {
  double load, normal;
};

namespace detail {
class Tracer;
}

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
    if (!(t > 0)) return {line_.load_start, line_.normal_start};
    if (!(t < duration)) return {line_.load_end, line_.normal_end};
    return {line_.load(t), line_.normal(t)};
  }

  /// N+/g, by which friction is multiplied; 0 in flight.
  double weight(double t) const noexcept {
    return start.in_flight ? 0 : std::max(load(t).normal, 0.0) / standard_gravity;
  }

  /// x'' [m/s^2].
  double acceleration(double t) const {
    return rests() ? 0 : sign(direction_of(start.mode)) * at_(flow_, t).acceleration;
  }

  /// The state at a time, with the memory of the law.
  State at(double t) const {
    State state = start;
    go(state, t);
    return state;
  }

 private:
  friend class detail::Tracer;

  Arc(double from, double to, double lasts, const State& state, const LoadSegment& line) noexcept
      : begin(from), end(to), duration(lasts), start(state), line_(line) {}

  // Moves the state at the beginning to a time.
  void go(State& state, double t) const {
    if (!rests()) {
      const Progress progress = at_(flow_, t);
      const double s = sign(direction_of(start.mode));
      state.displacement += s * progress.distance;
      state.velocity = s * std::max(progress.speed, 0.0);
      if (remember_ != nullptr) remember_(law_, state, progress.distance);
    }
    if (heat_ != nullptr)
      heat_(flow_, t, state.heat);
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
  const void* flow_ = nullptr;             // of a slip
  Progress (*at_)(const void* flow, double t) = nullptr;
  void (*heat_)(const void* flow, double t, SurfaceHeat&) = nullptr;
  const void* law_ = nullptr;
  void (*remember_)(const void* law, State&, double distance) = nullptr;  // null for a law without memory
};

/// Receives the arcs and events of a trajectory in order. At an event the state is that before it, as in Event.
struct TrajectoryReader {
  virtual void arc(const Arc&) = 0;
  virtual void event(EventKind, double /*time*/, const State&, const Load&) {}

 protected:
  ~TrajectoryReader() = default;
};

/// The continuous motion of a response: exact at any time, not only at samples. It is integrated again whenever it is
/// read; nothing of it is stored. Forces, margins, floor motions and hysteresis loops are readers of it, compiled once
/// for all laws. `trajectory` makes one.
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
  virtual double resist(const State& state, double weight, Direction direction) const = 0;
  virtual double hold(const State& state, double weight, Direction direction) const = 0;

  /// Energy of the spring, and of springs in the law, under the weight, per unit mass [m^2/s^2].
  virtual double elastic(const State& state) const = 0;
  /// Whether a spring draws the slider back.
  virtual bool has_spring() const = 0;

  /// Time of a sample of the response [s].
  virtual double time(std::size_t sample) const = 0;
  /// Number of samples of the ground motion.
  virtual std::size_t samples() const = 0;

  const Mounting& mounting() const noexcept { return mounting_; }
  const Response& response() const noexcept { return response_; }
  double begin() const { return time(0); }
  /// End of the response: its last event [s].
  double end() const noexcept { return response_.events.back().time; }

  /// Force of the spring at x under a weight N+/g, per unit mass [m/s^2].
  double pull(double x, double weight) const noexcept { return mounting_.spring().under(weight) * x; }
  /// g sin(slope), the load of the weight [m/s^2].
  double downhill() const noexcept {
    return mounting_.slope_degrees > 0 ? standard_gravity * std::sin(mounting_.slope()) : 0;
  }

 protected:
  Trajectory(const Mounting& mounting, const Response& response) : mounting_(mounting), response_(response) {}

 private:
  Mounting mounting_;
  const Response& response_;
};

namespace detail {

/// Observes the event loop, segment by segment, and shows arcs and events to a reader.
class Tracer {
 public:
  template <FrictionLaw Law>
  Tracer(TrajectoryReader& reader, const Law& law, const State& start) : reader_(reader), state_(start), law_(&law) {
    if constexpr (MemoryLaw<Law>)
      remember_ = [](const void* of, State& state, double distance) {
        detail::slide(*static_cast<const Law*>(of), state, distance);
      };
  }

  /// @param begin, end  times of the next segment [s]
  void begin_segment(double begin, double end, const LoadSegment& line) noexcept {
    begin_ = begin, end_ = end, now_ = 0;
    line_ = line;
    wave_ = nullptr;
  }
  void begin_segment(double begin, double end, const HarmonicSegment& wave) noexcept {
    begin_segment(begin, end, LoadSegment{wave.duration, 0, 0, standard_gravity, standard_gravity});
    wave_ = &wave;
  }
  void end_segment(const State& state) {
    rest(line_.duration);
    state_ = state;
  }
  void finish() { reader_.event(EventKind::end, end_, state_, load(line_.duration)); }

  template <class Flow>
  void follow(const Flow& flow, [[maybe_unused]] double taken) {
    flow_ = &flow;
    at_ = [](const void* slip, double t) -> Progress { return static_cast<const Flow*>(slip)->at(t); };
    if constexpr (requires(SurfaceHeat & heat) { flow.heat(taken, heat); })
      heat_ = [](const void* slip, double t, SurfaceHeat& heat) { static_cast<const Flow*>(slip)->heat(t, heat); };
    if constexpr (requires { flow.pendulum_work(taken); }) pendulum_work_ = flow.pendulum_work(taken);
  }

  [[gnu::noinline]] void slide(const Slip& slip) {
    if (!(slip.duration > 0)) return;
    state_.displacement = slip.from;
    state_.velocity = sign(slip.direction) * std::max(at_(flow_, 0).speed, 0.0);
    state_.mode = mode_of(slip.direction);
    Arc arc = next(slip.duration);
    arc.distance = slip.distance;
    arc.work = slip.work + pendulum_work_;
    arc.flow_ = flow_;
    arc.at_ = at_;
    arc.heat_ = heat_;
    arc.law_ = law_;
    arc.remember_ = remember_;
    show(arc);
  }

  [[gnu::noinline]] void event(EventKind kind, double time, const State& at) {
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
    if (wave_ != nullptr) return {wave_->amplitude * std::cos(wave_->phase + wave_->omega * time), line_.normal_start};
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
            {duration, first.load, last.load, first.normal, last.normal});
    arc.wave_ = wave_;
    arc.offset_ = now_;
    return arc;
  }
  void show(const Arc& arc) {
    reader_.arc(arc);
    arc.go(state_, arc.duration);
    now_ += arc.duration;
  }

  TrajectoryReader& reader_;
  State state_;
  const void* law_;
  void (*remember_)(const void*, State&, double) = nullptr;
  double begin_ = 0, end_ = 0;  // of the segment [s]
  double now_ = 0;              // since its beginning [s]
  LoadSegment line_{};
  const HarmonicSegment* wave_ = nullptr;
  // of the present slip
  const void* flow_ = nullptr;
  Progress (*at_)(const void*, double) = nullptr;
  void (*heat_)(const void*, double, SurfaceHeat&) = nullptr;
  double pendulum_work_ = 0;
};

/// Trace a slider under a ground motion, or from a time on without one (`motion` is null), to a time.
template <FrictionLaw Law>
[[gnu::noinline]] void trace(const Slider<Law>& slider, double usual_duration, const GroundMotion* motion, double from,
                             double until, Contact contact, State& state, Tracer& tracer) {
  with_flows(slider, usual_duration, [&](const auto& flows) {
    const Bounds bounds{slider.mounting().stops, slider.mounting().one_way};
    StateOf<Law> moving(state);
    const auto go = [&](double begin, double end, const LoadSegment& segment) {
      tracer.begin_segment(begin, end, segment);
      advance(flows, segment, bounds, contact, moving, tracer);
      tracer.end_segment(State(moving));
    };
    if (motion != nullptr) {
      const LoadPieces pieces(*motion, slider.slope());
      for (std::size_t i = 0; i < motion->segments() && from < until; ++i)
        go(std::exchange(from, pieces.time(i + 1)), pieces.time(i + 1), pieces.segment(i));
    }
    if (from < until) go(from, until, load_segment(Segment{until - from, 0, 0}, slider.slope()));
    store(moving, state);
  });
}

/// The same under a harmonic motion, to its end. A segment is from crest to crest, so that the load is monotonic.
template <FrictionLaw Law>
[[gnu::noinline]] void trace(const Slider<Law>& slider, const HarmonicMotion& motion, double until, State& state,
                             Tracer& tracer) {
  with_flows(slider, motion, [&](const auto& flows) {
    typename std::remove_cvref_t<decltype(flows)>::Place moving(state);
    const double half = motion.period() / 2, last = motion.time(motion.segments());
    double begin = motion.time(0);
    for (double crest = 1; begin < std::min(last, until); ++crest) {
      const double end = std::min(crest * half, last);
      const HarmonicSegment segment{end - begin, motion.amplitude(), motion.omega(), motion.phase(begin)};
      tracer.begin_segment(begin, end, segment);
      advance(flows, segment, moving, tracer);
      tracer.end_segment(State(moving));
      begin = end;
    }
    store(moving, state);
  });
}

template <FrictionLaw Law, Motion M>
class TrajectoryOf final : public Trajectory {
 public:
  TrajectoryOf(const Slider<Law>& slider, const M& motion, const Response& response)
      : Trajectory(slider.mounting(), response), slider_(slider), motion_(motion) {}

  void read(TrajectoryReader& reader, double until) const override {
    State start = State::at(response().displacement.front(), response().velocity.front());
    start.sliding_distance = std::max(response().state.sliding_distance - response().sliding_distance, 0.0);
    if constexpr (HeatedLaw<Law>)
      start.heat = SurfaceHeat::with(slider_.law().half_integral_at(response().temperature.front()));
    State state(with_memory(slider_.law(), start));
    Tracer tracer(reader, slider_.law(), state);
    if constexpr (std::same_as<M, GroundMotion>) {
      trace(slider_, motion_.dt(), &motion_, begin(), until, response().contact, state, tracer);
    } else {
      trace(slider_, motion_, until, state, tracer);
      trace(slider_, motion_.dt(), nullptr, motion_.time(motion_.segments()), until, response().contact, state, tracer);
    }
    tracer.finish();
  }

  double resist(const State& state, double weight, Direction direction) const override {
    return stickslip::resist(law_at(slider_.law(), state, weight), state.displacement, std::abs(state.velocity),
                             direction);
  }
  double hold(const State& state, double weight, Direction direction) const override {
    return stickslip::hold(law_at(slider_.law(), state, weight), state.displacement, direction);
  }
  double elastic(const State& state) const override {
    return slider_.stiffness() * state.displacement * state.displacement / 2 + detail::elastic(slider_.law(), state);
  }
  bool has_spring() const override {
    return slider_.stiffness() > 0 || requires(const Law& law, const State& state) { law.elastic(state); };
  }
  double time(std::size_t sample) const override { return motion_.time(sample); }
  std::size_t samples() const override { return motion_.samples(); }

 private:
  Slider<Law> slider_;
  const M& motion_;
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
/// @param times       in any order, from the start of the motion to the end of the response (its last event) [s]
/// @return a state for each time, in their order; at an event, that after it
/// @throws std::invalid_argument  a time before the start or after the end
/// As exact as `integrate`. Cost: about that of `integrate`, and 0.1 us for each time.
inline std::vector<State> states_at(const Trajectory& trajectory, std::span<const double> times) {
  const double begin = trajectory.begin(), end = trajectory.end();
  for (const double time : times)
    detail::require(time >= begin && time <= end,
                    "states at times: must be from " + detail::shortest(begin) + " to " + detail::shortest(end) +
                        " s, the start and the end of the response",
                    time, "s");
  if (times.empty()) return {};
  std::vector<std::size_t> order(times.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t k) { return times[i] < times[k]; });
  detail::StatesAt reader(times, order);
  trajectory.read(reader, std::min(std::nextafter(times[order.back()], never), end));
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
