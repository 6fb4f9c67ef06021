#include "bindings.hpp"
#include "response.hpp"

namespace stickslip::python {
namespace {

Response slide(const AnySlider& slider, const GroundMotion& ground, const IntegrateOptions& options,
               Response&& storage) {
  return std::visit([&](const auto& s) { return integrate(s, ground, options, std::move(storage)); }, slider);
}
Response slide(const ViscousSlider& slider, const GroundMotion& ground, const IntegrateOptions& options,
               Response&& storage) {
  return integrate(slider, ground, options, std::move(storage));
}

template <class S>
Recording integrate_any(const S& slider, const py::object& motion, double displacement, double velocity, bool settle) {
  if (!py::isinstance<GroundMotion>(motion))
    throw py::type_error("integrate: motion must be a GroundMotion, got " +
                         py::type::of(motion).attr("__name__").cast<std::string>());
  const auto& ground = motion.cast<const GroundMotion&>();
  const IntegrateOptions options{displacement, velocity, settle, check_for_interrupt};
  Response storage = Storage::take();
  Response response = [&] {
    const py::gil_scoped_release released;
    return slide(slider, ground, options, std::move(storage));
  }();
  return {std::move(response), py::cast(slider), motion};
}

}  // namespace

void bind_integrate(py::module_& m) {
  m.def("integrate", &integrate_any<AnySlider>, py::arg("slider"), py::arg("motion"), py::kw_only(),
        py::arg("displacement") = 0.0, py::arg("velocity") = 0.0, py::arg("settle") = false,
        R"(Slides through a whole ground motion.

x'' + level(x) sgn(x') + wn^2 x = -n(t), thesis (4.51) to (4.53), (2.44), (2.50), with all breakaways, reversals and
arrests, up to two reversals within one straight piece of n(t).

Parameters
----------
slider : Slider, Coulomb or Caster
    What slides; a law alone is a slider without a spring.
motion : GroundMotion
    The ground acceleration.
displacement : float, optional
    x at the start [m], finite.
velocity : float, optional
    x' at the start [m/s], finite.
settle : bool, optional
    Go on under zero ground acceleration after the last sample until the slider rests, so that the residual is final.

Returns
-------
Response

Raises
------
ValueError
    A start that is not finite, or that moves against an infinite slip level.
OverflowError
    A displacement, velocity or energy beyond the range of doubles.
ConvergenceError
    Asked to settle, and the slider does not come to rest (no friction; a caster that has escaped). More than 1,000,000
    events and eight a sample (a spring that swings that often between samples).

Notes
-----
Constant friction is solved in closed form between events: exact to round-off, 1e-13 of the scale of x; 7 to 25 ns a
sample, 20 to 65 with a spring. The caster by Taylor series, to near round-off; 150 to 850 ns a sample. The interpreter
is not held meanwhile.)");
  m.def("integrate", &integrate_any<ViscousSlider>, py::arg("slider"), py::arg("motion"), py::kw_only(),
        py::arg("displacement") = 0.0, py::arg("velocity") = 0.0, py::arg("settle") = false,
        R"(The same for the linear system, x'' + zeta x' + wn^2 x = -n(t), thesis (4.2), (5.2).

Parameters, answers and errors are those of a slider on friction. There are no events but the end; what is dissipated is
the integral of zeta x'^2 dt; settle must be False, for it never comes to rest. Exact to round-off for any damping and
step; some 150 ns a sample at even steps, 1.2 us where they are uneven.)");
}

}  // namespace stickslip::python
