// The forces on a slider in the plane during its response.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "stickslip/base/min_max.hpp"
#include "stickslip/base/units.hpp"
#include "stickslip/base/vector2.hpp"
#include "stickslip/friction/law.hpp"
#include "stickslip/ground/ground_motion.hpp"
#include "stickslip/planar/integrate.hpp"
#include "stickslip/planar/response.hpp"
#include "stickslip/planar/segment.hpp"
#include "stickslip/planar/slider.hpp"
#include "stickslip/planar/state.hpp"
#include "stickslip/planar/trajectory.hpp"
#include "stickslip/run/detail/largest.hpp"
#include "stickslip/sliding/forces.hpp"

namespace stickslip {

/// Forces per unit mass at the samples of a response [m/s^2], positive where they pull toward negative components:
///     r'' + friction + damper + spring = p.
/// As on one axis, the impact on a stop is an impulse, and the force with which a stop holds the slider counts as
/// friction, both at rest and while the slider slides along the stop.
struct PlanarForces {
  std::vector<Vector2> friction;    ///< resist N+/g r'/|r'| during a slip; p - spring while the slider sticks
  std::vector<Vector2> damper;      ///< c r'
  std::vector<Vector2> spring;      ///< wn^2 r; of a pendulum times N+/g
  std::vector<double> normal;       ///< N+, 0 while the slider is in flight
  std::vector<std::uint8_t> stuck;  ///< 1 while the slider sticks, else 0
  double downhill = 0;              ///< g sin(slope)
  double peak = 0;                  ///< largest |friction + damper + spring| over all time, not only at samples
  double peak_time = 0;             ///< its time [s]

  /// The sum of friction, damper and spring [m/s^2].
  Vector2 total(std::size_t i) const noexcept { return friction[i] + damper[i] + spring[i]; }

  /// Absolute acceleration of the mass [m/s^2].
  Vector2 acceleration(std::size_t i) const noexcept {
    return Vector2{downhill, 0} - total(i) + Vector2{0.0, 0.0};  // no minus zero
  }
};

namespace detail {

struct PlanarForce {
  Vector2 friction, damper, spring;
  double normal;
};

/// The forces in a state under a load and a normal force N.
inline PlanarForce force_on(const PlanarEngine& engine, const PlanarState& state, Vector2 load, double normal) {
  const double weight = state.in_flight ? 0 : std::max(normal, 0.0) / standard_gravity;
  const double pull = engine.mounting().spring().under(weight);
  PlanarForce force{
      {}, engine.mounting().damping * state.velocity, pull * state.displacement, weight * standard_gravity};
  const Vector2 q = load - force.spring;
  if (state.mode == PlanarMode::stuck) {
    force.friction = q;
    return force;
  }
  // A slip begins in the direction of the load.
  const double speed = norm(state.velocity), size = norm(q);
  const Vector2 direction = speed > 0 ? (1 / speed) * state.velocity : size > 0 ? (1 / size) * q : Vector2{};
  if (weight > 0) {
    force.friction = (weight * engine.resist(state, weight, speed)) * direction;
  }
  if (state.mode == PlanarMode::along_stop) {
    const double gap = norm(state.displacement);
    const Vector2 outward = (1 / gap) * state.displacement;
    force.friction += std::max(dot(q, outward) + speed * speed / gap, 0.0) * outward;
  }
  return force;
}

/// Reads the largest resultant force of a motion in the plane, p - r'', and whether a slip begins at the start of a
/// segment.
class PeakForce final : public PlanarTrajectoryReader {
 public:
  void segment(double begin, const PlanarLoadSegment& segment) override {
    begin_ = begin;
    segment_ = &segment;
    now_ = 0;
    departs = false;
  }
  void end_of_segment() override { rest_until(segment_->duration); }

  void event(EventKind kind, double time, const PlanarState&) override {
    departs = departs || (kind == EventKind::breakaway && !(time > 0));
  }

  // The force is smooth in the parameter of an arc, which ends before it changes much.
  void arc(const PlanarArc& arc) override {
    rest_until(arc.begin);
    look_for_largest(arc.last, 8, peak, [&](double s) {
      const double time = arc.begin + arc.at(s).time, force = norm(load(time) - arc.acceleration(s));
      look(force, time);
      return force;
    });
    now_ = arc.begin + arc.at(arc.last).time;
  }

  double peak = 0, peak_time = 0;
  bool departs = false;

