#include "stickslip/theory/pulse_chain.hpp"

#include "parts.hpp"
#include "theory/theory.hpp"

namespace stickslip::python {
namespace {

using theory::PulseChain;

const Slider<Coulomb>& coulomb_of(const AnySlider& slider) {
  if (const auto* block = std::get_if<Slider<Coulomb>>(&slider)) return *block;
  throw std::invalid_argument("PulseChain: covers Coulomb friction; PulseSuperposition covers other laws");
}

Moments chain_moments(const PulseChain& self, const AnySlider& slider, const PoissonPulses& pulses,
                      const py::object& times) {
  const std::vector<double> at = to_vector(times, "PulseChain: times");
  const py::gil_scoped_release released;
  return self.predict(coulomb_of(slider), pulses, at, &check_for_interrupt);
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
    Two slots to a step of the pulse up to sigma / a = 1: more exact, up to some seconds.

Notes
-----
Against simulation, for the symmetric rectangular pulse and Gaussian amplitudes, lambda dt from 0.05 to 2 (4): growth rate
and velocity variance are within 4 % (9 %) for sigma / a from 1 to 20, within 9 % (13 %) from 1/3 on. Below that they are
too high: the growth rate by 19 % at 1/4 and 41 % at 1/5, the final rms of the thesis's events (lambda dt = 1/2) by 9 % at
1/4, 16 % at 1/5, 27 % at 1/6 and 37(3) % at 0.15. Refined they are within 3 % (4 %) from 1/3 on, within 7 % at 1/4 and
17 % at 1/5, the final rms within 5 % at 1/5; above sigma / a = 1 refined is the same. From rest on, before a pulse's
length is over, E[x^2] and E[v^2] are within 10 % (lambda dt up to 1) and 17 % (up to 2) for sigma / a from 1/2 on, at any
time down to dt / 20; else `remark` says that they are off by up to a factor of 2.4. After that they are within 12 %.

Covers equal slip levels without a spring; pulses of two to four equal steps, two if refined, whose values are multiples
of a common unit and which leave no net velocity; symmetric laws of amplitudes.)")
          .def(py::init<bool>(), py::kw_only(), py::arg("refined") = false)
          .def_property_readonly("refined", &PulseChain::refined, "Whether there are two slots to a step of the pulse.")
          .def("predict", &chain_moments, py::arg("slider"), py::arg("excitation"), py::arg("times"),
               R"(Moments by time, from rest on.

Parameters
----------
slider : Slider or Coulomb
    Equal slip levels, no spring.
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
          .def("final_rms", &chain_rms, py::arg("slider"), py::arg("pulses"),
               R"((E[x^2(t_d)])^(1/2) at the end of the motion, t_d = pulses.duration; thesis figure 5.7.

Parameters
----------
slider : Slider or Coulomb
    Equal slip levels, no spring.
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
