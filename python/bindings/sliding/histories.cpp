#include "stickslip/sliding/histories.hpp"

#include <memory>
#include <utility>

#include "bindings.hpp"
#include "sliding/response.hpp"

namespace stickslip::python {
namespace {

py::tuple histories_any(const AnySlider& slider, const py::object& motion) {
  if (!py::isinstance<GroundMotion>(motion))
    throw py::type_error("histories: motion must be a GroundMotion, got " +
                         py::type::of(motion).attr("__name__").cast<std::string>());
  const auto& ground = motion.cast<const GroundMotion&>();
  Response spare = Storage::take();
  Histories storage{std::move(spare.displacement), std::move(spare.velocity)};
  auto* const kept = new Histories([&] {
    const py::gil_scoped_release released;
    return histories(slider, ground, check_for_interrupt, std::move(storage));
  }());
  const py::capsule owner(kept, [](void* p) {
    const std::unique_ptr<Histories> histories(static_cast<Histories*>(p));
    Response response;
    response.displacement = std::move(histories->displacement);
    response.velocity = std::move(histories->velocity);
    Storage::give_back(std::move(response));
  });
  return py::make_tuple(view(kept->displacement, owner), view(kept->velocity, owner));
}

}  // namespace

void bind_histories(py::module_& m) {
  m.def("histories", &histories_any, py::arg("slider"), py::arg("motion"),
        R"(Compute displacement and velocity at the samples only: faster than `integrate`.

x'' + resist sgn(x') + c x' + wn^2 x = -n(t), thesis (4.51) to (4.53), (2.44), (2.50), from rest at x = 0; without
events, peak and energy.

Parameters
----------
slider : Slider or friction law
    A law alone is a slider without spring and damper.
motion : GroundMotion
    The ground acceleration.

Returns
-------
displacement : ndarray, shape (samples,)
    x, relative to the ground [m]. Read-only.
velocity : ndarray, shape (samples,)
    x', relative to the ground [m/s].

Raises
------
ValueError
    A vertical motion under which the slider never lands.
OverflowError
    A displacement or velocity beyond the range of doubles.

Notes
-----
As accurate as `integrate`; the last bits may differ. Splits long records like `integrate`. Releases the interpreter
lock.)");
}

}  // namespace stickslip::python
