#include "stickslip/theory/pulse_chain.hpp"

#include "parts.hpp"
#include "theory/displacement_distribution.hpp"
#include "theory/theory.hpp"

namespace stickslip::python {
namespace {

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

double chain_peak(const PulseChain& self, const AnySlider& slider, const PoissonPulses& pulses, double probability) {
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
      value_class<PulseChain>(m, "PulseChain",
                              R"(Poisson pulses that arrive in step: the pulse theory for Coulomb friction.

Pulses may begin at the nodes of a lattice alone, as many as Poisson's law gives to each: ground acceleration is then
constant over slots, and velocity and the last few batches are a Markov chain, which is solved on a grid, from rest on.
The law of the acceleration and its spectrum, the response to a single pulse and to no friction stay exact; what pairs
of pulses do at the lattice's offsets instead of all is put right to the second order in lambda dt. docs/pulse_chain.md
derives it and has the map of its errors.

Parameters
----------
refined : bool, optional
    Two slots to a step of the pulse from sigma / a = 0.12 to 1, below 1/2 extrapolated with one: more exact, up to some
    seconds.

Notes
-----
Against simulation, for the symmetric rectangular pulse and Gaussian amplitudes, lambda dt from 0.05 to 2 (4): growth rate
and velocity variance are within 4 % (9 %) for sigma / a from 1 to 20, within 9 % (13 %) from 1/3 on. Below that they are
too high: the growth rate by 19 % at 1/4 and 41 % at 1/5, the final rms of the thesis's events (lambda dt = 1/2) by 9 % at
1/4, 16 % at 1/5, 27 % at 1/6 and 37(3) % at 0.15. Refined they are within 5 % from 1/3 on, and the final rms within 5 %
down to 0.13; above sigma / a = 1 refined is the same. From rest on, before a pulse's
length is over, E[x^2] and E[v^2] are within 10 % (lambda dt up to 1) and 17 % (up to 2) for sigma / a from 1/2 on, at any
time down to dt / 20; else `remark` says that they are off by up to a factor of 2.4. After that they are within 12 %.

Where the two slip levels differ, one way too, or amplitudes have a mean, the displacement drifts: the mean velocity is
within 8 % for levels that differ by a third or more (12 % for 1.1 times), the growth rate within 12 % (18 % one way at
lambda dt = 2) and the velocity variance within 8 % (13 %), for sigma over the smaller level from 1/3 to 20 and lambda dt
up to 2. Above sigma = 3 smaller levels the other level is at most 4 times the smaller one.

Covers Coulomb friction without a spring; pulses of two to four equal steps, two if refined, whose values are multiples
of a common unit and which leave no net velocity; any law of amplitudes, symmetric ones where the levels differ.)")
          .def(py::init<bool>(), py::kw_only(), py::arg("refined") = false)
          .def_property_readonly("refined", &PulseChain::refined, "Whether there are two slots to a step of the pulse.")
          .def("predict", &chain_moments, py::arg("slider"), py::arg("excitation"), py::arg("times"),
               R"(Moments by time, from rest on.

Parameters
----------
slider : Slider or Coulomb
    No spring; the levels may differ.
excitation : PoissonPulses
    Without an envelope; from rest as if no pulse had arrived before time zero.
times : array_like
    Where to answer [s], shape (T,), finite, at least 0.

Returns
-------
Moments
    `remark` says where the theory, or one of the times, is outside of its range, and where nothing slips.

Raises
------
ValueError
    What is not covered; a value out of its range.
ConvergenceError
    The chain does not become stationary within its steps.

Notes
-----
Takes 3 to 100 ms, refined 0.1 to 5 s.)")
          .def("distribution", &chain_distribution, py::arg("slider"), py::arg("pulses"), py::arg("time"),
               R"(The distribution of the displacement at a time.

By closure: the chain's first four cumulants, and its chance that nothing has slipped yet, are those of a compound Poisson
law whose slips are of gamma-distributed lengths: densities as abs(d)^(k-1) exp(-abs(d) / theta), one k for both ways, two
theta.

Parameters
----------
slider : Slider or Coulomb
    As for `predict`.
pulses : PoissonPulses
    As for `predict`.
time : float
    [s], finite, 0 or at least the length of a pulse.

Returns
-------
DisplacementDistribution
    With the chance of no displacement at all, density, probabilities and quantiles.

Raises
------
ValueError
    What is not covered; a value out of its range; sigma / a from 0.05 to 0.12 and more than 4 pulses to a step; a
    kurtosis below what a sum of slips can have by more than 0.1.
ConvergenceError
    As for `predict`.

Notes
-----
Of 100,000 blocks with equal levels, lambda dt from 0.05 to 2, at 10, 40 and 160 dt, a probability is off by less than
0.03 for sigma / a from 1/2 to 20, refined from 1/3 on; refined by less than 0.07 at 1/4 and 1/5. docs/pulse_chain.md has
the table. Takes 15 to 250 ms, refined up to some seconds.)")
          .def(
              "peak", &chain_peak, py::arg("slider"), py::arg("pulses"), py::arg("probability"),
              R"(An estimate of the largest abs(x) that a block does not exceed with a probability, up to the end of the motion.

That of a walk whose steps are the slips of `distribution`, as many as Poisson's law has it, solved on a grid with walls at
the peak. On each slip the block goes farther out by the factor that one pulse and two that overlap have in the mean square.

Parameters
----------
slider : Slider or Coulomb
    As for `predict`.
pulses : PoissonPulses
    As for `predict`; over its duration.
probability : float
    That the peak is not exceeded, in (0, 1).

Returns
-------
float
    [m]; 0 where that many do not slip at all.

Raises
------
ValueError
    What is not covered; a value out of its range.
ConvergenceError
    As for `predict`.

Notes
-----
In the thesis's four events, mu from 0.05 to 0.7 where sigma / a is 0.2 to 5 (refined below 0.3), of the 95 % peak of 40,000
blocks 0.99 to 1.10, of the 99 % one 0.99 to 1.11, and of the median 0.97 to 1.04 unless fewer than two slips are expected.
Measured for equal levels. Takes 60 to 350 ms, refined up to 10 s.)")
          .def("final_rms", &chain_rms, py::arg("slider"), py::arg("pulses"),
               R"((E[x^2(t_d)])^(1/2) at the end of the motion, t_d = pulses.duration; thesis figure 5.7.

Parameters
----------
slider : Slider or Coulomb
    No spring; the levels may differ.
pulses : PoissonPulses
    The excitation, without an envelope.

Returns
-------
float
    [m]

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
