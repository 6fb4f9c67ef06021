#include "stickslip/structure/isolated_structure.hpp"

#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "stickslip/base/error.hpp"
#include "structure/modal_interface.hpp"

namespace stickslip {
namespace {

using detail::view;

// The floors of a structure on a base that moves with the interface.
detail::ModalInterface on_base(const Structure& structure, double base_mass) {
  const Modes& modes = structure.modes();
  const auto participation = view(modes.participation);
  const auto influence = view(structure.influence());
  const bool matrices = structure.has_matrices();
  // With matrices all modes are there; otherwise masses are fractions of the whole.
  const double total = matrices ? base_mass + influence.dot(view(structure.mass()) * influence) : 1;
  detail::ModalInterface of;
  of.stiffness = view(modes.frequencies).cwiseAbs2();
  of.damping = view(structure.modal_damping());
  of.classical = structure.classical();
  of.demand = participation / total;
  of.load = participation;
  of.jump = participation;
  of.reaction = Eigen::VectorXd::Zero(structure.size());
  of.ground_demand = of.mass = base_mass / total;
  of.coupling = of.input = participation / total;
  of.modal_mass = 1 / total;
  of.shapes = view(modes.shapes);
  of.influence = influence;
  of.base_shear = participation;
  of.base_shear_of_base = participation.squaredNorm();
  if (matrices && structure.uniform_influence()) of.floor_mass = view(structure.mass());
  return of;
}

// A slider that is driven by the forces on the base, which the structure does not feel.
detail::ModalInterface decoupled(detail::ModalInterface of) {
  of.mass = 1;
  of.jump.setZero();
  of.driven = true;
  of.rides = false;
  return of;
}

double checked(const char* name, const Structure& structure, double base_mass) {
  if (!structure.has_matrices())
    throw std::invalid_argument(std::string(name) +
                                ": base_mass must be left out with a structure from_modes, whose mass fractions leave "
                                "it, got " +
                                detail::shortest(base_mass) + " kg");
  detail::require(std::isfinite(base_mass) && base_mass > 0,
                  std::string(name) + ": base_mass must be positive and finite", base_mass, "kg");
  return base_mass;
}

double rest_of(const char* name, const Structure& structure) {
  if (structure.has_matrices())
    throw std::invalid_argument(std::string(name) + ": a structure with matrices needs a base_mass [kg], got none");
  return 1 - view(structure.modes().effective_masses).sum();
}

constexpr const char *isolated = "IsolatedStructure", *unfelt = "DecoupledStructure";

}  // namespace

IsolatedStructure::IsolatedStructure(AnySlider slider, Structure structure, double base_mass)
    : SlidingStructure(isolated, std::move(slider), structure,
                       on_base(structure, checked(isolated, structure, base_mass))),
      base_mass_(base_mass) {}

IsolatedStructure::IsolatedStructure(AnySlider slider, Structure structure)
    : SlidingStructure(isolated, std::move(slider), structure, on_base(structure, rest_of(isolated, structure))),
      base_mass_(rest_of(isolated, structure)) {}

DecoupledStructure::DecoupledStructure(AnySlider slider, Structure structure, double base_mass)
    : SlidingStructure(unfelt, std::move(slider), structure,
                       decoupled(on_base(structure, checked(unfelt, structure, base_mass)))) {}

DecoupledStructure::DecoupledStructure(AnySlider slider, Structure structure)
    : SlidingStructure(unfelt, std::move(slider), structure,
                       decoupled(on_base(structure, rest_of(unfelt, structure)))) {}

}  // namespace stickslip
