// A run of a cart for its outcome.
#pragma once

#include "stickslip/carts/integrate.hpp"

namespace stickslip::detail {

/// `integrate` without the motion at the samples.
CartResponse integrate_without_samples(const Cart& cart, const GroundMotion& motion, const CartOptions& options);

}  // namespace stickslip::detail
