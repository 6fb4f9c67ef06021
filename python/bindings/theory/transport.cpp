#include "stickslip/theory/transport.hpp"

#include <limits>
#include <memory>
#include <optional>
#include <variant>

#include <pybind11/numpy.h>

#include "parts.hpp"
#include "stickslip/theory/overturning.hpp"
#include "theory/displacement_distribution.hpp"
#include "theory/theory.hpp"

namespace stickslip::python {
namespace {

using theory::Transport;
using theory::TransportCost;
using theory::TransportStationary;

/// A prediction with what it was made of. The stationary motion is computed once.
struct TransportPrediction : Moments {
  TransportPrediction(const Transport& by, AnySlider any, DistributionSource source, Moments moments,
                      const TransportCost& work)
      : Moments(std::move(moments)), theory(by), slider(std::move(any)), excitation(std::move(source)), cost(work) {}

  Moments moments() const { return *this; }

  Transport theory;
  AnySlider slider;
  DistributionSource excitation;
  TransportCost cost;
  std::shared_ptr<std::optional<TransportStationary>> stationary =
      std::make_shared<std::optional<TransportStationary>>();
};

TransportPrediction predicted(const Transport& self, const AnySlider& slider, const DistributionSource& excitation,
                              const py::object& times) {
  const std::vector<double> at = to_vector(times, "Transport: times", "s");
  const py::gil_scoped_release released;
  const theory::TransportPrediction found =
      self.predict(slider, transport_excitation(excitation), at, &check_for_interrupt);
  return {self, slider, excitation, found, found.cost()};
}

TransportStationary stationary_motion(const Transport& self, const AnySlider& slider,
                                      const DistributionSource& excitation) {
  const py::gil_scoped_release released;
  return self.stationary(slider, transport_excitation(excitation), &check_for_interrupt);
}

std::vector<Estimate> overturning(const Transport& self, const SlenderBlock& block, const DistributionSource& noise,
                                  const py::object& times, double ratio) {
  if (std::holds_alternative<PoissonPulses>(noise))
    throw std::invalid_argument("Transport.overturning: covers white noise and noise from a filter of two states");
  const std::vector<double> at = to_vector(times, "Transport.overturning: times", "s");
  const auto two_state = std::get<theory::TwoStateNoise>(transport_excitation(noise));
  const py::gil_scoped_release released;
  return theory::overturning_probability(
      block, two_state, at, {.tolerance = self.tolerance(), .ratio = ratio, .progress = &check_for_interrupt});
}

/// The peak with what it was made of.
struct TransportPeak {
  Transport theory;
  AnySlider slider;
  DistributionSource excitation;
  double time;

  theory::TransportPeak peak() const { return {theory, slider, transport_excitation(excitation), time}; }
};

TransportPeak peak_of(const TransportPrediction& self, double time) {
  TransportPeak peak{self.theory, self.slider, self.excitation, time};
  peak.peak();
  return peak;
}

Estimate exceedance(const TransportPeak& self, double level) {
  const py::gil_scoped_release released;
  return self.peak().exceedance(level, &check_for_interrupt);
}

Estimate peak_quantile(const TransportPeak& self, double probability) {
  const py::gil_scoped_release released;
  return self.peak().quantile(probability, &check_for_interrupt);
}

/// The distribution of a velocity with what it was made of.
struct VelocityDistribution : theory::VelocityDistribution {
  VelocityDistribution(const Transport& by, AnySlider any, DistributionSource source, double at)
      : theory::VelocityDistribution(by.velocity(any, transport_excitation(source), at, &check_for_interrupt)),
        theory(by),
        slider(std::move(any)),
        excitation(std::move(source)),
        time(at) {}

