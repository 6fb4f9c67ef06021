#include "stickslip/friction/multi_pendulum.hpp"

#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "friction/arguments.hpp"
#include "parts.hpp"

namespace stickslip::python {
namespace {

std::vector<double> capacities_from(const py::object& capacities, std::size_t count, const std::string& who) {
  if (capacities.is_none()) return std::vector<double>(count, std::numeric_limits<double>::infinity());
  return to_vector(capacities, who + ": capacities", "m");
}

MultiPendulum bearing_from(const std::string& who, const py::object& radii, const py::object& mu,
                           const py::object& capacities, double restitution, bool nested) {
  std::vector<double> of_radii = to_vector(radii, who + ": radii", "m"), of_mu = to_vector(mu, who + ": mu");
  std::vector<double> of_capacities = capacities_from(capacities, of_radii.size(), who);
  check_unit("radius", who, "radii", of_radii);
  check_unit("coefficient of friction", who, "mu", of_mu);
  check_unit("length", who, "capacities", of_capacities);
  return MultiPendulum(std::move(of_radii), std::move(of_mu), std::move(of_capacities), restitution, nested);
}

/// A bearing of a fixed number of surfaces.
void def_bearing(py::module_& m, const char* name, std::size_t surfaces, bool nested, const char* doc) {
  m.def(
      name,
      [name, surfaces, nested](const py::object& radii, const py::object& mu, const py::object& capacities,
                               double restitution) {
        const MultiPendulum bearing = bearing_from(name, radii, mu, capacities, restitution, nested);
        detail::require(bearing.radii().size() == surfaces,
                        std::string(name) + ": radii must hold " + std::to_string(surfaces),
                        static_cast<double>(bearing.radii().size()));
        return bearing;
      },
      py::arg("radii"), py::arg("mu"), py::arg("capacities") = py::none(), py::arg("restitution") = 0.0, doc);
}

template <double MultiPendulum::Element::*member>
auto of_elements() {
  return [](const MultiPendulum& law) {
    std::vector<double> values;
    for (const auto& element : law.elements()) values.push_back(element.*member);
    return array_of(std::move(values));
  };
}

/// The motion of elements and surfaces, whose displacements are largest at the points of the path.
ElementMotion motion_of(const PendulumLoop& loop) {
  const auto largest = [](const std::vector<std::vector<double>>& rows) {
    std::vector<double> most;
    for (const auto& row : rows) {
      double one = 0;
      for (const double value : row) one = std::max(one, std::abs(value));
      most.push_back(one);
    }
    return most;
  };
  std::vector<double> work = loop.dissipated;
  for (double& one : work) one *= standard_gravity;
  return {loop.displacement,      loop.surfaces, std::move(work), loop.sliding_distance, largest(loop.displacement),
          largest(loop.surfaces), loop.slides,   loop.stops,      loop.surface_stops};
}

}  // namespace

template <>
void bind_law<MultiPendulum>(py::module_& m) {
  auto type = value_class<MultiPendulum>(
      m, "MultiPendulum",
      R"(A friction pendulum isolator with several sliding surfaces, in one horizontal direction.

A series of massless elements that carry the same force F. With phi = F/N, element k slides while
phi = u_k / R_k +- mu_k and |u_k| <= d_k, and stays where phi lies between; x is the sum of all u_k. Without a yield
displacement: at rest the bearing holds any force between the levels of its elements. phi depends on the path of x alone.
Where all elements are at their stops, the last stop, the slider hits it.

`DoublePendulum`, `TriplePendulum` and `QuintuplePendulum` make the usual ones.

Parameters
----------
radii : array_like
    Effective radii R [m]: that of the surface minus the height of the pivot. Positive; infinite is a flat surface.
    1 to 8 elements.
mu : array_like
    Coefficients of friction, one for each radius, positive and finite. They do not depend on the velocity.
capacities : array_like, optional
    Travel d of each surface to its stop [m], positive; none if not given.
restitution : float, optional
    Of the impact on the last stop, from 0 to 1. The other stops take no impact.
nested : bool, optional
    Whether the radii are those of nested surfaces, from the innermost outward: inner, lower, upper (, lower, upper), of
    which the inner one occurs twice. Otherwise they are elements in series, from bottom to top.

Raises
------
ValueError
    A value out of its range; lists of different lengths. In a nested bearing: an inner surface with a larger radius or
    more friction than the next outer one, or one that is at its stop before that slides.

Warns
-----
PlausibilityWarning
    A radius of 20 m or more, or a capacity of 3 m or more, which may be in mm, cm or inches; a coefficient from 3 to
    100, which may be in percent.

Notes
-----
As a law its resistance contains the springs of the elements: it may be negative. Exact to 1e-12 of the peak in closed
form; under vertical motion by power series. Linear in x: below 0.2 of the sum of the radii that move, where the next
term is 2 %. Not covered: friction that depends on velocity, pressure or temperature; uplift of single parts; two
horizontal directions.

Sources: Fenz and Constantinou (2008), doi 10.1193/1.2982531. See the page on pendulums with several surfaces.

Examples
--------
>>> isolator = TriplePendulum(radii=[0.3937, 3.7465, 3.7465], mu=[0.01, 0.04, 0.08], capacities=[0.0716, 0.5043, 0.5043])
>>> round(isolator.capacity, 4)
1.1518
>>> isolator.trace([0.508, -0.508]).force.round(4)
array([ 0.1225, -0.1225]))");
  type.def(py::init(
               [](const py::object& radii, const py::object& mu, const py::object& capacities, double restitution,
                  bool nested) { return bearing_from("MultiPendulum", radii, mu, capacities, restitution, nested); }),
           py::arg("radii"), py::arg("mu"), py::arg("capacities") = py::none(), py::arg("restitution") = 0.0,
           py::kw_only(), py::arg("nested") = false)
      .def_property_readonly(
          "radii", [](const MultiPendulum& law) { return to_array(law.radii()); }, "Effective radii, as given [m].")
      .def_property_readonly(
          "mu", [](const MultiPendulum& law) { return to_array(law.mu()); }, "Coefficients of friction, as given.")
      .def_property_readonly(
          "capacities", [](const MultiPendulum& law) { return to_array(law.capacities()); },
          "Travel to the stops, as given [m].")
      .def_property_readonly("restitution", &MultiPendulum::restitution, "Of the last stop.")
      .def_property_readonly("nested", &MultiPendulum::nested, "Whether the surfaces are nested.")
      .def_property_readonly(
          "capacity", [](const MultiPendulum& law) { return law.capacity(); },
          "Largest displacement of the bearing [m].")
      .def_property_readonly("element_radii", of_elements<&MultiPendulum::Element::radius>(),
                             "R_k of the elements of the series [m].")
      .def_property_readonly("element_mu", of_elements<&MultiPendulum::Element::mu>(), "mu_k of the elements.")
      .def_property_readonly("element_capacities", of_elements<&MultiPendulum::Element::capacity>(),
                             "d_k of the elements [m].")
      .def(
          "element_displacements",
          [](const MultiPendulum& law, const State& state) {
            State known = state;
            law.begin(known);
            return array_of(law.displacements(known.pendulum));
          },
          py::arg("state"), R"(Where the elements are in a state.

Parameters
----------
state : State

Returns
-------
ndarray
    u_k [m].)")
      .def(
          "trace",
          [](const MultiPendulum& law, const py::object& path) {
            const std::vector<double> points = to_vector(path, "trace: path", "m");
            return trace(law, points);
          },
          py::arg("path"), R"(Impose a displacement on the bearing, slowly, from its center.

Parameters
----------
path : array_like
    Displacements, one after the other [m]: finite, within `capacity`.

Returns
-------
PendulumLoop)")
      .def("__repr__", [](const MultiPendulum& law) {
        const bool triple = law.nested() && law.radii().size() == 3, five = law.nested() && law.radii().size() == 5;
        return std::string(triple ? "TriplePendulum"
                           : five ? "QuintuplePendulum"
                                  : "MultiPendulum") +
               "(radii=" + list_of_numbers(law.radii()) + ", mu=" + list_of_numbers(law.mu()) +
               ", capacities=" + list_of_numbers(law.capacities()) +
               (law.restitution() > 0 ? ", restitution=" + detail::shortest(law.restitution()) : "") +
               (law.nested() && !triple && !five ? ", nested=True" : "") + ")";
      });
  explain_constructor(type, "MultiPendulum: give radii= [m], mu= and capacities= [m], one of each for every surface");

  value_class<PendulumLoop>(m, "PendulumLoop", "The force of a `MultiPendulum` along a slow path of its displacement.")
      .def_property_readonly(
          "force", [](const PendulumLoop& loop) { return to_array(loop.force); },
          "F/W at each point of the path, on arrival.")
      .def_property_readonly(
          "corners",
          [](const PendulumLoop& loop) {
            std::vector<std::vector<double>> points;
            for (const auto& corner : loop.corners) points.push_back({corner.displacement, corner.force});
            return array_of_rows(points);
          },
          R"(Displacement [m] and F/W where the stiffness or the force changes, shape (corners, 2).

Straight lines between them are the loop. Where the force jumps there are two at one displacement.)")
      .def_property_readonly(
          "moving",
          [](const PendulumLoop& loop) {
            const auto corners = static_cast<py::ssize_t>(loop.corners.size());
            const auto surfaces = static_cast<py::ssize_t>(loop.surfaces.size());
            py::array_t<bool> moving({corners, surfaces});
            auto values = moving.mutable_unchecked<2>();
            for (py::ssize_t i = 0; i < corners; ++i)
              for (py::ssize_t k = 0; k < surfaces; ++k)
                values(i, k) = loop.corners[static_cast<std::size_t>(i)].moving >> k & 1;
            return moving;
          },
          R"(Which surfaces slide after each corner (bool), shape (corners, surfaces), from bottom to top.

At a turn of the path, and at its end, those that have slid up to there. A nested surface turns with the next outer one
while that slides.)")
      .def_property_readonly(
          "elements", [](const PendulumLoop& loop) { return motion_of(loop); },
          "The `ElementMotion` along the path; its samples are the points. Its work is for the weight g.")
      .def_property_readonly(
          "surfaces", [](const PendulumLoop& loop) { return SurfaceMotion{motion_of(loop)}; },
          "The `SurfaceMotion` along the path, from bottom to top; its samples are the points.")
      .def_property_readonly(
          "dissipated", [](const PendulumLoop& loop) { return to_array(loop.dissipated); },
          "Work against friction by each element, over the weight [m].")
      .def(
          "plot",
          [](const py::object& self, const py::object& ax, const py::object& title) {
            return py::module_::import("stickslip.plotting").attr("plot_pendulum_loop")(self, ax, title);
          },
          py::kw_only(), py::arg("ax") = py::none(), py::arg("title") = py::none(),
          R"(Plot force over weight against displacement, with the corners.

Needs matplotlib. Takes `ax`, matplotlib Axes to draw in, and `title`. Returns the axes or the figure, see
`stickslip.plotting.plot_pendulum_loop`.)")
      .def("__repr__", [](const PendulumLoop& loop) {
        double most = 0;
        for (const auto& corner : loop.corners) most = std::max(most, std::abs(corner.force));
        return "<PendulumLoop: " + std::to_string(loop.force.size()) + " points, largest F/W " + digits(most) + ">";
      });

  def_bearing(m, "DoublePendulum", 2, false,
              R"(A double friction pendulum with a jointed slider: two surfaces in series.

Parameters
----------
radii : array_like
    Effective radii of the lower and the upper surface [m].
mu : array_like
    Coefficients of friction.
capacities : array_like, optional
    Travel of each to its stop [m]; none if not given.
restitution : float, optional
    Of the impact where both are at their stops, from 0 to 1.

Returns
-------
MultiPendulum

Raises
------
ValueError
    As `MultiPendulum`.

Warns
-----
PlausibilityWarning
    As for `MultiPendulum`.)");
  def_bearing(m, "TriplePendulum", 3, true, R"(A triple friction pendulum: two outer surfaces, and an inner one twice.

Parameters
----------
radii : array_like
    Effective radii of the inner, the lower outer and the upper outer surface [m], finite; the inner one is the smallest.
mu : array_like
    Coefficients of friction; the inner one is the smallest.
capacities : array_like, optional
    Travel of each surface to its stop [m], the real one: a nominal capacity times effective over real radius. None if
    not given.
restitution : float, optional
    Of the impact where all are at their stops, from 0 to 1.

Returns
-------
MultiPendulum

Raises
------
ValueError
    As `MultiPendulum`.

Warns
-----
PlausibilityWarning
    As for `MultiPendulum`.)");
  def_bearing(m, "QuintuplePendulum", 5, true,
              R"(A quintuple friction pendulum: two outer and two middle surfaces, and an inner one twice.

Parameters
----------
radii : array_like
    Effective radii of the inner, the lower middle, the upper middle, the lower outer and the upper outer surface [m].
mu : array_like
    Coefficients of friction. Radii and friction grow outward in each half.
capacities : array_like, optional
    Travel of each surface to its stop [m]; none if not given.
restitution : float, optional
    Of the impact where all are at their stops, from 0 to 1.

Returns
-------
MultiPendulum

Raises
------
ValueError
    As `MultiPendulum`.

Warns
-----
PlausibilityWarning
    As for `MultiPendulum`.)");
}

}  // namespace stickslip::python
