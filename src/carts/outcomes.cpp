#include "stickslip/carts/outcomes.hpp"

#include "base/attempt.hpp"
#include "base/outcomes.hpp"
#include "carts/run.hpp"
#include "stickslip/carts/integrate.hpp"

namespace stickslip {
namespace {

CartOutcome cart_outcome(const Cart& cart, const GroundMotion& motion, const CartOptions& options) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  CartOutcome found;
  detail::attempt(
      [&] {
        CartResponse r = detail::integrate_without_samples(cart, motion, options);
        found = {r.peak,         r.peak_yaw, r.peak_outline, r.residual,
                 r.residual_yaw, r.rests,    r.margin,       std::move(r.clearances)};
      },
      [&](const char* message) {
        found = {nan, nan, nan, {nan, nan}, nan, 0, nan, {}, message};
        found.clearances.assign(options.walls.size(), {nan, nan});
      });
  return found;
}

}  // namespace

std::vector<CartOutcome> cart_outcomes(
    std::size_t runs, const std::function<const Cart&(std::size_t)>& cart_of,
    const std::function<void(std::size_t, const std::function<void(const GroundMotion&)>&)>& motion_of,
    const CartRunOptions& options) {
  return detail::outcomes_of<CartOutcome>(runs, options, [&](std::size_t i, const std::function<void()>& progress) {
    CartOptions how;
    how.settle = options.settle;
    how.walls = options.walls;
    how.progress = progress;
    CartOutcome found;
    motion_of(i, [&](const GroundMotion& motion) { found = cart_outcome(cart_of(i), motion, how); });
    return found;
  });
}

}  // namespace stickslip
