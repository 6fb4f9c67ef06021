#include "stickslip/theory/pulse_chain.hpp"

#include "parts.hpp"
#include "theory/displacement_distribution.hpp"
#include "theory/theory.hpp"

namespace stickslip::python {
namespace {

using detail::pulse_accuracy;
using theory::PulseChain;

Moments chain_moments(const PulseChain& self, const AnySlider& slider, const PoissonPulses& pulses,
                      const py::object& times) {
  const std::vector<double> at = to_vector(times, "PulseChain: times", "s");
  const py::gil_scoped_release released;
  return self.predict(coulomb_of(slider), pulses, at, &check_for_interrupt);
}

DisplacementDistribution chain_distribution(const PulseChain& self, const AnySlider& slider,
                                            const PoissonPulses& pulses, double time) {
  const py::gil_scoped_release released;
  return {self, slider, pulses, time};
}

Interval chain_peak(const PulseChain& self, const AnySlider& slider, const PoissonPulses& pulses, double probability) {
  const py::gil_scoped_release released;
  return self.peak(coulomb_of(slider), pulses, probability, &check_for_interrupt);
}

double chain_rms(const PulseChain& self, const AnySlider& slider, const PoissonPulses& pulses) {
  const py::gil_scoped_release released;
  return self.final_rms(coulomb_of(slider), pulses, &check_for_interrupt);
}

}  // namespace

void bind_pulse_chain(py::module_& m) {
  auto type =
      value_class<PulseChain>(
          m, "PulseChain",
          R"(Pulse theory for Coulomb friction, with Poisson pulses that arrive on a lattice of times.

Pulses begin only at the nodes of a lattice, with a Poisson-distributed number at each node. The ground acceleration is
then constant over slots, and the velocity with the last few batches of pulses is a Markov chain, which is solved on a
grid, from rest. The distribution of the acceleration and its spectrum, the response to a single pulse and the response
without friction stay exact. Pairs of pulses occur only at the offsets of the lattice; this is corrected to second order
in lambda dt. docs/pulse_chain.md has the derivation and a map of the errors.

Parameters
----------
refined : bool, optional
    Use two slots per step of the pulse for sigma / a from 0.12 to 1, extrapolated from one and two below 1/2: more
    accurate, takes up to some seconds.

Notes
-----
Against simulation, for the symmetric rectangular pulse and Gaussian amplitudes, lambda dt from 0.05 to 2 (4): growth
rate and velocity variance are within 4 % (9 %) for sigma / a from 1 to 20, within 9 % (13 %) from 1/3. Below that they
are too high, as `remark` says: the final rms of the thesis's events (lambda dt = 1/2) by 9 % at 1/4, 16 % at 1/5, 27 %
at 1/6 and 37(3) % at 0.15. With `refined` they are within 5 % from 1/3, and the final rms within 5 % down to 0.13;
above sigma / a = 1 `refined` makes no difference. Within the first pulse length after the start from rest, E[x^2] and
E[v^2] are within 10 % (lambda dt up to 1) and 17 % (up to 2) for sigma / a from 1/2, at any time down to dt / 20;
otherwise `remark` says that they are off by up to a factor of 2.4. Later they are within 12 %.

If the two slip levels differ, including one-way sliding, or amplitudes have a mean, the displacement drifts. The mean
velocity is within 8 % for levels that differ by a third or more (12 % for 1.1 times; 26 % with `refined`, which
`remark` says), the growth rate within 12 % (18 % for one-way sliding at lambda dt = 2) and the velocity variance within
8 % (13 %), for sigma over the smaller level from 1/3 to 20 and lambda dt up to 2. If sigma exceeds 3 times the smaller level, these errors hold for a larger level of at
most 4 times the smaller one.

Covers Coulomb friction without a spring; pulses of two to four equal steps (two with `refined`) whose values are
multiples of a common unit and which leave no net velocity; any distribution of amplitudes, a symmetric one if the
levels differ.)")
          .def(py::init<bool>(), py::kw_only(), py::arg("refined") = false)
          .def_property_readonly("refined", &PulseChain::refined, "Whether there are two slots per step of the pulse.")
          .def("predict", &chain_moments, py::arg("slider"), py::arg("excitation"), py::arg("times"),
               R"(Predict moments by time, from rest.

Parameters
----------
slider : Slider or Coulomb
    No spring; the levels may differ.
excitation : PoissonPulses
    Without an envelope; no pulse arrives before time zero.
times : array_like
    Times [s], shape (T,), finite, at least 0.

Returns
-------
Moments
    `remark` says whether the theory or one of the times is out of range, and whether nothing slips.

Raises
------
ValueError
    An input that the theory does not cover; a value out of range.
ConvergenceError
    The chain does not become stationary within its steps.

Notes
-----
Takes 3 to 100 ms, with `refined` 0.1 to 5 s.)")
          .def(
              "distribution", &chain_distribution, py::arg("slider"), py::arg("pulses"), py::arg("time"),
              (std::string(R"(Predict the distribution of the displacement at a time.

By closure: a compound Poisson law with gamma-distributed slip lengths is fitted to the first four cumulants of the
chain, and to its probability of no slip. The densities are abs(d)^(k-1) exp(-abs(d) / theta), with one k for both
directions and two theta.

Parameters
----------
slider : Slider or Coulomb
    As for `predict`.
pulses : PoissonPulses
    As for `predict`.
time : float
    Time [s], finite, 0 or at least the length of a pulse.

Returns
-------
DisplacementDistribution
    With the probability of no displacement, density, probabilities, quantiles and `remark`.

Raises
------
ValueError
    An input that the theory does not cover; a value out of range; sigma / a from 0.05 to 0.12 with more than 4 pulses
    per step; a kurtosis more than 0.1 below the minimum for a sum of slips.
ConvergenceError
    As for `predict`.

Notes
-----
)") + pulse_accuracy().distribution +
               R"( Elsewhere `remark` of the result says what is known. docs/pulse_chain.md has the table. Takes 15 to 250
ms, with `refined` up to some seconds.)")
                  .c_str())
          .def("peak", &chain_peak, py::arg("slider"), py::arg("pulses"), py::arg("probability"),
               (std::string(R"(Estimate a quantile of the peak abs(x) of a block over the duration of the motion.

It is the peak of a random walk whose steps are the slips of `distribution`, with a Poisson-distributed number, solved
on a grid with absorbing walls at the peak. How far the block goes during a slip, beyond the point where the slip ends,
follows from its length, by the responses to one pulse and to two that overlap.

Parameters
----------
slider : Slider or Coulomb
    As for `predict`.
pulses : PoissonPulses
    As for `predict`; over its duration.
probability : float
    Probability that the peak is not exceeded, in (0, 1).

Returns
-------
Interval
    Peak [m], 0 if that fraction does not slip at all; `float(...)` is the estimate. The bounds are the estimate divided
    by the largest and the smallest ratio to simulations that are found in the range stated below; outside that range
    they are 0 and infinity. They are not confidence bounds.

Raises
------
ValueError
    An input that the theory does not cover; a value out of range.
ConvergenceError
    As for `predict`.

Notes
-----
)") + pulse_accuracy().peak +
                " Takes 0.1 to 1 s, with `refined` up to 10 s.")
                   .c_str())
          .def("final_rms", &chain_rms, py::arg("slider"), py::arg("pulses"),
               R"(Predict the rms displacement (E[x^2(t_d)])^(1/2) at t_d = pulses.duration; thesis figure 5.7.

Parameters
----------
slider : Slider or Coulomb
    No spring; the levels may differ.
pulses : PoissonPulses
    The excitation, without an envelope.

Returns
-------
float
    Rms displacement [m].

Raises
------
ValueError, ConvergenceError
    As for `predict`.)")
          .def("__repr__", [](const PulseChain& t) {
            return std::string("PulseChain(refined=") + (t.refined() ? "True)" : "False)");
          });
  def_theory(type);
}

}  // namespace stickslip::python
