// Many carts: outcomes are those of single runs.
#include "stickslip/carts/outcomes.hpp"

#include <cmath>
#include <cstddef>
#include <functional>
#include <numbers>
#include <vector>

#include "stickslip/carts/integrate.hpp"
#include "support/catch.hpp"

using namespace stickslip;

namespace {

Cart cart_on_casters(double heading, double rolling_mu) {
  std::vector<Support> supports;
  for (const double x : {-0.4, 0.4})
    for (const double y : {-0.3, 0.3})
      supports.emplace_back(SwivelCaster::from_slip_level({x, y}, heading + x + 2 * y, 0.97, 0.041, rolling_mu));
  return {supports, 0.35};
}

GroundMotion both_ways() {
  std::vector<double> n, t;
  for (int k = 0; k < 200; ++k) {
    const double fade = std::pow(std::sin(std::numbers::pi * k / 200), 2);
    n.push_back(2.5 * fade * std::sin(0.15 * k));
    t.push_back(1.5 * fade * std::cos(0.1 * k));
  }
  return GroundMotion(n, 0.05).with_components(t);
}

}  // namespace

TEST_CASE("cart outcomes: those of single runs, for any number of threads") {
  const GroundMotion motion = both_ways();
  std::vector<Cart> carts;
  for (int i = 0; i < 5; ++i) carts.push_back(cart_on_casters(i, 0.01));
  carts.push_back(cart_on_casters(0, 0));
  CartRunOptions options;
  options.settle = true;
  options.walls = {{{0.6, 0}, {0, 1}}, {{0, -9}, {1, 0}}};
  for (const unsigned threads : {1U, 3U}) {
    options.threads = threads;
    const auto outcomes = cart_outcomes(
        12, [&](std::size_t i) -> const Cart& { return carts[i % 6]; },
        [&](std::size_t i, const auto& use) { use(i < 6 ? motion : motion.scaled(-1)); }, options);
    REQUIRE(outcomes.size() == 12);
    for (std::size_t i = 0; i < 12; ++i) {
      CAPTURE(i);
      if (i % 6 == 5) {
        CHECK_THAT(outcomes[i].failure, Catch::Matchers::ContainsSubstring("may roll without end"));
        CHECK(std::isnan(outcomes[i].peak_outline));
        CHECK(outcomes[i].clearances.size() == 2);
        continue;
      }
      CartOptions how;
      how.settle = true;
      how.walls = options.walls;
      const CartResponse r = integrate(carts[i % 6], i < 6 ? motion : motion.scaled(-1), how);
      CHECK(outcomes[i].failure.empty());
      CHECK(outcomes[i].peak == r.peak);
      CHECK(outcomes[i].peak_yaw == r.peak_yaw);
      CHECK(outcomes[i].peak_outline == r.peak_outline);
      CHECK(outcomes[i].residual == r.residual);
      CHECK(outcomes[i].residual_yaw == r.residual_yaw);
      CHECK(outcomes[i].rests == r.rests);
      CHECK(outcomes[i].margin == r.margin);
      REQUIRE(outcomes[i].clearances.size() == 2);
      CHECK(outcomes[i].clearances[0].least == r.clearances[0].least);
      CHECK(std::isnan(outcomes[i].clearances[1].hit_time));
    }
  }
}
