#include "stickslip/ensemble/one_of.hpp"

#include <algorithm>
#include <cmath>

#include "stickslip/excitation/random.hpp"

namespace stickslip::detail {

std::optional<TimeBase> common_time_base(std::span<const GroundMotion> motions) {
  TimeBase base{motions[0].duration(), std::isnan(motions[0].dt()) ? 0 : motions[0].dt()};
  for (const GroundMotion& motion : motions) {
    if (!(std::abs(motion.duration() - base.duration) <= 1e-9 * base.duration)) return std::nullopt;
    if (motion.dt() != base.dt) base.dt = 0;
  }
  return base;
}

std::size_t drawn_place(std::uint64_t seed, std::uint64_t member, bool of_motions, std::size_t length) {
  const std::uint32_t purpose = of_motions ? 0x72656373 : 0x736c6964;  // "recs", "slid"
  double uniform = 0;
  uniforms({seed, member, purpose}, {&uniform, 1});
  return std::min(static_cast<std::size_t>(uniform * static_cast<double>(length)), length - 1);
}

std::string describe_list(const std::vector<std::string>& sliders, const char* order) {
  std::string text;
  for (const std::string& slider : sliders) text += (text.empty() ? "" : ", ") + slider;
  return "{\"one_of\": [" + text + "], \"order\": \"" + order + "\"}";
}

std::string describe_list(std::span<const GroundMotion> motions, const char* order) {
  return "{\"motions\": " + std::to_string(motions.size()) + ", \"digest\": \"" + identity(motions) +
         "\", \"order\": \"" + order + "\"}";
}

}  // namespace stickslip::detail
