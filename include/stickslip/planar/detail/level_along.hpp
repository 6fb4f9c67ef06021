// The level of friction during a slip in the plane.
#pragma once

#include <cmath>

#include "stickslip/base/vector2.hpp"
#include "stickslip/friction/law.hpp"
#include "stickslip/planar/detail/held_slip.hpp"
#include "stickslip/planar/detail/path_series.hpp"
#include "stickslip/planar/path.hpp"

namespace stickslip::detail {

/// The resistance of an isotropic law as a function of the path length and of the time since the start of a flow, and
/// of the speed.
template <class Law, class Path, class Speed, class Time>
auto level_along(const Law& law, const Path& path, const Speed& speed, const Time& time) {
  if constexpr (requires { law.resist_at(time, speed); })
    return law.resist_at(time, speed);
  else
    return resist(law, path, speed, Direction::forward);
}

/// Whether the level depends on time, by the heat of a step, and how well it is then known.
template <class Law>
inline constexpr bool heated_step = requires(const Law& law) {
  law.resist_at(0.0, 0.0);
};
inline constexpr double level_error = 1e-9;

/// Shorten a series until its level is that of the law at its end: a high power of the speed may only act in terms that
/// were cut.
template <class Law>
void keep_to(PlanarPath& path, const Law& law) noexcept {
  constexpr double exact = heated_step<Law> ? level_error : 0x1p-47;
  for (int halvings = 0; halvings < 60; ++halvings, path.last /= 2) {
    const double level = path.series.level(path.last);
    const PlanarProgress end = path.at_parameter(path.last);
    const double weight = path.load.weight + path.load.weight_rate * end.time;
    const double actual = weight * level_along(law, end.distance, norm(end.velocity), end.time);
    if (!(std::abs(level - actual) > exact * (std::abs(level) + std::abs(path.series.l[0])))) return;
  }
}

}  // namespace stickslip::detail
