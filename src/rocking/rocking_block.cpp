#include "stickslip/rocking/rocking_block.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "stickslip/base/error.hpp"
#include "stickslip/base/units.hpp"

namespace stickslip {
namespace {

void require_positive(const char* name, double value) {
  detail::require(std::isfinite(value) && value > 0,
                  std::string("RockingBlock: ") + name + " must be positive and finite", value, "m");
}
double frequency_parameter(double half, double center, double square) noexcept {
  const double radius = std::hypot(half, center);
  return std::sqrt(standard_gravity * radius / (square + radius * radius));
}

}  // namespace

RockingBlock::RockingBlock(const RockingBlockSize& size)
    : size_(size),
      mu_(size.mu ? *size.mu + 0.0 : std::numeric_limits<double>::infinity()),
      half_{size.width / 2, size.width / 2},
      center_(size.height / 2),
      square_((size.width * size.width + size.height * size.height) / 12),
      lever_{1, 1} {
  require_positive("width", size.width);
  require_positive("height", size.height);
  if (size.mu)
    detail::require(std::isfinite(*size.mu) && *size.mu >= 0,
                    "RockingBlock: mu must be at least 0 and finite; without one the block never slips", *size.mu);
  if (size.center) {
    const auto [offset, above] = *size.center;
    detail::require(
        std::abs(offset) < size.width / 2,
        "RockingBlock: center must be above the base: its distance to the right of the middle must be below "
        "width/2",
        offset, "m");
    detail::require(above > 0 && above <= size.height,
                    "RockingBlock: center must be within the block: its height must be positive and at most height",
                    above, "m");
    half_ = {size.width / 2 - offset, size.width / 2 + offset};
    center_ = above;
  }
  if (size.gyration_radius) {
    require_positive("gyration_radius", *size.gyration_radius);
    square_ = *size.gyration_radius * *size.gyration_radius;
  }
  detail::require(!size.restitution || !size.lever, "RockingBlock: give restitution or lever, not both: lever",
                  size.lever.value_or(0));
  if (size.lever) {
    detail::require(std::isfinite(*size.lever) && *size.lever >= 0,
                    "RockingBlock: lever must be at least 0: below, impacts would create energy", *size.lever);
    lever_ = {*size.lever, *size.lever};
  }
  if (size.restitution) {
    const double eta = *size.restitution;
    detail::require(eta >= 0 && eta <= 1,
                    "RockingBlock: restitution must be from 0 to 1: above, impacts would create energy", eta);
    for (const std::size_t to : {0U, 1U}) {
      const double ahead = half_[to], behind = half_[1 - to];
      lever_[to] = (1 - eta) * (square_ + center_ * center_) / (ahead * (behind + eta * ahead));
    }
  }
}

double RockingBlock::alpha_right() const noexcept { return std::atan2(half_[0], center_); }
double RockingBlock::alpha_left() const noexcept { return std::atan2(half_[1], center_); }
double RockingBlock::alpha() const noexcept { return std::min(alpha_right(), alpha_left()); }
double RockingBlock::p_right() const noexcept { return frequency_parameter(half_[0], center_, square_); }
double RockingBlock::p_left() const noexcept { return frequency_parameter(half_[1], center_, square_); }

double RockingBlock::restitution_right() const noexcept {
  const double inertia = square_ + center_ * center_, arm = lever_[0] * half_[0];
  return std::max((inertia - arm * half_[1]) / (inertia + arm * half_[0]), 0.0);
}
double RockingBlock::restitution_left() const noexcept {
  const double inertia = square_ + center_ * center_, arm = lever_[1] * half_[1];
  return std::max((inertia - arm * half_[0]) / (inertia + arm * half_[1]), 0.0);
}

double RockingBlock::painleve_friction() const noexcept {
  const double far = std::max(half_[0], half_[1]), kappa = square_ / (far * far + center_ * center_);
  return 2 * std::sqrt(kappa * (1 + kappa));
}

}  // namespace stickslip
