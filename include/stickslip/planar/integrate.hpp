// Integrate a slider in the plane under one ground motion.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>

#include "stickslip/base/equal.hpp"
#include "stickslip/base/error.hpp"
#include "stickslip/base/min_max.hpp"
#include "stickslip/ground/ground_motion.hpp"
#include "stickslip/planar/advance.hpp"
#include "stickslip/planar/detail/engine.hpp"
#include "stickslip/planar/detail/radius.hpp"
#include "stickslip/planar/detail/work.hpp"
#include "stickslip/planar/path.hpp"
#include "stickslip/planar/response.hpp"
#include "stickslip/planar/slider.hpp"
#include "stickslip/run/detail/event_log.hpp"
#include "stickslip/run/detail/run.hpp"
#include "stickslip/run/options.hpp"
#include "stickslip/sliding/detail/run.hpp"

namespace stickslip {

using PlanarIntegrateOptions = RunOptions<Vector2>;

namespace detail {

/// The segments of a ground motion with two horizontal components.
class PlanarPieces {
 public:
  /// @throws std::invalid_argument  the motion has no transverse component
  PlanarPieces(const GroundMotion& motion, double slope)
      : axis_(motion),
        transverse_(motion.transverse()),
        up_(motion.vertical()),
        next_(motion.interpolation() == Interpolation::linear ? 1 : 0),
        slope_(slope) {
    if (!motion.has_transverse())
      throw std::invalid_argument(
          "a PlanarSlider needs a ground motion with a transverse component, got one along the axis only; "
          "give GroundMotion its transverse component, or read all components of the station");
  }

  double time(std::size_t i) const noexcept { return axis_.time(i); }
  PlanarLoadSegment segment(std::size_t i) const noexcept {
    const Segment axis = axis_.segment(i);
    const PlanarSegment both{axis.duration, {axis.start, transverse_[i]}, {axis.end, transverse_[i + next_]}};
    if (up_.empty()) return load_segment(both, slope_);
    return load_segment(both, slope_, up_[i], up_[i + next_]);
  }

  /// On level ground without vertical motion: the first segment from `i` up to `last` in which the load does not remain
  /// within a circle, |p - center| <= radius. The load moves along a straight line, so that its ends suffice.
  std::size_t first_outside(std::size_t i, std::size_t last, Vector2 center, double radius) const noexcept {
    const double* const axis = axis_.samples();
    const double limit = radius * radius;
    const auto inside = [&](std::size_t sample) {
      const double along = axis[sample] + center.axis, across = transverse_[sample] + center.transverse;
      return along * along + across * across <= limit;
    };
    if (i == last || !inside(i)) return i;
    while (i < last && inside(i + next_)) ++i;
    return i;
  }

 private:
  GroundMotion::Pieces axis_;
  std::span<const double> transverse_, up_;
  std::size_t next_;
  Slope slope_;
};

/// Move a slider through a ground motion and keep its motion at the samples. A slider that rests on level ground is
/// asked for its next departure only.
/// @tparam Recorder  a sink with `begin_segment`
template <class Recorder>
void walk_plane(const PlanarEngine& engine, const GroundMotion& motion, const PlanarPieces& pieces, Contact contact,
                PlanarState& state, Recorder& recorder, const HistorySpansOf<Vector2>& histories) {
  const Mounting& on = engine.mounting();
  const bool scans = !engine.law().heated && !(on.slope() > 0) && !motion.has_vertical();
  const std::size_t count = motion.segments();
  for (std::size_t i = 0; i < count;) {
    for (const std::size_t last = std::min(i + Recorder::work_per_report, count); i < last;) {
      if (scans && is_stuck(state)) {
        const std::size_t next =
            pieces.first_outside(i, last, on.spring().under(1) * state.displacement, engine.hold(state, 1));
        std::fill(&histories.displacement[i] + 1, &histories.displacement[next] + 1, state.displacement);
        std::fill(&histories.velocity[i] + 1, &histories.velocity[next] + 1, Vector2{});
        if ((i = next) == last) break;
      }
      recorder.begin_segment(pieces.time(i), pieces.time(i + 1));
      engine.move(pieces.segment(i++), contact, state, recorder);
      histories.displacement[i] = state.displacement;
      histories.velocity[i] = state.velocity;
      if (!histories.gap.empty()) histories.gap[i] = state.gap;
      if (!histories.temperature.empty()) histories.temperature[i] = engine.temperature(state);
    }
    if (i < count) recorder.report_progress();
  }
}

/// Records the events, the peak and the sums of a motion in the plane.
class PlanarRecorder final : public PlanarSink, public EventLog<Vector2>, public Pace<4096> {
 public:
  /// @param start     r at the start [m]
  /// @param response  to which the sums are added
  PlanarRecorder(Vector2 start, std::size_t event_limit, const std::function<void()>& progress,
                 PlanarResponse& response)
      : EventLog(event_limit, std::move(response.events)), Pace(progress), response_(response) {
    response_.energy = {};
    response_.sliding_distance = response_.time_sliding = 0;
    response_.peak = norm(start);
    response_.peak_displacement = start;
  }

