// Structures with one sliding interface against reference values of independent programs.
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "stickslip/structure/equipment_on_floor.hpp"
#include "stickslip/structure/isolated_structure.hpp"
#include "structure/structure_values.hpp"
#include "support/catch.hpp"

using namespace stickslip;
using namespace test;

namespace {

Eigen::VectorXd vector(const std::vector<double>& values) {
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

GroundMotion input(bool vertical = false) {
  std::vector<double> n, up;
  for (int m = 0; m <= 400; ++m) {
    n.push_back(2 * std::sin(0.7 * m) + 1.3 * std::cos(1.9 * m + 0.4));
    up.push_back(2.5 * std::cos(0.5 * m + 0.2));
  }
  const GroundMotion motion(n, 0.1);
  return vertical ? motion.with_components({}, up) : motion;
}

Structure structure_of(const StructureCase& one) {
  if (one.column > 0) {
    std::vector<double> gamma, frequencies, ratios;
    for (int j = 1; j <= one.column; ++j) {
      const double odd = 2 * j - 1;
      gamma.push_back(8 / (odd * odd * std::numbers::pi * std::numbers::pi));
      frequencies.push_back(6 * odd);
      ratios.push_back(0.05);
    }
    return Structure::from_modes(vector(gamma), vector(frequencies), vector(ratios));
  }
  if (!one.gamma.empty()) return Structure::from_modes(vector(one.gamma), vector(one.frequencies), vector(one.ratios));
  const Structure building = Structure::shear_building(vector(one.masses), vector(one.stiffnesses), one.rayleigh);
  if (one.dashpots.empty()) return building;
  Eigen::MatrixXd damping = building.damping();
  for (std::size_t i = 0; i < one.dashpots.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    damping(k, k) += one.dashpots[i];
    if (i == 0) continue;
    damping(k - 1, k - 1) += one.dashpots[i];
    damping(k, k - 1) -= one.dashpots[i];
    damping(k - 1, k) -= one.dashpots[i];
  }
  return Structure(building.mass(), damping, building.stiffness());
}

AnySlider slider_of(const StructureCase& one) {
  Mounting mounting{.natural_frequency = one.natural_frequency, .damping = one.damping};
  if (one.stop > 0) mounting.stops = Stops(one.stop, one.restitution);
  const double level = one.vertical ? one.level * standard_gravity : one.level;
  const Coulomb law(level, one.one_way ? never : level);
  if (one.static_level > 0) return Slider<StaticKinetic<Coulomb>>(StaticKinetic(law, one.static_level), mounting);
  return Slider<Coulomb>(law, mounting);
}

std::unique_ptr<SlidingStructure> system_of(const StructureCase& one) {
  const Structure structure = structure_of(one);
  const AnySlider slider = slider_of(one);
  switch (one.kind) {
    case StructureCase::Kind::floor:
      return std::make_unique<EquipmentOnFloor>(slider, structure, one.floor, one.mass);
    case StructureCase::Kind::decoupled:
      return std::make_unique<DecoupledStructure>(slider, structure);
    default:
      if (structure.has_matrices()) return std::make_unique<IsolatedStructure>(slider, structure, one.base_mass);
      return std::make_unique<IsolatedStructure>(slider, structure);
  }
}

}  // namespace

TEST_CASE("a structure with a sliding interface moves as computed by independent programs", "[structure][long]") {
  for (const StructureCase& one : structure_cases()) {
    CAPTURE(one.id);
    const auto system = system_of(one);
    const StructureResponse r = integrate(*system, input(one.vertical));
    const StructureCase::Value& value = one.value;
    // Over 314 impacts with a restitution of 0.9, doubles lose seven digits.
    const bool sensitive = std::string(one.id) == "S1.two.stops.e0.9.spring";
    const double tolerance = sensitive ? 1e-6 : 1e-12;
    const auto check = [&](const char* what, double got, double expected) {
      CAPTURE(what);
      CHECK(std::abs(got - expected) <= tolerance * std::max(1.0, std::abs(expected)));
    };
    check("x_end", r.displacement.back(), value.x_end);
    check("v_end", r.velocity.back(), value.v_end);
    check("peak", r.peak, value.peak_abs_x);
    check("dissipated", r.energy.dissipated, value.dissipated);
    check("sliding distance", r.sliding_distance, value.sliding_distance);
    if (value.damping_loss >= 0) {
      check("damped", r.energy.damped, value.damping_loss);
      check("input", r.energy.input, value.work);
    }
    CHECK(std::abs(r.energy.imbalance()) <= 1e-12 * r.energy.input);
    for (const std::size_t i : {0, 1, 2}) {
      check("x", r.displacement[100 * (i + 1)], value.x[i]);
      check("v", r.velocity[100 * (i + 1)], value.v[i]);
    }
    std::array<int, 4> counts{};
    for (const Event& event : r.events) {
      if (event.kind == EventKind::breakaway) ++counts[0];
      if (event.kind == EventKind::arrest) ++counts[1];
      if (event.kind == EventKind::reversal) ++counts[2];
      if (event.kind == EventKind::impact) ++counts[3];
    }
    if (!sensitive) CHECK(counts == value.counts);
    for (std::size_t i = 0; i < value.first_times.size(); ++i) check("time", r.events[i].time, value.first_times[i]);
    if (value.margin >= 0 && !sensitive) CHECK(std::abs(r.margin / value.margin - 1) <= 6e-3);

    const Structure& structure = system->structure();
    const Eigen::VectorXd& y = r.final_state.modal_displacement;
    const Eigen::VectorXd& rate = r.final_state.modal_velocity;
    const Eigen::Index last = structure.size() - 1;
    if (structure.has_matrices()) {
      const Eigen::MatrixXd& shapes = structure.modes().shapes;
      check("u_1", shapes.row(0).dot(y), value.y_first);
      check("u_1'", shapes.row(0).dot(rate), value.rate_first);
      check("u_n", shapes.row(last).dot(y), value.y_last);
      check("u_n'", shapes.row(last).dot(rate), value.rate_last);
    } else {
      const Eigen::VectorXd& unit = structure.modes().participation;
      check("y_1", y[0] / unit[0], value.y_first);
      check("y_1'", rate[0] / unit[0], value.rate_first);
      check("y_n", y[last] / unit[last], value.y_last);
      check("y_n'", rate[last] / unit[last], value.rate_last);
    }
    if (value.peak_base_shear >= 0) {
      const double total = structure.has_matrices() ? one.base_mass + structure.mass().sum() : 1;
      check("base shear", r.peak_base_shear / total, value.peak_base_shear);
    }
    if (value.peak_building_base_shear >= 0) check("base shear", r.peak_base_shear, value.peak_building_base_shear);
    if (value.peak_roof_abs_acc >= 0) check("roof", r.floors.peak_acceleration[last], value.peak_roof_abs_acc);
  }
}
