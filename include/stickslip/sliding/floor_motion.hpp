// The absolute acceleration of the sliding mass.
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "stickslip/base/equal.hpp"
#include "stickslip/base/min_max.hpp"
#include "stickslip/error.hpp"
#include "stickslip/flow/damped.hpp"
#include "stickslip/friction/law.hpp"
#include "stickslip/ground/motion.hpp"
#include "stickslip/ground/response_spectrum.hpp"
#include "stickslip/ground/segment.hpp"
#include "stickslip/slider.hpp"
#include "stickslip/sliding/advance.hpp"
#include "stickslip/sliding/detail/contact.hpp"
#include "stickslip/sliding/detail/load.hpp"
#include "stickslip/sliding/detail/load_history.hpp"
#include "stickslip/sliding/detail/run.hpp"
#include "stickslip/sliding/forces.hpp"
#include "stickslip/sliding/observer.hpp"
#include "stickslip/sliding/response.hpp"
#include "stickslip/state.hpp"
#include "stickslip/units.hpp"

namespace stickslip {
namespace detail {

/// Load and normal force in each step of a ground motion, and after its end.
class GroundSteps {
 public:
  GroundSteps(const GroundMotion& motion, double slope) : motion_(motion), pieces_(motion, slope), slope_(slope) {}

  double duration(std::size_t i) const { return step(i).duration; }
  /// @param fraction  of the step
  Load at(std::size_t i, double /*time*/, double fraction) const {
    const LoadSegment s = step(i);
    return {std::lerp(s.load_start, s.load_end, fraction), std::lerp(s.normal_start, s.normal_end, fraction)};
  }

 private:
  LoadSegment step(std::size_t i) const {
    return i < motion_.segments() ? pieces_.segment(i)
                                  : load_segment(Segment{motion_.time(i + 1) - motion_.time(i), 0, 0}, slope_);
  }

  const GroundMotion& motion_;
  LoadPieces pieces_;
  Slope slope_;
};

/// The same of a harmonic motion, on level ground.
class HarmonicSteps {
 public:
  HarmonicSteps(const HarmonicMotion& motion, double /*slope*/) : motion_(motion) {}

  double duration(std::size_t i) const { return motion_.time(i + 1) - motion_.time(i); }
  Load at(std::size_t i, double time, double /*fraction*/) const {
    return {i < motion_.segments() ? -motion_.acceleration(time) : 0, standard_gravity};
  }

 private:
  const HarmonicMotion& motion_;
};

template <Motion M>
using StepsOf = std::conditional_t<std::same_as<M, GroundMotion>, GroundSteps, HarmonicSteps>;

/// Contact of a slider with the ground between two events.
enum class Touch { sticks, slides, flies };

/// The motion between two consecutive samples or events, without a stop or reversal between them.
template <FrictionLaw Law, Motion M>
class FloorPiece {
 public:
  FloorPiece(const Slider<Law>& slider, const M& motion, const StepsOf<M>& steps, std::size_t step, double duration,
             const Event& from, const Event& to, Touch touch, double slid, const SurfaceHeat& heat)
      : slider_(slider),
        motion_(motion),
        steps_(steps),
        step_(step),
        duration_(duration),
        from_(from),
        to_(to),
        touch_(touch),
        slid_(slid),
        half_integral_(heat.half_integral()) {
    begin_ = motion.time(step);
    whole_ = steps.duration(step);
    downhill_ = slider.slope() > 0 ? standard_gravity * std::sin(slider.slope()) : 0;
    load_[0] = load(0);
    load_[1] = load(1);
    if (touch == Touch::sticks) return;
    const double moved = to.displacement - from.displacement, speed = from.velocity + to.velocity;
    const double way = !equal(moved, 0)   ? moved
                       : !equal(speed, 0) ? speed
                                          : load_[0].load - pull(from.displacement, weight(load_[0]));
    direction_ = way < 0 ? Direction::backward : Direction::forward;
    a_[0] = load_[0].load - opposes(from.displacement, from.velocity, load_[0]);
    a_[1] = load_[1].load - opposes(to.displacement, to.velocity, load_[1]);
  }

  double duration() const { return duration_; }
  Direction direction() const { return direction_; }
  /// Load and normal force at both ends.
  const Load& first() const { return load_[0]; }
  const Load& last() const { return load_[1]; }

  /// Whether the acceleration is linear in time.
  bool straight() const {
    if (touch_ == Touch::sticks) return std::same_as<M, GroundMotion>;
    return ConstantLevelLaw<Law> && equal(slider_.stiffness(), 0) && equal(slider_.damping(), 0);
  }

