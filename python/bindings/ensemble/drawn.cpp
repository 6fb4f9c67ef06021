#include "drawn.hpp"

#include "parts.hpp"
#include "stickslip/ensemble/one_of.hpp"

namespace stickslip::python {

template <>
inline constexpr auto parts<Drawn> = std::tuple(&Drawn::items);

void bind_drawn(py::module_& m) {
  value_class<Drawn>(m, "Drawn",
                     R"(A list from which each member of an ensemble takes a random item, with equal probability.

`run_ensemble` accepts it for ground motions and for sliders. (seed, member) determines the item; sliders and motions
are drawn independently of each other.

Parameters
----------
items : iterable of GroundMotion, or of Slider, Coulomb and Caster
    At least one.

Raises
------
ValueError
    No items.)")
      .def(py::init([](const py::iterable& items) {
             Drawn drawn{py::tuple(items)};
             if (drawn.items.empty())
               throw std::invalid_argument("Drawn: items must hold at least one, got an empty list");
             return drawn;
           }),
           py::arg("items"))
      .def_property_readonly(
          "items", [](const Drawn& self) { return self.items; }, "The items, as a tuple.")
      .def(
          "sample",
          [](const Drawn& self, std::uint64_t seed, std::uint64_t member) -> py::object {
            return self.items[detail::drawn_place(seed, member, is_of_motions(self.items), self.items.size())];
          },
          py::kw_only(), py::arg("seed"), py::arg("member"),
          R"(The item of a member.

Parameters
----------
seed, member : int
    From 0 to 2^64 - 1.

Returns
-------
GroundMotion or slider)")
      .def("__len__", [](const Drawn& self) { return self.items.size(); })
      .def("__repr__", [](const Drawn& self) {
        return "<Drawn: one of " + std::to_string(self.items.size()) + (is_of_motions(self.items) ? " motions" : "") +
               ">";
      });
}

}  // namespace stickslip::python
