#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>
#include <variant>

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

// c [1/s], given as such or as a part of critical damping.
double damping_from(std::optional<double> damping, std::optional<double> ratio, double natural_frequency) {
  if (damping && ratio)
    throw std::invalid_argument("Slider: give damping or damping_ratio, got both (" +
                                given("damping", damping, " 1/s, ") + given("damping_ratio", ratio, ")"));
  if (!ratio) return damping.value_or(0);
  detail::require(std::isfinite(*ratio) && *ratio >= 0, "Slider: damping_ratio must be finite and at least 0", *ratio);
  detail::require(natural_frequency > 0, "Slider: damping_ratio needs a spring (natural_frequency or period)", *ratio);
  return 2 * natural_frequency * *ratio;
}

template <class Law>
void add_law(py::class_<AnySlider>& slider) {
  slider.def(py::init([](const Law& law, std::optional<double> natural_frequency, std::optional<double> damping,
                         std::optional<double> period, std::optional<double> damping_ratio) {
               const double wn = natural_frequency_from(natural_frequency, period);
               return AnySlider(Slider<Law>(law, wn, damping_from(damping, damping_ratio, wn)));
             }),
             py::arg("law"), py::arg("natural_frequency") = py::none(), py::arg("damping") = py::none(), py::kw_only(),
             py::arg("period") = py::none(), py::arg("damping_ratio") = py::none());
  py::implicitly_convertible<Law, AnySlider>();
}

template <class... Laws>
void add_laws(py::class_<AnySlider>& slider, const std::variant<Slider<Laws>...>*) {
  (add_law<Laws>(slider), ...);
}

py::object law_of(const AnySlider& slider) {
  return std::visit([](const auto& s) { return py::cast(s.law()); }, slider);
}

double natural_frequency_of(const AnySlider& slider) {
  return std::visit([](const auto& s) { return s.natural_frequency(); }, slider);
}

double damping_of(const AnySlider& slider) {
  return std::visit([](const auto& s) { return s.damping(); }, slider);
}

Direction direction_of(bool backward) { return backward ? Direction::backward : Direction::forward; }

}  // namespace

