// Descriptions of sliders and ground motions, by which they are compared.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <type_traits>
#include <typeinfo>
#include <variant>
#include <vector>

#include "stickslip/friction/caster.hpp"
#include "stickslip/friction/coulomb.hpp"
#include "stickslip/friction/degrading.hpp"
#include "stickslip/friction/function_law.hpp"
#include "stickslip/friction/kumar.hpp"
#include "stickslip/friction/law.hpp"
#include "stickslip/friction/static_kinetic.hpp"
#include "stickslip/friction/stribeck.hpp"
#include "stickslip/friction/velocity_dependent.hpp"
#include "stickslip/ground/ground_motion.hpp"
#include "stickslip/slider.hpp"

namespace stickslip::detail {

/// The parameters of a law, as members of a JSON object.
std::string parameters(const Coulomb& law);
std::string parameters(const Caster& law);
std::string parameters(const VelocityDependent& law);
std::string parameters(const Stribeck& law);
std::string parameters(const Degrading& law);
std::string parameters(const KumarFriction& law);
std::string parameters(const FunctionLaw& law);
template <FrictionLaw Law>
std::string parameters(const StaticKinetic<Law>& law);
std::string parameters_of_static(const std::string& sliding, double forward, double backward);
/// A user-defined law: its type and a few of its levels.
std::string parameters(const char* type, std::span<const double> levels);
template <FrictionLaw Law>
std::vector<double> some_levels(const Law& law) {
  std::vector<double> levels;
  const auto add = [&](const auto& now) {
    using Now = std::remove_cvref_t<decltype(now)>;
    for (const Direction direction : {Direction::forward, Direction::backward})
      for (const double x : {-0.2, -0.1, 0.0, 0.1, 0.2}) {
        levels.push_back(resist(now, x, 0.0, direction));
        if constexpr (SpeedLaw<Now>)
          for (double speed = 1e-6; speed < 20; speed *= 10) levels.push_back(resist(now, x, speed, direction));
        if constexpr (LawWithHold<Now>) levels.push_back(hold(now, x, direction));
      }
  };
  add(law_at(law, State{}));
  if constexpr (MemoryLaw<Law>)
    for (double slid = 1e-6; slid < 20; slid *= 10) add(law.at(State{.sliding_distance = slid}));
  return levels;
}
template <FrictionLaw Law>
std::string parameters(const Law& law) {
  return parameters(typeid(Law).name(), some_levels(law));
}

template <FrictionLaw Law>
std::string parameters(const StaticKinetic<Law>& law) {
  return parameters_of_static(parameters(law.sliding()), law.static_forward(), law.static_backward());
}

/// Everything that the motion of a slider depends on, as JSON.
std::string describe(const std::string& law, const Mounting& mounting);
template <FrictionLaw Law>
std::string describe(const Slider<Law>& slider) {
  return describe(parameters(slider.law()), slider.mounting());
}
template <class... Sliders>
std::string describe(const std::variant<Sliders...>& slider) {
  return std::visit([](const auto& one) { return describe(one); }, slider);
}

/// The description of a list from which each member uses one item.
/// @param order  "in turn" or "drawn"
std::string describe_list(const std::vector<std::string>& sliders, const char* order);
/// Motions by their number and a digest of their samples, times and interpolation; names do not matter.
std::string describe_list(std::span<const GroundMotion> motions, const char* order);

}  // namespace stickslip::detail
