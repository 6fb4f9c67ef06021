// A mass with friction, and its mounting: spring, damper, slope and stops.
#pragma once

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include "stickslip/base/equal.hpp"
#include "stickslip/base/error.hpp"
#include "stickslip/base/units.hpp"
#include "stickslip/friction/law.hpp"
#include "stickslip/slider/spring.hpp"
#include "stickslip/slider/stops.hpp"

namespace stickslip {

/// The mounting of a mass, in addition to friction. All parts are optional.
struct Mounting {
  double natural_frequency = 0;  ///< wn, of the spring and the mass without friction [rad/s], finite and at least 0
  double damping = 0;            ///< c, of the damper per unit mass [1/s], finite and at least 0; 2 wn damping ratio
  double slope_degrees = 0;      ///< of the ground, forward is downhill [degrees], from 0 to less than 90
  bool one_way = false;          ///< never slides backward
  Stops stops{};                 ///< limits of the displacement
  bool pendulum = false;         ///< the spring is a pendulum: its force is wn^2 x N+ / g

  /// wn^2, spring stiffness per unit mass [1/s^2].
  double stiffness() const noexcept { return natural_frequency * natural_frequency; }
  Spring spring() const noexcept { return {stiffness(), pendulum}; }
  /// Slope of the ground [rad].
  double slope() const noexcept { return slope_degrees * (std::numbers::pi / 180); }

  friend bool operator==(const Mounting&, const Mounting&) = default;
};

/// A mass on friction, with an optional spring, damper and stops, on level or sloping ground:
///     x'' + resist N+/g sgn(x') + c x' + wn^2 x = p(t),                              thesis (2.27), (2.50), (4.2)
///     p = (g + a_z) sin(slope) - n cos(slope),   N = (g + a_z) cos(slope) + n sin(slope),   N+ = max(N, 0)
/// x the displacement relative to the ground [m], along the slope and positive downhill; n and a_z the horizontal and
/// the upward ground acceleration [m/s^2]. On level ground without vertical motion p = -n and N = g. At rest
/// it stays while
///     -hold_backward N+/g <= p - wn^2 x <= hold_forward N+/g.
template <class Law>
class Slider {
  static_assert(!detail::LawWithDirectionBeforeSpeed<Law>,
                "friction law: the order of arguments is resist(x, speed, direction)");
  static_assert(
      FrictionLaw<Law> || detail::LawWithDirectionBeforeSpeed<Law>,
      "friction law: must be copyable and define `resist(x, direction) const` or `resist(x, speed, direction) "
      "const`, with doubles or template parameters for x and speed, or at, ahead and pass of a law with "
      "memory; see stickslip/friction/law.hpp");

 public:
  /// @param law                the friction law
  /// @param natural_frequency  wn, of the spring and the mass without friction [rad/s], finite and at least 0; 0 is no
  ///                           spring
  /// @param damping            c, of the damper per unit mass [1/s], finite and at least 0; 2 wn times the
  ///                           damping ratio; its square is finite
  /// @throws std::invalid_argument naming the value
  explicit Slider(Law law, double natural_frequency = 0, double damping = 0)
      : Slider(std::move(law), Mounting{natural_frequency, damping}) {}

  /// @param law       the friction law
  /// @param mounting  spring, damper, slope and stops
  /// @throws std::invalid_argument naming the value; also if the slider would slide under its own weight without
  ///                  a spring or stop to hold it
  Slider(Law law, const Mounting& mounting) : law_(std::move(law)), mounting_(with_law(law_, mounting)) {
    mounting_.natural_frequency += 0.0;  // minus zero is zero
    mounting_.damping += 0.0;
    detail::require(std::isfinite(stiffness()) && natural_frequency() >= 0,
                    "Slider: natural_frequency must be finite and at least 0", natural_frequency(), "rad/s");
    detail::require(std::isfinite(damping() * damping()) && damping() >= 0,
                    "Slider: damping and its square must be finite and at least 0", damping(), "1/s");
    const double degrees = mounting_.slope_degrees;
    detail::require(degrees >= 0 && degrees < 90, "Slider: slope_degrees must be from 0 to less than 90", degrees,
                    "degrees");
    if (degrees > 0 && detail::equal(stiffness(), 0) && !std::isfinite(mounting_.stops.forward())) {
      const double steepest = std::tan(slope()), holds = hold(law_at(law_, State{}), 0, Direction::forward);
      detail::require(holds >= steepest * standard_gravity,
                      "Slider: on a slope of " + detail::shortest(degrees) +
                          " degrees it slides under its own weight unless mu is at least " + detail::shortest(steepest),
                      holds / standard_gravity);
    }
    if (mounting_.pendulum && !(stiffness() > 0))
      throw std::invalid_argument("Slider: a pendulum needs a natural_frequency, sqrt(g / radius)");
  }

