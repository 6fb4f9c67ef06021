#include "stickslip/theory/pulse_superposition.hpp"

#include "parts.hpp"
#include "theory/displacement_distribution.hpp"
#include "theory/theory.hpp"

namespace stickslip::python {
namespace {

using theory::Overlap;
using theory::PulseSuperposition;

constexpr std::pair<const char*, Overlap> overlaps[] = {
    {"none", Overlap::none}, {"thesis", Overlap::thesis}, {"renewal", Overlap::renewal}};

PulseSuperposition theory_of(const std::string& overlap) {
  for (const auto& [name, value] : overlaps)
    if (overlap == name) return PulseSuperposition(value);
  throw std::invalid_argument("PulseSuperposition: overlap must be 'none', 'thesis' or 'renewal', got '" + overlap +
                              "'");
}

std::string overlap_of(const PulseSuperposition& theory) {
  for (const auto& [name, value] : overlaps)
    if (theory.overlap() == value) return name;
  return {};
}

Moments superposition_moments(const PulseSuperposition& self, const AnySlider& slider, const PoissonPulses& pulses,
                              const py::object& times) {
  const std::vector<double> at = to_vector(times, "PulseSuperposition: times", "s");
  const py::gil_scoped_release released;
  return with_position_law(slider, "PulseSuperposition",
                           [&](const auto& s) { return self.predict(s, pulses, at, &check_for_interrupt); });
}

Moments superposition_from_rest(const PulseSuperposition& self, const AnySlider& slider, const PoissonPulses& pulses,
                                const py::object& times) {
  const std::vector<double> at = to_vector(times, "PulseSuperposition: times", "s");
  const auto* block = std::get_if<Slider<Coulomb>>(&slider);
  if (block == nullptr) throw std::invalid_argument("PulseSuperposition: from_rest covers Coulomb friction");
  const py::gil_scoped_release released;
  return self.from_rest(*block, pulses, at, &check_for_interrupt);
}

double superposition_rms(const PulseSuperposition& self, const AnySlider& slider, const PoissonPulses& pulses) {
  const py::gil_scoped_release released;
  return with_position_law(slider, "PulseSuperposition",
                           [&](const auto& s) { return self.final_rms(s, pulses, &check_for_interrupt); });
}

DisplacementDistribution superposition_distribution(const PulseSuperposition& self, const AnySlider& slider,
                                                    const PoissonPulses& pulses, double time) {
  const py::gil_scoped_release released;
  return {self, slider, pulses, time};
}

}  // namespace

void bind_pulse_superposition(py::module_& m) {
  auto type =
      value_class<PulseSuperposition>(m, "PulseSuperposition",
                                      R"(Pulse theory in which each Poisson pulse finds the slider at rest.

E[x'^2] = lambda E[int v^2], d/dt Var[x] = lambda E[dx^2], d/dt E[x] = lambda E[dx], thesis (5.25), (5.28), where v
and dx are velocity and offset due to one pulse.

Parameters
----------
overlap : str, optional
    'none': each pulse acts alone, (5.34), (5.40). 'thesis': pulses that begin within dt of another one form a composite
    with it, (5.52) to (5.55) as printed. 'renewal': the same, corrected: each composite consists of 1 + lambda dt
    pulses, so that composites are rarer by that factor (errata to 5.52).

Raises
------
ValueError
    An unknown overlap.

Notes
-----
Asymptotic in time: (5.38), (5.39) require t >> 4 dt. Accurate if pulses are rare, lambda dt << 1, and exact for a
frictionless slider with 'none' and 'renewal'. Otherwise the growth rate is off by large factors: for lambda dt from
0.05 to 2 it is 1e-4 to 0.24 times the simulated one at sigma / a = 1/3, and 1.02 to 7.5 times at 5. `PulseChain` is
better for Coulomb friction.

Covers any friction law without a spring, unequal slip levels, any pulse shape that lets the slider stop, and with
'none' any distribution of amplitudes, with any mean. Under an envelope the growth is integrated over time (constant
slip levels only). The rates of a caster depend on its position: the moment equations are closed by a Gaussian
distribution of x, and `growth_rate` is that at x = 0.

A caster escapes if its friction can no longer stop it, after overlapping pulses or after many pulses. Before it returns
a result, the theory estimates for the whole excitation how overlaps affect a block of the same level, by `PulseChain`,
and how far the slider moves. It rejects casters that escape; if overlaps matter, `remark` states the factor. For 231
simulated casters, all results were within 45 % of the rms after multiplication by that factor.

References
----------
Thesis 5.3 with the errata to (5.52); Y. K. Lin, Probabilistic Theory of Structural Dynamics (1967), 87-94.)")
          .def(py::init(&theory_of), py::arg("overlap") = "renewal")
          .def_property_readonly("overlap", &overlap_of, "'none', 'thesis' or 'renewal'.")
          .def("predict", &superposition_moments, py::arg("slider"), py::arg("excitation"), py::arg("times"),
               R"(Predict moments by time.

Parameters
----------
slider : Slider, Coulomb or Caster
    Without a spring.
excitation : PoissonPulses
    The pulses, with or without an envelope.
times : array_like
    Times [s], shape (T,), finite, at least 0.

Returns
-------
Moments
    Velocities are stationary; `growth_rate` is NaN under an envelope. `remark` says whether times are too short,
    whether nothing slips and why, the factor of overlaps for a caster, and the fraction of pulses that would make it
    escape.

Raises
------
ValueError
    An input that the theory does not cover; a value out of range; a caster that escapes within the excitation, for any
    times.

Notes
-----
Integrals over the amplitudes are accurate to 1e-12 for Coulomb friction and take 60 us. A caster takes 0.1 to 10 s,
longest if its displacements are large; Ctrl-C interrupts.)")
          .def("from_rest", &superposition_from_rest, py::arg("slider"), py::arg("pulses"), py::arg("times"),
               R"(Predict moments at any time from rest, with Coulomb friction.

By Campbell's theorem, with z(u) the response to a pulse at time u after its beginning, E[x(t)] = lambda E[int_0^t z du]
and Var[x(t)] = lambda E[int_0^t z^2 du], thesis (5.25), (5.28); likewise with z' for the velocity. The covariance is
lambda E[z(t)^2] / 2, (5.59).

Parameters
----------
slider : Slider or Coulomb
    Without a spring; the levels may differ.
pulses : PoissonPulses
    Without an envelope; no pulse arrives before time zero.
times : array_like
    Times [s], shape (T,), finite, at least 0.

Returns
-------
Moments
    At large times they tend to the lines of `predict`, with the same `growth_rate`.

Raises
------
ValueError
    An input that the theory does not cover; a value out of range.

Notes
-----
Overlapping responses are added: exact for lambda dt -> 0 at every time, and without friction with 'none'. Integrals
over time are in closed form, those over the amplitudes accurate to 1e-5. Takes 0.1 to 1 ms, plus some 10 us for each
time.)")
          .def("final_rms", &superposition_rms, py::arg("slider"), py::arg("pulses"),
               R"(Predict the rms displacement (E[x^2(t_d)])^(1/2) at t_d = pulses.duration; thesis 5.6 and figure 5.7.

Parameters
----------
slider : Slider, Coulomb or Caster
    Without a spring.
pulses : PoissonPulses
    The excitation.

Returns
-------
float
    Rms displacement [m].

Raises
------
ValueError
    As for `predict`.)")
          .def("distribution", &superposition_distribution, py::arg("slider"), py::arg("pulses"), py::arg("time"),
               (std::string(R"(Predict the distribution of the displacement at a time.

Pulses arrive independently, and each pulse above the slip level adds its offset: x is a compound Poisson sum,
E[exp(iux)] = exp(lambda t E[exp(iu dx) - 1]), with the mean and variance of `predict`. With overlaps, the sum is over
composites, with a rate of lambda / (1 + lambda dt) ('renewal').

Parameters
----------
slider : Slider or Coulomb
    Constant slip levels, which may be unequal, without a spring.
pulses : PoissonPulses
    Without an envelope, lambda dt at most 0.1.
time : float
    Time [s], finite and at least 0.

Returns
-------
DisplacementDistribution
    With the probability of no displacement, density, probabilities, quantiles and `remark`.

Raises
------
ValueError
    An input that the theory does not cover; a value out of range; pulses whose overlaps change the standard deviation
    by more than a factor of 2.

Notes
-----
Exact for lambda dt -> 0 and t >> 4 dt. )") +
                detail::pulse_accuracy().rare +
                " If overlaps change the standard deviation by more than 5 %, `remark` of the result gives the factor, "
                "found with `PulseChain`. Takes some 30 ms.")
                   .c_str())
          .def("__repr__",
               [](const PulseSuperposition& t) { return "PulseSuperposition(overlap='" + overlap_of(t) + "')"; });
  def_theory(type);

  m.def("peak_from_growth", &theory::peak_from_growth, py::arg("growth_rate"), py::arg("duration"),
        py::arg("probability"),
        R"(Estimate a quantile of the peak of a slider from its growth rate.

Finds L with P(|x| <= L on [0, T]) = probability for Brownian motion without drift and with variance growth_rate t, by a
series of eigenfunctions or of reflections, whichever converges faster. A slider's displacement is Brownian motion only
over many slips, and motion out and back within a pulse adds to the peak. Compared with the peak that 5 % of blocks
exceed in the thesis's four events, the estimate with the growth rate of `PulseChain` is 0.96 to 0.99 for sigma / a from
0.5 to 5 in the great events (60 s), 0.89 to 0.98 in the moderate ones (15 s), and 0.88 to 1.32 down to sigma / a = 0.2.
Below that fewer than 5 % may slip at all, and the estimate is meaningless. `PulseChain.peak` is more accurate, also at
other probabilities.

Parameters
----------
growth_rate : float
    Growth rate of the displacement variance [m^2/s], finite and at least 0.
duration : float
    T [s], finite and at least 0.
probability : float
    Probability that the peak is not exceeded, in (0, 1).

Returns
-------
float
    L [m], with a relative error of 1e-14.

Raises
------
ValueError
    A value out of range.

References
----------
W. Feller, An Introduction to Probability Theory and Its Applications, vol. 2 (1971), X.5.)");
}

}  // namespace stickslip::python
