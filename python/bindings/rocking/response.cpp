#include "rocking/rocking.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "in_python.hpp"
#include "sliding/response.hpp"
#include "sliding/units_remark.hpp"
#include "statistics/estimate.hpp"
#include "stickslip/rocking/integrate.hpp"

namespace stickslip::python {
namespace {

using Self = RockingResponseWithInputs;

const SlenderBlock& block_of(const Self& self) { return self.block.cast<const SlenderBlock&>(); }
const GroundMotion& motion_of(const Self& self) { return self.motion.cast<const GroundMotion&>(); }

std::u32string_view name_of(RockingEventKind kind) {
  switch (kind) {
    case RockingEventKind::uplift:
      return U"uplift";
    case RockingEventKind::impact:
      return U"impact";
    case RockingEventKind::rest:
      return U"rest";
    case RockingEventKind::overturned:
      return U"overturned";
    case RockingEventKind::end:
      return U"end";
  }
  return U"";
}

py::array events_array(const std::vector<RockingEvent>& events) {
  struct Row {
    double time, rotation, rate;
    char32_t kind[10];
  };
  py::dict layout;
  layout["names"] = py::make_tuple("time", "rotation", "rate", "kind");
  layout["formats"] = py::make_tuple("f8", "f8", "f8", "U10");
  layout["offsets"] =
      py::make_tuple(offsetof(Row, time), offsetof(Row, rotation), offsetof(Row, rate), offsetof(Row, kind));
  layout["itemsize"] = sizeof(Row);
  py::array rows(py::dtype::from_args(layout), static_cast<py::ssize_t>(events.size()));
  auto* row = static_cast<Row*>(rows.mutable_data());
  for (const RockingEvent& e : events) {
    *row = {e.time, e.rotation, e.rate, {}};
    std::ranges::copy(name_of(e.kind), row->kind);
    ++row;
  }
  return rows;
}

template <auto member>
auto history() {
  return [](const py::object& self) { return view(self.cast<const Self&>().response.*member, self); };
}
template <auto member>
auto number() {
  return [](const Self& self) { return self.response.*member; };
}

// At rest under the motion: the largest load over the level of uplift.
double load_ratio(const SlenderBlock& block, const GroundMotion& motion) {
  double largest = 0;
  for (std::size_t i = 0; i < motion.samples(); ++i) {
    const double n = motion.acceleration()[i];
    const double heavy = standard_gravity + (motion.has_vertical() ? motion.vertical()[i] : 0.0);
    largest = std::max(largest, std::max(-n / block.alpha_right(), n / block.alpha_left()) / heavy);
  }
  return largest;
}

std::string remark_of(const Self& self) {
  const RockingResponse& r = self.response;
  if (r.condition * 1e-16 > 1e-6)
    return "the history hangs on round-off: a change of the input by 1e-16 of it changes theta/alpha by " +
           digits(r.condition * 1e-16) + "; only probabilities mean something, see run_ensemble";
  if (r.overturned != 0)
    return "whether a block overturns is not monotone in the scale of a record: it may stand at larger scales and "
           "overturn at smaller ones; see critical_scales";
  const double peak = motion_of(self).peak_acceleration();
  if (r.time_rocking > 0 || !(peak > 0 && peak <= most_g)) return "";
  const double load = load_ratio(block_of(self), motion_of(self));
  if (load >= 1 || load * standard_gravity <= 1) return "";
  return "the block never rocks: the peak ground acceleration is " + digits(peak) + " m/s^2 (" +
         digits(peak / standard_gravity) + " g); if the accelerations are in g, give units=\"g\": at " + digits(peak) +
         " g it rocks";
}

Self integrate_block(const SlenderBlock& block, const py::object& motion, double rotation, double rate, bool settle) {
  if (!py::isinstance<GroundMotion>(motion))
    throw py::type_error("integrate: the motion of a SlenderBlock must be a GroundMotion, got " +
                         py::type::of(motion).attr("__name__").cast<std::string>() +
                         (py::isinstance<HarmonicMotion>(motion) ? "; give motion.sampled(dt)" : ""));
  const auto& ground = motion.cast<const GroundMotion&>();
  RockingResponse response = [&] {
    const py::gil_scoped_release released;
    return integrate(block, ground, {rotation, rate, settle, check_for_interrupt});
  }();
  return {std::move(response), py::cast(block), motion};
}

auto picture(const char* function) {
  return [=](const py::object& self, const py::object& figure, const py::object& title) {
    return py::module_::import("stickslip.plotting").attr(function)(self, figure, title);
  };
}

}  // namespace

void bind_rocking_response(py::module_& m) {
  const auto energy = [](auto member) { return [=](const RockingEnergy& e) { return e.energy.*member; }; };
  value_class<RockingEnergy>(m, "RockingEnergy",
                             R"(Energy balance of a block that rocks, over its moment of inertia about a corner [1/s^2].

initial + input = impact + fall + kinetic + potential, to round-off.)")
      .def_property_readonly("initial", energy(&Energy::initial), "Kinetic and potential energy at the start.")
      .def_property_readonly("input", energy(&Energy::input),
                             "Work of the ground, the integral of -p^2 (n + a_z (s alpha - theta))/g theta' dt.")
      .def_property_readonly("impact", energy(&Energy::impact),
                             "Lost in impacts of the base, the sum of (1 - restitution^2) theta'^2 / 2.")
      .def_property_readonly("fall", energy(&Energy::dissipated),
                             "Kinetic energy with which a block lands on its side.")
      .def_property_readonly("kinetic", energy(&Energy::kinetic), "theta'^2 / 2 at the end.")
      .def_property_readonly("potential", energy(&Energy::elastic),
                             "p^2 |theta| (alpha - |theta|/2) at the end: of the weight.")
      .def_property_readonly(
          "imbalance", [](const RockingEnergy& e) { return e.energy.imbalance(); },
          "Residual of the energy balance (round-off).")
      .def("__repr__", [](const RockingEnergy& e) {
        return "<RockingEnergy [1/s^2]: initial " + digits(e.energy.initial) + ", input " + digits(e.energy.input) +
               ", impact " + digits(e.energy.impact) + ", fall " + digits(e.energy.dissipated) + ", kinetic " +
               digits(e.energy.kinetic) + ", potential " + digits(e.energy.elastic) + ">";
      });

  value_class<Self>(m, "RockingResponse",
                    R"(The response of a block that rocks, as `integrate` returns it for a `SlenderBlock`.

Rotations are relative to the ground, positive about the right corner. The arrays are read-only.)")
      .def_property_readonly(
          "block", [](const Self& r) { return r.block; }, "The `SlenderBlock`.")
      .def_property_readonly(
          "motion", [](const Self& r) { return r.motion; }, "The ground motion.")
      .def_property_readonly(
          "time",
          [](Self& r) {
            return keep(r.time, [&] { return times_of(r.motion, motion_of(r), r.response.rotation.size()); });
          },
          R"(Times of the samples [s], shape (N,).

The times of the ground motion. With `settle=True`, if the block still rocks at the last of them, samples continue with the
last step of the motion up to the first at or after rest; but see `truncated`.)")
      .def_property_readonly("rotation", history<&RockingResponse::rotation>(),
                             "theta at `time` [rad], shape (N,); pi/2 in magnitude where the block lies on its side.")
      .def_property_readonly("rate", history<&RockingResponse::rate>(), "theta' at `time` [rad/s], shape (N,).")
      .def_property_readonly(
          "events", [](Self& r) { return keep(r.events, [&] { return events_array(r.response.events); }); },
          R"(Events sorted by time: a structured array.

Fields: time [s], rotation [rad], rate [rad/s], kind ('uplift', 'impact', 'rest', 'overturned' or 'end'). The rate of an
impact is that before it. A block that rocks already at the start has an uplift there. Of infinitely many bounces before
a rest, those that are resolved: the last ones have a negligible speed.)")
      .def_property_readonly("peak_rotation", number<&RockingResponse::peak>(),
                             "Largest |theta| over all time, not only at samples [rad]; pi/2 if the block overturned.")
      .def_property_readonly("peak_time", number<&RockingResponse::peak_time>(),
                             "Time of `peak_rotation`; `overturned_at` if the block overturned [s].")
      .def_property_readonly("peak_rotation_ratio", number<&RockingResponse::peak_ratio>(),
                             "Largest |theta| over alpha of its side; infinite if the block overturned.")
      .def_property_readonly(
          "overturned", [](const Self& r) { return side_name(r.response.overturned); },
          "Side to which the block overturned, 'right' or 'left'; None if it stands.")
      .def_property_readonly(
          "overturned_at",
          [](const Self& r) {
            return r.response.overturned == 0 ? std::nullopt : std::optional(r.response.overturned_at);
          },
          R"(Time from which it is certain that the block never comes back [s]; None if it stands.

From the rest of the record it follows long before the block lies on its side: in the median, at 0.26 alpha. Under vertical
motion it is the time at which |theta| = pi/2, or the end of the record.)")
      .def_property_readonly("impacts", number<&RockingResponse::impacts>(),
                             "Number of impacts faster than 1e-3 p alpha; slower ones are too many to count.")
      .def_property_readonly("uplifts", number<&RockingResponse::uplifts>(), "Number of uplifts from rest.")
      .def_property_readonly("time_rocking", number<&RockingResponse::time_rocking>(), "Time spent rocking [s].")
      .def_property_readonly(
          "energy", [](const Self& r) { return RockingEnergy{r.response.energy}; }, "The `RockingEnergy`.")
      .def_property_readonly("margin", number<&RockingResponse::margin>(),
                             R"(Distance of the nearest decision, relative to what decides; infinite without a decision.

The smallest of the distance from the stable manifold of overturning at turning points beyond alpha/2, over p alpha
(on it the block would neither fall nor come back), and of 1 - load/level at the maxima of the load at rest. If it is
tiny, the history hangs on round-off.)")
      .def_property_readonly("condition", number<&RockingResponse::condition>(),
                             R"(Largest |d theta / d ln(scale of the ground motion)| over alpha, at samples.

From the exact derivative along the motion, up to an overturning: a relative error of 1e-16 of the input becomes
1e-16 condition in theta/alpha. A rest resets it.)")
      .def_property_readonly("remark", &remark_of,
                             R"(A sentence about limits of the result; empty if there are none (str).

A history that hangs on round-off, with condition * 1e-16 > 1e-6; an overturned block, which may stand at a larger scale;
a block that never rocks, but would if the ground accelerations were in g.)")
      .def_property_readonly(
          "at_rest", [](const Self& r) { return r.response.state.mode == RockingMode::rest; },
          "Whether the block rests on its base at the end (bool).")
      .def_property_readonly("state", number<&RockingResponse::state>(),
                             "The `RockingState` at the end; `advance` can continue from it.")
      .def_property_readonly("truncated", number<&RockingResponse::truncated>(),
                             R"(Whether the samples end before the block comes to rest (bool).

Samples end at ten times the number of samples of the ground motion. Peak, events and energy still include the motion up to
rest.)")
      .def_property_readonly("components", number<&RockingResponse::components>(),
                             "Components of the ground motion that acted: 'axis' or 'axis + vertical' (str).")
      .def("plot", picture("plot_rocking_response"), py::kw_only(), py::arg("figure") = py::none(),
           py::arg("title") = py::none(),
           R"(Plot ground acceleration and theta/alpha over time, with impacts, peak and overturning.

Needs matplotlib (`pip install stickslip[plot]`). Takes `figure`, a matplotlib Figure or SubFigure to draw in, and `title`.
Returns the figure, see `stickslip.plotting.plot_rocking_response`.)")
      .def("plot_phase", picture("plot_rocking_phase"), py::kw_only(), py::arg("figure") = py::none(),
           py::arg("title") = py::none(),
           R"(Plot theta'/(p alpha) over theta/alpha, with the separatrix of a still ground.

Needs matplotlib. Takes `figure`, a matplotlib Figure or SubFigure to draw in, and `title`. Returns the figure, see
`stickslip.plotting.plot_rocking_phase`.)")
      .def("animate", animation(), py::kw_only(), py::arg("time") = py::none(), py::arg("speed") = 1.0,
           py::arg("fps") = 15.0, py::arg("title") = py::none(), py::arg("size") = py::none(),
           R"(Show the block rocking on its moving ground, with theta/alpha below.

Needs matplotlib. Takes `time`, the begin and end of the part to show [s], `speed`, seconds of the motion in a second of
the animation, `fps`, frames in a second, `title`, and `size`, width and height [inches]. Returns an animation: a notebook shows it, its `write` saves it as
.gif, .mp4 or .html; see `stickslip.plotting.animate`.)")
      .def("to_dataframe", in_python("stickslip.rocking.tables", "to_dataframe"),
           R"(Convert the histories to a pandas DataFrame over `time` [s].

Columns `ground_acceleration` [m/s^2], `rotation` [rad] and `rate` [rad/s], and `vertical_ground_acceleration` [m/s^2] if it
acted; units are in `attrs["units"]`. ImportError without pandas.)")
      .def("to_xarray", in_python("stickslip.rocking.tables", "to_xarray"),
           R"(Convert the histories to an xarray Dataset over the coordinate `time`.

The variables are the columns of `to_dataframe`, each with the attribute `units`. ImportError without xarray.)")
      .def("to_csv", csv_in("stickslip.rocking.tables", "to_csv"), py::arg("path"),
           csv_doc("Write the histories to a CSV file, whole or not at all.",
                   "A line of names with units, then one line per sample; every number reads back as the same double.")
               .c_str())
      .def("to_json", in_python("stickslip.rocking.tables", "to_json"),
           R"(The results and histories as one JSON document, for instance for a web page.

Returns
-------
str
    An object with `block`, `motion`, the results under the names of the attributes, `units` by name, the columns of
    `to_dataframe` as lists, and `events`. Numbers read back to the same double; NaN and infinity are null.)")
      .def("_repr_html_", in_python("stickslip.rocking.tables", "response_html"))
      .def("__repr__", [](const Self& r) {
        const std::string remark = remark_of(r);
        const auto side = side_name(r.response.overturned);
        return "<RockingResponse: " +
               (side ? "overturned to the " + *side + ", certain at " + digits(r.response.overturned_at) + " s"
                     : "peak " + digits(r.response.peak) + " rad (" + digits(r.response.peak_ratio) + " alpha)") +
               ", " + std::to_string(r.response.impacts) + " impacts" +
               (r.response.truncated ? ", samples end before rest" : "") + (remark.empty() ? "" : "; " + remark) + ">";
      });

  m.def(
      "integrate", &integrate_block, py::arg("slider"), py::arg("motion"), py::kw_only(), py::arg("rotation") = 0.0,
      py::arg("rate") = 0.0, py::arg("settle") = false,
      R"(With a `SlenderBlock`, a block that rocks, from `rotation` [rad], below pi/2 in magnitude, and `rate` [rad/s]. The
horizontal component along the axis acts, and a vertical one, under which g + a_z must stay positive. With `settle`, until the
block rests or falls. Returns a `RockingResponse`.

Closed form between impacts, exact to round-off, which grows as e^(p t) between rests (see `RockingResponse.condition`); 60 ns
per sample at rest, 0.8 us where every third sample has an impact. ValueError also for g + a_z <= 0; ConvergenceError with
`settle` and a restitution of 1.)");
}

}  // namespace stickslip::python
