// Levels and coefficients of friction as named arguments of the laws, and in their reprs.
#pragma once

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "bindings.hpp"

namespace stickslip::python {

/// A level [m/s^2] as an argument that reproduces it to the last bit: "mu=0.2" if a coefficient of friction of at most
/// six digits does so and is shorter than "slip_level=1.9613300000000001".
inline std::string level_argument(double level, const std::string& mu_name = "mu",
                                  const std::string& level_name = "slip_level") {
  if (std::isinf(level)) return level_name + "=" + literal(level);
  const std::string itself = detail::shortest(level);
  for (int digits = 1; digits <= 6; ++digits) {
    char text[32];
    std::snprintf(text, sizeof text, "%.*g", digits, level / standard_gravity);
    const double mu = std::strtod(text, nullptr);
    if (mu * standard_gravity == level && detail::shortest(mu).size() < itself.size())
      return mu_name + "=" + detail::shortest(mu);
  }
  return level_name + "=" + itself;
}

/// The repr of a law whose parts are numbers, under the names of its constructor: levels [m/s^2] as above, with "mu" for
/// "slip_level" and "mu_slow" for "slow".
template <WithParts Law>
std::string repr_of(const Law& law) {
  std::string text;
  const auto add = [&](const auto& part) {
    const auto value = static_cast<double>(std::invoke(part.get, law));
    if (part.listed == Listed::unless_zero && value == 0) return;
    const std::string name = part.name;
    text += (text.empty() ? "" : ", ") + (std::string_view(part.unit) == "m/s^2"
                                              ? level_argument(value, name == "slip_level" ? "mu" : "mu_" + name, name)
                                              : name + "=" + literal(value));
  };
  std::apply([&](const auto&... part) { (add(part), ...); }, Law::parts());
  return Law::class_name + ("(" + text) + ")";
}

/// Numbers as a list of Python.
inline std::string list_of_numbers(const std::vector<double>& values) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "" : ", ") + literal(value);
  return "[" + text + "]";
}

/// The coefficient of friction of a level [m/s^2]: the one with the fewest digits that gives the level to the last bit.
inline double mu_of(double level) {
  for (int digits = 1; digits <= 17; ++digits) {
    char text[32];
    std::snprintf(text, sizeof text, "%.*g", digits, level / standard_gravity);
    const double mu = std::strtod(text, nullptr);
    if (mu * standard_gravity == level) return mu;
  }
  return level / standard_gravity;
}
inline std::vector<double> mu_of(const std::vector<double>& levels) {
  std::vector<double> all;
  for (const double level : levels) all.push_back(mu_of(level));
  return all;
}

/// Makes a law's constructor explain its arguments if a call has others, such as a number without a name.
/// @param rule  such as "Coulomb: give mu= or slip_level= [m/s^2]"
template <class Law>
void explain_constructor(py::class_<Law>& type, const char* rule) {
  const py::object take = type.attr("__init__");
  const std::string doc = py::str(take.attr("__doc__"));
  py::options options;
  options.disable_function_signatures();
  type.attr("__init__") = py::cpp_function(
      [take, rule](const py::args& self_and_others, const py::kwargs& named) {
        try {
          take(*self_and_others, **named);
        } catch (const py::error_already_set& error) {
          if (!error.matches(PyExc_TypeError)) throw;
          const py::object shown = py::module_::import("reprlib").attr("repr");
          std::string given;
          for (std::size_t i = 1; i < self_and_others.size(); ++i)
            given += (given.empty() ? "" : ", ") + std::string(py::str(shown(self_and_others[i])));
          for (const auto& [name, value] : named)
            given +=
                (given.empty() ? "" : ", ") + std::string(py::str(name)) + "=" + std::string(py::str(shown(value)));
          const std::string text = rule;
          throw py::type_error(text + ", as numbers by name, got " + text.substr(0, text.find(':')) + "(" + given +
                               ")");
        }
      },
      py::name("__init__"), py::is_method(type), doc.c_str());
}

}  // namespace stickslip::python
