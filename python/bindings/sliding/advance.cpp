#include "stickslip/sliding/advance.hpp"

#include <cmath>
#include <limits>
#include <optional>

#include "parts.hpp"

namespace stickslip::python {
namespace {

State advanced(const py::object& what, State state, double dt, double start, std::optional<double> end,
               double vertical_start, std::optional<double> vertical_end, const std::string& contact) {
  const auto slider = slider_of(what);
  if (!slider)
    throw py::type_error("advance: slider must be a Slider or a friction law, got " +
                         py::type::of(what).attr("__name__").cast<std::string>());
  detail::require(std::isfinite(dt) && dt >= 0, "advance: dt must be finite and at least 0", dt, "s");
  const Segment horizontal{dt, start, end.value_or(start)};
  const double up = vertical_end.value_or(vertical_start);
  const Contact lost = contact_of(contact, "advance");
  if (vertical_start == 0 && up == 0)
    advance(*slider, horizontal, state, lost, check_for_interrupt);
  else
    advance(*slider, detail::load_segment(horizontal, mounting_of(*slider).slope(), vertical_start, up), state, lost,
            check_for_interrupt);
  return state;
}

}  // namespace

void bind_advance(py::module_& m) {
  m.def("advance", &advanced, py::arg("slider"), py::arg("state"), py::arg("dt"), py::arg("start"),
        py::arg("end") = py::none(), py::kw_only(), py::arg("vertical_start") = 0.0,
        py::arg("vertical_end") = py::none(), py::arg("contact") = "flight",
        R"(Advance a slider by one time step, for your own time loop.

x'' + resist N+/g sgn(x') + c x' + wn^2 x = p(t), see `Slider`, with all events within the step.

Parameters
----------
slider : Slider or friction law
state : State
    The state at the beginning of the step.
dt : float
    The time step [s], finite and at least 0.
start, end : float
    Horizontal ground acceleration n at the beginning and end of the step [m/s^2], linear in between; constant without
    `end`.
vertical_start, vertical_end : float, optional
    Upward ground acceleration [m/s^2], likewise.
contact : 'flight' or 'clipped', optional
    See `integrate`.

Returns
-------
State
    The state at the end of the step.

Raises
------
ValueError
    A number that is not finite; a state beyond a stop; a velocity that points where the slip level is infinite.
OverflowError
    The motion leaves the range of doubles.
ConvergenceError
    More than a million steps in closed form, or three million of a power series, within a hundredth of the step: the
    spring, damper, acceleration or slip level is too large for a step this long.

Notes
-----
As accurate as `integrate`; takes about 1 us per call.)");
}

}  // namespace stickslip::python