  /// A slider in cups, thesis (2.49) as corrected: each wheel stands in a bowl, which makes the slider a pendulum
  /// with a length equal to the radius of the bowl minus that of the wheel,
  ///     wn = sqrt(g / (cup_radius - wheel_radius))
  /// to first order in x / (cup_radius - wheel_radius); the next term is of third order.
  /// @param cup_radius    radius of curvature of the bowl [m], finite
  /// @param wheel_radius  of the wheel that rolls in it [m], at least 0 and less than cup_radius; 0, a sliding
  ///                      point, is the case of the thesis
  /// @param damping       as above
  /// @throws std::invalid_argument naming the value
  static Slider in_cup(Law law, double cup_radius, double wheel_radius = 0, double damping = 0) {
    detail::require(std::isfinite(cup_radius) && cup_radius > 0, "Slider: cup_radius must be positive and finite",
                    cup_radius, "m");
    detail::require(
        wheel_radius >= 0 && wheel_radius < cup_radius,
        "Slider: wheel_radius must be at least 0 and less than the cup's " + detail::shortest(cup_radius) + " m",
        wheel_radius, "m");
    return Slider(std::move(law), std::sqrt(standard_gravity / (cup_radius - wheel_radius)), damping);
  }

  /// A friction pendulum: a slider on a spherical dish, whose restoring force is the component of the normal force
  /// along the dish, N+ x / radius.
  ///     wn = sqrt(g / radius)
  /// Linear in x; valid for |x| up to 0.2 radius, where the next term is 2 %.
  /// @param radius    effective radius of curvature of the dish [m], positive and finite
  /// @param mounting  damper, stops; its spring is replaced
  /// @throws std::invalid_argument naming the value
  static Slider friction_pendulum(Law law, double radius, Mounting mounting = {}) {
    detail::require(std::isfinite(radius) && radius > 0, "Slider: radius must be positive and finite", radius, "m");
    mounting.natural_frequency = std::sqrt(standard_gravity / radius);
    mounting.pendulum = true;
    return Slider(std::move(law), mounting);
  }

  /// The same mounting with the law that applies from a given state.
  auto at(const State& state) const requires MemoryLaw<Law> {
    using Now = Slider<decltype(law_.at(state))>;
    return Now(law_.at(state), mounting_, typename Now::Unchecked{});
  }

  const Law& law() const noexcept { return law_; }
  const Mounting& mounting() const noexcept { return mounting_; }
  double natural_frequency() const noexcept { return mounting_.natural_frequency; }

  /// wn^2, spring stiffness per unit mass [1/s^2].
  double stiffness() const noexcept { return mounting_.stiffness(); }

  /// c [1/s].
  double damping() const noexcept { return mounting_.damping; }

  /// Slope of the ground [rad].
  double slope() const noexcept { return mounting_.slope(); }

  /// Whether the slider is on level ground, slides both ways and has no stops.
  bool plain() const noexcept { return plain_; }

 private:
  // The law may add stops to a mounting, or refuse it.
  static Mounting with_law(const Law& law, Mounting on) {
    if constexpr (requires { law.mount(on); }) law.mount(on);
    return on;
  }

  template <class>
  friend class Slider;
  struct Unchecked {};
  Slider(Law law, const Mounting& mounting, Unchecked) : law_(std::move(law)), mounting_(mounting) {}

  Law law_;
  Mounting mounting_;
  bool plain_ = detail::equal(mounting_.slope_degrees, 0) && !mounting_.one_way && !mounting_.stops;
};

namespace detail {

/// Throws for a mounting that a function without vertical motion does not cover. (A pendulum is then a spring.)
inline void require_plain_mounting(const Mounting& on, std::string_view function) {
  if (!equal(on.slope_degrees, 0) || on.one_way || on.stops)
    throw std::invalid_argument(std::string(function) +
                                ": covers sliders on level ground that slide both ways, without stops");
}

}  // namespace detail
}  // namespace stickslip
