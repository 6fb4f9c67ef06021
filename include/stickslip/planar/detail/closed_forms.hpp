// Slips in the plane that have a closed form.
#pragma once

#include <cmath>

#include "stickslip/base/equal.hpp"
#include "stickslip/base/min_max.hpp"
#include "stickslip/base/vector2.hpp"
#include "stickslip/flow/closed_form.hpp"
#include "stickslip/friction/law.hpp"
#include "stickslip/planar/detail/closing_slip.hpp"
#include "stickslip/planar/detail/held_slip.hpp"
#include "stickslip/planar/detail/level_along.hpp"
#include "stickslip/planar/path.hpp"

namespace stickslip::detail {

/// The speed aside of a collinear motion is round-off of its largest speed, about sqrt((w a + Q) |r|).
inline bool is_collinear(const PlanarPath& path, double across, double speed, double force) noexcept {
  return std::abs(across) <= std::max(0x1p-46 * speed, 0x1p-52 * std::sqrt(force * norm(path.place)));
}

/// The rate at which the level changes at a given speed [m/s^3].
template <class Law>
double change_in_time([[maybe_unused]] const PlanarPath& path, [[maybe_unused]] const Law& law,
                      [[maybe_unused]] double speed, [[maybe_unused]] double now) noexcept {
  if constexpr (heated_step<Law>)
    return std::max(std::abs(law.resist_at(path.duration, speed) - now) - 1e-8 * now, 0.0) /
           path.duration;  // known to 1e-8
  else
    return 0;
}

/// The rate at which the level changes along the path [1/s^2].
template <class Law>
double memory_slope([[maybe_unused]] const Law& law) noexcept {
  if constexpr (form_of<Law> == Form::linear)
    return std::abs(law.slope(Direction::forward));
  else
    return 0;
}

/// Close a stop, or a collinear reversal, with the constant load of now, if it comes before the load changes.
template <class Law>
bool close(PlanarPath& path, const Law& law) noexcept {
  const PlanarLoad& p = path.load;
  const double speed = norm(path.velocity);
  const double a = level_along(law, 0.0, speed, 0.0), level = p.weight * a + path.damping * speed;
  const Vector2 q = p.start - path.pull();
  const double load = norm(q);
  const Vector2 to = load > 0 ? (1 / load) * q : (1 / speed) * path.velocity;
  const double along = dot(path.velocity, to), across = cross(to, path.velocity);
  // u + v_q and u - v_q, without cancellation.
  const double plus = along < 0 ? across * across / (speed - along) : speed + along;
  const double minus = along < 0 ? speed - along : across * across / (speed + along);
  const bool turns = !(load < level);
  if (turns && !(along < 0 && is_collinear(path, across, speed, level + load))) return false;
  const double time = turns ? minus / (2 * (level + load)) : (plus / (level - load) + minus / (level + load)) / 2;
  if (!(time <= path.duration)) return false;
  const double slower = level_along(law, 0.0, speed / 2, 0.0);
  const double changes = norm(p.rate) + path.spring.stiffness * (speed + std::abs(p.weight_rate) * norm(path.place)) +
                         std::abs(p.weight_rate) * a +
                         (2 * p.weight * std::abs(slower - a) / speed + path.damping) * (level + load) +
                         p.weight * (memory_slope(law) * speed + change_in_time(path, law, speed, a));
  // A constant load misplaces the stop by up to 0.2 S T^3, and its time by S T^2 / (2 (w a - Q)), which matters where
  // the motion goes on.
  const double far = norm(path.place),
               closest = 0x1p-56 * far + 0x1p-64 * (level + load) * path.duration * path.duration;
  if (changes * time * time * (turns ? time + std::sqrt(far / (level + load)) : time) > closest) return false;
  if (turns) {
    const double sideways = std::abs(cross(to, p.rate)) + path.spring.stiffness * std::abs(cross(to, path.velocity));
    if (sideways * time > 0x1p-44 * (level + load)) return false;
  } else if (changes * time > (level - load) / 4) {
    return false;
  }
  const ClosingSlip closing{to, level, load, turns ? 0 : plus, minus, across};
  const PlanarProgress whole = closing.to_stop(1);
  // So close that neither a stop nor a largest displacement can be missed on the way.
  if (whole.distance > 0x1p-26 * far + 0x1p-40 * (level + load) * path.duration * path.duration) return false;
  path.closing = closing;
  path.kind = PlanarPath::Kind::stop;
  path.stops = true;
  // Along a line, round-off remains below a part of 1e-8 of the speed.
  path.turns = turns && std::abs(across) > 0x1p-23 * speed;
  // The mean level along the way, for the work: the speed falls linearly.
  path.level =
      (p.weight + p.weight_rate * time / 3) * level_along(law, whole.distance / 2, speed * (2.0 / 3), time / 3);
  path.last = 1;
  path.end = whole;
  path.end.velocity = {};
  return true;
}

/// A slip under a constant load and a constant level has a closed form. A collinear one ends where it reverses.
template <class Law>
bool hold_load([[maybe_unused]] PlanarPath& path, [[maybe_unused]] const Law& law) noexcept {
  if constexpr (form_of<Law> == Form::constant) {
    const PlanarLoad& p = path.load;
    const bool constant = equal(path.spring.stiffness, 0) && equal(path.damping, 0) && !(path.gap < never) &&
                          equal(p.rate.axis, 0) && equal(p.rate.transverse, 0) && equal(p.weight_rate, 0);
    if (!constant) return false;
    path.level = p.weight * level_along(law, 0.0, 0.0, 0.0);
    const double load = norm(p.start), speed = norm(path.velocity);
    if (!(path.level > 0 || load > 0)) return false;
    const Vector2 to = load > 0 ? (1 / load) * p.start : (1 / speed) * path.velocity;
    const double along = dot(path.velocity, to), across = cross(to, path.velocity);
    const bool reverses = along < 0 && is_collinear(path, across, speed, path.level + load);
    const double plus = reverses ? 0 : along < 0 ? across * across / (speed - along) : speed + along;
    const double minus = along < 0 ? speed - along : across * across / (speed + along);
    path.held = HeldSlip(to, path.level, load, plus, minus, across);
    path.kind = PlanarPath::Kind::held;
    path.constant_level = true;
    path.last = path.held.parameter(path.duration);
    path.end = path.held.at(path.last);
    if (std::abs(path.end.time - path.duration) <= 0x1p-40 * path.duration) path.end.time = path.duration;
    return true;
  }
  return false;
}

}  // namespace stickslip::detail
