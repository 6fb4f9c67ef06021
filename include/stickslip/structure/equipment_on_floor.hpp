// A slider on a floor of a structure.
#pragma once

#include <cstddef>

#include "stickslip/structure/sliding_structure.hpp"

namespace stickslip {

/// A slider on a floor of a structure that stands on the ground; the reference mass is that of the slider. x is
/// relative to the floor. With a mass m_e it acts on the structure: while it is stuck its mass is part of the floor,
/// and breakaway, arrest and impacts are felt by the structure. With m_e = 0 it follows the floor of a structure that
/// does not feel it, and energies are those of the slider per unit mass.
class EquipmentOnFloor : public SlidingStructure {
 public:
  /// @param slider     law, spring, damper and stops per unit mass of the slider
  /// @param structure  with shapes
  /// @param floor      counted from 1, the lowest
  /// @param mass       m_e [kg], finite and at least 0; with `from_modes`, as a fraction of the total mass of the
  /// structure
  /// @throws std::invalid_argument  naming the value; a slope; a law of numbers
  EquipmentOnFloor(AnySlider slider, Structure structure, std::ptrdiff_t floor, double mass = 0);

  std::ptrdiff_t floor() const noexcept { return floor_; }
  double mass() const noexcept { return mass_; }

 private:
  std::ptrdiff_t floor_;
  double mass_;
};

}  // namespace stickslip
