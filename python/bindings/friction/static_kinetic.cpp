#include <pybind11/stl.h>

#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>

#include "friction/arguments.hpp"
#include "parts.hpp"

namespace stickslip::python {
namespace {

using Pair = std::pair<double, double>;
using Level = std::variant<double, Pair>;  // one number, or (forward, backward)

// Levels [m/s^2] given as such or as coefficients of friction.
Pair levels_of(const std::optional<Level>& mu, const std::optional<Level>& level, const char* mu_name,
               const char* level_name) {
  if (mu.has_value() == level.has_value())
    throw std::invalid_argument(std::string("StaticKinetic: give either ") + mu_name + " or " + level_name + ", got " +
                                (mu ? "both" : "neither"));
  const Level& given = mu ? *mu : *level;
  const Pair pair = given.index() == 0 ? Pair(std::get<0>(given), std::get<0>(given)) : std::get<1>(given);
  if (!mu) {
    check_unit("slip level", "StaticKinetic", level_name, pair.first);
    return pair;
  }
  for (const double value : {pair.first, pair.second})
    detail::require(value >= 0, std::string("StaticKinetic: ") + mu_name + " must be at least 0", value);
  check_unit("coefficient of friction", "StaticKinetic", mu_name, pair.first);
  return {pair.first * standard_gravity, pair.second * standard_gravity};
}

AnyStaticKinetic make_static_kinetic(const py::object& sliding, const std::optional<Level>& mu_static,
                                     const std::optional<Level>& mu_kinetic, const std::optional<Level>& hold,
                                     const std::optional<Level>& kinetic) {
  const Pair at_rest = levels_of(mu_static, hold, "mu_static", "static");
  const auto with = [&](auto law) -> AnyStaticKinetic {
    return StaticKinetic(std::move(law), at_rest.first, at_rest.second);
  };
  if (sliding.is_none()) {
    const Pair levels = levels_of(mu_kinetic, kinetic, "mu_kinetic", "kinetic");
    return with(Coulomb(levels.first, levels.second));
  }
  if (mu_kinetic || kinetic)
    throw std::invalid_argument("StaticKinetic: give a sliding law, or mu_kinetic or kinetic, got both");
  std::optional<AnyStaticKinetic> made;
  std::string names;
  StaticKineticLaws::for_each([&]<class Law>() {
    using Sliding = std::remove_cvref_t<decltype(std::declval<const Law&>().sliding())>;
    if (py::isinstance<Sliding>(sliding)) made = with(sliding.cast<Sliding>());
    names += (names.empty() ? "" : ", ") + std::string(Sliding::class_name);
  });
  if (made) return *std::move(made);
  throw py::type_error("StaticKinetic: the sliding law must be one of " + names + ", got " +
                       py::type::of(sliding).attr("__name__").cast<std::string>());
}

py::object sliding_of(const AnyStaticKinetic& law) {
  return std::visit([](const auto& one) { return py::cast(one.sliding()); }, law);
}
double forward_of(const AnyStaticKinetic& law) {
  return std::visit([](const auto& one) { return one.static_forward(); }, law);
}
double backward_of(const AnyStaticKinetic& law) {
  return std::visit([](const auto& one) { return one.static_backward(); }, law);
}

}  // namespace

void bind_static_kinetic(py::module_& m) {
  py::class_<AnyStaticKinetic> type(m, "StaticKinetic", m.attr("FrictionLaw"), R"(Static friction above kinetic.

A slider at rest withstands |load| <= a_static; another law resists sliding. A slip that stops sticks if
|load| <= a_static. At breakaway the acceleration jumps to a_static minus the resistance to sliding.

Objects compare by content; they can be hashed, copied and pickled.

Parameters
----------
sliding : FrictionLaw, optional
    The law of sliding, one whose friction at rest is not already above it, instead of mu_kinetic or kinetic.
mu_static : float or (float, float), optional
    Static coefficient of friction, or those against forward and backward sliding. Give mu_static or static.
static : float or (float, float), optional
    The same as levels a_static = mu_static * STANDARD_GRAVITY [m/s^2]; at least the level of the sliding law at x = 0.
mu_kinetic, kinetic : float or (float, float), optional
    Coefficient of kinetic friction, or its level [m/s^2], independent of position and speed.

Raises
------
ValueError
    A static level below the kinetic one; a value out of its range; both or neither of a coefficient and its level.

Warns
-----
PlausibilityWarning
    As for `Coulomb`.

Notes
-----
As exact as the sliding law. The response is not a continuous function of its input: where a slip almost stops, or a
load almost reaches the static level, an arbitrarily small change decides.)");
  type.def(py::init(&make_static_kinetic), py::arg("sliding") = py::none(), py::kw_only(),
           py::arg("mu_static") = py::none(), py::arg("mu_kinetic") = py::none(), py::arg("static") = py::none(),
           py::arg("kinetic") = py::none())
      .def_property_readonly("sliding", &sliding_of, "The law of sliding.")
      .def_property_readonly("static", &forward_of, "Static level against forward sliding [m/s^2].")
      .def_property_readonly(
          "mu_static", [](const AnyStaticKinetic& law) { return mu_of(forward_of(law)); },
          "Static coefficient of friction against forward sliding, static / g.")
      .def_property_readonly("static_backward", &backward_of, "Static level against backward sliding [m/s^2].")
      .def("__repr__",
           [](const AnyStaticKinetic& law) {
             const double forward = forward_of(law), backward = backward_of(law);
             const std::string level = forward == backward
                                           ? level_argument(forward, "mu_static", "static")
                                           : "static=(" + detail::shortest(forward) + ", " + literal(backward) + ")";
             return "StaticKinetic(" + py::repr(sliding_of(law)).cast<std::string>() + ", " + level + ")";
           })
      .def(
          "__eq__",
          [](const AnyStaticKinetic& a, const py::object& other) -> py::object {
            if (!py::isinstance<AnyStaticKinetic>(other)) return py::reinterpret_borrow<py::object>(Py_NotImplemented);
            const auto& b = other.cast<const AnyStaticKinetic&>();
            return py::bool_(sliding_of(a).equal(sliding_of(b)) && forward_of(a) == forward_of(b) &&
                             backward_of(a) == backward_of(b));
          },
          py::is_operator())
      .def("__hash__",
           [](const AnyStaticKinetic& law) {
             return py::hash(py::make_tuple(sliding_of(law), forward_of(law), backward_of(law)));
           })
      .def(py::pickle(
          [](const AnyStaticKinetic& law) {
            return py::make_tuple(sliding_of(law), forward_of(law), backward_of(law));
          },
          [](const py::tuple& parts) {
            if (parts.size() != 3) throw std::invalid_argument("unpickling: expected 3 values");
            return make_static_kinetic(parts[0], {}, {}, Level(Pair(parts[1].cast<double>(), parts[2].cast<double>())),
                                       {});
          }));
  explain_constructor(type,
                      "StaticKinetic: give mu_static= or static= [m/s^2], and a sliding law, mu_kinetic= or kinetic= "
                      "[m/s^2]");
}

}  // namespace stickslip::python
