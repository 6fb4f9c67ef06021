// A slender block that rocks on its base.
#pragma once

#include <array>
#include <optional>

#include "stickslip/base/requirements.hpp"

namespace stickslip {

/// A free-standing block that is slender and does not slip: small angles, and a restitution for the impacts of its base,
///     theta'' = p^2 (G/g)(theta - s alpha) - p^2 n/g,     s = sgn(theta),   G = g + a_z          Housner (1963)
/// theta the rotation [rad], positive when it tilts toward +x about its right corner; n and a_z the horizontal and the
/// upward ground acceleration [m/s^2]. It rests while
///     -n <= alpha_right G  and  n <= alpha_left G,
/// and where theta passes zero, the rate theta' becomes restitution theta' on the other corner. Where it tilts beyond
/// alpha it overturns, unless the ground moves back under it.
///
/// Accuracy of the model beside a rigid block with large angles: theta / alpha within 2e-3, 5e-4 and 5e-5 at alpha =
/// 0.03, 0.01 and 0.003 after seven impacts; percents at 0.15; a warning above 0.35.
class SlenderBlock {
 public:
  /// @param p            frequency parameter sqrt(m g R / I) [rad/s], positive: R the distance from a corner to the
  ///                     center of mass, I the moment of inertia about the corner; sqrt(3 g / (4 R)) if uniform
  /// @param alpha        angle between the side and the line from the corner to the center of mass [rad], positive and
  ///                     below pi/2
  /// @param restitution  rate after an impact over that before, from 0 to 1
  /// @throws std::invalid_argument  naming the value
  SlenderBlock(double p, double alpha, double restitution) : SlenderBlock(p, alpha, alpha, restitution) {}
  /// The same with a center of mass that is not above the middle of the base. It keeps one p and one restitution; they
  /// differ by side, too, if the offset is large.
  SlenderBlock(double p, double alpha_right, double alpha_left, double restitution);

  /// A uniform block of a width and a height [m], with p and alpha of its size.
  /// @param restitution  without a value that of Housner, 1 - 3/2 sin^2 alpha
  /// @throws std::invalid_argument  naming the value; a block too squat for Housner's impacts (width >= sqrt(2) height)
  static SlenderBlock from_size(double width, double height, std::optional<double> restitution = {});

  double p() const noexcept { return p_; }                   ///< [rad/s]
  double alpha_right() const noexcept { return alpha_[0]; }  ///< of the right corner, about which theta > 0 [rad]
  double alpha_left() const noexcept { return alpha_[1]; }   ///< [rad]
  double restitution() const noexcept { return restitution_; }
  /// The smaller alpha [rad].
  double alpha() const noexcept { return alpha_[0] < alpha_[1] ? alpha_[0] : alpha_[1]; }

  /// Period of free rocking between impacts that lose nothing [s], Housner (1963): (4/p) arcosh(1/(1 - rotation/alpha)) with
  /// equal sides. It grows with the amplitude, to infinity at alpha.
  /// @param rotation  amplitude [rad]: positive to the right, negative to the left, not zero
  /// @throws std::invalid_argument  an amplitude with which the block would overturn on one side
  double period(double rotation) const;

  friend bool operator==(const SlenderBlock&, const SlenderBlock&) = default;

 private:
  double p_;
  std::array<double, 2> alpha_;
  double restitution_;
};

/// Restitution of a rigid block that lands on its other corner without slip, from the conservation of its angular
/// momentum about that corner: 1 - 3/2 sin^2 alpha for a uniform block, Housner (1963).
double housner_restitution(double alpha);

}  // namespace stickslip
