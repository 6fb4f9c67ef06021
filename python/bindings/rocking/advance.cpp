#include <cmath>
#include <numbers>
#include <optional>
#include <string>

#include "rocking/rocking.hpp"
#include "stickslip/rocking/integrate.hpp"

namespace stickslip::python {
namespace {

template <class Block>
RockingState advanced(const Block& block, RockingState state, double dt, double start, std::optional<double> end,
                      double vertical_start, std::optional<double> vertical_end) {
  detail::require(std::isfinite(dt) && dt >= 0, "advance: dt must be finite and at least 0", dt, "s");
  advance(block, {dt, start, end.value_or(start), vertical_start, vertical_end.value_or(vertical_start)}, state);
  return state;
}

}  // namespace

void bind_rocking_advance(py::module_& m) {
  value_class<RockingState>(m, "RockingState", R"(State of a block that rocks, which determines its future motion.

Parameters
----------
rotation : float, optional
    theta [rad], below pi/2 in magnitude; positive about the right corner.
rate : float, optional
    theta' [rad/s]. With a rotation of 0 it is that just after an impact.

Raises
------
ValueError
    A value that is not finite, or a rotation of pi/2 or more.)")
      .def(py::init([](double rotation, double rate) {
             detail::require(std::abs(rotation) < std::numbers::pi / 2,
                             "RockingState: rotation must be below pi/2 in magnitude", rotation, "rad");
             detail::require(std::isfinite(rate), "RockingState: rate must be finite", rate, "rad/s");
             return RockingState::at(rotation, rate);
           }),
           py::arg("rotation") = 0.0, py::arg("rate") = 0.0)
      .def_readonly("rotation", &RockingState::rotation, "theta [rad].")
      .def_readonly("rate", &RockingState::rate, "theta' [rad/s].")
      .def_readonly(
          "displacement", &RockingState::displacement,
          "Of the base or the corner on the ground, in flight of the center of mass [m]; 0 of a `SlenderBlock`.")
      .def_readonly("velocity", &RockingState::velocity, "Its rate [m/s].")
      .def_property_readonly(
          "in_flight", [](const RockingState& state) { return state.mode == RockingMode::flight; },
          "Whether the block has left the ground.")
      .def_property_readonly(
          "slips", [](const RockingState& state) { return state.slip != 0; }, "Whether its base or its corner slips.")
      .def_property_readonly(
          "at_rest", [](const RockingState& state) { return state.mode == RockingMode::rest; },
          "Whether the block rests on its base.")
      .def_property_readonly(
          "overturned", [](const RockingState& state) { return side_name(state.overturned); },
          "Side to which the block has overturned, 'right' or 'left'; None if it has not.")
      .def("__repr__", [](const RockingState& state) {
        const auto side = side_name(state.overturned);
        return "<RockingState: theta " + digits(state.rotation) + " rad, theta' " + digits(state.rate) + " rad/s, " +
               (side                                ? "overturned to the " + *side
                : state.mode == RockingMode::rest   ? std::string("at rest")
                : state.mode == RockingMode::slide  ? std::string("sliding on its base")
                : state.mode == RockingMode::flight ? std::string("in flight")
                : state.mode == RockingMode::right  ? std::string("on the right corner")
                                                    : std::string("on the left corner")) +
               ">";
      });
  m.def(
      "advance", &advanced<SlenderBlock>, py::arg("slider"), py::arg("state"), py::arg("dt"), py::arg("start"),
      py::arg("end") = py::none(), py::kw_only(), py::arg("vertical_start") = 0.0, py::arg("vertical_end") = py::none(),
      R"(With a `SlenderBlock` and a `RockingState`, a block that rocks. g + vertical_start and g + vertical_end must be
positive. A block that lies on its side, at |theta| = pi/2, stays there. Returns a `RockingState`. Exact to round-off, like
`integrate`.)");
  m.def(
      "advance", &advanced<RockingBlock>, py::arg("slider"), py::arg("state"), py::arg("dt"), py::arg("start"),
      py::arg("end") = py::none(), py::kw_only(), py::arg("vertical_start") = 0.0, py::arg("vertical_end") = py::none(),
      R"(With a `RockingBlock` and a `RockingState`, a block that rocks, slides and flies; g + a_z may be negative. Returns a
`RockingState`. ConvergenceError where its friction decides nothing, see `RockingBlock`.)");
}

}  // namespace stickslip::python
