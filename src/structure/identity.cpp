#include "stickslip/structure/identity.hpp"

#include <cstddef>
#include <vector>

#include "base/json.hpp"
#include "stickslip/slider/identity.hpp"
#include "stickslip/structure/equipment_on_floor.hpp"
#include "stickslip/structure/flexible_slope.hpp"
#include "stickslip/structure/isolated_structure.hpp"

namespace stickslip {
namespace {

std::string json_of(const std::vector<double>& values) { return detail::json(values); }

std::string json_of(const RealMatrix& values) {
  std::string text = "[";
  for (std::ptrdiff_t i = 0; i < values.rows(); ++i) {
    std::vector<double> row;
    for (std::ptrdiff_t j = 0; j < values.cols(); ++j) row.push_back(values(i, j));
    text.append(i > 0 ? ", " : "").append(json_of(row));
  }
  return text + "]";
}

// What it was made from: modes would differ in their last digits between machines.
std::string json_of(const Structure& of) {
  if (of.has_matrices())
    return "{\"mass\": " + json_of(of.mass()) + ", \"damping\": " + json_of(of.damping()) +
           ", \"stiffness\": " + json_of(of.stiffness()) + ", \"influence\": " + json_of(of.influence()) + "}";
  const Modes& modes = of.modes();
  return "{\"mass_fractions\": " + json_of(modes.effective_masses) +
         ", \"frequencies\": " + json_of(modes.frequencies) + ", \"damping_ratios\": " + json_of(modes.damping_ratios) +
         (of.unit_shapes().size() > 0 ? ", \"shapes\": " + json_of(of.unit_shapes()) : "") + "}";
}

}  // namespace

std::string identity(const IsolatedStructure& system) {
  return "{\"isolated_structure\": " + json_of(system.structure()) +
         ", \"base_mass\": " + detail::json(system.base_mass()) + ", \"slider\": " + identity(system.slider()) + "}";
}

std::string identity(const EquipmentOnFloor& system) {
  return "{\"equipment_on_floor\": " + std::to_string(system.floor()) +
         ", \"structure\": " + json_of(system.structure()) + ", \"mass\": " + detail::json(system.mass()) +
         ", \"slider\": " + identity(system.slider()) + "}";
}

std::string identity(const FlexibleSlope& slope) {
  const bool coupled = slope.method == SlopeMethod::coupled;
  return std::string("{\"flexible_slope\": \"") + (coupled ? "coupled" : "decoupled") + "\", " +
         (slope.degrading ? detail::json_of_law(*slope.degrading) : "\"ky_g\": " + detail::json(slope.ky_g)) +
         ", \"height\": " + detail::json(slope.height) + ", \"shear_velocity\": " + detail::json(slope.shear_velocity) +
         ", \"damping_ratio\": " + detail::json(slope.damping_ratio) + ", \"modes\": " + std::to_string(slope.modes) +
         (slope.rock_velocity ? ", \"rock_velocity\": " + detail::json(*slope.rock_velocity) : "") +
         (slope.soil ? ", \"reference_strain\": " + detail::json(slope.soil->reference_strain()) : "") + "}";
}

}  // namespace stickslip
