// Blocks through the C interface: the same bits as `advance`, and errors as codes.
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

#include "stickslip/rocking/integrate.hpp"
#include "stickslip/stickslip.h"
#include "support/catch.hpp"

using namespace stickslip;
using Catch::Matchers::ContainsSubstring;

namespace {

double shaking(int m) { return 0.9 * (2 * std::sin(0.7 * m) + 1.3 * std::cos(1.9 * m + 0.4)); }

// Moves a block in both ways; how many samples it spent in each mode, from left to flight.
template <class Block, class OfC, class Advance>
std::array<int, 5> check_same_bits(const Block& block, const OfC& c, const Advance& step, double factor, double up) {
  stickslip_rocking_state state = {};
  RockingState at;
  std::array<int, 5> spent{};
  for (int m = 0; m < 400; ++m) {
    const double n = factor * shaking(m), then = factor * shaking(m + 1), a = up * std::cos(0.5 * m),
                 b = up * std::cos(0.5 * (m + 1));
    const stickslip_segment segment = {0.1, n, then, a, b};
    REQUIRE(step(&c, &segment, &state) == STICKSLIP_OK);
    advance(block, {0.1, n, then, a, b}, at);
    REQUIRE(state.rotation == at.rotation);
    REQUIRE(state.rate == at.rate);
    REQUIRE(state.mode == static_cast<double>(at.mode));
    REQUIRE(state.overturned == static_cast<double>(at.overturned));
    REQUIRE(state.displacement == at.displacement);
    REQUIRE(state.velocity == at.velocity);
    REQUIRE(state.climb == at.climb);
    ++spent[static_cast<std::size_t>(static_cast<int>(at.mode) + 1)];
  }
  return spent;
}

}  // namespace

TEST_CASE("the C interface moves slender blocks to the same bits") {
  const SlenderBlock block(2, 0.2, 0.15, 0.9);
  const stickslip_slender_block c = {2, 0.2, 0.15, 0.9};
  const std::array<int, 5> spent = check_same_bits(block, c, stickslip_advance_slender_block, 0.6, 1);
  for (const int samples : {spent[0], spent[1], spent[2]}) CHECK(samples > 10);  // it rocks on both corners, and rests
}

TEST_CASE("the C interface moves rigid blocks to the same bits") {
  RockingBlockSize size{.width = 0.5, .height = 1.2, .mu = 0.35};
  stickslip_rocking_block c = {};
  c.width = 0.5, c.height = 1.2, c.mu = 0.35;
  SECTION("that slide and fly") {
    const std::array<int, 5> spent = check_same_bits(RockingBlock(size), c, stickslip_advance_rocking_block, 2, 12);
    CHECK(spent[3] > 50);
    CHECK(spent[4] > 50);
  }
  SECTION("that rock and slip") {
    size.mu = c.mu = 0.5;
    const std::array<int, 5> spent = check_same_bits(RockingBlock(size), c, stickslip_advance_rocking_block, 1.5, 6);
    CHECK(spent[0] > 50);
    CHECK(spent[2] > 50);
  }
  SECTION("that never slip, with a center of mass beside the middle and a given restitution") {
    size = {.width = 0.5, .height = 1.2, .restitution = 0.9, .center = std::pair(0.05, 0.5), .gyration_radius = 0.4};
    c = {0.5, 1.2, 0, 0.9, 0.05, 0.5, 0.4};
    const std::array<int, 5> spent = check_same_bits(RockingBlock(size), c, stickslip_advance_rocking_block, 1.8, 0);
    CHECK(spent[0] > 50);
    CHECK(spent[2] > 50);
  }
}

TEST_CASE("the C interface refuses what no block can be") {
  const stickslip_segment segment = {0.1, 0, 0, 0, 0};
  stickslip_slender_block slender = {2, 0.2, 0, 0.9};
  stickslip_rocking_state state = {};
  const auto refused = [&](const char* text) {
    const stickslip_rocking_state before = state;
    CHECK(stickslip_advance_slender_block(&slender, &segment, &state) == STICKSLIP_INVALID_ARGUMENT);
    CHECK_THAT(std::string(stickslip_message()), ContainsSubstring(text));
    CHECK(state.rotation == before.rotation);
  };
  state.rotation = 0.1;  // without a mode
  refused("mode");
  state.mode = -1;
  refused("mode");
  state.mode = 0.5;
  refused("whole number");
  state.mode = 1;
  REQUIRE(stickslip_advance_slender_block(&slender, &segment, &state) == STICKSLIP_OK);
  CHECK(state.rotation < 0.1);
  state.rise = std::nan("");
  refused("finite");
  state = {};
  slender.restitution = 2;
  refused("restitution");
  state.mode = 2;  // a slender block does not slide
  refused("from -1 to 1");

  const stickslip_rocking_block rigid = {0.5, -1, 0, 0, 0, 0, 0};
  state = {};
  CHECK(stickslip_advance_rocking_block(&rigid, &segment, &state) == STICKSLIP_INVALID_ARGUMENT);
  CHECK_THAT(std::string(stickslip_message()), ContainsSubstring("height"));
  CHECK(stickslip_advance_rocking_block(&rigid, nullptr, &state) == STICKSLIP_INVALID_ARGUMENT);
  CHECK(stickslip_advance_rocking_block(nullptr, &segment, &state) == STICKSLIP_INVALID_ARGUMENT);
}
