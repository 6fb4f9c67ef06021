#include "stickslip/theory/slowly_varying_parameters.hpp"

#include <pybind11/stl.h>

#include "parts.hpp"
#include "theory/theory.hpp"

namespace stickslip::python {
namespace {

using theory::Branches;
using theory::HarmonicSolution;

/// The theory together with its slider.
struct SlowlyVaryingParameters : theory::SlowlyVaryingParameters {
  explicit SlowlyVaryingParameters(AnySlider any)
      : theory::SlowlyVaryingParameters(with_position_law(
            any, "SlowlyVaryingParameters", [](const auto& s) { return theory::SlowlyVaryingParameters(s); })),
        slider(std::move(any)) {}

  AnySlider slider;
};

constexpr const char* amplitudes = "SlowlyVaryingParameters: amplitude";

/// Two values for each amplitude: a tuple of floats for a float, of arrays of the same shape for an array.
template <class F>
py::tuple branches(const py::object& given, const F& f) {
  const Numbers amplitude = to_numbers(given, amplitudes, "m");
  if (amplitude.ndim() == 0) {
    const Branches b = f(*amplitude.data());
    return py::make_tuple(b.lower, b.upper);
  }
  const std::vector<py::ssize_t> shape(amplitude.shape(), amplitude.shape() + amplitude.ndim());
  py::array_t<double> lower(shape), upper(shape);
  const auto size = static_cast<std::size_t>(amplitude.size());
  const double* const in = amplitude.data();
  double *const low = lower.mutable_data(), *const up = upper.mutable_data();
  {
    const py::gil_scoped_release released;
    for (std::size_t i = 0; i < size; ++i) {
      const Branches b = f(in[i]);
      low[i] = b.lower;
      up[i] = b.upper;
    }
  }
  return py::make_tuple(std::move(lower), std::move(upper));
}

template <double (theory::SlowlyVaryingParameters::*f)(double) const>
py::object by_amplitude(const SlowlyVaryingParameters& self, const py::object& amplitude) {
  return of_each(amplitude, amplitudes, [&self](double a) { return (self.*f)(a); });
}

}  // namespace

template <>
inline constexpr auto parts<SlowlyVaryingParameters> = std::tuple(&SlowlyVaryingParameters::slider);

void bind_slowly_varying_parameters(py::module_& m) {
  value_class<HarmonicSolution>(m, "HarmonicSolution",
                                R"(A periodic motion x = amplitude cos(omega t + phase) under B cos(omega t).)")
      .def_readonly("amplitude", &HarmonicSolution::amplitude, "A [m].")
      .def_readonly("phase", &HarmonicSolution::phase, "phi [rad], from -pi to pi; nan if the amplitude is 0.")
      .def_readonly("stable", &HarmonicSolution::stable, "Whether the solution is stable under small perturbations.")
      .def("__repr__", [](const HarmonicSolution& s) {
        return "<HarmonicSolution: amplitude " + digits(s.amplitude) + " m, phase " + digits(s.phase) + " rad, " +
               (s.stable ? "stable" : "unstable") + ">";
      });

  auto type =
      value_class<SlowlyVaryingParameters>(
          m, "SlowlyVaryingParameters",
          R"(Harmonic response by the method of slowly varying parameters, thesis 2.2 and 2.3.

With corrected signs::

    x'' + level(x) sgn(x') + wn^2 x = B cos(omega t),   x = A cos(omega t + phi)            (2.28), (2.50)
    -2 omega A' + S(A) = B sin(phi)                                                         (2.10) corrected
    -2 omega A phi' - omega^2 A + C(A) = B cos(phi)                                         (2.11)

A and phi vary little within a cycle. The motion is therefore approximated by a cosine about x = 0, without sticking.
With W(A) the work against friction in a cycle of amplitude A, S = -W / (pi A), which is -4 a / pi for Coulomb friction
and -(4 a / pi) gd(A / 3l) / (A / 3l) for the caster; C = wn^2 A.

Parameters
----------
slider : Slider, Coulomb or Caster, optional
    A law alone is a slider without spring and damper. Coulomb friction with equal levels, or with any finite levels and
    a spring, which is equivalent to their mean level about `center`. Default: a slip level of 1 m/s^2 without a spring.

Raises
------
ValueError
    Different levels forward and backward without a spring, with which the mass drifts.

Notes
-----
The theory holds for B well above the slip level. For Coulomb friction without a spring the error is 0.7 % at B/a = 8, 3
% at 4, 25 % at 2, and the theory finds no motion from B = a, where motion begins, to 4 a / pi. It assumes a mean
position of x = 0, although without a spring nothing restores it: a caster may in fact creep away and escape. The claim
(2.34), that the amplitude of a caster lies between those of Coulomb friction and of the ground, holds for these
amplitudes, not for the exact responses.

References
----------
N. M. Krylov, N. N. Bogoliubov, Introduction to Non-Linear Mechanics (1947).)")
          .def(py::init([] { return SlowlyVaryingParameters(Slider(Coulomb(1))); }))
          .def(py::init<AnySlider>(), py::arg("slider"))
          .def_property_readonly(
              "slider", [](const SlowlyVaryingParameters& self) { return self.slider; }, "The slider.")
          .def_property_readonly(
              "center", [](const SlowlyVaryingParameters& self) { return self.center(); },
              "Center of the motion [m]: (backward - forward) / (2 wn^2) with a spring, otherwise 0.")
          .def("dissipative", &by_amplitude<&SlowlyVaryingParameters::dissipative>, py::arg("amplitude"),
               R"(S(A) = (1/pi) int f sin(theta) dtheta over a cycle, thesis (2.12), (2.22), (2.30): dissipation.

Parameters
----------
amplitude : float or array_like
    A [m], finite and at least 0; at 0, the limit.

Returns
-------
float or ndarray
    Values [m/s^2], at most 0, of the same shape.

Raises
------
ValueError
    An amplitude out of range.

Notes
-----
Accurate to round-off for every A / 3l; takes some 100 ns.)")
          .def("dissipative_slope", &by_amplitude<&SlowlyVaryingParameters::dissipative_slope>, py::arg("amplitude"),
               R"(S'(A), thesis (2.38).

Parameters
----------
amplitude : float or array_like
    A [m], finite and at least 0.

Returns
-------
float or ndarray
    Values [1/s^2], of the same shape.

Raises
------
ValueError
    An amplitude out of range.)")
          .def("in_phase", &by_amplitude<&SlowlyVaryingParameters::in_phase>, py::arg("amplitude"),
               R"(C(A) = (1/pi) int f cos(theta) dtheta, thesis (2.13), (2.46), (2.52): the part in phase with x.

Parameters
----------
amplitude : float or array_like
    A [m], finite and at least 0.

Returns
-------
float or ndarray
    Values [m/s^2], of the same shape.

Raises
------
ValueError
    An amplitude out of range.)")
          .def("in_phase_slope", &by_amplitude<&SlowlyVaryingParameters::in_phase_slope>, py::arg("amplitude"),
               R"(C'(A), thesis (2.39).

Parameters
----------
amplitude : float or array_like
    A [m], finite and at least 0.

Returns
-------
float or ndarray
    Values [1/s^2], of the same shape.

Raises
------
ValueError
    An amplitude out of range.)")
          .def("response", &SlowlyVaryingParameters::response, py::arg("B"), py::arg("omega"),
               py::call_guard<py::gil_scoped_release>(),
               R"(Find all periodic solutions except rest, sorted by amplitude.

S^2 + (C - omega^2 A)^2 = B^2, thesis (2.16); phi = atan2(S, C - omega^2 A), (2.17) corrected. Stable if
S' + S/A <= 0, (2.18) corrected, which friction always satisfies, and (C/A - omega^2) (C' - omega^2) + S S'/A > 0,
(2.19).

Parameters
----------
B : float
    Amplitude of the force per unit mass, which is that of the ground acceleration [m/s^2]; positive and finite.
omega : float
    Angular frequency [rad/s], positive and finite.

Returns
-------
list of HarmonicSolution
    Without rest, A = 0, which exists for every omega; see `rests`. At resonance, omega = wn, no amplitude is stable: it
    grows without bound with Coulomb friction if B exceeds 4 a / pi, and for a caster above its unstable solution.
    Without friction there is a single amplitude B / abs(omega^2 - wn^2), which is neutral and counts as stable. Within
    round-off of a fold, where two solutions meet, the list may hold both, one or none of them.

Raises
------
ValueError
    A value out of range.
OverflowError
    Amplitudes beyond the range of doubles.

Notes
-----
Finds all solutions, with amplitudes to round-off; takes 1 to 10 us.)")
          .def(
              "frequency",
              [](const SlowlyVaryingParameters& self, double B, const py::object& amplitude) {
                return branches(amplitude, [&](double a) { return self.frequency(B, a); });
              },
              py::arg("B"), py::arg("amplitude"),
              R"(The two frequencies at which the amplitude is A: both branches of (2.48), (2.53), and (2.25), (2.32).

omega^2 = C/A -+ sqrt(B^2 - S^2) / A.

Parameters
----------
B : float
    Amplitude of the load [m/s^2], positive and finite.
amplitude : float or array_like
    A [m], positive and finite.

Returns
-------
lower, upper : float or ndarray
    Frequencies [rad/s], of the same shape. nan if not real: both below the minimum amplitude, the lower one also if it
    would be imaginary. Without a spring there is only the upper one.

Raises
------
ValueError
    A value out of range.)")
          .def(
              "stability_boundary",
              [](const SlowlyVaryingParameters& self, const py::object& amplitude) {
                return branches(amplitude, [&](double a) { return self.stability_boundary(a); });
              },
              py::arg("amplitude"),
              R"(The frequencies between which solutions of amplitude A are unstable, for any B.

They are the locus of vertical tangents, (2.19) as an equation, thesis (2.41), (2.42), on both sides of wn.

Parameters
----------
amplitude : float or array_like
    A [m], positive and finite.

Returns
-------
lower, upper : float or ndarray
    Frequencies [rad/s], of the same shape. The lower one is 0 if the unstable zone extends to 0, as it always does
    without a spring. If both are equal, as for Coulomb friction, all solutions are stable.

Raises
------
ValueError
    An amplitude out of range.)")
          .def("min_amplitude", &SlowlyVaryingParameters::min_amplitude, py::arg("B"),
               R"(Minimum amplitude over all frequencies: -S(A) = B, thesis (2.36), (2.37), by bracketing.

Parameters
----------
B : float
    [m/s^2], positive and finite.

Returns
-------
float
    Amplitude [m]; 0 for B of at least -S(0) = 4 a / pi; inf if there is no solution, as for Coulomb friction below
    that.

Raises
------
ValueError
    B out of range.)")
          .def("rests", &SlowlyVaryingParameters::rests, py::arg("B"),
               R"(Whether a small motion decays to rest: B <= -S(0), which is 4 a / pi.

The exact motion comes to rest only for B <= a; between that and 4 a / pi it is small and sticks twice per cycle.

Parameters
----------
B : float
    [m/s^2], positive and finite.

Returns
-------
bool

Raises
------
ValueError
    B out of range.)")
          .def(
              "transient",
              [](const SlowlyVaryingParameters& self, double B, double omega, double amplitude, double phase,
                 const py::object& times) {
                const std::vector<double> at = to_vector(times, "SlowlyVaryingParameters: times", "s");
                theory::HarmonicTransient found;
                {
                  const py::gil_scoped_release released;
                  found = self.transient(B, omega, amplitude, phase, at, check_for_interrupt);
                }
                return py::make_tuple(array_of(std::move(found.amplitude)), array_of(std::move(found.phase)));
              },
              py::arg("B"), py::arg("omega"), py::arg("amplitude"), py::arg("phase"), py::arg("times"),
              R"(Compute the transient amplitude and phase, from the averaged equations (2.10) corrected and (2.11).

A motion that decays to zero stays at rest if `rests(B)`.

Parameters
----------
B, omega : float
    As for `response`.
amplitude : float
    A at t = 0 [m], finite and at least 0.
phase : float
    phi at t = 0 [rad], finite: x(0) = A cos(phi), x'(0) = -omega A sin(phi).
times : array_like, shape (T,)
    Times [s], increasing, from 0.

Returns
-------
amplitude, phase : ndarray, shape (T,)
    Amplitude [m], and phase [rad] from -pi to pi; the phase is nan if the amplitude is 0.

Raises
------
ValueError
    A value out of range.
ConvergenceError
    No convergence after a million steps (the message states the time reached).

Notes
-----
Integrated by SUNDIALS CVODE, with Adams formulas in A cos(phi), A sin(phi); local errors 1e-10 of A and 1e-12 B /
omega^2.)")
          .def(
              "settles_on",
              [](const SlowlyVaryingParameters& self, double B, double omega, double amplitude, double phase) {
                const py::gil_scoped_release released;
                return self.settles_on(B, omega, amplitude, phase, check_for_interrupt);
              },
              py::arg("B"), py::arg("omega"), py::arg("amplitude"), py::arg("phase"),
              R"(Find the solution to which a motion converges.

The averaged equations contract areas, by (S' + S/A) / (2 omega), so that they have no closed orbits. A motion
that has encircled one stable solution, and no other solution, cannot leave it.

Parameters
----------
B, omega, amplitude, phase : float
    As for `transient`.

Returns
-------
HarmonicSolution
    One of `response`, or rest (amplitude 0), or, at resonance, an infinite amplitude. Without friction, the solution
    that the motion encircles forever.

Raises
------
ValueError
    A value out of range.
ConvergenceError
    Undecided after a hundred thousand turns: within round-off of the boundary between two solutions.

Notes
-----
Takes some milliseconds if several solutions are stable.)")
          .def(
              "predict",
              [](const SlowlyVaryingParameters&, const AnySlider& slider, const HarmonicMotion& excitation,
                 const py::object& times) {
                const std::vector<double> at = to_vector(times, "SlowlyVaryingParameters: times", "s");
                const SlowlyVaryingParameters theory(slider);
                const py::gil_scoped_release released;
                return theory.theory::SlowlyVaryingParameters::predict(excitation, at, check_for_interrupt);
              },
              py::arg("slider"), py::arg("excitation"), py::arg("times"),
              R"(Predict x and x' by time from rest for a given slider, like other theories, by `transient`.

Parameters
----------
slider : Slider, Coulomb or Caster
    As for the constructor.
excitation : HarmonicMotion
    The ground motion.
times : array_like, shape (T,)
    Times [s], increasing, from 0.

Returns
-------
Moments
    Means without scatter: x = A cos(omega t + phi), x' = -omega A sin(omega t + phi).

Raises
------
ValueError
    A value out of range; different levels forward and backward.
ConvergenceError
    No convergence after a million steps (the message states the time reached).)")
          .def("__repr__", [](const SlowlyVaryingParameters& self) {
            return "SlowlyVaryingParameters(" + py::repr(py::cast(self.slider)).cast<std::string>() + ")";
          });
  def_theory(type);
}

}  // namespace stickslip::python
