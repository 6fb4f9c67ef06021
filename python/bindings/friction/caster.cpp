#include <pybind11/stl.h>

#include "friction/arguments.hpp"
#include "parts.hpp"

namespace stickslip::python {

template <>
void bind_law<Caster>(py::module_& m) {
  auto type =
      value_class<Caster>(m, "Caster",
                          R"(A rigid mass on casters, thesis (2.27): the slip level is a sech(x / reach) + rolling.

The thesis writes 3l for the reach and has no rolling resistance. That acts along the wheel, on the fraction
|tanh(x / reach)| of the path on which it rolls; this law applies it everywhere, which is too much by up to `rolling`
while the wheel is across the motion and scrubs. Final displacements of carts that stay within their reach are therefore
too small, by up to 26 % for rolling_mu = 0.02; the page on the caster has a table, and the exact force as a `Law`. The
law holds while the wheels are neither aligned with the motion nor turned around: it is reliable for |x| up to about the
reach (thesis A.2); beyond that a real wheel is sensitive to small disturbances.

Parameters
----------
mu : float, optional
    Coefficient of friction, finite and at least 0: slip_level = mu * STANDARD_GRAVITY. Give mu or slip_level.
slip_level : float, optional
    a, friction force per unit mass at x = 0, where the wheels are across the motion [m/s^2]; finite and at least 0.
reach : float
    Distance over which the level falls off [m]; positive; inf is Coulomb friction.
rolling : float, optional
    Resistance of rolling and of the bearings, per unit mass [m/s^2]; finite and at least 0.

Raises
------
ValueError
    A value out of range; both or neither of mu and slip_level.

Warns
-----
PlausibilityWarning
    A coefficient from 3 to 100, which may be in percent; a level from 50 to 985 m/s^2, which may be in cm/s^2; with
    mu, a reach of 3 m or more, which may be in mm, cm or inches.)");
  type.def(py::init([](std::optional<double> mu, std::optional<double> slip_level, double reach, double rolling) {
             if (mu) check_unit("length", "Caster", "reach", reach);  // with a level, theories have any length
             check_unit("slip level", "Caster", "rolling", rolling);
             return Caster(slip_level_of(mu, slip_level, "Caster"), reach, rolling);
           }),
           py::kw_only(), py::arg("mu") = py::none(), py::arg("slip_level") = py::none(), py::arg("reach"),
           py::arg("rolling") = 0.0)
      .def_static(
          "from_geometry",
          [](double mu, double trail, double wheel_width, double rolling_mu, bool thesis) {
            const std::string who = "Caster.from_geometry";
            check_unit("coefficient of friction", who, "mu", mu);
            check_unit("length", who, "trail", trail);
            check_unit("length", who, "wheel_width", wheel_width);
            check_unit("coefficient of friction", who, "rolling_mu", rolling_mu);
            return thesis ? Caster::from_geometry_thesis(mu, trail, wheel_width, rolling_mu)
                          : Caster::from_geometry(mu, trail, wheel_width, rolling_mu);
          },
          py::kw_only(), py::arg("mu"), py::arg("trail"), py::arg("wheel_width"), py::arg("rolling_mu") = 0.0,
          py::arg("thesis") = false,
          R"(A caster from the mechanics of a rigid wheel pivoted ahead of its contact line, thesis A, corrected.

The balance of moments about the pivot, (B^2 + 4 (l/w) B) asinh(1/B) = sqrt(1 + B^2), determines
B = |2 v_n / (w theta')| at the midpoint of the contact, and with it the slip level mu g s, s = B asinh(1/B), and the
reach l + w B / 2. The thesis drops a term in (A.12), which leads to B = 4 l/w and the reach 3 l.

Parameters
----------
mu : float
    Coefficient of friction of wheel and floor, finite and at least 0.
trail : float
    l, horizontal distance from pivot to wheel axis [m], positive and finite.
wheel_width : float
    w, length of the line of contact [m], positive and finite.
rolling_mu : float, optional
    Coefficient of rolling resistance, finite and at least 0: rolling = rolling_mu * STANDARD_GRAVITY. It acts along the
    wheel, through the axis of the pivot, and does not affect the balance.
thesis : bool, optional
    Use (A.15), (A.16), (A.20) and (A.27) of the thesis, with corrected signs, for comparison.

Returns
-------
Caster

Raises
------
ValueError
    A value out of range.

Warns
-----
PlausibilityWarning
    A length of 3 m or more, which may be in mm, cm or inches; a coefficient from 3 to 100, which may be in percent.

Notes
-----
Accurate to a few units in the last place for every l/w > 0; takes about 2.5 us.)")
      .def_property_readonly("slip_level", &Caster::slip_level, "Level at x = 0 [m/s^2].")
      .def_property_readonly(
          "mu", [](const Caster& law) { return mu_of(law.slip_level()); },
          "Coefficient of friction at x = 0, slip_level / g.")
      .def_property_readonly("reach", &Caster::reach, "Distance over which the level falls off [m].")
      .def_property_readonly("rolling", &Caster::rolling, "Rolling resistance [m/s^2].")
      .def("__repr__", [](const Caster& law) {
        return "Caster(" + level_argument(law.slip_level()) + ", reach=" + literal(law.reach()) +
               (law.rolling() > 0 ? ", rolling=" + detail::shortest(law.rolling()) : "") + ")";
      });
  explain_constructor(type, "Caster: give mu= or slip_level= [m/s^2], and reach= [m]");
}

}  // namespace stickslip::python
