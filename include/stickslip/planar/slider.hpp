// A mass that slides in two horizontal directions.
#pragma once

#include <concepts>
#include <stdexcept>
#include <string>
#include <utility>

#include "stickslip/base/equal.hpp"
#include "stickslip/friction/law.hpp"
#include "stickslip/planar/state.hpp"
#include "stickslip/slider/slider.hpp"
#include "stickslip/state/state.hpp"

namespace stickslip {

/// A law that can be the same in all directions: its levels depend on speed, sliding distance and temperature, not on
/// the place. `isotropic()` says whether its levels are equal in both directions. In the plane it is asked for
/// Direction::forward, with the path length in place of x.
template <class Law>
concept IsotropicLaw = FrictionLaw<Law> && requires(const Law& law) {
  { law.isotropic() } -> std::convertible_to<bool>;
};

/// A mass on friction that slides in the plane, with an optional spring, damper and circular stop, on level or sloping
/// ground. Friction opposes the velocity vector:
///     r'' + resist N+/g r'/|r'| + c r' + wn^2 r = p(t),
///     p = ((g + a_z) sin(slope) - n cos(slope), -t),   N = (g + a_z) cos(slope) + n sin(slope),   N+ = max(N, 0)
/// r the displacement relative to the ground [m], with its components along the axis of the ground motion (on a slope:
/// downhill) and along its transverse direction, 90 degrees clockwise from the axis; n, t and a_z the ground
/// acceleration along the axis, along the transverse direction and upward [m/s^2]. At rest it stays while
///     |p - wn^2 r| <= hold N+/g.
/// A circular stop at |r| = gap reflects the radial velocity, times its restitution. The stop itself has no friction.
template <IsotropicLaw Law>
class PlanarSlider {
 public:
  /// @param law       the friction law, the same in all directions
  /// @param mounting  spring, damper, slope, and stops with equal gaps
  /// @throws std::invalid_argument  as Slider; also a law whose levels are not equal in all directions, `one_way`, and
  ///                                stops with unequal gaps
  explicit PlanarSlider(Law law, const Mounting& mounting = {}) : PlanarSlider(Slider<Law>(std::move(law), mounting)) {}

  /// The same law and mounting in the plane.
  explicit PlanarSlider(Slider<Law> slider) : slider_(std::move(slider)) {
    if (!slider_.law().isotropic())
      throw std::invalid_argument(
          "PlanarSlider: the friction law must be the same in all directions; this one has different levels forward "
          "and backward");
    const Mounting& on = slider_.mounting();
    if (on.one_way) throw std::invalid_argument("PlanarSlider: one_way has no meaning in the plane");
    if (!detail::equal(on.stops.forward(), on.stops.backward()))
      throw std::invalid_argument("PlanarSlider: a circular stop has one gap; got stops with gaps of " +
                                  detail::shortest(on.stops.forward()) + " m forward and " +
                                  detail::shortest(on.stops.backward()) + " m backward");
  }

  /// The same law and mounting on one axis.
  const Slider<Law>& along_axis() const noexcept { return slider_; }
  const Law& law() const noexcept { return slider_.law(); }
  const Mounting& mounting() const noexcept { return slider_.mounting(); }
  double natural_frequency() const noexcept { return slider_.natural_frequency(); }
  double stiffness() const noexcept { return slider_.stiffness(); }  ///< wn^2 [1/s^2]
  double damping() const noexcept { return slider_.damping(); }      ///< c [1/s]
  double slope() const noexcept { return slider_.slope(); }          ///< [rad]

 private:
  Slider<Law> slider_;
};

namespace detail {

/// The state of which an isotropic law is a function: at the beginning of a path.
template <IsotropicLaw Law>
State on_path(const PlanarState& state) noexcept {
  State start{.sliding_distance = state.sliding_distance};
  if constexpr (HeatedLaw<Law>) start.heat = state.heat;
  return start;
}

/// What friction holds at rest, and what resists sliding at a speed [m/s], under a normal force of `weight` times g,
/// divided by the weight [m/s^2].
template <IsotropicLaw Law>
double hold_at(const PlanarSlider<Law>& slider, const PlanarState& state, double weight = 1) {
  return hold(law_at(slider.law(), on_path<Law>(state), weight), 0.0, Direction::forward);
}
template <IsotropicLaw Law>
double resist_at(const PlanarSlider<Law>& slider, const PlanarState& state, double weight, double speed) {
  return resist(law_at(slider.law(), on_path<Law>(state), weight), 0.0, speed, Direction::forward);
}

}  // namespace detail

}  // namespace stickslip
