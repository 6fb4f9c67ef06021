#include "stickslip/theory/stationary_linearization.hpp"

#include "parts.hpp"
#include "theory/theory.hpp"

namespace stickslip::python {
namespace {

using theory::StationaryLinearization;
using theory::StationaryPrediction;

const Slider<Coulomb>& coulomb(const AnySlider& slider) {
  if (const auto* found = std::get_if<Slider<Coulomb>>(&slider)) return *found;
  throw py::type_error(
      "StationaryLinearization: covers Coulomb friction, with or without a spring; a caster's slip level depends on "
      "the "
      "position, which has no stationary variance");
}

}  // namespace

void bind_stationary_linearization(py::module_& m) {
  value_class<StationaryPrediction>(
      m, "StationaryPrediction",
      R"(Result of stationary linearization, as `StationaryLinearization.predict` returns it.

The linear system x'' + zeta x' + wn^2 x = -n(t) and its response.)")
      .def_readonly("damping", &StationaryPrediction::damping,
                    "zeta_eq [1/s], thesis (4.20); inf if the theory predicts no motion.")
      .def_readonly(
          "velocity_std", &StationaryPrediction::velocity_std,
          "Standard deviation of the velocity [m/s], thesis (4.9); inf without friction if the ground velocity is "
          "not stationary.")
      .def_readonly("displacement_std", &StationaryPrediction::displacement_std,
                    "Standard deviation of the stationary displacement [m], thesis (4.12); inf if there is none.")
      .def_readonly("growth_rate", &StationaryPrediction::growth_rate,
                    R"(Growth rate of the displacement variance at large times [m^2/s], thesis (4.13).

0 if it does not grow, or grows less than linearly; inf if it grows faster.)")
      .def_readonly("remark", &StationaryPrediction::remark,
                    "A warning about the validity of the values; '' if there is none.")
      .def_readonly("spectrum", &StationaryPrediction::spectrum, "Spectrum of the ground acceleration.")
      .def_readonly("natural_frequency", &StationaryPrediction::natural_frequency, "wn [rad/s]; 0 without a spring.")
      .def(
          "velocity_spectrum",
          [](const StationaryPrediction& self, const py::object& omega) {
            return of_each(omega, "StationaryPrediction: omega",
                           [&self](double w) { return self.velocity_spectrum(w); });
          },
          py::arg("omega"),
          R"(Two-sided spectral density of the stationary velocity; its integral over the whole line is velocity_std**2.

S(omega) / (omega^2 + zeta^2), thesis (4.8); with a spring S omega^2 / ((omega^2 - wn^2)^2 + zeta^2 omega^2).

Parameters
----------
omega : float or array_like
    Angular frequency [rad/s], of either sign.

Returns
-------
float or ndarray
    Density [m^2/s]: (m/s)^2 per rad/s, of the same shape.)")
      .def(
          "transient",
          [](const StationaryPrediction& self, const py::object& times) {
            const std::vector<double> at = to_vector(times, "StationaryPrediction: times", "s");
            const py::gil_scoped_release released;
            return self.transient(at, check_for_interrupt);
          },
          py::arg("times"),
          R"(Compute the exact moments of the linear system from rest at x = 0.

E[x_i x_j] = integral of S(omega) A_i A_j^* d omega, where A_i is the integral of h_i(u) exp(-i omega u) from 0 to t and
h the impulse response, thesis (4.5). The velocity becomes stationary. Without a spring the displacement does not: the
initial ground velocity over zeta remains as an offset, and the variance tends to
displacement_std**2 + (ground velocity variance) / zeta**2.

Parameters
----------
times : array_like, shape (T,)
    Times [s], finite and at least 0, in any order.

Returns
-------
Moments

Raises
------
ValueError
    A time out of range.
ConvergenceError
    A spectrum that cannot be integrated.

Notes
-----
The relative error is at most 1e-8. Takes some 0.3 to 2 ms for each time, however late. Releases the interpreter
lock.)")
      .def("__repr__", [](const StationaryPrediction& p) {
        return "<StationaryPrediction: damping " + digits(p.damping) + " 1/s, velocity_std " + digits(p.velocity_std) +
               " m/s, displacement_std " + digits(p.displacement_std) + " m" +
               (p.remark.empty() ? "" : "; " + p.remark) + ">";
      });

  auto type =
      value_class<StationaryLinearization>(m, "StationaryLinearization",
                                           R"(Stationary equivalent linearization of Coulomb friction, thesis 4.3.

x'' + a sgn(x') + wn^2 x = -n(t) by x'' + zeta x' + wn^2 x = -n(t), thesis (4.1), (4.2), with

    zeta = sqrt(2/pi) a / sigma_v,   sigma_v^2 = integral of S(omega) / (omega^2 + zeta^2),   (4.19), (4.20)

(with a spring S omega^2 / ((omega^2 - wn^2)^2 + zeta^2 omega^2)): the damper equivalent to friction if the velocity
were Gaussian. There is one solution if sigma_n / a > sqrt(2/pi), (4.22), and none below, where the method predicts no
motion. It is found by bracketing, because the iteration (4.41) converges too slowly near that threshold and cycles for
bands far from zero.

Measured range: without a spring, or on one whose natural frequency exceeds those of at most a quarter of the variance of
the ground acceleration, the standard deviation of the velocity is right within 16 % from sigma_n / a = 1.2 on, within 21 %
under Kanai-Tajimi noise with a damping ratio above 0.9; on a stiffer spring it is too low, down to 0.5 of the simulated
one at 1.2 and 0.8 at 3. There the slider follows the ground
acceleration quasi-statically and sticks in between, which a damper cannot represent; the remark says so.

The displacement is wrong if the acceleration has no content at zero frequency: friction creates such content, so that x
drifts, which the linear system cannot model. With a spring the displacement is too small until sigma_n is some four
times a. docs/filtered_noise.md has tables.

References
----------
Thesis 4.3; C. K. Constantinou, I. G. Tadjbakhsh, J. Struct. Eng. 110 (1984).)")
          .def(py::init<>())
          .def(
              "predict",
              [](const StationaryLinearization& self, const AnySlider& slider, const AnyNoise& excitation) {
                const Slider<Coulomb>& friction = coulomb(slider);
                const theory::StationaryNoise noise = stationary_noise(excitation);
                const py::gil_scoped_release released;
                return self.predict(friction, noise);
              },
              py::arg("slider"), py::arg("excitation"), R"(Predict the equivalent damping and the stationary response.

Parameters
----------
slider : Slider or Coulomb
    Coulomb friction with equal levels in both directions, with or without a spring.
excitation : Spectrum, GaussianExcitation or float
    Stationary ground acceleration; a number is the level S0 of white noise [m^2/s^3].

Returns
-------
StationaryPrediction

Raises
------
TypeError
    A caster.
ValueError
    Unequal levels, with which friction has a mean and the slider drifts. An envelope; white noise without a line at
    zero frequency.
ConvergenceError
    A spectrum that cannot be integrated.

Notes
-----
Exact to round-off for band-pass and white noise without a spring, in 1 us; otherwise quadrature to 1e-9, in 0.1 to 10
ms.)")
          .def(
              "predict",
              [](const StationaryLinearization& self, const AnySlider& slider, const AnyNoise& excitation,
                 const py::object& times) {
                const std::vector<double> at = to_vector(times, "StationaryLinearization: times", "s");
                const Slider<Coulomb>& friction = coulomb(slider);
                const theory::StationaryNoise noise = stationary_noise(excitation);
                const py::gil_scoped_release released;
                return self.predict(friction, noise, at, check_for_interrupt);
              },
              py::arg("slider"), py::arg("excitation"), py::arg("times"),
              R"(Predict moments from rest, like other theories, by `StationaryPrediction.transient`.

Parameters
----------
slider, excitation
    As above.
times : array_like, shape (T,)
    Times [s], finite and at least 0, in any order.

Returns
-------
Moments

Raises
------
TypeError, ValueError, ConvergenceError
    As above; a time out of range.)")
          .def(
              "threshold",
              [](const StationaryLinearization& self, const AnySlider& slider, const AnyNoise& excitation) {
                return self.threshold(coulomb(slider), stationary_noise(excitation));
              },
              py::arg("slider"), py::arg("excitation"),
              R"(Compute the factor on the ground acceleration at which motion begins.

sqrt(2/pi) a / sigma_n, thesis (4.22). If it is 1 or more the method predicts no motion; the actual motion is then small
and rare, but not zero.

Parameters
----------
slider, excitation
    As for `predict`.

Returns
-------
float
    0 for white noise, whose variance is infinite.

Raises
------
TypeError, ValueError
    As for `predict`.)")
          .def("__repr__", [](const StationaryLinearization&) { return "StationaryLinearization()"; });
  def_theory(type);
}

}  // namespace stickslip::python
