// The absolute acceleration of the sliding mass.
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

#include "stickslip/base/equal.hpp"
#include "stickslip/base/error.hpp"
#include "stickslip/base/min_max.hpp"
#include "stickslip/ground/floor_motion.hpp"
#include "stickslip/ground/motion.hpp"
#include "stickslip/run/detail/reading.hpp"
#include "stickslip/sliding/response.hpp"
#include "stickslip/sliding/trajectory.hpp"
#include "stickslip/state/state.hpp"

namespace stickslip {

namespace detail {

/// The absolute acceleration of the mass during an arc or a part of it, at five equally spaced times [m/s^2].
struct FloorArc {
  double values[5];
  double bend = 0;  ///< largest second difference; 0 if it is round-off

  static double at(const Arc& arc, double downhill, double t) {
    return downhill - arc.load(t).load + arc.acceleration(t);
  }

  FloorArc(const Arc& arc, double downhill, double begin, double end) {
    for (int k = 0; k < 5; ++k) values[k] = at(arc, downhill, std::lerp(begin, end, k / 4.0));
    for (int k = 1; k < 4; ++k) bend = std::max(bend, std::abs(values[k - 1] - 2 * values[k] + values[k + 1]));
    const double largest = std::max(std::abs(arc.load(0).load), std::abs(arc.load(arc.duration).load));
    if (!(bend > 0x1p-49 * (largest + std::abs(downhill)))) bend = 0;
  }
};

/// Reads the largest absolute acceleration at the ends of arcs, and the largest bend.
class FloorRange final : public TrajectoryReader {
 public:
  explicit FloorRange(double downhill) : downhill_(downhill) {}

  void arc(const Arc& arc) override {
    const FloorArc floor(arc, downhill_, 0, arc.duration);
    largest = std::max({largest, std::abs(floor.values[0]), std::abs(floor.values[4])});
    bend = std::max(bend, floor.bend);
  }

  double largest = 0, bend = 0;

 private:
  double downhill_;
};

/// Reads the absolute acceleration as chords, and the jumps of the velocity as impulses.
class FloorReader final : public TrajectoryReader {
 public:
  /// @param tolerance  maximum error of a chord [m/s^2]
  /// @param bend       largest of all arcs [m/s^2]
  FloorReader(double downhill, double tolerance, double bend)
      : downhill_(downhill), tolerance_(tolerance), usual_(std::min(chords(bend), max_chords)) {}

  void arc(const Arc& arc) override {
    jump_to(arc.start.velocity);
    add(arc, 0, arc.duration);
  }

  void event(EventKind kind, double, const State& state, const Load&) override {
    const bool jumps = kind == EventKind::impact || kind == EventKind::landing;
    if (jumps || kind == EventKind::end) jump_to(state.velocity);
    if (jumps) before_ = state.velocity;
  }

  FloorMotion floor;

 private:
  void jump_to(double velocity) {
    if (before_ && !equal(*before_, velocity)) floor.impulses.push_back({floor.segments.size(), velocity - *before_});
    before_.reset();
  }

  static constexpr double max_chords = 8;

  // The number of equal chords, a power of two: twice as many have a quarter of the error.
  double chords(double bend) const noexcept {
    constexpr double margin = 4.0 / 3;  // the curvature between the five values
    double chords = 1;
    while (chords * chords * tolerance_ < margin * 2 * bend && chords <= max_chords) chords *= 2;
    return chords;
  }

  // Where many chords are needed the curvature may vary much, and each half is divided alone. All other arcs that bend
  // have as many, because a response spectrum costs least over segments of one duration.
  void add(const Arc& arc, double begin, double end) {
    const FloorArc part(arc, downhill_, begin, end);
    const double needed = chords(part.bend);
    if (needed > max_chords && end - begin > 0x1p-20 * arc.duration) {
      const double middle = std::midpoint(begin, end);
      add(arc, begin, middle);
      return add(arc, middle, end);
    }
    const double count = part.bend > 0 ? std::max(needed, usual_) : 1;
    for (double k = 1, start = part.values[0]; k <= count; ++k) {
      const double stop = k < count ? FloorArc::at(arc, downhill_, std::lerp(begin, end, k / count)) : part.values[4];
      floor.segments.push_back({(end - begin) / count, start, stop});
      start = stop;
    }
  }

  double downhill_, tolerance_, usual_;
  std::optional<double> before_;  // velocity before an impact or a landing
};

}  // namespace detail

/// The absolute acceleration of the mass along x, x'' - p + g sin(slope); on level ground x'' + n. It is the input to
/// equipment on a sliding floor; its `response_spectrum` is the floor spectrum.
///
/// It jumps at the start of a slip, at a reversal, at a stop of a slip, at a lift-off and at a landing; a segment ends
/// there. While the slider sticks it equals the ground acceleration along x, and while it slides under a constant level
/// without spring and damper it is linear in time; both are exact. Otherwise each arc of the trajectory is divided into
/// segments, of which each chord is within `tolerance`. An impact on a stop, and the friction impulse of a landing,
/// change the velocity at once: they are impulses.
///
/// @param trajectory  of the response, which must not be truncated
/// @param tolerance   maximum error of a chord, as a fraction of the largest absolute acceleration, from 1e-10 to 1
/// @return from the first to the last sample of the response. Use `settle`, otherwise the floor stops together with the
///         ground motion
/// @throws std::invalid_argument  a tolerance out of range, a truncated response, a response to another motion
/// Accuracy: `tolerance`; round-off for constant levels without spring and damper. The acceleration that is divided is
/// that of the motion itself, as exact as `integrate`. An error e of the absolute acceleration changes a
/// pseudo-acceleration of damping ratio z by at most e coth(pi z / (2 sqrt(1 - z^2))): 12.7 e at 5 %. Cost: about twice
/// that of `integrate`, and 30 ns per segment.
inline FloorMotion floor_motion(const Trajectory& trajectory, double tolerance = 1e-6) {
  const Response& response = trajectory.response();
  detail::check_floor(response, trajectory.samples(), tolerance);
  const double until = trajectory.time(response.displacement.size() - 1), downhill = trajectory.downhill();
  detail::FloorRange whole(downhill);
  trajectory.read(whole, until);
  // A floor that is not accelerated needs no division.
  const double largest = std::max(whole.largest, std::numeric_limits<double>::min());
  detail::FloorReader reader(downhill, tolerance * largest, whole.bend);
  trajectory.read(reader, until);
  return std::move(reader.floor);
}

/// The same of a slider, or a law alone, under a ground motion.
template <class Slider, Motion M>
FloorMotion floor_motion(const Slider& slider, const M& motion, const Response& response, double tolerance = 1e-6) {
  return floor_motion(*trajectory(slider, motion, response), tolerance);
}

}  // namespace stickslip
