// The forces on a cart during its response: the acceleration that its load feels.
#pragma once

#include <vector>

#include "stickslip/base/vector2.hpp"
#include "stickslip/carts/cart.hpp"
#include "stickslip/carts/response.hpp"
#include "stickslip/ground/floor_motion.hpp"
#include "stickslip/ground/ground_motion.hpp"

namespace stickslip {

/// The horizontal force of all supports per unit mass: the absolute acceleration of the center of mass, r'' + n. While the
/// cart rests it is the ground acceleration n.
struct CartForces {
  std::vector<Vector2> acceleration;  ///< at the samples [m/s^2]
  double peak = 0;                    ///< its largest magnitude over all time, not only at samples [m/s^2]
  double peak_time = 0;               ///< its time [s]; one of them, where it is constant
};

/// The forces on a cart during a response.
///
/// At a sample at which forces or the ground acceleration jump, the values are those just after it; at the end of the
/// ground motion and of the response, those just before it.
///
/// @param response  the result of `integrate` for cart and motion
/// @return as many values as the response has samples
/// As exact as `integrate`; while a foot begins to slide, to 1e-3. Cost: about that of `integrate`.
CartForces forces(const Cart& cart, const GroundMotion& motion, const CartResponse& response);

/// The absolute acceleration of the center of mass of a cart, for equipment on it; its spectra are floor spectra.
///
/// It jumps where a wheel or a foot begins to slide, stops or reverses; a segment ends there.
///
/// @param response   the result of `integrate` for cart and motion, which must not be truncated
/// @param tolerance  maximum error of a chord, as a fraction of the largest absolute acceleration, from 1e-10 to 1
/// @return from the first to the last sample of the response, without impulses. Use `settle`, otherwise the floor stops
///         together with the ground motion
/// @throws std::invalid_argument  a tolerance out of range, a truncated response, a response to another motion
/// Accuracy: `tolerance`; see `forces`. Cost: about twice that of `integrate`.
PlanarFloorMotion floor_motion(const Cart& cart, const GroundMotion& motion, const CartResponse& response,
                               double tolerance = 1e-6);

}  // namespace stickslip
