// Margins of the decisions in a response in the plane: stick or slip, impact or not.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "stickslip/base/equal.hpp"
#include "stickslip/base/min_max.hpp"
#include "stickslip/base/units.hpp"
#include "stickslip/base/vector2.hpp"
#include "stickslip/ground/ground_motion.hpp"
#include "stickslip/planar/integrate.hpp"
#include "stickslip/planar/response.hpp"
#include "stickslip/planar/segment.hpp"
#include "stickslip/planar/slider.hpp"
#include "stickslip/planar/state.hpp"
#include "stickslip/planar/trajectory.hpp"
#include "stickslip/sliding/margins.hpp"

namespace stickslip {
namespace detail {

/// Reads the margins of a motion in the plane.
class PlanarMarginReader final : public PlanarTrajectoryReader {
 public:
  /// @param state  that of the motion, which is followed
  PlanarMarginReader(const PlanarEngine& engine, const PlanarState& state)
      : engine_(engine),
        mounting_(engine.mounting()),
        state_(state),
        gap_(engine.mounting().stops.forward()),
        farthest_(norm(state.displacement)) {}

  Margins margins;

  void segment(double begin, const PlanarLoadSegment& segment) override {
    begin_ = begin;
    segment_ = segment;
    now_ = 0;
    std::erase_if(departures_, [&](Departed& one) {
      one.since = 0;
      return passes(one, 0);
    });
    if (rests()) approach(0);
  }
  void end_of_segment() override {
    const double duration = segment_.duration;
    std::erase_if(departures_, [&](Departed& one) {
      const double turns = turn(one.state);
      return (turns > one.since && turns < duration && passes(one, turns)) || passes(one, duration);
    });
    if (rests()) rest_until(duration);
  }
  /// The motion ends, with no ground acceleration after it.
  void finish() {
    segment_ = load_segment(PlanarSegment{0, {}, {}}, Slope(mounting_.slope()));
    for (Departed& one : departures_)
      if (!passes(one, 0)) count(one.least);
    if (rests()) leave();
    if (outward_) count_distance(gap_ - farthest_);
  }

  void event(EventKind kind, double time, const PlanarState& at) override {
    const bool at_once = last_ && kind_ != EventKind::reversal && equal(*last_, begin_ + time);
    switch (kind) {
      case EventKind::breakaway:
        if (at.velocity == Vector2{} && !at.in_flight) broke_away(at, time);
        break;
      case EventKind::reversal:
      case EventKind::arrest:
        if (!at.in_flight) ended(at, time, at_once);
        break;
      case EventKind::impact:
        hit(at, time);
        break;
      default:
        break;
    }
    if (kind == EventKind::liftoff || kind == EventKind::landing) return;
    last_left_ = infinite;
    falls_ = true;
    arrives_.reset();
    now_ = time;
    if (kind == EventKind::arrest && !at.in_flight) approach(time);
    last_ = begin_ + time;
    kind_ = kind;
  }

  void arc(const PlanarArc& arc) override {
    // Just before a stop, where the velocity still has a direction.
    arrives_ = arc.at(arc.last * (1 - 0x1p-20)).velocity;
    if (!(gap_ < never)) return;
    if (state_.mode == PlanarMode::along_stop) return arrive_at_stop();
    move_to(norm(arc.place));
    double where = arc.last;
    const double largest = arc.largest_radius(where);
    if (where < arc.last) move_to(largest);
    move_to(norm(arc.place + arc.at(arc.last).way));
  }

 private:
  static constexpr double infinite = std::numeric_limits<double>::infinity();

  /// A slider that broke away, as if it still rested.
  struct Departed {
    PlanarState state;
    double since;             // of the present segment [s]
    double least = infinite;  // unused part of the level
  };

  bool rests() const noexcept { return state_.mode == PlanarMode::stuck && !state_.in_flight; }

  // At its end the segment states what the next one begins with: by a line between its ends the load would differ by
  // round-off, and a load that grows across the end would seem to have a maximum there.
  double weight(double time) const noexcept {
    const double normal = time < segment_.duration ? segment_.normal(time) : segment_.normal_end;
    return std::max(normal, 0.0) / standard_gravity;
  }
  /// The load without friction at a place; where a stop holds the slider, the component along the stop.
  Vector2 net(Vector2 place, double time, double weight, bool pressed = true) const noexcept {
    const Vector2 load = time < segment_.duration ? segment_.load(time) : segment_.load_end;
    const Vector2 q = load - mounting_.spring().under(weight) * place;
    const double from = norm(place);
    if (!pressed || !(from >= gap_ * (1 - 0x1p-48))) return q;
    const Vector2 outward = (1 / from) * place;
    return q - std::max(dot(q, outward), 0.0) * outward;
  }
  /// The unused part of a level, relative to it; infinite if it decides nothing.
  static double left_of(double level, double weight, double load) noexcept {
    const double weighed = level < infinite ? level * weight : infinite;
    return weighed > 0 && weighed < infinite ? 1 - load / weighed : infinite;
  }
  double held(const PlanarState& at, double time) const {
    const double w = weight(time);
    return left_of(engine_.hold(at, w), w, norm(net(at.displacement, time, w)));
  }

  /// The time at which the load divided by the level is least on a line; between the ends of a segment there is no
  /// other extremum of it.
  double turn(const PlanarState& at) const noexcept {
    if (segment_.normal_start < 0 || segment_.normal_end < 0 || !(segment_.duration > 0)) return never;
    const double w = weight(0), gains = weight(segment_.duration) - w;
    const Vector2 q = net(at.displacement, 0, w), change = net(at.displacement, segment_.duration, w + gains) - q;
    const double growth = dot(q, change), square = dot(q, q);
    return segment_.duration * (square * gains - growth * w) / (dot(change, change) * w - growth * gains);
  }

