// Parts of the run of a cart: its segments, and runs for their outcome.
#pragma once

#include <cstddef>

#include "carts/model.hpp"
#include "carts/system.hpp"
#include "stickslip/carts/integrate.hpp"
#include "stickslip/carts/response.hpp"
#include "stickslip/carts/state.hpp"
#include "stickslip/ground/ground_motion.hpp"

namespace stickslip::detail {

/// A segment of a ground motion.
CartSegment cart_segment(const GroundMotion& motion, std::size_t i);
/// One without ground motion.
CartSegment calm_for(double duration) noexcept;

/// Move a cart through a segment.
void move(CartWorkspace& work, const CartSegment& ground, CartState& state, CartSink& sink);

/// The state at the start of a response.
CartState start_of(const CartModel& model, const CartResponse& response);

/// `integrate` without the motion at the samples.
CartResponse integrate_without_samples(const Cart& cart, const GroundMotion& motion, const CartOptions& options);

}  // namespace stickslip::detail
