#include "structure/response.hpp"

#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "any_response.hpp"
#include "in_python.hpp"
#include "sliding/response.hpp"
#include "sliding/units_remark.hpp"
#include "stickslip/structure/equipment_on_floor.hpp"
#include "stickslip/structure/flexible_slope.hpp"
#include "stickslip/structure/isolated_structure.hpp"
#include "structure/from_inputs.hpp"
#include "structure/structure.hpp"
#include "structured.hpp"

namespace stickslip::python {
namespace {

using Self = StructureResponseWithInputs;

StructureResponse integrate_with(const py::object& system, const py::object& motion,
                                 const StructureIntegrateOptions& options) {
  const auto& ground = motion.cast<const GroundMotion&>();
  const auto run = [&](const auto& what) {
    return naming_cause(system, detail::shortest(options.velocity), [&] {
      const py::gil_scoped_release released;
      return integrate(what, ground, options);
    });
  };
  if (py::isinstance<FlexibleSlope>(system)) return run(system.cast<const FlexibleSlope&>());
  if (py::isinstance<EquipmentOnFloor>(system)) return run(system.cast<const EquipmentOnFloor&>());
  return run(system.cast<const IsolatedStructure&>());
}

/// What slides.
AnySlider interface_of(const py::object& system) {
  if (py::isinstance<FlexibleSlope>(system)) {
    const auto& slope = system.cast<const FlexibleSlope&>();
    if (slope.degrading) return Slider(*slope.degrading, Mounting{.one_way = true});
    return Slider(Coulomb(slope.ky_g * standard_gravity, never));
  }
  if (py::isinstance<EquipmentOnFloor>(system)) return system.cast<const EquipmentOnFloor&>().slider();
  return system.cast<const IsolatedStructure&>().slider();
}

/// Whether the interface would begin to slide at a sample if the ground accelerations, and with them the demand on it,
/// were in g.
bool slips_in_g(const Self& self, const AnySlider& slider, const GroundMotion& motion) {
  const Mounting& on = mounting_of(slider);
  const detail::Bounds bounds{on.stops, on.one_way};
  const double x = self.response.displacement.front(), pull = on.spring().under(1) * x;
  const auto& demand = self.response.interface_demand;
  return std::visit(
      [&](const auto& one) {
        for (std::size_t i = 0; i < std::min(demand.size(), motion.samples()); ++i) {
          const double up = motion.has_vertical() ? motion.vertical()[i] : 0, weight = std::max(1 + up, 0.0);
          const double q = (demand[i] + pull) * standard_gravity - pull;
          const Direction direction = q < 0 ? Direction::backward : Direction::forward;
          const double level =
              bounds.bound(direction, x, hold(law_at(one.law(), State::at(x, 0), weight), x, direction));
          if (std::abs(q) > detail::weigh(weight, level)) return true;
        }
        return false;
      },
      slider);
}

std::string remark_of(const Self& self) {
  const AnySlider slider = interface_of(self.system);
  const auto& motion = self.motion.cast<const GroundMotion&>();
  const double ground = motion.peak_acceleration();
  std::string all;
  const auto add = [&](const std::string& one) { all += (all.empty() || one.empty() ? "" : "; ") + one; };
  if (self.response.time_sliding > 0)
    add(linear_remark(slider, self.response.peak));
  else if (ground > 0 && ground <= most_g && slips_in_g(self, slider, motion))
    add(in_g_remark(ground));
  // The effective strain is 0.65 of the largest (Kaklamanos and others, Bull. Seism. Soc. Am. 103 (2013), 2609-2630).
  constexpr double most_strain = 0.004;
  if (const double strain = self.response.soil_strain / 0.65; strain > most_strain)
    add("the soil is sheared by " + digits(100 * strain) +
        " %, beyond the 0.4 % up to which equivalent-linear soil resembles nonlinear soil");
  if (py::isinstance<EquipmentOnFloor>(self.system) && motion.has_transverse())
    add("the transverse component does not act; floor_motions has both for a PlanarSlider");
  return all;
}

/// The floors of a response.
struct FloorsOfResponse {
  py::object response;
  const Floors& floors() const { return response.cast<const Self&>().response.floors; }
};

template <auto member>
auto of_floors() {
  return [](const py::object& self) { return view(self.cast<const FloorsOfResponse&>().floors().*member, self); };
}
// Of the stories: only if one floor is above another.
template <auto member>
auto drifts() {
  return [](const py::object& self) {
    const Floors& floors = self.cast<const FloorsOfResponse&>().floors();
    if (floors.drift.cols() == 0)
      throw std::invalid_argument(
          "Floors: drifts need an influence of ones, by which one floor is above another; `displacement` does not");
    return view(floors.*member, self);
  };
}
// Shears also need the masses of the floors.
template <auto member>
auto shears() {
  return [](const py::object& self) {
    const Floors& floors = self.cast<const FloorsOfResponse&>().floors();
    if (floors.shear.cols() == 0)
      throw std::invalid_argument(
          "Floors: the shear of each story needs the masses of the floors and an influence of ones; `peak_base_shear` "
          "of the response needs neither");
    return view(floors.*member, self);
  };
}

// Calls `use(system, motion)` without the interpreter lock.
template <class Use>
auto with_system(const Self& self, Use&& use) {
  const auto& motion = self.motion.cast<const GroundMotion&>();
  if (py::isinstance<FlexibleSlope>(self.system)) {
    const auto& slope = self.system.cast<const FlexibleSlope&>();
    const py::gil_scoped_release released;
    return use(sliding_structure(slope, properties(slope, motion)), motion);
  }
  const auto& system = py::isinstance<EquipmentOnFloor>(self.system)
                           ? static_cast<const SlidingStructure&>(self.system.cast<const EquipmentOnFloor&>())
                           : self.system.cast<const IsolatedStructure&>();
  const py::gil_scoped_release released;
  return use(system, motion);
}

Loop loop_of(const Self& self) {
  return with_system(self, [&](const SlidingStructure& system, const GroundMotion& motion) {
    return largest_loop(system, motion, self.response);
  });
}

const InterfacePoint& peak_force_of(Self& self) {
  if (!self.peak_force)
    self.peak_force = with_system(self, [&](const SlidingStructure& system, const GroundMotion& motion) {
      return peak_force(system, motion, self.response);
    });
  return *self.peak_force;
}

// At a time a StructureState, at several a structured array.
py::object at_times(const Self& self, const py::object& times) {
  const std::vector<double> t = to_vector_or_number(times, "StructureResponse.at: times", "s");
  RealMatrix shapes;
  const std::vector<StructureState> found =
      with_system(self, [&](const SlidingStructure& system, const GroundMotion& motion) {
        shapes = system.structure().modes().shapes;
        return states_at(system, motion, self.response, t);
      });
  if (py::array::ensure(times).ndim() == 0) return py::cast(found.front());
  const auto size = static_cast<py::ssize_t>(t.size()), floors = static_cast<py::ssize_t>(shapes.rows());
  py::array_t<double> x(size), v(size), y({size, floors});
  py::array_t<bool> stuck(size);
  for (py::ssize_t i = 0; i < size; ++i) {
    const StructureState& state = found[static_cast<std::size_t>(i)];
    x.mutable_at(i) = state.displacement;
    v.mutable_at(i) = state.velocity;
    stuck.mutable_at(i) = state.mode == Mode::stuck;
    for (py::ssize_t floor = 0; floor < floors; ++floor) {
      double sum = 0;
      for (std::ptrdiff_t k = 0; k < shapes.cols(); ++k)
        sum += shapes(floor, k) * state.modal_displacement[static_cast<std::size_t>(k)];
      y.mutable_at(i, floor) = sum;
    }
  }
  py::list fields;
  for (const char* name : {"time", "displacement", "velocity"}) fields.append(py::make_tuple(name, "f8"));
  fields.append(py::make_tuple("stuck", "?"));
  if (floors > 0) fields.append(py::make_tuple("floor_displacement", "f8", py::make_tuple(floors)));
  py::array rows(py::dtype::from_args(fields), size);
  const auto set = [&](const char* name, const py::object& values) { rows[py::str(name)] = values; };
  set("time", to_array(t));
  set("displacement", x);
  set("velocity", v);
  set("stuck", stuck);
  if (floors > 0) set("floor_displacement", y);
  return rows;
}

template <auto member>
auto number() {
  return [](const Self& self) { return self.response.*member; };
}
template <auto member>
auto history() {
  return [](const py::object& self) { return view(self.cast<const Self&>().response.*member, self); };
}

}  // namespace

Self integrate_structure(const py::object& system, const py::object& motion, double displacement, double velocity,
                         bool settle, double sliding_distance, const std::optional<SurfaceHeat>& heat) {
  if (!py::isinstance<GroundMotion>(motion))
    throw py::type_error("integrate: the motion of a structure must be a GroundMotion, got " +
                         py::type::of(motion).attr("__name__").cast<std::string>() +
                         (py::isinstance<HarmonicMotion>(motion) ? "; give motion.sampled(dt)" : ""));
  const StructureIntegrateOptions options{.displacement = displacement,
                                          .velocity = velocity,
                                          .settle = settle,
                                          .progress = check_for_interrupt,
                                          .sliding_distance = sliding_distance,
                                          .heat = heat.value_or(SurfaceHeat())};
  return {integrate_with(system, motion, options), system, motion, options};
}

void bind_structure_response(py::module_& m) {
  made_from_inputs<FloorsOfResponse>(
      m, "Floors",
      R"(The motion of the floors of a structure; see `StructureResponse.floors`.

Columns are the floors, the lowest first. Peaks are taken over all time, not only at samples. The arrays are
read-only.)",
      [](const FloorsOfResponse& f) { return py::make_tuple(f.response); },
      [](const py::tuple& inputs) { return FloorsOfResponse{inputs[0].cast<py::object>()}; })
      .def_property_readonly("displacement", of_floors<&Floors::displacement>(),
                             "Relative to the base, or to the ground below an `EquipmentOnFloor`, at `time` [m], shape "
                             "(N, floors).")
      .def_property_readonly("acceleration", of_floors<&Floors::acceleration>(),
                             "Absolute, at `time` [m/s^2], shape (N, floors).")
      .def_property_readonly("drift", drifts<&Floors::drift>(),
                             R"(Displacement relative to the floor below, at `time` [m], shape (N, floors).

ValueError if `influence` is not ones: then the degrees of freedom are not floors above each other.)")
      .def_property_readonly("shear", shears<&Floors::shear>(),
                             R"(Shear of the stories at `time` [N], shape (N, floors).

The sum of the inertia forces of a floor and of those above it, with that of equipment that has a mass. ValueError
without the masses of the floors, or if `influence` is not ones.)")
      .def_property_readonly("peak_acceleration", of_floors<&Floors::peak_acceleration>(),
                             "Largest absolute acceleration [m/s^2], shape (floors,).")
      .def_property_readonly("peak_drift", drifts<&Floors::peak_drift>(),
                             "Largest drift [m], shape (floors,); see `drift`.")
      .def_property_readonly("peak_shear", shears<&Floors::peak_shear>(),
                             "Largest shear of the stories [N], shape (floors,); see `shear`.")
      .def("__repr__", [](const FloorsOfResponse& f) {
        return "<Floors: " + std::to_string(f.floors().displacement.cols()) + " floors, largest acceleration " +
               digits(std::ranges::max(f.floors().peak_acceleration)) + " m/s^2>";
      });

