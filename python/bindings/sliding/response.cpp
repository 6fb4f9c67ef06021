#include "sliding/response.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <string_view>
#include <system_error>

#include "any_response.hpp"
#include "in_python.hpp"
#include "parts.hpp"
#include "sliding/units_remark.hpp"
#include "statistics/estimate.hpp"
#include "structured.hpp"

namespace stickslip::python {
namespace {

py::object events_of(ResponseWithInputs& self) {
  return keep(self.events, [&] { return events_array(self.response.events); });
}

py::object time_of(ResponseWithInputs& self) {
  return keep(self.time, [&] {
    return with_inputs(self, [&](const auto&, const auto& motion) {
      return times_of(self.motion, motion, self.response.displacement.size());
    });
  });
}

const Forces& forces_of(ResponseWithInputs& self) {
  if (!self.forces)
    self.forces = with_inputs(
        self, [&](const auto& slider, const auto& motion) { return forces(slider, motion, self.response); });
  return *self.forces;
}

const LargestForce& largest_force_of(ResponseWithInputs& self) {
  if (!self.largest_force)
    self.largest_force = with_inputs(
        self, [&](const auto& slider, const auto& motion) { return peak_force(slider, motion, self.response); });
  return *self.largest_force;
}

// A read-only array of `value(forces, i)` at each sample.
template <class Value>
auto at_samples(Value&& value) {
  return [value](ResponseWithInputs& self) {
    const Forces& all = forces_of(self);
    std::vector<double> values(all.friction.size());
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = value(all, i);
    return array_of(std::move(values));
  };
}

template <auto member>
auto force() {
  return [](const py::object& self) { return view(forces_of(self.cast<ResponseWithInputs&>()).*member, self); };
}

py::object gap_of(const py::object& self) {
  const Response& response = self.cast<const ResponseWithInputs&>().response;
  if (!response.gap.empty()) return view(response.gap, self);
  return array_of(std::vector<double>(response.displacement.size()));
}

py::object temperature_of(const py::object& self) {
  const Response& response = self.cast<const ResponseWithInputs&>().response;
  return response.temperature.empty() ? py::object(py::none()) : py::object(view(response.temperature, self));
}

py::array impacts_of(const ResponseWithInputs& self) {
  return events_array(events_of_kind(self.response.events, EventKind::impact));
}

std::string remark_of(const ResponseWithInputs& self) {
  const auto& any = self.slider.cast<const AnySlider&>();
  if (self.response.time_sliding == 0 && py::isinstance<GroundMotion>(self.motion))
    return units_remark(any, self.motion.cast<const GroundMotion&>(), self.response.displacement.front());
  return linear_remark(any, self.response.peak);
}

ElementMotion elements_of(const ResponseWithInputs& self) {
  return with_inputs(self, [&](const auto& slider, const auto& motion) {
    const auto* bearing = std::get_if<Slider<MultiPendulum>>(&slider);
    if (bearing == nullptr)
      throw std::invalid_argument("elements and surfaces: only a MultiPendulum has them, not " +
                                  py::repr(self.slider).cast<std::string>());
    const py::gil_scoped_release released;
    return element_motion(bearing->law(), *trajectory(slider, motion, self.response));
  });
}

Loop loop_of(const ResponseWithInputs& self) {
  return with_inputs(
      self, [&](const auto& slider, const auto& motion) { return largest_loop(slider, motion, self.response); });
}

Margins margins_of(const ResponseWithInputs& self) {
  return with_inputs(self,
                     [&](const auto& slider, const auto& motion) { return margins(slider, motion, self.response); });
}

Sensitivity sensitivity_of(const ResponseWithInputs& self, const std::string& name) {
  const UnitParameter by = parameter_of(name, "sensitivity");
  return with_inputs(self, [&](const auto& slider, const auto& motion) -> Sensitivity {
    if constexpr (std::same_as<std::decay_t<decltype(motion)>, HarmonicMotion>) {
      throw std::invalid_argument(
          "sensitivity: covers a GroundMotion, got a HarmonicMotion; integrate motion.sampled(dt)");
    } else {
      const Sensitivity one = sensitivity(slider, motion, self.response, by.parameter, by.surface);
      return {by.factor * one.peak, by.factor * one.residual, by.factor * one.velocity};
    }
  });
}

py::object at_times(const ResponseWithInputs& self, const py::object& times) {
  return slider_at("Response", times, [&](const std::vector<double>& t) {
    return with_inputs(self, [&](const auto& slider, const auto& motion) {
      const py::gil_scoped_release released;
      return states_at(slider, motion, self.response, t);
    });
  });
}

// Points of a motion that straight lines between them draw: both ends of each arc, and more within long arcs.
class CurveReader final : public TrajectoryReader {
 public:
  // One point, with the layout of the NumPy type below.
  struct Point {
    double time, displacement, velocity, force, normal, gravity, hold, hold_backward;
  };

