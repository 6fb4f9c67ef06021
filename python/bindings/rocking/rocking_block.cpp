#include "stickslip/rocking/rocking_block.hpp"

#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "rocking/rocking.hpp"

namespace stickslip::python {
namespace {

RockingBlock block_of(double width, double height, std::optional<double> mu, const py::object& restitution,
                      std::optional<double> lever, std::optional<std::pair<double, double>> center,
                      std::optional<double> gyration_radius, double corner_restitution) {
  if (!(corner_restitution >= 0 && corner_restitution <= 0))
    throw std::invalid_argument("RockingBlock: corner_restitution must be 0, got " +
                                detail::shortest(corner_restitution) +
                                ": corners that bounce create energy where they slip and make histories chaotic; "
                                "restitution and lever are those of "
                                "the base");
  std::optional<double> given;
  if (py::isinstance<py::str>(restitution)) {
    if (const auto name = restitution.cast<std::string>(); name != "housner")
      throw std::invalid_argument("RockingBlock: restitution must be a number from 0 to 1 or 'housner', got '" + name +
                                  "'");
  } else {
    given = to_number(restitution, "RockingBlock: restitution", "");
  }
  RockingBlock block({width, height, mu, given, lever, center, gyration_radius});
  const double p = std::min(block.p_right(), block.p_left());
  if (!plausible_range("frequency parameter").holds(p))
    warn_of_unit("RockingBlock: " + implausibility("frequency parameter", "p", p) +
                 "; width and height are those of the whole block, in m");
  if (mu) {
    check_unit("coefficient of friction", "RockingBlock", "mu", *mu, 1);
    if (*mu > block.painleve_friction())
      warn_of_unit(
          "RockingBlock: mu = " + digits(*mu) + " is above " + digits(block.painleve_friction()) +
          ", up to which friction always decides the motion (Painleve); a motion that meets the paradox raises "
          "ConvergenceError. Without mu the block never slips");
  }
  return block;
}

}  // namespace

void bind_rocking_block(py::module_& m) {
  value_class<RockingBlock>(m, "RockingBlock",
                            R"(A free-standing rigid block: it rocks, slides, leaves the ground and falls.

Large rotations theta, positive about the right corner; Coulomb friction at the base and its corners; plastic impacts. The
block rests, slides on its base, rocks about a corner that sticks or slips, or is in flight.

Parameters
----------
width, height : float
    Of the whole block [m], positive.
mu : float, optional
    Coefficient of friction, at least 0; default: it never slips.
restitution : float or 'housner', optional
    Rate theta' after an impact of the base without slip over that before, from 0 to 1. Default: 'housner', what the law of
    impacts gives, for a uniform block 1 - 3/2 sin^2 alpha. Give a measured value, if there is one: results depend on it
    more than on anything else. Where the corner slips it cannot hold, see `RockingResponse.impacts_with_slip`.
lever : float, optional
    The same otherwise: where the impulse acts, over the distance from the foot of the center of mass to the corner on
    which the block goes on; 1 is Housner's impact, 0 loses nothing. At least 0; not with `restitution`.
center : (float, float), optional
    Center of mass: its distance to the right of the middle of the base, and its height [m]; within the block. Default:
    (0, height/2).
gyration_radius : float, optional
    About the center of mass [m], positive. Default: that of a uniform block, sqrt((width^2 + height^2)/12).
corner_restitution : float, optional
    Must be 0: corners do not bounce.

Raises
------
ValueError
    A value out of range.

Warns
-----
PlausibilityWarning
    mu above `painleve_friction`; a size that looks like half of it, or is in mm.

Notes
-----
An arriving corner stops, and its impulse lies within Coulomb's cone (Moreau). Where the base lands, the impulse acts at one
corner alone if the other then leaves; else rocking stops: a block wider than sqrt(2) times its height does not rock on.)")
      .def(py::init(&block_of), py::kw_only(), py::arg("width"), py::arg("height"), py::arg("mu") = py::none(),
           py::arg("restitution") = "housner", py::arg("lever") = py::none(), py::arg("center") = py::none(),
           py::arg("gyration_radius") = py::none(), py::arg("corner_restitution") = 0.0)
      .def_property_readonly("width", &RockingBlock::width, "Of the base [m].")
      .def_property_readonly("height", &RockingBlock::height, "Of the block [m].")
      .def_property_readonly(
          "mu", [](const RockingBlock& b) { return b.size().mu; },
          "Coefficient of friction; None if the block never slips.")
      .def_property_readonly("restitution", &RockingBlock::restitution_right,
                             R"(Rate after an impact onto the right corner over that before, without slip.

0 if the block then stops rocking.)")
      .def_property_readonly("restitution_left", &RockingBlock::restitution_left, "The same onto the left corner.")
      .def_property_readonly("lever", &RockingBlock::lever_right, "Of impacts onto the right corner.")
      .def_property_readonly(
          "center", [](const RockingBlock& b) { return std::pair((b.left() - b.right()) / 2, b.center_height()); },
          "Center of mass: distance to the right of the middle of the base, and height [m].")
      .def_property_readonly(
          "gyration_radius", [](const RockingBlock& b) { return std::sqrt(b.gyration_square()); },
          "About the center of mass [m].")
      .def_property_readonly("p", &RockingBlock::p_right,
                             "Frequency parameter sqrt(m g R / I) about the right corner [rad/s].")
      .def_property_readonly("p_left", &RockingBlock::p_left, "The same about the left corner [rad/s].")
      .def_property_readonly("alpha", &RockingBlock::alpha_right,
                             "Angle between the side and the line from the right corner to the center of mass [rad].")
      .def_property_readonly("alpha_left", &RockingBlock::alpha_left, "The same of the left corner [rad].")
      .def_property_readonly("painleve_friction", &RockingBlock::painleve_friction,
                             R"(Coefficient of friction below which the motion is always determined.

2 sqrt(kappa (1 + kappa)), kappa = (gyration radius / R)^2; 4/3 if uniform. With a larger mu the paradox of Painleve may be
met, where no motion or several satisfy Coulomb's law: then ConvergenceError says so.)")
      .def("__repr__", [](const RockingBlock& b) {
        const RockingBlockSize& size = b.size();
        std::string text = "RockingBlock(width=" + literal(size.width) + ", height=" + literal(size.height);
        const auto add = [&](const char* name, const std::optional<double>& value) {
          if (value) text += std::string(", ") + name + "=" + literal(*value);
        };
        add("mu", size.mu);
        add("restitution", size.restitution);
        add("lever", size.lever);
        if (size.center) text += ", center=(" + literal(size.center->first) + ", " + literal(size.center->second) + ")";
        add("gyration_radius", size.gyration_radius);
        return text + ")";
      });
}

}  // namespace stickslip::python
