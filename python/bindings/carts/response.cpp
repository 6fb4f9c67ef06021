#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string_view>

#include "any_response.hpp"
#include "carts/carts.hpp"
#include "in_python.hpp"
#include "planar/response.hpp"
#include "sliding/response.hpp"
#include "sliding/units_remark.hpp"
#include "statistics/estimate.hpp"
#include "structured.hpp"

namespace stickslip::python {
namespace {

using Self = CartResponseWithInputs;

const CartAsGiven& its_cart(const Self& self) { return self.cart.cast<const CartAsGiven&>(); }
const GroundMotion& motion_of(const Self& self) { return self.motion.cast<const GroundMotion&>(); }

const CartForces& forces_of(Self& self) {
  if (!self.forces) {
    const Cart& cart = its_cart(self).cart();
    const GroundMotion& motion = motion_of(self);
    CartForces found = [&] {
      const py::gil_scoped_release released;
      return forces(cart, motion, self.response);
    }();
    self.forces = std::move(found);
  }
  return *self.forces;
}

std::u32string_view name_of(CartEventKind kind) {
  switch (kind) {
    case CartEventKind::breakaway:
      return U"breakaway";
    case CartEventKind::rest:
      return U"rest";
    case CartEventKind::slip:
      return U"slip";
    case CartEventKind::stick:
      return U"stick";
    case CartEventKind::reversal:
      return U"reversal";
    case CartEventKind::end:
      return U"end";
  }
  return U"";
}

py::array events_array(const std::vector<CartEvent>& events) {
  struct Row {
    double time;
    Vector2 displacement;
    double yaw;
    TextField<10> kind;
    std::int64_t support;
    TextField<6> line;
  };
  const auto row = [&](std::size_t i) -> Row {
    const CartEvent& e = events[i];
    const bool of_line = e.support != CartEvent::no_support;
    return {e.time,
            e.displacement,
            e.yaw,
            name_of(e.kind),
            of_line ? static_cast<std::int64_t>(e.support) : -1,
            !of_line  ? U""
            : e.along ? U"along"
                      : U"across"};
  };
  return structured(events.size(), row, std::pair("time", &Row::time), std::pair("displacement", &Row::displacement),
                    std::pair("yaw", &Row::yaw), std::pair("kind", &Row::kind), std::pair("support", &Row::support),
                    std::pair("line", &Row::line));
}

py::array work_array(const std::vector<SupportWork>& work) {
  py::array rows = structured(
      work.size(), [&](std::size_t i) { return work[i]; }, std::pair("scrub", &SupportWork::scrub),
      std::pair("roll", &SupportWork::roll), std::pair("slide", &SupportWork::slide));
  rows.attr("setflags")(py::arg("write") = false);
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

/// Of shape (casters, samples), over the memory of the response.
py::array_t<double> heading_of(const py::object& self) {
  const CartResponse& r = self.cast<const Self&>().response;
  const auto samples = static_cast<py::ssize_t>(r.displacement.size());
  const py::ssize_t casters = static_cast<py::ssize_t>(r.headings.size()) / samples, wide = sizeof(double);
  py::array_t<double> array({casters, samples}, {wide, casters * wide}, r.headings.data(), self);
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

std::string remark_of(const Self& self) {
  const GroundMotion& motion = motion_of(self);
  const double peak = motion.peak_acceleration();
  if (self.response.time_moving > 0 || !(peak > 0 && peak <= most_g)) return "";
  const Cart& cart = its_cart(self).cart();
  const double c = std::cos(self.yaw), s = std::sin(self.yaw);
  for (std::size_t i = 0; i < motion.samples(); ++i) {
    const Vector2 ground{motion.acceleration()[i], motion.transverse()[i]};
    const double size = norm(ground);
    if (!(size > 0)) continue;
    const Vector2 load{c * ground.axis + s * ground.transverse, c * ground.transverse - s * ground.axis};
    if (size * standard_gravity > cart.holds(load))
      return "the cart never moves: the peak ground acceleration is " + digits(peak) + " m/s^2 (" +
             digits(peak / standard_gravity) + " g); if the accelerations are in g, give units=\"g\": at " +
             digits(peak) + " g it does";
  }
  return "";
}

CartResponse integrated(const Self& how, const std::vector<Wall>& walls) {
  const Cart& cart = its_cart(how).cart();
  const GroundMotion& ground = motion_of(how);
  const py::gil_scoped_release released;
  return integrate(cart, ground, {how.yaw, how.velocity, how.yaw_rate, how.settle, walls, check_for_interrupt});
}

Self integrate_cart(const CartAsGiven& cart, const py::object& motion, double yaw, const py::object& velocity,
                    double yaw_rate, bool settle, const py::object& walls) {
  both_components(motion, "integrate", "Cart");
  Self self{{},       py::cast(cart),
            motion,   yaw,
            yaw_rate, to_vector2(velocity, "integrate: velocity", "m/s"),
            settle,   walls_of(walls, "integrate: walls")};
  self.response = integrated(self, self.walls);
  return self;
}

// Places and rates of shape (samples, 3): along the axis, transverse, and the yaw.
py::tuple histories_cart(const CartAsGiven& cart, const py::object& motion) {
  const Self self = integrate_cart(cart, motion, 0, py::make_tuple(0.0, 0.0), 0, false, py::tuple());
  const CartResponse& r = self.response;
  const auto rows = [](const std::vector<Vector2>& moves, const std::vector<double>& turns) {
    std::vector<double> values;
    values.reserve(3 * moves.size());
    for (std::size_t i = 0; i < moves.size(); ++i)
      values.insert(values.end(), {moves[i].axis, moves[i].transverse, turns[i]});
    return array_of(std::move(values)).attr("reshape")(moves.size(), 3);
  };
  return py::make_tuple(rows(r.displacement, r.yaw), rows(r.velocity, r.yaw_rate));
}

py::object at_times(const Self& self, const py::object& times) {
  struct Row {
    double time;
    Vector2 displacement, velocity;
    double yaw, yaw_rate;
    bool at_rest;
  };
  return at(
      "CartResponse", times,
      [&](const std::vector<double>& t) {
        const Cart& cart = its_cart(self).cart();
        const GroundMotion& motion = motion_of(self);
        const py::gil_scoped_release released;
        return states_at(cart, motion, self.response, t);
      },
      [](double t, const CartState& s) {
        return Row{t, s.displacement, s.velocity, s.yaw, s.yaw_rate, s.mode == CartMode::rest};
      },
      std::pair("time", &Row::time), std::pair("displacement", &Row::displacement),
      std::pair("velocity", &Row::velocity), std::pair("yaw", &Row::yaw), std::pair("yaw_rate", &Row::yaw_rate),
      std::pair("at_rest", &Row::at_rest));
}

std::optional<double> unless_nan(double value) { return std::isnan(value) ? std::nullopt : std::optional(value); }

}  // namespace

Wall wall_of(const py::object& given, const std::string& name) {
  if (!py::isinstance<py::sequence>(given) || py::len(given) != 2)
    throw std::invalid_argument(name +
                                " must be two vectors, a point on it and its direction, such as ((1.5, 0), (0, 1))");
  const py::sequence pair = given;
  return {to_vector2(pair[0], name + "[0]", "m"), to_vector2(pair[1], name + "[1]")};
}

std::vector<Wall> walls_of(const py::object& given, const std::string& name) {
  std::vector<Wall> walls;
  for (const py::handle one : given)
    walls.push_back(wall_of(py::reinterpret_borrow<py::object>(one), name + "[" + std::to_string(walls.size()) + "]"));
  return walls;
}

void bind_cart_response(py::module_& m) {
  value_class<CartEnergy>(m, "CartEnergy", R"(Energy balance of a cart, per unit mass [m^2/s^2].

initial + input = dissipated + kinetic, to round-off.)")
      .def_readonly("initial", &CartEnergy::initial, "Kinetic energy at the start.")
      .def_readonly("input", &CartEnergy::input, "Work of the ground, the integral of -(a_x x' + a_y y') dt.")
      .def_readonly("dissipated", &CartEnergy::dissipated, "Work against friction.")
      .def_readonly("kinetic", &CartEnergy::kinetic, "Kinetic energy at the end.")
      .def_property_readonly(
          "by_support", [](const CartEnergy& e) { return work_array(e.by_support); },
          R"(The work against friction at each support: a structured array of shape (supports,).

Fields: scrub, across a wheel; roll, along it; slide, of a foot.)")
      .def_property_readonly(
          "imbalance", [](const CartEnergy& e) { return e.imbalance(); }, "Residual of the energy balance (round-off).")
      .def("__repr__", [](const CartEnergy& e) {
        return "<CartEnergy [m^2/s^2]: initial " + digits(e.initial) + ", input " + digits(e.input) + ", dissipated " +
               digits(e.dissipated) + ", kinetic " + digits(e.kinetic) + ">";
      });

  value_class<Clearance>(m, "Clearance", "How near the outline of a cart came to a wall.")
      .def_readonly("least", &Clearance::least,
                    "Least distance of a corner to the wall [m]; negative: it would have hit.")
      .def_readonly("time", &Clearance::time, "Time of the least distance [s].")
      .def_property_readonly(
          "hit_time", [](const Clearance& c) { return unless_nan(c.hit_time); },
          "Time of the first contact [s]; None without one.")
      .def_property_readonly(
          "hit_speed", [](const Clearance& c) { return unless_nan(c.hit_speed); },
          "Speed of the corner toward the wall at the first contact [m/s]; None without one.")
      .def("__repr__", [](const Clearance& c) {
        return "<Clearance: least " + digits(c.least) + " m at " + digits(c.time) + " s" +
               (std::isnan(c.hit_time) ? std::string()
                                       : ", hit at " + digits(c.hit_time) + " s with " + digits(c.hit_speed) + " m/s") +
               ">";
      });

  value_class<Self>(m, "CartResponse",
                    R"(The response of a cart, as `integrate` returns it for a `Cart`.

Displacements are relative to the ground, along its axis and along its transverse direction. The arrays are read-only.)")
      .def_property_readonly(
          "cart", [](const Self& r) { return r.cart; }, "The `Cart`.")
      .def_property_readonly("displacement", history<&CartResponse::displacement>(),
                             "Displacement of the center of mass at `time` [m], shape (N, 2).")
      .def_property_readonly("velocity", history<&CartResponse::velocity>(),
                             "Velocity of the center of mass at `time` [m/s], shape (N, 2).")
      .def_property_readonly("yaw", history<&CartResponse::yaw>(),
                             "phi at `time` [rad], shape (N,), positive from the axis toward the transverse direction.")
      .def_property_readonly("yaw_rate", history<&CartResponse::yaw_rate>(), "phi' at `time` [rad/s], shape (N,).")
      .def_property_readonly(
          "acceleration", [](const py::object& self) { return view(forces_of(self.cast<Self&>()).acceleration, self); },
          R"(Absolute acceleration of the center of mass at `time` [m/s^2], shape (N, 2).

The force of all supports per unit mass, r'' + n; that of the ground while the cart rests. At a sample where it jumps the
value just after it; at the end of the ground motion and of the response that before. As exact as `integrate`; while a
foot begins to slide, to 1e-3. On first access the motion is integrated once more.)")
      .def_property_readonly(
          "peak_force", [](Self& r) { return forces_of(r).peak; },
          R"(Largest magnitude of the force of all supports per unit mass [m/s^2].

The largest absolute acceleration of the center of mass over all time, not only at samples; as exact as `acceleration`.)")
      .def_property_readonly(
          "peak_force_time", [](Self& r) { return forces_of(r).peak_time; },
          "Time of `peak_force` [s], to 1e-6 of a slip; one of them, where it is constant.")
      .def_property_readonly("heading", &heading_of,
                             "Headings of the casters relative to the cart at `time` [rad], shape (casters, N).")
      .def_property_readonly(
          "events", [](Self& r) { return keep(r.events, [&] { return events_array(r.response.events); }); },
          R"(Events sorted by time: a structured array.

Fields: time [s], displacement of the center of mass [m], of shape (2,), yaw [rad], kind ('breakaway', 'rest', 'slip', 'stick',
'reversal' or 'end'), and of the last three but 'end' the number of the support, from 0, and the line, 'across' a wheel or
'along' it; else -1 and ''. A line across a wheel that sticks rolls straight, one that slips scrubs.)")
      .def_property_readonly("peak", number<&CartResponse::peak>(),
                             "Largest displacement of the center of mass over all time, not only at samples [m].")
      .def_property_readonly("peak_time", number<&CartResponse::peak_time>(), "Time of `peak` [s].")
      .def_property_readonly("peak_yaw", number<&CartResponse::peak_yaw>(),
                             "Largest change of the yaw since the start, in magnitude [rad].")
      .def_property_readonly("peak_outline", number<&CartResponse::peak_outline>(),
                             "Largest displacement of a corner of the outline [m].")
      .def_property_readonly("peak_outline_time", number<&CartResponse::peak_outline_time>(),
                             "Time of `peak_outline` [s].")
      .def_property_readonly("peak_corner", number<&CartResponse::peak_corner>(),
                             "The corner that moved farthest, its place in `Cart.outline`.")
      .def_property_readonly(
          "reach_outline",
          [](const Self& r) {
            const Reach& reach = r.response.reach;
            return std::tuple(reach.low.axis, reach.low.transverse, reach.high.axis, reach.high.transverse);
          },
          R"(The rectangle that the outline sweeps, relative to the center of mass at the start [m].

Smallest and largest place along the axis and along the transverse direction: (xmin, ymin, xmax, ymax).)")
      .def_property_readonly(
          "residual", [](const Self& r) { return array_of(r.response.residual); },
          "Displacement of the center of mass at the end [m], shape (2,); final if the cart rests.")
      .def_property_readonly("residual_yaw", number<&CartResponse::residual_yaw>(),
                             "Change of the yaw at the end [rad].")
      .def_property_readonly("time_moving", number<&CartResponse::time_moving>(), "Time spent moving [s].")
      .def_property_readonly("rests", number<&CartResponse::rests>(), "Number of rests, that at the start included.")
      .def_property_readonly("margin", number<&CartResponse::margin>(),
                             R"(Distance of the nearest decision; infinite without one.

The smallest distance of a decision between stick and slip from the other one, over the accelerations that take part. If
it is tiny, the history hangs on round-off. Histories are sensitive anyhow while casters swivel against their motion: answer
in distributions over the headings, see `Cart.with_random_headings`.)")
      .def_property_readonly("clearances", number<&CartResponse::clearances>(),
                             "The `Clearance` of each of the walls that `integrate` was given.")
      .def_property_readonly(
          "condition",
          [](const Self& r) {
            const Cart& cart = its_cart(r).cart();
            const GroundMotion& ground = motion_of(r);
            const py::gil_scoped_release released;
            return condition(cart, ground, {r.yaw, r.velocity, r.yaw_rate, r.settle, {}, check_for_interrupt});
          },
          "How far an error grows: the largest change of `displacement` at a sample, or of the yaw times the radius\n"
          "of gyration, per change of the headings of all casters at the start (without casters, of the yaw) [m/rad].\n"
          "Computed when it is asked for, from two motions whose headings differ by 1e-9 rad.")
      .def(
          "clearance",
          [](const Self& r, const py::object& wall) {
            return integrated(r, {wall_of(wall, "CartResponse.clearance: wall")}).clearances.front();
          },
          py::arg("wall"),
          R"(How near the outline came to a straight wall, which the motion does not feel. Integrates again.

Parameters
----------
wall : ((float, float), (float, float))
    A point on it, relative to the center of mass at the start [m], and its direction, not zero.

Returns
-------
Clearance

Raises
------
ValueError
    A value that is not finite, or a direction that is zero.)")
      .def_property_readonly("energy", number<&CartResponse::energy>(), "The `CartEnergy`.")
      .def_property_readonly("remark", &remark_of,
                             R"(A sentence about limits of the result; empty if there are none (str).

A cart that never moves, but would if the ground accelerations were in g.)")
      .def_property_readonly(
          "at_rest", [](const Self& r) { return r.response.state.mode == CartMode::rest; },
          "Whether the cart is at rest at the end (bool).")
      .def_property_readonly("state", number<&CartResponse::state>(),
                             "The `CartState` at the end; `advance` can continue from it.")
      .def_property_readonly("components", number<&CartResponse::components>(),
                             "Components of the ground motion that acted, such as 'axis + transverse' (str).")
      .def(
          "plot",
          [](const py::object& self, const py::object& figure, const py::object& title) {
            return py::module_::import("stickslip.plotting").attr("plot_cart_response")(self, figure, title);
          },
          py::kw_only(), py::arg("figure") = py::none(), py::arg("title") = py::none(),
          R"(Plot the path from above with the outline and the wheels at start, peak and end; and displacements over time.

Needs matplotlib (`pip install stickslip[plot]`). Takes `figure`, a matplotlib Figure or SubFigure to draw in, and `title`.
Returns the figure, see `stickslip.plotting.plot_cart_response`.)")
      .def("animate", animation(), py::kw_only(), py::arg("time") = py::none(), py::arg("speed") = 1.0,
           py::arg("fps") = 15.0, py::arg("title") = py::none(), py::arg("size") = py::none(),
           R"(Show the cart from above as it moves and turns on the ground.

Needs matplotlib. Takes `time`, the begin and end of the part to show [s], `speed`, seconds of the motion in a second of
the animation, `fps`, frames in a second, `title`, and `size`, width and height [inches]. Returns an animation: a notebook
shows it, its `write` saves it as .gif, .mp4 or .html; see `stickslip.plotting.animate`.)")
      .def("__repr__", [](const Self& self) {
        const CartResponse& r = self.response;
        const std::string remark = remark_of(self);
        return "<CartResponse: peak " + digits(r.peak) + " m, of the outline " + digits(r.peak_outline) + " m, yaw " +
               digits(r.peak_yaw) + " rad, residual " + digits(r.residual) + " m, " + std::to_string(r.events.size()) +
               " events" + (r.truncated ? ", samples end before rest" : "") + (remark.empty() ? "" : "; " + remark) +
               ">";
      });
  define_response<Self>(
      m, "CartResponse", times_over<Self>(&CartResponse::displacement), &at_times,
      {.system = "cart",
       .object = "cart",
       .states = R"(CartState or ndarray
    At one time a `CartState`, which has the headings, too. At several a structured array of shape (T,) with the fields
    time [s], displacement [m] and velocity [m/s] of the center of mass, both of shape (T, 2), yaw [rad], yaw_rate [rad/s]
    and at_rest.)",
       .at_notes = " Round-off grows as `condition` says.",
       .columns = R"(The columns are `ground_acceleration_axis` and `ground_acceleration_transverse` [m/s^2],
    `vertical_ground_acceleration` [m/s^2] if it acted, `displacement_axis` and `displacement_transverse` [m],
    `velocity_axis` and `velocity_transverse` [m/s], `acceleration_axis` and `acceleration_transverse` [m/s^2], `yaw`
    [rad], `yaw_rate` [rad/s], and for each caster that swivels `heading_0` [rad] and so on, by the number of the
    support.)",
       .attributes = "`peak` and `peak_outline`",
       .results = R"(`peak` [m], `peak_time` [s], `peak_yaw` [rad], `peak_outline` [m], `peak_outline_time` [s],
    `peak_corner`, `reach_outline` [m], `residual` [m], `residual_yaw` [rad], `time_moving` [s], `rests`, `at_rest`,
    `margin` and `remark`)"});

  m.def(
      "integrate", &integrate_cart, py::arg("slider"), py::arg("motion"), py::kw_only(), py::arg("yaw") = 0.0,
      py::arg("velocity") = py::make_tuple(0.0, 0.0), py::arg("yaw_rate") = 0.0, py::arg("settle") = false,
      py::arg("walls") = py::tuple(),
      R"(With a `Cart`, which moves in the plane and turns, from `yaw` [rad], `velocity` of its center of mass [m/s], of
shape (2,), and `yaw_rate` [rad/s]. Both horizontal components of the ground motion act, and a vertical one. `walls` are pairs
of a point, relative to the center of mass at the start [m], and a direction, whose clearance is asked. Returns a
`CartResponse`.

Exact to round-off, which grows while casters swivel against their motion; some 30 us per event. ValueError also for a motion
without a transverse component, and with `settle` for a cart without rolling resistance, which may roll without end.)");
  m.def(
      "histories", &histories_cart, py::arg("slider"), py::arg("motion"),
      R"(With a `Cart`, the motion of a cart from rest: of shape (samples, 3), the displacement of its center of mass along
the axis and the transverse direction [m] and the yaw [rad]; and their rates. The same bits as `integrate`, and its time.)");
}

}  // namespace stickslip::python
