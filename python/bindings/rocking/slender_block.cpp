#include "stickslip/rocking/slender_block.hpp"

#include <optional>
#include <string>

#include "rocking/rocking.hpp"

namespace stickslip::python {
namespace {

/// A restitution, or nothing for that of Housner.
std::optional<double> restitution_of(const py::object& given) {
  if (py::isinstance<py::str>(given)) {
    if (const auto name = given.cast<std::string>(); name != "housner")
      throw std::invalid_argument("SlenderBlock: restitution must be a number from 0 to 1 or 'housner', got '" + name +
                                  "'");
    return std::nullopt;
  }
  return to_number(given, "SlenderBlock: restitution", "");
}

void check(const SlenderBlock& block) {
  check_unit("frequency parameter", "SlenderBlock", "p", block.p(), 1);
  check_unit("angle of a slender block", "SlenderBlock", "alpha", block.alpha_right(), 1);
  if (block.alpha_left() != block.alpha_right())
    check_unit("angle of a slender block", "SlenderBlock", "alpha_left", block.alpha_left(), 1);
}

SlenderBlock block_with(double p, double alpha, const py::object& restitution, std::optional<double> alpha_left) {
  const std::optional<double> given = restitution_of(restitution);
  if (!given && alpha_left && *alpha_left != alpha)
    throw std::invalid_argument(
        "SlenderBlock: restitution 'housner' is that of a block with equal sides; give a number with alpha_left");
  const double impact = given ? *given : housner_restitution(alpha);
  if (!given && alpha > 0 && impact < 0)
    throw std::invalid_argument("SlenderBlock: a block with alpha = " + detail::shortest(alpha) +
                                " rad is too squat to rock on after Housner's impacts; give a restitution from 0 to 1");
  const SlenderBlock block(p, alpha, alpha_left.value_or(alpha), impact);
  check(block);
  return block;
}

}  // namespace

void bind_slender_block(py::module_& m) {
  value_class<SlenderBlock>(m, "SlenderBlock", R"(A free-standing block that rocks: slender, and without slip.

theta'' = p^2 (G/g)(theta - s alpha) - p^2 n/g,  s = sgn(theta),  G = g + a_z;  Housner (1963).

theta is the rotation [rad], positive when the block tilts toward positive displacements about its right corner; n and
a_z are the horizontal and the upward ground acceleration. The block rests while -n <= alpha G and n <= alpha_left G. Where
theta passes zero, the base lands on the other corner, and the rate theta' is multiplied by the restitution. Beyond alpha
the block overturns, unless the ground moves back under it.

Parameters
----------
p : float
    Frequency parameter sqrt(m g R / I) [rad/s], positive: R is the distance from a corner to the center of mass, I the
    moment of inertia about the corner. sqrt(3 g / (4 R)) if uniform.
alpha : float
    Angle between the side and the line from the corner to the center of mass [rad], above 0 and below pi/2: its tangent
    is the width over the height, if uniform.
restitution : float or 'housner'
    Rate after an impact of the base over that before, from 0 to 1. 'housner': 1 - 3/2 sin^2 alpha, that of a uniform
    block, whose angular momentum about the new corner is conserved. Tests on concrete gave 0.95 to 0.97 of it or more:
    give a measured value, if there is one.
alpha_left : float, optional
    alpha of the left corner [rad], about which theta is negative, if the center of mass is not above the middle of the
    base; default: alpha. p and the restitution remain the same on both sides.

Raises
------
ValueError
    A value out of range; 'housner' with sides that differ.

Warns
-----
PlausibilityWarning
    An alpha above 0.35, beyond which large angles matter; a p outside 0.5 to 12 rad/s.

Notes
-----
Beside a rigid block with large angles, theta/alpha differs by 2e-3, 5e-4 and 5e-5 at alpha = 0.03, 0.01 and 0.003 after
seven impacts, and by percents at 0.15. A single history may be chaotic; see `RockingResponse.margin` and `condition`.)")
      .def(py::init(&block_with), py::kw_only(), py::arg("p"), py::arg("alpha"), py::arg("restitution"),
           py::arg("alpha_left") = py::none())
      .def_static(
          "from_size",
          [](double width, double height, const py::object& restitution) {
            SlenderBlock block = SlenderBlock::from_size(width, height, restitution_of(restitution));
            if (!plausible_range("frequency parameter").holds(block.p()))
              warn_of_unit("SlenderBlock.from_size: " + implausibility("frequency parameter", "p", block.p()) +
                           "; width and height are those of the whole block, in m");
            check_unit("angle of a slender block", "SlenderBlock.from_size", "alpha", block.alpha(), 1);
            return block;
          },
          py::kw_only(), py::arg("width"), py::arg("height"), py::arg("restitution") = "housner",
          R"(A uniform block of a width and a height.

p = sqrt(3 g / (4 R)), R = sqrt(width^2 + height^2)/2, tan(alpha) = width/height.

Parameters
----------
width, height : float
    Of the whole block [m], positive.
restitution : float or 'housner', optional
    As for `SlenderBlock`; default: 'housner'.

Returns
-------
SlenderBlock

Raises
------
ValueError
    A value out of range; a block too squat for Housner's impacts, width >= sqrt(2) height.

Warns
-----
PlausibilityWarning
    As for `SlenderBlock`: a size that looks like half of it, or is in mm.)")
      .def_property_readonly("p", &SlenderBlock::p, "Frequency parameter [rad/s].")
      .def_property_readonly("alpha", &SlenderBlock::alpha_right, "alpha of the right corner [rad].")
      .def_property_readonly("alpha_left", &SlenderBlock::alpha_left, "alpha of the left corner [rad].")
      .def_property_readonly("restitution", &SlenderBlock::restitution,
                             "Rate after an impact of the base over that before.")
      .def("period", &SlenderBlock::period, py::arg("rotation"),
           R"(Period of free rocking between impacts that lose nothing.

(4/p) arcosh(1/(1 - rotation/alpha)) with equal sides, Housner (1963). It grows with the amplitude, to infinity at alpha.

Parameters
----------
rotation : float
    Amplitude [rad]: positive to the right, negative to the left, not zero.

Returns
-------
float
    [s].

Raises
------
ValueError
    An amplitude with which the block would overturn on one side.)")
      .def("__repr__", [](const SlenderBlock& block) {
        return "SlenderBlock(p=" + literal(block.p()) + ", alpha=" + literal(block.alpha_right()) +
               ", restitution=" + literal(block.restitution()) +
               (block.alpha_left() == block.alpha_right() ? "" : ", alpha_left=" + literal(block.alpha_left())) + ")";
      });
}

}  // namespace stickslip::python
