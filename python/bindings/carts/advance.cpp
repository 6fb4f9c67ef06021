#include <cmath>
#include <optional>
#include <string>

#include "carts/carts.hpp"

namespace stickslip::python {
namespace {

CartState advanced(const CartAsGiven& cart, CartState state, double dt, const py::object& start, const py::object& end,
                   double vertical_start, std::optional<double> vertical_end) {
  detail::require(std::isfinite(dt) && dt >= 0, "advance: dt must be finite and at least 0", dt, "s");
  const Vector2 first = to_vector2(start, "advance: start", "m/s^2");
  advance(cart.cart(),
          {dt, first, end.is_none() ? first : to_vector2(end, "advance: end", "m/s^2"), vertical_start,
           vertical_end.value_or(vertical_start)},
          state);
  return state;
}

CartState state_of(const py::object& displacement, double yaw, const py::object& velocity, double yaw_rate,
                   const py::object& headings) {
  CartState state{to_vector2(displacement, "CartState: displacement", "m"), yaw,
                  to_vector2(velocity, "CartState: velocity", "m/s"), yaw_rate,
                  headings.is_none() ? std::vector<double>() : to_vector(headings, "CartState: headings", "rad")};
  const auto finite = [](const char* name, double value, const char* unit) {
    detail::require(std::isfinite(value), std::string("CartState: ") + name + " must be finite", value, unit);
  };
  for (const double value : {state.displacement.axis, state.displacement.transverse})
    finite("displacement", value, "m");
  for (const double value : {state.velocity.axis, state.velocity.transverse}) finite("velocity", value, "m/s");
  finite("yaw", yaw, "rad");
  finite("yaw_rate", yaw_rate, "rad/s");
  for (const double value : state.headings) finite("headings", value, "rad");
  if (norm(state.velocity) > 0 || yaw_rate < 0 || yaw_rate > 0) state.mode = CartMode::moving;
  return state;
}

}  // namespace

void bind_cart_advance(py::module_& m) {
  value_class<CartState>(m, "CartState", R"(State of a cart, which determines its future motion.

Parameters
----------
displacement : array_like, shape (2,), optional
    Of the center of mass relative to the ground, along the axis and along the transverse direction [m].
yaw : float, optional
    phi, positive from the axis toward the transverse direction [rad].
velocity : array_like, shape (2,), optional
    Of the center of mass [m/s].
yaw_rate : float, optional
    phi' [rad/s].
headings : array_like, shape (casters,), optional
    Of the casters, relative to the cart [rad]; default: those of the cart.

Raises
------
ValueError
    A value that is not finite.)")
      .def(py::init(&state_of), py::arg("displacement") = py::make_tuple(0.0, 0.0), py::arg("yaw") = 0.0,
           py::arg("velocity") = py::make_tuple(0.0, 0.0), py::arg("yaw_rate") = 0.0, py::arg("headings") = py::none())
      .def_property_readonly(
          "displacement", [](const CartState& s) { return array_of(s.displacement); },
          "Of the center of mass [m], shape (2,).")
      .def_readonly("yaw", &CartState::yaw, "phi [rad].")
      .def_property_readonly(
          "velocity", [](const CartState& s) { return array_of(s.velocity); },
          "Of the center of mass [m/s], shape (2,).")
      .def_readonly("yaw_rate", &CartState::yaw_rate, "phi' [rad/s].")
      .def_property_readonly(
          "headings", [](const CartState& s) { return array_of(s.headings); },
          "Of the casters, relative to the cart [rad]; empty: those of the cart.")
      .def_property_readonly(
          "at_rest", [](const CartState& s) { return s.mode == CartMode::rest; }, "Whether the cart is at rest.")
      .def("__repr__", [](const CartState& s) {
        return "<CartState: " + digits(s.displacement) + " m, yaw " + digits(s.yaw) + " rad, " +
               (s.mode == CartMode::rest ? std::string("at rest")
                                         : digits(s.velocity) + " m/s, " + digits(s.yaw_rate) + " rad/s") +
               ">";
      });
  m.def(
      "advance", &advanced, py::arg("slider"), py::arg("state"), py::arg("dt"), py::arg("start"),
      py::arg("end") = py::none(), py::kw_only(), py::arg("vertical_start") = 0.0, py::arg("vertical_end") = py::none(),
      R"(With a `Cart` and a `CartState`, `start` and `end` are the two horizontal components of the ground acceleration, as
with a `PlanarSlider`. Returns a `CartState`. As accurate as `integrate`.)");
}

}  // namespace stickslip::python