  made_from_inputs<Self>(
      m, "StructureResponse",
      R"(The response of a structure with one sliding interface, as `integrate` returns it.

Displacement and velocity are those of the interface: of the base relative to the ground, or of the equipment relative to
its floor. Energies are those of the whole system per unit of the reference mass: base and structure, or the equipment.
Two responses are equal if they have equal inputs; a pickled one is integrated again. The arrays are read-only.)",
      [](const Self& r) { return r.inputs(); },
      [](const py::tuple& inputs) {
        return integrate_structure(inputs[0], inputs[1], inputs[2].cast<double>(), inputs[3].cast<double>(),
                                   inputs[4].cast<bool>(), inputs[5].cast<double>(),
                                   inputs[6].cast<std::optional<SurfaceHeat>>());
      })
      .def_property_readonly(
          "system", [](const Self& r) { return r.system; }, "What was integrated, such as an `IsolatedStructure`.")
      .def_property_readonly("displacement", history<&StructureResponse::displacement>(),
                             "x at `time` [m], shape (N,).")
      .def_property_readonly("velocity", history<&StructureResponse::velocity>(), "x' at `time` [m/s], shape (N,).")
      .def_property_readonly(
          "base_acceleration", history<&StructureResponse::base_acceleration>(),
          "Absolute acceleration of what the structure stands on, at `time` [m/s^2], shape (N,). It jumps at arrests.")
      .def_property_readonly(
          "demand", history<&StructureResponse::interface_demand>(),
          "Force q that the bond would have to carry, per unit of the reference mass, at `time` [m/s^2], shape (N,).")
      .def_property_readonly(
          "force", history<&StructureResponse::interface_force>(),
          R"(Force of friction, spring and damper between both sides of the interface, at `time` [m/s^2], shape (N,).

Per unit of the reference mass; positive where it pulls toward negative x. While the interface sticks, friction is what
balances the other forces.)")
      .def_property_readonly(
          "peak_force", [](Self& r) { return std::abs(peak_force_of(r).force); }, peak_force_doc)
      .def_property_readonly(
          "peak_force_time", [](Self& r) { return peak_force_of(r).time; }, peak_force_time_doc)
      .def_property_readonly(
          "effective_period", [](const Self& r) { return loop_of(r).period(); },
          R"(2 pi / sqrt(k_eff) of the hysteresis loop of the interface with the largest displacement [s].

As `Response.effective_period`: k_eff = F / D, where D is `peak` and F the force of spring and friction of the interface
there, just before it reverses or stops, per unit of the reference mass. For an isolated building, the period of the
building, if it were rigid, on isolators of the secant stiffness. The motion is integrated again. ValueError without a
spring, as for a `FlexibleSlope`; if the interface never slips; if |x| is largest at the start or at the end of an
unfinished slip.)")
      .def_property_readonly(
          "effective_damping", [](const Self& r) { return loop_of(r).damping(); },
          R"(E_d / (2 pi k_eff D^2) of the same loop, a fraction of critical damping.

As `Response.effective_damping`: E_d is 4 D times the energy per meter that friction and damper of the interface
dissipated in the swing up to the peak; what the structure dissipates is not in it. ValueError as for
`effective_period`.)")
      .def_property_readonly(
          "floors",
          [](const py::object& self) {
            if (self.cast<const Self&>().response.floors.displacement.cols() == 0)
              throw std::invalid_argument(
                  "StructureResponse.floors: the structure has no floors; give Structure.from_modes the shapes");
            return FloorsOfResponse{self};
          },
          "The motion of the floors, a `Floors`. ValueError if the structure is known by modes without shapes.")
      .def_property_readonly(
          "events", [](Self& r) { return keep(r.events, [&] { return events_array(r.response.events); }); },
          R"(Events of the interface, sorted by time: a structured array like `Response.events`.)")
      .def_property_readonly(
          "impacts", [](const Self& r) { return events_array(events_of_kind(r.response.events, EventKind::impact)); },
          "Impacts on stops, sorted by time: a structured array like `events`, with the velocity before the impact.")
      .def_property_readonly(
          "temperature",
          [](const py::object& self) -> py::object {
            const auto& temperature = self.cast<const Self&>().response.temperature;
            if (temperature.empty()) return py::none();
            return view(temperature, self);
          },
          R"(Temperature of the sliding surface at `time` [degrees Celsius], shape (N,).

None unless the friction law depends on it.)")
      .def_property_readonly(
          "state", [](const Self& r) { return r.response.final_state; },
          R"(The `StructureState` at the end, from which `advance` continues.)")
      .def_property_readonly("peak", number<&StructureResponse::peak>(),
                             "Largest |x| over all time, not only at samples [m].")
      .def_property_readonly("residual", number<&StructureResponse::residual>(), "x at the end [m].")
      .def_property_readonly(
          "at_rest", [](const Self& r) { return r.response.final_state.mode == Mode::stuck; },
          "Whether the interface sticks at the end; the structure may still move.")
      .def_property_readonly("settled", number<&StructureResponse::settled>(),
                             R"(Whether it is certain that the interface will not slide again (bool).

With `settle=True` always: the amplitudes of all modes, which only shrink, together cannot exceed the friction.)")
      .def_property_readonly("sliding_distance", number<&StructureResponse::sliding_distance>(),
                             "Total sliding distance (path length) [m].")
      .def_property_readonly(
          "slips", [](const Self& r) { return slips(r.response.events); }, "Number of slips.")
      .def_property_readonly("time_sliding", number<&StructureResponse::time_sliding>(), "Time spent sliding [s].")
      .def_property_readonly("energy", number<&StructureResponse::energy>(),
                             R"(Energy balance of the whole system per unit of the reference mass [m^2/s^2].

`dissipated` is the work of friction; `damped` contains that of the dampers of the structure. With mass=0, and for a
decoupled `FlexibleSlope`, it is that of the slider alone.)")
      .def_property_readonly("peak_base_acceleration", number<&StructureResponse::peak_base_acceleration>(),
                             "Largest |`base_acceleration`| over all time [m/s^2].")
      .def_property_readonly("peak_base_shear", number<&StructureResponse::peak_base_shear>(),
                             "Largest sum of the inertia forces of the structure over all time [N]; with `from_modes`, "
                             "per unit mass of base and structure [m/s^2].")
      .def_property_readonly("margin", number<&StructureResponse::margin>(),
                             R"(Smallest | |q| - level | at which stick or slip was decided [m/s^2].

Decisions are the ends of slips; infinite if there was none. If it is tiny, the response depends on round-off.)")
      .def_property_readonly("components", number<&StructureResponse::components>(),
                             "Components of the ground motion that acted, 'axis' or 'axis + vertical'.")
      .def_property_readonly("remark", &remark_of,
                             R"(Sentences about limits of the result; empty if there are none (str).

A pendulum beyond 0.2 of its radius; an interface that never slips, but would if the ground accelerations were in g;
equivalent-linear soil that is sheared by more than 0.4 %; equipment under a motion whose transverse component does not
act.)")
      .def("__getattr__",
           [](const Self&, const std::string& name) -> py::object {
             throw py::attribute_error(name == "sensitivity"
                                           ? "StructureResponse: sensitivities of structures are not covered"
                                           : "'StructureResponse' object has no attribute '" + name + "'");
           })
      .def("animate", animation(), py::kw_only(), py::arg("time") = py::none(), py::arg("speed") = 1.0,
           py::arg("fps") = 15.0, py::arg("title") = py::none(), py::arg("size") = py::none(), animation_doc)
      .def("plot", plot_in("plot_structure_response", "figure"), py::kw_only(), py::arg("figure") = py::none(),
           py::arg("title") = py::none(),
           R"(Plot the displacement of the interface over time, and the peaks of the floors by height.

Needs matplotlib (`pip install stickslip[plot]`). Takes `figure`, a matplotlib Figure or SubFigure to draw in, and
`title`. Returns the figure, see `stickslip.plotting.plot_structure_response`.)")
      .def("plot_hysteresis", hysteresis(), py::kw_only(), py::arg("figure") = py::none(),
           py::arg("title") = py::none(), py::arg("ax") = py::none(), py::arg("time") = py::none(), hysteresis_doc)
      .def(
          "_curve",
          [](const Self& self) {
            const std::vector<InterfacePoint> points =
                with_system(self, [&](const SlidingStructure& system, const GroundMotion& motion) {
                  return interface_loops(system, motion, self.response);
                });
            return structured(
                points.size(), [&](std::size_t i) { return points[i]; }, std::pair("time", &InterfacePoint::time),
                std::pair("displacement", &InterfacePoint::displacement), std::pair("force", &InterfacePoint::force));
          },
          R"(Points that draw the loops of `force` with straight lines between them, for `stickslip.plotting`.

A structured array with the fields time [s], displacement [m] and force [m/s^2]; two points where the force jumps.)")
      .def("__repr__", [](const Self& r) {
        const std::string remark = remark_of(r);
        return "<StructureResponse: peak " + digits(r.response.peak) + " m, residual " + digits(r.response.residual) +
               " m, " + std::to_string(r.response.events.size()) + " events" + (remark.empty() ? "" : "; " + remark) +
               ">";
      });
  define_response<Self>(
      m, "StructureResponse", times_over<Self>(&StructureResponse::displacement), &at_times,
      {.system = "system",
       .object = "interface",
       .rests = "is known to stick for good",
       .states = R"(StructureState or ndarray
    At one time a `StructureState`, from which `advance` continues. At several a structured array of shape (T,) with the
    fields time [s], displacement [m] and velocity [m/s] of the interface, stuck, and, if the structure has floors,
    floor_displacement [m] of shape (T, floors), relative to the base, or to the ground below an `EquipmentOnFloor`. At
    an impact, the state after it.)",
       .columns = R"(The columns are `ground_acceleration` [m/s^2], `displacement` [m], `velocity` [m/s],
    `base_acceleration`, `demand` and `force` [m/s^2], `temperature` [degC] if the law depends on it, and for each floor
    `floor_1_displacement` [m], `floor_1_acceleration` [m/s^2] and so on.)",
       .attributes = "`peak` and `residual`",
       .results = R"(`peak` [m], `residual` [m], `sliding_distance` [m], `at_rest`, `settled`,
    `margin` [m/s^2], `peak_base_acceleration` [m/s^2] and `peak_base_shear` [N, or m/s^2 with `from_modes`])",
       .floors = R"(In place of those of floors `floor_displacement`, `floor_acceleration` and, with an influence of
    ones, `floor_drift` [m], over `time` and the coordinate `floor`, from 1.
    )",
       .peaks = R"(; with floors, `peak_floor_acceleration`
    [m/s^2] and, with an influence of ones, `peak_drift` [m])"});

  const auto bind_integrate_of = [&](auto* type, const char* doc) {
    using System = std::remove_pointer_t<decltype(type)>;
    m.def(
        "integrate",
        [](const System& slider, const py::object& motion, double displacement, double velocity, bool settle,
           double sliding_distance, const std::optional<SurfaceHeat>& heat) {
          return integrate_structure(py::cast(slider), motion, displacement, velocity, settle, sliding_distance, heat);
        },
        py::arg("slider"), py::arg("motion"), py::kw_only(), py::arg("displacement") = 0.0, py::arg("velocity") = 0.0,
        py::arg("settle") = false, py::arg("sliding_distance") = 0.0, py::arg("heat") = py::none(), doc);
  };
  const auto bind_histories_of = [&](auto* type, const char* doc) {
    using System = std::remove_pointer_t<decltype(type)>;
    m.def(
        "histories",
        [](const System& slider, const GroundMotion& motion) {
          StructureIntegrateOptions options{.progress = check_for_interrupt};
          options.floors = false;
          StructureResponse r = [&] {
            const py::gil_scoped_release released;
            return integrate(slider, motion, options);
          }();
          return py::make_tuple(array_of(std::move(r.displacement)), array_of(std::move(r.velocity)));
        },
        py::arg("slider"), py::arg("motion"), doc);
  };
  bind_histories_of(
      static_cast<IsolatedStructure*>(nullptr),
      R"(With an `IsolatedStructure`, an `EquipmentOnFloor` or a `FlexibleSlope`, the histories are those of
the sliding interface. The same bits as `integrate`.)");
  bind_histories_of(static_cast<EquipmentOnFloor*>(nullptr), "");
  bind_histories_of(static_cast<FlexibleSlope*>(nullptr), "");
  const std::string doc =
      R"(With an `IsolatedStructure`, an `EquipmentOnFloor` or a `FlexibleSlope`, the structure moves, too, and the result
is a `StructureResponse`. The motion must be a GroundMotion. Where N < 0 the interface slides without friction, as with
contact='clipped'. With `settle`, the motion continues until the amplitudes of all modes together cannot exceed the
friction; ConvergenceError if they do not shrink. ValueError for a structure whose fastest rate, stuck or sliding [rad/s],
times the mean time step of the motion is above )" +
      detail::shortest(SlidingStructure::most_rate_per_step) + ", as with a tiny base mass.";
  bind_integrate_of(static_cast<IsolatedStructure*>(nullptr), doc.c_str());
  bind_integrate_of(static_cast<EquipmentOnFloor*>(nullptr), "");
  bind_integrate_of(static_cast<FlexibleSlope*>(nullptr), "");
}

}  // namespace stickslip::python
