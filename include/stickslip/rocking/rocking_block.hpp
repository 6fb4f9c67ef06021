// A rigid block that rocks, slides and leaves the ground.
#pragma once

#include <array>
#include <optional>
#include <utility>

#include "stickslip/base/requirements.hpp"

namespace stickslip {

/// What describes a RockingBlock.
struct RockingBlockSize {
  double width;   ///< of the base [m], positive
  double height;  ///< of the block [m], positive
  /// Coulomb's coefficient of friction at the base and its corners, at least 0. Without one it never slips; where
  /// that would take tension, and the corner would not leave by itself, it is held.
  std::optional<double> mu{};
  /// Rate after an impact of the base over that before it, from 0 to 1. Without one that of the impact law, Housner's for a
  /// block that does not slip.
  std::optional<double> restitution{};
  /// The same otherwise: where the impulse acts, over the distance from the foot of the center of mass to the corner on which
  /// the block goes on; 1 is Housner's impact, 0 loses nothing.
  std::optional<double> lever{};
  /// Of mass: its distance to the right of the middle of the base, and its height [m]. Without one that of a uniform block.
  std::optional<std::pair<double, double>> center{};
  /// About the center of mass [m], positive. Without one sqrt((width^2 + height^2)/12), that of a uniform block.
  std::optional<double> gyration_radius{};

  friend bool operator==(const RockingBlockSize&, const RockingBlockSize&) = default;
};

/// A rigid block on rigid ground, with large rotations, Coulomb friction and plastic impacts. It rests, slides on its base,
/// rocks about a corner that sticks, rocks about a corner that slips, or flies:
///     X'' = -n + T,   Y'' = -G + N,   k^2 theta'' = r_y T - r_x N,   |T| <= mu N,   N >= 0,   G = g + a_z
/// with (X, Y) the center of mass, (r_x, r_y) the corner from there, and theta > 0 a tilt toward +x about the right corner.
///
/// Impacts are plastic and unilateral, with Coulomb's law in impulses (Moreau): a corner that arrives stops; where the base
/// arrives, the impulse acts at one corner alone if the other then leaves, and else the block stops rocking. Without slip
/// this is Housner's restitution, (k^2 + h^2 - b_L b_R)/(k^2 + h^2 + b^2) with b on the new side, h the height of the center
/// of mass and b_R, b_L its distances from the corners.
class RockingBlock {
 public:
  /// @throws std::invalid_argument  naming the value
  explicit RockingBlock(const RockingBlockSize& size);

  const RockingBlockSize& size() const noexcept { return size_; }  ///< as given
  double width() const noexcept { return size_.width; }            ///< [m]
  double height() const noexcept { return size_.height; }          ///< [m]
  /// Infinite if it never slips.
  double mu() const noexcept { return mu_; }
  double right() const noexcept { return half_[0]; }           ///< b_R, from the center of mass to the right corner [m]
  double left() const noexcept { return half_[1]; }            ///< b_L [m]
  double center_height() const noexcept { return center_; }    ///< h [m]
  double gyration_square() const noexcept { return square_; }  ///< k^2 [m^2]
  /// Of the impact onto the right corner, and onto the left one.
  double lever_right() const noexcept { return lever_[0]; }
  double lever_left() const noexcept { return lever_[1]; }

  double alpha_right() const noexcept;  ///< atan(b_R/h) [rad]
  double alpha_left() const noexcept;   ///< [rad]
  double alpha() const noexcept;        ///< the smaller [rad]
  /// Frequency parameter sqrt(g R/(k^2 + R^2)) about the right corner, and about the left one [rad/s]
  double p_right() const noexcept;
  double p_left() const noexcept;
  /// theta' after over before an impact of the base without slip, onto the right corner and onto the left one; 0 if it
  /// stops rocking.
  double restitution_right() const noexcept;
  double restitution_left() const noexcept;
  /// Below this coefficient of friction, 2 sqrt(kappa (1 + kappa)) with kappa = k^2/R^2 of the farther corner, the motion is
  /// always determined: no paradox of Painleve exists. 4/3 if uniform.
  double painleve_friction() const noexcept;

  friend bool operator==(const RockingBlock& a, const RockingBlock& b) { return a.size_ == b.size_; }

 private:
  RockingBlockSize size_;
  double mu_;
  std::array<double, 2> half_;
  double center_, square_;
  std::array<double, 2> lever_;
};

}  // namespace stickslip
