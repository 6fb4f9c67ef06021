#include "stickslip/structure/flexible_slope.hpp"

#include <pybind11/stl.h>

#include <optional>
#include <stdexcept>
#include <string>
#include <tuple>
#include <variant>

#include "parts.hpp"
#include "structure/response.hpp"
#include "structure/structure.hpp"

namespace stickslip::python {
namespace {

const char* name_of(SlopeMethod method) { return method == SlopeMethod::coupled ? "coupled" : "decoupled"; }

SlopeMethod method_of(const std::string& name) {
  if (name == "coupled") return SlopeMethod::coupled;
  if (name == "decoupled") return SlopeMethod::decoupled;
  throw std::invalid_argument("FlexibleSlope: method must be 'coupled' or 'decoupled', got '" + name + "'");
}

std::string text_of(const FlexibleSlope& s) {
  std::string text = "FlexibleSlope(ky_g=" +
                     (s.degrading ? py::repr(py::cast(*s.degrading)).cast<std::string>() : detail::shortest(s.ky_g)) +
                     ", height=" + detail::shortest(s.height) +
                     ", shear_velocity=" + detail::shortest(s.shear_velocity);
  if (!s.soil) text += ", damping_ratio=" + detail::shortest(s.damping_ratio);
  if (s.modes != 1) text += ", modes=" + std::to_string(s.modes);
  if (s.rock_velocity) text += ", rock_velocity=" + detail::shortest(*s.rock_velocity);
  if (s.soil) text += ", soil=HyperbolicSoil(reference_strain=" + detail::shortest(s.soil->reference_strain()) + ")";
  return text + ", method='" + name_of(s.method) + "')";
}

}  // namespace

template <>
inline constexpr auto parts<HyperbolicSoil> = std::tuple(&HyperbolicSoil::reference_strain);
template <>
inline constexpr auto parts<FlexibleSlope> = std::tuple(&FlexibleSlope::ky_g, &FlexibleSlope::height,
                                                        &FlexibleSlope::shear_velocity, &FlexibleSlope::damping_ratio,
                                                        &FlexibleSlope::modes, &FlexibleSlope::rock_velocity,
                                                        &FlexibleSlope::soil, &FlexibleSlope::method,
                                                        &FlexibleSlope::degrading);

void bind_flexible_slope(py::module_& m) {
  value_class<HyperbolicSoil>(m, "HyperbolicSoil",
                              R"(Soil whose shear modulus and damping depend on the strain, for `FlexibleSlope`.

G/Gmax = 1 / (1 + g/gr), and the damping ratio is 0.62 (G/Gmax)^0.1 D + 0.01, where
D = (4/pi) (1 + gr/g) (1 - (gr/g) ln(1 + g/gr)) - 2/pi is that of Masing's rule (Darendeli 2001).

Parameters
----------
reference_strain : float
    gr, at which the modulus is half of Gmax; positive and finite.

Warns
-----
PlausibilityWarning
    A strain of 0.02 or more, which may be in percent.)")
      .def(py::init([](double reference_strain) {
             check_unit("reference strain", "HyperbolicSoil", "reference_strain", reference_strain);
             return HyperbolicSoil(reference_strain);
           }),
           py::kw_only(), py::arg("reference_strain"))
      .def_property_readonly("reference_strain", &HyperbolicSoil::reference_strain, "gr.")
      .def(
          "modulus_ratio",
          [](const HyperbolicSoil& s, const py::object& strain) {
            return of_each(strain, "HyperbolicSoil.modulus_ratio: strain",
                           [&](double g) { return s.modulus_ratio(g); });
          },
          py::arg("strain"),
          R"(G/Gmax at strains of at least 0.

Parameters
----------
strain : float or array_like
    Finite and at least 0.

Returns
-------
float or ndarray)")
      .def(
          "damping_ratio",
          [](const HyperbolicSoil& s, const py::object& strain) {
            return of_each(strain, "HyperbolicSoil.damping_ratio: strain",
                           [&](double g) { return s.damping_ratio(g); });
          },
          py::arg("strain"),
          R"(Damping ratio at strains of at least 0.

Parameters
----------
strain : float or array_like
    Finite and at least 0.

Returns
-------
float or ndarray)")
      .def("__repr__", [](const HyperbolicSoil& s) {
        return "HyperbolicSoil(reference_strain=" + detail::shortest(s.reference_strain()) + ")";
      });

  const auto as = [](SlopeMethod method) {
    return [method](const py::object& self, const py::object& motion) {
      FlexibleSlope slope = self.cast<const FlexibleSlope&>();
      slope.method = method;
      return integrate_structure(py::cast(slope), motion, 0, 0, true, 0, {});
    };
  };
  m.attr("_most_modes") = FlexibleSlope::most_modes;
  value_class<FlexibleSlope>(
      m, "FlexibleSlope",
      R"(A flexible mass that slides downhill, such as an earth dam: coupled and decoupled sliding-block analysis.

A uniform shear column of height H and shear-wave velocity Vs, with the modes w_j = (2 j - 1) pi Vs / (2 H) and the mass
fractions 8 / ((2 j - 1)^2 pi^2). Coupled: the column moves on the sliding surface, as an `IsolatedStructure` that slides
one way. Decoupled: the base shear of a column that does not slide drives a rigid block. Positive ground acceleration
points downhill, and displacements are positive downhill.

Parameters
----------
ky_g : float or Degrading
    Yield acceleration [g], finite and at least 0; or a law by which it changes with the distance slid downhill.
height : float
    H [m], positive and finite.
shear_velocity : float
    Vs [m/s], at small strains; positive and finite.
damping_ratio : float, optional
    Of each mode, finite and at least 0. Not with `soil`.
modes : int, optional
    How many modes move, from 1 to 1000; the mass of the others rides with the base. Default 1, the usual analysis.
rock_velocity : float, optional
    Shear-wave velocity Vr of the rock [m/s]; default: rigid rock. Radiation adds min(0.55016 (Vr/Vs)^-0.9904, 0.20) to
    the damping ratio, with Vs at small strains.
soil : HyperbolicSoil, optional
    Equivalent-linear soil: modulus and damping belong to the effective strain 0.65 (pi/2) u_max / H, u_max the largest
    displacement of the top relative to the base without sliding. Iterated until neither changes by more than 1e-12.
method : 'coupled' or 'decoupled', optional

Raises
------
ValueError
    A value out of range; a damping ratio together with `soil`.

Warns
-----
PlausibilityWarning
    A ky_g from 0.8 to 100, which may be in m/s^2 or percent of g; a damping ratio from 1 to 100, which may be in percent;
    a velocity outside 10 to 8000 m/s, which may be in km/s or ft/s; a first period 4 H / Vs of 5 s or more.

Examples
--------
>>> import stickslip as ss
>>> slope = ss.FlexibleSlope(ky_g=0.1, height=50, shear_velocity=600, damping_ratio=0.15)
>>> quake = ss.GroundMotion([0, 3, -3, 0, 2, 0], dt=0.2)
>>> bool(slope.coupled(quake).residual > 0)
True)")
      .def(py::init([](const std::variant<double, Degrading>& ky_g, double height, double shear_velocity,
                       double damping_ratio, int modes, std::optional<double> rock_velocity,
                       const std::optional<HyperbolicSoil>& soil, const std::string& method) {
             const auto* const degrading = std::get_if<Degrading>(&ky_g);
             FlexibleSlope slope{degrading ? 0 : std::get<double>(ky_g),
                                 height,
                                 shear_velocity,
                                 damping_ratio,
                                 modes,
                                 rock_velocity,
                                 soil,
                                 method_of(method),
                                 degrading ? std::optional(*degrading) : std::nullopt};
             check(slope);
             const std::string who = "FlexibleSlope";
             check_unit("yield acceleration", who, "ky_g", slope.ky_g);
             check_unit("first period of a slope", who, "the first period", 4 * height / shear_velocity);
             check_unit("shear-wave velocity", who, "shear_velocity", shear_velocity);
             check_unit("shear-wave velocity", who, "rock_velocity", rock_velocity);
             check_unit("damping ratio", who, "damping_ratio", damping_ratio);
             return slope;
           }),
           py::kw_only(), py::arg("ky_g"), py::arg("height"), py::arg("shear_velocity"), py::arg("damping_ratio") = 0.0,
           py::arg("modes") = 1, py::arg("rock_velocity") = py::none(), py::arg("soil") = py::none(),
           py::arg("method") = "coupled")
      .def_property_readonly(
          "ky_g",
          [](const FlexibleSlope& s) -> std::variant<double, Degrading> {
            if (s.degrading) return *s.degrading;
            return s.ky_g;
          },
          "Yield acceleration [g], or the law by which it changes.")
      .def_readonly("height", &FlexibleSlope::height, "H [m].")
      .def_readonly("shear_velocity", &FlexibleSlope::shear_velocity, "Vs at small strains [m/s].")
      .def_readonly("damping_ratio", &FlexibleSlope::damping_ratio, "Of each mode, without radiation.")
      .def_readonly("modes", &FlexibleSlope::modes, "How many modes move.")
      .def_readonly("rock_velocity", &FlexibleSlope::rock_velocity, "Vr [m/s], or None.")
      .def_readonly("soil", &FlexibleSlope::soil, "The soil, or None.")
      .def_property_readonly(
          "method", [](const FlexibleSlope& s) { return name_of(s.method); }, "'coupled' or 'decoupled'.")
      .def(
          "properties",
          [](const FlexibleSlope& slope, const GroundMotion& motion) {
            const SlopeProperties found = [&] {
              const py::gil_scoped_release released;
              return properties(slope, motion);
            }();
            py::dict result;
            result["shear_velocity"] = found.shear_velocity;
            result["damping_ratio"] = found.damping_ratio;
            result["strain"] = found.strain;
            result["iterations"] = found.iterations;
            return result;
          },
          py::arg("motion"),
          R"(Shear-wave velocity and damping ratio of the column under a ground motion.

Parameters
----------
motion : GroundMotion
    It matters with `soil` only.

Returns
-------
dict
    shear_velocity [m/s], damping_ratio (with radiation), strain (the effective one; 0 without `soil`), iterations.

Raises
------
ConvergenceError
    The iteration does not converge.)")
      .def("coupled", as(SlopeMethod::coupled), py::arg("motion"),
           R"(The settled response of the coupled analysis.

Parameters
----------
motion : GroundMotion
    Positive accelerations point downhill.

Returns
-------
StructureResponse)")
      .def("decoupled", as(SlopeMethod::decoupled), py::arg("motion"),
           R"(The settled response of the decoupled analysis.

Parameters
----------
motion : GroundMotion
    Positive accelerations point downhill.

Returns
-------
StructureResponse)")
      .def("__repr__", &text_of);
}

}  // namespace stickslip::python