  void follow(const PlanarPath& path, double last, double begin) override {
    count_work();
    const PlanarProgress end = path.at_parameter(last);
    double where = last;
    if (const double radius = largest_radius(path, last, response_.peak, where); radius > response_.peak) {
      const PlanarProgress at = path.at_parameter(where);
      response_.peak = radius;
      response_.peak_displacement = path.place + at.way;
      response_.peak_time = segment_begins() + begin + at.time;
    }
    const auto work = detail::work(path, last);
    response_.energy.input += work.load;
    response_.energy.dissipated += work.friction;
    response_.energy.damped += work.damper;
    response_.sliding_distance += end.distance;
    response_.time_sliding += end.time;
  }
  void event(EventKind kind, double time, const PlanarState& state) override {
    count_work();
    add(kind, time, state.displacement, state.velocity);
  }
  void dissipate(double work) override { response_.energy.dissipated += work; }
  void lose(double energy) override { response_.energy.impact += energy; }

  void finish(PlanarResponse& response) { response.events = take(); }

 private:
  PlanarResponse& response_;
};

/// Records nothing of a motion in the plane; counts its events, and reports progress.
class NoPlanarRecorder final : public PlanarSink, public Pace<4096> {
 public:
  NoPlanarRecorder(std::size_t event_limit, const std::function<void()>& progress)
      : Pace(progress), events_(event_limit) {}

  void begin_segment(double, double) const noexcept {}
  void follow(const PlanarPath&, double, double) override { count_work(); }
  void event(EventKind, double, const PlanarState&) override {
    count_work();
    ++events_;
  }

 private:
  EventCount events_;
};

/// A slider in the plane under a ground motion, as a run (see RunOfSystem).
class PlaneRun {
 public:
  using State = PlanarState;
  using Response = PlanarResponse;
  using Recorder = PlanarRecorder;
  struct NoSink final : PlanarSink {
    void follow(const PlanarPath&, double, double) override {}
    void event(EventKind, double, const PlanarState&) override {}
  };

  /// All are held by reference.
  PlaneRun(const PlanarEngine& engine, const GroundMotion& motion, const PlanarIntegrateOptions& options)
      : engine_(engine), motion_(motion), options_(options), pieces_(motion, engine.mounting().slope()) {}

  const GroundMotion& motion() const noexcept { return motion_; }
  const PlanarIntegrateOptions& options() const noexcept { return options_; }

  State start() const {
    check_start(options_);
    State state = State::at(options_.displacement, options_.velocity);
    state.sliding_distance = options_.sliding_distance;
    state.heat = options_.heat;
    check_start(engine_.mounting(), state, "integrate");
    if (flies() && !options_.settle && !options_.may_end_in_flight) check_landing(motion_, engine_.mounting().slope());
    return state;
  }

