#include <pybind11/stl.h>

#include <optional>
#include <string>
#include <vector>

#include "bindings.hpp"
#include "sliding/response.hpp"
#include "sliding/units_remark.hpp"

namespace stickslip::python {
namespace {

template <class M>
ResponseWithInputs integrate_under(const AnySlider& slider, const py::object& motion, const IntegrateOptions& options) {
  const auto& ground = motion.cast<const M&>();
  Response storage = Storage::take();
  Response response = naming_cause(py::cast(slider), detail::shortest(options.velocity), [&] {
    const py::gil_scoped_release released;
    return integrate(slider, ground, options, std::move(storage));
  });
  return {std::move(response), py::cast(slider), motion};
}

ResponseWithInputs integrate_any(const AnySlider& slider, const py::object& motion, double displacement,
                                 double velocity, bool settle, const std::string& contact, double sliding_distance,
                                 const std::optional<SurfaceHeat>& heat) {
  const IntegrateOptions options{displacement,
                                 velocity,
                                 settle,
                                 contact_of(contact, "integrate"),
                                 check_for_interrupt,
                                 sliding_distance,
                                 heat.value_or(SurfaceHeat())};
  if (py::isinstance<GroundMotion>(motion)) return integrate_under<GroundMotion>(slider, motion, options);
  if (py::isinstance<HarmonicMotion>(motion)) return integrate_under<HarmonicMotion>(slider, motion, options);
  throw py::type_error("integrate: motion must be a GroundMotion or a HarmonicMotion, got " +
                       py::type::of(motion).attr("__name__").cast<std::string>());
}

template <class Slider, class Place>
std::string first_remark(const std::vector<Slider>& sliders, const std::vector<const GroundMotion*>& motions,
                         Place place) {
  const py::gil_scoped_release released;
  for (const GroundMotion* const motion : motions)
    for (const Slider& slider : sliders)
      if (std::string remark = units_remark(slider, *motion, place); !remark.empty()) return remark;
  return {};
}

}  // namespace

void bind_integrate(py::module_& m) {
  m.def(
      "_units_remark",
      [](const std::vector<AnySlider>& sliders, const std::vector<const GroundMotion*>& motions) {
        return first_remark(sliders, motions, 0.0);
      },
      py::arg("sliders"), py::arg("motions"),
      "The remark on the first of some combinations, none of which slips, that would slip if accelerations were in g.");
  m.def(
      "_units_remark",
      [](const std::vector<AnyPlanarSlider>& sliders, const std::vector<const GroundMotion*>& motions) {
        return first_remark(sliders, motions, Vector2{});
      },
      py::arg("sliders"), py::arg("motions"));
  m.def(
      "_linear_remark",
      [](const py::object& slider, double peak) -> std::string {
        if (py::isinstance<AnyPlanarSlider>(slider))
          return pendulum_remark(mounting_of(slider.cast<const AnyPlanarSlider&>()), peak);
        const auto found = slider_of(slider);
        return found ? linear_remark(*found, peak) : "";
      },
      py::arg("slider"), py::arg("peak"),
      "`Response.remark` on a pendulum that leaves its linear range; empty for anything else.");
  m.def("integrate", &integrate_any, py::arg("slider"), py::arg("motion"), py::kw_only(), py::arg("displacement") = 0.0,
        py::arg("velocity") = 0.0, py::arg("settle") = false, py::arg("contact") = "flight",
        py::arg("sliding_distance") = 0.0, py::arg("heat") = py::none(),
        R"(Integrate the response of a slider to a ground motion.

x'' + resist N+/g sgn(x') + c x' + wn^2 x = p(t), thesis (4.51) to (4.53), (2.44), (2.50), (4.2); (2.27), (2.28); on
level ground without vertical motion p = -n and N = g, otherwise see `Slider`. Finds all events: breakaways, reversals,
arrests, impacts on stops, liftoffs and landings.

Parameters
----------
slider : Slider or friction law
    A law alone is a slider without spring and damper.
motion : GroundMotion or HarmonicMotion
    The ground acceleration. A vertical component acts; a transverse one does not (see `Response.components`). A
    HarmonicMotion does not allow a slope, stops or a pendulum.
displacement : float, optional
    x at the start [m], finite.
velocity : float, optional
    x' at the start [m/s], finite.
settle : bool, optional
    Continue under zero ground acceleration after the last sample until the slider comes to rest, so that the residual
    is final. The samples of the response continue too, up to the first at or after rest (see `Response.truncated`).
contact : 'flight' or 'clipped', optional
    What happens when the ground accelerates downward faster than free fall, N < 0. 'flight': the slider leaves the
    ground without friction, and its gap follows y'' = -N; spring, damper and stops continue to act. It lands where
    y = 0, without rebound; the friction impulse -mu |y'| acts against x', and at most stops the slider. 'clipped': the
    slider stays on the ground, and friction is zero while N < 0.
sliding_distance : float, optional
    Sliding distance before the start [m], finite and at least 0, for laws that depend on it:
    `response.state.sliding_distance` of the response before.
heat : SurfaceHeat, optional
    Heat left in the sliding surface at the start, for laws that depend on its temperature: `response.state.heat` of the
    response before. Without it the surface is cold.

Returns
-------
Response

Raises
------
ValueError
    An initial state that is not finite, beyond a stop, or moving against an infinite slip level or `one_way`. A
    vertical motion under which the slider never lands. A slope, stops or a pendulum under a HarmonicMotion.
OverflowError
    A displacement, velocity or energy beyond the range of doubles.
ConvergenceError
    With `settle`, the slider does not come to rest (no friction; a caster that has escaped). More than 1,000,000 events
    and eight per sample, or per period of a harmonic motion (a spring that oscillates that often between samples).

Notes
-----
Constant friction is solved in closed form between events, exact to round-off, 1e-13 of the scale of x; this takes 13 to
25 ns per sample, 28 to 57 with a spring. With a damper the accuracy is 1e-12 and the time some 0.3 us. Casters are
integrated by Taylor series, nearly to round-off; 200 to 850 ns per sample. `Degrading` is solved in closed form under
horizontal motion, to 1e-12 of the scale; 0.13 us per sample. The response to a harmonic motion is not based on samples:
the event times are exact for the cosine, in closed form without spring and damper, otherwise by power series to
round-off. It takes 1.5 us per cycle with Coulomb friction, 6 us with a spring, 50 us for a caster, and 0.1 to 0.2 us
for each sample. Releases the interpreter lock.

With Coulomb friction and no spring, a long record with even steps is split into parts that are integrated from rest in
parallel, in vector lanes. Each part is then repeated from the end state of the one before, until both solutions are
stuck and therefore continue alike. Only the last bits can change, and what depends on them: whether a velocity that
just touches zero stops there.)");
}

}  // namespace stickslip::python
