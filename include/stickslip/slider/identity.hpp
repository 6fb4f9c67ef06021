// Texts by which sliders and ground motions are compared: in files of ensembles and in checkpoints of sweeps.
#pragma once

#include <functional>
#include <limits>
#include <span>
#include <string>
#include <tuple>
#include <type_traits>
#include <typeinfo>
#include <variant>
#include <vector>

#include "stickslip/base/parts.hpp"
#include "stickslip/friction/law.hpp"
#include "stickslip/friction/static_kinetic.hpp"
#include "stickslip/ground/ground_motion.hpp"
#include "stickslip/slider/slider.hpp"

namespace stickslip {
namespace detail {

/// A member of a JSON object, after a comma; of a list, an array.
std::string json_member(const char* name, double value);
std::string json_member(const char* name, int value);
std::string json_member(const char* name, std::span<const double> values);

/// All parts of an object, as members of a JSON object. A part that lists parts itself is replaced by them.
template <WithParts T>
std::string json_members(const T& value) {
  const auto member = [&](const auto& part) -> std::string {
    const auto& one = std::invoke(part.get, value);
    if constexpr (WithParts<std::remove_cvref_t<decltype(one)>>) {
      return json_members(one);
    } else {
      if constexpr (requires { one < 0.0; })
        if (part.listed == Listed::unless_zero && !(one < 0.0) && !(one > 0.0)) return {};
      return json_member(part.name, one);
    }
  };
  return std::apply([&](const auto&... part) { return (member(part) + ...); }, T::parts());
}

/// A few levels of a law, by which one that lists no parts is known; NaN where it has none.
template <FrictionLaw Law>
std::vector<double> some_levels(const Law& law) {
  std::vector<double> levels;
  const auto add_one = [&](const auto& level) {
    try {
      levels.push_back(level());
    } catch (const NoLevel&) {
      levels.push_back(std::numeric_limits<double>::quiet_NaN());
    }
  };
  const auto add = [&](const auto& now) {
    using Now = std::remove_cvref_t<decltype(now)>;
    for (const Direction direction : {Direction::forward, Direction::backward})
      for (const double x : {-0.2, -0.1, 0.0, 0.1, 0.2}) {
        add_one([&] { return resist(now, x, 0.0, direction); });
        if constexpr (SpeedLaw<Now>)
          for (double speed = 1e-6; speed < 20; speed *= 10) add_one([&] { return resist(now, x, speed, direction); });
        if constexpr (LawWithHold<Now>) add_one([&] { return hold(now, x, direction); });
      }
  };
  add(law_at(law, State{}));
  if constexpr (MemoryLaw<Law>)
    for (double slid = 1e-6; slid < 20; slid *= 10) add(law.at(State{.sliding_distance = slid}));
  return levels;
}

/// A law, as members of a JSON object.
template <FrictionLaw Law>
std::string json_of_law(const Law& law) {
  std::string name = "\"law\": \"";
  if constexpr (requires { Law::class_name; })
    name += Law::class_name;
  else
    name += typeid(Law).name();
  if constexpr (WithParts<Law>)
    return name + '"' + json_members(law);
  else
    return name + '"' + json_member("levels", some_levels(law));
}
std::string json_of_static(double forward, double backward);
template <FrictionLaw Law>
std::string json_of_law(const StaticKinetic<Law>& law) {
  return json_of_static(law.static_forward(), law.static_backward()) + json_of_law(law.sliding());
}

std::string identity(const std::string& law, const Mounting& mounting);

}  // namespace detail

/// Everything that the motion of a slider depends on, as a JSON object: the name and the parameters of its law, and its
/// mounting. A law that does not list its parts is known by its type and by a few of its levels.
template <FrictionLaw Law>
std::string identity(const Slider<Law>& slider) {
  return detail::identity(detail::json_of_law(slider.law()), slider.mounting());
}
template <class... Sliders>
std::string identity(const std::variant<Sliders...>& slider) {
  return std::visit([](const auto& one) { return identity(one); }, slider);
}

/// A digest of the samples of all components of ground motions, their times and interpolation, as 16 hexadecimal
/// digits. Names and orientations do not count.
std::string identity(std::span<const GroundMotion> motions);

}  // namespace stickslip
