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
#include "stickslip/base/min_max.hpp"
#include "stickslip/error.hpp"
#include "stickslip/ground/ground_motion.hpp"
#include "stickslip/planar/advance.hpp"
#include "stickslip/planar/response.hpp"
#include "stickslip/planar/slider.hpp"
#include "stickslip/sliding/detail/recorder.hpp"
#include "stickslip/sliding/detail/run.hpp"

namespace stickslip {

struct PlanarIntegrateOptions {
  Vector2 displacement{};  ///< r at the start [m], finite
  Vector2 velocity{};      ///< r' at the start [m/s], finite
  bool settle = false;     ///< continue under zero ground acceleration after the last sample until the slider rests
  Contact contact = Contact::flight;  ///< what the slider does while the ground falls away from under it
  std::function<void()> progress{};   ///< called about once per second or more often; may throw to stop the work
  double sliding_distance = 0;     ///< sliding distance before the start [m], finite and at least 0; used by laws that
                                   ///< depend on it
  SurfaceHeat heat{};              ///< of the sliding surface at the start; used by laws that depend on its temperature
  bool may_end_in_flight = false;  ///< whether a response without `settle` may end before the slider has landed
};

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

/// Iterate over the segments of a motion and keep the motion at the samples: `go(i, begin, end, segment)` moves `state`
/// over a segment, and `report()` is called now and then. A slider that rests on level ground is asked for its next
/// departure only.
template <IsotropicLaw Law, class Go, class Report>
void walk_plane(const PlanarSlider<Law>& slider, const GroundMotion& motion, const PlanarPieces& pieces,
                const PlanarState& state, std::vector<Vector2>& displacement, std::vector<Vector2>& velocity, Go&& go,
                Report&& report) {
  constexpr std::size_t segments_per_report = 4096;
  const bool scans = !HeatedLaw<Law> && !(slider.slope() > 0) && !motion.has_vertical();
  const std::size_t count = motion.segments();
  for (std::size_t i = 0; i < count;) {
    for (const std::size_t last = std::min(i + segments_per_report, count); i < last;) {
      if (scans && state.mode == PlanarMode::stuck) {
        const std::size_t next = pieces.first_outside(i, last, slider.mounting().spring().under(1) * state.displacement,
                                                      hold_at(slider, state));
        std::fill(displacement.data() + i + 1, displacement.data() + next + 1, state.displacement);
        std::fill(velocity.data() + i + 1, velocity.data() + next + 1, Vector2{});
        if ((i = next) == last) break;
      }
      go(i, pieces.time(i), pieces.time(i + 1), pieces.segment(i));
      displacement[i + 1] = state.displacement;
      velocity[i + 1] = state.velocity;
      ++i;
    }
    if (i < count) report();
  }
}

/// Records the events, the peak and the sums of a motion in the plane.
class PlanarRecorder final : public PlanarSink {
 public:
  static constexpr std::uint32_t work_per_report = 4096;  // events or flows

  PlanarRecorder(Vector2 from, double start, std::size_t event_limit, const std::function<void()>& progress,
                 PlanarResponse& response)
      : response_(response), from_(from), event_limit_(event_limit), progress_(progress) {
    response_.events.clear();
    look(norm(from), from, start);
  }

  void begin_segment(double begin, double end) noexcept {
    segment_begins_ = begin;
    segment_ends_ = end;
  }
  void report_progress() const {
    if (progress_) progress_();
  }

  void follow(const PlanarSlipFlow& flow, double last, double begin) override {
    if (++work_ % work_per_report == 0) report_progress();
    const PlanarProgress end = flow.at_parameter(last);
    double where = last;
    if (const double radius = flow.largest_radius(last, response_.peak, where); radius > response_.peak) {
      const PlanarProgress at = flow.at_parameter(where);
      look(radius, flow.place() + at.way, segment_begins_ + begin + at.time);
    }
    const auto work = flow.work(last);
    response_.energy.input += work.load;
    response_.energy.dissipated += work.friction;
    response_.energy.damped += work.damper;
    response_.sliding_distance += end.distance;
    response_.time_sliding += end.time;
  }
  void event(EventKind kind, double time, const PlanarState& state) override {
    if (++work_ % work_per_report == 0) report_progress();
    if (response_.events.size() >= event_limit_) refuse_more_events(event_limit_, segment_begins_ + time);
    response_.events.push_back(
        {std::min(segment_begins_ + time, segment_ends_), state.displacement, state.velocity, kind});
  }
  void dissipate(double work) override { response_.energy.dissipated += work; }
  void lose(double energy) override { response_.energy.impact += energy; }

