// Forces, margins and the largest loop of sliders of any law.
#include "stickslip/sliding/any_slider.hpp"

namespace stickslip {

template <Motion M>
Forces forces(const AnySlider& slider, const M& motion, const Response& response) {
  return std::visit([&](const auto& one) { return forces(one, motion, response); }, slider);
}
template Forces forces(const AnySlider&, const GroundMotion&, const Response&);
template Forces forces(const AnySlider&, const HarmonicMotion&, const Response&);

template <Motion M>
Margins margins(const AnySlider& slider, const M& motion, const Response& response) {
  return std::visit([&](const auto& one) { return margins(one, motion, response); }, slider);
}
template Margins margins(const AnySlider&, const GroundMotion&, const Response&);
template Margins margins(const AnySlider&, const HarmonicMotion&, const Response&);

template <Motion M>
Loop largest_loop(const AnySlider& slider, const M& motion, const Response& response) {
  return std::visit([&](const auto& one) { return largest_loop(one, motion, response); }, slider);
}
template Loop largest_loop(const AnySlider&, const GroundMotion&, const Response&);
template Loop largest_loop(const AnySlider&, const HarmonicMotion&, const Response&);

}  // namespace stickslip
