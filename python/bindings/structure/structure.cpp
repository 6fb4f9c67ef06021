#include "structure/structure.hpp"

#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "in_python.hpp"
#include "parts.hpp"
#include "sliding/response.hpp"
#include "sliding/units_remark.hpp"
#include "stickslip/structure/equipment_on_floor.hpp"
#include "stickslip/structure/flexible_slope.hpp"
#include "stickslip/structure/floor_motions.hpp"
#include "stickslip/structure/isolated_structure.hpp"
#include "structure/from_inputs.hpp"

namespace stickslip::python {
namespace {

py::tuple inputs_of_structure(const Structure& s) {
  if (s.has_matrices())
    return py::make_tuple("matrices", plain(s.mass()), plain(s.damping()), plain(s.stiffness()), plain(s.influence()));
  return py::make_tuple("modes", plain(s.modes().effective_masses), plain(s.modes().frequencies),
                        plain(s.modes().damping_ratios), plain(s.unit_shapes()));
}

Structure structure_of_modes(const py::object& fractions, const py::object& frequencies, const py::object& ratios,
                             const py::object& shapes) {
  const auto f = to_vector(fractions, "Structure.from_modes: mass_fractions"),
             w = to_vector(frequencies, "Structure.from_modes: frequencies", "rad/s"),
             z = to_vector(ratios, "Structure.from_modes: damping_ratios");
  if (shapes.is_none()) return Structure::from_modes(f, w, z);
  return Structure::from_modes(f, w, z, matrix_from(shapes, "Structure.from_modes: shapes"));
}

double first_period(const Structure& s) {
  const auto& w = s.modes().frequencies;  // in order
  const auto first = std::ranges::upper_bound(w, 0.0);
  return first == w.end() ? std::numeric_limits<double>::infinity() : 2 * std::numbers::pi / *first;
}

void check_first_period(const std::string& who, std::string_view quantity, const Structure& structure) {
  check_unit(quantity, who, "the first period", first_period(structure));
}

Structure plausible_structure_of_modes(const py::object& fractions, const py::object& frequencies,
                                       const py::object& ratios, const py::object& shapes) {
  Structure structure = structure_of_modes(fractions, frequencies, ratios, shapes);
  check_unit("damping ratio", "Structure.from_modes", "damping_ratios", structure.modes().damping_ratios);
  check_first_period("Structure.from_modes", "first period of modes", structure);
  return structure;
}

Structure structure_of_matrices(const py::object& mass, const py::object& damping, const py::object& stiffness,
                                const py::object& influence) {
  const auto m = matrix_from(mass, "Structure: mass", "kg"), c = matrix_from(damping, "Structure: damping", "N*s/m"),
             k = matrix_from(stiffness, "Structure: stiffness", "N/m");
  if (influence.is_none()) return Structure(m, c, k);
  return Structure(m, c, k, to_vector(influence, "Structure: influence"));
}

Structure structure_from_inputs(const py::tuple& inputs) {
  const auto of = [&](std::size_t i) { return inputs[i].cast<py::object>(); };
  if (inputs.size() != 5) throw std::invalid_argument("unpickling: expected 5 values of a Structure");
  if (of(0).equal(py::str("modes"))) return structure_of_modes(of(1), of(2), of(3), of(4));
  return structure_of_matrices(of(1), of(2), of(3), of(4));
}

std::string description(const Structure& s) {
  const auto rigid = std::ranges::count(s.modes().frequencies, 0.0);
  const auto count = [](std::ptrdiff_t n, const char* what) {
    return std::to_string(n) + ' ' + what + (n == 1 ? "" : "s");
  };
  return "<Structure: " + (s.floors() > 0 ? count(s.floors(), "floor") + ", " : std::string()) +
         count(s.size(), "mode") + (rigid > 0 ? ", " + std::to_string(rigid) + " of them rigid" : std::string()) +
         ", first period " + digits(first_period(s)) + " s>";
}

const char* name_of(SlopeMethod method) { return method == SlopeMethod::coupled ? "coupled" : "decoupled"; }

SlopeMethod method_of(const std::string& name) {
  if (name == "coupled") return SlopeMethod::coupled;
  if (name == "decoupled") return SlopeMethod::decoupled;
  throw std::invalid_argument("FlexibleSlope: method must be 'coupled' or 'decoupled', got '" + name + "'");
}

std::string text_of(const FlexibleSlope& s) {
  std::string text = "FlexibleSlope(ky_g=" +
                     (s.degrading ? py::repr(py::cast(*s.degrading)).cast<std::string>() : detail::shortest(s.ky_g)) +
                     ", height=" + detail::shortest(s.height) +
                     ", shear_velocity=" + detail::shortest(s.shear_velocity);
  if (!s.soil) text += ", damping_ratio=" + detail::shortest(s.damping_ratio);
  if (s.modes != 1) text += ", modes=" + std::to_string(s.modes);
  if (s.rock_velocity) text += ", rock_velocity=" + detail::shortest(*s.rock_velocity);
  if (s.soil) text += ", soil=HyperbolicSoil(reference_strain=" + detail::shortest(s.soil->reference_strain()) + ")";
  return text + ", method='" + name_of(s.method) + "')";
}

}  // namespace

template <>
inline constexpr auto parts<HyperbolicSoil> = std::tuple(&HyperbolicSoil::reference_strain);
template <>
inline constexpr auto parts<Rayleigh> = std::tuple(&Rayleigh::alpha, &Rayleigh::beta);
template <>
inline constexpr auto parts<FlexibleSlope> = std::tuple(&FlexibleSlope::ky_g, &FlexibleSlope::height,
                                                        &FlexibleSlope::shear_velocity, &FlexibleSlope::damping_ratio,
                                                        &FlexibleSlope::modes, &FlexibleSlope::rock_velocity,
                                                        &FlexibleSlope::soil, &FlexibleSlope::method,
                                                        &FlexibleSlope::degrading);

namespace {

/// What `integrate` returns for a structure: it is made again from its inputs when it is unpickled.
struct StructureResponseWithInputs {
  StructureResponse response;
  py::object system, motion;
  StructureIntegrateOptions options;
  py::object time{}, events{};

