#include "stickslip/theory/equivalent_linearization.hpp"

#include "parts.hpp"
#include "theory/theory.hpp"

namespace stickslip::python {
namespace {

using theory::EquivalentLinearization;
using theory::TransitionTime;
using Force = EquivalentLinearization::Force;
using Start = EquivalentLinearization::Start;

constexpr std::pair<const char*, Force> forces[] = {{"gaussian", Force::gaussian},
                                                    {"gaussian_a22", Force::gaussian_a22},
                                                    {"laplace", Force::laplace},
                                                    {"thesis", Force::thesis}};
constexpr std::pair<const char*, Start> starts[] = {{"rest", Start::rest}, {"thesis", Start::thesis}};

template <class T, std::size_t n>
T named(const std::pair<const char*, T> (&all)[n], const std::string& name, const char* rule) {
  for (const auto& [known, value] : all)
    if (name == known) return value;
  throw std::invalid_argument(std::string("EquivalentLinearization: ") + rule + ", got '" + name + "'");
}

template <class T, std::size_t n>
const char* which_of(const std::pair<const char*, T> (&all)[n], T value) {
  for (const auto& [name, known] : all)
    if (value == known) return name;
  return "";
}

/// Calls `work` without the interpreter lock, with the slider in its static type or with a structure.
template <class Work>
Moments with_system(const py::object& slider, const Work& work) {
  if (const auto structure = sliding_structure_of(slider)) {
    const py::gil_scoped_release released;
    return work(*structure);
  }
  const auto one = slider_of(slider);
  if (!one)
    throw py::type_error(
        "EquivalentLinearization: slider must be a Slider, a friction law, an IsolatedStructure or an "
        "EquipmentOnFloor, got " +
        py::type::of(slider).attr("__name__").cast<std::string>());
  const py::gil_scoped_release released;
  return with_position_law(*one, "EquivalentLinearization", work);
}

Moments predict(const EquivalentLinearization& self, const py::object& slider, const AnyShapedNoise& excitation,
                const py::object& times) {
  const std::vector<double> t = to_vector(times, "EquivalentLinearization: times", "s");
  const theory::ShapedNoise noise = shaped_noise(excitation);
  return with_system(slider, [&](const auto& s) { return self.predict(s, noise, t, check_for_interrupt); });
}

Moments stationary(const EquivalentLinearization& self, const py::object& slider, const AnyShapedNoise& excitation) {
  const theory::ShapedNoise noise = shaped_noise(excitation);
  return with_system(slider, [&](const auto& s) { return self.stationary(s, noise); });
}

TransitionTime transition(const AnySlider& slider, const AnyNoise& s0) {
  const auto* const caster = std::get_if<Slider<Caster>>(&slider);
  if (caster == nullptr) throw py::type_error("transition_time: covers casters without a spring, got another law");
  return theory::transition_time(*caster, white_level(s0));
}

}  // namespace

void bind_equivalent_linearization(py::module_& m) {
  auto type =
      value_class<EquivalentLinearization>(
          m, "EquivalentLinearization",
          R"(Generalized equivalent linearization, thesis 3.3 and 3.4, also for colored or nonstationary excitation.

At each time the method replaces friction by the linear force a21 x + a22 x' with the smallest mean square error. With
the states of the filter that shapes the excitation, z = (x, x', filter), the covariance Q about the mean m follows::

    Q' = A Q + (A Q)^T + 2 pi S0 b b^T                          (3.9)
    m_x' = m_v,  m_v' = -E F - c m_v - wn^2 m_x,  F = level sgn(x')

where the row of x' in A has -wn^2 + a21, -c + a22 and the acceleration of the filter, times the envelope. Under white
noise these are::

    q11' = 2 q12                                                (3.32)
    q12' = (a21 - wn^2) q11 + a22 q12 + q22                     (3.33) corrected
    q22' = 2 (a21 - wn^2) q12 + 2 a22 q22 + 2 pi S0             (3.34) corrected

with [a21 a22] = E[h x^T] Q^-1, h = -level(x) sgn(x'), (3.5) corrected. The thesis sets a21 to zero (3.24), which is
right only if x and x' are uncorrelated, and simplifies the level of a caster (3.28).

Parameters
----------
force : {'gaussian', 'gaussian_a22', 'laplace', 'thesis'}, optional
    'gaussian': Gaussian expectations of the law itself. 'gaussian_a22': the same with a21 = 0, (3.24), as in the
    thesis. 'laplace': expectations with the exact density under white noise, two exponentials; Coulomb friction only.
    'thesis': a level of a / (1 + (x / reach)^2), (3.28) to (3.30), and a21 = 0.
start : {'rest', 'thesis'}, optional
    'rest': x = x' = 0. 'thesis': (3.38) to (3.40), a^6 q11 / S0^4 = 0.01, a^4 q12 / S0^3 = 5.4e-8, a^2 q22 / S0^2 =
    1.3e-5; for white noise without an envelope, equal levels and no damper.
tolerance : float, optional
    Approximate relative error of the results; from 1e-12 to 1e-2.
filter_order : int, optional
    Number of states of the filter fitted to a spectrum other than white, Kanai-Tajimi and Clough-Penzien, whose filters
    are exact: 2, 4, ... 16.
max_misfit : float, optional
    Maximum accepted misfit of such a filter, above 0; see `ShapingFilter`.
dimensions : int, optional
    Number of dimensions of the motion, from 1 to 6: 2 for a block on a plane. In more than one, friction opposes the
    velocity vector, the excitation acts in each coordinate, independently of the others, and results are those of each
    coordinate; Coulomb friction with equal levels only, and not the force or the start of the thesis.

Raises
------
ValueError
    An unknown name, a tolerance or a number of dimensions out of range. (`predict` raises for an order or misfit out of
    range.)

Notes
-----
Covers sliders, and structures of at most 12 modes with a sliding interface (`IsolatedStructure`, `EquipmentOnFloor`), of
which it predicts the motion of the interface: z = (x, x', modes, rates of the modes, filter).

Covers Coulomb friction, also with unequal levels, which cause drift, and casters; springs and dampers; white noise, any
spectrum through a `ShapingFilter`, Gaussian excitation with an envelope, and Poisson pulses by their second moments.

The response is not Gaussian. For Coulomb friction under white noise the stationary velocity variance is 21 % low and
the growth of the displacement variance 51 %; `WhiteNoise` has the exact values. With 'laplace': under white noise the
stationary velocity variance is exact, the growth of the displacement variance 20 % low for equal levels, 23 % for 1 to
1.3, 34 % for 1 to 2; for levels that differ the displacement variance is too low without a spring: by up to 25 % for
levels 1 to 1.5, 35 % for 1 to 2, 50 % for 1 to 3, 65 % for sliding one way only (a level 1000 times the other; an
infinite one is rejected).

In d dimensions a22 = -a E|v| / E|v|^2: the results are those along one axis with a slip level lower by a factor of
sqrt(pi) Gamma((d + 1) / 2) / (d Gamma(d / 2)), pi / 4 in the plane, or of sqrt(2 / (d + 1)) with 'laplace'. Under white
noise in the plane the stationary velocity variance is 15 % low and the growth of the displacement variance 38 %; with
'laplace' the velocity variance is exact and the growth 14 % low.

With gamma = S(0)^2 / (reach a^3), while a caster breaks loose, for z of (3.30) from 5 to 0.01, its displacement
variance is too low by a factor that grows as gamma falls: at most 1.4 at gamma = 0.03, 3 at 0.01, 10 at 0.005, 40 at
0.003, 2000 at 0.001.

Where the rms acceleration is below sqrt(2/pi) times the slip level (sqrt(1/2) with 'laplace'), the method predicts no
motion; at such times the velocity variance is 0, and the remark counts them. If the excitation has no content at zero
frequency, the method misses the drift of a slider without a spring. The page on linearization in time has tables of
errors.

References
----------
W. D. Iwan, A. B. Mason, Int. J. Non-Linear Mech. 15 (1980), 71-82; T. S. Atalik, S. Utku, Earthq. Eng. Struct. Dyn. 4
(1976), 411-420; S. H. Crandall, S. S. Lee, J. H. Williams, J. Appl. Mech. 41 (1974), 1094-1098.)")
          .def(py::init([](const std::string& force, const std::string& start, double tolerance, int order,
                           double max_misfit, int dimensions) {
                 return EquivalentLinearization(
                     {.force = named(forces, force, "force must be 'gaussian', 'gaussian_a22', 'laplace' or 'thesis'"),
                      .start = named(starts, start, "start must be 'rest' or 'thesis'"),
                      .tolerance = tolerance,
                      .filter = {.order = order, .max_misfit = max_misfit},
                      .dimensions = dimensions});
               }),
               py::arg("force") = "gaussian", py::kw_only(), py::arg("start") = "rest", py::arg("tolerance") = 1e-10,
               py::arg("filter_order") = theory::ShapingFilter::Fit().order,
               py::arg("max_misfit") = theory::ShapingFilter::Fit().max_misfit, py::arg("dimensions") = 1)
          .def_property_readonly(
              "force", [](const EquivalentLinearization& self) { return which_of(forces, self.options().force); },
              "Linear force that replaces friction.")
          .def_property_readonly(
              "start", [](const EquivalentLinearization& self) { return which_of(starts, self.options().start); },
              "Initial covariance.")
          .def_property_readonly(
              "tolerance", [](const EquivalentLinearization& self) { return self.options().tolerance; },
              "Approximate relative error of the results.")
          .def_property_readonly(
              "filter_order", [](const EquivalentLinearization& self) { return self.options().filter.order; },
              "Number of states of a fitted filter.")
          .def_property_readonly(
              "max_misfit", [](const EquivalentLinearization& self) { return self.options().filter.max_misfit; },
              "Maximum accepted misfit of a fitted filter.")
          .def_property_readonly(
              "dimensions", [](const EquivalentLinearization& self) { return self.options().dimensions; },
              "Number of dimensions of the motion.")
          .def("predict", &predict, py::arg("slider"), py::arg("excitation"), py::arg("times"),
               R"(Predict means and covariances by time, from rest.

Means are zero unless levels are unequal. Under white noise without envelope, unequal levels and damper, the integration
is over the logarithm of time, in variables that keep the covariance positive definite on any scale; there is a closed
form for a slider without friction. Otherwise Q is integrated in time (only its rows of x and x' if the covariance of
the filter is stationary): by backward differentiation where friction may hold the slider, by explicit steps elsewhere.
A velocity of sqrt(tolerance) / 10 of that at the first time, or of the rms acceleration over the filter's mean rate,
then counts as rest. This is about the relative error just after an abrupt start; it soon decays.

Parameters
----------
slider : Slider, Coulomb, Caster, IsolatedStructure or EquipmentOnFloor
    A law alone is a slider without spring and damper.
excitation : float, Spectrum, ShapingFilter, GaussianExcitation or PoissonPulses
    White noise by its level S0, two-sided, R(t) = 2 pi S0 delta(t) [m^2/s^3], positive and finite; other noise by its
    spectrum and envelope. Sampling and duration do not matter.
times : array_like of shape (T,)
    Times [s], finite, at least 0, increasing.

Returns
-------
Moments
    growth_rate is that with stationary velocity: for Coulomb friction under white noise pi^5 S0^3 / (2 a^4), (3.47),
    and for a law that is constant far away, such as a caster with rolling resistance, the same with that level; 0 with
    a spring that bounds the displacement (for a caster under white noise: a reach wn > pi S0, or rolling resistance);
    NaN if the velocity never becomes stationary. The remark states the misfit of a filter that is not exact, and where
    the prediction is outside its measured range.

Raises
------
ValueError
    Times out of range, an infinite level, a spectrum that no filter of the given order fits (names the misfit), pulses
    whose amplitudes have a mean, a value beyond the range of doubles.
ConvergenceError
    The tolerance cannot be reached: with a spring, after 300,000 steps. The message states the time reached.

Notes
-----
Takes 0.03 s for a structure of one mode, 0.2 s for three, 1 s for five and 16 s for ten. For sliders about 1 ms under
white noise, with a weakly damped spring some 0.1 ms per period; otherwise 1 to 200 ms, plus the fit of a filter.
Releases the interpreter lock.)")
          .def("stationary", &stationary, py::arg("slider"), py::arg("excitation"), R"(Predict the stationary moments.

Solves A Q + (A Q)^T + 2 pi S0 b b^T = 0, (3.9), where A depends on Q. Without a spring only the velocity is stationary.
Below the threshold of motion all moments are zero.

Parameters
----------
slider, excitation
    As for `predict`.

Returns
-------
Moments
    At one time, inf. Without a spring the displacement variance is inf if it grows, at growth_rate, and NaN if it does
    not, because it then depends on the start; the displacement mean is infinite if levels differ.

Raises
------
ValueError
    No stationary moments (the message gives the reason): an envelope; no spring and a level that depends on position;
    no friction and no damper; friction that cannot dissipate the input of the noise. Also errors of `predict`.

Notes
-----
Accurate to 1e-9. Takes 0.1 to 5 ms, plus the fit of a filter.)")
          .def(
              "coefficients",
              [](const EquivalentLinearization& self, const AnySlider& slider, double q11, double q12, double q22) {
                const auto f = with_position_law(slider, "EquivalentLinearization", [&](const auto& s) {
                  return self.coefficients(s.law(), q11, q12, q22);
                });
                return std::pair(f.a21, f.a22);
              },
              py::arg("slider"), py::arg("q11"), py::arg("q12"), py::arg("q22"),
              R"(Compute the equivalent linear friction for a given covariance of displacement and velocity.

a21 = -E[level'(x) sgn(x')], (3.22), and a22 = -sqrt(2 / (pi q22)) E[level(x) | x' = 0], (3.25); 0 and (3.29) for the
force 'thesis'. Accurate to 1e-12.

Parameters
----------
slider : Slider, Coulomb or Caster
    Only its law matters, not its spring.
q11, q22 : float
    Variances of x [m^2] and x' [m^2/s^2], positive and finite.
q12 : float
    Their covariance [m^2/s], q12^2 < q11 q22.

Returns
-------
tuple of float
    a21 [1/s^2] and a22 [1/s].

Raises
------
ValueError
    A value out of range, unequal levels.)")
          .def("__repr__", [](const EquivalentLinearization& self) {
            const theory::ShapingFilter::Fit fit = self.options().filter;
            const std::string filter =
                ", filter_order=" + std::to_string(fit.order) + ", max_misfit=" + detail::shortest(fit.max_misfit);
            return "EquivalentLinearization(force='" + std::string(which_of(forces, self.options().force)) +
                   "', start='" + which_of(starts, self.options().start) +
                   "', tolerance=" + detail::shortest(self.options().tolerance) +
                   (fit == theory::ShapingFilter::Fit() ? "" : filter) +
                   (self.options().dimensions == 1 ? "" : ", dimensions=" + std::to_string(self.options().dimensions)) +
                   ")";
          });
  def_theory(type);

  value_class<TransitionTime>(m, "TransitionTime",
                              "Time at which a caster under white noise breaks loose; see transition_time.")
      .def_readonly("thesis", &TransitionTime::thesis, "(3.51): S0 / a^2 (1 / (pi^5 gamma^2) + pi^2 / 4) [s].")
      .def_readonly("with_intercept", &TransitionTime::with_intercept,
                    "With the delay 47 pi^2 / 48 S0 / a^2 of q11 behind (3.47), which (3.51) drops [s].")
      .def("__repr__", [](const TransitionTime& t) {
        return "<TransitionTime: " + digits(t.thesis) + " s by (3.51), " + digits(t.with_intercept) +
               " s with the intercept; simulated casters break loose earlier>";
      });
  m.def("transition_time", &transition, py::arg("slider"), py::arg("s0"),
        R"(Estimate when a caster under white noise breaks loose, by equivalent linearization, thesis (3.51).

Its rms displacement then equals the reach (z = 1 in (3.30)) and friction decreases.

Simulated casters break loose earlier: (3.51) is late by a factor of 1.1 at gamma = S0^2 / (reach a^3) = 0.01, 2.1 at
0.005, 3.2 at 0.003, 4.2 at 0.002 and 6.3 at 0.001, because a few early casters carry the variance. The simulated time
is not a power of gamma: it goes as gamma^-1.0 from 0.01 to 0.005, and as gamma^-1.4 from 0.002 to 0.001, where (3.51)
goes as gamma^-2. The errata of the thesis (3g) have the table.

Parameters
----------
slider : Slider or Caster
    A caster with friction and without a spring. (3.51) assumes a stationary velocity and is not meaningful for
    gamma = S0^2 / (reach a^3) above 0.02. With infinite reach a caster never breaks loose.
s0 : float, Spectrum or GaussianExcitation
    Level of the white noise [m^2/s^3], positive and finite; or a white spectrum or excitation.

Returns
-------
TransitionTime

Raises
------
ValueError
    s0 out of range, no friction, a spring.
TypeError
    Another law.)");
}

}  // namespace stickslip::python
