// Many carts under many ground motions: what each did, without its history.
#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "stickslip/carts/cart.hpp"
#include "stickslip/carts/response.hpp"
#include "stickslip/ground/ground_motion.hpp"

namespace stickslip {

/// What a cart did under a ground motion; the names are those of CartResponse.
struct CartOutcome {
  double peak = 0;          ///< [m]
  double peak_yaw = 0;      ///< [rad]
  double peak_outline = 0;  ///< [m]
  Vector2 residual{};       ///< [m]
  double residual_yaw = 0;  ///< [rad]
  std::size_t rests = 0;
  double margin = std::numeric_limits<double>::infinity();
  std::vector<Clearance> clearances{};  ///< of the walls
  std::string failure{};                ///< why there is no outcome; the numbers are then NaN and 0
};

struct CartRunOptions {
  bool settle = false;                                                ///< as CartOptions::settle
  std::vector<Wall> walls{};                                          ///< as CartOptions::walls, the same for all runs
  unsigned threads = 0;                                               ///< maximum number; 0: all cores
  std::function<void(std::size_t done, std::size_t all)> progress{};  ///< called ten times a second; may throw
};

/// The outcomes of runs, each from rest.
/// @param cart_of    the cart of run i
/// @param motion_of  `motion_of(i, use)` calls `use(motion)` with the motion of run i; several threads call it
/// A run that fails (`settle` without rolling resistance) is entered with the reason.
std::vector<CartOutcome> cart_outcomes(
    std::size_t runs, const std::function<const Cart&(std::size_t)>& cart_of,
    const std::function<void(std::size_t, const std::function<void(const GroundMotion&)>&)>& motion_of,
    const CartRunOptions& options = {});

}  // namespace stickslip
