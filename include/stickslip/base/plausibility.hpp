// Ranges of the quantities that engineers give, beyond which another unit is more probable: the one table.
#pragma once

#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>
#include <string_view>

#include "stickslip/base/units.hpp"

namespace stickslip {

/// A mistake in units. Where it was made, factor value^power + offset was meant.
struct UnitMistake {
  const char* text = nullptr;  // "it is in mm"
  double factor = 1, power = 1, offset = 0;
};

/// The range of a quantity. Values from `low` to below `high` are plausible. So are those from `meant_from` on, which
/// nobody gives by mistake. The constructor of the object checks given values that are not positive.
struct PlausibleRange {
  std::string_view quantity;
  const char* unit;
  double low, high;
  double usual_low, usual_high;  // where a mistake must lead to, to be the likely one
  const char* where;             // "surfaces"
  std::array<UnitMistake, 4> mistakes{};
  bool derived = false;  // computed from what was given
  double meant_from = std::numeric_limits<double>::infinity();
  const char* otherwise = "check its unit";  // the advice if no mistake leads there

  constexpr bool holds(double value) const {
    return !(value < low || value >= high) || (!(value > 0) && !derived) || value >= meant_from;
  }
};

namespace plausible {

inline constexpr UnitMistake in_percent{"it is in percent", 0.01}, in_mm{"it is in mm", 1e-3},
    in_cm{"it is in cm", 1e-2}, in_inches{"it is in inches", 0.0254}, in_ms{"it is in ms", 1e-3},
    in_cm_per_s{"it is in cm/s", 1e-2}, in_g{"it is in m/s^2", 1 / standard_gravity};

inline constexpr bool given = false, computed = true;
inline constexpr double nothing_slips = 100.5;  // whoever gives more means it
inline constexpr double always_odd = std::numeric_limits<double>::infinity();

inline constexpr double root_of_1000 = 31.622776601683793;

// clang-format off
inline constexpr std::array ranges{
    // Rock joints have at most 2.5, tan 68 degrees.
    PlausibleRange{"coefficient of friction", "", 0, 3.01, 0.01, 1.5, "surfaces", {in_percent}, given, nothing_slips},
    PlausibleRange{"slip level", "m/s^2", 0, 50.5, 0.05, 15, "surfaces", {{{"it is in cm/s^2", 0.01}}}, given, nothing_slips * standard_gravity},
    PlausibleRange{"pressure", "Pa", 1e5, 1e9, 1e6, 1e8, "bearings",
                   {{{"it is in MPa", 1e6}, {"it is in kPa", 1e3}, {"it is in psi", 6894.757}}}},
    PlausibleRange{"rate", "s/m", 2, 1000, 10, 300, "liners",
                   {{{"it is in s/cm", 100}, {"it is in s/mm", 1000}, {"it is in s/inch", 1 / 0.0254}}}},
    PlausibleRange{"sliding velocity", "m/s", 0, 10, 1e-3, 1, "surfaces",
                   {{in_cm_per_s, {"it is in mm/s", 1e-3}}}},
    PlausibleRange{"temperature", "degrees Celsius", -100, 150, -50, 60, "bearings at the start",
                   {{{"it is in K", 1, 1, -273.15}}}},
    PlausibleRange{"diffusivity", "m^2/s", 0, 1e-2, 1e-7, 2e-4, "metals", {{{"it is in mm^2/s", 1e-6}}}},
    PlausibleRange{"conductivity", "W/(m K)", 0.1, 1000, 1, 500, "metals", {{{"it is in W/(mm K)", 1e3}}}},
    PlausibleRange{"distance slid", "m", 0, 300, 1e-3, 30, "surfaces", {in_mm, in_cm, in_inches}},
    // A pendulum of 20 m has a period of 9 s.
    PlausibleRange{"radius", "m", 0, 20, 0.2, 8, "dishes", {in_mm, in_cm, in_inches}},
    PlausibleRange{"length", "m", 0, 3, 0.02, 1, "casters, bearings and their stops", {in_mm, in_cm, in_inches}},
    PlausibleRange{"length of a cart", "m", 0, 20, 0.05, 5, "carts", {in_mm, in_cm, in_inches}},
    PlausibleRange{"heading", "rad", 0, 2 * std::numbers::pi * (1 + 1e-12), 0, 2 * std::numbers::pi, "casters",
                   {{{"it is in degrees", std::numbers::pi / 180}}}},
    // A slope of less than one degree changes load and friction by less than 2 % of g.
    PlausibleRange{"slope", "degrees", 1, 90, 1, 60, "slopes", {{{"it is in radians", 180 / std::numbers::pi}}}},
    PlausibleRange{"period", "s", 0, 60, 0.01, 20, "structures and mountings", {in_ms}},
    PlausibleRange{"angular frequency", "rad/s", 0, 1e4, 0.1, 500, "mountings and soils"},
    // Blocks with 5 cm to 29 m from a corner to the center of mass.
    PlausibleRange{"frequency parameter", "rad/s", 0.5, 12, 0.5, 12, "blocks that rock",
                   {{{"width and height are in mm", root_of_1000}, {"width and height are in cm", 10}}}, computed},
    PlausibleRange{"angle of a slender block", "rad", 0, 0.35 * (1 + 1e-12), 0, 0.35, "slender blocks", {}, given,
                   always_odd, "its angles are no longer small, as this model takes them"},
    PlausibleRange{"damper", "1/s", 0, 1e4, 0.01, 100, "mountings"},
    // Structures are damped by 0.5 to 20 %, strained soil by up to 50 %; filters and mountings also critically.
    PlausibleRange{"damping ratio", "", 0, 1, 0.005, 0.95, "structures and soils", {in_percent}, given, nothing_slips},
    PlausibleRange{"damping ratio of one mode", "", 0, 2, 0.005, 1, "oscillators", {in_percent}, given, nothing_slips},
    PlausibleRange{"first period of a building", "s", 0.02, 10, 0.05, 8, "buildings",
                   {{{"the stiffnesses are in kN/m", 1 / root_of_1000}, {"the stiffnesses are in MN/m", 1e-3},
                     {"the masses are in t", root_of_1000}}}, computed},
    PlausibleRange{"first period of modes", "s", 0.02, 10, 0.05, 8, "buildings",
                   {{{"the frequencies are in Hz", 0.5 / std::numbers::pi}}}, computed},
    PlausibleRange{"base mass over the mean mass of a floor", "", 5e-3, 200, 0.05, 20, "buildings",
                   {{{"base_mass is in t", 1e3}, {"the masses of the structure are in t", 1e-3}}}, computed},
    PlausibleRange{"first period of a slope", "s", 0, 5, 0.05, 3, "slopes and dams",
                   {{{"height and shear_velocity are exchanged", 16, -1}, {"height is in ft", 0.3048},
                     {"height is in cm", 0.01}, {"shear_velocity is in km/s", 1e-3}}}, computed},
    PlausibleRange{"shear-wave velocity", "m/s", 10, 8000, 50, 4000, "soils and rocks",
                   {{{"it is in km/s", 1e3}, {"it is in ft/s", 0.3048}}}, given, 1e6},
    PlausibleRange{"reference strain", "", 0, 0.02, 5e-6, 0.01, "soils", {in_percent}},
    PlausibleRange{"yield acceleration", "g", 0, 0.8, 0.02, 0.8, "slopes",
                   {{in_g, {"it is in percent of g", 0.01}}}, given, nothing_slips},
    PlausibleRange{"ground acceleration in g", "g", 0, 6, 0.01, 6, "earthquakes", {in_g}},
    PlausibleRange{"ground velocity in cm/s", "cm/s", 1, 1000, 1, 500, "earthquakes", {{{"it is in m/s", 100}}}},
    PlausibleRange{"ground velocity", "m/s", 0, 10, 0.01, 5, "earthquakes", {in_cm_per_s}},
    PlausibleRange{"Arias intensity", "m/s", 0, 100, 1e-3, 50, "earthquakes", {in_cm_per_s}},
    PlausibleRange{"ground acceleration", "m/s^2", 0, 100, 0.01, 20, "earthquakes", {{{"it is in cm/s^2", 0.01}}}, given, 1e4},
    // Design earthquakes have some 100 cm^2/s^3.
    PlausibleRange{"spectral density", "m^2/s^3", 0, 50, 1e-4, 1, "earthquakes", {{{"it is in cm^2/s^3", 1e-4}}}},
    PlausibleRange{"frequency in Hz", "Hz", 0, 100, 0.05, 50, "earthquakes",
                   {{{"it is in rad/s", 0.5 / std::numbers::pi}}}},
    PlausibleRange{"pulses or cycles of a motion", "", 0, 1e4 * (1 + 1e-9), 1, 5000, "earthquakes",
                   {{{"the duration is in ms", 1e-3}}}, computed, 1e5 * (1 - 1e-9)},
    PlausibleRange{"time in an earthquake", "s", 0, 3600, 0.1, 600, "earthquakes", {in_ms}},
    PlausibleRange{"ratio of components", "", 0, 10, 0.1, 2, "ground motions", {in_percent}},
    // What is above 3 g is nearly always in other units. (The largest acceleration ever recorded is some 4 g.)
    PlausibleRange{"peak of a record", "m/s^2", 1e-4, 29.4, 1e-4, 29.4, "recorded earthquakes", {}, computed, always_odd, "check the units"},
    PlausibleRange{"time step of a record", "s", 0.0005 * (1 - 1e-9), 0.1 * (1 + 1e-9), 0.0005, 0.1,
                   "recorded earthquakes", {}, computed, always_odd, "check whether milliseconds or numbers of rows were taken for seconds"},
    PlausibleRange{"duration of a record", "s", 1, 3600 * (1 + 1e-9), 1, 3600, "recorded earthquakes", {}, computed, always_odd, "check the time step"},
};
// clang-format on

}  // namespace plausible

/// The range of a quantity. Throws std::invalid_argument if the table has none.
constexpr const PlausibleRange& plausible_range(std::string_view quantity) {
  for (const PlausibleRange& range : plausible::ranges)
    if (range.quantity == quantity) return range;
  throw std::invalid_argument("plausible_range: no quantity '" + std::string(quantity) + "'");
}

/// What is implausible about a value, with the likely unit; empty if nothing is.
/// @param name  of the argument, or of what was computed from the arguments
inline std::string implausibility(std::string_view quantity, const std::string& name, double value) {
  const PlausibleRange& range = plausible_range(quantity);
  if (range.holds(value) || !std::isfinite(value)) return "";
  const auto number = [](double x) {
    char text[32];
    std::snprintf(text, sizeof text, "%.4g", x);
    return std::string(text);
  };
  const std::string unit = *range.unit == 0 ? "" : std::string(" ") + range.unit;
  std::string advice;
  for (const UnitMistake& mistake : range.mistakes) {
    if (mistake.text == nullptr) break;
    const double meant = mistake.factor * std::pow(value, mistake.power) + mistake.offset;
    if (meant >= range.usual_low && meant <= range.usual_high)
      advice += std::string("; if ") + mistake.text +
                (range.derived ? ", it is " + number(meant) + unit : ", give " + name + "=" + number(meant));
  }
  return name + " = " + number(value) + unit + " is outside " + number(range.usual_low) + " to " +
         number(range.usual_high) + unit + ", the range of " + range.where +
         (advice.empty() ? std::string("; ") + range.otherwise : advice);
}

}  // namespace stickslip