  Recorder recorder(const State& state, Response& response) const {
    const std::size_t samples = motion_.samples();
    response.displacement.resize(samples);
    response.velocity.resize(samples);
    response.displacement[0] = state.displacement;
    response.velocity[0] = state.velocity;
    response.gap.assign(flies() && may_fly(motion_, engine_.mounting().slope()) ? samples : 0, 0);
    response.temperature.assign(engine_.law().heated ? samples : 0, engine_.temperature(state));
    response.heat = options_.heat;
    response.contact = options_.contact;
    response.components = std::string(name_of(Component::axis)) + " + " + name_of(Component::transverse);
    if (motion_.has_vertical()) response.components += std::string(" + ") + name_of(Component::vertical);
    response.peak_time = motion_.time(0);
    return {state.displacement, max_events(motion_.segments()), options_.progress, response};
  }

  void walk(State& state, Recorder& recorder, Response& response) const {
    walk_plane(engine_, motion_, pieces_, options_.contact, state, recorder,
               {response.displacement, response.velocity, response.gap, response.temperature});
  }

  double settle(State& state, Recorder& recorder, Response& response) const {
    return settle_freely(*this, state, recorder, response);
  }
  const PlanarEngine& slider() const noexcept { return engine_; }
  void calm(double duration, State& state, PlanarSink& sink) const {
    engine_.calm(duration, options_.contact, state, sink);
  }
  double temperature(const State& state) const { return engine_.temperature(state); }

  double kinetic(const State& state) const { return dot(state.velocity, state.velocity) / 2; }
  double elastic(const State& state) const {
    return engine_.mounting().stiffness() * dot(state.displacement, state.displacement) / 2;
  }
  void finish(const State& state, Response& response) const {
    response.residual = state.displacement;
    response.state = state;
  }

 private:
  bool flies() const noexcept { return options_.contact == Contact::flight; }

  const PlanarEngine& engine_;
  const GroundMotion& motion_;
  const PlanarIntegrateOptions& options_;
  PlanarPieces pieces_;
};

inline PlanarResponse integrate(const PlanarEngine& engine, const GroundMotion& motion,
                                const PlanarIntegrateOptions& options, PlanarResponse storage) {
  return integrate_run(PlaneRun(engine, motion, options), std::move(storage));
}

}  // namespace detail

/// Integrate the motion of a slider in the plane under a ground motion with two horizontal components; see PlanarSlider
/// for the equation. Every stop is exact: a slider that stops stays where it is while friction holds the load, and a
/// slider that nearly stops is followed.
///
/// @param slider   the slider
/// @param motion   the ground acceleration, with a transverse component; a vertical one acts, too
/// @param options  state at the start, and whether to continue until the slider rests
/// @param storage  a discarded response whose buffers are reused
/// @return the response at the samples, with its events, peak and energy
/// @throws std::invalid_argument  a motion without a transverse component; a start that is not finite or beyond the
///                                stop; a vertical motion that ends in free fall (without `settle` or
///                                `may_end_in_flight`)
/// @throws std::overflow_error    a displacement, velocity or energy beyond the range of doubles
/// @throws ConvergenceError       with `settle`, the slider does not come to rest; more events than 1,000,000 plus
///                                eight per segment; more than three million steps within a hundredth of a segment
/// Accuracy: 1e-12 of the scale of r, 1e-10 s for the times of arrests. Cost: some 10 ns a sample at rest; sliding,
/// about 2 us a sample; some 20 us for each slip that begins under a load that grows smoothly, and for each stop.
template <IsotropicLaw Law>
PlanarResponse integrate(const PlanarSlider<Law>& slider, const GroundMotion& motion,
                         const PlanarIntegrateOptions& options = {}, PlanarResponse storage = {}) {
  return detail::integrate(detail::PlanarEngineOf(slider), motion, options, std::move(storage));
}

}  // namespace stickslip
