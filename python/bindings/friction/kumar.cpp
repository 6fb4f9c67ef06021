#include "stickslip/friction/kumar.hpp"

#include <pybind11/stl.h>

#include <string>

#include "friction/arguments.hpp"
#include "parts.hpp"

namespace stickslip::python {

template <>
void bind_law<KumarFriction>(py::module_& m) {
  auto type =
      value_class<KumarFriction>(m, "KumarFriction",
                                 R"(Friction of a sliding isolator that depends on pressure, speed and temperature.

mu = mu_ref kp kv kT, with

- kp = 0.7^(0.02 (p - p0)), p and p0 in MPa, p = static_pressure N/g the pressure under the normal force N;
- kv = 1 - 0.5 exp(-rate |x'|);
- kT = 0.79 (0.7^(0.02 T) + 0.40), T in degrees Celsius.

At rest the slider withstands loads up to the level at zero speed. T is the temperature at the center of the sliding
surface. Friction heats it while the slider covers it:

T = temperature + sqrt(D) / (k sqrt(pi)) times the integral of q(t - tau) / sqrt(tau) over tau > 0,
q = mu p |x'| while |x| < contact_radius sqrt(pi/4), otherwise 0.

Parameters
----------
mu_ref : float
    Coefficient of friction at high speed, at p = p0 and 20 degrees Celsius; finite and at least 0.
static_pressure : float
    p where N = g [Pa]; positive, below 1e9.
reference_pressure : float
    p0 [Pa]; positive, below 1e9.
contact_radius : float
    Radius of the slider's contact area [m]; positive. Infinite if it always covers the center.
temperature : float, optional
    At the start [degrees Celsius], from -100 to 400.
rate : float, optional
    Of kv [s/m]; finite and at least 0.
diffusivity : float, optional
    D, thermal diffusivity of the steel [m^2/s]; positive.
conductivity : float, optional
    k, thermal conductivity of the steel [W/(m K)]; positive. Infinite if friction does not heat the surface.

Raises
------
ValueError
    A value out of range.

Warns
-----
PlausibilityWarning
    A pressure below 1e5 Pa, which may be in MPa or kPa; mu_ref from 3 to 100, which may be in percent; a rate below
    2 s/m, which may be in s/cm.

Notes
-----
The motion is computed by collocation in time, to some 1e-7 of the scale, with the heat's history as 42 exponentials
(`SurfaceHeat`), so that the cost does not grow with time: 3 us per sample of the Kobe record, 3.5 us of noise.
`Response.temperature` has the temperature at the samples; `State.heat` continues it. Theories and sensitivities do not
cover it.

References
----------
M. Kumar, A. S. Whittaker, M. C. Constantinou, Characterizing friction in sliding isolation bearings, Earthquake
Engineering & Structural Dynamics 44 (2015), 1409-1425.

Examples
--------
>>> law = KumarFriction(mu_ref=0.06, static_pressure=50e6, reference_pressure=50e6, contact_radius=0.2)
>>> round(Slider(law).resist(speed=1) / STANDARD_GRAVITY, 4)
0.0601)");
  type.def(py::init([](double mu_ref, double static_pressure, double reference_pressure, double contact_radius,
                       double temperature, double rate, double diffusivity, double conductivity) {
             const KumarFriction made({mu_ref, static_pressure, reference_pressure, contact_radius, temperature, rate,
                                       diffusivity, conductivity});
             const auto check = [](const char* quantity, const char* name, double value) {
               check_unit(quantity, "KumarFriction", name, value);
             };
             check("coefficient of friction", "mu_ref", mu_ref);
             check("pressure", "static_pressure", static_pressure);
             check("pressure", "reference_pressure", reference_pressure);
             check("length", "contact_radius", contact_radius);
             check("temperature", "temperature", temperature);
             check("rate", "rate", rate);
             check("diffusivity", "diffusivity", diffusivity);
             check("conductivity", "conductivity", conductivity);
             return made;
           }),
           py::kw_only(), py::arg("mu_ref"), py::arg("static_pressure"), py::arg("reference_pressure"),
           py::arg("contact_radius"), py::arg("temperature") = 20.0, py::arg("rate") = 100.0,
           py::arg("diffusivity") = 4.44e-6, py::arg("conductivity") = 18.0);
  const auto property = [&](const char* name, double KumarFriction::Parameters::*part, const char* doc) {
    type.def_property_readonly(
        name, [part](const KumarFriction& law) { return law.parameters().*part; }, doc);
  };
  using P = KumarFriction::Parameters;
  property("mu_ref", &P::mu_ref, "Coefficient of friction at high speed, at p0 and 20 degrees Celsius.");
  property("static_pressure", &P::static_pressure, "p where N = g [Pa].");
  property("reference_pressure", &P::reference_pressure, "p0 [Pa].");
  property("contact_radius", &P::contact_radius, "Radius of the slider's contact area [m].");
  property("temperature", &P::temperature, "Temperature at the start [degrees Celsius].");
  property("rate", &P::rate, "Of kv [s/m].");
  property("diffusivity", &P::diffusivity, "Thermal diffusivity of the steel [m^2/s].");
  property("conductivity", &P::conductivity, "Thermal conductivity of the steel [W/(m K)].");
  type.def("__repr__", [](const KumarFriction& law) {
    const P& p = law.parameters();
    const auto unless = [&](const char* name, double value, double usual) {
      return value == usual ? std::string() : std::string(", ") + name + "=" + literal(value);
    };
    const P usual{};
    return "KumarFriction(mu_ref=" + literal(p.mu_ref) + ", static_pressure=" + literal(p.static_pressure) +
           ", reference_pressure=" + literal(p.reference_pressure) + ", contact_radius=" + literal(p.contact_radius) +
           unless("temperature", p.temperature, usual.temperature) + unless("rate", p.rate, usual.rate) +
           unless("diffusivity", p.diffusivity, usual.diffusivity) +
           unless("conductivity", p.conductivity, usual.conductivity) + ")";
  });
  explain_constructor(type,
                      "KumarFriction: give mu_ref=, static_pressure= and reference_pressure= [Pa], and contact_radius= "
                      "[m]");
}

}  // namespace stickslip::python
