// The C interface of carts.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "c_interface.hpp"
#include "stickslip/base/error.hpp"
#include "stickslip/base/vector2.hpp"
#include "stickslip/carts/cart.hpp"
#include "stickslip/carts/integrate.hpp"
#include "stickslip/carts/state.hpp"
#include "stickslip/stickslip.h"

namespace stickslip {
namespace {

using detail::store;
using detail::vector;

constexpr std::size_t most = STICKSLIP_MOST_SUPPORTS;

Support support_of(const stickslip_support& s, bool shares) {
  const std::optional<double> share = shares ? std::optional(s.share) : std::nullopt;
  switch (s.kind) {
    case STICKSLIP_SWIVEL_CASTER:
      return SwivelCaster{vector(s.at), s.heading, s.mu, s.reach, s.rolling_mu, share};
    case STICKSLIP_FIXED_WHEEL:
      return FixedWheel{vector(s.at), s.heading, s.mu, s.rolling_mu, share};
    case STICKSLIP_FOOT:
      return Foot{vector(s.at), s.mu, share};
    default:
      detail::refuse("stickslip_support: kind must be a stickslip_support_kind, 0 to 2", s.kind);
  }
}

Cart cart_of(const stickslip_cart& c) {
  if (c.supports < 1 || c.supports > static_cast<int>(most))
    detail::refuse("stickslip_cart: supports must be from 1 to " + std::to_string(most), c.supports);
  const stickslip_support *first = c.support, *last = c.support + c.supports;
  const bool shares = std::any_of(first, last, [](const stickslip_support& s) { return std::abs(s.share) > 0; });
  std::vector<Support> supports;
  for (; first != last; ++first) supports.push_back(support_of(*first, shares));
  const Vector2 center = vector(c.center);
  return Cart(std::move(supports), c.radius_of_gyration,
              shares && !(norm(center) > 0) ? std::nullopt : std::optional(center));
}

CartState state_of(const stickslip_cart_state& s, const Cart& cart) {
  CartState state{
      .displacement = vector(s.displacement), .yaw = s.yaw, .velocity = vector(s.velocity), .yaw_rate = s.yaw_rate};
  if (detail::whole<int>(s.started, 0, 1, "stickslip_cart_state: started") == 0) return state;
  state.mode = detail::whole<CartMode>(s.moving, 0, 1, "stickslip_cart_state: moving");
  state.headings.assign(s.headings, s.headings + cart.casters());
  const int known = detail::whole<int>(s.known, 0, 2 * STICKSLIP_MOST_SUPPORTS, "stickslip_cart_state: known");
  for (int i = 0; i < known; ++i)
    state.lines.push_back(detail::whole<std::int8_t>(s.contacts[i], -1, 1, "stickslip_cart_state: contacts"));
  return state;
}

void store(const CartState& at, stickslip_cart_state& s) {
  s = {};
  store(at.displacement, s.displacement);
  s.yaw = at.yaw;
  store(at.velocity, s.velocity);
  s.yaw_rate = at.yaw_rate;
  s.started = 1;
  std::copy(at.headings.begin(), at.headings.end(), s.headings);
  s.moving = at.mode == CartMode::moving ? 1 : 0;
  s.known = static_cast<double>(at.lines.size());
  std::copy(at.lines.begin(), at.lines.end(), s.contacts);
}

}  // namespace
}  // namespace stickslip

extern "C" int stickslip_advance_cart(const stickslip_cart* cart, const stickslip_planar_segment* segment,
                                      stickslip_cart_state* state) {
  using namespace stickslip;
  return detail::c_status_of([&] {
    detail::require_pointer(cart, "cart");
    detail::require_pointer(segment, "segment");
    detail::require_pointer(state, "state");
    const Cart checked = cart_of(*cart);
    CartState at = state_of(*state, checked);
    const stickslip_planar_segment& s = *segment;
    if (!(s.duration > 0) && std::isfinite(s.duration)) return;
    advance(checked, {s.duration, vector(s.start), vector(s.end), s.vertical_start, s.vertical_end}, at);
    store(at, *state);
  });
}
