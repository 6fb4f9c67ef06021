#include "sliding/response.hpp"

#include <algorithm>

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

initial + input = dissipated + damped + kinetic + elastic, to round-off.)")
      .def_readonly("initial", &Energy::initial, "Kinetic and elastic energy at the start.")
      .def_readonly("input", &Energy::input, "Work of the ground on the slider, the integral of -n x' dt.")
      .def_readonly("dissipated", &Energy::dissipated, "Work against friction, the integral of resist |x'| dt.")
      .def_readonly("damped", &Energy::damped, "Work on the damper, the integral of c x'^2 dt.")
      .def_readonly("kinetic", &Energy::kinetic, "x'^2 / 2 at the end.")
      .def_readonly("elastic", &Energy::elastic, "wn^2 x^2 / 2 at the end.")
      .def_property_readonly("imbalance", &Energy::imbalance, "What does not add up: round-off.")
      .def("__repr__", [](const Energy& e) {
        return "Energy(initial=" + detail::shortest(e.initial) + ", input=" + detail::shortest(e.input) +
               ", dissipated=" + detail::shortest(e.dissipated) + ", damped=" + detail::shortest(e.damped) +
               ", kinetic=" + detail::shortest(e.kinetic) + ", elastic=" + detail::shortest(e.elastic) + ")";
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
      .def_property_readonly("truncated", number<&Response::truncated>(),
                             R"(Whether the samples end before the slider rests (bool).

They end at ten times the number of samples of the ground motion. Peak, residual, events and energy are still those of
the final rest.)")
      .def_property_readonly("events", &events_of,
                             R"(Changes of mode in order of time, and the end: a structured array.

Fields: time [s], displacement [m], velocity [m/s], kind ('breakaway', 'reversal', 'arrest' or 'end'). A slip that is
under way at the start is entered as a breakaway there.)")
      .def_property_readonly("peak", number<&Response::peak>(), "Largest |x| over all time, not only at samples [m].")
      .def_property_readonly("residual", number<&Response::residual>(), "x at the end [m]; final if the slider rests.")
      .def_property_readonly(
          "at_rest", [](const Recording& r) { return r.response.state.mode == Mode::stuck; },
          "Whether the slider rests at the end.")
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
      .def(
          "plot",
          [](const py::object& self, const py::kwargs& options) {
            return py::module_::import("stickslip.plotting").attr("plot_response")(self, **options);
          },
          R"(Draws ground acceleration with the slip level, velocity with sticks shaded, and displacement.

Needs matplotlib (`pip install stickslip[plot]`). Returns the matplotlib Figure.)")
      .def("__repr__", [](const Recording& r) {
        return "<Response: peak " + detail::shortest(r.response.peak) + " m, residual " +
               detail::shortest(r.response.residual) + " m, " + std::to_string(r.response.events.size()) + " events" +
               (r.response.truncated ? ", samples end before rest>" : ">");
      });
}

}  // namespace stickslip::python
