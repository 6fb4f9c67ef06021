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
      value_class<PulseSuperposition>(m, "PulseSuperposition", R"(Poisson pulses as if each found the slider at rest.

E[x'^2] = lambda E[int v^2], d/dt Var[x] = lambda E[dx^2], d/dt E[x] = lambda E[dx], thesis (5.25), (5.28): v and dx are
what one pulse does.

Parameters
----------
overlap : str, optional
    'none': each pulse acts alone, (5.34), (5.40). 'thesis': those that begin within dt of another's begin are one with
    it, (5.52) to (5.55) as printed. 'renewal': the same, corrected: each composite takes up 1 + lambda dt pulses, so
    that they come 1 + lambda dt times more rarely (errata to 5.52).

Raises
------
ValueError
    Another overlap.

Notes
-----
Asymptotic in time: (5.38), (5.39) ask for t >> 4 dt. Right where pulses are rare, lambda dt << 1, and exact for a
frictionless slider with 'none' and 'renewal'; else off by factors, down to 1/4000 ('none') and 1/14 (the others) of the
growth rate at sigma / a = 1/3, up to 3.7 times ('thesis') at 5. `PulseChain` is better for Coulomb friction.

Covers any friction law without a spring, unequal slip levels, any pulse shape that lets the slider stop, and with
'none' any law of amplitudes, of any mean. Under an envelope the growth is integrated over its strength (constant slip
levels only). A caster's rates depend on where it is: the equations of the moments are closed by a Gaussian law of x, and
`growth_rate` is that at x = 0.

A caster escapes where its friction can no longer stop it, by pulses that overlap or by the last ones of many. Before
anything is answered, it is asked for all of the excitation what the overlaps do to a block of the same level, by
`PulseChain`, and how far the slider comes: where it escapes it is refused, where the overlaps matter `remark` has the
factor by which they do. Of 231 casters that were simulated, all that is answered is within 45 % of the rms, after that
factor.

References
----------
Thesis 5.3 with the errata to (5.52); Y. K. Lin, Probabilistic Theory of Structural Dynamics (1967), 87-94.)")
          .def(py::init(&theory_of), py::arg("overlap") = "renewal")
          .def_property_readonly("overlap", &overlap_of, "'none', 'thesis' or 'renewal'.")
          .def("predict", &superposition_moments, py::arg("slider"), py::arg("excitation"), py::arg("times"),
               R"(Moments by time.

Parameters
----------
slider : Slider, Coulomb or Caster
    Without a spring.
excitation : PoissonPulses
    The pulses, with an envelope or without.
times : array_like
    Where to answer [s], shape (T,), finite, at least 0.

Returns
-------
Moments
    Velocities are stationary; `growth_rate` is NaN under an envelope. `remark` says where times are too short, where
    nothing slips and why, by how much overlaps are missed for a caster, and which share of the pulses would carry it off.

Raises
------
ValueError
    What is not covered; a value out of its range; a caster that escapes within the excitation, whatever the times are.

Notes
-----
Integrals over the amplitudes to 1e-12 for Coulomb friction, 60 us. A caster takes 0.1 to 10 s, most where it spreads
far; Ctrl-C ends it.)")
          .def("from_rest", &superposition_from_rest, py::arg("slider"), py::arg("pulses"), py::arg("times"),
               R"(Moments at any time from rest on, under Coulomb friction.

Campbell's theorem: with z(u) the response to a pulse that began u ago, E[x(t)] = lambda E[int_0^t z du] and
Var[x(t)] = lambda E[int_0^t z^2 du], thesis (5.25), (5.28); the same of z' for the velocity. The covariance is
lambda E[z(t)^2] / 2, (5.59).

Parameters
----------
slider : Slider or Coulomb
    Without a spring; the levels may differ.
pulses : PoissonPulses
    Without an envelope, from rest as if no pulse had arrived before time zero.
times : array_like
    Where to answer [s], shape (T,), finite, at least 0.

Returns
-------
Moments
    Late ones tend to the lines of `predict`; `growth_rate` is theirs.

Raises
------
ValueError
    What is not covered; a value out of its range.

Notes
-----
Responses that overlap are added: exact for lambda dt -> 0 at every time, and without friction with 'none'. Integrals over
time in closed form, over the amplitudes to 1e-5; 0.1 to 1 ms, and some 10 us for each time.)")
          .def("final_rms", &superposition_rms, py::arg("slider"), py::arg("pulses"),
               R"((E[x^2(t_d)])^(1/2) at the end of the motion, t_d = pulses.duration; thesis 5.6 and figure 5.7.

Parameters
----------
slider : Slider, Coulomb or Caster
    Without a spring.
pulses : PoissonPulses
    The excitation.

Returns
-------
float
    [m]

Raises
------
ValueError
    As for `predict`.)")
          .def("distribution", &superposition_distribution, py::arg("slider"), py::arg("pulses"), py::arg("time"),
               R"(The distribution of the displacement at a time.

Pulses come independently, each that exceeds the slip level adds its offset: x is a compound Poisson sum,
E[exp(iux)] = exp(lambda t E[exp(iu dx) - 1]), with the mean and variance of `predict`. With overlaps, of composites as
they come: lambda / (1 + lambda dt) of them a second ('renewal').

Parameters
----------
slider : Slider or Coulomb
    Of constant slip levels, which may be unequal, without a spring.
pulses : PoissonPulses
    Without an envelope, lambda dt at most 0.1.
time : float
    [s], finite and at least 0.

Returns
-------
DisplacementDistribution
    With the chance of no displacement at all, density, probabilities and quantiles.

Raises
------
ValueError
    What is not covered; a value out of its range.

Notes
-----
Exact for lambda dt -> 0 and t >> 4 dt. For 20 pulses at sigma / a from 1/2 to 3 a probability is off by less than 0.0062
at lambda dt = 0.001, 0.02 at 0.01, and 0.13 at 0.1. Takes 10 to 25 ms.)")
          .def("__repr__",
               [](const PulseSuperposition& t) { return "PulseSuperposition(overlap='" + overlap_of(t) + "')"; });
  def_theory(type);

  m.def("peak_from_growth", &theory::peak_from_growth, py::arg("growth_rate"), py::arg("duration"),
        py::arg("probability"),
        R"(An estimate of the peak that a slider does not exceed with a probability, from its growth rate.

The L with P(|x| <= L on [0, T]) = probability for Brownian motion without drift of variance growth_rate t: by its series
of eigenfunctions, or of reflections, whichever converges at once. An estimate: a slider's displacement is Brownian
motion only over many slips, and the way out and back within a pulse comes on top. Of the peak that 5 % of blocks exceed
in the thesis's four events it is, with the growth by `PulseChain`, 0.96 to 0.99 for sigma / a from 0.5 to 5 in the great
events (60 s), 0.89 to 0.98 in the moderate ones (15 s), and from 0.88 to 1.32 down to sigma / a = 0.2. Below that fewer
than 5 % may slip at all, and it means nothing. `PulseChain.peak` is nearer, at other probabilities too.

Parameters
----------
growth_rate : float
    Of the displacement variance [m^2/s], finite and at least 0.
duration : float
    T [s], finite and at least 0.
probability : float
    That the peak is not exceeded, in (0, 1).

Returns
-------
float
    L [m], to a relative 1e-14.

Raises
------
ValueError
    A value out of range.

References
----------
W. Feller, An Introduction to Probability Theory and Its Applications, vol. 2 (1971), X.5.)");
}

}  // namespace stickslip::python