  /// Absolute acceleration after a fraction of the duration [m/s^2].
  double acceleration(double s) const {
    const Load now = load(s);
    if (touch_ == Touch::sticks) return downhill_ - now.load;
    if (equal(s, 0)) return absolute(from_.displacement, from_.velocity, now);
    if (equal(s, 1)) return absolute(to_.displacement, to_.velocity, now);
    const double h = duration_, t = s * h;
    if constexpr (ConstantLevelLaw<Law> && std::same_as<M, GroundMotion>)
      if (!slider_.mounting().pendulum || equal(weight(load_[0]), weight(load_[1]))) {  // closed form
        const double wn = slider_.natural_frequency();
        const DampedBasis b(slider_.damping(), slider_.mounting().pendulum ? wn * std::sqrt(weight(load_[0])) : wn, t);
        const double q = a_[0] + slider_.damping() * from_.velocity;
        const double slope = (net(load_[1]) - net(load_[0])) / h, u = from_.velocity;
        return absolute(from_.displacement + b.distance(u, q, slope), b.velocity(u, q, slope), now);
      }
    // the polynomial of degree 5 with the x, x' and x'' of both ends
    const double r = 1 - s, gone = to_.displacement - from_.displacement;
    const double x = from_.displacement + s * s * s * (10 - 15 * s + 6 * s * s) * gone +
                     h * (s * r * r * r * (1 + 3 * s) * from_.velocity - r * s * s * s * (1 + 3 * r) * to_.velocity) +
                     h * h / 2 * (s * s * r * r * r * a_[0] + r * r * s * s * s * a_[1]);
    const double v = 30 * s * s * r * r * gone / h +
                     (1 - 18 * s * s + 32 * s * s * s - 15 * s * s * s * s) * from_.velocity +
                     (1 - 18 * r * r + 32 * r * r * r - 15 * r * r * r * r) * to_.velocity +
                     h / 2 * (s * r * r * (2 - 5 * s) * a_[0] - r * s * s * (2 - 5 * r) * a_[1]);
    return absolute(x, v, now);
  }

  /// Distances of the acceleration from its chord at three times [m/s^2].
  double sag() const {
    double sag = 0;
    for (const double s : {0.25, 0.5, 0.75})
      sag = std::max(sag, std::abs(acceleration(s) - std::lerp(acceleration(0), acceleration(1), s)));
    return sag;
  }

 private:
  Load load(double s) const {
    const double time = std::lerp(from_.time, to_.time, s);
    const double fraction = equal(s, 0) && equal(from_.time, begin_)                  ? 0
                            : equal(s, 1) && equal(to_.time, motion_.time(step_ + 1)) ? 1
                                                                                      : (time - begin_) / whole_;
    return steps_.at(step_, time, fraction);
  }

  /// N+ / g, by which friction is multiplied.
  double weight(const Load& now) const {
    return touch_ == Touch::flies ? 0 : std::max(now.normal, 0.0) / standard_gravity;
  }
  double pull(double x, double weight) const {
    return slider_.stiffness() * (slider_.mounting().pendulum ? weight : 1) * x;
  }
  double friction(double x, double v, double weight) const {
    const double way = slid_ + std::abs(x - from_.displacement);
    State there{.displacement = x, .sliding_distance = way};
    if constexpr (HeatedLaw<Law>) there.heat = SurfaceHeat::with(half_integral_);
    const double level = resist(law_at(slider_.law(), there, weight), x, std::abs(v), direction_);
    return sign(direction_) * weigh(weight, level);
  }
  /// Friction, damper and spring.
  double opposes(double x, double v, const Load& now) const {
    const double w = weight(now);
    return friction(x, v, w) + slider_.damping() * v + pull(x, w);
  }
  double absolute(double x, double v, const Load& now) const { return downhill_ - opposes(x, v, now); }
  /// The load less friction under a constant level.
  double net(const Load& now) const { return now.load - friction(from_.displacement, 0, weight(now)); }

