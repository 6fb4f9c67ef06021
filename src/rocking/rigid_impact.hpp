// Impacts of a rigid block on the ground.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "rocking/rigid_leg.hpp"
#include "stickslip/rocking/rocking_block.hpp"

namespace stickslip::detail {

/// Velocities of the center of mass and the rotation.
struct RigidVelocity {
  double x, y, w;  // [m/s], [m/s], [rad/s]
};

inline double kinetic_energy(const RockingBlock& block, const RigidVelocity& v) noexcept {
  return (v.x * v.x + v.y * v.y + block.gyration_square() * v.w * v.w) / 2;
}

/// After an impact.
struct RigidImpact {
  RigidVelocity after;
  double side;  // the corner on the ground, +1 or -1; 0: the base
  int slip;  // the direction in which it slips; 0 if it sticks. As found: computed again, round-off could say otherwise
  bool lever = false;  // whether the impulse acted within the base
  bool consistent = true;
};

/// One corner arrives: it stops, and sticks if the impulse lies within the cone of friction.
inline RigidImpact corner_impact(const RockingBlock& block, const RigidVelocity& v, double side,
                                 const Arm& r) noexcept {
  const double square = block.gyration_square(), mu = block.mu();
  const double across = v.x + v.w * r.y, down = v.y - v.w * r.x;  // of the corner
  if (!(down < 0))                                                // by round-off: it does not press
    return {v, side, !(mu < never) || equal(across, 0) ? 0 : across > 0 ? 1 : -1};
  const double nn = 1 + r.x * r.x / square, nt = -r.x * r.y / square, tt = 1 + r.y * r.y / square;
  const auto after = [&](double t, double n) {
    return RigidVelocity{v.x + t, v.y + n, v.w + (r.y * t - r.x * n) / square};
  };
  const double determinant = nn + tt - 1;  // nn tt - nt^2
  const double t = (nt * down - nn * across) / determinant, n = (nt * across - tt * down) / determinant;
  if (!(mu < never) || std::abs(t) <= mu * n) return {after(t, n), side, 0};
  RigidImpact found{v, side, 0, false, false};
  for (const int s : {t > 0 ? -1 : 1, t > 0 ? 1 : -1}) {
    const double weight = nn - s * mu * nt, push = -down / weight;
    if (!(weight > 0 && push >= 0) || s * (across + (nt - s * mu * tt) * push) < 0) continue;
    return {after(-s * mu * push, push), side, s};
  }
  return found;
}

/// Both corners are down: the impulse acts at one of them alone if the other then leaves; else the block stops rocking.
inline RigidImpact base_impact(const RockingBlock& block, const RigidVelocity& v) noexcept {
  const double h = block.center_height();
  const auto down = [&](double side) { return v.y - v.w * corner(block, side); };
  const double first = down(1) <= down(-1) ? 1 : -1;
  for (const double side : {first, -first}) {
    if (!(down(side) < 0)) continue;
    const double ahead = corner(block, side);
    // The impulse within the base, while the new corner sticks.
    const double lever = side > 0 ? block.lever_right() : block.lever_left();
    if (!equal(lever, 1)) {
      const double square = block.gyration_square(), at = lever * ahead;
      const double w = (square * v.w + h * v.x + at * v.y) / (square + h * h + at * ahead);
      const RigidVelocity after{h * w, ahead * w, w};
      if (side * w > 0 && (!(block.mu() < never) || std::abs(after.x - v.x) <= block.mu() * (after.y - v.y)) &&
          kinetic_energy(block, after) <= kinetic_energy(block, v))
        return {after, side, 0, true};
    }
    RigidImpact one = corner_impact(block, v, side, {ahead, -h});
    if (one.consistent && side * one.after.w > 0) return one;
  }
  const double push = -v.y;
  const double x =
      !(block.mu() < never) || std::abs(v.x) <= block.mu() * push ? 0 : v.x - std::copysign(block.mu() * push, v.x);
  return {{x, 0, 0}, 0, x > 0 ? 1 : x < 0 ? -1 : 0};
}

}  // namespace stickslip::detail
