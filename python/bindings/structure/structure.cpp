#include "structure/structure.hpp"

#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "parts.hpp"
#include "stickslip/structure/floor_motions.hpp"
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

}  // namespace

std::string description(const Structure& s) {
  const auto rigid = std::ranges::count(s.modes().frequencies, 0.0);
  const auto count = [](std::ptrdiff_t n, const char* what) {
    return std::to_string(n) + ' ' + what + (n == 1 ? "" : "s");
  };
  return "<Structure: " + (s.floors() > 0 ? count(s.floors(), "floor") + ", " : std::string()) +
         count(s.size(), "mode") + (rigid > 0 ? ", " + std::to_string(rigid) + " of them rigid" : std::string()) +
         ", first period " + digits(first_period(s)) + " s>";
}

template <>
inline constexpr auto parts<Rayleigh> = std::tuple(&Rayleigh::alpha, &Rayleigh::beta);

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
}

}  // namespace stickslip::python
