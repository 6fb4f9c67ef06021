// The motion of a slider in the plane between the samples of its response.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "stickslip/base/equal.hpp"
#include "stickslip/base/min_max.hpp"
#include "stickslip/ground/ground_motion.hpp"
#include "stickslip/planar/detail/radius.hpp"
#include "stickslip/planar/integrate.hpp"
#include "stickslip/planar/path.hpp"
#include "stickslip/planar/response.hpp"
#include "stickslip/planar/slider.hpp"
#include "stickslip/planar/state.hpp"
#include "stickslip/run/detail/reading.hpp"
#include "stickslip/sliding/trajectory.hpp"

namespace stickslip {

/// A part of a motion in the plane that is computed in one piece: of a slip, of a flight, or along a stop. A parameter
/// from 0 to `last` stands for the time.
class PlanarArc {
 public:
  PlanarArc(const PlanarPath& path, double end, double time) : begin(time), last(end), place(path.place), path_(path) {}

  double begin;   ///< since the beginning of the segment [s]
  double last;    ///< largest parameter
  Vector2 place;  ///< r at its beginning [m]

  /// Time and displacement since the beginning of the arc, velocity, and length of the path.
  PlanarProgress at(double parameter) const { return path_.at_parameter(parameter); }
  /// r'' [m/s^2]; at a stop, its limit.
  Vector2 acceleration(double parameter) const { return path_.acceleration_at(parameter); }
  /// The largest distance from the origin [m]; `where` receives its parameter.
  double largest_radius(double& where) const { return detail::largest_radius(path_, last, 0, where); }

 private:
  const PlanarPath& path_;
};

/// Receives a motion in the plane, segment by segment, while it is integrated again. The slider rests in the time that
/// no arc covers. At an impact or a landing the state is that before it. Times are since the beginning of the segment.
struct PlanarTrajectoryReader {
  virtual void segment(double /*begin*/, const PlanarLoadSegment&) = 0;
  virtual void arc(const PlanarArc&) = 0;
  virtual void event(EventKind, double /*time*/, const PlanarState&) {}
  virtual void end_of_segment() {}

 protected:
  ~PlanarTrajectoryReader() = default;
};

namespace detail {

/// Shows flows and events to a reader.
class PlanarTracer final : public PlanarSink {
 public:
  explicit PlanarTracer(PlanarTrajectoryReader& reader) noexcept : reader_(reader) {}

  void event(EventKind kind, double time, const PlanarState& state) override { reader_.event(kind, time, state); }
  void follow(const PlanarPath& path, double last, double begin) override { reader_.arc(PlanarArc(path, last, begin)); }

 private:
  PlanarTrajectoryReader& reader_;
};

/// The last segment of a motion that begins at or before a time.
inline std::size_t segment_at(const GroundMotion& motion, double time) {
  std::size_t first = 0, last = motion.segments();
  while (last - first > 1) {
    const std::size_t middle = first + (last - first) / 2;
    (motion.time(middle) <= time ? first : last) = middle;
  }
  return first;
}

/// The state at the start of a response.
inline PlanarState start_of(const PlanarResponse& response) {
  PlanarState state = PlanarState::at(response.displacement.front(), response.velocity.front());
  state.sliding_distance = std::max(response.state.sliding_distance - response.sliding_distance, 0.0);
  state.heat = response.heat;
  return state;
}

/// Call `go(begin, segment)` for each part of a ground motion from one time to a later one, with the time at which the
/// part begins [s]. After the motion the ground acceleration is zero.
template <class Go>
void between(const PlanarPieces& pieces, const GroundMotion& motion, double slope, double from, double to, Go&& go) {
  for (std::size_t i = segment_at(motion, from); i < motion.segments() && motion.time(i) < to; ++i) {
    const double first = motion.time(i), last = motion.time(i + 1);
    const double begin = std::max(first, from), end = std::min(last, to);
    if (!(begin < end)) continue;
    const PlanarLoadSegment whole = pieces.segment(i);
    if (equal(begin, first) && equal(end, last))
      go(begin, whole);
    else
      go(begin, PlanarLoadSegment{end - begin, whole.load(begin - first), whole.load(end - first),
                                  whole.normal(begin - first), whole.normal(end - first)});
  }
  const double begin = std::max(motion.time(motion.segments()), from);
  if (begin < to) go(begin, load_segment(PlanarSegment{to - begin, {}, {}}, Slope(slope)));
}

/// Show a motion to a reader, from its beginning to a time.
/// @param state  at its beginning; moves with it
inline void trace(const PlanarEngine& engine, const GroundMotion& motion, const PlanarResponse& response, double until,
                  PlanarTrajectoryReader& reader, PlanarState& state) {
  PlanarTracer tracer(reader);
  const double slope = engine.mounting().slope();
  const PlanarPieces pieces(motion, slope);
  between(pieces, motion, slope, motion.time(0), until, [&](double begin, const PlanarLoadSegment& segment) {
    reader.segment(begin, segment);
    engine.move(segment, response.contact, state, tracer);
    reader.end_of_segment();
  });
}

inline std::vector<PlanarState> states_at(const PlanarEngine& engine, const GroundMotion& motion,
                                          const PlanarResponse& response, std::span<const double> times) {
  const double begin = motion.time(0), end = response.events.back().time;
  const std::vector<std::size_t> order = order_of(times, begin, end, motion.time(response.displacement.size() - 1));
  const double slope = engine.mounting().slope();
  const PlanarPieces pieces(motion, slope);
  std::vector<PlanarState> states(times.size());
  PlaneRun::NoSink none;
  PlanarState state = start_of(response);
  double now = begin;
  for (const std::size_t i : order) {
    if (now < times[i])
      between(pieces, motion, slope, now, times[i],
              [&](double, const PlanarLoadSegment& segment) { engine.move(segment, response.contact, state, none); });
    now = times[i];
    states[i] = now < end ? state : response.state;
  }
  return states;
}

}  // namespace detail

/// The states of a slider in the plane at any times of a response, also between its samples and after the last sample.
///
/// @param slider    the slider
/// @param motion    its ground motion
/// @param response  the result of `integrate` for them
/// @param times     in any order, from the start of the motion to the last event or sample of the response [s]
/// @return a state for each time, in their order; at an impact or a landing, that after it
/// @throws std::invalid_argument  a time before the start or after the end
/// As exact as `integrate`: the motion is integrated again, and ends a step at each time. Cost: about that of
/// `integrate`, and 1 us for each time.
template <IsotropicLaw Law>
std::vector<PlanarState> states_at(const PlanarSlider<Law>& slider, const GroundMotion& motion,
                                   const PlanarResponse& response, std::span<const double> times) {
  return detail::states_at(detail::PlanarEngineOf(slider), motion, response, times);
}

}  // namespace stickslip