  // Within an arc, points are at most `step` apart, or 32 in number.
  CurveReader(const Trajectory& trajectory, double step) : trajectory_(trajectory), step_(step) {}

  void arc(const Arc& arc) override {
    const double slope = trajectory_.mounting().slope();
    const double parts = std::clamp(std::ceil(arc.duration / step_ * (1 - 1e-9)), 1.0, 32.0);
    for (double k = 0; k <= parts; ++k) {
      const double t = k < parts ? k / parts * arc.duration : arc.duration, weight = arc.weight(t);
      const State at = arc.at(t);
      const Load load = arc.load(t);
      const Point next{k < parts ? arc.begin + t : arc.end,
                       at.displacement,
                       at.velocity,
                       load.load - arc.acceleration(t),
                       weight * standard_gravity,
                       std::max(load.load * std::sin(slope) + load.normal * std::cos(slope), 0.0),
                       trajectory_.hold(at, weight, Direction::forward),
                       trajectory_.hold(at, weight, Direction::backward)};
      if (k > 0 || points.empty() || jumps(points.back(), next)) points.push_back(next);
    }
  }

  std::vector<Point> points;

 private:
  static bool jumps(const Point& one, const Point& other) {
    const auto differ = [](double a, double b) {
      return std::abs(a - b) > 1e-12 * (std::abs(a) + std::abs(b)) + 1e-15;
    };
    return differ(one.velocity, other.velocity) || differ(one.force, other.force) || differ(one.normal, other.normal);
  }

