// The absolute acceleration of the sliding mass.
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

#include "stickslip/detail/equal.hpp"
#include "stickslip/detail/min_max.hpp"
#include "stickslip/error.hpp"
#include "stickslip/flow/damped.hpp"
#include "stickslip/friction/law.hpp"
#include "stickslip/ground/motion.hpp"
#include "stickslip/slider.hpp"
#include "stickslip/sliding/forces.hpp"
#include "stickslip/sliding/response.hpp"
#include "stickslip/state.hpp"

namespace stickslip {
namespace detail {

/// The ground motion in step i, and after the end of the motion.
inline Segment ground_step(const GroundMotion& motion, std::size_t i) {
  return i < motion.segments() ? motion.segment(i) : Segment{motion.time(i + 1) - motion.time(i), 0, 0};
}
inline double ground_at(const GroundMotion& motion, std::size_t i, double /*time*/, double fraction) {
  const Segment s = ground_step(motion, i);
  return std::lerp(s.start, s.end, fraction);
}
inline Segment ground_step(const HarmonicMotion& motion, std::size_t i) {
  return {motion.time(i + 1) - motion.time(i), 0, 0};
}
inline double ground_at(const HarmonicMotion& motion, std::size_t i, double time, double /*fraction*/) {
  return i < motion.segments() ? motion.acceleration(time) : 0;
}

/// The motion between two consecutive samples or events, without a stop or reversal between them.
template <FrictionLaw Law, Motion M>
class FloorPiece {
 public:
  FloorPiece(const Slider<Law>& slider, const M& motion, std::size_t step, double duration, const Event& from,
             const Event& to, bool stuck, double slid, const SurfaceHeat& heat)
      : slider_(slider),
        motion_(motion),
        step_(step),
        duration_(duration),
        from_(from),
        to_(to),
        stuck_(stuck),
        slid_(slid),
        half_integral_(heat.half_integral()) {
    const Segment s = ground_step(motion, step);
    begin_ = motion.time(step);
    whole_ = s.duration;
    n_[0] = ground(0);
    n_[1] = ground(1);
    if (stuck) return;
    const double moved = to.displacement - from.displacement, speed = from.velocity + to.velocity;
    const double way = !equal(moved, 0)   ? moved
                       : !equal(speed, 0) ? speed
                                          : -n_[0] - slider.stiffness() * from.displacement;
    direction_ = way < 0 ? Direction::backward : Direction::forward;
    a_[0] = absolute(from.displacement, from.velocity) - n_[0];
    a_[1] = absolute(to.displacement, to.velocity) - n_[1];
  }

  double duration() const { return duration_; }

  /// Whether the acceleration is linear in time.
  bool straight() const {
    if (stuck_) return std::same_as<M, GroundMotion>;
    return ConstantLevelLaw<Law> && equal(slider_.stiffness(), 0) && equal(slider_.damping(), 0);
  }

  /// Absolute acceleration after a fraction of the duration [m/s^2].
  double acceleration(double s) const {
    if (stuck_) return ground(s);
    if (equal(s, 0)) return absolute(from_.displacement, from_.velocity);
    if (equal(s, 1)) return absolute(to_.displacement, to_.velocity);
    const double h = duration_, t = s * h;
    if constexpr (ConstantLevelLaw<Law> && std::same_as<M, GroundMotion>) {  // closed form
      const DampedBasis b(slider_.damping(), slider_.natural_frequency(), t);
      const double q = a_[0] + slider_.damping() * from_.velocity, slope = (n_[0] - n_[1]) / h;
      const double u = from_.velocity;
      return absolute(from_.displacement + b.distance(u, q, slope), b.velocity(u, q, slope));
    } else {  // the polynomial of degree 5 with the x, x' and x'' of both ends
      const double r = 1 - s, gone = to_.displacement - from_.displacement;
      const double x = from_.displacement + s * s * s * (10 - 15 * s + 6 * s * s) * gone +
                       h * (s * r * r * r * (1 + 3 * s) * from_.velocity - r * s * s * s * (1 + 3 * r) * to_.velocity) +
                       h * h / 2 * (s * s * r * r * r * a_[0] + r * r * s * s * s * a_[1]);
      const double v = 30 * s * s * r * r * gone / h +
                       (1 - 18 * s * s + 32 * s * s * s - 15 * s * s * s * s) * from_.velocity +
                       (1 - 18 * r * r + 32 * r * r * r - 15 * r * r * r * r) * to_.velocity +
                       h / 2 * (s * r * r * (2 - 5 * s) * a_[0] - r * s * s * (2 - 5 * r) * a_[1]);
      return absolute(x, v);
    }
  }

  /// Distances of the acceleration from its chord at three times [m/s^2].
  double sag() const {
    double sag = 0;
    for (const double s : {0.25, 0.5, 0.75})
      sag = std::max(sag, std::abs(acceleration(s) - std::lerp(acceleration(0), acceleration(1), s)));
    return sag;
  }

 private:
  double ground(double s) const {
    const double time = std::lerp(from_.time, to_.time, s);
    const double fraction = equal(s, 0) && equal(from_.time, begin_)                  ? 0
                            : equal(s, 1) && equal(to_.time, motion_.time(step_ + 1)) ? 1
                                                                                      : (time - begin_) / whole_;
    return ground_at(motion_, step_, time, fraction);
  }

