// Two horizontal components.
#pragma once

#include <cmath>

#include "stickslip/base/requirements.hpp"

namespace stickslip {

/// A vector in the plane of sliding: its component along the axis, and that along the transverse direction, which
/// points 90 degrees clockwise from the axis as seen from above.
struct Vector2 {
  double axis = 0, transverse = 0;

  friend constexpr Vector2 operator+(Vector2 a, Vector2 b) noexcept {
    return {a.axis + b.axis, a.transverse + b.transverse};
  }
  friend constexpr Vector2 operator-(Vector2 a, Vector2 b) noexcept {
    return {a.axis - b.axis, a.transverse - b.transverse};
  }
  friend constexpr Vector2 operator-(Vector2 a) noexcept { return {-a.axis, -a.transverse}; }
  friend constexpr Vector2 operator*(double factor, Vector2 a) noexcept {
    return {factor * a.axis, factor * a.transverse};
  }
  constexpr Vector2& operator+=(Vector2 a) noexcept { return *this = *this + a; }

  friend bool operator==(const Vector2&, const Vector2&) = default;
};

/// The scalar product.
constexpr double dot(Vector2 a, Vector2 b) noexcept { return a.axis * b.axis + a.transverse * b.transverse; }

/// The component of the vector product perpendicular to the plane: positive if `b` points clockwise from `a`.
constexpr double cross(Vector2 a, Vector2 b) noexcept { return a.axis * b.transverse - a.transverse * b.axis; }

/// The length, without overflow.
inline double norm(Vector2 a) noexcept { return std::hypot(a.axis, a.transverse); }

/// The vector turned by 90 degrees clockwise.
constexpr Vector2 turned(Vector2 a) noexcept { return {-a.transverse, a.axis}; }

}  // namespace stickslip