  py::tuple inputs() const {
    return py::make_tuple(system, motion, options.displacement, options.velocity, options.settle,
                          options.sliding_distance, options.heat);
  }
};
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

template <auto member>
auto number() {
  return [](const Self& self) { return self.response.*member; };
}
template <auto member>
auto history() {
  return [](const py::object& self) { return view(self.cast<const Self&>().response.*member, self); };
}

}  // namespace

void bind_structure(py::module_& m) {
  value_class<Rayleigh>(m, "Rayleigh", R"(Rayleigh damping of a structure, C = alpha M + beta K.

Parameters
----------
alpha : float, optional
    [1/s], finite and at least 0.
beta : float, optional
    [s], finite and at least 0.)")
      .def(py::init([](double alpha, double beta) {
             detail::require(std::isfinite(alpha) && alpha >= 0, "Rayleigh: alpha must be finite and at least 0", alpha,
                             "1/s");
             detail::require(std::isfinite(beta) && beta >= 0, "Rayleigh: beta must be finite and at least 0", beta,
                             "s");
             return Rayleigh{alpha, beta};
           }),
           py::arg("alpha") = 0.0, py::arg("beta") = 0.0)
      .def_readonly("alpha", &Rayleigh::alpha, "Factor of the mass matrix [1/s].")
      .def_readonly("beta", &Rayleigh::beta, "Factor of the stiffness matrix [s].")
      .def("__repr__", [](const Rayleigh& r) {
        return "Rayleigh(alpha=" + detail::shortest(r.alpha) + ", beta=" + detail::shortest(r.beta) + ")";
      });

  made_from_inputs<Structure>(
      m, "Structure",
      R"(A linear structure on a base that moves with the acceleration n, M u'' + C u' + K u = -M influence n.

u are the displacements relative to the base [m]. See also `Structure.shear_building` and `Structure.from_modes`.

Parameters
----------
mass : array_like, shape (n, n)
    M [kg], symmetric and positive definite.
damping : array_like, shape (n, n)
    C [N s/m], symmetric and positive semidefinite; it need not be diagonal in the modes.
stiffness : array_like, shape (n, n)
    K [N/m], symmetric and positive semidefinite, not zero.
influence : array_like, shape (n,), optional
    Displacements under a unit displacement of the base; default: ones.

Raises
------
ValueError
    Naming the matrix, the entry or the eigenvalue.

Warns
-----
PlausibilityWarning
    A first period outside 0.02 to 10 s: the stiffnesses may be in kN/m or MN/m, or the masses in t.)",
      &inputs_of_structure, &structure_from_inputs)
      .def(py::init([](const py::object& mass, const py::object& damping, const py::object& stiffness,
                       const py::object& influence) {
             Structure structure = structure_of_matrices(mass, damping, stiffness, influence);
             check_first_period("Structure", "first period of a building", structure);
             return structure;
           }),
           py::arg("mass"), py::arg("damping"), py::arg("stiffness"), py::arg("influence") = py::none())
      .def_static(
          "shear_building",
          [](const py::object& masses, const py::object& stiffnesses, const std::optional<Rayleigh>& damping,
             std::optional<double> damping_ratio) {
            const auto mass = to_vector(masses, "Structure.shear_building: masses", "kg"),
                       stiffness = to_vector(stiffnesses, "Structure.shear_building: stiffnesses", "N/m");
            if (damping.has_value() == damping_ratio.has_value())
              throw std::invalid_argument("Structure.shear_building: give either damping or damping_ratio, got " +
                                          std::string(damping ? "both" : "neither"));
            check_unit("damping ratio", "Structure.shear_building", "damping_ratio", damping_ratio);
            Structure building = damping ? Structure::shear_building(mass, stiffness, *damping)
                                         : Structure::shear_building(mass, stiffness, *damping_ratio);
            check_first_period("Structure.shear_building", "first period of a building", building);
            return building;
          },
          py::kw_only(), py::arg("masses"), py::arg("stiffnesses"), py::arg("damping") = py::none(),
          py::arg("damping_ratio") = py::none(),
          R"(A building of rigid floors.

Parameters
----------
masses : array_like, shape (n,)
    Of the floors, the lowest first [kg], positive and finite.
stiffnesses : array_like, shape (n,)
    Of the stories below them [N/m], positive and finite.
damping : Rayleigh, optional
    C = alpha M + beta K.
damping_ratio : float, optional
    Of all modes, instead of damping; finite and at least 0.

Returns
-------
Structure

Raises
------
ValueError
    Naming the entry; both or neither of `damping` and `damping_ratio`.

Warns
-----
PlausibilityWarning
    As for `Structure`; a damping ratio from 1 to 100, which may be in percent.)")
      .def_static("from_modes", &plausible_structure_of_modes, py::kw_only(), py::arg("mass_fractions"),
                  py::arg("frequencies"), py::arg("damping_ratios"), py::arg("shapes") = py::none(),
                  R"(A structure that is known by some of its modes on a fixed base.

Each mode obeys y'' + 2 z w y' + w^2 y = -n and has a fraction of the mass of base and structure; what the fractions
leave is the mass that moves with the base.

Parameters
----------
mass_fractions : array_like, shape (n,)
    Positive, with a sum below 1.
frequencies : array_like, shape (n,)
    w [rad/s], positive and finite.
damping_ratios : array_like, shape (n,)
    z, finite and at least 0.
shapes : array_like, shape (floors, n), optional
    The displacements of the floors are shapes @ y. With all modes, each row has the sum 1.

Returns
-------
Structure

Raises
------
ValueError
    Naming the entry.

Warns
-----
PlausibilityWarning
    A first period outside 0.02 to 10 s: the frequencies may be in Hz; a damping ratio from 1 to 100, which may be in
    percent.)")
      .def_property_readonly(
          "mass", [](const Structure& s) { return array_from(s.mass()); },
          "M [kg], shape (n, n); empty with `from_modes`.")
      .def_property_readonly(
          "damping", [](const Structure& s) { return array_from(s.damping()); },
          "C [N s/m], shape (n, n); empty with `from_modes`.")
      .def_property_readonly(
          "stiffness", [](const Structure& s) { return array_from(s.stiffness()); },
          "K [N/m], shape (n, n); empty with `from_modes`.")
      .def_property_readonly(
          "influence", [](const Structure& s) { return array_from(s.influence()); },
          "Displacements of the floors under a unit displacement of the base, shape (floors,).")
      .def_property_readonly(
          "floors", [](const Structure& s) { return s.floors(); },
          "Number of floors, or degrees of freedom; 0 if `from_modes` was given no shapes.")
      .def(
          "modes",
          [](const Structure& s) {
            return py::module_::import("stickslip._structures")
                .attr("Modes")(array_from(s.modes().frequencies), array_from(s.modes().damping_ratios),
                               array_from(s.modes().participation), array_from(s.modes().effective_masses),
                               array_from(s.modes().shapes));
          },
          R"(The modes on a fixed base, in order of frequency.

Returns
-------
Modes
    With frequencies, periods, damping ratios, participation factors, effective masses and shapes; a table by
    `to_dataframe` and a figure by `plot`.)")
      .def(
          "floor_motions",
          [](const Structure& s, const GroundMotion& motion, int parts, const std::optional<Structure>& transverse) {
            const std::vector<GroundMotion> motions = [&] {
              const py::gil_scoped_release released;
              return floor_motions(s, motion, parts, transverse);
            }();
            py::list each, floors;
            for (const GroundMotion& one : motions) {
              each.append(one);
              floors.append(py::len(floors) + 1);
            }
            return py::module_::import("stickslip.motions.suite")
                .attr("Suite")(each, py::dict(py::arg("floor") = floors));
          },
          py::arg("motion"), py::kw_only(), py::arg("parts") = 1, py::arg("transverse") = py::none(),
          R"(The absolute accelerations of the floors, as ground motions for light sliders on them.

One response of the structure, on the ground and without what stands on it, serves all sliders: `sweep` integrates many of
them on every floor. It starts from rest and ends with the ground motion.

Parameters
----------
motion : GroundMotion
    Along the direction of the structure. A transverse component acts on the structure in the other direction; there is
    no torsion. A vertical component acts on the floors as on the ground.
parts : int, optional
    Equal parts of each segment, at least 1: the floor motions have that many times more samples.
transverse : Structure, optional
    The structure in the transverse direction, with as many floors; default: the same as along the axis.

Returns
-------
Suite
    One motion per floor, the lowest first, named after the motion and the floor; `suite.floor` has their numbers.
    Floors count from 1, the items of the suite from 0: `suite[2]` is floor 3. With both horizontal components if the
    motion has them, as a `PlanarSlider` needs.

Raises
------
ValueError
    A structure made by `from_modes` without shapes; parts below 1; a transverse structure with another number of
    floors, or for a motion without that component.
OverflowError
    Accelerations above 1e100 m/s^2.

Notes
-----
The motions are exact at their samples, to round-off. Between samples sliders see straight lines, where an
`EquipmentOnFloor` with mass=0 sees the exact motion. For 20 levels on each floor of a building of ten stories under the
18 sample records, peaks above 1 cm differ by 0.1 % in the median, 1.2 % at the 95 % quantile and 6.3 % at most; peaks
above 1 mm by at most 20 %. Two parts make that a quarter, four a sixteenth.

Takes some 5 ms for ten stories and a record.)")
      .def("__repr__", &description);

