// The absolute acceleration of a mass that slides in the plane.
#pragma once

#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "stickslip/base/equal.hpp"
#include "stickslip/base/min_max.hpp"
#include "stickslip/base/units.hpp"
#include "stickslip/base/vector2.hpp"
#include "stickslip/ground/floor_motion.hpp"
#include "stickslip/ground/ground_motion.hpp"
#include "stickslip/planar/integrate.hpp"
#include "stickslip/planar/response.hpp"
#include "stickslip/planar/segment.hpp"
#include "stickslip/planar/slider.hpp"
#include "stickslip/planar/state.hpp"
#include "stickslip/planar/trajectory.hpp"
#include "stickslip/run/detail/chords.hpp"
#include "stickslip/run/detail/reading.hpp"

namespace stickslip {
namespace detail {

/// Reads the absolute acceleration of the mass as chords, and the jumps of its velocity as impulses.
class PlanarFloorReader final : public PlanarTrajectoryReader {
 public:
  /// @param tolerance  largest error of a chord [m/s^2]
  PlanarFloorReader(double downhill, double tolerance) : downhill_(downhill), tolerance_(tolerance) {}

  void segment(double, const PlanarLoadSegment& next) noexcept override {
    segment_ = &next;
    now_ = 0;
  }
  void end_of_segment() override { rest_until(segment_->duration); }
  /// @param velocity  at the end of the motion [m/s]
  void finish(Vector2 velocity) { jump_to(velocity); }

  void event(EventKind kind, double time, const PlanarState& state) override {
    if (kind != EventKind::impact && kind != EventKind::landing) return;
    rest_until(time);
    jump_to(state.velocity);
    before_ = state.velocity;
  }

  void arc(const PlanarArc& arc) override {
    rest_until(arc.begin);
    jump_to(arc.at(0).velocity);
    const auto at = [&](double s) {
      const double time = arc.at(s).time;
      return CurvePoint{s, time, absolute(arc.begin + time, arc.acceleration(s))};
    };
    // At a stop the direction of friction turns within a time that vanishes.
    const CurvePoint end = at(arc.last);
    add_chords(at, at(0), end, tolerance_, 0x1p-20 * arc.last, floor);
    now_ = arc.begin + end.time;
  }

  PlanarFloorMotion floor;

 private:
  Vector2 absolute(double time, Vector2 acceleration) const noexcept {
    return acceleration - segment_->load(time) + Vector2{downhill_, 0};
  }

  // At rest the mass has the acceleration of the ground, which is linear in time.
  void rest_until(double time) {
    const double duration = time - now_;
    if (!(duration > 0x1p-40 * segment_->duration)) return;
    jump_to({});
    floor.segments.push_back({duration, absolute(now_, {}), absolute(time, {})});
    now_ = time;
  }

  void jump_to(Vector2 velocity) {
    if (before_ && *before_ != velocity) floor.impulses.push_back({floor.segments.size(), velocity - *before_});
    before_.reset();
  }

  double downhill_, tolerance_;
  const PlanarLoadSegment* segment_ = nullptr;
  double now_ = 0;                 // since the beginning of the segment [s]
  std::optional<Vector2> before_;  // velocity before an impact or a landing
};

inline PlanarFloorMotion floor_motion(const PlanarEngine& engine, const GroundMotion& motion,
                                      const PlanarResponse& response, double tolerance) {
  check_floor(response, motion.samples(), tolerance);
  const double slope = engine.mounting().slope(), until = motion.time(response.displacement.size() - 1);
  const auto read = [&](double largest_error) {
    PlanarFloorReader reader(slope > 0 ? standard_gravity * std::sin(slope) : 0, largest_error);
    PlanarState state = start_of(response);
    trace(engine, motion, response, until, reader, state);
    reader.finish(state.velocity);
    return std::move(reader.floor);
  };
  // A floor that is not accelerated needs no division.
  double largest = std::numeric_limits<double>::min();
  for (const PlanarSegment& part : read(never).segments)
    largest = std::max({largest, norm(part.start), norm(part.end)});
  return read(tolerance * largest);
}

}  // namespace detail

/// The absolute acceleration of a mass that slides in the plane, r'' - p + g sin(slope); on level ground r'' + n. It is
/// the input to equipment on a sliding floor; the spectra of its components are floor spectra.
///
/// As on one axis (see sliding/floor_motion.hpp). In the plane the friction turns with the velocity, so that each slip
/// is divided into segments, of which each chord is within `tolerance`; while the slider rests the acceleration is that
/// of the ground, which is exact.
///
/// @param slider     the slider
/// @param motion     its ground motion
/// @param response   the result of `integrate` for them, which must not be truncated
/// @param tolerance  maximum error of a chord, as a fraction of the largest absolute acceleration, from 1e-10 to 1
/// @return from the first to the last sample of the response. Use `settle`, otherwise the floor stops together with the
///         ground motion
/// @throws std::invalid_argument  a tolerance out of range, a truncated response, a response to another motion
/// Accuracy: `tolerance`. Cost: about twice that of `integrate`, and 0.2 us per segment.
template <IsotropicLaw Law>
PlanarFloorMotion floor_motion(const PlanarSlider<Law>& slider, const GroundMotion& motion,
                               const PlanarResponse& response, double tolerance = 1e-6) {
  return detail::floor_motion(detail::PlanarEngineOf(slider), motion, response, tolerance);
}

}  // namespace stickslip
