#include "stickslip/carts/cart.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "carts/carts.hpp"
#include "in_python.hpp"

namespace stickslip::python {
namespace {

std::vector<Support> supports_of(const std::vector<SupportAsGiven>& given) {
  std::vector<Support> supports;
  for (const SupportAsGiven& one : given)
    supports.push_back(std::visit(
        [](const auto& support) -> Support {
          if constexpr (requires { support.support(); })
            return support.support();
          else
            return support;
        },
        one));
  return supports;
}

CartAsGiven cart_of(const py::iterable& supports, double radius_of_gyration,
                    std::optional<std::pair<double, double>> center, const py::object& outline) {
  std::vector<SupportAsGiven> given;
  for (const py::handle one : supports) {
    if (!py::isinstance<CasterAsGiven>(one) && !py::isinstance<FixedWheel>(one) && !py::isinstance<Foot>(one))
      throw py::type_error("Cart: support " + std::to_string(given.size()) +
                           " must be a SwivelCaster, a FixedWheel or a Foot, got " +
                           py::type::of(one).attr("__name__").cast<std::string>());
    given.push_back(one.cast<SupportAsGiven>());
  }
  std::vector<Vector2> corners;
  if (!outline.is_none()) {
    const Numbers numbers = to_numbers(outline, "Cart: outline", "m");
    if (numbers.ndim() != 2 || numbers.shape(1) != 2)
      throw std::invalid_argument("Cart: outline must be corners, an array of shape (C, 2), got the shape " +
                                  py::str(numbers.attr("shape")).cast<std::string>());
    for (py::ssize_t i = 0; i < numbers.shape(0); ++i) corners.push_back({numbers.at(i, 0), numbers.at(i, 1)});
  }
  CartAsGiven cart(std::move(given), radius_of_gyration, center, std::move(corners));
  check_unit("length of a cart", "Cart", "radius_of_gyration", radius_of_gyration);
  std::vector<double> places;
  for (const Vector2& corner : cart.outline)
    places.insert(places.end(), {std::abs(corner.axis), std::abs(corner.transverse)});
  check_unit("length of a cart", "Cart", "outline", places);
  return cart;
}

std::vector<double> headings_of(const py::object& given) { return to_vector(given, "Cart: headings", "rad"); }

CartAsGiven with_headings(const CartAsGiven& cart, const py::object& given) {
  const std::vector<double> headings = headings_of(given);
  static_cast<void>(cart.cart().with_headings(headings));  // checks them
  std::vector<SupportAsGiven> supports = cart.supports;
  std::size_t next = 0;
  for (SupportAsGiven& one : supports)
    if (auto* caster = std::get_if<CasterAsGiven>(&one); caster && caster->swivels())
      caster->heading = headings[next++];
  return {std::move(supports), cart.radius_of_gyration, cart.center, cart.outline};
}

/// The arguments by name but the supports; those at their default are left out.
py::dict arguments_of(const CartAsGiven& cart) {
  py::dict given;
  given["radius_of_gyration"] = cart.radius_of_gyration;
  if (cart.center) given["center"] = *cart.center;
  if (!cart.outline.empty()) {
    py::list corners;
    for (const Vector2& corner : cart.outline) corners.append(std::pair(corner.axis, corner.transverse));
    given["outline"] = corners;
  }
  return given;
}

}  // namespace

CartAsGiven::CartAsGiven(std::vector<SupportAsGiven> given, double radius,
                         std::optional<std::pair<double, double>> place, std::vector<Vector2> corners)
    : supports(std::move(given)),
      radius_of_gyration(radius),
      center(place),
      outline(std::move(corners)),
      cart_(supports_of(supports), radius_of_gyration,
            center ? std::optional(Vector2{center->first, center->second}) : std::nullopt, outline) {}

void bind_cart(py::module_& m) {
  value_class<CartAsGiven>(m, "Cart",
                           R"(A rigid cart on swivel casters, fixed wheels and feet, which moves in the plane and turns.

y' = (-a_x, -a_y, 0) - sum over supports of their friction, with y = (x', y', k phi'): (x, y) is the displacement of the center
of mass relative to the ground, along the axis of the ground motion and along its transverse direction, which is 90 degrees
clockwise from the axis as seen from above; phi is the yaw, positive from the axis toward the transverse direction, and k
the radius of gyration. The loads are the shares of the weight times max(g + a_z, 0)/g.

Parameters
----------
supports : sequence of SwivelCaster, FixedWheel or Foot
    At least 1. Their `share` is given for all of them, with the sum 1, or for none.
radius_of_gyration : float
    k, about the center of mass [m], positive and finite.
center : (float, float), optional
    Center of mass in the frame of the supports [m]. Default: the origin, or what shares imply; shares and center must
    agree. Without shares they are those of equal stiffness (least squares), which must not be negative.
outline : array_like, shape (C, 2), optional
    Corners whose motion is watched, in the same frame [m]; default: the supports.

Raises
------
ValueError
    A value out of range, which names the support by its number, from 0; a share that would be negative.
TypeError
    A support of another type.

Warns
-----
PlausibilityWarning
    A radius of gyration or a corner of 20 m or more.

Notes
-----
Left out: the friction of a swivel; the shift of the loads as wheels swivel and by overturning moments; yaw of the ground;
springs, stops and walls in the motion. Static friction is that of sliding.

Examples
--------
>>> import stickslip as ss
>>> wheel = dict(mu=0.5, trail=0.04, wheel_width=0.032, rolling_mu=0.01)
>>> cart = ss.Cart(
...     [ss.SwivelCaster(at=(x, y), heading=0.3, **wheel) for x in (-0.4, 0.4) for y in (-0.3, 0.3)],
...     radius_of_gyration=0.35,
... )
>>> cart.casters
4)")
      .def(py::init(&cart_of), py::arg("supports"), py::kw_only(), py::arg("radius_of_gyration"),
           py::arg("center") = py::none(), py::arg("outline") = py::none())
      .def_property_readonly(
          "supports", [](const CartAsGiven& cart) { return py::tuple(py::cast(cart.supports)); }, "As given.")
      .def_property_readonly(
          "shares", [](const CartAsGiven& cart) { return array_of(cart.cart().shares()); },
          "Of the weight, for each support; their sum is 1.")
      .def_property_readonly(
          "outline", [](const CartAsGiven& cart) { return array_of(cart.cart().outline()); },
          "Corners whose motion is watched [m], shape (C, 2).")
      .def_property_readonly(
          "center",
          [](const CartAsGiven& cart) { return std::pair(cart.cart().center().axis, cart.cart().center().transverse); },
          "Center of mass [m].")
      .def_property_readonly(
          "casters", [](const CartAsGiven& cart) { return cart.cart().casters(); },
          "Number of casters that swivel: those with lock='both' do not count.")
      .def_readonly("radius_of_gyration", &CartAsGiven::radius_of_gyration, "k, about the center of mass [m].")
      .def(
          "holds",
          [](const CartAsGiven& cart, const py::object& direction, const py::object& headings) {
            const std::vector<double> turned = headings.is_none() ? std::vector<double>() : headings_of(headings);
            const Vector2 along = to_vector2(direction, "Cart.holds: direction");
            return (headings.is_none() ? cart.cart() : cart.cart().with_headings(turned)).holds(along);
          },
          py::arg("direction"), py::arg("headings") = py::none(),
          R"(The largest acceleration of level ground along a direction under which the cart stays at rest.

Parameters
----------
direction : array_like, shape (2,)
    In the frame of the cart, not zero.
headings : array_like, shape (casters,), optional
    Of the casters [rad]; default: those of the cart.

Returns
-------
float
    Acceleration [m/s^2].

Raises
------
ValueError
    A direction that is zero or not finite; another number of headings.)")
      .def("with_headings", &with_headings, py::arg("headings"),
           R"(The same cart with other headings of its casters at the start.

Parameters
----------
headings : array_like, shape (casters,)
    Of the casters that swivel, in the order of the supports [rad].

Returns
-------
Cart

Raises
------
ValueError
    Another number of headings; a heading that is not finite.)")
      .def("with_random_headings", in_python("stickslip.ensemble.random_headings", "RandomHeadings"),
           R"(Carts for `run_ensemble` and `sweep`, whose casters have independent headings uniform over the circle.

Casters that do not swivel (lock='both') stay as they are.

Returns
-------
RandomHeadings
    A `Random` with a `Uniform` parameter `heading_i` for the caster that is support i.

Raises
------
ValueError
    A cart without casters that swivel.)")
      .def("_arguments", &arguments_of,
           "Arguments of the constructor by name but the supports; those at their default are left out.")
      .def("to_json", in_python("stickslip.carts.files", "to_json"),
           R"(The arguments of the cart and its supports as JSON; `from_json` reads it.

Returns
-------
str)")
      .def_static(
          "from_json",
          [](const py::object& source) {
            return py::module_::import("stickslip.carts.files").attr("from_json")(source).cast<CartAsGiven>();
          },
          py::arg("source"),
          R"(A cart from JSON.

Parameters
----------
source : str or path-like
    A text that begins with '{', or a file: an object with the arguments of `Cart`, in which each support is an object
    with `kind`, 'SwivelCaster', 'FixedWheel' or 'Foot', and the arguments of that class.

Returns
-------
Cart

Raises
------
ValueError
    A text that is not such an object; a name that no argument has; a value that a constructor rejects.
OSError
    The file cannot be read.)")
      .def("__repr__", [](const CartAsGiven& cart) {
        std::string text = "Cart(" + std::string(py::str(py::repr(py::cast(cart.supports))));
        for (const auto& [name, value] : arguments_of(cart))
          text += ", " + std::string(py::str(name)) + "=" + std::string(py::str(py::repr(value)));
        return text + ")";
      });
}

}  // namespace stickslip::python
