// A cart as its motion sees it: wheels about the center of mass, and the lines along which they resist.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "carts/zonotope.hpp"
#include "stickslip/base/units.hpp"
#include "stickslip/carts/cart.hpp"
#include "stickslip/carts/state.hpp"
#include "stickslip/ground/ground_motion.hpp"

namespace stickslip::detail {

/// Directions are in the cart's frame. Velocities are y = (u, w, k phi'), u and w along the cart's own axes.
struct CartModel {
  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  struct Wheel {
    double lever_x, lever_y;    // from the center of mass, over k
    std::size_t caster;         // its number, or none
    double per_reach;           // [1/m]
    double cosine, sine;        // of a fixed wheel
    std::size_t across, along;  // its lines, or none
  };
  struct Line {
    std::size_t wheel;
    bool along;
    double coefficient;  // friction over the weight of the cart
  };

  struct Foot {
    std::size_t wheel;
    double coefficient;
  };

  explicit CartModel(const Cart& cart);

  std::vector<Wheel> wheels;  // of all supports
  std::vector<Line> lines;
  std::vector<Foot> feet;        // their modes follow those of the lines: 1 slides, 0 sticks
  std::vector<Vector2> outline;  // from the center of mass [m]
  std::size_t contacts() const noexcept { return lines.size() + feet.size(); }
  /// Of a line or, after them, of a foot.
  double coefficient(std::size_t contact) const noexcept {
    return contact < lines.size() ? lines[contact].coefficient : feet[contact - lines.size()].coefficient;
  }

  std::vector<double> headings;  // at the start, relative to the cart [rad]
  std::size_t casters;
  double gyration;  // k [m]
  double slow;      // a speed that is round-off [m/s]
  double halted;    // a speed from which a cart on feet stops at once: it would go 1e-20 m [m/s]
  double steady;    // speeds below are tried where events follow each other without time [m/s]

  CartState start() const {
    CartState state;
    state.headings = headings;
    return state;
  }
  Vector2 direction(const Wheel& wheel, const CartState& state) const noexcept {
    if (wheel.caster == none) return {wheel.cosine, wheel.sine};
    const double heading = state.headings[wheel.caster];
    return {std::cos(heading), std::sin(heading)};
  }
  Vector3 row(const Line& line, const CartState& state) const noexcept {
    const Wheel& wheel = wheels[line.wheel];
    const Vector2 e = direction(wheel, state);
    return row_of(wheel, line.along ? e : Vector2{-e.transverse, e.axis});
  }
  static Vector3 row_of(const Wheel& wheel, Vector2 d) noexcept {
    return {d.axis, d.transverse, wheel.lever_x * d.transverse - wheel.lever_y * d.axis};
  }
  Vector3 row_axis(const Foot& foot) const noexcept { return row_of(wheels[foot.wheel], {1, 0}); }
  Vector3 row_transverse(const Foot& foot) const noexcept { return row_of(wheels[foot.wheel], {0, 1}); }
  /// Velocity of a pivot in the cart's frame.
  static Vector2 pivot(const Wheel& wheel, const Vector3& y) noexcept {
    return {y[0] - y[2] * wheel.lever_y, y[1] + y[2] * wheel.lever_x};
  }
  Vector3 velocities(const CartState& state) const noexcept {
    const double c = std::cos(state.yaw), s = std::sin(state.yaw);
    const Vector2 v = state.velocity;
    return {c * v.axis + s * v.transverse, c * v.transverse - s * v.axis, gyration * state.yaw_rate};
  }
  void set_velocities(CartState& state, const Vector3& y) const noexcept {
    const double c = std::cos(state.yaw), s = std::sin(state.yaw);
    state.velocity = {c * y[0] - s * y[1], s * y[0] + c * y[1]};
    state.yaw_rate = y[2] / gyration;
  }
};

/// The ground during a segment, linear in time [m/s^2].
struct CartSegment {
  double duration;
  Vector2 start, end;
  double heavy_start, heavy_end;  // g + a_z

  Vector2 ground(double t) const noexcept {
    if (!(duration > 0)) return start;
    const double part = t / duration;
    return (1 - part) * start + part * end;
  }
  double heavy(double t) const noexcept {
    return duration > 0 ? heavy_start + (heavy_end - heavy_start) * (t / duration) : heavy_start;
  }
  /// When the ground falls away as fast as the cart, or comes back; `duration` if not within.
  double weightless() const noexcept {
    if ((heavy_start > 0) == (heavy_end > 0)) return duration;
    return duration * (heavy_start / (heavy_start - heavy_end));
  }
};

}  // namespace stickslip::detail
