#include "sliding/response.hpp"

#include <algorithm>
#include <iterator>

#include "parts.hpp"

namespace stickslip::python {
namespace {

// One row of `Response.events`: laid out as the NumPy type below says.
struct EventRow {
  double time, displacement, velocity;
  char32_t kind[10];
};

constexpr const char32_t* name_of(EventKind kind) {
  switch (kind) {
    case EventKind::breakaway:
      return U"breakaway";
    case EventKind::reversal:
      return U"reversal";
    case EventKind::arrest:
      return U"arrest";
    case EventKind::end:
      return U"end";
    case EventKind::impact:
      return U"impact";
    case EventKind::liftoff:
      return U"liftoff";
    case EventKind::landing:
      return U"landing";
  }
  return U"";
}

}  // namespace

py::array events_array(const std::vector<Event>& events) {
  py::dict layout;
  layout["names"] = py::make_tuple("time", "displacement", "velocity", "kind");
  layout["formats"] = py::make_tuple("f8", "f8", "f8", "U10");
  layout["offsets"] = py::make_tuple(offsetof(EventRow, time), offsetof(EventRow, displacement),
                                     offsetof(EventRow, velocity), offsetof(EventRow, kind));
  layout["itemsize"] = sizeof(EventRow);
  py::array rows(py::dtype::from_args(layout), static_cast<py::ssize_t>(events.size()));
  auto* row = static_cast<EventRow*>(rows.mutable_data());
  for (const Event& e : events) {
    *row = {e.time, e.displacement, e.velocity, {}};
    const std::u32string_view kind = name_of(e.kind);
    std::copy(kind.begin(), kind.end(), row->kind);
    ++row;
  }
  return rows;
}

namespace {

// The array in `kept`, made by `make` when first asked for.
template <class Make>
py::object keep(py::object& kept, Make&& make) {
  if (!kept) {
    kept = make();
    kept.attr("setflags")(py::arg("write") = false);
  }
  return kept;
}

py::object events_of(Recording& recording) {
  return keep(recording.events, [&] { return events_array(recording.response.events); });
}

py::object time_of(Recording& recording) {
  return keep(recording.time, [&]() -> py::object {
    const std::size_t samples = recording.response.displacement.size();
    if (py::len(recording.motion.attr("time")) == samples) return recording.motion.attr("time");
    const auto times = [&](const auto& motion) {
      std::vector<double> time(samples);
      for (std::size_t i = 0; i < samples; ++i) time[i] = motion.time(i);
      return to_array(time);
    };
    if (py::isinstance<GroundMotion>(recording.motion)) return times(recording.motion.cast<const GroundMotion&>());
    return times(recording.motion.cast<const HarmonicMotion&>());
  });
}

const Forces& forces_of(Recording& recording) {
  if (!recording.forces)
    recording.forces = with_inputs(
        recording, [&](const auto& slider, const auto& motion) { return forces(slider, motion, recording.response); });
  return *recording.forces;
}

// A read-only array of what `value(forces, i)` gives at each sample.
template <class Value>
auto at_samples(Value&& value) {
  return [value](Recording& recording) {
    const Forces& all = forces_of(recording);
    std::vector<double> values(all.friction.size());
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = value(all, i);
    return array_of(std::move(values));
  };
}

template <auto member>
auto force() {
  return [](const py::object& self) { return view(forces_of(self.cast<Recording&>()).*member, self); };
}

py::object gap_of(const py::object& self) {
  const Response& response = self.cast<const Recording&>().response;
  if (!response.gap.empty()) return view(response.gap, self);
  return array_of(std::vector<double>(response.displacement.size()));
}

py::array impacts_of(const Recording& recording) {
  std::vector<Event> impacts;
  std::ranges::copy_if(recording.response.events, std::back_inserter(impacts),
                       [](const Event& e) { return e.kind == EventKind::impact; });
  return events_array(impacts);
}

std::string remark_of(const Recording& recording) {
  constexpr double most = 0.2;
  return std::visit(
      [&](const auto& slider) -> std::string {
        const double radius = standard_gravity / slider.stiffness();
        if (!slider.mounting().pendulum || recording.response.peak <= most * radius) return "";
        return "the displacement reaches " + detail::shortest(recording.response.peak) +
               " m, beyond 0.2 of the radius of " + detail::shortest(radius) +
               " m up to which a pendulum is linear to 2 %";
      },
      recording.slider.cast<const AnySlider&>());
}

Loop loop_of(const Recording& recording) {
  return with_inputs(recording, [&](const auto& slider, const auto& motion) {
    return largest_loop(slider, motion, recording.response);
  });
}

// A function of Python that takes the response.
auto in_python(const char* module, const char* function) {
  return [=](const py::object& self) { return py::module_::import(module).attr(function)(self); };
}

template <auto member>
auto history() {
  return [](const py::object& self) { return view(self.cast<const Recording&>().response.*member, self); };
}

template <auto member>
auto number() {
  return [](const Recording& recording) { return recording.response.*member; };
}

}  // namespace

template <>
inline constexpr auto parts<Recording> = std::tuple(&Recording::response, &Recording::slider, &Recording::motion);

void bind_response(py::module_& m) {
  value_class<Energy>(m, "Energy", R"(Where the energy went, per unit mass [J/kg = m^2/s^2].

initial + input = dissipated + damped + impact + kinetic + elastic, to round-off: the energy of the motion along x.)")
      .def_readonly("initial", &Energy::initial, "Kinetic and elastic energy at the start.")
      .def_readonly("input", &Energy::input, R"(Work of the load, the integral of p x' dt; on level ground p = -n.

Of a pendulum, also that of a normal force which is not g on its spring, the integral of wn^2 (1 - N+/g) x x' dt.)")
      .def_readonly("dissipated", &Energy::dissipated,
                    "Work against friction, the integral of resist N+/g |x'| dt, and of its impulses on landing.")
      .def_readonly("damped", &Energy::damped, "Work on the damper, the integral of c x'^2 dt.")
      .def_readonly("kinetic", &Energy::kinetic, "x'^2 / 2 at the end.")
      .def_readonly("elastic", &Energy::elastic, "wn^2 x^2 / 2 at the end.")
      .def_readonly("impact", &Energy::impact, "Lost on stops, the sum of (1 - restitution^2) x'^2 / 2.")
      .def_property_readonly("imbalance", &Energy::imbalance, "What does not add up: round-off.")
      .def("__repr__", [](const Energy& e) {
        return "Energy(initial=" + detail::shortest(e.initial) + ", input=" + detail::shortest(e.input) +
               ", dissipated=" + detail::shortest(e.dissipated) + ", damped=" + detail::shortest(e.damped) +
               ", kinetic=" + detail::shortest(e.kinetic) + ", elastic=" + detail::shortest(e.elastic) +
               ", impact=" + detail::shortest(e.impact) + ")";
      });

  value_class<Recording>(m, "Response", R"(The motion of a slider under one ground motion; what `integrate` returns.

Displacement and velocity are relative to the ground. The arrays are read-only; displacement and velocity are not
copied.)")
      .def_property_readonly(
          "slider", [](const Recording& r) { return r.slider; }, "The slider that moved.")
      .def_property_readonly(
          "motion", [](const Recording& r) { return r.motion; }, "The ground motion.")
      .def_property_readonly("time", &time_of, R"(Times of the samples [s], shape (N,).

Those of the ground motion. With `settle=True`, where the slider still moves at the last of them, samples continue at
the motion's last step up to the first at or after rest, so that `displacement[-1]` is `residual`; but see `truncated`.)")
      .def_property_readonly("displacement", history<&Response::displacement>(), "x at `time` [m], shape (N,).")
      .def_property_readonly("velocity", history<&Response::velocity>(), "x' at `time` [m/s], shape (N,).")
      .def_property_readonly("acceleration",
                             at_samples([](const Forces& f, std::size_t i) { return f.acceleration(i); }),
                             R"(Absolute acceleration of the mass at `time` [m/s^2], shape (N,).

On level ground x'' + n = -force, on a slope g sin(slope) - force; that of the ground where the slider sticks. At a sample where a slip begins, turns or stops, or where a
held ground acceleration jumps, this and the forces are the values just after it. At the end of the ground motion they
belong to its last value (of held values, the last that acts), and later to a ground at rest.)")
      .def_property_readonly("friction", force<&Forces::friction>(),
                             R"(Friction force per unit mass at `time` [m/s^2], shape (N,).

resist N+/g sgn(x') during a slip; while the slider sticks what balances the other forces, p - spring, also where a stop
holds it. Like the other forces it is positive where it pulls toward negative x: x'' + friction + damper + spring = p, on
level ground p = -n.)")
      .def_property_readonly("normal_force", force<&Forces::normal>(),
                             R"(Normal force per unit mass at `time`, N+ [m/s^2], shape (N,).

max(N, 0), N = (g + a_z) cos(slope) + n sin(slope); 0 while the slider flies.)")
      .def_property_readonly("gap", &gap_of, R"(Gap between slider and ground at `time` [m], shape (N,).

0 but while the slider flies, with contact='flight'.)")
      .def_property_readonly("spring", force<&Forces::spring>(),
                             "Force of the spring per unit mass at `time`, wn^2 x, of a pendulum times N+/g [m/s^2], "
                             "shape (N,).")
      .def_property_readonly("damper", force<&Forces::damper>(),
                             "Force of the damper per unit mass at `time`, c x' [m/s^2], shape (N,).")
      .def_property_readonly("force", at_samples([](const Forces& f, std::size_t i) { return f.total(i); }),
                             R"(friction + damper + spring at `time` [m/s^2], shape (N,).

The force per unit mass between the mass and the ground, as of an isolator, positive with the displacement.)")
      .def_property_readonly(
          "stuck", [](Recording& r) { return array_of(forces_of(r).stuck).attr("view")("?"); },
          "Whether the slider sticks at `time` (bool), shape (N,); just after a sample where that changes.")
      .def_property_readonly("truncated", number<&Response::truncated>(),
                             R"(Whether the samples end before the slider rests (bool).

They end at ten times the number of samples of the ground motion. Peak, residual, events and energy are still those of
the final rest.)")
      .def_property_readonly("components", number<&Response::components>(),
                             R"(The components of the ground motion that acted, joined by " + " (str).

'axis': along the axis of the slider; 'axis + vertical'. A transverse component never acts.)")
      .def_property_readonly(
          "contact", [](const Recording& r) { return name_of(r.response.contact); },
          "What was asked of a slider that the ground falls away from, 'flight' or 'clipped'; see `integrate`.")
      .def_property_readonly("remark", &remark_of,
                             "What limits the answer, in a sentence; empty where nothing does. (str)")
      .def_property_readonly("impacts", &impacts_of,
                             R"(Impacts on stops in order of time: a structured array, as `events`.

The velocity is that of arrival [m/s].)")
      .def_property_readonly("events", &events_of,
                             R"(Changes of mode in order of time, and the end: a structured array.

Fields: time [s], displacement [m], velocity [m/s], kind ('breakaway', 'reversal', 'arrest', 'impact', 'liftoff',
'landing' or 'end'). A slip that is under way at the start is entered as a breakaway there. An impact has the velocity of
arrival; a slider that a stop throws back goes on without a reversal.)")
      .def_property_readonly("peak", number<&Response::peak>(), "Largest |x| over all time, not only at samples [m].")
      .def_property_readonly("residual", number<&Response::residual>(), "x at the end [m]; final if the slider rests.")
      .def_property_readonly(
          "at_rest", [](const Recording& r) { return r.response.state.mode == Mode::stuck; },
          "Whether the slider rests at the end.")
      .def_property_readonly(
          "state", [](const Recording& r) { return r.response.state; },
          "The `State` at the end: a motion can be continued from it.")
      .def_property_readonly("sliding_distance", number<&Response::sliding_distance>(), "Length of the way slid [m].")
      .def_property_readonly(
          "slips",
          [](const Recording& r) {
            return std::ranges::count_if(r.response.events, [](const Event& e) {
              return e.kind == EventKind::breakaway || e.kind == EventKind::reversal;
            });
          },
          "Number of slips; a reversal ends one and begins another.")
      .def_property_readonly("time_sliding", number<&Response::time_sliding>(), "Time spent sliding [s].")
      .def_property_readonly("energy", number<&Response::energy>(), "Where the energy went, per unit mass [m^2/s^2].")
      .def_property_readonly(
          "effective_period", [](const Recording& r) { return loop_of(r).period(); },
          R"(2 pi / sqrt(k_eff) of the hysteresis loop with the largest displacement [s].

k_eff = F / D: D is `peak`, F the force of spring and friction there, before the slider turns or stops. With Coulomb
friction k_eff = wn^2 + slip_level / D. ValueError without a spring, where no force draws the mass back; where it never
slips; where |x| is largest at the start, or at the end of a slip that is not over.)")
      .def_property_readonly(
          "effective_damping", [](const Recording& r) { return loop_of(r).damping(); },
          R"(E_d / (2 pi k_eff D^2) of the same loop, a part of critical damping.

An earthquake response closes no loop. E_d is therefore that of a cycle from D to -D and back: 4 D times the energy per
meter that friction and damper took in the swing up to the peak. In a steady cycle about x = 0 that is the area of the
loop; with Coulomb friction E_d = 4 slip_level D. ValueError as for `effective_period`.)")
      .def("plot", plot_in("plot_response", "figure"), py::kw_only(), py::arg("figure") = py::none(),
           py::arg("title") = py::none(),
           R"(Draws ground acceleration with the slip level, velocity with sticks shaded, and displacement.

Needs matplotlib (`pip install stickslip[plot]`). Takes `figure`, a matplotlib Figure or SubFigure to draw in, and
`title`. Returns the figure, see `stickslip.plotting.plot_response`.)")
      .def(
          "plot_hysteresis",
          [](const py::object& self, const py::object& figure, const py::object& title, const py::object& ax) {
            return py::module_::import("stickslip.plotting")
                .attr("plot_hysteresis")(self, figure, title, py::arg("ax") = ax);
          },
          py::kw_only(), py::arg("figure") = py::none(), py::arg("title") = py::none(), py::arg("ax") = py::none(),
          R"(Draws force against displacement.

Needs matplotlib. Takes `ax`, matplotlib Axes, or `figure`, a Figure or SubFigure, to draw in, and `title`. Returns the
axes or the figure, see `stickslip.plotting.plot_hysteresis`.)")
      .def("to_dataframe", in_python("stickslip._tables", "to_dataframe"),
           R"(The histories as a pandas DataFrame.

Its index is 'time [s]'; the columns are named with their units: ground acceleration, displacement, velocity,
acceleration, friction, spring, damper and force, and 'stuck' (bool). The ground acceleration is that of the samples, and
0 after the motion. ImportError without pandas.)")
      .def("to_xarray", in_python("stickslip._tables", "to_xarray"),
           R"(The histories as an xarray Dataset over the coordinate `time`.

The variables are those of `to_dataframe`, each with the attributes `units` and `long_name`. Attributes of the whole:
slider, motion (its name), peak [m], residual [m]. ImportError without xarray.)")
      .def(
          "to_csv",
          [](const py::object& self, const py::object& path) {
            return py::module_::import("stickslip._tables").attr("to_csv")(self, path);
          },
          py::arg("path"),
          R"(Writes the histories to a file of comma-separated values, whole or not at all.

Parameters
----------
path : path-like
    A file there is replaced.

Returns
-------
Path

Raises
------
OSError
    The folder is missing or cannot be written; the file is read-only, or no regular file.

Notes
-----
One line of names with units, then one line a sample; every number reads back to the same double.)")
      .def("_repr_html_", in_python("stickslip._tables", "response_html"))
      .def("__repr__", [](const Recording& r) {
        return "<Response: peak " + detail::shortest(r.response.peak) + " m, residual " +
               detail::shortest(r.response.residual) + " m, " + std::to_string(r.response.events.size()) + " events" +
               (r.response.truncated ? ", samples end before rest>" : ">");
      });
}

}  // namespace stickslip::python