 private:
  void look(double radius, Vector2 place, double time) noexcept {
    response_.peak = radius;
    response_.peak_displacement = place;
    response_.peak_time = time;
  }

  PlanarResponse& response_;
  double segment_begins_ = 0, segment_ends_ = 0;
  Vector2 from_;
  std::size_t event_limit_;
  std::uint32_t work_ = 0;
  const std::function<void()>& progress_;
};

/// As `settle` on one axis: continue without ground acceleration until the slider comes to rest.
/// @return whether it crept to rest, without an event
template <IsotropicLaw Law, class Go>
bool settle(const PlanarSlider<Law>& slider, PlanarState& state, Go&& go) {
  double longest = 0x1p40;  // [s], about 35,000 years
  if constexpr (form_of<Law> == Form::constant)
    if (state.mode != PlanarMode::stuck && !(hold(slider.law(), 0, Direction::forward) > 0)) longest = 0;
  const double wn = slider.natural_frequency();
  double scale = wn > 0 ? norm(state.velocity) / wn : 0;  // of the displacement [m]
  // As on one axis.
  const double weight = standard_gravity * std::sin(slider.slope()), stiffness = slider.stiffness();
  const double lowest = slider.mounting().stops.forward();
  const auto energy = [&] {
    const Vector2 stretched = state.displacement - Vector2{stiffness > 0 ? weight / stiffness : 0, 0};
    return (dot(state.velocity, state.velocity) + stiffness * dot(stretched, stretched)) / 2 +
           (weight > 0 && !(stiffness > 0) ? weight * (lowest - state.displacement.axis) : 0);
  };
  for (double duration = 1; duration <= longest; duration *= 2) {
    const Vector2 from = state.displacement;
    const double speed = norm(state.velocity), before = energy();
    go(duration);
    if (state.in_flight) continue;
    if (state.mode == PlanarMode::stuck) return false;
    if (rings_on(before, energy(), duration, longest)) break;
    // A damper above the critical one lets a slider creep, too.
    if (!PositionLaw<Law> || slider.damping() > 0) {
      scale = std::max(scale, std::max(norm(from), norm(state.displacement)));
      const bool rests = norm(state.velocity) <= (wn > 0 ? 0x1p-40 * wn * scale : speed / 2);
      if (rests && norm(state.displacement - from) <= 0x1p-50 * scale) {
        state.velocity = {};
        state.mode = PlanarMode::stuck;
        return true;
      }
    }
  }
  throw ConvergenceError(
      "without ground motion the slider does not come to rest: at |r| = " + shortest(norm(state.displacement)) +
      " m it still moves at " + shortest(norm(state.velocity)) + " m/s; use settle = false");
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
  using detail::require;
  for (const auto& [value, name, unit] :
       {std::tuple(options.displacement, "displacement", "m"), std::tuple(options.velocity, "velocity", "m/s")})
    for (const double component : {value.axis, value.transverse})
      require(std::isfinite(component), std::string("integrate: ") + name + " must be finite", component, unit);
  require(std::isfinite(options.sliding_distance) && options.sliding_distance >= 0,
          "integrate: sliding_distance must be finite and at least 0", options.sliding_distance, "m");
  const detail::PlanarPieces pieces(motion, slider.slope());
  PlanarState state = PlanarState::at(options.displacement, options.velocity);
  state.sliding_distance = options.sliding_distance;
  state.heat = options.heat;
  detail::check_start(slider, state, "integrate");
  if (options.contact == Contact::flight && !options.settle && !options.may_end_in_flight)
    detail::check_landing(motion, slider.slope());
  const bool flies = options.contact == Contact::flight && detail::may_fly(motion, slider.slope());

  PlanarResponse response = std::move(storage);
  response.displacement.resize(motion.samples());
  response.velocity.resize(motion.samples());
  response.gap.assign(flies ? motion.samples() : 0, 0);
  response.temperature.clear();
  if constexpr (HeatedLaw<Law>)
    response.temperature.resize(motion.samples(), slider.law().temperature(detail::on_path<Law>(state)));
  response.heat = options.heat;
  response.energy = {};
  response.peak = response.sliding_distance = response.time_sliding = 0;
  const auto kinetic = [&] { return dot(state.velocity, state.velocity) / 2; };
  const auto elastic = [&] { return slider.stiffness() * dot(state.displacement, state.displacement) / 2; };
  response.displacement[0] = state.displacement;
  response.velocity[0] = state.velocity;
  response.energy.initial = kinetic() + elastic();
  detail::PlanarRecorder recorder(state.displacement, motion.time(0), detail::max_events(motion.segments()),
                                  options.progress, response);
  recorder.begin_segment(motion.time(0), motion.time(0));
  if (state.mode != PlanarMode::stuck) recorder.event(EventKind::breakaway, 0, state);
  const auto go = [&](std::size_t i, double begin, double end, const PlanarLoadSegment& segment) {
    recorder.begin_segment(begin, end);
    detail::advance_plane(slider, segment, options.contact, state, recorder);
    if (flies) response.gap[i + 1] = state.gap;
    if constexpr (HeatedLaw<Law>) response.temperature[i + 1] = slider.law().temperature(detail::on_path<Law>(state));
  };
  detail::walk_plane(slider, motion, pieces, state, response.displacement, response.velocity, go,
                     [&] { recorder.report_progress(); });
  double end = motion.time(motion.segments());
  response.contact = options.contact;
  response.components = std::string(name_of(Component::axis)) + " + " + name_of(Component::transverse);
  if (motion.has_vertical()) response.components += std::string(" + ") + name_of(Component::vertical);
  response.truncated = false;
  if (options.settle) {
    const detail::Slope slope(slider.slope());
    const auto at_rest = [&](double duration) { return detail::load_segment(PlanarSegment{duration, {}, {}}, slope); };
    PlanarState from = state;
    double time = end;
    const bool crept = detail::settle(slider, state, [&](double duration) {
      recorder.begin_segment(time, time + duration);
      detail::advance_plane(slider, at_rest(duration), options.contact, state, recorder);
      time += duration;
    });
    recorder.begin_segment(time, time);
    if (crept) recorder.event(EventKind::arrest, 0, state);
    if (!response.events.empty()) end = std::max(end, response.events.back().time);
    NoPlanarObserver nobody;
    detail::PlanarObserverSink none(nobody);
    for (std::size_t i = motion.segments(); motion.time(i) < end; ++i) {
      if (i + 1 >= 10 * motion.samples()) {
        response.truncated = true;
        break;
      }
      detail::advance_plane(slider, at_rest(motion.last_step()), options.contact, from, none);
      if (!(motion.time(i + 1) < end)) {
        from.displacement = state.displacement;
        from.velocity = {};
        from.mode = PlanarMode::stuck;
      }
      response.displacement.push_back(from.displacement);
      response.velocity.push_back(from.velocity);
      if (flies) response.gap.push_back(from.gap);
      if constexpr (HeatedLaw<Law>)
        response.temperature.push_back(slider.law().temperature(detail::on_path<Law>(from)));
    }
  }
  recorder.begin_segment(end, end);
  recorder.event(EventKind::end, 0, state);
  response.residual = state.displacement;
  response.energy.kinetic = kinetic();
  response.energy.elastic = elastic();
  response.state = state;
  if (!std::isfinite(response.energy.imbalance()) || !std::isfinite(response.peak))
    throw std::overflow_error("integrate: the motion leaves the range of doubles, in displacement (peak " +
                              detail::shortest(response.peak) + " m), velocity or energy");
  return response;
}

}  // namespace stickslip
