#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>
#include <variant>

#include <pybind11/stl.h>

#include "in_python.hpp"
#include "parts.hpp"

namespace stickslip::python {
namespace {

std::string given(const char* name, const std::optional<double>& value, const char* unit) {
  return std::string(name) + " = " + detail::shortest(*value) + unit;
}

// wn [rad/s], given as such or as a period.
double natural_frequency_from(std::optional<double> natural_frequency, std::optional<double> period) {
  if (natural_frequency && period)
    throw std::invalid_argument("Slider: give natural_frequency or period, got both (" +
                                given("natural_frequency", natural_frequency, " rad/s, ") +
                                given("period", period, " s)"));
  if (!period) return natural_frequency.value_or(0);
  detail::require(std::isfinite(*period) && *period > 0, "Slider: period must be positive and finite", *period, "s");
  return 2 * std::numbers::pi / *period;
}

// c [1/s], given as such or as a fraction of critical damping.
double damping_from(std::optional<double> damping, std::optional<double> ratio, double natural_frequency) {
  if (damping && ratio)
    throw std::invalid_argument("Slider: give damping or damping_ratio, got both (" +
                                given("damping", damping, " 1/s, ") + given("damping_ratio", ratio, ")"));
  if (!ratio) return damping.value_or(0);
  detail::require(std::isfinite(*ratio) && *ratio >= 0, "Slider: damping_ratio must be finite and at least 0", *ratio);
  detail::require(natural_frequency > 0, "Slider: damping_ratio needs a spring (natural_frequency or period)", *ratio);
  return 2 * natural_frequency * *ratio;
}

// The slider of a law without anything else; rejects objects that are not laws.
AnySlider alone(const py::object& law) {
  if (auto slider = slider_of_law(law)) return *std::move(slider);
  throw py::type_error("Slider: law must be a friction law, such as Coulomb(mu=0.3), got " +
                       py::type::of(law).attr("__name__").cast<std::string>());
}

AnySlider mounted(const py::object& law, const Mounting& mounting) {
  return std::visit(
      [&]<class Law>(const Slider<Law>& slider) -> AnySlider { return Slider<Law>(slider.law(), mounting); },
      alone(law));
}

// A state at rest; `temperature` [degrees Celsius] matters to laws that depend on it.
State slid_to(const AnySlider& slider, double displacement, double sliding_distance,
              std::optional<double> temperature) {
  detail::require(std::isfinite(sliding_distance) && sliding_distance >= 0,
                  "Slider: sliding_distance must be finite and at least 0", sliding_distance, "m");
  State state = State::at(displacement, 0);
  state.sliding_distance = sliding_distance;
  if (temperature) {
    detail::require(std::isfinite(*temperature), "Slider: temperature must be finite", *temperature, "degrees Celsius");
    std::visit(
        [&]<class Law>(const Slider<Law>& one) {
          if constexpr (HeatedLaw<Law>) state.heat = SurfaceHeat::with(one.law().half_integral_at(*temperature));
        },
        slider);
  }
  return state;
}

// The values that differ from the defaults, as arguments.
std::string described(const Mounting& mounting) {
  const auto number = [](const char* name, double value) {
    return value != 0 ? std::string(", ") + name + "=" + detail::shortest(value) : std::string();
  };
  return number("natural_frequency", mounting.natural_frequency) + number("damping", mounting.damping) +
         number("slope_degrees", mounting.slope_degrees) + (mounting.one_way ? ", one_way=True" : "") +
         (mounting.stops ? ", stops=" + py::repr(py::cast(mounting.stops)).cast<std::string>() : "") +
         (mounting.pendulum ? ", pendulum=True" : "");
}

// The radius [m] with the fewest digits that gives wn to the last bit.
double radius_of(double natural_frequency) {
  const double radius = standard_gravity / (natural_frequency * natural_frequency);
  for (int digits = 1; digits <= 17; ++digits) {
    char text[32];
    std::snprintf(text, sizeof text, "%.*g", digits, radius);
    const double shorter = std::strtod(text, nullptr);
    if (std::sqrt(standard_gravity / shorter) == natural_frequency) return shorter;
  }
  return radius;
}

// "radius=2.2" or "period=3" for a pendulum that `FrictionPendulum` gives back to the last bit from at most six digits;
// else empty.
std::string dish_of(const Mounting& mounting) {
  const double wn = mounting.natural_frequency;
  if (!mounting.pendulum || mounting.slope_degrees != 0 || mounting.one_way) return "";
  const std::string radius = detail::shortest(radius_of(wn));
  if (radius.size() <= 7) return "radius=" + radius;
  for (int digits = 1; digits <= 6; ++digits) {
    char text[32];
    std::snprintf(text, sizeof text, "%.*g", digits, 2 * std::numbers::pi / wn);
    if (2 * std::numbers::pi / std::strtod(text, nullptr) == wn) return std::string("period=") + text;
  }
  return std::sqrt(standard_gravity / std::strtod(radius.c_str(), nullptr)) == wn ? "radius=" + radius : "";
}

py::object law_of(const AnySlider& slider) {
  return std::visit([](const auto& s) { return law_object(s.law()); }, slider);
}

double natural_frequency_of(const AnySlider& slider) { return mounting_of(slider).natural_frequency; }

double damping_of(const AnySlider& slider) { return mounting_of(slider).damping; }

Direction direction_of(bool backward) { return backward ? Direction::backward : Direction::forward; }

}  // namespace

AnySlider slider_from(const py::object& law, std::optional<double> natural_frequency, std::optional<double> damping,
                      std::optional<double> period, std::optional<double> damping_ratio, const py::object& slope,
                      bool one_way, const Stops* stops, bool pendulum) {
  const double wn = natural_frequency_from(natural_frequency, period);
  // A quantity in degrees would count as a number of radians. A plain float does not need NumPy.
  const double degrees = PyFloat_CheckExact(slope.ptr()) ? PyFloat_AsDouble(slope.ptr())
                                                         : to_number(slope, "Slider: slope_degrees", "degree");
  AnySlider made = mounted(
      law, {wn, damping_from(damping, damping_ratio, wn), degrees, one_way, stops ? *stops : Stops(), pendulum});
  if (PyNumber_Check(slope.ptr()) != 0 && !py::hasattr(slope, "to"))  // no quantity
    check_unit("slope", "Slider", "slope_degrees", degrees);
  check_unit("angular frequency", "Slider", "natural_frequency", natural_frequency);
  check_unit("period", "Slider", "period", period);
  check_unit("damper", "Slider", "damping", damping);
  check_unit("damping ratio of one mode", "Slider", "damping_ratio", damping_ratio);
  return made;
}

void bind_slider(py::module_& m) {
  py::class_<AnySlider> slider(
      m, "Slider",
      R"(A mass that slides: a friction law, and optionally a spring, a damper, a slope and stops.

x'' + resist N+/g sgn(x') + c x' + wn^2 x = p, thesis (2.27), (2.50), (4.2): x is the displacement relative to the
ground [m], along the slope and positive downhill. p = (g + a_z) sin(slope) - n cos(slope),
N = (g + a_z) cos(slope) + n sin(slope) and N+ = max(N, 0), where n and a_z are the horizontal and the upward ground
acceleration [m/s^2]; on level ground without vertical motion p = -n and N = g. A slider at rest stays at rest while
-hold_backward N+/g <= p - wn^2 x <= hold_forward N+/g.

Parameters
----------
law : FrictionLaw
    The friction at rest and while sliding.
natural_frequency : float, optional
    wn of the mass on its spring, without friction [rad/s]; finite and at least 0; 0 means no spring.
damping : float, optional
    c of the damper per unit mass [1/s]; finite and at least 0; 0 means no damper.
period : float, optional
    2 pi / wn [s], instead of natural_frequency; positive and finite.
damping_ratio : float, optional
    c / (2 wn), the fraction of critical damping, instead of damping; finite and at least 0. Needs a spring.
slope_degrees : float, optional
    Slope of the ground [degrees], at least 0 and less than 90; forward is downhill. n is horizontal, positive toward
    the downhill side.
one_way : bool, optional
    Never slides backward, like Newmark's block.
stops : Stops, optional
    Stops that limit the displacement; default: none.
pendulum : bool, optional
    The spring is that of a friction pendulum, with the force wn^2 x N+/g; see `FrictionPendulum`.

Raises
------
ValueError
    A value out of range; natural_frequency and period, or damping and damping_ratio, both given; a damping_ratio or
    a pendulum without a spring; a slope on which the mass slides under its own weight without a spring or a stop.

Warns
-----
PlausibilityWarning
    A slope of less than one degree, which may be in radians; a period of 60 s or more, which may be in ms; a
    damping_ratio from 2 to 100, which may be in percent.

Notes
-----
Functions that take a slider also take a law: a slider on level ground without spring and damper.)");
  slider.def(py::init(&slider_from), py::arg("law"), py::arg("natural_frequency") = py::none(),
             py::arg("damping") = py::none(), py::kw_only(), py::arg("period") = py::none(),
             py::arg("damping_ratio") = py::none(), py::arg("slope_degrees") = 0.0, py::arg("one_way") = false,
             py::arg("stops") = py::none(), py::arg("pendulum") = false);
  slider
      .def_static(
          "in_cup",
          [](const AnySlider& law, double cup_radius, double wheel_radius, double damping) {
            check_unit("radius", "Slider.in_cup", "cup_radius", cup_radius);
            check_unit("length", "Slider.in_cup", "wheel_radius", wheel_radius);
            check_unit("damper", "Slider.in_cup", "damping", damping);
            return std::visit(
                [&](const auto& s) -> AnySlider {
                  if (s.mounting() != Mounting{})
                    throw std::invalid_argument("Slider: in_cup takes a law without spring and damper");
                  return std::remove_cvref_t<decltype(s)>::in_cup(s.law(), cup_radius, wheel_radius, damping);
                },
                law);
          },
          py::arg("law"), py::kw_only(), py::arg("cup_radius"), py::arg("wheel_radius") = 0.0, py::arg("damping") = 0.0,
          R"(A slider whose wheels stand in cups and climb their sides, thesis (2.49), corrected.

A pendulum whose length is the radius of the cup minus that of the wheel: wn = sqrt(g / (cup_radius - wheel_radius)).

Parameters
----------
law : FrictionLaw
cup_radius : float
    Radius of curvature of the cup [m], positive and finite.
wheel_radius : float, optional
    Radius of the wheel that rolls in it [m], at least 0 and less than cup_radius; 0, a sliding point, is the form in
    the thesis.
damping : float, optional
    c of a damper per unit mass [1/s]; finite and at least 0.

Returns
-------
Slider

Raises
------
ValueError
    A value out of range; a slider that already has a spring or damper.

Warns
-----
PlausibilityWarning
    A cup_radius of 20 m or more, or a wheel_radius of 3 m or more, which may be in mm, cm or inches.

Notes
-----
Holds to first order in x / (cup_radius - wheel_radius); the next term is of third order.)")
      .def_property_readonly("law", &law_of, "The friction law.")
      .def_property_readonly("natural_frequency", &natural_frequency_of, "wn [rad/s]; 0 without a spring.")
      .def_property_readonly("damping", &damping_of, "c [1/s]; 0 without a damper.")
      .def_property_readonly(
          "slope_degrees", [](const AnySlider& self) { return mounting_of(self).slope_degrees; },
          "Slope of the ground [degrees].")
      .def_property_readonly(
          "one_way", [](const AnySlider& self) { return mounting_of(self).one_way; },
          "Whether the slider never slides backward.")
      .def_property_readonly(
          "stops",
          [](const AnySlider& self) {
            const Stops& stops = mounting_of(self).stops;
            return stops ? std::optional(stops) : std::nullopt;
          },
          "The stops; None if there are none.")
      .def_property_readonly(
          "pendulum", [](const AnySlider& self) { return mounting_of(self).pendulum; },
          "Whether the spring is that of a friction pendulum.")
      .def_property_readonly(
          "radius",
          [](const AnySlider& self) -> std::optional<double> {
            if (!mounting_of(self).pendulum) return std::nullopt;
            return radius_of(natural_frequency_of(self));
          },
          "Effective radius of the dish of a friction pendulum, g / wn^2 [m]; None for other sliders.")
      .def_property_readonly(
          "period", [](const AnySlider& self) { return 2 * std::numbers::pi / natural_frequency_of(self); },
          "2 pi / wn [s]; inf without a spring.")
      .def_property_readonly(
          "damping_ratio", [](const AnySlider& self) { return damping_of(self) / (2 * natural_frequency_of(self)); },
          "c / (2 wn); without a spring, inf, or nan if there is no damper either.")
      .def(
          "hold",
          [](const AnySlider& self, double displacement, bool backward, double sliding_distance,
             std::optional<double> temperature) {
            if (backward && mounting_of(self).one_way) return never;
            const State state = slid_to(self, displacement, sliding_distance, temperature);
            return std::visit(
                [&](const auto& s) { return hold(law_at(s.law(), state), displacement, direction_of(backward)); },
                self);
          },
          py::arg("displacement") = 0.0, py::kw_only(), py::arg("backward") = false, py::arg("sliding_distance") = 0.0,
          py::arg("temperature") = py::none(),
          R"(Largest load that friction resists at rest.

Parameters
----------
displacement : float, optional
    x [m].
backward : bool, optional
    Against backward instead of forward sliding.
sliding_distance : float, optional
    Slid so far [m], where the law depends on it; at least 0.
temperature : float, optional
    Of the sliding surface [degrees Celsius], where the law depends on it; that at the start if not given.

Returns
-------
float
    Friction force per unit mass [m/s^2].)")
      .def(
          "resist",
          [](const AnySlider& self, double displacement, double speed, bool backward, double sliding_distance,
             std::optional<double> temperature) {
            if (backward && mounting_of(self).one_way) return never;
            const State state = slid_to(self, displacement, sliding_distance, temperature);
            return std::visit(
                [&](const auto& s) -> double {
                  return resist(law_at(s.law(), state), displacement, speed, direction_of(backward));
                },
                self);
          },
          py::arg("displacement") = 0.0, py::arg("speed") = 0.0, py::kw_only(), py::arg("backward") = false,
          py::arg("sliding_distance") = 0.0, py::arg("temperature") = py::none(),
          R"(Friction while sliding.

Parameters
----------
displacement : float, optional
    x [m].
speed : float, optional
    |x'| [m/s].
backward : bool, optional
    Against backward instead of forward sliding.
sliding_distance : float, optional
    Slid so far [m], where the law depends on it; at least 0.
temperature : float, optional
    Of the sliding surface [degrees Celsius], where the law depends on it; that at the start if not given.

Returns
-------
float
    Friction force per unit mass [m/s^2].)")
      .def("to_json", in_python("stickslip.slider_files", "to_json"),
           R"(The arguments of the slider, its law and its stops as JSON; `from_json` reads it.

Returns
-------
str

Raises
------
ValueError
    A law from functions, which numbers do not describe.)")
      .def_static(
          "from_json",
          [](const py::object& source) {
            return py::module_::import("stickslip.slider_files").attr("from_json")(source).cast<AnySlider>();
          },
          py::arg("source"),
          R"(A slider from JSON, as the option --slider of the command reads it.

Parameters
----------
source : str or path-like
    A text that begins with '{', or a file: an object with `kind`, 'Slider', 'FrictionPendulum' or the name of a law, and the
    arguments of that class by name. Laws and stops are such objects, too. "inf" is infinity.

Returns
-------
Slider

Raises
------
OSError
    The file cannot be read.
ValueError
    No JSON, an unknown kind, a missing or unknown argument, or a value out of range; the message names the object.)")
      .def("__repr__",
           [](const AnySlider& self) {
             const Mounting& on = mounting_of(self);
             const auto law = py::repr(law_of(self)).cast<std::string>();
             if (const std::string dish = dish_of(on); !dish.empty()) {
               const bool plain = law.starts_with("Coulomb(mu=") && law.find(',') == std::string::npos;
               Mounting rest = on;
               rest.natural_frequency = 0;
               rest.pendulum = false;
               return "FrictionPendulum(" + dish + ", " + (plain ? law.substr(8, law.size() - 9) : "law=" + law) +
                      described(rest) + ")";
             }
             return "Slider(" + law + described(on) + ")";
           })
      .def(
          "__eq__",
          [](const AnySlider& a, const py::object& other) {
            if (!py::isinstance<AnySlider>(other)) return false;  // a law is not a slider here
            const auto& b = other.cast<const AnySlider&>();
            return law_of(a).equal(law_of(b)) && mounting_of(a) == mounting_of(b);
          },
          py::is_operator())
      .def("__hash__",
           [](const AnySlider& s) { return py::hash(py::make_tuple(law_of(s), described(mounting_of(s)))); })
      .def(py::pickle(
          [](const AnySlider& self) {
            const Mounting& on = mounting_of(self);
            return py::make_tuple(law_of(self), on.natural_frequency, on.damping, on.slope_degrees, on.one_way,
                                  on.stops, on.pendulum);
          },
          [](const py::tuple& state) {
            if (state.size() != 7)
              throw std::invalid_argument("unpickling: expected 7 values, got " + std::to_string(state.size()));
            return mounted(state[0], {state[1].cast<double>(), state[2].cast<double>(), state[3].cast<double>(),
                                      state[4].cast<bool>(), state[5].cast<Stops>(), state[6].cast<bool>()});
          }));
  m.def(
      "FrictionPendulum",
      [](std::optional<double> radius, std::optional<double> period, std::optional<double> mu,
         std::optional<double> mu_slow, std::optional<double> mu_fast, std::optional<double> rate,
         const py::object& law, const Stops* stops, double damping) {
        if (radius.has_value() == period.has_value())
          throw std::invalid_argument("FrictionPendulum: give radius or period, got " +
                                      (radius
                                           ? "both (" + given("radius", radius, " m, ") + given("period", period, " s)")
                                           : std::string("neither")));
        if (period)
          detail::require(std::isfinite(*period) && *period > 0, "FrictionPendulum: period must be positive and finite",
                          *period, "s");
        check_unit("radius", "FrictionPendulum", "radius", radius);
        check_unit("period", "FrictionPendulum", "period", period);
        check_unit("rate", "FrictionPendulum", "rate", rate);
        check_unit("damper", "FrictionPendulum", "damping", damping);
        const bool varies = mu_slow || mu_fast || rate;
        if (static_cast<int>(mu.has_value()) + varies + !law.is_none() != 1 ||
            (varies && !(mu_slow && mu_fast && rate)))
          throw std::invalid_argument("FrictionPendulum: give mu, or mu_slow, mu_fast and rate, or law");
        const AnySlider friction = !law.is_none() ? alone(law)
                                   : mu ? AnySlider(Slider(Coulomb(slip_level_of(mu, {}, "FrictionPendulum"))))
                                        : AnySlider(Slider(VelocityDependent(
                                              slip_level_of(mu_slow, {}, "FrictionPendulum", "mu_slow"),
                                              slip_level_of(mu_fast, {}, "FrictionPendulum", "mu_fast"), *rate)));
        Mounting mounting;
        mounting.damping = damping;
        if (stops) mounting.stops = *stops;
        return std::visit(
            [&]<class Law>(const Slider<Law>& one) -> AnySlider {
              if (radius) return Slider<Law>::friction_pendulum(one.law(), *radius, mounting);
              mounting.natural_frequency = 2 * std::numbers::pi / *period;
              mounting.pendulum = true;
              return Slider<Law>(one.law(), mounting);
            },
            friction);
      },
      py::kw_only(), py::arg("radius") = py::none(), py::arg("period") = py::none(), py::arg("mu") = py::none(),
      py::arg("mu_slow") = py::none(), py::arg("mu_fast") = py::none(), py::arg("rate") = py::none(),
      py::arg("law") = py::none(), py::arg("stops") = py::none(), py::arg("damping") = 0.0,
      R"(A slider on a spherical dish: a friction pendulum bearing.

The restoring force is N+ x / radius, where N is the normal force per unit mass: a spring of natural frequency
sqrt(g / radius) whose force follows the vertical motion. Linear in x, for |x| up to 0.2 radius, where the next term is
2 % of the force; `Response.remark` reports motions beyond that.

Parameters
----------
radius : float, optional
    Effective radius of curvature of the dish [m], positive and finite. Give radius or period.
period : float, optional
    2 pi sqrt(radius / g) [s], positive and finite: radius = g (period / (2 pi))^2.
mu : float, optional
    Coefficient of friction, equal at all speeds.
mu_slow, mu_fast, rate : float, optional
    As for `VelocityDependent`; rate in s/m.
law : friction law, optional
    Any other friction law.
stops : Stops, optional
    The rim of the dish.
damping : float, optional
    c of a damper per unit mass [1/s]; finite and at least 0.

Returns
-------
Slider

Raises
------
ValueError
    A value out of range; not exactly one of radius and period; not exactly one of mu, (mu_slow, mu_fast, rate) and law.

Warns
-----
PlausibilityWarning
    A coefficient from 3 to 100, which may be in percent; a rate below 2 s/m, which may be in s/cm.

Notes
-----
Under a ground motion without vertical component it is a slider with a constant spring. The motion is integrated by
Taylor series in time, nearly to round-off.)");
}

}  // namespace stickslip::python
