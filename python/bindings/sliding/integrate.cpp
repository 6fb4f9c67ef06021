#include <concepts>

#include "bindings.hpp"
#include "sliding/response.hpp"

namespace stickslip::python {
namespace {

template <class S, class M>
Recording integrate_under(const S& slider, const py::object& motion, const IntegrateOptions& options) {
  const auto& ground = motion.cast<const M&>();
  Response storage = Storage::take();
  Response response = [&] {
    const py::gil_scoped_release released;
    if constexpr (std::same_as<S, AnySlider>)
      return std::visit([&](const auto& s) { return integrate(s, ground, options, std::move(storage)); }, slider);
    else
      return integrate(slider, ground, options, std::move(storage));
  }();
  return {std::move(response), py::cast(slider), motion};
}

Recording integrate_any(const AnySlider& slider, const py::object& motion, double displacement, double velocity,
                        bool settle, const std::string& contact, double sliding_distance) {
  const IntegrateOptions options{displacement,        velocity,        settle, contact_of(contact, "integrate"),
                                 check_for_interrupt, sliding_distance};
  if (py::isinstance<GroundMotion>(motion)) return integrate_under<AnySlider, GroundMotion>(slider, motion, options);
  if (py::isinstance<HarmonicMotion>(motion))
    return integrate_under<AnySlider, HarmonicMotion>(slider, motion, options);
  throw py::type_error("integrate: motion must be a GroundMotion or a HarmonicMotion, got " +
                       py::type::of(motion).attr("__name__").cast<std::string>());
}

}  // namespace

void bind_integrate(py::module_& m) {
  m.def("integrate", &integrate_any, py::arg("slider"), py::arg("motion"), py::kw_only(), py::arg("displacement") = 0.0,
        py::arg("velocity") = 0.0, py::arg("settle") = false, py::arg("contact") = "flight",
        py::arg("sliding_distance") = 0.0,
        R"(Slides through a whole motion of the ground.

x'' + resist N+/g sgn(x') + c x' + wn^2 x = p(t), thesis (4.51) to (4.53), (2.44), (2.50), (4.2); (2.27), (2.28); on level
ground without vertical motion p = -n and N = g, otherwise see `Slider`. With all breakaways, reversals, arrests, impacts on
stops, and where the slider leaves the ground and lands.

Parameters
----------
slider : Slider or friction law
    What slides; a law alone is a slider without spring and damper.
motion : GroundMotion or HarmonicMotion
    The ground acceleration. A vertical component acts; a transverse one does not (see `Response.components`). Under a
    HarmonicMotion no slope, stops or pendulum.
displacement : float, optional
    x at the start [m], finite.
velocity : float, optional
    x' at the start [m/s], finite.
settle : bool, optional
    Continue under zero ground acceleration after the last sample until the slider rests, so that the residual is
    final. The samples of the response continue too, up to the first at or after rest (see `Response.truncated`).
contact : 'flight' or 'clipped', optional
    What happens where the ground falls away from under the slider faster than it falls itself, N < 0. 'flight': it
    flies, the gap y'' = -N, without friction; spring, damper and stops go on to act. It lands where y = 0: plastic, with
    the impulse of friction -mu |y'| against x', which stops it at most. 'clipped': it stays on the ground, and friction
    is zero while N < 0.
sliding_distance : float, optional
    Slid before the start [m], finite and at least 0, for laws that depend on it: `response.state.sliding_distance` of the
    motion before.

Returns
-------
Response

Raises
------
ValueError
    A start that is not finite, beyond a stop, or against an infinite slip level or one way. A vertical motion under
    which the slider never lands. Under a HarmonicMotion a slope, stops or a pendulum.
OverflowError
    A displacement, velocity or energy beyond the range of doubles.
ConvergenceError
    Asked to settle, and the slider does not come to rest (no friction; a caster that has escaped). More than 1,000,000
    events and eight a sample, or period of a harmonic motion (a spring that swings that often between samples).

Notes
-----
Constant friction is solved in closed form between events: exact to round-off, 1e-13 of the scale of x; 13 to 25 ns a
sample, 28 to 57 with a spring; with a damper 1e-12 and some 0.3 us. The caster by Taylor series, to near round-off; 200
to 850 ns a sample. `Degrading` in closed form under horizontal motion, to 1e-12 of the scale; 0.13 us a sample. Under a harmonic motion nothing is sampled: the times of events are those of the cosine itself, in
closed form without spring and damper, else by power series to round-off; 1.5 us a cycle with Coulomb friction, 6 us with a spring, 50 us for a caster, and each sample
adds 0.1 to 0.2 us. The interpreter is not held meanwhile.

A long record of even steps is cut in pieces which, with Coulomb friction and no spring, move side by side from rest, in
vector lanes; each is then done again from where the one before has come to, until both are stuck and so move alike.
Nothing is lost by it but the last bits, and what they decide: whether a velocity that only touches zero stops there.)");
}

}  // namespace stickslip::python
