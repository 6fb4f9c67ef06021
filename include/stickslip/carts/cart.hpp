// A rigid cart on swivel casters, fixed wheels and feet, in the plane.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "stickslip/carts/support.hpp"

namespace stickslip {

/// A rigid cart that moves in the plane and turns, under two components of ground acceleration and a vertical one. With
/// y = (x', y', k phi') and the arm b of each support from the center of mass,
///     y' = (-a_x, -a_y, 0) - sum over lines (L N/g) sgn(sigma) r - sum over feet (L N/g) J^T V/|V|,   N = max(g + a_z, 0),
/// where each wheel has a line across it and, if it resists rolling, one along it: d its direction, r = (d, (b x d)/k),
/// sigma = r.y the speed along d, and L = share g times its coefficient of friction. Friction is monotone, so that the motion
/// is determined; the forces of single supports that stick together are not. At rest the load must lie in the sum of all
/// segments L r and discs L J^T. Angles are positive from the axis toward the transverse direction.
///
/// Left out: the friction of a swivel; the shift of the loads as wheels swivel (trail over wheel base) and by overturning
/// moments; yaw of the ground; springs, stops and walls in the motion.
class Cart {
 public:
  /// @param supports            at least 1. The shares of the load are given for all supports, or for none: then they are
  ///                            those of equal stiffness (least squares), which must not be negative
  /// @param radius_of_gyration  k, about the center of mass [m], positive and finite
  /// @param center              of mass, in the frame in which the supports are given [m]. Without one it is the origin, or
  ///                            follows from shares; with both they must agree to 1e-6 of the size of the cart
  /// @param outline             corners whose motion is watched [m], in the same frame; those of the supports if empty
  /// @throws std::invalid_argument  naming the support by its number, counted from 0, and its value
  Cart(std::vector<Support> supports, double radius_of_gyration, std::optional<Vector2> center = {},
       std::vector<Vector2> outline = {});

  const std::vector<Support>& supports() const noexcept { return supports_; }  ///< as given
  double radius_of_gyration() const noexcept { return radius_; }               ///< [m]
  Vector2 center() const noexcept { return center_; }                          ///< [m]
  const std::vector<Vector2>& outline() const noexcept { return outline_; }    ///< [m]
  const std::vector<double>& shares() const noexcept { return shares_; }       ///< of the weight, their sum 1
  std::size_t casters() const noexcept { return casters_; }                    ///< number of swivel casters

  /// The largest acceleration of level ground along a direction under which the cart stays at rest [m/s^2].
  /// @param direction  not zero
  /// @param headings   of the casters [rad]; those of the cart if empty
  /// @throws std::invalid_argument  a direction that is zero or not finite; another number of headings
  double holds(Vector2 direction, std::span<const double> headings = {}) const;

  /// The same cart with other headings of its casters at the start.
  /// @throws std::invalid_argument  another number of headings; a heading that is not finite
  Cart with_headings(std::span<const double> headings) const;

  friend bool operator==(const Cart&, const Cart&) = default;

 private:
  std::vector<Support> supports_;
  double radius_;
  Vector2 center_{};
  std::vector<Vector2> outline_;
  std::vector<double> shares_;
  std::size_t casters_ = 0;
};

}  // namespace stickslip
