// Integrate the motion of a cart.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "stickslip/carts/cart.hpp"
#include "stickslip/carts/response.hpp"
#include "stickslip/carts/state.hpp"
#include "stickslip/ground/ground_motion.hpp"

namespace stickslip {

struct CartOptions {
  double yaw = 0;             ///< at the start [rad], finite
  Vector2 velocity{};         ///< of the center of mass at the start [m/s], finite
  double yaw_rate = 0;        ///< at the start [rad/s], finite
  bool settle = false;        ///< continue under zero ground acceleration after the last sample until the cart rests
  std::vector<Wall> walls{};  ///< whose clearance is asked
  std::function<void()> progress{};  ///< called about once per second or more often; may throw to stop the work
};

/// Integrate the motion of a cart under a ground motion, with every slip, stick, reversal and rest of its wheels; see Cart
/// for the equations. Both horizontal components act, and the vertical one on N.
/// @throws std::invalid_argument  a start that is not finite; a wall without direction; with `settle`, a cart none of whose
///                                supports resists rolling, which may roll without end
/// @throws ConvergenceError       with `settle`, a cart that does not come to rest; more events than 1,000,000 plus eight
///                                per segment
/// Between events the motion is a power series, and events are roots of polynomials: exact to round-off on wheels, which grows
/// while casters swivel against their motion; to 1e-9 on feet, whose starts are slaved to their force. What feet hold is found
/// to 1e-5. Answer in distributions over the headings. Cost: 25 us an event on casters, ten times that on feet.
CartResponse integrate(const Cart& cart, const GroundMotion& motion, const CartOptions& options = {});

/// How far an error grows: the largest change of the displacement of the center of mass at a sample, or of the yaw times the
/// radius of gyration, per change of the headings of all casters at the start (without casters, of the yaw) [m/rad]. Found
/// from a second motion whose headings differ by 1e-9 rad: an error of 1e-16 becomes 1e-16 times that. Cost: two motions.
/// @throws as `integrate`
double condition(const Cart& cart, const GroundMotion& motion, const CartOptions& options = {});

/// Ground acceleration over a segment, linear from start to end.
struct CartGround {
  double duration;                              ///< [s], finite, at least 0
  Vector2 start, end;                           ///< horizontal [m/s^2], finite
  double vertical_start = 0, vertical_end = 0;  ///< upward, a_z [m/s^2], finite
};

/// Integrate over one segment, for codes with their own time loop.
/// @param state  replaced by the state at the end; unchanged on an error
/// @throws std::invalid_argument  a number that is not finite; other numbers of headings or lines than the cart has
/// @throws ConvergenceError       events faster than the time can be resolved
void advance(const Cart& cart, const CartGround& segment, CartState& state);

/// The states of a cart at any times of a response, also between its samples and while it settles.
///
/// @param response  the result of `integrate` for cart and motion
/// @param times     in any order, from the start of the motion to the last event or sample of the response [s]
/// @return a state for each time, in their order; at an event, that after it
/// @throws std::invalid_argument  a time before the start or after the end
/// As exact as `integrate`. Cost: a step for each segment and each time.
std::vector<CartState> states_at(const Cart& cart, const GroundMotion& motion, const CartResponse& response,
                                 std::span<const double> times);

}  // namespace stickslip
