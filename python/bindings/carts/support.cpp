#include "stickslip/carts/support.hpp"

#include <cmath>
#include <optional>
#include <string>

#include "carts/carts.hpp"
#include "stickslip/friction/caster.hpp"

namespace stickslip::python {
namespace {

/// The arguments of a constructor by name; those at their default are left out.
class Arguments {
 public:
  explicit Arguments(Vector2 at) { given["at"] = std::pair(at.axis, at.transverse); }
  template <class T>
  Arguments& add(const char* name, const T& value) {
    given[name] = value;
    return *this;
  }
  template <class T>
  Arguments& add(const char* name, const std::optional<T>& value) {
    return value ? add(name, *value) : *this;
  }
  Arguments& add_unless_zero(const char* name, double value) {
    return value < 0 || value > 0 ? add(name, value) : *this;
  }

  py::dict given{};
};

py::dict arguments_of(const CasterAsGiven& one) {
  return Arguments(one.at)
      .add("heading", one.heading)
      .add("mu", one.mu)
      .add("trail", one.trail)
      .add("wheel_width", one.wheel_width)
      .add("slip_level", one.slip_level)
      .add("reach", one.reach)
      .add_unless_zero("rolling_mu", one.rolling_mu)
      .add("share", one.share)
      .add("lock", one.lock)
      .given;
}
py::dict arguments_of(const FixedWheel& one) {
  return Arguments(one.at)
      .add_unless_zero("heading", one.heading)
      .add("mu", one.mu)
      .add_unless_zero("rolling_mu", one.rolling_mu)
      .add("share", one.share)
      .given;
}
py::dict arguments_of(const Foot& one) { return Arguments(one.at).add("mu", one.mu).add("share", one.share).given; }

void check_place(const std::string& who, Vector2 at) {
  check_unit("length of a cart", who, "at[0]", std::abs(at.axis));
  check_unit("length of a cart", who, "at[1]", std::abs(at.transverse));
}

CasterAsGiven caster_of(const py::object& at, double heading, std::optional<double> mu, std::optional<double> trail,
                        std::optional<double> wheel_width, std::optional<double> slip_level,
                        std::optional<double> reach, double rolling_mu, std::optional<double> share,
                        const std::optional<std::string>& lock) {
  const std::string who = "SwivelCaster";
  if (lock && *lock != "wheel" && *lock != "both")
    throw std::invalid_argument(who + ": lock must be None, 'wheel' or 'both', got '" + *lock + "'");
  const bool wheel = mu && trail && (wheel_width || lock), any_wheel = mu || trail || wheel_width;
  const bool measured = slip_level && reach, any_measured = slip_level || reach;
  if (wheel == measured || (wheel ? any_measured : any_wheel))
    throw std::invalid_argument(who + ": give mu, trail and wheel_width, or slip_level and reach, and not both");
  if (lock && measured)
    throw std::invalid_argument(who +
                                ": a lock needs mu and trail, not the slip_level and reach of a wheel that rolls");
  const CasterAsGiven caster{
      to_vector2(at, who + ": at", "m"), heading, mu, trail, wheel_width, slip_level, reach, rolling_mu, share, lock};
  static_cast<void>(caster.support());
  check_place(who, caster.at);
  check_unit("heading", who, "heading", std::abs(heading));
  check_unit("coefficient of friction", who, "mu", mu);
  check_unit("length", who, "trail", trail);
  check_unit("length", who, "wheel_width", wheel_width);
  check_unit("slip level", who, "slip_level", slip_level);
  check_unit("length of a cart", who, "reach", reach);
  check_unit("coefficient of friction", who, "rolling_mu", rolling_mu);
  if (slip_level)
    detail::require(std::isfinite(*slip_level) && *slip_level >= 0, who + ": slip_level must be finite and at least 0",
                    *slip_level, "m/s^2");
  detail::check_support(who, caster.support());
  return caster;
}

/// What all supports have.
template <class Class>
Class& as_support(Class& type, const char* name) {
  using T = typename Class::type;
  type.def_property_readonly(
          "at", [](const T& one) { return std::pair(one.at.axis, one.at.transverse); },
          "Where it is, in the frame of the cart [m]: along its axis, and along the transverse direction.")
      .def_readonly("mu", &T::mu, "Coefficient of friction.")
      .def_readonly("share", &T::share, "Of the weight of the cart, as given.")
      .def(
          "_arguments", [](const T& one) { return arguments_of(one); },
          "Arguments of the constructor by name; those at their default are left out.")
      .def("__repr__", [name](const T& one) {
        std::string text;
        for (const auto& [key, value] : arguments_of(one))
          text += (text.empty() ? "" : ", ") + std::string(py::str(key)) + "=" +
                  (py::isinstance<py::float_>(value) ? literal(py::cast<double>(value))
                                                     : std::string(py::str(py::repr(value))));
        return std::string(name) + "(" + text + ")";
      });
  return type;
}

}  // namespace

Support CasterAsGiven::support() const {
  if (!lock) {
    SwivelCaster caster = mu ? SwivelCaster::from_geometry(at, heading, *mu, *trail, *wheel_width, rolling_mu)
                             : SwivelCaster::from_slip_level(at, heading, *slip_level, *reach, rolling_mu);
    caster.share = share;
    return caster;
  }
  detail::require(std::isfinite(*trail) && *trail > 0, "SwivelCaster: trail must be positive and finite", *trail, "m");
  if (*lock == "wheel") {
    SwivelCaster caster = SwivelCaster::with_locked_wheel(at, heading, *mu, *trail);
    caster.share = share;
    return caster;
  }
  Foot foot = Foot::of_locked_caster(at, heading, *mu, *trail);
  foot.share = share;
  return foot;
}

void bind_supports(py::module_& m) {
  auto caster =
      value_class<CasterAsGiven>(m, "SwivelCaster",
                                 R"(A wheel of a `Cart` that trails a pivot, about which it swivels without friction.

With V the velocity of the pivot, e the direction from the contact of the wheel to the pivot, n that direction turned by
+90 degrees, and N the load, psi' = V.n / reach and F = -(slip_level/g) N sgn(V.n) n - rolling_mu N sgn(V.e) e: a fixed
wheel whose direction follows a tractrix. Angles are positive from the axis of the cart toward the transverse direction,
which is 90 degrees clockwise from it as seen from above.

Parameters
----------
at : array_like, shape (2,)
    The pivot in the frame of the cart [m].
heading : float
    Direction of e at the start, relative to the cart [rad]: at 0 the wheel trails while the cart moves along its axis.
    The thesis counts the opposite direction.
mu : float, optional
    Coefficient of friction of wheel and floor, finite and at least 0. Give mu, trail and wheel_width, from which slip_level
    and reach follow as in `Caster.from_geometry`; or give slip_level and reach.
trail : float, optional
    From the pivot to the axis of the wheel [m], positive and finite.
wheel_width : float, optional
    Length of the line of contact [m], positive and finite; not needed with a lock.
slip_level : float, optional
    Friction across the wheel per unit mass that it carries [m/s^2], from a push across it; finite and at least 0.
reach : float, optional
    Distance over which the wheel aligns with its path [m]; positive, or infinite.
rolling_mu : float, optional
    Rolling resistance over the load, finite and at least 0; without effect with a lock.
share : float, optional
    Of the weight of the cart, at least 0; see `Cart`.
lock : {None, 'wheel', 'both'}, optional
    'wheel': the wheel does not roll, but swivels: a stick dragged behind the pivot. 'both': it does not swivel either: a
    `Foot` where it touches the floor, at the trail behind the pivot. A lock needs mu and trail.

Raises
------
ValueError
    Both or neither of the two groups; a lock without mu and trail; a value out of range.

Warns
-----
PlausibilityWarning
    A heading above 2 pi, which may be in degrees; a place or a reach of 20 m or more, a trail or a width of 3 m or more;
    a coefficient from 3 to 100; a slip level from 50 to 985 m/s^2.

Notes
-----
The mass of the wheel and the friction of its swivel are neglected. A real tread does not carry its load evenly over the
width: take slip_level and reach from a push test where there is one.)");
  caster.def(py::init(&caster_of), py::kw_only(), py::arg("at"), py::arg("heading"), py::arg("mu") = py::none(),
             py::arg("trail") = py::none(), py::arg("wheel_width") = py::none(), py::arg("slip_level") = py::none(),
             py::arg("reach") = py::none(), py::arg("rolling_mu") = 0.0, py::arg("share") = py::none(),
             py::arg("lock") = py::none());
  as_support(caster, "SwivelCaster")
      .def_readonly("heading", &CasterAsGiven::heading, "At the start, relative to the cart [rad].")
      .def_readonly("trail", &CasterAsGiven::trail, "From the pivot to the axis of the wheel [m], as given.")
      .def_readonly("wheel_width", &CasterAsGiven::wheel_width, "Length of the line of contact [m], as given.")
      .def_property_readonly(
          "slip_level",
          [](const CasterAsGiven& one) {
            const Support support = one.support();
            const auto* const swivel = std::get_if<SwivelCaster>(&support);
            return one.slip_level ? one.slip_level
                   : swivel       ? std::optional(swivel->side_mu * standard_gravity)
                                  : std::nullopt;
          },
          "Friction across the wheel per unit mass that it carries [m/s^2]; None if it is a foot.")
      .def_property_readonly(
          "reach",
          [](const CasterAsGiven& one) {
            const Support support = one.support();
            const auto* const swivel = std::get_if<SwivelCaster>(&support);
            return swivel ? std::optional(swivel->reach) : std::nullopt;
          },
          "Distance over which the wheel aligns with its path [m]; None if it is a foot.")
      .def_readonly("rolling_mu", &CasterAsGiven::rolling_mu, "Rolling resistance over the load.")
      .def_readonly("lock", &CasterAsGiven::lock, "None, 'wheel' or 'both'.");

  auto wheel = value_class<FixedWheel>(m, "FixedWheel", R"(A wheel of a `Cart` without swivel.

F = -mu N sgn(V.n) n - rolling_mu N sgn(V.d) d, with V the velocity of its contact, N its load, d its direction and n across
it. Its resistance to turning on the spot is left out.

Parameters
----------
at : array_like, shape (2,)
    Where it is, in the frame of the cart [m].
heading : float, optional
    Of its direction, relative to the cart [rad]; default: along the axis.
mu : float
    Coefficient of friction across the wheel, finite and at least 0.
rolling_mu : float, optional
    Rolling resistance over the load, finite and at least 0.
share : float, optional
    Of the weight of the cart, at least 0; see `Cart`.

Raises
------
ValueError
    A value out of range.

Warns
-----
PlausibilityWarning
    As for `SwivelCaster`.)");
  wheel.def(
      py::init([](const py::object& at, double heading, double mu, double rolling_mu, std::optional<double> share) {
        const FixedWheel one{to_vector2(at, "FixedWheel: at", "m"), heading, mu, rolling_mu, share};
        check_place("FixedWheel", one.at);
        check_unit("heading", "FixedWheel", "heading", std::abs(heading));
        check_unit("coefficient of friction", "FixedWheel", "mu", mu);
        check_unit("coefficient of friction", "FixedWheel", "rolling_mu", rolling_mu);
        detail::check_support("FixedWheel", one);
        return one;
      }),
      py::kw_only(), py::arg("at"), py::arg("heading") = 0.0, py::arg("mu"), py::arg("rolling_mu") = 0.0,
      py::arg("share") = py::none());
  as_support(wheel, "FixedWheel")
      .def_readonly("heading", &FixedWheel::heading, "Of its direction, relative to the cart [rad].")
      .def_readonly("rolling_mu", &FixedWheel::rolling_mu, "Rolling resistance over the load.");

  auto foot = value_class<Foot>(m, "Foot", R"(A support of a `Cart` that does not roll.

F = -mu N V/|V| while it slides with the velocity V under the load N; any |F| <= mu N at rest.

Parameters
----------
at : array_like, shape (2,)
    Where it is, in the frame of the cart [m].
mu : float
    Coefficient of friction, finite and at least 0.
share : float, optional
    Of the weight of the cart, at least 0; see `Cart`.

Raises
------
ValueError
    A value out of range.

Warns
-----
PlausibilityWarning
    As for `SwivelCaster`.)");
  foot.def(py::init([](const py::object& at, double mu, std::optional<double> share) {
             const Foot one{to_vector2(at, "Foot: at", "m"), mu, share};
             check_place("Foot", one.at);
             check_unit("coefficient of friction", "Foot", "mu", mu);
             detail::check_support("Foot", one);
             return one;
           }),
           py::kw_only(), py::arg("at"), py::arg("mu"), py::arg("share") = py::none());
  as_support(foot, "Foot");
}

}  // namespace stickslip::python
