#include "stickslip/theory/shaping_filter.hpp"

#include <array>

#include "parts.hpp"
#include "theory/theory.hpp"

namespace stickslip::python {
namespace {

using theory::ShapingFilter;
using Row = std::array<double, 5>;

ShapingFilter from_rows(double s0, const std::vector<Row>& rows) {
  std::vector<ShapingFilter::Section> sections;
  for (const auto& [b2, b1, b0, d1, d0] : rows) sections.push_back({b2, b1, b0, d1, d0});
  return ShapingFilter(s0, std::move(sections));
}

py::tuple rows(const ShapingFilter& filter) {
  py::list all;
  for (const auto& s : filter.sections()) all.append(py::make_tuple(s.b2, s.b1, s.b0, s.d1, s.d0));
  return py::tuple(all);
}

// The first type of a variant must be default-constructible.
ShapingFilter fitted(const std::variant<double, Spectrum, PoissonPulses>& source, int order, double max_misfit) {
  const ShapingFilter::Fit fit{order, max_misfit};
  return std::visit(
      [&]<class Source>(const Source& any) {
        if constexpr (std::same_as<Source, double>)
          return ShapingFilter(any);
        else
          return ShapingFilter::of(any, fit);
      },
      source);
}

}  // namespace

void bind_shaping_filter(py::module_& m) {
  value_class<ShapingFilter>(m, "ShapingFilter",
                             R"(White noise through a linear filter: a ground acceleration with a rational spectrum.

White noise of two-sided level s0 passes through second-order sections in series::

    n = H(d/dt) w,  H(s) = product of (b2 s^2 + b1 s + b0) / (s^2 + d1 s + d0),  S(omega) = s0 |H(i omega)|^2

Without sections it is white noise.

Parameters
----------
s0 : float
    Level of the white noise [m^2/s^3], positive and finite.
sections : sequence of (b2, b1, b0, d1, d0), optional
    At most 8; b2, b1 [1/s] and b0 [1/s^2] finite and not all zero, d1 [1/s] and d0 [1/s^2] positive and finite.

Raises
------
ValueError
    A value out of range (names its section); an unstable section.

Examples
--------
>>> import stickslip as ss
>>> soil = ss.theory.ShapingFilter.of(ss.Spectrum.kanai_tajimi(s0=0.02, frequency=15, damping=0.6))
>>> soil.order, soil.misfit
(2, 0.0))")
      .def(py::init(&from_rows), py::arg("s0"), py::arg("sections") = std::vector<Row>())
      .def_static("of", &fitted, py::arg("spectrum"), py::kw_only(), py::arg("order") = ShapingFilter::Fit().order,
                  py::arg("max_misfit") = ShapingFilter::Fit().max_misfit, R"(Find the filter for a spectrum.

White noise, Kanai-Tajimi and Clough-Penzien spectra have an exact filter with 0, 2 and 4 states. For other spectra, the
filter is the best one of the given order, with as many zeros at zero frequency as the spectrum has, up to four: it
minimizes the integral of (sqrt(S) - sqrt(S_filter))^2 over the logarithm of omega.

Parameters
----------
spectrum : float, Spectrum or PoissonPulses
    A number is the level S0 of white noise [m^2/s^3]. For pulses, the spectrum is `PoissonPulses.density`.
order : int, optional
    Maximum number of states, two per section: 2, 4, ... 16; the filter has fewer if the last ones do not improve it.
max_misfit : float, optional
    Maximum accepted `misfit`, above 0.

Returns
-------
ShapingFilter

Raises
------
ValueError
    An order or a misfit out of range; a misfit above max_misfit (names the misfit).

Notes
-----
Takes 1 us; a fit of order 8 takes some 50 to 200 ms. With order 8 an ideal band-pass has a misfit of 0.03 to 0.13,
Poisson pulses 0.09.)")
      .def_property_readonly("s0", &ShapingFilter::s0, "Level of the white noise [m^2/s^3].")
      .def_property_readonly("sections", &rows, "Sections (b2, b1, b0, d1, d0).")
      .def_property_readonly("order", &ShapingFilter::order, "Number of states.")
      .def_property_readonly(
          "misfit", &ShapingFilter::misfit,
          "Misfit of the filter: the integral of abs(S - S_filter) over that of S; 0 if the filter is exact.")
      .def(
          "__call__",
          [](const ShapingFilter& self, const py::object& omega) {
            return of_each(omega, "ShapingFilter: omega", [&self](double w) { return self(w); });
          },
          py::arg("omega"), R"(Two-sided spectral density of the acceleration.

Parameters
----------
omega : float or array_like
    [rad/s], of either sign.

Returns
-------
float or ndarray
    [m^2/s^3], of the shape of omega.)")
      .def("__repr__", [](const ShapingFilter& self) {
        return "<ShapingFilter: order " + std::to_string(self.order()) + ", s0 = " + digits(self.s0()) +
               " m^2/s^3, misfit " + digits(self.misfit()) + ">";
      });
}

}  // namespace stickslip::python
