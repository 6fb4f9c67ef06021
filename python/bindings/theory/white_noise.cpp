#include "stickslip/theory/white_noise.hpp"

#include "parts.hpp"
#include "stickslip/theory/stationary_velocity.hpp"
#include "theory/theory.hpp"

namespace stickslip::python {

template <>
inline constexpr auto parts<theory::StationaryVelocity> = std::tuple(&theory::StationaryVelocity::slider,
                                                                     &theory::StationaryVelocity::s0);

namespace {

using theory::StationaryVelocity;
using theory::WhiteNoise;

auto by_one(const char* name, double (WhiteNoise::*f)(double) const) {
  return [name = std::string("WhiteNoise: ") + name, f](const WhiteNoise& self, const py::object& values) {
    return of_each(values, name, [&](double value) { return (self.*f)(value); });
  };
}

WhiteNoise of_slider(const AnySlider& slider, const AnyNoise& s0, int dimensions) {
  const auto* const coulomb = std::get_if<Slider<Coulomb>>(&slider);
  if (coulomb == nullptr) throw py::type_error("WhiteNoise: covers Coulomb friction without a spring, got a Caster");
  return {*coulomb, white_level(s0), dimensions};
}

void bind_stationary_velocity(py::module_& m) {
  value_class<StationaryVelocity>(m, "StationaryVelocity", R"(The stationary velocity under white noise, exactly.

Of a slider whose friction depends on its speed alone, with or without a damper. The velocity is a diffusion in a
potential, dv = -f(v) dt + sqrt(2 D) dW, D = pi S0, U' = f, p(v) ~ exp(-U(v) / D), where f is the resistance with the sign
of v. The variance of x grows at (2 / D) int G(v)^2 / p(v) dv, G(v) = int_v^inf (u - mean) p(u) du. For Coulomb friction
these are the values of `WhiteNoise`.

Parameters
----------
slider : Slider or friction law
    Friction that is constant or depends on the speed alone, on level ground, without spring and stops; a damper is
    optional, one-way sliding too. Static friction above kinetic has no effect under white noise: give the kinetic law.
s0 : float, Spectrum or GaussianExcitation
    Level S0 of the white ground acceleration, two-sided [m^2/s^3], positive and finite; or a white spectrum or
    excitation.

Raises
------
ValueError
    Another slider; friction that does not bound the velocity; s0 out of range, noise that is not white.

Notes
-----
Accurate to some 1e-13; takes some milliseconds, and 1 us for a density.

References
----------
H. Risken, The Fokker-Planck Equation (1989), 5.2; dry and viscous friction: H. Touchette, T. Prellberg, W. Just, J. Phys.
A 45 (2012), 395002.)")
      .def(py::init(
               [](const AnySlider& slider, const AnyNoise& s0) { return StationaryVelocity(slider, white_level(s0)); }),
           py::arg("slider"), py::arg("s0"))
      .def_property_readonly("slider", &StationaryVelocity::slider, "The slider.")
      .def_property_readonly("s0", &StationaryVelocity::s0, "Level of the white noise [m^2/s^3].")
      .def_property_readonly("mean", &StationaryVelocity::mean, "Mean velocity, the drift [m/s].")
      .def_property_readonly("mean_speed", &StationaryVelocity::mean_speed, "Mean of |v| [m/s].")
      .def_property_readonly("variance", &StationaryVelocity::variance, "Variance of the velocity [m^2/s^2].")
      .def_property_readonly("growth_rate", &StationaryVelocity::growth_rate,
                             "Growth of the variance of the displacement [m^2/s].")
      .def(
          "density",
          [](const StationaryVelocity& self, const py::object& velocity) {
            return of_each(velocity, "StationaryVelocity: velocity", [&](double v) { return self.density(v); });
          },
          py::arg("velocity"),
          R"(Probability density of the velocity.

Parameters
----------
velocity : array_like
    Velocities [m/s].

Returns
-------
float or numpy.ndarray
    Density [s/m], of the shape of velocity.)")
      .def("__repr__", [](const StationaryVelocity& self) {
        return "StationaryVelocity(" + py::repr(py::cast(self.slider())).cast<std::string>() +
               ", s0=" + detail::shortest(self.s0()) + ")";
      });
}

}  // namespace

void bind_white_noise(py::module_& m) {
  bind_stationary_velocity(m);
  auto type =
      value_class<WhiteNoise>(m, "WhiteNoise", R"(Coulomb friction without a spring under white noise, exactly.

The velocity is a diffusion toward rest: dv = -a sgn(v) dt + sqrt(2 D) dW, D = pi S0, dx = v dt, thesis (3.48), (3.49);
with a different a in each direction for unequal levels. There is no known exact solution for other laws, or with a
spring.

In d dimensions (2: a block on a plane) friction opposes the velocity vector, and white noise of level S0 acts in each
coordinate, independently of the others: dv = -a v / |v| dt + sqrt(2 D) dW. The distribution is the same in all
directions: coordinates are uncorrelated, and means, variances, covariances, densities and spectra are those of each
coordinate.

Parameters
----------
slider : Slider or Coulomb, optional
    Coulomb friction; the two levels may differ. With an infinite backward level it never slides backward. Default: a
    slip level of 1 m/s^2.
s0 : float, Spectrum or GaussianExcitation, optional
    Level S0 of the white ground acceleration, two-sided, R(t) = 2 pi S0 delta(t) [m^2/s^3], positive and finite; or a
    white spectrum or excitation. Default: 1.
dimensions : int, optional
    Number of dimensions, from 1 to 6. In more than one, the levels must be equal.

Raises
------
ValueError
    s0 or dimensions out of range, noise that is not white, a spring, unequal levels in more than one dimension.
TypeError
    Another law.

Notes
-----
If one level is 0 the velocity is not stationary: stationary values are infinite, transient ones remain right. Values at
a time are for a start from rest. The relative error is at most 1e-12; each time takes about 3 us in one dimension, 100
us in more. In two and more dimensions the velocity never returns to zero, so that the block does not stick.

References
----------
T. K. Caughey, J. K. Dienes, J. Appl. Phys. 32 (1961), 2476-2479; I. Karatzas, S. E. Shreve, Ann. Probab. 12 (1984),
819-828; transforms by the contour of J. A. C. Weideman, SIAM J. Numer. Anal. 44 (2006), 2342-2362. The page on white
noise in the plane derives the results in more dimensions.)")
          .def(py::init([](int dimensions) { return WhiteNoise(Coulomb(1), 1.0, dimensions); }), py::kw_only(),
               py::arg("dimensions") = 1)
          .def(py::init(&of_slider), py::arg("slider"), py::arg("s0"), py::kw_only(), py::arg("dimensions") = 1)
          .def_static(
              "coulomb",
              [](double slip_level, const AnyNoise& s0, int dimensions) {
                return WhiteNoise::coulomb(slip_level, white_level(s0), dimensions);
              },
              py::arg("slip_level"), py::arg("s0"), py::kw_only(), py::arg("dimensions") = 1,
              R"(Construct the theory for equal slip levels in all directions.

Parameters
----------
slip_level : float
    a [m/s^2], finite and at least 0.
s0 : float, Spectrum or GaussianExcitation
    As above.
dimensions : int, optional
    As above.)")
          .def_property_readonly("law", &WhiteNoise::law, "The friction law.")
          .def_property_readonly("s0", &WhiteNoise::s0, "Level of the white noise [m^2/s^3].")
          .def_property_readonly("dimensions", &WhiteNoise::dimensions, "Number of dimensions of the motion.")
          .def_property_readonly(
              "mean", &WhiteNoise::mean,
              "Stationary mean velocity, the drift: D / a - D / b [m/s], where a and b are the levels against "
              "forward and backward sliding; 0 in more than one dimension.")
          .def_property_readonly("mean_speed", &WhiteNoise::mean_speed,
                                 "Stationary mean of the speed |v| [m/s]: d D / a in d dimensions; for levels that "
                                 "differ (D^2 / a^2 + D^2 / b^2) / (D / a + D / b).")
          .def_property_readonly("variance", &WhiteNoise::variance,
                                 "Stationary variance of each component of the velocity: D^2 (1 / a^2 + 1 / b^2), "
                                 "which is 2 pi^2 S0^2 / a^2, thesis (3.48); in d dimensions (d + 1) D^2 / a^2 "
                                 "[m^2/s^2].")
          .def_property_readonly(
              "growth_rate", &WhiteNoise::growth_rate,
              "Growth of the variance of each coordinate once the velocity is stationary: 2 D^3 (2 / a^4 + 1 "
              "/ (a b)^2 + 2 / b^4), which is 10 pi^3 S0^3 / a^4, thesis (3.49); in d dimensions (d + 1) (2 d + 3) "
              "D^3 / a^4 [m^2/s]. Infinite if a level is 0: the variance then grows as t^3, and the growth rate of "
              "`predict` is NaN.")
          .def_property_readonly(
              "relaxation_rate", &WhiteNoise::relaxation_rate,
              "Rate at which the velocity forgets its start [1/s]: d a^2 / ((d + 1)^2 D) in d dimensions, with the "
              "lower level if they differ. The slowest part of every transient, and of the autocovariance, decays as "
              "exp(-rate t), in one dimension times a power of t.")
          .def("density", by_one("velocity", &WhiteNoise::density), py::arg("velocity"),
               R"(Stationary probability density of the velocity, in more dimensions of each of its components.

Two exponentials that meet at rest: p(v) = exp(-a v / D) / (D / a + D / b) for v > 0, exp(b v / D) / (D / a + D / b) for
v < 0; a / (2 D) exp(-a |v| / D) if the levels are equal. 0 if a level is 0. In d dimensions the density of the vector
is proportional to exp(-a |v| / D), and that of a component, with y = a |v| / D and a Bessel function K, is (a / D)
(y / 2)^(d / 2) K_(d / 2)(y) / (sqrt(pi) Gamma((d + 1) / 2)): (a / D) y K_1(y) / pi in the plane.

Parameters
----------
velocity : array_like
    Velocities [m/s].

Returns
-------
float or numpy.ndarray
    Density [s/m], of the shape of velocity.)")
          .def("speed_density", by_one("speed", &WhiteNoise::speed_density), py::arg("speed"),
               R"(Stationary probability density of the speed |v|, a Gamma distribution of shape d.

In d dimensions (a / D)^d |v|^(d - 1) exp(-a |v| / D) / (d - 1)!. 0 for negative speeds and if a level is 0.

Parameters
----------
speed : array_like
    Speeds [m/s].

Returns
-------
float or numpy.ndarray
    Density [s/m], of the shape of speed.)")
          .def(
              "transition_density",
              [](const WhiteNoise& self, const py::object& velocity, const py::object& time, const py::object& start) {
                return py::vectorize([&self](double v, double t, double v0) {
                  return self.transition_density(v, t, v0);
                })(to_numbers(velocity, "WhiteNoise: velocity", "m/s"), to_numbers(time, "WhiteNoise: time", "s"),
                   to_numbers(start, "WhiteNoise: start", "m/s"));
              },
              py::arg("velocity"), py::arg("time"), py::arg("start") = 0.0,
              R"(Probability density of the velocity at a time, given the velocity at time 0.

With y = |v|, y0 = |v0|: exp(-(y - y0 + a t)^2 / 4 D t) / sqrt(4 pi D t) + q on the side of the start, exp(-a y / D)
exp(-(y + y0 - a t)^2 / 4 D t) / sqrt(4 pi D t) + q beyond rest, q = a / (4 D) exp(-a y / D) erfc((y + y0 - a t) /
sqrt(4 D t)).

Parameters
----------
velocity : array_like
    v [m/s], finite.
time : array_like
    t [s], positive and finite.
start : array_like, optional
    v0 [m/s], finite.

Returns
-------
float or numpy.ndarray
    Density [s/m], of the shape to which the parameters broadcast.

Raises
------
ValueError
    A value out of range; unequal levels, and more than one dimension, for which no closed form is known.)")
          .def("velocity_autocovariance", by_one("lag", &WhiteNoise::velocity_autocovariance), py::arg("lag"),
               R"(Autocovariance of each component of the stationary velocity, E[v_i(t) v_i(t + lag)].

Its integral over all lags is `growth_rate`. The error is at most 1e-12 of the variance.

Parameters
----------
lag : array_like
    Lags of either sign [s].

Returns
-------
float or numpy.ndarray
    Autocovariance [m^2/s^2], of the shape of lag.

Raises
------
ValueError
    Unequal levels, or levels of 0.)")
          .def("velocity_spectrum", by_one("omega", &WhiteNoise::velocity_spectrum), py::arg("omega"),
               R"(Two-sided spectral density of each component of the stationary velocity.

Its integral over the whole line is the variance. S(w) = D^3 / (pi a^4) Re[(2 k^2 + 2 k + 1) / k^4], 2 k = 1 + sqrt(1 +
4 i w D / a^2). In d dimensions, with Gauss's function F, rho = (k - 1) / k and b = 1 + (d - 1) (k - 1) / (2 k - 1), it
is D / (pi w^2) (1 - Re[F(1, b - d; b + 1; rho^2) / (b k^2)]).

Parameters
----------
omega : array_like
    Angular frequencies [rad/s].

Returns
-------
float or numpy.ndarray
    Density [m^2/s], of the shape of omega.

Raises
------
ValueError
    Unequal levels, or levels of 0.)")
          .def(
              "absolute_moment",
              [](const WhiteNoise& self, int order, const py::object& time) {
                return of_each(time, "WhiteNoise: time", [&](double t) { return self.absolute_moment(order, t); });
              },
              py::arg("order"), py::arg("time"),
              R"(E|v|^n at a time, from rest.

Computed from the transform n! (1/k^(n+1) + 1/m^(n+1)) / (s (1/k + 1/m)), 2 D k = a + sqrt(a^2 + 4 D s), and m like k
with b. In more than one dimension |v| is the speed, and the transform is (W.13) of the page on white noise in the
plane.

Parameters
----------
order : int
    n, from 1 to 8.
time : array_like
    Times [s], finite and at least 0.

Returns
-------
float or numpy.ndarray
    Moments [(m/s)^n], of the shape of time.

Raises
------
ValueError
    A value out of range.)")
          .def(
              "predict",
              [](const WhiteNoise& self, const py::object& times) {
                const std::vector<double> t = to_vector(times, "WhiteNoise: times", "s");
                const py::gil_scoped_release released;
                return self.predict(t);
              },
              py::arg("times"), R"(Predict means and covariances of each coordinate by time, from rest.

E[x v] and E[x^2] also follow from their transforms: for equal levels, in units of D and a, 3 / ((k - 1) (2 k - 1) k^4)
+ 2 / ((k - 1) (2 k - 1)^2 k^3), and 2 / (k (k - 1)) times that; in more dimensions by (W.13) and (W.14) of the page on
white noise in the plane.

Parameters
----------
times : array_like of shape (T,)
    Times [s], finite, at least 0, increasing.

Returns
-------
Moments

Raises
------
ValueError
    Times out of range; a value beyond the range of doubles.)")
          .def(
              "predict",
              [](const WhiteNoise& self, const AnySlider& slider, const AnyNoise& excitation, const py::object& times) {
                const std::vector<double> t = to_vector(times, "WhiteNoise: times", "s");
                const WhiteNoise theory = of_slider(slider, excitation, self.dimensions());
                const py::gil_scoped_release released;
                return theory.predict(t);
              },
              py::arg("slider"), py::arg("excitation"), py::arg("times"),
              R"(Predict for a given slider and excitation, like other theories: ``WhiteNoise(slider, excitation)``,
in the number of dimensions of this object.

Parameters
----------
slider : Slider or Coulomb
    Coulomb friction without a spring.
excitation : float, Spectrum or GaussianExcitation
    White noise: the level S0 [m^2/s^3], or a white spectrum or excitation.
times : array_like of shape (T,)
    Times [s], finite, at least 0, increasing.

Returns
-------
Moments

Raises
------
ValueError
    As above, and errors of `WhiteNoise`.
TypeError
    Another law; another kind of excitation.)")
          .def("__repr__", [](const WhiteNoise& self) {
            return "WhiteNoise(" + py::repr(py::cast(self.law())).cast<std::string>() +
                   ", s0=" + detail::shortest(self.s0()) +
                   (self.dimensions() == 1 ? "" : ", dimensions=" + std::to_string(self.dimensions())) + ")";
          });
  def_theory(type);
}

}  // namespace stickslip::python
