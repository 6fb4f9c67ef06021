#include "theory/displacement_distribution.hpp"

#include <pybind11/complex.h>
#include <pybind11/numpy.h>

#include "parts.hpp"

namespace stickslip::python {

template <>
inline constexpr auto parts<DisplacementDistribution> = std::tuple(&DisplacementDistribution::theory,
                                                                   &DisplacementDistribution::slider,
                                                                   &DisplacementDistribution::source,
                                                                   &DisplacementDistribution::time);

void bind_displacement_distribution(py::module_& m) {
  value_class<DisplacementDistribution>(m, "DisplacementDistribution",
                                        R"(Distribution of a displacement that is a sum of slips.

The slips d_k are independent and their number has a Poisson distribution: a compound Poisson law. With nu(d) the
expected number of slips per length, E[exp(iux)] = exp(int (exp(iud) - 1) nu(d) dd), and the cumulants are int d^n nu(d)
dd: thesis 5.3, (5.21) to (5.28). There is an atom at x = 0, the probability exp(-int nu) of no slip; the rest has a
density, the Fourier transform of the characteristic function minus the atom. `PulseSuperposition.distribution` computes
it from the response to single pulses; `PulseChain.distribution` fits slips of gamma-distributed lengths to four
cumulants and the atom. `TransportPrediction.displacement` carries the characteristic function itself, of a law without
an atom; then `error` bounds the numerical error of probabilities.

Notes
-----
Of slips it is computed by FFT over 131072 points of a window that x leaves with a probability below 2e-13. Atom and cumulants are
accurate to 1e-12. The tabulated variance is up to 2e-4 too large for up to 1e5 expected slips, which changes
probabilities by some 3e-5; quantiles are accurate to that and to one step of the grid. Very short slips are frequent:
near x = 0 the density may grow as x^-1/2, and is averaged over a step there.

References
----------
W. Feller, An Introduction to Probability Theory and Its Applications, vol. 2 (1971), XVII.2.)")
      .def_property_readonly("remark", &DisplacementDistribution::remark,
                             "Parameters outside the range of the theory and the errors to expect; empty within it.")
      .def_property_readonly("atom", &DisplacementDistribution::atom,
                             "Probability of no slip, that is, of exactly x = 0.")
      .def_property_readonly("atom_error", &DisplacementDistribution::atom_error,
                             "Bound on the numerical error of the atom; 0 of sums of slips.")
      .def_property_readonly("slips", &DisplacementDistribution::slips,
                             "Expected number of slips, if they are independent, -ln(atom); infinite without an atom.")
      .def_property_readonly("error", &DisplacementDistribution::error,
                             "Bound on the numerical error of all probabilities; 0 of sums of slips.")
      .def_property_readonly("mean", &DisplacementDistribution::mean, "Mean [m].")
      .def_property_readonly("variance", &DisplacementDistribution::variance, "Variance [m^2].")
      .def_property_readonly("skewness", &DisplacementDistribution::skewness, "Skewness; NaN if nothing ever slips.")
      .def_property_readonly("kurtosis", &DisplacementDistribution::kurtosis,
                             "Kurtosis, 3 for a Gaussian law; NaN if nothing ever slips.")
      .def_property_readonly(
          "displacement",
          [](const py::object& self) {
            return view(self.cast<const DisplacementDistribution&>().displacement(), self);
          },
          "Displacements at which the density is tabulated, ascending and even [m], shape (N,), read-only; empty if "
          "nothing ever slips.")
      .def_property_readonly(
          "density",
          [](const py::object& self) { return view(self.cast<const DisplacementDistribution&>().density(), self); },
          "Density without the atom [1/m], shape (N,), read-only; its integral is 1 - `atom`.")
      .def("cdf", py::vectorize([](const DisplacementDistribution* self, double x) { return self->cdf(x); }),
           py::arg("x"),
           R"(Probability that the displacement is at most x.

Parameters
----------
x : array_like
    Displacements [m], any shape, no NaN.

Returns
-------
float or ndarray
    Of the shape of `x`.

Raises
------
ValueError
    NaN.)")
      .def("error_at", py::vectorize([](const DisplacementDistribution* self, double x) { return self->error_at(x); }),
           py::arg("x"),
           R"(Bound on the numerical error of `cdf(x)`, which is smaller in the tails; 0 of sums of slips.

Parameters
----------
x : array_like
    Displacements [m], any shape, no NaN.

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
           R"(Quantile: the smallest displacement not exceeded with a given probability; exactly 0 within the atom.

Parameters
----------
probability : array_like
    From 1e-9 to 1 - 1e-9, any shape.

Returns
-------
float or ndarray
    Displacements [m], of the shape of `probability`.

Raises
------
ValueError
    A value out of range.)")
      .def("characteristic",
           py::vectorize([](const DisplacementDistribution* self, double u) { return self->characteristic(u); }),
           py::arg("u"),
           R"(Characteristic function E[exp(iux)] of the tabulated law.

Parameters
----------
u : array_like
    Arguments [1/m], finite, any shape.

Returns
-------
complex or ndarray
    Of the shape of `u`; the relative error of its logarithm is 2e-4 where u is of the order of 1 / std. Takes 2 ms
    each.

Raises
------
ValueError
    A value that is not finite.)")
      .def("__repr__", [](const DisplacementDistribution& d) {
        const std::string of =
            d.error() > 0 ? "error of probabilities " + digits(d.error()) : digits(d.slips()) + " slips expected";
        return "<DisplacementDistribution: " + of + ", atom " + digits(d.atom()) + ", std " +
               digits(std::sqrt(d.variance())) + " m>";
      });
}

}  // namespace stickslip::python
