#include "stickslip/excitation/with_vertical.hpp"

#include <array>

#include "excitation/join.hpp"
#include "stickslip/excitation/random.hpp"

namespace stickslip::detail {

std::uint64_t vertical_seed(std::uint64_t seed) {
  constexpr std::uint32_t purpose = 0x76657274;  // "vert"
  std::array<std::uint32_t, 2> words{};
  random_words({seed, 0, purpose}, 0, words);
  return words[0] | (std::uint64_t{words[1]} << 32);
}

GroundMotion with_vertical(GroundMotion horizontal, const GroundMotion& vertical, double ratio) {
  if (horizontal.has_vertical())
    throw std::invalid_argument(
        "WithVertical: the horizontal excitation must make motions without a vertical component, got one that has it");
  auto [motion, up] = join(std::move(horizontal), vertical, "WithVertical", "vertical");
  for (double& a : up) a *= ratio;
  return motion.with_components({motion.transverse().begin(), motion.transverse().end()}, std::move(up));
}

}  // namespace stickslip::detail
