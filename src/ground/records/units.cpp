#include "ground/records/units.hpp"

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <iterator>
#include <stdexcept>
#include <string>
#include <utility>

#include "ground/records/text.hpp"
#include "stickslip/base/units.hpp"
#include "stickslip/ground/records.hpp"

namespace stickslip {
namespace records {
namespace {

constexpr AccelerationUnit accelerations[] = {
    {"g", standard_gravity},
    {"m/s^2", 1},
    {"cm/s^2", 0.01},
    {"gal", 0.01},
    {"mm/s^2", 0.001},
    {"ft/s^2", 0.3048},
    {"in/s^2", 0.0254},
    {"mg", 0.001 * standard_gravity},
    {"%g", 0.01 * standard_gravity},
};

/// One spelling of each unit: lower case, without blanks, s^2 for the square of the second; empty for a long text.
std::string plain(std::string_view name) {
  constexpr std::size_t longest = 32;  // the names here with room to spare
  std::string unit;
  for (const char c : name)
    if (!is_blank(c) && std::string_view("(){}$").find(c) == std::string_view::npos && unit.size() <= longest)
      unit += lower(c);
  if (unit.size() > longest) return {};
  for (const auto& [variant, plain] : {std::pair<std::string_view, std::string_view>{"\xC2\xB2", "2"},  // superscript 2
                                       {"\xE2\x81\xBB", "-"},                                           // superscript -
                                       {"\xE2\x8B\x85", ""},                                            // dot operator
                                       {"\xC2\xA0", ""},                                                // blank
                                       {"\xC2\xB7", ""},                                                // middle dot
                                       {"*s", "s"},
                                       {"sec", "s"},
                                       {"cms/", "cm/"},
                                       {"**", "^"},
                                       {"s^-2", "s-2"},
                                       {"ms-2", "m/s^2"},
                                       {"s/s", "s^2"},
                                       {"s2", "s^2"},
                                       {"gals", "gal"},
                                       {"g's", "g"}})
    for (std::size_t at; (at = unit.find(variant)) != std::string::npos;) unit.replace(at, variant.size(), plain);
  return unit;
}

}  // namespace

std::optional<AccelerationUnit> find_acceleration_unit(std::string_view name) {
  const std::string unit = plain(name);
  const auto* const found =
      std::ranges::find_if(accelerations, [&](const AccelerationUnit& one) { return one.name == unit; });
  return found == std::end(accelerations) ? std::nullopt : std::optional(*found);
}

AccelerationUnit acceleration_unit_named(std::string_view name) {
  if (const std::optional<AccelerationUnit> found = find_acceleration_unit(name)) return *found;
  std::string known;
  for (const AccelerationUnit& one : accelerations) known.append(known.empty() ? "" : ", ").append(one.name);
  throw std::invalid_argument("unknown unit of acceleration " + quote(name) + "; known are " + known);
}

std::optional<double> find_time_unit(std::string_view name) {
  if (is_second(name)) return 1;
  constexpr std::pair<std::string_view, double> units[] = {
      {"ms", 1e-3},           {"msec", 1e-3},      {"msecs", 1e-3},     {"millisecond", 1e-3}, {"milliseconds", 1e-3},
      {"us", 1e-6},           {"\xC2\xB5s", 1e-6}, {"\xCE\xBCs", 1e-6}, {"hours", 3600},       {"usec", 1e-6},
      {"microseconds", 1e-6}, {"min", 60},         {"minutes", 60}};
  for (const auto& [unit, seconds] : units)
    if (same(name, unit)) return seconds;
  return std::nullopt;
}

std::string quantity_with_unit(std::string_view name) {
  const std::string unit = plain(name);
  const auto is = [&](std::initializer_list<std::string_view> names) {
    return std::ranges::find(names, std::string_view(unit)) != names.end();
  };
  if (is({"m/s", "cm/s", "mm/s", "in/s", "ft/s", "km/s"})) return "a velocity";
  if (is({"m", "cm", "mm", "in", "ft", "km", "cms"})) return "a length";
  if (is({"hz", "1/s", "rad/s"})) return "a frequency";
  if (is({"counts", "count", "v", "mv", "volt", "volts"})) return "raw counts or volts";
  if (is({"n", "kn", "mn", "kip", "kips", "lbf", "kgf", "pa", "kpa", "mpa"})) return "a force or a pressure";
  if (is({"deg", "degrees", "rad"})) return "an angle";
  if (is({"c", "degc", "k"})) return "a temperature";
  return {};
}

}  // namespace records

double acceleration_unit(std::string_view name) { return records::acceleration_unit_named(name).value; }

}  // namespace stickslip
