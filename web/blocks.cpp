// Blocks that rock, for the page; see exports.hpp.
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include "exports.hpp"
#include "stickslip/rocking/integrate.hpp"
#include "stickslip/rocking/response.hpp"
#include "stickslip/rocking/rocking_block.hpp"
#include "stickslip/rocking/slender_block.hpp"

namespace {

using namespace stickslip;
using namespace stickslip::web;

/// A uniform block by its size: rigid with a coefficient of friction, otherwise slender. NaN is an option that is not given.
struct BlockSettings {
  double width, height, mu, restitution, vertical, scale;
};
constexpr const char* setting_names = "width height mu restitution vertical scale";

struct BlockSummary {
  double peak_rotation, peak_ratio, overturned, overturned_at, impacts, uplifts, liftoffs, residual, sliding_distance;
  double time_rocking, p, alpha, restitution, margin, condition, impacts_with_slip, at_rest, events, samples;
  double input, imbalance, pga;
};
constexpr const char* summary_names =
    "peak_rotation peak_ratio overturned overturned_at impacts uplifts liftoffs residual sliding_distance time_rocking "
    "p alpha restitution margin condition impacts_with_slip at_rest events samples input imbalance pga";

/// Calls `use(block)`.
template <class Use>
void with_block(const BlockSettings& s, Use&& use) {
  if (!std::isnan(s.mu))
    use(RockingBlock({.width = s.width, .height = s.height, .mu = s.mu, .restitution = if_given(s.restitution)}));
  else
    use(SlenderBlock::from_size(s.width, s.height, if_given(s.restitution)));
}

double frequency_parameter(const SlenderBlock& block) { return block.p(); }
double frequency_parameter(const RockingBlock& block) { return block.p_right(); }
double restitution(const SlenderBlock& block) { return block.restitution(); }
double restitution(const RockingBlock& block) { return block.restitution_right(); }

/// The response until it rests or falls; to the end of the motion if it never rests, as the command reports it.
template <class Block>
RockingResponse settled(const Block& block, const GroundMotion& motion) {
  bool settles = restitution(block) < 1;
  if constexpr (std::is_same_v<Block, RockingBlock>) settles = settles && block.mu() > 0;
  return integrate(block, motion, {.settle = settles});
}

RockingResponse response;
std::vector<double> ground;

}  // namespace

extern "C" {

STICKSLIP_EXPORT(block_names) void block_names() { say_names(setting_names, summary_names); }

/// Rocks. The input is the settings.
/// @return 0; `numbers` is the summary, and `block_history` has the histories
STICKSLIP_EXPORT(rock) int rock(int number) {
  return guarded([&] {
    const auto settings = given_settings<BlockSettings>();
    const GroundMotion motion = driven(settings, of(number).motion);
    with_block(settings, [&](const auto& block) {
      response = settled(block, motion);
      const RockingResponse& r = response;
      ground.assign(motion.acceleration().begin(), motion.acceleration().end());
      answer_with_summary(BlockSummary{.peak_rotation = r.peak,
                                       .peak_ratio = r.peak_ratio,
                                       .overturned = static_cast<double>(r.overturned),
                                       .overturned_at = r.overturned_at,
                                       .impacts = static_cast<double>(r.impacts),
                                       .uplifts = static_cast<double>(r.uplifts),
                                       .liftoffs = static_cast<double>(r.liftoffs),
                                       .residual = r.residual,
                                       .sliding_distance = r.sliding_distance,
                                       .time_rocking = r.time_rocking,
                                       .p = frequency_parameter(block),
                                       .alpha = block.alpha(),
                                       .restitution = restitution(block),
                                       .margin = r.margin,
                                       .condition = r.condition,
                                       .impacts_with_slip = static_cast<double>(r.impacts_with_slip),
                                       .at_rest = r.state.mode == RockingMode::rest ? 1.0 : 0.0,
                                       .events = static_cast<double>(r.events.size()),
                                       .samples = static_cast<double>(r.rotation.size()),
                                       .input = r.energy.input,
                                       .imbalance = r.energy.imbalance(),
                                       .pga = motion.peak_acceleration()});
    });
    return 0;
  });
}

/// The largest rotation over alpha, infinite where it overturns, for each number that follows the settings in the input:
/// heights of blocks of the same shape, or coefficients of friction. NaN where the block is refused.
STICKSLIP_EXPORT(rock_over) int rock_over(int number, int of_mu) {
  return guarded([&] {
    auto settings = given_settings<BlockSettings>();
    const GroundMotion motion = driven(settings, of(number).motion);
    const double slenderness = settings.width / settings.height;
    answer.clear();
    for (const double value : given_numbers<BlockSettings>()) {
      if (of_mu != 0)
        settings.mu = value;
      else
        settings.height = value, settings.width = slenderness * value;
      try {
        with_block(settings, [&](const auto& block) { answer.push_back(settled(block, motion).peak_ratio); });
      } catch (const std::exception&) {  // its friction decides nothing, or it would leave the ground
        answer.push_back(undefined);
      }
    }
    return 0;
  });
}

/// What `rock` found: 0 the rotation [rad], 1 its rate [rad/s], 2 and 3 the displacement of the base and of the top [m], 4 the
/// height above the ground [m], 5 the ground acceleration [m/s^2], 6 time, rotation, rate and kind of each event.
STICKSLIP_EXPORT(block_history) void block_history(int which) {
  answer.clear();
  switch (which) {
    case 0:
      return answer_with(response.rotation);
    case 1:
      return answer_with(response.rate);
    case 2:
      return answer_with(response.displacement);
    case 3:
      return answer_with(response.top_displacement);
    case 4:
      return answer_with(response.gap);
    case 5:
      return answer_with(ground);
    case 6:
      for (const RockingEvent& event : response.events)
        answer.insert(answer.end(),
                      {event.time, event.rotation, event.rate, static_cast<double>(static_cast<int>(event.kind))});
      return;
  }
}

}  // extern "C"