  Transport theory;
  AnySlider slider;
  DistributionSource excitation;
  double time;
};

VelocityDistribution velocity_of(const TransportPrediction& self, double time) {
  const py::gil_scoped_release released;
  return {self.theory, self.slider, self.excitation, time};
}

DisplacementDistribution displacement_of(const TransportPrediction& self, double time) {
  const py::gil_scoped_release released;
  return {self.theory, self.slider, self.excitation, time};
}

TransportStationary stationary_of(const TransportPrediction& self) {
  if (!*self.stationary) *self.stationary = stationary_motion(self.theory, self.slider, self.excitation);
  return **self.stationary;
}

/// The errors as values.
Moments errors_of(const TransportPrediction& self) {
  Moments errors = self;
  for (Estimates Moments::*figure : {&Moments::displacement_mean, &Moments::displacement_variance, &Moments::covariance,
                                     &Moments::velocity_mean, &Moments::velocity_variance}) {
    Estimates& one = errors.*figure;
    one.value.assign(one.error.size(), 0);
    std::swap(one.value, one.error);
  }
  errors.growth_rate = {self.growth_rate.error, 0};
  errors.remark.clear();
  return errors;
}

}  // namespace

template <>
inline constexpr auto parts<Transport> = std::tuple(&Transport::tolerance);
template <>
inline constexpr auto parts<TransportCost> = std::tuple(&TransportCost::nodes, &TransportCost::steps,
                                                        &TransportCost::seconds);
template <>
inline constexpr auto parts<TransportStationary> = std::tuple(&TransportStationary::displacement_mean,
                                                              &TransportStationary::displacement_variance,
                                                              &TransportStationary::velocity_mean,
                                                              &TransportStationary::velocity_variance,
                                                              &TransportStationary::growth_rate,
                                                              &TransportStationary::rest);
template <>
inline constexpr auto parts<TransportPrediction> = std::tuple(&TransportPrediction::theory,
                                                              &TransportPrediction::slider,
                                                              &TransportPrediction::excitation,
                                                              &TransportPrediction::moments,
                                                              &TransportPrediction::cost);

template <>
inline constexpr auto parts<TransportPeak> = std::tuple(&TransportPeak::theory, &TransportPeak::slider,
                                                        &TransportPeak::excitation, &TransportPeak::time);

template <>
inline constexpr auto parts<VelocityDistribution> = std::tuple(&VelocityDistribution::theory,
                                                               &VelocityDistribution::slider,
                                                               &VelocityDistribution::excitation,
                                                               &VelocityDistribution::time);

void bind_transport(py::module_& m) {
  value_class<VelocityDistribution>(m, "VelocityDistribution", R"(Distribution of a velocity, with an atom at rest.

Made by `TransportPrediction.velocity`. Between the values of a table it is interpolated by monotone cubics (M. Steffen,
Astron. Astrophys. 239 (1990), 443-450).)")
      .def_property_readonly("remark", &VelocityDistribution::remark, "As of the prediction.")
      .def_property_readonly("atom", &VelocityDistribution::atom, "Probability of rest.")
      .def_property_readonly("atom_error", &VelocityDistribution::atom_error, "Bound on its numerical error.")
      .def_property_readonly("error", &VelocityDistribution::error,
                             "Bound on the numerical error of probabilities away from rest.")
      .def_property_readonly(
          "velocity",
          [](const py::object& self) { return view(self.cast<const VelocityDistribution&>().velocity(), self); },
          "Velocities of the table, ascending [m/s], shape (N,), read-only.")
      .def("cdf", py::vectorize([](const VelocityDistribution* self, double v) { return self->cdf(v); }), py::arg("v"),
           R"(Probability that the velocity is at most v.

Parameters
----------
v : array_like
    Velocities [m/s], any shape, no NaN.

Returns
-------
float or ndarray
    Of the shape of `v`.

Raises
------
ValueError
    NaN.)")
      .def("density", py::vectorize([](const VelocityDistribution* self, double v) { return self->density(v); }),
           py::arg("v"), R"(Density without the atom; at 0 that of positive velocities.

Parameters
----------
v : array_like
    Velocities [m/s], any shape, no NaN.

Returns
-------
float or ndarray
    [s/m], of the shape of `v`.

Raises
------
ValueError
    NaN.)")
      .def("quantile", py::vectorize([](const VelocityDistribution* self, double p) { return self->quantile(p); }),
           py::arg("probability"),
           R"(Quantile: the smallest velocity not exceeded with a given probability; exactly 0 within the atom.

Parameters
----------
probability : array_like
    Between 0 and 1, any shape.

Returns
-------
float or ndarray
    Velocities [m/s], of the shape of `probability`.

Raises
------
ValueError
    A value out of range.)")
      .def("__repr__",
           [](const VelocityDistribution& d) { return "<VelocityDistribution: rest " + digits(d.atom()) + ">"; });

  value_class<TransportCost>(m, "TransportCost", R"(The work of a prediction by `Transport`.)")
      .def_readonly("nodes", &TransportCost::nodes, "Nodes of the finest grid.")
      .def_readonly("steps", &TransportCost::steps, "Steps to the last time, with the longest step.")
      .def_readonly("seconds", &TransportCost::seconds, "Time of all grids [s].")
      .def("__repr__", [](const TransportCost& cost) {
        return "<TransportCost: " + std::to_string(cost.nodes) + " nodes, " + std::to_string(cost.steps) + " steps, " +
               digits(cost.seconds) + " s>";
      });

  value_class<TransportStationary>(m, "TransportStationary", R"(The stationary motion, by `Transport`.

Each value is an `Estimate`, whose `error` is numerical: what steps and grids contribute, by refinement.)")
      .def_readonly("displacement_mean", &TransportStationary::displacement_mean,
                    "Mean of x [m]; NaN without a spring.")
      .def_readonly("displacement_variance", &TransportStationary::displacement_variance,
                    "Variance of x [m^2]; infinite without a spring.")
      .def_readonly("velocity_mean", &TransportStationary::velocity_mean, "Mean of x' [m/s].")
      .def_readonly("velocity_variance", &TransportStationary::velocity_variance, "Variance of x' [m^2/s^2].")
      .def_readonly("growth_rate", &TransportStationary::growth_rate,
                    "Growth of the variance of x [m^2/s]; 0 with a spring.")
      .def_readonly("rest", &TransportStationary::rest,
                    "Fraction of time at rest; 0 under continuous white noise. Filtered noise crosses a level "
                    "infinitely often, so that it converges with the root of the step: its error is some percent.")
      .def("__repr__", [](const TransportStationary& s) {
        return "<TransportStationary: variance of x' " + digits(s.velocity_variance.value) + " m^2/s^2, " +
               (std::isfinite(s.displacement_variance.value)
                    ? "of x " + digits(s.displacement_variance.value) + " m^2>"
                    : "growth rate " + digits(s.growth_rate.value) + " m^2/s>");
      });

  value_class<TransportPeak>(m, "TransportPeak", R"(The largest abs(x) from rest up to a time, by `Transport`.

By absorbing walls at -L and L, with x on the grid: an exact step is lost if its path crosses one. Values have a
numerical error, by one refinement of step and grid.)")
      .def_readonly("time", &TransportPeak::time, "Time [s].")
      .def("exceedance", &exceedance, py::arg("level"), R"(Probability that the peak exceeds a level.

Parameters
----------
level : float
    Level [m], positive and finite.

Returns
-------
Estimate
    Probability and its numerical error.

Raises
------
ValueError
    A level out of range.

Notes
-----
Takes 2 to 20 s.)")
      .def("quantile", &peak_quantile, py::arg("probability"),
           R"(Level that the peak does not exceed with a probability.

Parameters
----------
probability : float
    From 0.01 to 0.999.

Returns
-------
Estimate
    Level and its numerical error [m]. 0, with an error of a thousandth of the rms displacement, if more than this part
    hardly moves.

Raises
------
ValueError
    A probability out of range.
ConvergenceError
    No such level within a factor of 1000 of the rms displacement: the slider hardly slides.

Notes
-----
Takes 3 to 30 s: one `exceedance`, at a level found with a coarse grid.)")
      .def("__repr__", [](const TransportPeak& p) { return "<TransportPeak up to " + digits(p.time) + " s>"; });

  value_class<TransportPrediction, Moments>(m, "TransportPrediction", R"(Moments by time, by `Transport`.

They are `Moments`, whose errors are numerical: what steps and grids contribute, by refinement.)")
      .def_property_readonly("error", &errors_of, "The errors, as Moments: `error.displacement_variance` [m^2] etc.")
      .def_property_readonly(
          "cost", [](const TransportPrediction& self) { return self.cost; }, "The work, as TransportCost.")
      .def_property_readonly("stationary", &stationary_of, R"(The stationary motion, as TransportStationary.

Computed at the first use: as `Transport.stationary`.)")
      .def("displacement", &displacement_of, py::arg("time"), R"(Distribution of the displacement at a time.

With x on a grid that becomes fine towards the start. The atom is the probability that the slider has not slipped.

Parameters
----------
time : float
    Time [s], positive and finite.

Returns
-------
DisplacementDistribution
    `error_at` bounds the numerical error of each probability: docs/transport.md compares it with simulation, down to
    probabilities of 1e-4.

Raises
------
ValueError
    A time out of range.

Notes
-----
Takes 1 to 10 s without a spring, up to 60 s with one.)")
      .def("velocity", &velocity_of, py::arg("time"),
           R"(Distribution of the velocity at a time, with the probability of rest.

Of each velocity the probability that the load of the last step leads below it, integrated over that load exactly.
Under pulses it is the law of a random phase of the lattice on which they begin, as that of the displacement.

Parameters
----------
time : float
    Time [s], positive and finite.

Returns
-------
VelocityDistribution

Raises
------
ValueError
    A time out of range.

Notes
-----
Takes 0.2 to 1 s without a spring, up to 20 s with one.)")
      .def("peak", &peak_of, py::arg("time"), R"(The largest abs(x) from rest up to a time.

Parameters
----------
time : float
    Time [s], positive and finite.

Returns
-------
TransportPeak

Raises
------
ValueError
    A time out of range.)")
      .def("__repr__", [](const TransportPrediction& self) {
        return "<TransportPrediction at " + std::to_string(self.time.size()) + " times" +
               (self.remark.empty() ? "" : ": " + self.remark) + ">";
      });

  auto type = value_class<Transport>(m, "Transport", R"(The transport operator: carries the probability of the state.

Over a step h the load is held at its value in the middle, and the step has two exact parts: S, the slider's own motion
under a constant load, and Z, the step of the filter::

    (T f)(x, v, z) = (Z f)(S(x, v; n(z)), z),    p_(k+1) = T' p_k

Functions of the state are represented by their values at nodes, probability by the adjoint T'. Moments are those of p;
the growth rate is the solution of a linear system. The error is of second order in h; each value is extrapolated from
two steps (under white noise from three to six), and its error is that of the extrapolation plus the change when degrees
and windows of the grid are refined. docs/transport.md has the derivation and a table of errors.

Covers Coulomb friction with equal, unequal and one-way levels, friction that depends on the speed (`VelocityDependent`,
`Stribeck`), and static friction above kinetic; with or without a spring and a damper; with a one-way mounting; on slopes
without vertical motion. White noise, and noise from a filter of two states: Kanai and Tajimi's, or one without content
at zero frequency. Casters are covered under noise, static friction under filtered or held noise, on a spring with
a tolerance of at least 0.05, slopes under filtered or held noise and pulses, with an rms acceleration of at most g / (4.5 tan(slope)). A
`GaussianExcitation` stands for its spectrum as a continuous Gaussian process, stationary at t = 0, not periodic, with
its content at zero frequency; white noise with constant, uncorrected interpolation is predicted as sampled.

The damping ratio of the filter is from 0.1 to 1.5, its rms acceleration at least 0.35 times the lower level at rest and
at most 20 times the least resistance, and the spring at most 5 times as fast as it. Under white noise one level is at
most 10 times the other, or infinite, wn pi S0 / a^2 at least 0.05, and a caster on a spring has a reach wn >= 3 pi S0.
Under filtered noise a caster has no spring, a reach of at least a / wg^2, an rms acceleration from 0.7 a to 6 a and a
damping ratio of the filter from 0.3 to 0.9, and takes minutes: use a tolerance of 0.1 for errors of 1 to 4 %.
Static friction on a spring under filtered noise is equal both ways and at most twice the kinetic one a, wn at most
3 wg, the rms acceleration from 0.7 a to 3 a and the damping ratio of the filter from 0.3 to 0.9.

`PoissonPulses` of two equal steps, up and down, with Gaussian amplitudes and without an envelope, are moved to the nodes
of a lattice of times, of one and two slots to a half width Dt; what is left of the whole error with two slots is 0.20 to
0.27 of what they change. Blocks, sliders with a spring and dampers, laws that depend on the speed. The rms amplitude is
from 0.3 to 6 times the lower level, the number of pulses in Dt from 0.03 to 10, the rms acceleration at least 0.25 of
the level, and wn Dt at most 3. docs/transport.md measures their errors.

Parameters
----------
tolerance : float, optional
    Relative, from 1e-6 to 0.3: steps and grids are refined until the errors of both variances at the last time, and of
    the growth rate, are below it. Under pulses the error is larger, that of the lattice, and is stated.

Raises
------
ValueError
    A tolerance out of range.)");
  type.def(py::init<double>(), py::kw_only(), py::arg("tolerance") = 1e-2)
      .def_property_readonly("tolerance", &Transport::tolerance, "Relative.")
      .def("predict", &predicted, py::arg("slider"), py::arg("excitation"), py::arg("times"),
           R"(Predict moments by time, from rest.

Parameters
----------
slider : Slider or friction law
    Positive levels, which may differ; the backward one may be infinite. Spring and damper are optional.
excitation : float, Spectrum, ShapingFilter, GaussianExcitation or PoissonPulses
    A number is the level S0 of white noise [m^2/s^3]. Filters of at most two states.
times : array_like
    Times [s], shape (T,), finite, at least 0, increasing.

Returns
-------
TransportPrediction
    `remark` says how the motions of a `GaussianExcitation` differ from the process. The `growth_rate` of a caster
    without a spring is NaN.

Raises
------
ValueError
    An input that the theory does not cover; a value out of range.
ConvergenceError
    The tolerance is not reached with the largest grid; the message has the best value and its error. Not under pulses.

Notes
-----
Takes 0.3 to 2 s for a block, up to 20 s at the edges of the range, 2 to 8 s for static friction, 2 to 60 s with a
spring, 3 to 300 s for a caster; under pulses 0.2 to 5 s for a block, 2 to 25 s with a spring.)")
      .def("stationary", &stationary_motion, py::arg("slider"), py::arg("excitation"), R"(Predict the stationary motion.

Parameters
----------
slider : Slider or friction law
    As for `predict`, but not a caster, which becomes stationary slowly at best.
excitation : float, Spectrum, ShapingFilter, GaussianExcitation or PoissonPulses
    As for `predict`.

Returns
-------
TransportStationary

Raises
------
ValueError, ConvergenceError
    As for `predict`.)")
      .def("overturning", &overturning, py::arg("block"), py::arg("excitation"), py::arg("times"), py::kw_only(),
           py::arg("ratio") = std::numeric_limits<double>::infinity(),
           R"(Probability that a slender block that starts at rest has overturned.

A function of the state is carried backward from f = 1 where the block is lost; after k steps it is the probability to
be lost within k steps,

    f_(k+1)(y, v, z) = E f_k(S(y, v; n(z)), z'),

with S the exact motion with all impacts, y = theta / alpha. By symmetry a block with equal sides is a ball that bounces
on a half line, where each bounce changes the sign of the noise.

Parameters
----------
block : SlenderBlock
    With a restitution of at least 0.2, and one alpha at most twice the other.
excitation : float, Spectrum, ShapingFilter or GaussianExcitation
    Noise as for `predict`: white, also held, or filtered with a frequency from 0.5 p to 50 p. It gives the rate a
    deviation (white: sqrt(pi p S0)/g) of 0.04 to 1 times p alpha.
times : array_like
    Times [s], shape (N,), finite, at least 0, increasing.
ratio : float, optional
    The |theta| over alpha at which the block counts as overturned before, positive; default: where it is certain not
    to come back. A finite one gives the probability that the peak exceeds it.

Returns
-------
list of Estimate
    N probabilities with their errors, which are numerical: the last change by the refinement of steps and grids, and at
    least 0.4 %. Refinement ends below `tolerance`, which is at least 0.005 here.

Raises
------
ValueError
    What is not covered, or a value out of range.

Notes
-----
Takes 1 to 20 s under white noise, 20 s to some minutes under filtered noise; docs/rocking.md compares it with
simulation.)")
      .def("__repr__",
           [](const Transport& t) { return "Transport(tolerance=" + detail::shortest(t.tolerance()) + ")"; });
  def_theory(type);
}

}  // namespace stickslip::python
