#include "planar/response.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "any_response.hpp"
#include "in_python.hpp"
#include "parts.hpp"
#include "sliding/response.hpp"
#include "sliding/units_remark.hpp"
#include "statistics/estimate.hpp"

namespace stickslip::python {
namespace {

using Self = PlanarResponseWithInputs;

const AnyPlanarSlider& slider_of_response(const Self& self) { return self.slider.cast<const AnyPlanarSlider&>(); }
const GroundMotion& motion_of(const Self& self) { return self.motion.cast<const GroundMotion&>(); }

const PlanarForces& forces_of(Self& self) {
  if (!self.forces) {
    const AnyPlanarSlider& slider = slider_of_response(self);
    const GroundMotion& motion = motion_of(self);
    PlanarForces found = [&] {
      const py::gil_scoped_release released;
      return forces(slider, motion, self.response);
    }();
    self.forces = std::move(found);
  }
  return *self.forces;
}

// A read-only array of shape (N, 2) of `value(forces, i)` at each sample.
template <class Value>
auto at_samples(Value&& value) {
  return [value](Self& self) {
    const PlanarForces& all = forces_of(self);
    py::array_t<double> values({static_cast<py::ssize_t>(all.friction.size()), py::ssize_t{2}});
    for (std::size_t i = 0; i < all.friction.size(); ++i) {
      const Vector2 v = value(all, i);
      values.mutable_at(i, 0) = v.axis;
      values.mutable_at(i, 1) = v.transverse;
    }
    values.attr("setflags")(py::arg("write") = false);
    return values;
  };
}

template <auto member>
auto force() {
  return [](const py::object& self) { return view(forces_of(self.cast<Self&>()).*member, self); };
}
template <auto member>
auto history() {
  return [](const py::object& self) { return view(self.cast<const Self&>().response.*member, self); };
}
template <auto member>
auto number() {
  return [](const Self& self) { return self.response.*member; };
}
template <auto member>
auto vector() {
  return [](const Self& self) { return array_of(self.response.*member); };
}

py::object temperature_of(const py::object& self) {
  const PlanarResponse& response = self.cast<const Self&>().response;
  return response.temperature.empty() ? py::object(py::none()) : py::object(view(response.temperature, self));
}

Margins margins_of(const Self& self) {
  const AnyPlanarSlider& slider = slider_of_response(self);
  const GroundMotion& motion = motion_of(self);
  const py::gil_scoped_release released;
  return margins(slider, motion, self.response);
}

py::object gap_of(const py::object& self) {
  const PlanarResponse& response = self.cast<const Self&>().response;
  if (!response.gap.empty()) return view(response.gap, self);
  return array_of(std::vector<double>(response.displacement.size()));
}

std::optional<double> peak_azimuth_of(const Self& self) {
  const std::optional<double> axis = azimuth_of(motion_of(self).orientation());
  const Vector2 peak = self.response.peak_displacement;
  if (!axis || !(self.response.peak > 0)) return std::nullopt;
  const double azimuth = std::fmod(*axis + std::atan2(peak.transverse, peak.axis) * (180 / std::numbers::pi), 360);
  return azimuth < 0 ? azimuth + 360 : azimuth;
}

std::string remark_of(const Self& self) {
  const AnyPlanarSlider& slider = slider_of_response(self);
  if (!(self.response.time_sliding > 0))
    return units_remark(slider, motion_of(self), self.response.displacement.front());
  return pendulum_remark(mounting_of(slider), self.response.peak);
}

py::object at_times(const Self& self, const py::object& times) {
  const auto find = [&](const std::vector<double>& t) {
    const AnyPlanarSlider& slider = slider_of_response(self);
    const GroundMotion& motion = motion_of(self);
    const py::gil_scoped_release released;
    return states_at(slider, motion, self.response, t);
  };
  return slider_at("PlanarResponse", times, find);
}

}  // namespace

template <>
inline constexpr auto parts<PlanarResponseWithInputs> = std::tuple(&PlanarResponseWithInputs::response,
                                                                   &PlanarResponseWithInputs::slider,
                                                                   &PlanarResponseWithInputs::motion);

void bind_planar_response(py::module_& m) {
  value_class<Self>(
      m, "PlanarResponse",
      R"(The response of a slider in the plane to a ground motion, as `integrate` returns it for a `PlanarSlider`.

Displacement and velocity are relative to the ground. The last dimension of vectors is the component: first along the
axis of the ground motion, then along its transverse direction, 90 degrees clockwise from the axis. The arrays are
read-only.)")
      .def_property_readonly(
          "slider", [](const Self& r) { return r.slider; }, "The `PlanarSlider`.")
      .def_property_readonly("displacement", history<&PlanarResponse::displacement>(), "r at `time` [m], shape (N, 2).")
      .def_property_readonly("velocity", history<&PlanarResponse::velocity>(), "r' at `time` [m/s], shape (N, 2).")
      .def_property_readonly("acceleration",
                             at_samples([](const PlanarForces& f, std::size_t i) { return f.acceleration(i); }),
                             R"(Absolute acceleration of the mass at `time` [m/s^2], shape (N, 2).

On level ground -force, on a slope (g sin(slope), 0) - force. At a sample where a slip begins or stops, or where a
constant ground acceleration jumps, this and the forces are the values just after it.)")
      .def_property_readonly("friction", force<&PlanarForces::friction>(),
                             R"(Friction force per unit mass at `time` [m/s^2], shape (N, 2).

resist N+/g r'/|r'| during a slip. While the slider sticks, it balances the other forces: p - spring. The force with
which a stop holds the slider counts as friction, at rest and while the slider slides along the stop. Like the other
forces it is positive toward negative components: r'' + friction + damper + spring = p.)")
      .def_property_readonly("normal_force", force<&PlanarForces::normal>(),
                             R"(Normal force per unit mass at `time`, N+ [m/s^2], shape (N,).

max(N, 0), N = (g + a_z) cos(slope) + n sin(slope); 0 in flight.)")
      .def_property_readonly("spring", force<&PlanarForces::spring>(),
                             "Force of the spring per unit mass at `time`, wn^2 r, for a pendulum times N+/g [m/s^2], "
                             "shape (N, 2).")
      .def_property_readonly("damper", force<&PlanarForces::damper>(),
                             "Force of the damper per unit mass at `time`, c r' [m/s^2], shape (N, 2).")
      .def_property_readonly("force", at_samples([](const PlanarForces& f, std::size_t i) { return f.total(i); }),
                             R"(friction + damper + spring at `time` [m/s^2], shape (N, 2).

The force per unit mass between the mass and the ground, such as that of an isolator.)")
      .def_property_readonly(
          "peak_force", [](Self& r) { return forces_of(r).peak; }, peak_force_doc)
      .def_property_readonly(
          "peak_force_time", [](Self& r) { return forces_of(r).peak_time; }, peak_force_time_doc)
      .def_property_readonly(
          "stuck", [](Self& r) { return array_of(forces_of(r).stuck).attr("view")("?"); },
          "Whether the slider sticks at `time` (bool), shape (N,); just after the sample if that "
          "changes there.")
      .def_property_readonly("temperature", &temperature_of,
                             R"(Temperature of the sliding surface at `time` [degrees Celsius], shape (N,).

None unless the friction law depends on it.)")
      .def_property_readonly("gap", &gap_of, R"(Gap between slider and ground at `time` [m], shape (N,).

0 except in flight, with contact='flight'.)")
      .def_property_readonly("components", number<&PlanarResponse::components>(),
                             R"(Components of the ground motion that acted, joined by " + " (str).

'axis + transverse', or 'axis + transverse + vertical'.)")
      .def_property_readonly(
          "contact", [](const Self& r) { return name_of(r.response.contact); },
          "What happens at a loss of contact, 'flight' or 'clipped'; see `integrate`.")
      .def_property_readonly("remark", &remark_of,
                             R"(A sentence about limits of the result; empty if there are none (str).

A pendulum that moves beyond 0.2 of its radius; a slider that never slips, but would if the ground accelerations were in
g.)")
      .def_property_readonly(
          "events", [](Self& r) { return keep(r.events, [&] { return events_array(r.response.events); }); },
          R"(Events sorted by time: a structured array.

Fields: time [s], displacement [m] and velocity [m/s], both of shape (2,), kind ('breakaway', 'reversal', 'arrest',
'impact', 'liftoff', 'landing' or 'end'). If the slider already slides at the start, the first event is a breakaway
there. The velocity of an impact is that before it. A reversal is a stop of no duration; motions in the plane rarely
have one, because the velocity turns without vanishing.)")
      .def_property_readonly(
          "impacts", [](const Self& r) { return events_array(events_of_kind(r.response.events, EventKind::impact)); },
          R"(Impacts on the stop, sorted by time: a structured array like `events`.

The velocity is that before the impact [m/s].)")
      .def_property_readonly("peak", number<&PlanarResponse::peak>(),
                             "Largest |r| over all time, not only at samples [m].")
      .def_property_readonly("peak_time", number<&PlanarResponse::peak_time>(), "Time of `peak` [s].")
      .def_property_readonly("peak_displacement", vector<&PlanarResponse::peak_displacement>(),
                             "r at the time of `peak` [m], shape (2,).")
      .def_property_readonly("peak_azimuth", &peak_azimuth_of,
                             R"(Direction of `peak_displacement` [degrees clockwise from north], from 0 to below 360.

None if the orientation of the ground motion is not an azimuth, or if the slider does not move.)")
      .def_property_readonly("residual", vector<&PlanarResponse::residual>(),
                             "r at the end [m], shape (2,); final if the slider rests.")
      .def_property_readonly(
          "at_rest", [](const Self& r) { return r.response.state.mode == PlanarMode::stuck; },
          "Whether the slider is at rest at the end.")
      .def_property_readonly("state", number<&PlanarResponse::state>(),
                             "The `PlanarState` at the end; `advance` can continue from it.")
      .def_property_readonly("sliding_distance", number<&PlanarResponse::sliding_distance>(),
                             "Total sliding distance (path length) [m].")
      .def_property_readonly(
          "slips", [](const Self& r) { return slips(r.response.events); }, "Number of slips.")
      .def_property_readonly("time_sliding", number<&PlanarResponse::time_sliding>(), "Time spent sliding [s].")
      .def_property_readonly("energy", number<&PlanarResponse::energy>(),
                             R"(Energy balance along the path, per unit mass [m^2/s^2].

As that of `Response`, with the integrals of p.r', resist N+/g |r'| and c |r'|^2.)")
      .def_property_readonly(
          "margin", [](const Self& r) { return margins_of(r).load; },
          R"(Smallest ||q| - level| / level at which stick or slip was decided; infinite if there was no decision.

The load is the vector q = p - wn^2 r, the level is that of the law times N+/g. The decisions are those of
`Response.margin`, for the magnitude of q: the end of each slip, each maximum of |q| over the level during a rest, and
the next such maximum after a breakaway, with r as at rest. While the slider rests against a stop, q is the load along
the stop. A velocity that turns without vanishing is not a decision, however small it becomes, nor is a landing. The
motion is integrated again.)")
      .def_property_readonly(
          "impact_margin", [](const Self& r) { return margins_of(r).impact; },
          R"(Smallest distance by which a stop was missed or exceeded, over its gap.

At a maximum of |r|, the remaining distance to the stop; at an impact with the radial velocity v and the radial
deceleration d, the distance v^2 / (2 d) over which the slider would have continued. Infinite without stops and
slips.)")
      .def("animate", animation(), py::kw_only(), py::arg("time") = py::none(), py::arg("speed") = 1.0,
           py::arg("fps") = 15.0, py::arg("title") = py::none(), py::arg("size") = py::none(), animation_doc)
      .def(
          "plot",
          [](const py::object& self, const py::object& figure, const py::object& title, const py::object& time) {
            return py::module_::import("stickslip.plotting")
                .attr("plot_planar_response")(self, figure, title, py::arg("time") = time);
          },
          py::kw_only(), py::arg("figure") = py::none(), py::arg("title") = py::none(), py::arg("time") = py::none(),
          R"(Plot the path as on a map, and both components of the displacement over time.

The axis of the ground motion points upward, and the transverse direction to the right. Needs matplotlib
(`pip install stickslip[plot]`). Takes `figure`, a matplotlib Figure or SubFigure to draw in, `title`, and `time`, the
begin and end of the part of the lower panels to draw [s]. Returns the figure, see `stickslip.plotting.plot_planar_response`.)")
      .def("__repr__", [](const Self& r) {
        const std::string remark = remark_of(r);
        return "<PlanarResponse: peak " + digits(r.response.peak) + " m, residual " + digits(r.response.residual) +
               " m, " + std::to_string(r.response.events.size()) + " events" +
               (r.response.truncated ? ", samples end before rest" : "") + (remark.empty() ? "" : "; " + remark) + ">";
      });
  define_response<Self>(
      m, "PlanarResponse", times_over<Self>(&PlanarResponse::displacement), &at_times,
      {.system = "slider",
       .object = "slider",
       .states = R"(PlanarState or ndarray
    At one time a `PlanarState`. At several a structured array of shape (T,) with the fields time [s], displacement [m]
    and velocity [m/s], both of shape (T, 2), gap [m] (between slider and ground, in flight) and stuck. At an impact or
    a landing, the state after it.)",
       .columns = R"(The columns are those of `Response.to_dataframe`, two for each vector, such as
    `displacement_axis` and `displacement_transverse` [m].)",
       .attributes = "`peak` and `residual`",
       .results = R"(`contact`, `peak` [m], `peak_time` [s], `peak_displacement` [m], `peak_azimuth` [degrees],
    `residual` [m], `sliding_distance` [m] and `at_rest`, vectors as lists of two numbers)"});
}

}  // namespace stickslip::python