  void count(double left) noexcept { margins.load = std::min(margins.load, std::abs(left)); }
  void count_distance(double distance) noexcept {
    if (gap_ < never) margins.impact = std::min(margins.impact, std::abs(distance) / gap_);
  }

  /// During a rest: the maxima of load / level.
  void approach(double time) {
    const double left = held(state_, time);
    if (left > last_left_ && falls_) count(last_left_);
    if (!equal(left, last_left_)) falls_ = left < last_left_;
    last_left_ = left;
    now_ = time;
  }
  void rest_until(double time) {
    const double turns = turn(state_);
    if (turns > now_ && turns < time) approach(turns);
    approach(time);
  }
  /// The rest ends with the motion: the final approach counts.
  void leave() {
    if (falls_) count(last_left_);
  }

  void broke_away(const PlanarState& at, double time) {
    const double turns = turn(at);
    if (turns > now_ && turns < time) approach(turns);
    Departed one{at, time};
    one.state.mode = PlanarMode::stuck;
    if (!passes(one, time)) departures_.push_back(one);
  }
  /// Whether the load of a slider that broke away passes its maximum.
  bool passes(Departed& one, double time) {
    // Where the normal force vanishes, the load exceeds the level by infinitely many times the level.
    const double w = weight(time);
    const bool light = !(w > 0) && norm(net(one.state.displacement, time, w)) > 0;
    const double left = light ? -infinite : held(one.state, time);
    if (left <= one.least) {
      one.least = left;
      return false;
    }
    count(one.least);
    return true;
  }

  /// A slip ended, in a reversal or a stop.
  /// @param forced  whether a stop or a landing brought the velocity to zero
  void ended(const PlanarState& at, double time, bool forced) {
    count(held(at, time));
    if (!forced && arrives_) {
      const double w = weight(time);
      const Vector2 q = net(at.displacement, time, w);
      const double level = engine_.resist(at, w, 0);
      // The velocity turns into the load before it vanishes, unless it is exactly opposite.
      const double size = norm(q), forward = dot(q, *arrives_);
      const bool opposite = forward <= -(1 - 0x1p-20) * size * norm(*arrives_);
      count(left_of(level, w, opposite ? -size : size));
    }
    if (outward_) count_distance(gap_ - farthest_);
    outward_ = false;
  }

  /// The distance from the origin on the way: its maxima are approaches to a stop.
  void move_to(double radius) noexcept {
    if (!(radius < gap_ * (1 - 0x1p-46))) return arrive_at_stop();  // where it may also begin
    if (radius < farthest_ && outward_) count_distance(gap_ - farthest_);
    if (!equal(radius, farthest_)) outward_ = radius > farthest_;
    farthest_ = radius;
  }

  void arrive_at_stop() noexcept {
    farthest_ = gap_;
    outward_ = false;
  }

  void hit(const PlanarState& at, double time) {
    arrive_at_stop();
    const double from = norm(at.displacement), speed = norm(at.velocity), w = weight(time);
    const Vector2 outward = (1 / from) * at.displacement;
    const double radial = dot(at.velocity, outward), aside = cross(outward, at.velocity);
    if (!(radial > 0)) return;
    const double level = at.in_flight ? 0 : w * engine_.resist(at, w, speed);
    const double slows =
        level * radial / speed - dot(net(at.displacement, time, w, false), outward) - aside * aside / from;
    if (slows > 0) count_distance(radial * radial / (2 * slows));
  }

  const PlanarEngine& engine_;
  const Mounting& mounting_;
  const PlanarState& state_;
  double gap_;
  PlanarLoadSegment segment_{};
  double begin_ = 0, now_ = 0;  // of the segment [s], and within it
  double last_left_ = infinite;
  bool falls_ = true;                 // the unused part of the level, during a rest
  std::vector<Departed> departures_;  // whose loads still grow
  std::optional<Vector2> arrives_;    // velocity at the end of the flows since the last event
  std::optional<double> last_;        // time of the last event [s]
  EventKind kind_{};                  // and its kind
  double farthest_;                   // last distance from the origin [m]
  bool outward_ = false;              // whether it grew
};

inline Margins margins(const PlanarEngine& engine, const GroundMotion& motion, const PlanarResponse& response) {
  PlanarState state = start_of(response);
  PlanarMarginReader reader(engine, state);
  trace(engine, motion, response, response.events.back().time, reader, state);
  reader.finish();
  return reader.margins;
}

}  // namespace detail

/// The margins of the closest decisions of a response in the plane: those of Margins, with the magnitude of the load
/// vector q = p - wn^2 r. At a stop only the load along the stop counts while it presses the slider against the stop.
/// For stops, the margins are the distances by which |r| stayed below the gap in its maxima, and the radial distances
/// v^2 / (2 d) by which a slider with the radial velocity v and the radial deceleration d would have gone on, relative
/// to the gap.
///
/// A velocity that turns without vanishing, however small it becomes, does not count, nor does a landing. Under loads
/// along one line the margins below 1 are those on one axis. Cost: about that of `integrate`.
template <IsotropicLaw Law>
Margins margins(const PlanarSlider<Law>& slider, const GroundMotion& motion, const PlanarResponse& response) {
  return detail::margins(detail::PlanarEngineOf(slider), motion, response);
}

}  // namespace stickslip
