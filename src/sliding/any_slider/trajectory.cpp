// The motion of sliders of any law between samples.
#include "stickslip/sliding/any_slider.hpp"

namespace stickslip {

template <Motion M>
std::vector<State> states_at(const AnySlider& slider, const M& motion, const Response& response,
                             std::span<const double> times) {
  return std::visit([&](const auto& one) { return states_at(one, motion, response, times); }, slider);
}
template std::vector<State> states_at(const AnySlider&, const GroundMotion&, const Response&, std::span<const double>);
template std::vector<State> states_at(const AnySlider&, const HarmonicMotion&, const Response&,
                                      std::span<const double>);

}  // namespace stickslip