  const auto inputs_of_isolated = [](const IsolatedStructure& s) {
    return py::make_tuple(
        s.slider(), s.structure(),
        s.structure().has_matrices() ? py::object(py::float_(s.base_mass())) : py::object(py::none()));
  };
  const auto isolated = [](const AnySlider& slider, const Structure& structure, std::optional<double> base_mass) {
    return base_mass ? IsolatedStructure(slider, structure, *base_mass) : IsolatedStructure(slider, structure);
  };
  made_from_inputs<IsolatedStructure>(m, "IsolatedStructure",
                                      R"(A structure on a base that slides on the ground.

`integrate` moves it, exact to round-off from event to event: in the modes of the structure on a fixed base, with mass
fractions gamma of the sum G, the bond between base and ground must carry

    q = -(1 - G) n + sum gamma_j (2 z_j w_j y_j' + w_j^2 y_j) - wn^2 x,

per unit mass of base and structure. The base sticks while q is within the friction levels; the structure goes on moving.
While it slides, (1 - G) x'' = q - friction - c x', and n + x'' acts on the structure. An impact on a stop leaves the
absolute velocities of the floors as they are.

Parameters
----------
slider : Slider or friction law
    Friction, spring, damper and stops of the interface, per unit mass of base and structure; on level ground. Laws that
    are functions of numbers are not covered.
structure : Structure
    The structure on the base.
base_mass : float, optional
    [kg], positive and finite; not with `Structure.from_modes`, whose mass fractions leave it.

Raises
------
ValueError
    A slope; a law that is not covered; a base mass that is not positive, is missing, or is given with `from_modes`.

Warns
-----
PlausibilityWarning
    A base mass outside 0.005 to 200 times the mean mass of a floor: one of the masses may be in t.

Examples
--------
>>> import stickslip as ss
>>> building = ss.Structure.from_modes(mass_fractions=[0.7], frequencies=[8.0], damping_ratios=[0.05])
>>> quake = ss.GroundMotion([0, 3, -3, 0, 2, 0], dt=0.2)
>>> r = ss.integrate(ss.IsolatedStructure(ss.Coulomb(mu=0.1), building), quake, settle=True)
>>> r.settled
True)",
                                      inputs_of_isolated,
                                      [isolated](const py::tuple& inputs) {
                                        return isolated(inputs[0].cast<const AnySlider&>(),
                                                        inputs[1].cast<const Structure&>(),
                                                        inputs[2].cast<std::optional<double>>());
                                      })
      .def(py::init([isolated](const AnySlider& slider, const Structure& structure, std::optional<double> base_mass) {
             IsolatedStructure made = isolated(slider, structure, base_mass);
             double floors = 0;
             for (std::ptrdiff_t i = 0; i < structure.mass().rows(); ++i) floors += structure.mass()(i, i);
             if (base_mass)
               check_unit("base mass over the mean mass of a floor", "IsolatedStructure",
                          "base_mass over the mean mass of a floor",
                          *base_mass * static_cast<double>(structure.floors()) / floors);
             return made;
           }),
           py::arg("slider"), py::arg("structure"), py::kw_only(), py::arg("base_mass") = py::none())
      .def("rest", &IsolatedStructure::rest, "The `StructureState` at rest at x = 0, for `advance`.")
      .def_property_readonly("slider", &IsolatedStructure::slider, "The `Slider` of the interface.")
      .def_property_readonly("structure", &IsolatedStructure::structure, "The `Structure`.")
      .def_property_readonly("base_mass", &IsolatedStructure::base_mass,
                             "Mass of the base [kg]; with `from_modes`, as a fraction of base and structure.")
      .def("__repr__", [inputs_of_isolated](const IsolatedStructure& s) {
        const py::tuple of = inputs_of_isolated(s);
        std::string text =
            "IsolatedStructure(" + py::repr(of[0]).cast<std::string>() + ", " + description(s.structure());
        if (!of[2].is_none()) text += ", base_mass=" + detail::shortest(s.base_mass());
        return text + ")";
      });

