// What makes sliders and ground motions the same, in words.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <typeinfo>
#include <variant>
#include <vector>

#include "stickslip/friction/caster.hpp"
#include "stickslip/friction/coulomb.hpp"
#include "stickslip/friction/law.hpp"
#include "stickslip/ground/ground_motion.hpp"
#include "stickslip/slider.hpp"
#include "stickslip/viscous.hpp"

namespace stickslip::detail {

/// What the motion of a slider depends on, as JSON.
std::string describe(const Coulomb& law, double natural_frequency);
std::string describe(const Caster& law, double natural_frequency);
/// A law of somebody's own: its type and a few of its levels.
std::string describe(const char* type, std::span<const double> levels, double natural_frequency);
template <FrictionLaw Law>
std::string describe(const Law& law, double natural_frequency) {
  double levels[10];
  for (int i = 0; i < 10; ++i)
    levels[i] = law.level(0.1 * ((i / 2) - 2), i % 2 == 0 ? Direction::forward : Direction::backward);
  return describe(typeid(Law).name(), levels, natural_frequency);
}
template <FrictionLaw Law>
std::string describe(const Slider<Law>& slider) {
  return describe(slider.law(), slider.natural_frequency());
}
std::string describe(const ViscousSlider& slider);
template <class... Sliders>
std::string describe(const std::variant<Sliders...>& slider) {
  return std::visit([](const auto& one) { return describe(one); }, slider);
}

/// Of a list in which a member has one place.
/// @param order  "in turn" or "drawn"
std::string describe_list(const std::vector<std::string>& sliders, const char* order);
/// Motions by their number and a digest of their samples, times and interpolation; names do not matter.
std::string describe_list(std::span<const GroundMotion> motions, const char* order);

}  // namespace stickslip::detail
