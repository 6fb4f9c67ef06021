#include "stickslip/structure/equipment_on_floor.hpp"

#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "stickslip/base/error.hpp"
#include "structure/modal_interface.hpp"

namespace stickslip {
namespace {

using detail::view;

detail::ModalInterface on_floor(const Structure& structure, std::ptrdiff_t floor, double mass) {
  const std::ptrdiff_t floors = structure.floors();
  if (floors == 0)
    throw std::invalid_argument("EquipmentOnFloor: needs a structure with floors; give from_modes the shapes");
  if (floor < 1 || floor > floors)
    throw std::invalid_argument("EquipmentOnFloor: floor must be from 1 to " + std::to_string(floors) + ", got " +
                                std::to_string(floor));
  detail::require(std::isfinite(mass) && mass >= 0, "EquipmentOnFloor: mass must be finite and at least 0", mass, "kg");
  const Modes& modes = structure.modes();
  const auto shapes = view(modes.shapes);
  const Eigen::VectorXd shape = shapes.row(floor - 1);
  const auto participation = view(modes.participation), influences = view(structure.influence());
  const double influence = influences[floor - 1];
  detail::ModalInterface of;
  of.stiffness = view(modes.frequencies).cwiseAbs2();
  of.damping = view(structure.modal_damping());
  of.classical = structure.classical();
  of.mass = 1 / (1 + mass * shape.squaredNorm());
  of.demand = of.mass * shape;
  // The part of the motion of the ground that the modes do not bring to the floor; with all modes, none.
  double direct = influence - shape.dot(participation);
  if (structure.has_matrices()) direct = 0;
  of.ground_demand = of.mass * direct;
  of.reaction = mass * shape;
  of.load = participation + mass * of.ground_demand * shape;
  of.jump = mass * of.mass * shape;
  of.driven = !(mass > 0);
  of.coupling = shape;
  of.own = 1;
  of.modal_mass = mass > 0 ? 1 / mass : 0;
  of.input_base = influence;
  of.input = influence * shape + of.modal_mass * participation;
  of.shapes = shapes;
  of.influence = influences;
  of.rides = false;
  of.slider_floor = floor - 1;
  of.slider_mass = mass;
  of.base_shear = participation + mass * shape;
  of.base_shear_of_base = participation.squaredNorm() + mass * influence;
  if (structure.has_matrices() && structure.uniform_influence()) {
    of.floor_mass = view(structure.mass());
    of.floor_mass(floor - 1, floor - 1) += mass;
  }
  return of;
}

}  // namespace

EquipmentOnFloor::EquipmentOnFloor(AnySlider slider, Structure structure, std::ptrdiff_t floor, double mass)
    : SlidingStructure("EquipmentOnFloor", std::move(slider), structure, on_floor(structure, floor, mass)),
      floor_(floor),
      mass_(mass) {}

}  // namespace stickslip