  const auto inputs_of_equipment = [](const EquipmentOnFloor& s) {
    return py::make_tuple(s.slider(), s.structure(), s.floor(), s.mass());
  };
  made_from_inputs<EquipmentOnFloor>(m, "EquipmentOnFloor",
                                     R"(A slider on a floor of a structure that stands on the ground.

x is relative to the floor. With a mass, the structure feels the friction of the slider; while the slider sticks, its
mass is part of the floor. With mass=0 the floor moves as if there was no slider, and energies are those of the slider
per unit mass. Levels, spring, damper and energies are per unit mass of the slider.

Parameters
----------
slider : Slider or friction law
    As for `IsolatedStructure`.
structure : Structure
    With floors: if made by `from_modes`, with shapes.
floor : int
    Counted from 1, the lowest.
mass : float, optional
    Mass of the slider [kg], finite and at least 0; with `from_modes`, as a fraction of the mass of the structure.

Raises
------
ValueError
    A floor that does not exist; a negative mass; a slope; a law that is not covered.)",
                                     inputs_of_equipment,
                                     [](const py::tuple& inputs) {
                                       return EquipmentOnFloor(
                                           inputs[0].cast<const AnySlider&>(), inputs[1].cast<const Structure&>(),
                                           inputs[2].cast<std::ptrdiff_t>(), inputs[3].cast<double>());
                                     })
      .def(py::init<AnySlider, Structure, std::ptrdiff_t, double>(), py::arg("slider"), py::arg("structure"),
           py::kw_only(), py::arg("floor"), py::arg("mass") = 0.0)
      .def("rest", &EquipmentOnFloor::rest, "The `StructureState` at rest at x = 0, for `advance`.")
      .def_property_readonly("slider", &EquipmentOnFloor::slider, "The `Slider` on the floor.")
      .def_property_readonly("structure", &EquipmentOnFloor::structure, "The `Structure`.")
      .def_property_readonly("floor", &EquipmentOnFloor::floor, "The floor, counted from 1.")
      .def_property_readonly("mass", &EquipmentOnFloor::mass, "Mass of the slider [kg].")
      .def("__repr__", [inputs_of_equipment](const EquipmentOnFloor& s) {
        return "EquipmentOnFloor(" + py::repr(inputs_of_equipment(s)[0]).cast<std::string>() + ", " +
               description(s.structure()) + ", floor=" + std::to_string(s.floor()) +
               ", mass=" + detail::shortest(s.mass()) + ")";
      });

  value_class<HyperbolicSoil>(m, "HyperbolicSoil",
                              R"(Soil whose shear modulus and damping depend on the strain, for `FlexibleSlope`.

G/Gmax = 1 / (1 + g/gr), and the damping ratio is 0.62 (G/Gmax)^0.1 D + 0.01, where
D = (4/pi) (1 + gr/g) (1 - (gr/g) ln(1 + g/gr)) - 2/pi is that of Masing's rule (Darendeli 2001).

Parameters
----------
reference_strain : float
    gr, at which the modulus is half of Gmax; positive and finite.

Warns
-----
PlausibilityWarning
    A strain of 0.02 or more, which may be in percent.)")
      .def(py::init([](double reference_strain) {
             check_unit("reference strain", "HyperbolicSoil", "reference_strain", reference_strain);
             return HyperbolicSoil(reference_strain);
           }),
           py::kw_only(), py::arg("reference_strain"))
      .def_property_readonly("reference_strain", &HyperbolicSoil::reference_strain, "gr.")
      .def(
          "modulus_ratio",
          [](const HyperbolicSoil& s, const py::object& strain) {
            return of_each(strain, "HyperbolicSoil.modulus_ratio: strain",
                           [&](double g) { return s.modulus_ratio(g); });
          },
          py::arg("strain"),
          R"(G/Gmax at strains of at least 0.

Parameters
----------
strain : float or array_like
    Finite and at least 0.

Returns
-------
float or ndarray)")
      .def(
          "damping_ratio",
          [](const HyperbolicSoil& s, const py::object& strain) {
            return of_each(strain, "HyperbolicSoil.damping_ratio: strain",
                           [&](double g) { return s.damping_ratio(g); });
          },
          py::arg("strain"),
          R"(Damping ratio at strains of at least 0.

Parameters
----------
strain : float or array_like
    Finite and at least 0.

Returns
-------
float or ndarray)")
      .def("__repr__", [](const HyperbolicSoil& s) {
        return "HyperbolicSoil(reference_strain=" + detail::shortest(s.reference_strain()) + ")";
      });

  const auto as = [](SlopeMethod method) {
    return [method](const py::object& self, const py::object& motion) {
      FlexibleSlope slope = self.cast<const FlexibleSlope&>();
      slope.method = method;
      return integrate_structure(py::cast(slope), motion, 0, 0, true, 0, {});
    };
  };
  m.attr("_most_modes") = FlexibleSlope::most_modes;
  value_class<FlexibleSlope>(
      m, "FlexibleSlope",
      R"(A flexible mass that slides downhill, such as an earth dam: coupled and decoupled sliding-block analysis.

A uniform shear column of height H and shear-wave velocity Vs, with the modes w_j = (2 j - 1) pi Vs / (2 H) and the mass
fractions 8 / ((2 j - 1)^2 pi^2). Coupled: the column moves on the sliding surface, as an `IsolatedStructure` that slides
one way. Decoupled: the base shear of a column that does not slide drives a rigid block. Positive ground acceleration
points downhill, and displacements are positive downhill.

Parameters
----------
ky_g : float or Degrading
    Yield acceleration [g], finite and at least 0; or a law by which it changes with the distance slid downhill.
height : float
    H [m], positive and finite.
shear_velocity : float
    Vs [m/s], at small strains; positive and finite.
damping_ratio : float, optional
    Of each mode, finite and at least 0. Not with `soil`.
modes : int, optional
    How many modes move, from 1 to 1000; the mass of the others rides with the base. Default 1, the usual analysis.
rock_velocity : float, optional
    Shear-wave velocity Vr of the rock [m/s]; default: rigid rock. Radiation adds min(0.55016 (Vr/Vs)^-0.9904, 0.20) to
    the damping ratio, with Vs at small strains.
soil : HyperbolicSoil, optional
    Equivalent-linear soil: modulus and damping belong to the effective strain 0.65 (pi/2) u_max / H, u_max the largest
    displacement of the top relative to the base without sliding. Iterated until neither changes by more than 1e-12.
method : 'coupled' or 'decoupled', optional

Raises
------
ValueError
    A value out of range; a damping ratio together with `soil`.

Warns
-----
PlausibilityWarning
    A ky_g from 0.8 to 100, which may be in m/s^2 or percent of g; a damping ratio from 1 to 100, which may be in percent;
    a velocity outside 10 to 8000 m/s, which may be in km/s or ft/s; a first period 4 H / Vs of 5 s or more.

Examples
--------
>>> import stickslip as ss
>>> slope = ss.FlexibleSlope(ky_g=0.1, height=50, shear_velocity=600, damping_ratio=0.15)
>>> quake = ss.GroundMotion([0, 3, -3, 0, 2, 0], dt=0.2)
>>> bool(slope.coupled(quake).residual > 0)
True)")
      .def(py::init([](const std::variant<double, Degrading>& ky_g, double height, double shear_velocity,
                       double damping_ratio, int modes, std::optional<double> rock_velocity,
                       const std::optional<HyperbolicSoil>& soil, const std::string& method) {
             const auto* const degrading = std::get_if<Degrading>(&ky_g);
             FlexibleSlope slope{degrading ? 0 : std::get<double>(ky_g),
                                 height,
                                 shear_velocity,
                                 damping_ratio,
                                 modes,
                                 rock_velocity,
                                 soil,
                                 method_of(method),
                                 degrading ? std::optional(*degrading) : std::nullopt};
             check(slope);
             const std::string who = "FlexibleSlope";
             check_unit("yield acceleration", who, "ky_g", slope.ky_g);
             check_unit("first period of a slope", who, "the first period", 4 * height / shear_velocity);
             check_unit("shear-wave velocity", who, "shear_velocity", shear_velocity);
             check_unit("shear-wave velocity", who, "rock_velocity", rock_velocity);
             check_unit("damping ratio", who, "damping_ratio", damping_ratio);
             return slope;
           }),
           py::kw_only(), py::arg("ky_g"), py::arg("height"), py::arg("shear_velocity"), py::arg("damping_ratio") = 0.0,
           py::arg("modes") = 1, py::arg("rock_velocity") = py::none(), py::arg("soil") = py::none(),
           py::arg("method") = "coupled")
      .def_property_readonly(
          "ky_g",
          [](const FlexibleSlope& s) -> std::variant<double, Degrading> {
            if (s.degrading) return *s.degrading;
            return s.ky_g;
          },
          "Yield acceleration [g], or the law by which it changes.")
      .def_readonly("height", &FlexibleSlope::height, "H [m].")
      .def_readonly("shear_velocity", &FlexibleSlope::shear_velocity, "Vs at small strains [m/s].")
      .def_readonly("damping_ratio", &FlexibleSlope::damping_ratio, "Of each mode, without radiation.")
      .def_readonly("modes", &FlexibleSlope::modes, "How many modes move.")
      .def_readonly("rock_velocity", &FlexibleSlope::rock_velocity, "Vr [m/s], or None.")
      .def_readonly("soil", &FlexibleSlope::soil, "The soil, or None.")
      .def_property_readonly(
          "method", [](const FlexibleSlope& s) { return name_of(s.method); }, "'coupled' or 'decoupled'.")
      .def(
          "properties",
          [](const FlexibleSlope& slope, const GroundMotion& motion) {
            const SlopeProperties found = [&] {
              const py::gil_scoped_release released;
              return properties(slope, motion);
            }();
            py::dict result;
            result["shear_velocity"] = found.shear_velocity;
            result["damping_ratio"] = found.damping_ratio;
            result["strain"] = found.strain;
            result["iterations"] = found.iterations;
            return result;
          },
          py::arg("motion"),
          R"(Shear-wave velocity and damping ratio of the column under a ground motion.

Parameters
----------
motion : GroundMotion
    It matters with `soil` only.

Returns
-------
dict
    shear_velocity [m/s], damping_ratio (with radiation), strain (the effective one; 0 without `soil`), iterations.

Raises
------
ConvergenceError
    The iteration does not converge.)")
      .def("coupled", as(SlopeMethod::coupled), py::arg("motion"),
           R"(The settled response of the coupled analysis.

Parameters
----------
motion : GroundMotion
    Positive accelerations point downhill.

Returns
-------
StructureResponse)")
      .def("decoupled", as(SlopeMethod::decoupled), py::arg("motion"),
           R"(The settled response of the decoupled analysis.

Parameters
----------
motion : GroundMotion
    Positive accelerations point downhill.

Returns
-------
StructureResponse)")
      .def("__repr__", &text_of);
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
      .def_property_readonly(
          "motion", [](const Self& r) { return r.motion; }, "The ground motion.")
      .def_property_readonly(
          "time",
          [](Self& r) {
            return keep(r.time, [&] {
              return times_of(r.motion, r.motion.cast<const GroundMotion&>(), r.response.displacement.size());
            });
          },
          R"(Times of the samples [s], shape (N,).

The times of the ground motion; with `settle=True` they continue with its last step until the interface is known to stick
for good, but see `truncated`.)")
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
      .def_property_readonly("truncated", number<&StructureResponse::truncated>(),
                             "Whether the samples end, at ten times those of the motion, before the interface settles.")
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
          [](const Self& r) {
            StructureIntegrateOptions options = r.options;
            options.loops = true;
            const std::vector<InterfacePoint> points = integrate_with(r.system, r.motion, options).loops;
            py::dict layout;
            layout["names"] = py::make_tuple("time", "displacement", "force");
            layout["formats"] = py::make_tuple("f8", "f8", "f8");
            py::array rows(py::dtype::from_args(layout), static_cast<py::ssize_t>(points.size()));
            std::ranges::copy(points, static_cast<InterfacePoint*>(rows.mutable_data()));
            return rows;
          },
          R"(Points that draw the loops of `force` with straight lines between them, for `stickslip.plotting`.