 private:
  Vector2 load(double time) const noexcept {
    return segment_->duration > 0 ? segment_->load(time) : segment_->load_end;
  }
  // At rest the resultant is the load, which is largest at an end.
  void rest_until(double time) noexcept {
    if (!(time - now_ > 0x1p-40 * segment_->duration)) return;
    look(norm(load(now_)), now_);
    look(norm(load(time)), time);
    now_ = time;
  }
  void look(double resultant, double time) noexcept {
    if (!(resultant > peak)) return;
    peak = resultant;
    peak_time = begin_ + time;
  }

  const PlanarLoadSegment* segment_ = nullptr;
  double begin_ = 0;  // of the segment [s]
  double now_ = 0;    // since then [s]
};

/// Ground acceleration just after each of the first `samples` samples [m/s^2], of a component of a motion: at the end
/// of the motion the value just before it, then 0.
inline std::vector<double> acting(const GroundMotion& motion, std::span<const double> component, std::size_t samples) {
  std::vector<double> n(component.begin(), component.end());
  if (motion.interpolation() == Interpolation::constant &&
      !n.empty()) {                             // the last value never acts, nor do segments of
    const std::size_t end = motion.segments();  // zero duration
    std::size_t last = end - 1;
    while (equal(motion.time(last), motion.time(end))) --last;  // the duration is positive
    n[end] = n[last];
    for (std::size_t i = end; i-- > 0;)
      if (equal(motion.time(i), motion.time(i + 1))) n[i] = n[i + 1];
  }
  n.resize(samples);
  return n;
}

inline PlanarForces forces(const PlanarEngine& engine, const GroundMotion& motion, const PlanarResponse& response) {
  const double angle = engine.mounting().slope();
  const std::size_t samples = response.displacement.size();
  const std::vector<double> along = acting(motion, motion.acceleration(), samples),
                            up = acting(motion, motion.vertical(), samples),
                            across = acting(motion, motion.transverse(), samples);
  PlanarForces result;
  if (angle > 0) result.downhill = standard_gravity * std::sin(angle);
  const Slope slope(angle);
  const PlanarPieces pieces(motion, angle);
  const double end = response.events.back().time;
  PlanarState state = start_of(response);
  PeakForce peak;
  PlanarTracer tracer{peak};
  const auto go = [&](double from, double to) {
    bool departs = false;
    between(pieces, motion, angle, from, to, [&](double begin, const PlanarLoadSegment& segment) {
      peak.segment(begin, segment);
      engine.move(segment, response.contact, state, tracer);
      peak.end_of_segment();
      departs = departs || (peak.departs && equal(begin, from));
    });
    if (!(to < end)) state = response.state;
    return departs;
  };
  for (std::size_t i = 0; i < samples; ++i) {
    PlanarState here = state;
    const double time = motion.time(i), next = i + 1 < samples ? std::min(motion.time(i + 1), end) : end;
    if (time < next && go(time, next)) here.mode = PlanarMode::sliding;
    const PlanarSegment ground{0, {along[i], across[i]}, {along[i], across[i]}};
    const PlanarLoadSegment load = load_segment(ground, slope, up[i], up[i]);
    const PlanarForce now = force_on(engine, here, load.load_start, load.normal_start);
    const auto positive = [](Vector2 v) { return v + Vector2{0.0, 0.0}; };  // no minus zero
    result.friction.push_back(positive(now.friction));
    result.damper.push_back(positive(now.damper));
    result.spring.push_back(positive(now.spring));
    result.normal.push_back(now.normal);
    result.stuck.push_back(here.mode == PlanarMode::stuck);
  }
  result.peak = peak.peak;
  result.peak_time = peak.peak_time;
  return result;
}

}  // namespace detail

/// The forces on a slider in the plane during a response.
///
/// At a sample at which a slip begins or stops, or a held ground acceleration jumps, the values are those just after
/// it. At the end of the ground motion they balance its last value (of held values, the last that acts); after that the
/// ground acceleration is 0.
///
/// @param slider    the slider
/// @param motion    its ground motion
/// @param response  the result of `integrate` for them
/// @return vectors as long as `response.displacement`, and the largest resultant in continuous time
/// As accurate as the displacement and the velocity; the peak, found by a search within each step, to 1e-9. The motion
/// is integrated again: about twice the cost of `integrate`.
template <IsotropicLaw Law>
PlanarForces forces(const PlanarSlider<Law>& slider, const GroundMotion& motion, const PlanarResponse& response) {
  return detail::forces(detail::PlanarEngineOf(slider), motion, response);
}

}  // namespace stickslip
