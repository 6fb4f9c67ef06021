#include "bindings.hpp"

namespace stickslip::python {
namespace {

template <class Law>
void add_law(py::class_<AnySlider>& slider) {
  slider.def(
      py::init([](const Law& law, double natural_frequency) { return AnySlider(Slider<Law>(law, natural_frequency)); }),
      py::arg("law"), py::arg("natural_frequency") = 0.0);
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

}  // namespace

void bind_slider(py::module_& m) {
  py::class_<AnySlider> slider(m, "Slider", R"(The system that moves: a friction law and an optional centering spring.

x'' + level(x) sgn(x') + wn^2 x = -n(t), thesis (2.27), (2.50): x the displacement relative to the ground [m], n the
ground acceleration [m/s^2]. At rest it stays while -level_backward <= -(n + wn^2 x) <= level_forward.

Parameters
----------
law : Coulomb or Caster
    Gives the slip level.
natural_frequency : float, optional
    wn of the mass on its spring, without friction [rad/s]; finite and at least 0, 0 is no spring. A period T is
    2 pi / T.

Raises
------
ValueError
    natural_frequency out of its range.

Notes
-----
Wherever a slider is asked for, a law alone will do: a slider without a spring.)");
  add_laws(slider, static_cast<const AnySlider*>(nullptr));
  slider.def_property_readonly("law", &law_of, "The friction law.")
      .def_property_readonly("natural_frequency", &natural_frequency_of, "wn [rad/s]; 0 without a spring.")
      .def(
          "level",
          [](const AnySlider& self, double displacement, bool backward) {
            return std::visit(
                [&](const auto& s) -> double {
                  return s.law().resist(displacement, backward ? Direction::backward : Direction::forward);
                },
                self);
          },
          py::arg("displacement") = 0.0, py::kw_only(), py::arg("backward") = false,
          R"(The slip level at a displacement.

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
      .def("__repr__",
           [](const AnySlider& self) {
             const double wn = natural_frequency_of(self);
             return "Slider(" + py::repr(law_of(self)).cast<std::string>() +
                    (wn > 0 ? ", natural_frequency=" + detail::shortest(wn) : "") + ")";
           })
      .def(
          "__eq__",
          [](const AnySlider& a, const py::object& other) {
            if (!py::isinstance<AnySlider>(other)) return false;  // a law is no slider here
            const auto& b = other.cast<const AnySlider&>();
            return law_of(a).equal(law_of(b)) && natural_frequency_of(a) == natural_frequency_of(b);
          },
          py::is_operator())
      .def("__hash__", [](const AnySlider& s) { return py::hash(py::make_tuple(law_of(s), natural_frequency_of(s))); })
      .def("__reduce__", [](const py::object& self) {
        return py::make_tuple(py::type::of(self), py::make_tuple(self.attr("law"), self.attr("natural_frequency")));
      });
}

}  // namespace stickslip::python
