#include "stickslip/friction/degrading.hpp"

#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "friction/arguments.hpp"
#include "parts.hpp"

namespace stickslip::python {
namespace {

struct Given {
  const char* name;
  const py::object& values;
  double unit;  // [m/s^2]
};

/// The levels [m/s^2] of the one argument of several that is given.
std::vector<double> levels_of(const std::vector<Given>& arguments, const std::string& choice) {
  const Given* given = nullptr;
  for (const Given& argument : arguments) {
    if (argument.values.is_none()) continue;
    if (given != nullptr)
      throw std::invalid_argument("Degrading: give one of " + choice + ", got " + given->name + " and " +
                                  argument.name);
    given = &argument;
  }
  if (given == nullptr) throw std::invalid_argument("Degrading: give one of " + choice + ", got none");
  const std::string_view kind = given->name;
  const std::string name = std::string("Degrading: ") + given->name;
  std::vector<double> levels = to_vector(given->values, name, given->unit == 1 ? "m/s^2" : "");
  for (std::size_t i = 0; i < levels.size(); ++i) {
    detail::require(std::isfinite(levels[i]) && levels[i] >= 0,
                    name + "[" + std::to_string(i) + "] must be finite and at least 0", levels[i]);
  }
  if (kind == "ky_g") check_unit("yield acceleration", "Degrading", given->name, levels);
  if (kind == "slip_level" || kind == "backward") check_unit("slip level", "Degrading", given->name, levels);
  if (kind.starts_with("mu")) check_unit("coefficient of friction", "Degrading", given->name, levels);
  for (double& level : levels) level *= given->unit;
  return levels;
}

/// Levels as the argument that gives them back to the bit.
std::string levels_argument(const std::vector<double>& levels, const std::string& mu_name,
                            const std::string& level_name) {
  std::string text;
  for (const double level : levels) {
    const std::string one = level_argument(level, "mu", "level");
    if (level != 0 && !one.starts_with("mu=")) return level_name + "=" + list_of_numbers(levels);
    text += (text.empty() ? "" : ", ") + (level == 0 ? "0" : one.substr(3));
  }
  return mu_name + "=[" + text + "]";
}

}  // namespace

template <>
void bind_law<Degrading>(py::module_& m) {
  auto type = value_class<Degrading>(m, "Degrading",
                                     R"(Friction that degrades, or wears in, with the distance slid.

a(s), a = mu g the slip level: friction force per unit mass where the normal force is g. s is how far the slider has slid,
forward and backward alike: `State.sliding_distance`. The level is linear in s between knots, and constant before the first
and after the last. At rest, the level stays at its present value.

On a one-way slider this is Newmark's block whose yield acceleration falls with displacement, as that of a slope whose soil
loses strength.

Parameters
----------
distance : array_like
    Of the knots [m]: at least one, finite, at least 0 and increasing.
mu : array_like, optional
    Coefficients of friction there, finite and at least 0. Give mu, ky_g or slip_level.
ky_g : array_like, optional
    Yield accelerations in g: on level ground the same as mu.
slip_level : array_like, optional
    The levels [m/s^2].
mu_backward, backward : array_like, optional
    Coefficients of friction, or levels [m/s^2], against backward sliding, where they differ.

Raises
------
ValueError
    A value out of its range; another number of levels than of distances; none or several of mu, ky_g and slip_level.

Warns
-----
PlausibilityWarning
    As for `Coulomb`; a ky_g from 0.8 to 100, which may be in m/s^2 or percent of g; a distance of 300 m or more, which
    may be in mm, cm or inches.

Notes
-----
Between knots the slider moves as on constant friction and a spring, which pushes away where the level falls: in closed
form under horizontal motion, to 1e-12 of the scale, 0.13 us a sample. Under vertical motion, on slopes, between stops and
one way: Taylor series, near round-off, 0.14 to 0.2 us.

A knot is no event: the level does not jump there.

Examples
--------
>>> law = Degrading(distance=[0, 0.1], mu=[0.3, 0.2])
>>> Slider(law).resist(sliding_distance=0.05) / STANDARD_GRAVITY
0.25)");
  type.def(py::init([](const py::object& distance, const py::object& mu, const py::object& ky_g,
                       const py::object& slip_level, const py::object& mu_backward, const py::object& backward) {
             std::vector<double> distances = to_vector(distance, "Degrading: distance", "m");
             check_unit("distance slid", "Degrading", "distance", distances);
             const double g = standard_gravity;
             std::vector<double> levels = levels_of({{"mu", mu, g}, {"ky_g", ky_g, g}, {"slip_level", slip_level, 1}},
                                                    "mu, ky_g and slip_level");
             if (mu_backward.is_none() && backward.is_none()) return Degrading(std::move(distances), std::move(levels));
             std::vector<double> others =
                 levels_of({{"mu_backward", mu_backward, g}, {"backward", backward, 1}}, "mu_backward and backward");
             return Degrading(std::move(distances), std::move(levels), std::move(others));
           }),
           py::kw_only(), py::arg("distance"), py::arg("mu") = py::none(), py::arg("ky_g") = py::none(),
           py::arg("slip_level") = py::none(), py::arg("mu_backward") = py::none(), py::arg("backward") = py::none())
      .def_property_readonly(
          "distance", [](const Degrading& law) { return to_array(law.distances()); }, "Of the knots [m].")
      .def_property_readonly(
          "slip_level", [](const Degrading& law) { return to_array(law.levels()); },
          "Levels there against forward sliding [m/s^2].")
      .def_property_readonly(
          "mu", [](const Degrading& law) { return to_array(mu_of(law.levels())); },
          "Coefficients of friction there against forward sliding, slip_level / g.")
      .def_property_readonly(
          "backward", [](const Degrading& law) { return to_array(law.backward()); },
          "Levels there against backward sliding [m/s^2].")
      .def("__repr__", [](const Degrading& law) {
        return "Degrading(distance=" + list_of_numbers(law.distances()) + ", " +
               levels_argument(law.levels(), "mu", "slip_level") +
               (law.backward() != law.levels() ? ", " + levels_argument(law.backward(), "mu_backward", "backward")
                                               : "") +
               ")";
      });
  explain_constructor(type, "Degrading: give distance= [m], and mu=, ky_g= or slip_level= [m/s^2]");
}

}  // namespace stickslip::python
