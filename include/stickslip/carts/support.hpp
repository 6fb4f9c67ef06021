// What a cart stands on: swivel casters, fixed wheels and feet.
#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <variant>

#include "stickslip/base/vector2.hpp"

namespace stickslip {

/// A wheel that trails a pivot about which it swivels without friction.
///
/// The heading is the angle of the direction e from the contact of the wheel to its pivot: 0 trails while the cart moves
/// along its axis. (The thesis counts the opposite direction.) Angles are positive from the axis toward the transverse
/// direction. With V the velocity of the pivot, n the direction e turned by +90 degrees and N the load, for any path of the
/// pivot
///     psi' = V.n / reach,   F = -side_mu N sgn(V.n) n - rolling_mu N sgn(V.e) e:
/// a fixed wheel whose direction follows a tractrix. Its mass and the friction of its swivel are neglected, and so is the
/// part of mu N that rolling uses, of order (rolling_mu/mu)^2.
struct SwivelCaster {
  Vector2 at{};                   ///< the pivot, in the cart's frame [m], finite
  double heading = 0;             ///< at the start, relative to the cart [rad], finite
  double side_mu = 0;             ///< friction across the wheel over its load, mu s: at least 0, finite
  double reach = 0;               ///< over which the wheel aligns with its path [m]: positive, or infinite
  double rolling_mu = 0;          ///< rolling resistance over the load: at least 0, finite
  std::optional<double> share{};  ///< of the weight of the cart: at least 0

  /// From the mechanics of a rigid wheel, as Caster::from_geometry.
  /// @param mu           coefficient of friction between wheel and floor, finite and at least 0
  /// @param trail        from the pivot to the axis of the wheel [m], positive and finite
  /// @param wheel_width  of the line of contact [m], positive and finite
  /// @throws std::invalid_argument  naming the value
  static SwivelCaster from_geometry(Vector2 at, double heading, double mu, double trail, double wheel_width,
                                    double rolling_mu = 0);
  /// Measured on a push across the wheel, as Caster.
  /// @param slip_level  friction across the wheel per unit mass that it carries [m/s^2]
  static SwivelCaster from_slip_level(Vector2 at, double heading, double slip_level, double reach,
                                      double rolling_mu = 0);
  /// A wheel that cannot roll and swivels freely: a stick dragged behind the pivot.
  static SwivelCaster with_locked_wheel(Vector2 at, double heading, double mu, double trail) {
    return {at, heading, 0, trail, mu};
  }

  friend bool operator==(const SwivelCaster&, const SwivelCaster&) = default;
};

/// A wheel without swivel: F = -mu N sgn(V.n) n - rolling_mu N sgn(V.d) d, with d its direction and n across it. Its
/// resistance to turning on the spot, at most mu N times a quarter of its width, is left out.
struct FixedWheel {
  Vector2 at{};           ///< in the cart's frame [m], finite
  double heading = 0;     ///< of d, relative to the cart [rad], finite
  double mu = 0;          ///< at least 0, finite
  double rolling_mu = 0;  ///< at least 0, finite
  std::optional<double> share{};

  friend bool operator==(const FixedWheel&, const FixedWheel&) = default;
};

/// What does not roll: F = -mu N V/|V| while it slides, any |F| <= mu N at rest. A foot, or a caster whose wheel and swivel are
/// both locked.
struct Foot {
  Vector2 at{};   ///< in the cart's frame [m], finite
  double mu = 0;  ///< at least 0, finite
  std::optional<double> share{};

  /// A caster whose wheel and swivel are locked: a foot where its wheel touches the floor, behind its pivot.
  static Foot of_locked_caster(Vector2 at, double heading, double mu, double trail) {
    return {at - trail * Vector2{std::cos(heading), std::sin(heading)}, mu};
  }

  friend bool operator==(const Foot&, const Foot&) = default;
};

using Support = std::variant<SwivelCaster, FixedWheel, Foot>;

namespace detail {

/// Throw if a number of a support is out of range.
/// @param who  begins the message
void check_support(const std::string& who, const Support& support);

}  // namespace detail

}  // namespace stickslip