  const Slider<Law>& slider_;
  const M& motion_;
  const StepsOf<M>& steps_;
  std::size_t step_;
  double duration_;
  Event from_, to_;
  Touch touch_;
  double slid_;           // up to its beginning [m]
  double half_integral_;  // of the heat at its middle
  Direction direction_ = Direction::forward;
  double begin_ = 0, whole_ = 0, downhill_ = 0;
  Load load_[2] = {};
  double a_[2] = {};  // x'' at both ends
};

/// The speed at which a slider that has left the ground lands, the integral of N over its flight [m/s].
template <Motion M>
double landing_speed(const StepsOf<M>& steps, const M& motion, std::size_t step, double from, double to) {
  double speed = 0;
  for (std::size_t i = step + 1; i-- > 0;) {
    const double first = motion.time(i), begin = std::max(first, from), end = std::min(first + steps.duration(i), to);
    const auto normal = [&](double time) { return steps.at(i, time, (time - first) / steps.duration(i)).normal; };
    if (begin < end) speed += (end - begin) * (normal(begin) + normal(end)) / 2;
    if (!(first > from)) break;
  }
  return std::max(speed, 0.0);
}

}  // namespace detail

/// The absolute acceleration of the mass along x: segments, and impulses at impacts.
struct FloorMotion {
  std::vector<Segment> segments;  ///< consecutive, accelerations [m/s^2]
  std::vector<Impulse> impulses;  ///< jumps of the velocity between them, in order
};

/// The absolute acceleration of the mass along x, g sin(slope) - (friction + damper + spring); on level ground x'' + n.
/// It is the input to equipment on a sliding floor; its `response_spectrum` is the floor spectrum.
///
/// It jumps at the start of a slip, at a reversal, at a stop of a slip, at a lift-off and at a landing; a segment ends
/// there. While the slider sticks it equals the ground acceleration along x, and while it slides under a constant level
/// without spring and damper it is linear in time; both are exact. Otherwise each time step is divided into the number
/// of equal segments that keeps their chords within `tolerance`. An impact on a stop, and the friction impulse of a
/// landing, change the velocity at once: they are impulses.
///
/// @param slider     the slider
/// @param motion     its ground motion
/// @param response   the result of `integrate` for them; not truncated
/// @param tolerance  maximum error of a chord, as a fraction of the largest absolute acceleration, from 1e-10 to 1
/// @return from the first to the last sample of the response. Use `settle`, otherwise the floor stops together with the
///         ground motion
/// @throws std::invalid_argument  a tolerance out of range, a truncated response, a response to another motion
/// Accuracy: `tolerance`; round-off for constant levels without spring and damper. With them the curve
/// that is divided is exact; under laws with a variable level, under a HarmonicMotion, and for a pendulum under a
/// normal force that varies, it is a polynomial of degree 5 between samples and events, with an error that decreases
/// with the sixth power of the time step (for a law that depends on the temperature, evaluated at the middle of each
/// interval, with the first power). An error e of the absolute acceleration changes a pseudo-acceleration of damping
/// ratio z by at most e coth(pi z / (2 sqrt(1 - z^2))): 12.7 e at 5 %. Cost: one pass over samples and events, and
/// about 30 ns per segment.
template <FrictionLaw Law, Motion M>
FloorMotion floor_motion(const Slider<Law>& slider, const M& motion, const Response& response,
                         double tolerance = 1e-6) {
  detail::require(tolerance >= 1e-10 && tolerance <= 1, "floor_motion: tolerance must be from 1e-10 to 1", tolerance);
  if (response.truncated)
    throw std::invalid_argument(
        "floor motion: the samples of the response must reach the final rest, but they are truncated; extend the "
        "ground motion by zeros");
  const std::size_t samples = response.displacement.size();
  if (samples < motion.samples() || response.events.empty())
    throw std::invalid_argument("floor_motion: the response must be that to the motion of " +
                                std::to_string(motion.samples()) + " samples, got " + std::to_string(samples));

  using detail::Touch;
  const detail::StepsOf<M> steps(motion, slider.slope());
  std::vector<detail::FloorPiece<Law, M>> pieces;
  pieces.reserve(samples + response.events.size());
  std::vector<std::pair<std::size_t, double>> jumps;  // of the velocity, before a piece
  const std::vector<Event>& events = response.events;
  std::size_t next = 0;  // the next event, or the end
  bool sticks = true;
  double flies_since = never;  // time of the last lift-off, in flight
  detail::SlidAlong slid(response);
  const auto sample = [&](std::size_t i) {
    return Event{motion.time(i), response.displacement[i], response.velocity[i], EventKind::end};
  };
  const auto at_hand = [&](double time) { return events[next].kind != EventKind::end && events[next].time <= time; };
  const auto state_at = [&](const Event& at, double way, Direction direction) {
    State state{at.displacement, at.velocity, mode_of(direction)};
    state.sliding_distance = way;
    state.heat = detail::heat_at(slider.law(), motion, response, at.time);
    return state;
  };
  for (std::size_t i = 0; i + 1 < samples; ++i) {
    Event from = sample(i);
    const Event last = sample(i + 1);
    const double whole = steps.duration(i);
    const auto add = [&](const Event& to) {
      // A slider that a stop has caught waits there until the next event.
      const bool waits = from.kind == EventKind::impact && detail::equal(from.velocity, 0);
      const Touch touch = sticks || waits ? Touch::sticks : flies_since < never ? Touch::flies : Touch::slides;
      const double duration =
          detail::equal(from.time, motion.time(i)) && detail::equal(to.time, last.time) ? whole : to.time - from.time;
      const double way = slid.to(from.displacement).sliding_distance;
      const auto piece = [&](const Event& begin, const Event& end, double lasts) {
        pieces.emplace_back(slider, motion, steps, i, lasts, begin, end, touch,
                            way + std::abs(begin.displacement - from.displacement),
                            detail::heat_at(slider.law(), motion, response, begin.time + lasts / 2));
      };
      if (duration > 0) {
        piece(from, to, duration);
        if constexpr (std::same_as<M, GroundMotion>) {
          const detail::Load first = pieces.back().first(), end = pieces.back().last();
          const double part = first.normal / (first.normal - end.normal), lasts = part * duration;
          const bool crosses = first.normal * end.normal < 0 && lasts > 0 && lasts < duration;
          if (touch == Touch::slides && response.contact == Contact::clipped && crosses) {  // a kink of the friction
            State state = state_at(from, way, pieces.back().direction());
            const LoadSegment before{lasts, first.load, std::lerp(first.load, end.load, part), first.normal, 0};
            advance(slider, before, state, NoObserver(), Contact::clipped);
            const Event middle{from.time + lasts, state.displacement, state.velocity, EventKind::end};
            pieces.pop_back();
            piece(from, middle, lasts);
            piece(middle, to, duration - lasts);
          }
        }
      }
      from = to;
    };
    // Takes an event; from then on `from` has the velocity just after it.
    const auto take = [&] {
      const Event& e = events[next++];
      if (e.kind == EventKind::breakaway || e.kind == EventKind::reversal) sticks = false;
      if (e.kind == EventKind::arrest) sticks = true;
      if (e.kind == EventKind::liftoff) flies_since = e.time;
      if (e.kind == EventKind::impact) {
        const Event& then = at_hand(last.time) ? events[next] : last;
        const bool caught = detail::equal(then.displacement, e.displacement) && then.kind != EventKind::impact &&
                            detail::equal(then.velocity, 0);
        from.velocity = caught ? 0 : -slider.mounting().stops.restitution() * e.velocity;
      }
      if (e.kind == EventKind::landing) {
        if (!sticks && !detail::equal(e.velocity, 0)) {
          const Direction direction = e.velocity < 0 ? Direction::backward : Direction::forward;
          const State state = state_at(e, slid.to(e.displacement).sliding_distance, direction);
          from.velocity =
              sign(direction) * detail::after_impulse(law_at(slider.law(), state), e.displacement, direction,
                                                      std::abs(e.velocity),
                                                      detail::landing_speed(steps, motion, i, flies_since, e.time));
        }
        flies_since = never;
      }
      if (!detail::equal(from.velocity, e.velocity)) jumps.emplace_back(pieces.size(), from.velocity - e.velocity);
    };
    while (at_hand(from.time)) {
      from = events[next];
      take();
    }
    while (at_hand(last.time)) {
      add(events[next]);
      take();
    }
    add(last);
  }

  double largest = 0, sag = 0;
  for (const auto& piece : pieces) {
    largest = std::max({largest, std::abs(piece.acceleration(0)), std::abs(piece.acceleration(1))});
    if (!piece.straight()) sag = std::max(sag, piece.sag());
  }
  // Halving a chord divides its error by four. All parts of a step have the same duration.
  const double parts = largest > 0 ? std::ceil(std::sqrt(4.0 / 3 * sag / (tolerance * largest))) : 1;
  FloorMotion result;
  auto jump = jumps.begin();
  for (std::size_t i = 0; i <= pieces.size(); ++i) {
    for (; jump != jumps.end() && jump->first == i; ++jump)
      result.impulses.push_back({result.segments.size(), jump->second});
    if (i == pieces.size()) break;
    const auto& piece = pieces[i];
    const double count = piece.straight() ? 1 : std::clamp(parts, 1.0, 1e5);
    double start = piece.acceleration(0);
    for (double k = 1; k <= count; ++k) {
      const double end = piece.acceleration(k / count);
      result.segments.push_back({piece.duration() / count, start, end});
      start = end;
    }
  }
  return result;
}

template <FrictionLaw Law, Motion M>
FloorMotion floor_motion(const Law& law, const M& motion, const Response& response, double tolerance = 1e-6) {
  return floor_motion(Slider<Law>(law), motion, response, tolerance);
}

}  // namespace stickslip