A structured array with the fields time [s], displacement [m] and force [m/s^2]; two points where the force jumps.)")
      .def("to_dataframe", in_python("stickslip._structures", "to_dataframe"),
           R"(Convert the histories to a pandas DataFrame with the index `time`.

The columns are ground_acceleration, displacement, velocity, base_acceleration, demand and force, temperature if the law
depends on it, and for each floor floor_1_displacement, floor_1_acceleration and so on. ImportError without pandas.)")
      .def("to_xarray", in_python("stickslip._structures", "to_xarray"),
           R"(Convert the histories to an xarray Dataset over the coordinates `time` and, with floors, `floor`.

The variables of the interface are those of `to_dataframe`; floor_displacement, floor_acceleration and, with an influence
of ones, floor_drift are two-dimensional. Each has the attribute `units`. Attributes of the Dataset: system, motion (its
name), peak [m], residual [m]. ImportError without xarray.)")
      .def("_repr_html_", in_python("stickslip._structures", "response_html"))
      .def("to_csv", csv_in("stickslip._structures", "to_csv"), py::arg("path"),
           csv_doc("Write the histories to a CSV file, whole or not at all.",
                   "A line of names with units, then one line per sample; every number reads back as the same double.")
               .c_str())
      .def("to_json", in_python("stickslip._structures", "to_json"),
           R"(The results and histories as one JSON document.

Returns
-------
str
    An object with the columns of `to_dataframe`, their units, the events, the results by name, and the peaks of the
    floors.)")
      .def("__repr__", [](const Self& r) {
        const std::string remark = remark_of(r);
        return "<StructureResponse: peak " + digits(r.response.peak) + " m, residual " + digits(r.response.residual) +
               " m, " + std::to_string(r.response.events.size()) + " events" + (remark.empty() ? "" : "; " + remark) +
               ">";
      });

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
