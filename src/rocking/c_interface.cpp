// The C interface of blocks that rock.
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "c_interface.hpp"
#include "stickslip/base/equal.hpp"
#include "stickslip/base/error.hpp"
#include "stickslip/rocking/integrate.hpp"
#include "stickslip/rocking/rocking_block.hpp"
#include "stickslip/rocking/slender_block.hpp"
#include "stickslip/rocking/state.hpp"
#include "stickslip/stickslip.h"

namespace stickslip {
namespace {

SlenderBlock block_of(const stickslip_slender_block& b) {
  return {b.p, b.alpha, detail::equal(b.alpha_left, 0) ? b.alpha : b.alpha_left, b.restitution};
}

// What is 0 is left out.
std::optional<double> given(double value) { return detail::equal(value, 0) ? std::nullopt : std::optional(value); }

RockingBlock block_of(const stickslip_rocking_block& b) {
  RockingBlockSize size{.width = b.width,
                        .height = b.height,
                        .mu = given(b.mu),
                        .restitution = given(b.restitution),
                        .gyration_radius = given(b.gyration_radius)};
  if (given(b.center_offset) || given(b.center_height))
    size.center = std::pair(b.center_offset, given(b.center_height).value_or(b.height / 2));
  return RockingBlock(size);
}

RockingState state_of(const stickslip_rocking_state& s, int highest_mode) {
  const char* const wrong =
      "stickslip_rocking_state: mode must be that of the rotation: 1 where it is positive, -1 "
      "where it is negative, 0 with neither rotation nor rate; mode";
  for (const double value : {s.displacement, s.velocity, s.rise, s.climb})
    detail::require(std::isfinite(value), "stickslip_rocking_state: its members must be finite", value);
  const auto mode = detail::whole<RockingMode>(s.mode, -1, highest_mode, "stickslip_rocking_state: mode");
  const auto overturned = detail::whole<std::int8_t>(s.overturned, -1, 1, "stickslip_rocking_state: overturned");
  const bool tilts = std::abs(s.rotation) > 0;
  if (mode == RockingMode::left || mode == RockingMode::right)
    detail::require(!(s.mode * s.rotation < 0) && (tilts || std::abs(s.rate) > 0), wrong, s.mode);
  else if (mode != RockingMode::flight)
    detail::require(!tilts && !(std::abs(s.rate) > 0), wrong, s.mode);
  return {s.rotation,
          s.rate,
          mode,
          overturned,
          detail::whole<std::int8_t>(s.slip, -1, 1, "stickslip_rocking_state: slip"),
          s.displacement,
          s.velocity,
          s.rise,
          s.climb};
}

template <class Block>
int step(const Block* block, const stickslip_segment* segment, stickslip_rocking_state* state,
         int highest_mode) noexcept {
  return detail::c_status_of([&] {
    detail::require_pointer(block, "block");
    detail::require_pointer(segment, "segment");
    detail::require_pointer(state, "state");
    RockingState at = state_of(*state, highest_mode);
    const auto checked = block_of(*block);
    if (!(segment->duration > 0) && std::isfinite(segment->duration)) return;
    advance(checked, {segment->duration, segment->start, segment->end, segment->vertical_start, segment->vertical_end},
            at);
    *state = {at.rotation,
              at.rate,
              static_cast<double>(at.mode),
              static_cast<double>(at.overturned),
              static_cast<double>(at.slip),
              at.displacement,
              at.velocity,
              at.rise,
              at.climb};
  });
}

}  // namespace
}  // namespace stickslip

extern "C" {

int stickslip_advance_slender_block(const stickslip_slender_block* block, const stickslip_segment* segment,
                                    stickslip_rocking_state* state) {
  return stickslip::step(block, segment, state, 1);
}

int stickslip_advance_rocking_block(const stickslip_rocking_block* block, const stickslip_segment* segment,
                                    stickslip_rocking_state* state) {
  return stickslip::step(block, segment, state, 3);
}

}  // extern "C"
