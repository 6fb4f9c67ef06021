#include "theory/displacement_distribution.hpp"

#include <pybind11/complex.h>
#include <pybind11/numpy.h>

#include "parts.hpp"

namespace stickslip::python {

template <>
inline constexpr auto parts<DisplacementDistribution> = std::tuple(&DisplacementDistribution::theory,
                                                                   &DisplacementDistribution::slider,
                                                                   &DisplacementDistribution::pulses,
                                                                   &DisplacementDistribution::time);

void bind_displacement_distribution(py::module_& m) {
  value_class<DisplacementDistribution>(m, "DisplacementDistribution",
                                        R"(The distribution of a displacement that is the sum of slips.

The slips d_k are independent, their number is Poisson's: a compound Poisson law. With nu(d) the expected number of slips
per length, E[exp(iux)] = exp(int (exp(iud) - 1) nu(d) dd), and the cumulants are int d^n nu(d) dd: thesis 5.3, (5.21) to
(5.28). There is an atom at x = 0, the chance exp(-int nu) that nothing slips; the rest has a density, the Fourier
transform of the characteristic function less the atom. `PulseSuperposition.distribution` makes it from what single
pulses do; `PulseChain.distribution` fits slips of gamma-distributed lengths to four cumulants and the atom.

Notes
-----
By FFT over 131072 points of a window beyond which x lies with a probability below 2e-13. Atom and cumulants are to 1e-12;
the tabulated variance is up to 2e-4 too large for up to 1e5 slips expected, which moves probabilities by some 3e-5;
quantiles are to that and to one step of the grid. Slips of vanishing
length are frequent: near x = 0 the density may grow as x^-1/2, and there it is a mean over a step.

References
----------
W. Feller, An Introduction to Probability Theory and Its Applications, vol. 2 (1971), XVII.2.)")
      .def_property_readonly("atom", &DisplacementDistribution::atom,
                             "The chance that nothing slips, exp(-slips): the probability of exactly x = 0.")
      .def_property_readonly("slips", &DisplacementDistribution::slips, "Expected number of slips.")
      .def_property_readonly("mean", &DisplacementDistribution::mean, "[m]")
      .def_property_readonly("variance", &DisplacementDistribution::variance, "[m^2]")
      .def_property_readonly("skewness", &DisplacementDistribution::skewness, "NaN where nothing ever slips.")
      .def_property_readonly("kurtosis", &DisplacementDistribution::kurtosis,
                             "3 of a Gaussian law; NaN where nothing ever slips.")
      .def_property_readonly(
          "displacement",
          [](const py::object& self) {
            return view(self.cast<const DisplacementDistribution&>().displacement(), self);
          },
          "Where the density is tabulated, ascending and even [m], shape (N,), read-only; empty where nothing ever "
          "slips.")
      .def_property_readonly(
          "density",
          [](const py::object& self) { return view(self.cast<const DisplacementDistribution&>().density(), self); },
          "Of the part without the atom [1/m], shape (N,), read-only: its integral is 1 - `atom`.")
      .def("cdf", py::vectorize([](const DisplacementDistribution* self, double x) { return self->cdf(x); }),
           py::arg("x"),
           R"(The probability that the displacement is at most x.

Parameters
----------
x : array_like
    [m], any shape, no NaN.

Returns
-------
float or ndarray
    Of the shape of `x`.

Raises
------
ValueError
    NaN.)")
      .def("quantile", py::vectorize([](const DisplacementDistribution* self, double p) { return self->quantile(p); }),
           py::arg("probability"),
           R"(The least displacement that is not exceeded with a probability; exactly 0 within the atom.

Parameters
----------
probability : array_like
    At least 1e-9 and at most 1 - 1e-9, any shape.

Returns
-------
float or ndarray
    [m], of the shape of `probability`.

Raises
------
ValueError
    A value out of range.)")
      .def("characteristic",
           py::vectorize([](const DisplacementDistribution* self, double u) { return self->characteristic(u); }),
           py::arg("u"),
           R"(The characteristic function E[exp(iux)], from the tabulated law.

Parameters
----------
u : array_like
    [1/m], finite, any shape.

Returns
-------
complex or ndarray
    Of the shape of `u`; its logarithm is to a relative 2e-4 where u is of the order of 1 / std. Takes 2 ms each.

Raises
------
ValueError
    A value that is not finite.)")
      .def("__repr__", [](const DisplacementDistribution& d) {
        return "<DisplacementDistribution: " + detail::shortest(d.slips()) + " slips expected, atom " +
               detail::shortest(d.atom()) + ", std " + detail::shortest(std::sqrt(d.variance())) + " m>";
      });
}

}  // namespace stickslip::python
