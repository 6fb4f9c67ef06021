// The forces on a slider in the plane during its response.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "stickslip/base/min_max.hpp"
#include "stickslip/friction/law.hpp"
#include "stickslip/ground/ground_motion.hpp"
#include "stickslip/planar/integrate.hpp"
#include "stickslip/planar/response.hpp"
#include "stickslip/planar/segment.hpp"
#include "stickslip/planar/slider.hpp"
#include "stickslip/planar/state.hpp"
#include "stickslip/planar/trajectory.hpp"
#include "stickslip/planar/vector.hpp"
#include "stickslip/sliding/forces.hpp"
#include "stickslip/units.hpp"

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

  double resultant() const noexcept { return norm(friction + damper + spring); }
};

/// The forces in a state under a load and a normal force N.
template <IsotropicLaw Law>
PlanarForce force_on(const PlanarSlider<Law>& slider, const PlanarState& state, Vector2 load, double normal) {
  const double weight = state.in_flight ? 0 : std::max(normal, 0.0) / standard_gravity;
  const double pull = slider.mounting().spring().under(weight);
  PlanarForce force{{}, slider.damping() * state.velocity, pull * state.displacement, weight * standard_gravity};
  const Vector2 q = load - force.spring;
  if (state.mode == PlanarMode::stuck) {
    force.friction = q;
    return force;
  }
  // A slip begins in the direction of the load.
  const double speed = norm(state.velocity), size = norm(q);
  const Vector2 direction = speed > 0 ? (1 / speed) * state.velocity : size > 0 ? (1 / size) * q : Vector2{};
  if (weight > 0) {
    State along{.sliding_distance = state.sliding_distance};
    if constexpr (HeatedLaw<Law>) along.heat = state.heat;
    force.friction = (weight * resist(law_at(slider.law(), along, weight), 0.0, speed, Direction::forward)) * direction;
  }
  if (state.mode == PlanarMode::along_stop) {
    const double gap = norm(state.displacement);
    const Vector2 outward = (1 / gap) * state.displacement;
    force.friction += std::max(dot(q, outward) + speed * speed / gap, 0.0) * outward;
  }
  return force;
}

/// Finds the largest resultant force of a motion in the plane.
template <IsotropicLaw Law>
class PeakForce {
 public:
  /// @param state  that of the motion, which is followed
  PeakForce(const PlanarSlider<Law>& slider, const PlanarState& state, PlanarForces& forces)
      : slider_(slider), state_(state), forces_(forces) {}

  void begin(double time, const PlanarLoadSegment& segment) noexcept {
    begin_ = time;
    segment_ = &segment;
    departs_ = false;
    if (state_.mode == PlanarMode::stuck) rest(0);
  }
  void end() noexcept {
    if (state_.mode == PlanarMode::stuck) rest(segment_->duration);
  }
  /// Whether a slip began at the start of the segment.
  bool departs() const noexcept { return departs_; }

  void event(EventKind kind, double time, const PlanarState&) noexcept {
    departs_ = departs_ || (kind == EventKind::breakaway && !(time > 0));
    if (kind == EventKind::breakaway || kind == EventKind::arrest) rest(time);
  }

  // The force is smooth in the parameter of a flow, which ends before it changes much.
  template <class Flow>
  void follow(const Flow& flow, double last, double begin) {
    constexpr int parts = 8;
    PlanarState there = state_;
    double time = 0;
    const auto resultant = [&](double s) {
      const PlanarProgress at = flow.at_parameter(s);
      there.displacement = flow.place() + at.way;
      there.velocity = at.velocity;
      there.sliding_distance = state_.sliding_distance + at.distance;
      time = begin + at.time;
      return force_on(slider_, there, segment_->load(time), segment_->normal(time)).resultant();
    };
    // At a stop the direction of the velocity has a limit only.
    const bool stops = flow.stop() < never && !(last < flow.last());
    const double end = stops ? last * (1 - 0x1p-20) : last;
    double largest = 0;
    int where = 0;
    for (int i = 0; i <= parts; ++i) {
      const double here = resultant(end * i / parts);
      if (here > largest) largest = here, where = i;
      look(here, time);
    }
    if (largest < 0.9 * forces_.peak) return;
    double low = end * std::max(where - 1, 0) / parts, high = end * std::min(where + 1, parts) / parts;
    constexpr double golden = 0.6180339887498949;
    double left = high - golden * (high - low), right = low + golden * (high - low);
    double at_left = resultant(left), at_right = resultant(right);
    for (int i = 0; i < 40; ++i) {
      if (at_left < at_right) {
        low = left, left = right, at_left = at_right;
        right = low + golden * (high - low), at_right = resultant(right);
        look(at_right, time);
      } else {
        high = right, right = left, at_right = at_left;
        left = high - golden * (high - low), at_left = resultant(left);
        look(at_left, time);
      }
    }
  }

 private:
  // At rest the resultant is the load.
  void rest(double time) noexcept {
    look(norm(segment_->duration > 0 ? segment_->load(time) : segment_->load_end), time);
  }
  void look(double resultant, double time) noexcept {
    if (!(resultant > forces_.peak)) return;
    forces_.peak = resultant;
    forces_.peak_time = begin_ + time;
  }

  const PlanarSlider<Law>& slider_;
  const PlanarState& state_;
  PlanarForces& forces_;
  const PlanarLoadSegment* segment_ = nullptr;
  double begin_ = 0;
  bool departs_ = false;
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
  const std::size_t samples = response.displacement.size();
  const std::vector<double> along = detail::acting(motion, motion.acceleration(), samples),
                            up = detail::acting(motion, motion.vertical(), samples),
                            across = detail::acting(motion, motion.transverse(), samples);
  PlanarForces result;
  if (slider.slope() > 0) result.downhill = standard_gravity * std::sin(slider.slope());
  const detail::Slope slope(slider.slope());
  const detail::PlanarPieces pieces(motion, slider.slope());
  const double end = response.events.back().time;
  PlanarState state = detail::start_of(response);
  detail::PeakForce<Law> peak(slider, state, result);
  const auto go = [&](double from, double to) {
    bool departs = false;
    detail::between(pieces, motion, slider.slope(), from, to, [&](double begin, const PlanarLoadSegment& segment) {
      peak.begin(begin, segment);
      detail::advance_plane(slider, segment, response.contact, state, peak);
      peak.end();
      departs = departs || (peak.departs() && detail::equal(begin, from));
    });
    if (!(to < end)) state = response.state;
    return departs;
  };
  for (std::size_t i = 0; i < samples; ++i) {
    PlanarState here = state;
    const double time = motion.time(i), next = i + 1 < samples ? std::min(motion.time(i + 1), end) : end;
    if (time < next && go(time, next)) here.mode = PlanarMode::sliding;
    const PlanarSegment ground{0, {along[i], across[i]}, {along[i], across[i]}};
    const PlanarLoadSegment load = detail::load_segment(ground, slope, up[i], up[i]);
    const detail::PlanarForce force = detail::force_on(slider, here, load.load_start, load.normal_start);
    const auto positive = [](Vector2 v) { return v + Vector2{0.0, 0.0}; };  // no minus zero
    result.friction.push_back(positive(force.friction));
    result.damper.push_back(positive(force.damper));
    result.spring.push_back(positive(force.spring));
    result.normal.push_back(force.normal);
    result.stuck.push_back(here.mode == PlanarMode::stuck);
  }
  return result;
}

}  // namespace stickslip
