#include "rocking/rocking.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>

#include "any_response.hpp"
#include "in_python.hpp"
#include "sliding/response.hpp"
#include "sliding/units_remark.hpp"
#include "statistics/estimate.hpp"
#include "stickslip/rocking/integrate.hpp"
#include "stickslip/rocking/sensitivity.hpp"
#include "structured.hpp"

namespace stickslip::python {
namespace {

using Self = RockingResponseWithInputs;

bool is_rigid(const Self& self) { return py::isinstance<RockingBlock>(self.block); }
const GroundMotion& motion_of(const Self& self) { return self.motion.cast<const GroundMotion&>(); }

std::u32string_view name_of(RockingEventKind kind) {
  switch (kind) {
    case RockingEventKind::uplift:
      return U"uplift";
    case RockingEventKind::impact:
      return U"impact";
    case RockingEventKind::slip:
      return U"slip";
    case RockingEventKind::stick:
      return U"stick";
    case RockingEventKind::liftoff:
      return U"liftoff";
    case RockingEventKind::landing:
      return U"landing";
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
    TextField<10> kind;
    double rate_after, displacement, speed;
    std::int64_t side;
  };
  const auto row = [&](std::size_t i) -> Row {
    const RockingEvent& e = events[i];
    return {e.time, e.rotation, e.rate, name_of(e.kind), e.rate_after, e.displacement, e.speed, e.side};
  };
  return structured(events.size(), row, std::pair("time", &Row::time), std::pair("rotation", &Row::rotation),
                    std::pair("rate", &Row::rate), std::pair("kind", &Row::kind),
                    std::pair("rate_after", &Row::rate_after), std::pair("displacement", &Row::displacement),
                    std::pair("speed", &Row::speed), std::pair("side", &Row::side));
}

template <auto member>
auto history() {
  return [](const py::object& self) { return view(self.cast<const Self&>().response.*member, self); };
}
/// Zeros of a SlenderBlock, which stays where it is.
template <auto member>
auto history_or_zeros() {
  return [](const py::object& self) -> py::object {
    const auto& r = self.cast<const Self&>();
    if (is_rigid(r)) return view(r.response.*member, self);
    return array_of(std::vector<double>(r.response.rotation.size(), 0.0));
  };
}
template <auto member>
auto number() {
  return [](const Self& self) { return self.response.*member; };
}

// At rest under the motion: the largest load over the level of uplift, or of slip.
double load_ratio(const Self& self) {
  double right, left;
  if (is_rigid(self)) {
    const auto& block = self.block.cast<const RockingBlock&>();
    right = std::min(block.right() / block.center_height(), block.mu());
    left = std::min(block.left() / block.center_height(), block.mu());
  } else {
    const auto& block = self.block.cast<const SlenderBlock&>();
    right = block.alpha_right(), left = block.alpha_left();
  }
  const GroundMotion& motion = motion_of(self);
  double largest = 0;
  for (std::size_t i = 0; i < motion.samples(); ++i) {
    const double n = motion.acceleration()[i];
    const double heavy = standard_gravity + (motion.has_vertical() ? motion.vertical()[i] : 0.0);
    largest = std::max(largest, std::max(-n / right, n / left) / heavy);
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
  if (r.impacts_with_slip > 0)
    return "in " + std::to_string(r.impacts_with_slip) +
           " impacts the corner slipped, so that the given restitution could not hold; they are those of a plastic "
           "impact";
  const double peak = motion_of(self).peak_acceleration();
  if (r.time_rocking > 0 || r.time_sliding > 0 || !(peak > 0 && peak <= most_g)) return "";
  const double load = load_ratio(self);
  if (load >= 1 || load * standard_gravity <= 1) return "";
  return "the block never moves: the peak ground acceleration is " + digits(peak) + " m/s^2 (" +
         digits(peak / standard_gravity) + " g); if the accelerations are in g, give units=\"g\": at " + digits(peak) +
         " g it does";
}

RockingSensitivity sensitivity_of(const Self& self, const std::string& name) {
  static const std::map<std::string, RockingParameter> parameters{{"p", RockingParameter::p},
                                                                  {"alpha", RockingParameter::alpha},
                                                                  {"alpha_right", RockingParameter::alpha_right},
                                                                  {"alpha_left", RockingParameter::alpha_left},
                                                                  {"restitution", RockingParameter::restitution},
                                                                  {"scale", RockingParameter::scale}};
  const auto found = parameters.find(name);
  if (found == parameters.end())
    throw std::invalid_argument(
        "RockingResponse.sensitivity: parameter must be 'p', 'alpha', 'alpha_right', 'alpha_left', 'restitution' or "
        "'scale', got '" +
        name + "'");
  if (is_rigid(self))
    throw std::invalid_argument(
        "RockingResponse.sensitivity: covers a SlenderBlock; of a RockingBlock take differences of two responses");
  const auto& block = self.block.cast<const SlenderBlock&>();
  const GroundMotion& motion = motion_of(self);
  const py::gil_scoped_release released;
  return sensitivity(block, motion, self.response, found->second);
}

template <class Block>
RockingResponse response_of(const Block& block, const py::object& motion, const RockingOptions& options,
                            const char* who) {
  if (!py::isinstance<GroundMotion>(motion))
    throw py::type_error(who + std::string(": the motion of a block that rocks must be a GroundMotion, got ") +
                         py::type::of(motion).attr("__name__").cast<std::string>() +
                         (py::isinstance<HarmonicMotion>(motion) ? "; give motion.sampled(dt)" : ""));
  const auto& ground = motion.cast<const GroundMotion&>();
  const py::gil_scoped_release released;
  return integrate(block, ground, options);
}

template <class Block>
Self integrate_block(const Block& block, const py::object& motion, double rotation, double rate, bool settle) {
  return {response_of(block, motion, {rotation, rate, settle, check_for_interrupt}, "integrate"), py::cast(block),
          motion};
}

template <class Block>
py::tuple histories_block(const Block& block, const py::object& motion) {
  RockingResponse response = response_of(block, motion, {.progress = check_for_interrupt}, "histories");
  return py::make_tuple(array_of(std::move(response.rotation)), array_of(std::move(response.rate)));
}

py::object at_times(const Self& self, const py::object& times) {
  struct Row {
    double time, rotation, rate;
    bool at_rest, in_flight;
  };
  return at(
      "RockingResponse", times,
      [&](const std::vector<double>& t) {
        const GroundMotion& motion = motion_of(self);
        const auto of = [&](const auto& block) {
          const py::gil_scoped_release released;
          return states_at(block, motion, self.response, t);
        };
        return is_rigid(self) ? of(self.block.cast<const RockingBlock&>()) : of(self.block.cast<const SlenderBlock&>());
      },
      [](double t, const RockingState& s) {
        return Row{t, s.rotation, s.rate, s.mode == RockingMode::rest, s.mode == RockingMode::flight};
      },
      std::pair("time", &Row::time), std::pair("rotation", &Row::rotation), std::pair("rate", &Row::rate),
      std::pair("at_rest", &Row::at_rest), std::pair("in_flight", &Row::in_flight));
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
                             R"(Energy balance of a block that rocks.

initial + input = friction + impact + fall + kinetic + potential, to round-off: of a `SlenderBlock` over its moment of
inertia about a corner [1/s^2], of a `RockingBlock` over its mass [m^2/s^2].)")
      .def_property_readonly("initial", energy(&Energy::initial), "Kinetic and potential energy at the start.")
      .def_property_readonly("input", energy(&Energy::input),
                             R"(Work of the ground.

The integral of -p^2 (n + a_z (s alpha - theta))/g theta' dt, or of -(n X' + a_z Y') dt.)")
      .def_property_readonly("friction", energy(&Energy::dissipated),
                             "Work against friction while the base or a corner slips; 0 of a `SlenderBlock`.")
      .def_property_readonly(
          "impact", energy(&Energy::impact),
          "Lost in impacts of the base, the sum of (1 - restitution^2) theta'^2 / 2, and in landings.")
      .def_property_readonly("fall", energy(&Energy::damped), "Kinetic energy with which a block lands on its side.")
      .def_property_readonly("kinetic", energy(&Energy::kinetic), "At the end, of a `SlenderBlock` theta'^2 / 2.")
      .def_property_readonly("potential", energy(&Energy::elastic),
                             "Of the weight at the end: p^2 |theta| (alpha - |theta|/2), or g times the rise.")
      .def_property_readonly(
          "imbalance", [](const RockingEnergy& e) { return e.energy.imbalance(); },
          "Residual of the energy balance (round-off).")
      .def("__repr__", [](const RockingEnergy& e) {
        return std::string("<RockingEnergy [") + (e.per_mass ? "m^2/s^2" : "1/s^2") + "]: initial " +
               digits(e.energy.initial) + ", input " + digits(e.energy.input) +
               (e.per_mass ? ", friction " + digits(e.energy.dissipated) : "") + ", impact " + digits(e.energy.impact) +
               ", fall " + digits(e.energy.damped) + ", kinetic " + digits(e.energy.kinetic) + ", potential " +
               digits(e.energy.elastic) + ">";
      });

  value_class<RockingSensitivity>(
      m, "RockingSensitivity",
      R"(Derivatives of the motion of a `SlenderBlock` with respect to a parameter, from `RockingResponse.sensitivity`.

In rad, or rad/s, per unit of the parameter.)")
      .def_readonly("peak", &RockingSensitivity::peak, "Derivative of the largest |theta|.")
      .def_readonly("rotation", &RockingSensitivity::rotation, "Derivative of theta at the end; 0 if the block rests.")
      .def_readonly("rate", &RockingSensitivity::rate, "Derivative of theta' at the end; 0 if the block rests.")
      .def("__repr__", [](const RockingSensitivity& s) {
        return "<RockingSensitivity: peak " + digits(s.peak) + ", rotation " + digits(s.rotation) + ", rate " +
               digits(s.rate) + ">";
      });

  value_class<Self>(
      m, "RockingResponse",
      R"(The response of a block that rocks, as `integrate` returns it for a `SlenderBlock` or a `RockingBlock`.

Rotations are relative to the ground, positive about the right corner. The arrays are read-only.)")
      .def_property_readonly(
          "block", [](const Self& r) { return r.block; }, "The `SlenderBlock` or `RockingBlock`.")
      .def_property_readonly("rotation", history<&RockingResponse::rotation>(),
                             "theta at `time` [rad], shape (N,); pi/2 in magnitude where the block lies on its side.")
      .def_property_readonly("rate", history<&RockingResponse::rate>(), "theta' at `time` [rad/s], shape (N,).")
      .def_property_readonly("displacement", history_or_zeros<&RockingResponse::displacement>(),
                             R"(Displacement of the middle of the base relative to the ground at `time` [m], shape (N,).

At rest what the block has slid and walked. 0 for a `SlenderBlock`, which does not slip.)")
      .def_property_readonly(
          "top_displacement",
          [](const py::object& self) {
            if (!is_rigid(self.cast<const Self&>()))
              throw std::invalid_argument(
                  "RockingResponse.top_displacement: a SlenderBlock has no height; use a RockingBlock");
            return view(self.cast<const Self&>().response.top_displacement, self);
          },
          R"(Displacement of the middle of the top relative to the ground at `time` [m], shape (N,).

Of a `RockingBlock`; ValueError for a `SlenderBlock`, which has no height.)")
      .def_property_readonly(
          "gap", history_or_zeros<&RockingResponse::gap>(),
          "Height of the lower corner above the ground at `time` [m], shape (N,); 0 except in flight.")
      .def_property_readonly("residual", number<&RockingResponse::residual>(),
                             "Displacement of the base at the end [m].")
      .def_property_readonly("sliding_distance", number<&RockingResponse::sliding_distance>(),
                             "Path that the base or a corner slips [m].")
      .def_property_readonly("time_sliding", number<&RockingResponse::time_sliding>(), "Time spent slipping [s].")
      .def_property_readonly(
          "events", [](Self& r) { return keep(r.events, [&] { return events_array(r.response.events); }); },
          R"(Events sorted by time: a structured array.

Fields: time [s], rotation [rad], rate [rad/s], kind ('uplift', 'impact', 'rest', 'overturned' or 'end'; of a
`RockingBlock` also 'slip', 'stick', 'liftoff' and 'landing'), rate_after [rad/s], displacement of the base [m], speed with
which a corner arrives [m/s], and side, 1 for the right corner, -1 for the left one and 0 for the base. The rate of an impact
is that before it, rate_after that after it; displacement, speed and side are 0 for a `SlenderBlock`. A block that rocks already at the start has an uplift there. Of infinitely many bounces before
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
motion it is the time at which |theta| = pi/2, or the end of the record; that of a `RockingBlock` is always at |theta| =
pi/2.)")
      .def_property_readonly("impacts", number<&RockingResponse::impacts>(),
                             R"(Number of impacts of the base and landings; slow ones are too many to count.

Those faster than 1e-3 p alpha, of a `RockingBlock` than 1 mm/s at the corner.)")
      .def_property_readonly("uplifts", number<&RockingResponse::uplifts>(), "Number of uplifts from rest.")
      .def_property_readonly("liftoffs", number<&RockingResponse::liftoffs>(),
                             "Number of times the block leaves the ground; 0 for a `SlenderBlock`.")
      .def_property_readonly("impacts_with_slip", number<&RockingResponse::impacts_with_slip>(),
                             R"(Number of impacts at which a given restitution could not hold.

The corner slipped, or the restitution would have created energy; they are plastic impacts instead.)")
      .def_property_readonly("time_rocking", number<&RockingResponse::time_rocking>(), "Time spent rocking [s].")
      .def_property_readonly(
          "energy",
          [](const Self& r) {
            return RockingEnergy{r.response.energy, is_rigid(r)};
          },
          "The `RockingEnergy`.")
      .def_property_readonly("margin", number<&RockingResponse::margin>(),
                             R"(Distance of the nearest decision, relative to what decides; infinite without a decision.

The smallest of the distance from the stable manifold of overturning at turning points beyond alpha/2, over p alpha
(on it the block would neither fall nor come back), and of 1 - load/level at the maxima of the load at rest. If it is
tiny, the history hangs on round-off.)")
      .def_property_readonly("condition", number<&RockingResponse::condition>(),
                             R"(Largest |d theta / d ln(scale of the ground motion)| over alpha, at samples.

From the exact derivative along the motion, up to an overturning: a relative error of 1e-16 of the input becomes
1e-16 condition in theta/alpha. A rest resets it. NaN for a `RockingBlock`, whose derivatives are not computed: compare two
scales.)")
      .def("sensitivity", &sensitivity_of, py::arg("parameter"),
           R"(Differentiate the peak, and theta and theta' at the end, with respect to a parameter.

Solves the variational equation of each leg, with its jumps at impacts; not differences. With s the side, r the restitution,
f = theta'' before and after an impact and theta' the rate before it:

    leg     d(theta'') = p^2 d(theta) + 2 theta''/p dp - p^2 s d(alpha) - p^2 n/g d(scale)
    impact  d(theta) = r d(theta),  d(theta') = r d(theta') - (r f- - f+) d(theta)/theta' + theta' dr
    rest    0, and so at an uplift
    peak    d|theta| = s d(theta) at its time

Parameters
----------
parameter : str
    ``'p'`` per rad/s, ``'alpha'`` of both sides or ``'alpha_right'`` or ``'alpha_left'`` per rad, ``'restitution'``, or
    ``'scale'``, a factor of the ground acceleration, at 1.

Returns
-------
RockingSensitivity
    Equal to extrapolated differences to 1e-7 of alpha over the parameter, times 1 + `condition` (p from 1 to 4 rad/s,
    alpha from 0.08 to 0.36, restitution from 0.5 to 0.95). At a graze, where theta' almost vanishes as theta does, it has
    no bound.

Raises
------
ValueError
    A block that has overturned, vertical motion, a `RockingBlock`, or another parameter; take differences of two
    responses.)")
      .def_property_readonly("remark", &remark_of,
                             R"(A sentence about limits of the result; empty if there are none (str).

A history that hangs on round-off, with condition * 1e-16 > 1e-6; an overturned block, which may stand at a larger scale;
impacts at which a given restitution could not hold; a block that never moves, but would if the ground accelerations were in
g.)")
      .def_property_readonly(
          "at_rest", [](const Self& r) { return r.response.state.mode == RockingMode::rest; },
          "Whether the block rests on its base at the end (bool).")
      .def_property_readonly("state", number<&RockingResponse::state>(),
                             "The `RockingState` at the end; `advance` can continue from it.")
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
      .def("__repr__", [](const Self& r) {
        const std::string remark = remark_of(r);
        const auto side = side_name(r.response.overturned);
        return "<RockingResponse: " +
               (side ? "overturned to the " + *side + ", certain at " + digits(r.response.overturned_at) + " s"
                     : "peak " + digits(r.response.peak) + " rad (" + digits(r.response.peak_ratio) + " alpha)") +
               ", " + std::to_string(r.response.impacts) + " impacts" +
               (is_rigid(r) ? ", base displaced by " + digits(r.response.residual) + " m" : "") +
               (r.response.truncated ? ", samples end before rest" : "") + (remark.empty() ? "" : "; " + remark) + ">";
      });
  define_response<Self>(
      m, "RockingResponse", times_over<Self>(&RockingResponse::rotation), &at_times,
      {.system = "block",
       .object = "block",
       .states = R"(RockingState or ndarray
    At one time a `RockingState`. At several a structured array of shape (T,) with the fields time [s], rotation [rad],
    rate [rad/s], at_rest and in_flight. At an impact, the state after it.)",
       .at_notes = " Round-off grows as `condition` says.",
       .columns = R"(The columns are `ground_acceleration` [m/s^2], `vertical_ground_acceleration` [m/s^2] if it
    acted, `rotation` [rad], `rate` [rad/s], and of a `RockingBlock` `displacement` and `top_displacement` [m].)",
       .attributes = "`peak_rotation` and\n    `overturned`, empty if the block stands",
       .results = R"(`peak_rotation` [rad], `peak_time` [s], `peak_rotation_ratio`, `overturned`,
    `overturned_at` [s], `impacts`, `uplifts`, `time_rocking` [s], `at_rest`, `margin`, `condition` and `remark`, and
    of a `RockingBlock` `residual` [m], `sliding_distance` [m], `time_sliding` [s], `liftoffs`, `impacts_with_slip`)"});

  m.def(
      "integrate", &integrate_block<SlenderBlock>, py::arg("slider"), py::arg("motion"), py::kw_only(),
      py::arg("rotation") = 0.0, py::arg("rate") = 0.0, py::arg("settle") = false,
      R"(With a `SlenderBlock`, a block that rocks, from `rotation` [rad], below pi/2 in magnitude, and `rate` [rad/s]. The
horizontal component along the axis acts, and a vertical one, under which g + a_z must stay positive. With `settle`, until the
block rests or falls. Returns a `RockingResponse`.

Closed form between impacts, exact to round-off, which grows as e^(p t) between rests (see `RockingResponse.condition`); 3 ns
per sample at rest, 40 ns rocking, 0.7 us an impact. ValueError also for g + a_z <= 0; ConvergenceError with
`settle` and a restitution of 1.)");
  m.def(
      "integrate", &integrate_block<RockingBlock>, py::arg("slider"), py::arg("motion"), py::kw_only(),
      py::arg("rotation") = 0.0, py::arg("rate") = 0.0, py::arg("settle") = false,
      R"(With a `RockingBlock`, a block that rocks, slides and flies, as with a `SlenderBlock`; g + a_z may be negative. Returns a
`RockingResponse`.

Taylor series between events, exact to round-off, which grows as e^(p t) between rests; 0.5 us per sample rocking, 2 us
slipping. ConvergenceError where its friction decides nothing, see `RockingBlock`, and with `settle` if it never rests.)");
  m.def(
      "histories", &histories_block<SlenderBlock>, py::arg("slider"), py::arg("motion"),
      R"(With a `SlenderBlock`, the rotation [rad] and its rate [rad/s] of a block that rocks, from rest. The same bits as
`integrate`, and its time.)");
  m.def("histories", &histories_block<RockingBlock>, py::arg("slider"), py::arg("motion"),
        "With a `RockingBlock`, the same of a block that also slides and flies.");
}

}  // namespace stickslip::python