  const Trajectory& trajectory_;
  double step_;
};

py::array curve_of(const ResponseWithInputs& self) {
  using Point = CurveReader::Point;
  const std::vector<Point> points = with_inputs(self, [&](const auto& slider, const auto& motion) {
    const auto one = trajectory(slider, motion, self.response);
    CurveReader reader(*one, motion.last_step());
    one->read(reader, std::max(one->end(), one->time(self.response.displacement.size() - 1)));
    return std::move(reader.points);
  });
  return structured(
      points.size(), [&](std::size_t i) { return points[i]; }, std::pair("time", &Point::time),
      std::pair("displacement", &Point::displacement), std::pair("velocity", &Point::velocity),
      std::pair("force", &Point::force), std::pair("normal", &Point::normal), std::pair("gravity", &Point::gravity),
      std::pair("hold", &Point::hold), std::pair("hold_backward", &Point::hold_backward));
}

template <auto member>
auto history() {
  return [](const py::object& self) { return view(self.cast<const ResponseWithInputs&>().response.*member, self); };
}

template <auto member>
auto number() {
  return [](const ResponseWithInputs& self) { return self.response.*member; };
}

}  // namespace

UnitParameter parameter_of(const std::string& name, const std::string& who) {
  using enum stickslip::Parameter;
  constexpr std::pair<const char*, UnitParameter> parameters[] = {{"mu", {slip_level, standard_gravity}},
                                                                  {"slip_level", {slip_level, 1}},
                                                                  {"mu_kinetic", {kinetic, standard_gravity}},
                                                                  {"kinetic", {kinetic, 1}},
                                                                  {"mu_static", {static_level, standard_gravity}},
                                                                  {"static", {static_level, 1}},
                                                                  {"natural_frequency", {natural_frequency, 1}},
                                                                  {"damping", {damping, 1}},
                                                                  {"slope_degrees", {slope, 1}},
                                                                  {"scale", {scale, 1}},
                                                                  {"radii", {radius, 1}},
                                                                  {"capacities", {capacity, 1}}};
  std::string known;
  for (const auto& [its_name, parameter] : parameters) {
    if (name == its_name) return parameter;
    known += (known.empty() ? "'" : ", '") + std::string(its_name) + "'";
  }
  constexpr std::pair<std::string_view, stickslip::Parameter> of_surfaces[] = {
      {"radii[", radius}, {"mu[", stickslip::Parameter::mu}, {"capacities[", capacity}};
  for (const auto& [begin, parameter] : of_surfaces) {
    if (name.starts_with(begin) && name.ends_with(']')) {
      std::size_t index = 0;
      const char* const last = name.data() + name.size() - 1;
      const auto [end, error] = std::from_chars(name.data() + begin.size(), last, index);
      if (error == std::errc() && end == last) return {parameter, 1, index};
    }
    known += ", '" + std::string(begin) + "i]'";
  }
  known += " with i from 0, a surface of a MultiPendulum";
  throw std::invalid_argument(who + ": parameter must be one of " + known + ", got '" + name + "'");
}

template <>
inline constexpr auto parts<ResponseWithInputs> = std::tuple(&ResponseWithInputs::response, &ResponseWithInputs::slider,
                                                             &ResponseWithInputs::motion);

void bind_response(py::module_& m) {
  value_class<Sensitivity>(m, "Sensitivity",
                           R"(Derivatives of a response with respect to a parameter, returned by `Response.sensitivity`.

In meters, or m/s, per unit of the parameter.)")
      .def_readonly("peak", &Sensitivity::peak, "Derivative of the peak displacement; 0 if the peak is at a stop.")
      .def_readonly("residual", &Sensitivity::residual, "Derivative of the displacement at the end.")
      .def_readonly("velocity", &Sensitivity::velocity, "Derivative of the velocity at the end; 0 if the slider rests.")
      .def("__repr__", [](const Sensitivity& s) {
        return "<Sensitivity: peak " + digits(s.peak) + ", residual " + digits(s.residual) + ", velocity " +
               digits(s.velocity) + ">";
      });

  value_class<Energy>(m, "Energy", R"(Energy balance of a response, per unit mass [J/kg = m^2/s^2].

initial + input = dissipated + damped + impact + kinetic + elastic, to round-off, for the motion along x.)")
      .def_readonly("initial", &Energy::initial, "Kinetic and elastic energy at the start.")
      .def_readonly("input", &Energy::input, R"(Work of the load, the integral of p x' dt; on level ground p = -n.

For a pendulum, includes the work of the variation of the normal force on the spring, the integral of
wn^2 (1 - N+/g) x x' dt.)")
      .def_readonly("dissipated", &Energy::dissipated,
                    "Work of friction, the integral of resist N+/g |x'| dt, including its impulses on landing.")
      .def_readonly("damped", &Energy::damped, "Work of the damper, the integral of c x'^2 dt.")
      .def_readonly("kinetic", &Energy::kinetic, "x'^2 / 2 at the end.")
      .def_readonly("elastic", &Energy::elastic,
                    "wn^2 x^2 / 2 at the end, and the energy in the springs of a `MultiPendulum`.")
      .def_readonly("impact", &Energy::impact, "Energy lost on stops, the sum of (1 - restitution^2) x'^2 / 2.")
      .def_property_readonly("imbalance", &Energy::imbalance, "Residual of the energy balance (round-off).")
      .def("__repr__",
           [](const Energy& e) {
             return "<Energy [m^2/s^2]: initial " + digits(e.initial) + ", input " + digits(e.input) + ", dissipated " +
                    digits(e.dissipated) + ", damped " + digits(e.damped) + ", kinetic " + digits(e.kinetic) +
                    ", elastic " + digits(e.elastic) + ", impact " + digits(e.impact) + ">";
           })
      .def("_repr_html_", in_python("stickslip._html", "energy_html"));

  value_class<ResponseWithInputs>(m, "Response",
                                  R"(The response of a slider to a ground motion, as `integrate` returns it.

Displacement and velocity are relative to the ground. The arrays are read-only; displacement and velocity are not
copied.)")
      .def_property_readonly(
          "slider", [](const ResponseWithInputs& r) { return r.slider; }, "The slider.")
      .def_property_readonly("displacement", history<&Response::displacement>(), "x at `time` [m], shape (N,).")
      .def_property_readonly("velocity", history<&Response::velocity>(), "x' at `time` [m/s], shape (N,).")
      .def_property_readonly("acceleration",
                             at_samples([](const Forces& f, std::size_t i) { return f.acceleration(i); }),
                             R"(Absolute acceleration of the mass at `time` [m/s^2], shape (N,).

On level ground x'' + n = -force, on a slope g sin(slope) - force; that of the ground while the slider sticks. At a
sample where a slip begins, reverses or stops, or where a constant ground acceleration jumps, this and the forces are
the values just after it. At the end of the ground motion they belong to its last acting value, and later to a ground at
rest.)")
      .def_property_readonly("friction", force<&Forces::friction>(),
                             R"(Friction force per unit mass at `time` [m/s^2], shape (N,).

resist N+/g sgn(x') during a slip. While the slider sticks, it balances the other forces: p - spring, also at a stop.
Like the other forces it is positive toward negative x: x'' + friction + damper + spring = p, on level ground p = -n.)")
      .def_property_readonly("normal_force", force<&Forces::normal>(),
                             R"(Normal force per unit mass at `time`, N+ [m/s^2], shape (N,).

max(N, 0), N = (g + a_z) cos(slope) + n sin(slope); 0 in flight.)")
      .def_property_readonly("gap", &gap_of, R"(Gap between slider and ground at `time` [m], shape (N,).

0 except in flight, with contact='flight'.)")
      .def_property_readonly("temperature", &temperature_of,
                             R"(Temperature of the sliding surface at `time` [degrees Celsius], shape (N,).

None unless the friction law depends on it.)")
      .def_property_readonly("spring", force<&Forces::spring>(),
                             "Force of the spring per unit mass at `time`, wn^2 x, for a pendulum times N+/g [m/s^2], "
                             "shape (N,).")
      .def_property_readonly("damper", force<&Forces::damper>(),
                             "Force of the damper per unit mass at `time`, c x' [m/s^2], shape (N,).")
      .def_property_readonly("force", at_samples([](const Forces& f, std::size_t i) { return f.total(i); }),
                             R"(friction + damper + spring at `time` [m/s^2], shape (N,).

The force per unit mass between the mass and the ground, such as that of an isolator; positive for positive
displacement.)")
      .def_property_readonly(
          "peak_force", [](ResponseWithInputs& r) { return largest_force_of(r).force; }, peak_force_doc)
      .def_property_readonly(
          "peak_force_time", [](ResponseWithInputs& r) { return largest_force_of(r).time; }, peak_force_time_doc)
      .def_property_readonly(
          "stuck", [](ResponseWithInputs& r) { return array_of(forces_of(r).stuck).attr("view")("?"); },
          "Whether the slider sticks at `time` (bool), shape (N,); just after the sample if that changes there.")
      .def_property_readonly("components", number<&Response::components>(),
                             R"(Components of the ground motion that acted, joined by " + " (str).

'axis': along the axis of the slider; 'axis + vertical'. A transverse component never acts.)")
      .def_property_readonly(
          "contact", [](const ResponseWithInputs& r) { return name_of(r.response.contact); },
          "What happens at a loss of contact, 'flight' or 'clipped'; see `integrate`.")
      .def_property_readonly("remark", &remark_of,
                             R"(A sentence about limits of the result; empty if there are none (str).

A pendulum beyond 0.2 of its radius; a slider that never slips, but would if the ground accelerations were in g.)")
      .def_property_readonly(
          "margin", [](const ResponseWithInputs& r) { return margins_of(r).load; },
          R"(Smallest |load - level| / level at which stick or slip was decided; infinite if there was no decision.

The load is q = p - wn^2 x, the level is that of the law times N+/g. The decisions are

- the end of each slip: whether q is within the levels at rest in either direction, and how far it is from the level
  while sliding, that is, whether the velocity reaches zero at all;
- each maximum of q over the level during a rest: the slider stays;
- the next such maximum after a breakaway, with x as at rest: the slider leaves.

If the margin is near round-off, say 1e-12, the last digits of the input decided. With static friction above kinetic
friction, the smallest change of the input may then give a different response; with equal levels the response is
continuous. A velocity that almost reaches zero without an event is not a decision, nor is a landing. One pass over
events and samples.)")
      .def_property_readonly(
          "impact_margin", [](const ResponseWithInputs& r) { return margins_of(r).impact; },
          R"(Smallest distance by which a stop was missed or exceeded, over the distance of the stop from x = 0.

At the end of a slip, the remaining distance to the stop; at an impact at speed v under a load that slows the slider
down, the distance v^2 / (2 (a - q)) over which it would have continued, where a is the friction. Infinite without stops
and slips. After an impact at a speed near zero, the accuracy is only the square root of round-off.)")
      .def("sensitivity", &sensitivity_of, py::arg("parameter"),
           R"(Differentiate peak, residual and final velocity with respect to a parameter.

Solves the variational equation of each slip, with the jumps of its solution at events; not differences. With s the
direction, f the acceleration, q' the rate of the load, a_s and a_k the levels of rest and sliding:

    slip       d(v') = dp - s d(a_k N+/g) - d(c) v - d(wn^2) x - c dv - wn^2 dx,  a pendulum: wn^2 N+/g for wn^2
    arrest     dv = 0
    reversal   dv is multiplied by f+ / f-
    breakaway  dv = -(a_s - a_k) (d(a_s) + s wn^2 dx) / (q' - s a_s')
    impact     dx = dX - e (dx - dX),  dv = -e dv + (e f- + f+) (dx - dX) / v,  at a stop that moves by dX
    jump       dv = dv + (f- - f+) (dX - dx) / v, where the force of a `MultiPendulum` jumps at X
    peak       d|x| = sgn(x) dx at its time

The level of a `MultiPendulum` is a line in x from one change of its moving elements to the next; its derivative contains
those of the elements and of where they last turned.

Parameters
----------
parameter : str
    'mu' or 'slip_level' [m/s^2]: all levels alike; 'mu_kinetic' or 'kinetic', 'mu_static' or 'static', of
    `StaticKinetic`; 'natural_frequency' [rad/s]; 'damping' [1/s]; 'slope_degrees'; 'scale', a factor on all components
    of the ground motion. Of a `MultiPendulum` also 'radii[i]', 'mu[i]' and 'capacities[i]', i an index of its lists:
    from bottom to top in a series; inner, lower, upper, ... of nested surfaces. 'radii' and 'capacities': all alike.

Returns
-------
Sensitivity

Raises
------
ValueError
    Another law than `Coulomb`, `StaticKinetic` of it and `MultiPendulum`; a `HarmonicMotion`; a slider that leaves the
    ground; a parameter that the slider does not have, such as a surface beyond the last, or a radius or capacity that is
    infinite; a response that is not differentiable, where a velocity comes to zero without acceleration.

Notes
-----
Accurate nearly to round-off. With static friction above kinetic friction, the response jumps where a decision changes;
the derivative is that between the jumps, and `margin` states how near one is. Takes 3 to 17 times as long as
`integrate`.)")
      .def("_curve", &curve_of,
           R"(Points that draw the motion with straight lines between them, for `stickslip.plotting`.

A structured array with the fields time [s], displacement [m], velocity [m/s], force (of friction, spring and damper),
normal (force), gravity (g and the upward acceleration of the ground, at least 0), and hold and hold_backward, the
largest friction at rest against sliding forward and backward under a normal force of g; forces are per unit mass
[m/s^2]. Where one of them jumps there are two points.)")
      .def_property_readonly("impacts", &impacts_of,
                             R"(Impacts on stops, sorted by time: a structured array like `events`.

The velocity is that before the impact [m/s].)")
      .def_property_readonly("events", &events_of,
                             R"(Events sorted by time: a structured array.

Fields: time [s], displacement [m], velocity [m/s], kind ('breakaway', 'reversal', 'arrest', 'impact', 'liftoff',
'landing' or 'end'). If the slider already slides at the start, the first event is a breakaway there. The velocity of
an impact is that before it; a rebound from a stop is not a reversal.)")
      .def_property_readonly("peak", number<&Response::peak>(), "Largest |x| over all time, not only at samples [m].")
      .def_property_readonly("residual", number<&Response::residual>(), "x at the end [m]; final if the slider rests.")
      .def_property_readonly(
          "at_rest", [](const ResponseWithInputs& r) { return r.response.state.mode == Mode::stuck; },
          "Whether the slider is at rest at the end.")
      .def_property_readonly(
          "state", [](const ResponseWithInputs& r) { return r.response.state; },
          "The `State` at the end; another run can continue from it.")
      .def_property_readonly("sliding_distance", number<&Response::sliding_distance>(),
                             "Total sliding distance (path length) [m].")
      .def_property_readonly(
          "slips", [](const ResponseWithInputs& r) { return slips(r.response.events); },
          "Number of slips; a reversal ends one and begins another.")
      .def_property_readonly("time_sliding", number<&Response::time_sliding>(), "Time spent sliding [s].")
      .def_property_readonly("energy", number<&Response::energy>(), "Energy balance, per unit mass [m^2/s^2].")
      .def_property_readonly(
          "effective_period", [](const ResponseWithInputs& r) { return loop_of(r).period(); },
          R"(2 pi / sqrt(k_eff) of the hysteresis loop with the largest displacement [s].

k_eff = F / D, where D is `peak` and F the force of spring and friction there, just before the slider reverses or stops.
With Coulomb friction k_eff = wn^2 + slip_level / D. Under vertical motion F has the normal force at that instant. On a
slope D and F count from the position where the spring balances the weight. A stop does not count: at one, F is the
force of spring and friction on arrival. ValueError without a spring, because there is no restoring force; if the slider
never slips; if |x| is largest at the start, at the end of an unfinished slip, or in flight without a force.)")
      .def_property_readonly("elements", &elements_of, R"(The motion of the elements of a `MultiPendulum`.

Returns an `ElementMotion`. The motion is integrated again, so keep it. ValueError for other sliders.)")
      .def_property_readonly(
          "surfaces", [](const ResponseWithInputs& r) { return SurfaceMotion{elements_of(r)}; },
          R"(The motion of the surfaces of a `MultiPendulum`, from bottom to top.

Returns a `SurfaceMotion`. The motion is integrated again, so keep it. ValueError for other sliders.)")
      .def_property_readonly(
          "effective_damping", [](const ResponseWithInputs& r) { return loop_of(r).damping(); },
          R"(E_d / (2 pi k_eff D^2) of the same loop, a fraction of critical damping.

The loops of an earthquake response do not close. E_d is therefore defined for a cycle from D to -D and back: 4 D times
the energy per meter that friction and damper dissipated in the swing up to the peak. In a steady cycle about x = 0 this
is the area of the loop; with Coulomb friction E_d = 4 slip_level D. What stops take is not in it. ValueError as for
`effective_period`.)")
      .def(
          "plot",
          [](const py::object& self, const py::object& figure, const py::object& title, const py::object& time) {
            return py::module_::import("stickslip.plotting")
                .attr("plot_response")(self, figure, title, py::arg("time") = time);
          },
          py::kw_only(), py::arg("figure") = py::none(), py::arg("title") = py::none(), py::arg("time") = py::none(),
          R"(Plot ground acceleration with the slip level, velocity with shaded sticks, and displacement.

Needs matplotlib (`pip install stickslip[plot]`). Takes `figure`, a matplotlib Figure or SubFigure to draw in, `title`,
and `time`, the begin and end of the part to draw [s], such as (0, 25). Returns the figure, see
`stickslip.plotting.plot_response`.)")
      .def("animate", animation(), py::kw_only(), py::arg("time") = py::none(), py::arg("speed") = 1.0,
           py::arg("fps") = 15.0, py::arg("title") = py::none(), py::arg("size") = py::none(), animation_doc)
      .def("plot_hysteresis", hysteresis(), py::kw_only(), py::arg("figure") = py::none(),
           py::arg("title") = py::none(), py::arg("ax") = py::none(), py::arg("time") = py::none(), hysteresis_doc)
      .def("__repr__", [](const ResponseWithInputs& r) {
        const std::string remark = remark_of(r);
        return "<Response: peak " + digits(r.response.peak) + " m, residual " + digits(r.response.residual) + " m, " +
               std::to_string(r.response.events.size()) + " events" +
               (r.response.truncated ? ", samples end before rest" : "") + (remark.empty() ? "" : "; " + remark) + ">";
      });
  define_response<ResponseWithInputs>(
      m, "Response", &time_of, &at_times,
      {.system = "slider",
       .object = "slider",
       .states = R"(State or ndarray
    At one time a `State`. At several a structured array of shape (T,) with the fields time [s], displacement [m],
    velocity [m/s], gap [m] (between slider and ground, in flight) and stuck. At an impact or a landing, the state after
    it.)",
       .at_notes = R"( It takes about as long as `integrate`, and
0.1 us for each time. For laws that depend on the temperature of the surface, heat from before the start counts as if it
were old.

Examples
--------
>>> response = integrate(Coulomb(mu=0.1), GroundMotion([0.0, -2.0, 0.0], dt=1.0))
>>> response.at(0.25).stuck
True
>>> response.at([0.75, 1.0])["velocity"]
array([0.0625, 0.25  ]))",
       .columns = R"(The columns are `ground_acceleration` [m/s^2], `displacement` [m], `velocity` [m/s];
    `acceleration`, `friction`, `spring`, `damper` and `force` [m/s^2]; and `stuck` (bool). Under vertical motion also
    `vertical_ground_acceleration` [m/s^2], `gap` [m] and `normal_force` [m/s^2]; on a slope also `normal_force`; and
    `temperature` [degC] if the law depends on it.)",
       .attributes = "`peak` and `residual`",
       .results = "`contact`, `peak` [m], `residual` [m], `sliding_distance` [m] and `at_rest`"});
}

}  // namespace stickslip::python
