// Carts through the C interface: the same bits as `advance`, and errors as codes.
#include <cmath>
#include <cstddef>
#include <string>
#include <variant>
#include <vector>

#include "stickslip/carts/integrate.hpp"
#include "stickslip/stickslip.h"
#include "support/catch.hpp"

using namespace stickslip;
using Catch::Matchers::ContainsSubstring;

namespace {

// Two casters, a fixed wheel and a foot.
const std::vector<Support> supports{SwivelCaster{{0.3, 0.2}, 0.4, 0.1, 0.04, 0.01, {}},
                                    SwivelCaster{{0.3, -0.2}, 2.0, 0.1, 0.04, 0.01, {}},
                                    FixedWheel{{-0.3, 0.2}, 0.1, 0.3, 0.02, {}}, Foot{{-0.3, -0.2}, 0.05, {}}};

stickslip_cart cart_of_c() {
  stickslip_cart c = {};
  c.supports = 4;
  c.support[0] = {STICKSLIP_SWIVEL_CASTER, {0.3, 0.2}, 0.4, 0.1, 0.04, 0.01, 0};
  c.support[1] = {STICKSLIP_SWIVEL_CASTER, {0.3, -0.2}, 2.0, 0.1, 0.04, 0.01, 0};
  c.support[2] = {STICKSLIP_FIXED_WHEEL, {-0.3, 0.2}, 0.1, 0.3, 0, 0.02, 0};
  c.support[3] = {STICKSLIP_FOOT, {-0.3, -0.2}, 0, 0.05, 0, 0, 0};
  c.radius_of_gyration = 0.25;
  return c;
}

}  // namespace

TEST_CASE("the C interface moves carts to the same bits") {
  const Cart cart(supports, 0.25, Vector2{});
  const stickslip_cart c = cart_of_c();
  stickslip_cart_state state = {};
  CartState at;
  int rests = 0, moves = 0;
  for (int m = 0; m < 200; ++m) {
    const auto n = [](int i) { return Vector2{std::sin(0.7 * i), 0.6 * std::cos(0.9 * i + 0.4)}; };
    const stickslip_planar_segment segment = {0.1,
                                              {n(m).axis, n(m).transverse},
                                              {n(m + 1).axis, n(m + 1).transverse},
                                              std::cos(0.5 * m),
                                              std::cos(0.5 * m + 0.5)};
    REQUIRE(stickslip_advance_cart(&c, &segment, &state) == STICKSLIP_OK);
    advance(cart, {0.1, n(m), n(m + 1), std::cos(0.5 * m), std::cos(0.5 * m + 0.5)}, at);
    REQUIRE(state.displacement[0] == at.displacement.axis);
    REQUIRE(state.displacement[1] == at.displacement.transverse);
    REQUIRE(state.yaw == at.yaw);
    REQUIRE(state.yaw_rate == at.yaw_rate);
    REQUIRE(state.headings[1] == at.headings[1]);
    ++(at.mode == CartMode::rest ? rests : moves);
  }
  CHECK(moves > 50);
  CHECK(std::abs(at.yaw) > 1e-3);

  // Shares of the load place the center of mass, as in C++.
  stickslip_cart shared = c;
  for (int i = 0; i < 4; ++i) shared.support[i].share = i < 2 ? 0.3 : 0.2;
  std::vector<Support> with_shares = supports;
  for (std::size_t i = 0; i < 4; ++i) std::visit([&](auto& one) { one.share = i < 2 ? 0.3 : 0.2; }, with_shares[i]);
  const stickslip_planar_segment push = {0.2, {2, 1}, {2, 1}, 0, 0};
  state = {};
  at = {};
  REQUIRE(stickslip_advance_cart(&shared, &push, &state) == STICKSLIP_OK);
  advance(Cart(with_shares, 0.25), {0.2, {2, 1}, {2, 1}}, at);
  CHECK(state.yaw == at.yaw);
}

TEST_CASE("the C interface refuses what no cart can be") {
  const stickslip_planar_segment segment = {0.1, {1, 0}, {1, 0}, 0, 0};
  stickslip_cart c = cart_of_c();
  stickslip_cart_state state = {};
  const auto refused = [&](const char* text) {
    CHECK(stickslip_advance_cart(&c, &segment, &state) == STICKSLIP_INVALID_ARGUMENT);
    CHECK_THAT(std::string(stickslip_message()), ContainsSubstring(text));
  };
  c.supports = 17;
  refused("supports");
  c = cart_of_c();
  c.support[1].kind = 7;
  refused("kind");
  c = cart_of_c();
  c.support[1].reach = 0;
  refused("reach");
  c = cart_of_c();
  state.started = 1, state.known = 99;
  refused("known");
  state = {}, state.started = 1, state.known = 3;
  refused("lines");
  state = {}, state.yaw = std::nan("");
  refused("finite");
  CHECK(stickslip_advance_cart(&c, nullptr, &state) == STICKSLIP_INVALID_ARGUMENT);
}
