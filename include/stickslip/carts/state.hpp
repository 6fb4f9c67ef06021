// Where a cart is and how it moves.
#pragma once

#include <cstdint>
#include <vector>

#include "stickslip/base/vector2.hpp"

namespace stickslip {

enum class CartMode : std::uint8_t { rest, moving };

/// The state of a cart.
struct CartState {
  Vector2 displacement{};          ///< of the center of mass, relative to the ground [m]
  double yaw = 0;                  ///< phi [rad]
  Vector2 velocity{};              ///< [m/s]
  double yaw_rate = 0;             ///< [rad/s]
  std::vector<double> headings{};  ///< of the casters in order, relative to the cart [rad]; empty: those of the cart
  CartMode mode = CartMode::rest;
  /// The directions in which the lines of the wheels slide, +1 or -1, and 0 where they stick; across and along each wheel in
  /// order, lines without friction left out. Empty: found from the velocities.
  std::vector<std::int8_t> lines{};
};

}  // namespace stickslip