  double absolute(double x, double v) const {
    const double way = slid_ + std::abs(x - from_.displacement);
    State there{.displacement = x, .sliding_distance = way};
    if constexpr (HeatedLaw<Law>) there.heat = SurfaceHeat::with(half_integral_);
    const auto& law = law_at(slider_.law(), there);
    const double force = sign(direction_) * resist(law, x, direction_, std::abs(v));
    return -(force + slider_.damping() * v + slider_.stiffness() * x);
  }

  const Slider<Law>& slider_;
  const M& motion_;
  std::size_t step_;
  double duration_;
  Event from_, to_;
  bool stuck_;
  double slid_;           // up to its beginning [m]
  double half_integral_;  // of the heat at its middle
  Direction direction_ = Direction::forward;
  double begin_ = 0, whole_ = 0;
  double n_[2] = {}, a_[2] = {};  // ground acceleration and x'' at both ends
};

}  // namespace detail

/// The absolute acceleration x'' + n of the mass, -(friction + damper + spring), in linear pieces. It is the input to
/// equipment on a sliding floor; its `response_spectrum` is the floor spectrum.
///
/// It jumps at the start of a slip, at a reversal and at a stop; a piece ends there. While the slider sticks it equals
/// the ground acceleration, and while it slides under a constant level without spring and damper it equals that level;
/// both are exact. Otherwise each time step is divided into the number of equal pieces that keeps their
/// chords within `tolerance`.
///
/// @param slider     the slider
/// @param motion     its ground motion
/// @param response   the result of `integrate` for them; not truncated
/// @param tolerance  maximum error of a chord, as a fraction of the largest absolute acceleration, from 1e-10 to 1
/// @return pieces [s], [m/s^2] from the first to the last sample of the response. Use `settle`, otherwise the floor
/// stops
///         together with the ground motion
/// @throws std::invalid_argument  a tolerance out of range, a truncated response, a response to another motion
/// Accuracy: `tolerance`; round-off for constant levels without spring and damper. With them the curve
/// that is divided is exact; under laws with a variable level, and under a HarmonicMotion, it is a polynomial of degree
/// 5 between samples and events, with an error that decreases with the sixth power of the time step (for a law that
/// depends on the temperature, evaluated at the middle of each interval, with the first power). An error e of the
/// absolute acceleration changes a pseudo-acceleration of damping ratio z by at most e coth(pi z / (2 sqrt(1 -
/// z^2))): 12.7 e at 5 %. Cost: one pass over samples and events, and about 30 ns per piece.
template <FrictionLaw Law, Motion M>
std::vector<Segment> floor_motion(const Slider<Law>& slider, const M& motion, const Response& response,
                                  double tolerance = 1e-6) {
  detail::require_plain_mounting(slider, "floor_motion");
  if constexpr (std::same_as<M, GroundMotion>)
    if (motion.has_vertical())
      throw std::invalid_argument("floor_motion: covers horizontal motion alone, got a vertical component");
  detail::require(tolerance >= 1e-10 && tolerance <= 1, "floor_motion: tolerance must be from 1e-10 to 1", tolerance);
  if (response.truncated) throw std::invalid_argument("floor_motion: the response must not be truncated");
  const std::size_t samples = response.displacement.size();
  if (samples < motion.samples() || response.events.empty())
    throw std::invalid_argument("floor_motion: the response must be that to the motion of " +
                                std::to_string(motion.samples()) + " samples, got " + std::to_string(samples));

  std::vector<detail::FloorPiece<Law, M>> pieces;
  pieces.reserve(samples + response.events.size());
  const std::vector<Event>& events = response.events;
  std::size_t next = 0;  // the next event, or the end
  detail::SlidAlong slid(response);
  const auto sample = [&](std::size_t i) {
    return Event{motion.time(i), response.displacement[i], response.velocity[i], EventKind::end};
  };
  const auto at_hand = [&](double time) { return events[next].kind != EventKind::end && events[next].time <= time; };
  for (std::size_t i = 0; i + 1 < samples; ++i) {
    Event from = sample(i);
    const Event last = sample(i + 1);
    const double whole = detail::ground_step(motion, i).duration;
    const auto add = [&](const Event& to) {
      const bool stuck = next == 0 || events[next - 1].kind == EventKind::arrest;
      const double duration =
          detail::equal(from.time, motion.time(i)) && detail::equal(to.time, last.time) ? whole : to.time - from.time;
      const double way = slid.to(from.displacement).sliding_distance;
      if (duration > 0)
        pieces.emplace_back(slider, motion, i, duration, from, to, stuck, way,
                            detail::heat_at(slider.law(), motion, response, from.time + duration / 2));
      from = to;
    };
    while (at_hand(from.time)) ++next;
    while (at_hand(last.time)) {
      add(events[next]);
      ++next;
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
  std::vector<Segment> result;
  for (const auto& piece : pieces) {
    const double count = piece.straight() ? 1 : std::clamp(parts, 1.0, 1e5);
    double start = piece.acceleration(0);
    for (double k = 1; k <= count; ++k) {
      const double end = piece.acceleration(k / count);
      result.push_back({piece.duration() / count, start, end});
      start = end;
    }
  }
  return result;
}

template <FrictionLaw Law, Motion M>
std::vector<Segment> floor_motion(const Law& law, const M& motion, const Response& response, double tolerance = 1e-6) {
  return floor_motion(Slider<Law>(law), motion, response, tolerance);
}

}  // namespace stickslip
