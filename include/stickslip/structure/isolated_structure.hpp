// A structure on a sliding base.
#pragma once

#include "stickslip/structure/sliding_structure.hpp"

namespace stickslip {

/// A structure on a base that slides on the ground; the reference mass is that of base and structure. In the modes of
/// the structure on a fixed base, with mass fractions gamma_j of the sum G,
///     q = -(1 - G) n + sum gamma_j (2 z_j w_j y_j' + w_j^2 y_j) - wn^2 x
///     stuck:    y_j'' + 2 z_j w_j y_j' + w_j^2 y_j = -n
///     sliding:  (1 - G) x'' = q - s F - c x',   y_j'' + 2 z_j w_j y_j' + w_j^2 y_j = -n - x''.
/// An impact on a stop with restitution e changes x' to -e x' and leaves the absolute velocities of the structure as
/// they are; it takes (1 - e^2) (1 - G) x'^2 / 2.
class IsolatedStructure : public SlidingStructure {
 public:
  /// @param slider     law, spring, damper and stops per unit mass of base and structure, on level ground
  /// @param structure  with matrices
  /// @param base_mass  [kg], positive and finite
  /// @throws std::invalid_argument  naming the value; a slope; a law of numbers
  IsolatedStructure(AnySlider slider, Structure structure, double base_mass);

  /// @param structure  made by Structure::from_modes, whose mass fractions leave the mass of the base
  /// @throws std::invalid_argument  as above; a structure with matrices
  IsolatedStructure(AnySlider slider, Structure structure);

  double base_mass() const noexcept { return base_mass_; }  ///< [kg]; a fraction of the whole with `from_modes`

 private:
  double base_mass_;
};

/// A slider under the structure of an IsolatedStructure that does not feel the sliding: the structure moves as on a
/// fixed base, and its base shear and that of the base drive a rigid mass,
///     q = -(1 - G) n + sum gamma_j (2 z_j w_j y_j' + w_j^2 y_j) - wn^2 x,   x'' = q - s F - c x'.
/// This is the decoupled analysis of flexible sliding masses; energies are those of the slider per unit mass.
class DecoupledStructure : public SlidingStructure {
 public:
  /// As those of IsolatedStructure.
  DecoupledStructure(AnySlider slider, Structure structure, double base_mass);
  DecoupledStructure(AnySlider slider, Structure structure);
};

}  // namespace stickslip
