#include "stickslip/structure/isolated_structure.hpp"

#include <pybind11/stl.h>

#include <cstddef>
#include <optional>
#include <string>

#include "structure/from_inputs.hpp"
#include "structure/structure.hpp"

namespace stickslip::python {

void bind_isolated_structure(py::module_& m) {
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
}

}  // namespace stickslip::python
