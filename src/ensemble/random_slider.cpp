#include "stickslip/ensemble/random_slider.hpp"

#include <cassert>

#include "stickslip/excitation/random.hpp"

namespace stickslip::detail {

void draw(std::span<const Distribution> distributions, std::uint64_t seed, std::uint64_t member,
          std::span<double> values) {
  assert(distributions.size() == values.size());
  constexpr std::uint32_t purpose = 0x70617261;  // "para"
  uniforms({seed, member, purpose}, values);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = quantile(distributions[i], values[i]);
}

std::string describe_random(std::span<const Distribution> distributions, const std::vector<std::string>& sliders) {
  std::string text, quartiles;
  for (const Distribution& distribution : distributions) text += (text.empty() ? "" : ", ") + describe(distribution);
  for (const std::string& slider : sliders) quartiles += (quartiles.empty() ? "" : ", ") + slider;
  return "{\"random\": [" + text + "], \"quartiles\": [" + quartiles + "]}";
}

}  // namespace stickslip::detail