void bind_slider(py::module_& m) {
  py::class_<AnySlider> slider(
      m, "Slider", R"(The system that moves: a friction law, an optional centering spring, an optional damper.

x'' + resist sgn(x') + c x' + wn^2 x = -n(t), thesis (2.27), (2.50), (4.2): x the displacement relative to the ground
[m], n the ground acceleration [m/s^2]. At rest it stays while -hold_backward <= -(n + wn^2 x) <= hold_forward.

Parameters
----------
law : Coulomb, Caster or VelocityDependent
    What holds at rest and what resists sliding.
natural_frequency : float, optional
    wn of the mass on its spring, without friction [rad/s]; finite and at least 0, 0 is no spring.
damping : float, optional
    c of the damper per unit mass [1/s]; finite and at least 0, 0 is none.
period : float, optional
    2 pi / wn [s], instead of natural_frequency; positive and finite.
damping_ratio : float, optional
    c / (2 wn), the part of critical damping, instead of damping; finite and at least 0. Needs a spring.

Raises
------
ValueError
    A value out of its range; natural_frequency and period, or damping and damping_ratio, both given; a damping_ratio
    without a spring.

Notes
-----
Wherever a slider is asked for, a law alone will do: a slider without spring and damper.)");
  add_laws(slider, static_cast<const AnySlider*>(nullptr));
  slider
      .def_static(
          "in_cup",
          [](const AnySlider& law, double cup_radius, double wheel_radius, double damping) {
            return std::visit(
                [&](const auto& s) -> AnySlider {
                  if (s.natural_frequency() != 0 || s.damping() != 0)
                    throw std::invalid_argument("Slider: in_cup takes a law without spring and damper");
                  return std::remove_cvref_t<decltype(s)>::in_cup(s.law(), cup_radius, wheel_radius, damping);
                },
                law);
          },
          py::arg("law"), py::kw_only(), py::arg("cup_radius"), py::arg("wheel_radius") = 0.0, py::arg("damping") = 0.0,
          R"(A slider whose wheels stand in cups and climb their sides, thesis (2.49) as corrected.

A pendulum of the length of the bowl's radius less the wheel's: wn = sqrt(g / (cup_radius - wheel_radius)).

Parameters
----------
law : Coulomb, Caster or VelocityDependent
cup_radius : float
    Radius of curvature of the bowl [m], positive and finite.
wheel_radius : float, optional
    Radius of the wheel that rolls in it [m], at least 0 and less than cup_radius; 0, a point that slides, is the
    thesis's form.
damping : float, optional
    c of a damper per unit mass [1/s]; finite and at least 0.

Returns
-------
Slider

Raises
------
ValueError
    A value out of its range; a slider that has a spring or damper already.

Notes
-----
To first order in x / (cup_radius - wheel_radius); the next term is the third.)")
      .def_property_readonly("law", &law_of, "The friction law.")
      .def_property_readonly("natural_frequency", &natural_frequency_of, "wn [rad/s]; 0 without a spring.")
      .def_property_readonly("damping", &damping_of, "c [1/s]; 0 without a damper.")
      .def_property_readonly(
          "period", [](const AnySlider& self) { return 2 * std::numbers::pi / natural_frequency_of(self); },
          "2 pi / wn [s]; inf without a spring.")
      .def_property_readonly(
          "damping_ratio", [](const AnySlider& self) { return damping_of(self) / (2 * natural_frequency_of(self)); },
          "c / (2 wn); without a spring inf, or nan without a damper too.")
      .def(
          "hold",
          [](const AnySlider& self, double displacement, bool backward) {
            return std::visit([&](const auto& s) { return hold(s.law(), displacement, direction_of(backward)); }, self);
          },
          py::arg("displacement") = 0.0, py::kw_only(), py::arg("backward") = false,
          R"(What friction holds at rest.

Parameters
----------
displacement : float, optional
    x [m].
backward : bool, optional
    Against backward instead of forward sliding.

Returns
-------
float
    Friction force per unit mass [m/s^2].)")
      .def(
          "resist",
          [](const AnySlider& self, double displacement, double speed, bool backward) {
            return std::visit(
                [&](const auto& s) -> double { return resist(s.law(), displacement, direction_of(backward), speed); },
                self);
          },
          py::arg("displacement") = 0.0, py::arg("speed") = 0.0, py::kw_only(), py::arg("backward") = false,
          R"(What friction resists with while it slides.

Parameters
----------
displacement : float, optional
    x [m].
speed : float, optional
    |x'| [m/s].
backward : bool, optional
    Against backward instead of forward sliding.

Returns
-------
float
    Friction force per unit mass [m/s^2].)")
      .def("__repr__",
           [](const AnySlider& self) {
             const double wn = natural_frequency_of(self), c = damping_of(self);
             return "Slider(" + py::repr(law_of(self)).cast<std::string>() +
                    (wn > 0 ? ", natural_frequency=" + detail::shortest(wn) : "") +
                    (c > 0 ? ", damping=" + detail::shortest(c) : "") + ")";
           })
      .def(
          "__eq__",
          [](const AnySlider& a, const py::object& other) {
            if (!py::isinstance<AnySlider>(other)) return false;  // a law is no slider here
            const auto& b = other.cast<const AnySlider&>();
            return law_of(a).equal(law_of(b)) && natural_frequency_of(a) == natural_frequency_of(b) &&
                   damping_of(a) == damping_of(b);
          },
          py::is_operator())
      .def("__hash__",
           [](const AnySlider& s) {
             return py::hash(py::make_tuple(law_of(s), natural_frequency_of(s), damping_of(s)));
           })
      .def("__reduce__", [](const py::object& self) {
        return py::make_tuple(py::type::of(self),
                              py::make_tuple(self.attr("law"), self.attr("natural_frequency"), self.attr("damping")));
      });
}

}  // namespace stickslip::python
