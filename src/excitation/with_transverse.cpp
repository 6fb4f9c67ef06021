#include "stickslip/excitation/with_transverse.hpp"

#include <array>
#include <cstddef>
#include <vector>

#include "excitation/join.hpp"
#include "stickslip/excitation/random.hpp"

namespace stickslip::detail {

std::uint64_t transverse_seed(std::uint64_t seed) {
  constexpr std::uint32_t purpose = 0x7472616e;  // "tran"
  std::array<std::uint32_t, 2> words{};
  random_words({seed, 0, purpose}, 0, words);
  return words[0] | (std::uint64_t{words[1]} << 32);
}

GroundMotion with_transverse(GroundMotion horizontal, const TransverseWeights& weights,
                             const std::function<GroundMotion()>& transverse) {
  if (horizontal.has_transverse())
    throw std::invalid_argument(
        "WithTransverse: the horizontal excitation must make motions without a transverse component, got one that has "
        "it");
  std::vector<double> across(horizontal.samples(), 0.0);
  if (weights.transverse > 0) {
    auto joined = join(std::move(horizontal), transverse(), "WithTransverse", "transverse");
    horizontal = std::move(joined.motion);
    across = std::move(joined.other);
  }
  const auto along = horizontal.acceleration();
  for (std::size_t i = 0; i < across.size(); ++i)
    across[i] = weights.ratio * (weights.horizontal * along[i] + weights.transverse * across[i]);
  return horizontal.with_components(std::move(across), {horizontal.vertical().begin(), horizontal.vertical().end()});
}

}  // namespace stickslip::detail
