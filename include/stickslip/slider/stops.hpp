// Stops that limit the displacement of a slider.
#pragma once

#include <cmath>
#include <limits>

#include "stickslip/base/error.hpp"

namespace stickslip {

/// Stops at x = forward and x = -backward. A slider that hits a stop at speed v rebounds at speed restitution v. A
/// stop resists any load toward it.
class Stops {
 public:
  /// No stops.
  Stops() = default;

  /// Stops on both sides.
  /// @param gap          distance from x = 0 to either stop [m], positive; infinite: none
  /// @param restitution  e, from 0 to 1
  /// @throws std::invalid_argument naming the value
  Stops(double gap, double restitution) : Stops(gap, gap, restitution) {}

  /// @param forward, backward  distance from x = 0 to each stop [m], positive; infinite: none on that side
  /// @param restitution        e, from 0 to 1
  /// @throws std::invalid_argument naming the value
  Stops(double forward, double backward, double restitution)
      : forward_(forward), backward_(backward), restitution_(restitution) {
    detail::require(forward > 0, "Stops: gap must be positive", forward, "m");
    detail::require(backward > 0, "Stops: backward must be positive", backward, "m");
    detail::require(restitution >= 0 && restitution <= 1, "Stops: restitution must be from 0 to 1", restitution);
  }

  double forward() const noexcept { return forward_; }
  double backward() const noexcept { return backward_; }
  double restitution() const noexcept { return restitution_; }

  /// Whether there is a stop.
  explicit operator bool() const noexcept { return std::isfinite(forward_) || std::isfinite(backward_); }

  friend bool operator==(const Stops&, const Stops&) = default;

 private:
  double forward_ = std::numeric_limits<double>::infinity();
  double backward_ = std::numeric_limits<double>::infinity();
  double restitution_ = 0;
};

}  // namespace stickslip
