// Structures with one sliding interface against reference values of independent programs.
#include <cmath>
#include <cstddef>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "stickslip/structure/equipment_on_floor.hpp"
#include "stickslip/structure/isolated_structure.hpp"
#include "structure/eigen.hpp"
#include "support/catch.hpp"
#include "support/reference.hpp"

using namespace stickslip;
using reference::Value;

namespace {

GroundMotion input(bool vertical = false) {
  std::vector<double> n, up;
  for (int m = 0; m <= 400; ++m) {
    n.push_back(2 * std::sin(0.7 * m) + 1.3 * std::cos(1.9 * m + 0.4));
    up.push_back(2.5 * std::cos(0.5 * m + 0.2));
  }
  const GroundMotion motion(n, 0.1);
  return vertical ? motion.with_components({}, up) : motion;
}

Structure structure_of(const Value& one) {
  const auto list = [&](const char* key) { return one[key].list(); };
  if (one.has("column")) {
    std::vector<double> gamma, frequencies, ratios;
    for (int j = 1; j <= one["column"]; ++j) {
      const double odd = 2 * j - 1;
      gamma.push_back(8 / (odd * odd * std::numbers::pi * std::numbers::pi));
      frequencies.push_back(6 * odd);
      ratios.push_back(0.05);
    }
    return Structure::from_modes(gamma, frequencies, ratios);
  }
  if (one.has("gamma")) return Structure::from_modes(list("gamma"), list("frequencies"), list("ratios"));
  Rayleigh rayleigh;
  if (one.has("rayleigh")) rayleigh = {one["rayleigh"].list()[0], one["rayleigh"].list()[1]};
  const Structure building = Structure::shear_building(list("masses"), list("stiffnesses"), rayleigh);
  if (!one.has("dashpots")) return building;
  const std::vector<double> dashpots = one["dashpots"].list();
  RealMatrix damping = building.damping();
  for (std::size_t i = 0; i < dashpots.size(); ++i) {
    const auto k = static_cast<std::ptrdiff_t>(i);
    damping(k, k) += dashpots[i];
    if (i == 0) continue;
    damping(k - 1, k - 1) += dashpots[i];
    damping(k, k - 1) -= dashpots[i];
    damping(k - 1, k) -= dashpots[i];
  }
  return Structure(building.mass(), damping, building.stiffness());
}

AnySlider slider_of(const Value& one) {
  Mounting mounting{.natural_frequency = one.number("natural_frequency", 0), .damping = one.number("damping", 0)};
  if (one.has("stop")) mounting.stops = Stops(one["stop"], one.number("restitution", 0));
  const double level = one["level"] * (one.has("vertical") ? standard_gravity : 1);
  const Coulomb law(level, one.has("one_way") ? never : level);
  if (one.has("static_level")) return Slider<StaticKinetic<Coulomb>>(StaticKinetic(law, one["static_level"]), mounting);
  return Slider<Coulomb>(law, mounting);
}

std::unique_ptr<SlidingStructure> system_of(const Value& one) {
  const Structure structure = structure_of(one);
  const AnySlider slider = slider_of(one);
  const auto kind = one["kind"].as<std::string>();
  if (kind == "floor")
    return std::make_unique<EquipmentOnFloor>(slider, structure, one["floor"].as<int>(), one.number("mass", 0));
  if (kind == "decoupled") return std::make_unique<DecoupledStructure>(slider, structure);
  if (structure.has_matrices()) return std::make_unique<IsolatedStructure>(slider, structure, one["base_mass"]);
  return std::make_unique<IsolatedStructure>(slider, structure);
}

}  // namespace

TEST_CASE("a structure with a sliding interface moves as computed by independent programs", "[structure][long]") {
  for (const Value& one : reference::rows("structures", "interfaces")) {
    const auto id = one["id"].as<std::string>();
    CAPTURE(id);
    const auto system = system_of(one);
    const StructureResponse r = integrate(*system, input(one.has("vertical")));
    // Over 314 impacts with a restitution of 0.9, doubles lose seven digits.
    const bool sensitive = id == "S1.two.stops.e0.9.spring";
    const double tolerance = sensitive ? 1e-6 : 1e-12;
    const auto check = [&](const char* what, double got, double expected) {
      CAPTURE(what);
      CHECK(std::abs(got - expected) <= tolerance * std::max(1.0, std::abs(expected)));
    };
    check("x_end", r.displacement.back(), one["x_end"]);
    check("v_end", r.velocity.back(), one["v_end"]);
    check("peak", r.peak, one["peak_abs_x"]);
    check("dissipated", r.energy.dissipated, one["dissipated"]);
    check("sliding distance", r.sliding_distance, one["sliding_distance"]);
    if (one.has("damping_loss")) {
      check("damped", r.energy.damped, one["damping_loss"]);
      check("input", r.energy.input, one["work"]);
    }
    CHECK(std::abs(r.energy.imbalance()) <= 1e-12 * r.energy.input);
    for (const std::size_t i : {0, 1, 2}) {
      check("x", r.displacement[100 * (i + 1)], one["x"].list()[i]);
      check("v", r.velocity[100 * (i + 1)], one["v"].list()[i]);
    }
    std::vector<int> counts(4);
    for (const Event& event : r.events) {
      if (event.kind == EventKind::breakaway) ++counts[0];
      if (event.kind == EventKind::arrest) ++counts[1];
      if (event.kind == EventKind::reversal) ++counts[2];
      if (event.kind == EventKind::impact) ++counts[3];
    }
    if (!sensitive) CHECK(counts == one["counts"].as<std::vector<int>>());
    const std::vector<double> times = one["first_times"].list();
    for (std::size_t i = 0; i < times.size(); ++i) check("time", r.events[i].time, times[i]);
    if (one.has("margin") && !sensitive) CHECK(std::abs(r.margin / one["margin"] - 1) <= 6e-3);

    const Structure& structure = system->structure();
    const auto y = detail::view(r.final_state.modal_displacement), rate = detail::view(r.final_state.modal_velocity);
    const Eigen::Index last = structure.size() - 1;
    if (structure.has_matrices()) {
      const auto shapes = detail::view(structure.modes().shapes);
      check("u_1", shapes.row(0).dot(y), one["y_first"]);
      check("u_1'", shapes.row(0).dot(rate), one["rate_first"]);
      check("u_n", shapes.row(last).dot(y), one["y_last"]);
      check("u_n'", shapes.row(last).dot(rate), one["rate_last"]);
    } else {
      const auto unit = detail::view(structure.modes().participation);
      check("y_1", y[0] / unit[0], one["y_first"]);
      check("y_1'", rate[0] / unit[0], one["rate_first"]);
      check("y_n", y[last] / unit[last], one["y_last"]);
      check("y_n'", rate[last] / unit[last], one["rate_last"]);
    }
    if (one.has("peak_base_shear")) {
      const double total = structure.has_matrices() ? one["base_mass"] + detail::view(structure.mass()).sum() : 1;
      check("base shear", r.peak_base_shear / total, one["peak_base_shear"]);
    }
    if (one.has("peak_building_base_shear")) check("base shear", r.peak_base_shear, one["peak_building_base_shear"]);
    if (one.has("peak_roof_abs_acc")) check("roof", r.floors.peak_acceleration.back(), one["peak_roof_abs_acc"]);
  }
}
