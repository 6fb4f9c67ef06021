// The absolute acceleration of the sliding mass.
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "stickslip/base/equal.hpp"
#include "stickslip/base/min_max.hpp"
#include "stickslip/error.hpp"
#include "stickslip/ground/motion.hpp"
#include "stickslip/ground/response_spectrum.hpp"
#include "stickslip/ground/segment.hpp"
#include "stickslip/sliding/response.hpp"
#include "stickslip/sliding/trajectory.hpp"
#include "stickslip/state.hpp"

namespace stickslip {

/// The absolute acceleration of the mass along x: segments, and impulses at impacts.
struct FloorMotion {
  std::vector<Segment> segments;  ///< consecutive, accelerations [m/s^2]
  std::vector<Impulse> impulses;  ///< jumps of the velocity between them, in order
};

namespace detail {

/// The absolute acceleration of the mass during an arc [m/s^2].
inline double floor_acceleration(const Arc& arc, double downhill, double t) {
  return downhill - arc.load(t).load + arc.acceleration(t);
}

/// Reads the largest absolute acceleration at the ends of arcs.
class LargestAcceleration final : public TrajectoryReader {
 public:
  explicit LargestAcceleration(double downhill) : downhill_(downhill) {}

  void arc(const Arc& arc) override {
    for (const double t : {0.0, arc.duration})
      largest = std::max(largest, std::abs(floor_acceleration(arc, downhill_, t)));
  }

  double largest = 0;

 private:
  double downhill_;
};

/// Reads the absolute acceleration as chords, and the jumps of the velocity as impulses.
class FloorReader final : public TrajectoryReader {
 public:
  /// @param tolerance  maximum error of a chord [m/s^2]
  FloorReader(double downhill, double tolerance) : downhill_(downhill), tolerance_(tolerance) {}

  void arc(const Arc& arc) override {
    jump_to(arc.start.velocity);
    const double largest = std::max(std::abs(arc.load(0).load), std::abs(arc.load(arc.duration).load));
    noise_ = 0x1p-49 * (largest + std::abs(downhill_));
    add(arc, 0, arc.duration, floor_acceleration(arc, downhill_, 0), floor_acceleration(arc, downhill_, arc.duration));
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

  // The second differences of five values show how many equal chords are needed: twice as many have a quarter of the
  // error. Where many are needed the curvature may vary much, and each half is divided alone. Powers of two, because a
  // response spectrum costs least over segments of one duration.
  void add(const Arc& arc, double begin, double end, double first, double last) {
    const auto at = [&](double part) { return floor_acceleration(arc, downhill_, std::lerp(begin, end, part)); };
    const double a[] = {first, at(0.25), at(0.5), at(0.75), last};
    double bend = 0;
    for (int k = 1; k <= 3; ++k) bend = std::max(bend, std::abs(a[k - 1] - 2 * a[k] + a[k + 1]));
    if (!(bend > noise_)) bend = 0;
    constexpr double margin = 4.0 / 3;  // the curvature between the five values
    double chords = 1;
    while (chords * chords * tolerance_ < margin * 2 * bend && chords <= 8) chords *= 2;
    if (chords > 8 && end - begin > 0x1p-20 * arc.duration) {
      const double middle = std::midpoint(begin, end);
      add(arc, begin, middle, first, a[2]);
      return add(arc, middle, end, a[2], last);
    }
    const double duration = (end - begin) / chords;
    for (double k = 1, start = first; k <= chords; ++k) {
      const double stop = k < chords ? at(k / chords) : last;
      floor.segments.push_back({duration, start, stop});
      start = stop;
    }
  }

  double downhill_, tolerance_;
  double noise_ = 0;              // round-off of the acceleration [m/s^2]
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
  detail::require(tolerance >= 1e-10 && tolerance <= 1, "floor_motion: tolerance must be from 1e-10 to 1", tolerance);
  const Response& response = trajectory.response();
  if (response.truncated)
    throw std::invalid_argument(
        "floor motion: the samples of the response must reach the final rest, but they are truncated; extend the "
        "ground motion by zeros");
  const std::size_t samples = response.displacement.size();
  if (samples < trajectory.samples() || response.events.empty())
    throw std::invalid_argument("floor_motion: the response must be that to the motion of " +
                                std::to_string(trajectory.samples()) + " samples, got " + std::to_string(samples));
  const double until = trajectory.time(samples - 1), downhill = trajectory.downhill();
  detail::LargestAcceleration whole(downhill);
  trajectory.read(whole, until);
  // A floor that is not accelerated needs no division.
  detail::FloorReader reader(downhill, tolerance * std::max(whole.largest, std::numeric_limits<double>::min()));
  trajectory.read(reader, until);
  return std::move(reader.floor);
}

/// The same of a slider, or a law alone, under a ground motion.
template <class Slider, Motion M>
FloorMotion floor_motion(const Slider& slider, const M& motion, const Response& response, double tolerance = 1e-6) {
  return floor_motion(*trajectory(slider, motion, response), tolerance);
}

}  // namespace stickslip
