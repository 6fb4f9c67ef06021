#include "stickslip/rocking/slender_block.hpp"

#include <cmath>
#include <numbers>
#include <string>

#include "stickslip/base/error.hpp"
#include "stickslip/base/units.hpp"

namespace stickslip {

SlenderBlock::SlenderBlock(double p, double alpha_right, double alpha_left, double restitution)
    : p_(p), alpha_{alpha_right, alpha_left}, restitution_(restitution + 0.0) {
  detail::require(std::isfinite(p * p) && p > 0, "SlenderBlock: p must be positive and finite", p, "rad/s");
  const auto check = [](const char* name, double alpha) {
    detail::require(alpha > 0 && alpha < std::numbers::pi / 2,
                    std::string("SlenderBlock: ") + name +
                        " must be positive and below pi/2; it is the angle whose tangent is half the width over the "
                        "height of the center of mass",
                    alpha, "rad");
  };
  check("alpha", alpha_right);
  check("alpha_left", alpha_left);
  detail::require(restitution >= 0 && restitution <= 1, "SlenderBlock: restitution must be from 0 to 1", restitution);
}

double SlenderBlock::period(double rotation) const {
  const double size = std::abs(rotation), alpha = rotation < 0 ? alpha_[1] : alpha_[0];
  const double other = rotation < 0 ? alpha_[0] : alpha_[1];
  detail::require(size > 0 && size < alpha, "SlenderBlock: the amplitude of a period must be below alpha and not zero",
                  rotation, "rad");
  // On the other side up to the same potential, theta (alpha - theta/2).
  const double rise = size * (2 * alpha - size), left = other * other - rise;
  detail::require(left > 0, "SlenderBlock: with this amplitude the block overturns on its other side", rotation, "rad");
  // arcosh(1/(1 - x)) = 2 artanh(sqrt(x/(2 - x)))
  const auto quarter = [&](double x) { return 2 * std::atanh(std::sqrt(x / (2 - x))) / p_; };
  return 2 * (quarter(size / alpha) + quarter(rise / (other + std::sqrt(left)) / other));
}

double housner_restitution(double alpha) {
  const double sine = std::sin(alpha);
  return 1 - 1.5 * sine * sine;
}

SlenderBlock SlenderBlock::from_size(double width, double height, std::optional<double> restitution) {
  detail::require(std::isfinite(width) && width > 0, "SlenderBlock: width must be positive and finite", width, "m");
  detail::require(std::isfinite(height) && height > 0, "SlenderBlock: height must be positive and finite", height, "m");
  const double radius = std::hypot(width, height) / 2, alpha = std::atan2(width, height);
  if (!restitution) {
    restitution = housner_restitution(alpha);
    detail::require(*restitution >= 0,
                    "SlenderBlock: a block of this size is too squat to rock on after an impact: width must be below "
                    "sqrt(2) height, or the restitution be given; width",
                    width, "m");
  }
  return {std::sqrt(0.75 * standard_gravity / radius), alpha, *restitution};
}

}  // namespace stickslip
